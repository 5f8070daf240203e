//! The reasons why a design is not ready for algorithms.

use std::fmt::{self, Display, Formatter};

use crate::error::Mistake;

/// The reason why algorithms cannot take a mechanism at run time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NotPrepared {
    /// A user function is not given.
    Mistake(Mistake),
    /// The mechanism has more of something than a mechanism at run time can have.
    TooLarge {
        /// The name of the quantity, in the plural.
        of: &'static str,
        /// The number.
        count: usize,
        /// The most.
        most: usize,
    },
    /// The mechanism has another number of inputs than an algorithm takes.
    Inputs {
        /// The inputs of the mechanism.
        count: usize,
    },
    /// The mechanism has no formulas over intervals: its text has no `derive intervals;`.
    NoFormulas {
        /// The mechanism, or the driver of one.
        mechanism: String,
    },
    /// The scene has no `inertia`: nothing of it moves by itself.
    NoInertia {
        /// The scene.
        scene: String,
    },
    /// The compiled code is damaged.
    Defect(crate::Defect),
}

impl Display for NotPrepared {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mistake(error) => error.fmt(f),
            Self::TooLarge { of, count, most } => write!(
                f,
                "there are {count} {of}, more than the {most} that a mechanism at run time can have: use `linkage!`"
            ),
            Self::Inputs { count } => {
                write!(f, "the mechanism has {count} inputs, which this computation does not take")
            }
            Self::NoFormulas { mechanism } => {
                write!(f, "`{mechanism}` has no formulas over intervals: add `derive intervals;` to its mechanism")
            }
            Self::NoInertia { scene } => write!(f, "`{scene}` has no `inertia`: nothing of it moves by itself"),
            Self::Defect(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for NotPrepared {}

impl From<Mistake> for NotPrepared {
    fn from(mistake: Mistake) -> Self {
        Self::Mistake(mistake)
    }
}
