//! What is given and cannot be used.

use core::fmt;

/// A number or a setting that was given and cannot be used. What is compared is a pure number or in the unit of what was
/// given.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// A number outside the range that it may have.
    OutOfRange {
        /// The mechanism, the scene or the stop, if it is about one.
        of: Option<&'static str>,
        /// What was given.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The least that it may be.
        least: f64,
        /// The most that it may be.
        most: f64,
    },
    /// A stop whose least value is not below its greatest.
    EmptyRange {
        /// The scene.
        scene: &'static str,
        /// The stop.
        stop: &'static str,
        /// Its least value.
        lower: f64,
        /// Its greatest value.
        upper: f64,
    },
    /// A turn of the input does not bring the mechanism back to where it was.
    NotPeriodic {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
    },
    /// A motion begins at another place or rate than its drive says.
    Inconsistent {
        /// The scene.
        scene: &'static str,
        /// The driven input.
        coordinate: &'static str,
        /// Its position or its rate.
        quantity: &'static str,
        /// By how much it differs.
        gap: f64,
    },
    /// A motion begins beyond a stop.
    BeyondStop {
        /// The scene.
        scene: &'static str,
        /// The stop.
        stop: &'static str,
        /// By how much, in the unit of what it stops.
        gap: f64,
    },
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { of, quantity, value, least, most } => {
                let (of, name) = of.map_or(("", ""), |name| (" of ", name));
                write!(f, "{quantity}{of}{name} is {value:?}: it must be ")?;
                match (*least > f64::MIN, *most < f64::MAX) {
                    (true, true) => write!(f, "between {least:?} and {most:?}"),
                    (true, false) => write!(f, "at least {least:?}"),
                    (false, true) => write!(f, "at most {most:?}"),
                    (false, false) => write!(f, "a finite number"),
                }
            }
            Self::EmptyRange { scene, stop, lower, upper } => {
                write!(f, "the {stop} in {scene} leaves nothing between {lower} and {upper}")
            }
            Self::NotPeriodic { mechanism } => write!(f, "a turn of the input does not bring {mechanism} back"),
            Self::Inconsistent { scene, coordinate, quantity, gap } => {
                write!(
                    f,
                    "{scene} begins with another {quantity} of {coordinate} than its drive says: off by {gap:.1e}"
                )
            }
            Self::BeyondStop { scene, stop, gap } => write!(f, "{scene} begins beyond the {stop}: by {gap:.1e}"),
        }
    }
}

impl core::error::Error for InputError {}
