//! The error of invalid input.

use core::fmt;

/// An invalid number or setting. Measures are nondimensional or in the unit of the number given.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum InputError<N = &'static str> {
    /// A number outside the range that it may have.
    OutOfRange {
        /// The mechanism, scene or stop that the number belongs to, if any.
        of: Option<N>,
        /// The name of the number.
        quantity: N,
        /// Its value.
        value: f64,
        /// The least valid value.
        least: f64,
        /// The largest valid value.
        most: f64,
    },
    /// A stop whose lower limit is not less than its upper limit.
    EmptyRange {
        /// The scene.
        scene: N,
        /// The stop.
        stop: N,
        /// The lower limit.
        lower: f64,
        /// The upper limit.
        upper: f64,
    },
    /// A range of a coordinate or an output whose ends are not numbers, or whose first end is not less than its second.
    EmptyJointRange {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The coordinate or the output.
        of: N,
        /// The least value, minus infinity without one.
        least: f64,
        /// The largest value, infinity without one.
        most: f64,
    },
    /// The mechanism does not return to its start after one turn of the input.
    NotPeriodic {
        /// The mechanism, or the driver of one.
        mechanism: N,
    },
    /// The start of a motion disagrees with the drive of an input.
    Inconsistent {
        /// The scene.
        scene: N,
        /// The driven input.
        coordinate: N,
        /// The position or the rate of the input.
        quantity: N,
        /// The difference.
        gap: f64,
    },
    /// A motion starts beyond a stop.
    BeyondStop {
        /// The scene.
        scene: N,
        /// The stop.
        stop: N,
        /// The distance beyond the stop, in the unit of the stopped quantity.
        gap: f64,
    },
    /// A column of a batch has another number of lanes than the others.
    ColumnLength {
        /// The mechanism.
        mechanism: N,
        /// The column.
        column: N,
        /// Its length.
        length: usize,
        /// The number of lanes.
        expected: usize,
    },
}

impl<N> InputError<N> {
    /// This error with other names: borrowed ones become owned.
    pub fn map_names<M>(self, mut f: impl FnMut(N) -> M) -> InputError<M> {
        match self {
            Self::OutOfRange { of, quantity, value, least, most } => {
                InputError::OutOfRange { of: of.map(&mut f), quantity: f(quantity), value, least, most }
            }
            Self::EmptyRange { scene, stop, lower, upper } => {
                InputError::EmptyRange { scene: f(scene), stop: f(stop), lower, upper }
            }
            Self::EmptyJointRange { mechanism, of, least, most } => {
                InputError::EmptyJointRange { mechanism: f(mechanism), of: f(of), least, most }
            }
            Self::NotPeriodic { mechanism } => InputError::NotPeriodic { mechanism: f(mechanism) },
            Self::Inconsistent { scene, coordinate, quantity, gap } => {
                InputError::Inconsistent { scene: f(scene), coordinate: f(coordinate), quantity: f(quantity), gap }
            }
            Self::BeyondStop { scene, stop, gap } => InputError::BeyondStop { scene: f(scene), stop: f(stop), gap },
            Self::ColumnLength { mechanism, column, length, expected } => {
                InputError::ColumnLength { mechanism: f(mechanism), column: f(column), length, expected }
            }
        }
    }
}

impl<N: fmt::Display> fmt::Display for InputError<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { of, quantity, value, least, most } => {
                write!(f, "{quantity}")?;
                of.as_ref().map_or(Ok(()), |name| write!(f, " of {name}"))?;
                write!(f, " is {value:?}: it must be ")?;
                match (*least > f64::MIN, *most < f64::MAX) {
                    (true, true) => write!(f, "between {least:?} and {most:?}"),
                    (true, false) => write!(f, "at least {least:?}"),
                    (false, true) => write!(f, "at most {most:?}"),
                    (false, false) => write!(f, "a finite number"),
                }
            }
            Self::EmptyRange { scene, stop, lower, upper } => {
                write!(f, "the {stop} in {scene} is from {lower} to {upper}: the first must be less than the second")
            }
            Self::EmptyJointRange { mechanism, of, least, most } => {
                write!(
                    f,
                    "the range of {of} in {mechanism} is from {least:?} to {most:?}: the first must be less than the second"
                )
            }
            Self::NotPeriodic { mechanism } => {
                write!(f, "{mechanism} does not return to its start after one turn of the input")
            }
            Self::Inconsistent { scene, coordinate, quantity, gap } => {
                write!(f, "{scene} starts with a {quantity} of {coordinate} that differs by {gap:.1e} from its drive")
            }
            Self::BeyondStop { scene, stop, gap } => write!(f, "{scene} starts {gap:.1e} beyond the {stop}"),
            Self::ColumnLength { mechanism, column, length, expected } => {
                write!(f, "the column {column} of a batch of {mechanism} has {length} entries instead of {expected}")
            }
        }
    }
}

impl<N: fmt::Debug + fmt::Display> core::error::Error for InputError<N> {}
