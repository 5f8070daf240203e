//! The reasons why a motion goes no further. The page has their words, one table for each language.

use linkage_interpreter::Words;
use linkage_runtime::singularity::{self, GroupMeasure};
use linkage_runtime::{Group, Mechanism as _, PathError, RangeEnd};
use serde::Serialize;

use crate::at::{Coordinates, Moving};

/// The regularity up to which a group counts as singular: at an end of a motion, whose input has half of its digits as errors of
/// the unknowns.
const SINGULAR: f64 = 1e-6;

/// The limit of a motion.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum Limit {
    /// A group locks.
    DeadPoint { group: String },
    /// Motions cross where a group is singular.
    ChangePoint { group: String },
    /// It begins at a dead point or at a change point.
    NoDirection,
    /// A coordinate or an output has the least value of its range.
    Least { of: String },
    /// A coordinate or an output has the largest value of its range.
    Largest { of: String },
    /// Other positions are too near to know which one goes on.
    TooNear,
    /// The loops do not close at its start.
    NoPosition,
    /// It takes more than this number of steps.
    TooLong { steps: usize },
    /// Another error, in the words of the library.
    Error { why: String },
}

/// A limit at which a motion stopped.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Stop {
    /// The place of the input that moved; none if it was a motion to other values of parameters.
    pub input: Option<usize>,
    /// The limit.
    #[serde(flatten)]
    pub limit: Limit,
}

impl Limit {
    pub fn range(of: &str, end: RangeEnd) -> Self {
        let of = of.to_owned();
        if end == RangeEnd::Least { Self::Least { of } } else { Self::Largest { of } }
    }

    /// The limit at this position, with names as they are written. Several groups that are singular at once are a change point of
    /// all: rounding errors decide which of them is met first, and at the mirrored end it may be another.
    pub fn at(self, mechanism: &Moving<'_>, q: &Coordinates) -> Self {
        let (Self::DeadPoint { group: met } | Self::ChangePoint { group: met }) = &self else { return self };
        let Ok(found) = singularity::report(mechanism, &mechanism.pose_at(q)) else { return self };
        let written = |group: Group<'_, &str>| {
            group.unknowns.iter().map(|&place| mechanism.unknown_name(place)).collect::<Vec<_>>().join(", ")
        };
        let is_singular = |measure: &GroupMeasure<f64, &str>| measure.regularity <= SINGULAR;
        let singular = mechanism.groups().zip(found.groups()).filter(|(_, measure)| is_singular(measure));
        let group = match singular.map(|(group, _)| written(group)).collect::<Vec<_>>().as_slice() {
            [others @ .., last] if !others.is_empty() => {
                return Self::ChangePoint { group: format!("{} and {last}", others.join("; ")) };
            }
            _ => mechanism.groups().find(|group| group.name == met).map(written),
        };
        match (self, group) {
            (Self::DeadPoint { .. }, Some(group)) => Self::DeadPoint { group },
            (Self::ChangePoint { .. }, Some(group)) => Self::ChangePoint { group },
            (limit, _) => limit,
        }
    }
}

impl From<&PathError<&str>> for Limit {
    fn from(error: &PathError<&str>) -> Self {
        match *error {
            PathError::DeadPoint { group, .. } => Self::DeadPoint { group: group.to_owned() },
            PathError::ChangePoint { group, .. } => Self::ChangePoint { group: group.to_owned() },
            PathError::JointRange { of, end, .. } => Self::range(of, end),
            PathError::NoDirection { .. } => Self::NoDirection,
            PathError::TooManySteps { steps, .. } => Self::TooLong { steps },
            _ => Self::Error { why: Words::new(&|_| false).path(error) },
        }
    }
}
