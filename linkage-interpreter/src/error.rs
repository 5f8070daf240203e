//! Errors of running code.

use std::fmt::{self, Display, Formatter};
use std::sync::Arc;

use linkage_dynamics::MotionError;
use linkage_runtime::PositionError;

/// The error of a function of a mechanism or a scene: that of the emitted function, with names of its own.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// The error of a function of a mechanism.
    Position(PositionError<Arc<str>>),
    /// The error of a function of a scene.
    Motion(MotionError<Arc<str>>),
    /// More of something than a mechanism at run time can have.
    TooLarge {
        /// The name of the quantity, in the plural.
        of: &'static str,
        /// The number.
        count: usize,
        /// The most.
        most: usize,
    },
}

impl Error {
    /// The error as the `?` of a function of a scene converts it.
    pub(crate) fn of_scene(self) -> Self {
        match self {
            Self::Position(error) => Self::Motion(error.into()),
            other => other,
        }
    }
}

impl Display for Error {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position(error) => error.fmt(f),
            Self::Motion(error) => error.fmt(f),
            Self::TooLarge { of, count, most } => write!(
                f,
                "there are {count} {of}, more than the {most} that a mechanism at run time can have: use `linkage!`"
            ),
        }
    }
}

impl std::error::Error for Error {}

impl From<PositionError<&str>> for Error {
    fn from(error: PositionError<&str>) -> Self {
        Self::Position(error.map_names(Arc::from))
    }
}

impl From<MotionError<&str>> for Error {
    fn from(error: MotionError<&str>) -> Self {
        Self::Motion(error.map_names(Arc::from))
    }
}

/// A mistake of a caller: a name that does not exist, a value of another form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake(String);

impl Mistake {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }

    pub(crate) fn expected(what: &str, found: &crate::Data) -> Self {
        Self(format!("expected {what}, found {found:?}"))
    }

    pub(crate) fn missing(name: &str) -> Self {
        Self(format!("`{name}` is not given"))
    }

    /// A name that is none of these: the nearest, or all if none is near.
    pub(crate) fn unknown<'n>(name: &str, all: impl IntoIterator<Item = &'n str>) -> Self {
        let all: Vec<&str> = all.into_iter().collect();
        let near = all.iter().map(|other| (strsim::osa_distance(&name.to_lowercase(), &other.to_lowercase()), other));
        // Half of the letters may differ, at most three.
        let most = (name.chars().count() / 2).min(3);
        let nearest = near.filter(|(distance, _)| *distance <= most).min_by_key(|(distance, _)| *distance);
        Self(match (nearest, all.as_slice()) {
            (Some((_, nearest)), _) => format!("there is no `{name}`, did you mean `{nearest}`?"),
            (None, []) => format!("there is no `{name}`"),
            (None, all) => format!("there is no `{name}`, but `{}`", all.join("`, `")),
        })
    }
}

impl Display for Mistake {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Mistake {}
