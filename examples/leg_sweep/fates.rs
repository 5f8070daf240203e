//! A reducer that counts the designs by their fate.

use std::collections::BTreeMap;
use std::fmt;

use linkage::lanes::Lanes;
use linkage_sweep::{Block, Column, Kind, Place, Reducer, SweepError};

use crate::gait::{Condition, Gait, columns};

/// The fate of a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fate {
    /// It fulfils the condition.
    Walks,
    /// It walks with too short a stride.
    ShortStride,
    /// Its foot rises into the circle of the crank.
    TooHigh,
    /// Its foot is on the ground more than once in a turn.
    TwoGroundPhases,
    /// It does not assemble over the whole turn; the error is that of the first such position.
    Rejected(Kind),
}

/// Counts the designs by their fate.
pub struct Fates(pub Condition);

/// The number of designs of each fate.
pub type Counts = BTreeMap<Fate, u64>;

impl fmt::Display for Fate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Walks => write!(f, "they walk"),
            Self::ShortStride => write!(f, "the stride is too short"),
            Self::TooHigh => write!(f, "the foot rises into the circle of the crank"),
            Self::TwoGroundPhases => write!(f, "the foot is on the ground more than once in a turn"),
            Self::Rejected(kind) => write!(f, "error in some position: {kind}"),
        }
    }
}

impl<M: Lanes<Scalar = f64>> Reducer<M> for Fates {
    type Part = ([Place; 2], Counts);
    type Output = Counts;

    fn columns(&self) -> Vec<Column> {
        columns().to_vec()
    }

    fn start(&self) -> Result<Self::Part, SweepError> {
        let [x, y] = columns();
        Ok(([x.place::<M>()?, y.place::<M>()?], Counts::new()))
    }

    fn fold(&self, (places, counts): &mut Self::Part, block: &Block<'_, M>) {
        let mut rejected = block.rejected().peekable();
        for case in block.cases(*places) {
            let end = case.first_row + case.accepted.len() as u64;
            let mut first = None;
            while let Some((_, error)) = rejected.next_if(|(row, _)| *row < end) {
                first.get_or_insert(error.map_or(Kind::Other, Kind::from));
            }
            let fate = match (first, Gait::of_case(&case)) {
                (Some(kind), _) => Fate::Rejected(kind),
                (None, None) => Fate::TwoGroundPhases,
                (None, Some(gait)) if gait.top >= self.0.top => Fate::TooHigh,
                (None, Some(gait)) if gait.stride < self.0.least_stride => Fate::ShortStride,
                (None, Some(_)) => Fate::Walks,
            };
            *counts.entry(fate).or_default() += 1;
        }
    }

    fn merge(&self, (_, counts): &mut Self::Part, (_, other): Self::Part) {
        other.into_iter().for_each(|(fate, count)| *counts.entry(fate).or_default() += count);
    }

    fn finish(&self, (_, counts): Self::Part) -> Self::Output {
        counts
    }
}
