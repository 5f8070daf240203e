//! The reasons why there is no price.

use core::fmt;

use linkage_dynamics::MotionError;
use linkage_runtime::{InputError, PathError, PositionError};

/// The reason why there is no price.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum PriceError {
    /// An option is invalid, or the motion has none of the inputs that were asked for.
    Input(InputError),
    /// The motion has no position at an input between its ends.
    Path(PathError),
    /// There is no reference at an input: a position near the one in `f64`, with its rates and accelerations.
    Reference {
        /// The input.
        input: f64,
        /// The reason.
        error: PositionError,
    },
    /// The mechanism in double-double has other parameters than that in `f64`.
    OtherParameters {
        /// The mechanism.
        mechanism: &'static str,
        /// The number of an equation that does not hold, counted from 1.
        equation: usize,
        /// Its residual, divided by the sum of the magnitudes of its terms.
        residual: f64,
    },
    /// An equation in double-double has fewer digits than its scalar: its change over a tiny distance is not its derivative
    /// times that. A user function computes in `f64`.
    FewDigits {
        /// The mechanism.
        mechanism: &'static str,
        /// The number of the equation, counted from 1.
        equation: usize,
        /// A user function in the equations, if there is one.
        function: Option<&'static str>,
        /// The input.
        input: f64,
    },
    /// A scene in double-double has fewer digits than its scalar, for the same reason.
    FewDigitsOfScene {
        /// The scene.
        scene: &'static str,
    },
    /// A scene cannot be started.
    Start(Box<MotionError>),
    /// A scene ends before the time that was asked for.
    EndsEarly {
        /// The scene.
        scene: &'static str,
        /// The time at which it ends.
        t: f64,
        /// The time that was asked for.
        end: f64,
        /// The reason.
        error: Box<MotionError>,
    },
}

impl fmt::Display for PriceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::Path(error) => error.fmt(f),
            Self::Reference { input, error } => write!(f, "no reference at the input {input}: {error}"),
            Self::OtherParameters { mechanism, equation, residual } => write!(
                f,
                "`{mechanism}` in double-double has other parameters: the residual of its equation {equation} at a position \
                 of the motion is {residual:.0e} of its terms; make it by `map(DoubleDouble::from)` of the mechanism that moves"
            ),
            Self::FewDigits { mechanism, equation, function, input } => {
                let of = |function| format!("the user function `{function}`");
                let who = function.map_or_else(|| "a user function".to_owned(), of);
                write!(
                    f,
                    "`{mechanism}` has no double-double form: its equation {equation} has fewer than 31 digits at the input \
                     {input}; {who} must compute in the scalar of its argument"
                )
            }
            Self::FewDigitsOfScene { scene } => write!(
                f,
                "`{scene}` has no double-double form: its accelerations have fewer than 31 digits; its user functions must \
                 compute in the scalar of their arguments"
            ),
            Self::Start(error) => write!(f, "the scene does not start: {error}"),
            Self::EndsEarly { scene, t, end, error } => {
                write!(f, "`{scene}` ends at the time {t}, before {end}: {error}")
            }
        }
    }
}

impl core::error::Error for PriceError {}

impl From<InputError> for PriceError {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl From<PathError> for PriceError {
    fn from(error: PathError) -> Self {
        match error {
            PathError::Input(error) => Self::Input(error),
            error => Self::Path(error),
        }
    }
}
