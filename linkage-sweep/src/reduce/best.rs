//! The best cases.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::fmt;

use linkage_runtime::lanes::Lanes;

use super::Reducer;
use crate::count::positive;
use crate::{Block, Case, Column, Place, SweepError};

/// Keeps the cases with the largest scores. The score of a case is computed from the columns asked for, in which a number
/// that does not exist is NaN: see [`Case::numbers`] and [`Case::is_complete`]. A case without a score, or with NaN, is not
/// ranked.
pub struct Best<F, const N: usize> {
    count: usize,
    columns: [Column; N],
    score: F,
}

/// A case and its score.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ranked {
    /// The score.
    pub score: f64,
    /// The number of the case.
    pub case: u64,
    /// The number of its first row.
    pub first_row: u64,
}

impl<F, const N: usize> Best<F, N> {
    /// The `count` cases with the largest scores, the largest first; of equal scores the first case.
    /// [`Sweep::with_case`](crate::Sweep::with_case) sets the rows of a case.
    pub fn new<T>(count: usize, columns: [Column; N], score: F) -> Self
    where
        F: Fn(&Case<'_, T, N>) -> Option<f64>,
    {
        Self { count, columns, score }
    }
}

impl<F, const N: usize> fmt::Debug for Best<F, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Best").field("count", &self.count).field("columns", &self.columns).finish_non_exhaustive()
    }
}

impl Eq for Ranked {}

impl Ord for Ranked {
    /// The better of two cases is the larger one.
    fn cmp(&self, other: &Self) -> Ordering {
        self.score.total_cmp(&other.score).then_with(|| other.case.cmp(&self.case))
    }
}

impl PartialOrd for Ranked {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The best cases so far.
#[derive(Debug)]
pub struct Leaders<const N: usize> {
    places: [Place; N],
    /// The worst case is on top.
    cases: BinaryHeap<Reverse<Ranked>>,
}

impl<const N: usize> Leaders<N> {
    fn add(&mut self, ranked: Ranked, count: usize) {
        if self.cases.len() < count {
            self.cases.push(Reverse(ranked));
        } else if let Some(mut worst) = self.cases.peek_mut()
            && ranked > worst.0
        {
            *worst = Reverse(ranked);
        }
    }
}

impl<M: Lanes, F, const N: usize> Reducer<M> for Best<F, N>
where
    F: Fn(&Case<'_, M::Scalar, N>) -> Option<f64> + Sync,
{
    type Part = Leaders<N>;
    type Output = Vec<Ranked>;

    fn columns(&self) -> Vec<Column> {
        self.columns.to_vec()
    }

    fn start(&self) -> Result<Self::Part, SweepError> {
        positive(self.count, "best cases")?;
        let mut places = [Place::Given(0); N];
        for (place, column) in places.iter_mut().zip(&self.columns) {
            *place = column.place::<M>()?;
        }
        Ok(Leaders { places, cases: BinaryHeap::new() })
    }

    fn fold(&self, part: &mut Self::Part, block: &Block<'_, M>) {
        for case in block.cases(part.places) {
            let score = (self.score)(&case).filter(|score| !score.is_nan());
            if let Some(score) = score {
                // Adding zero gives both zeros the same sign, so that they are equal.
                part.add(Ranked { score: score + 0.0, case: case.number, first_row: case.first_row }, self.count);
            }
        }
    }

    fn merge(&self, part: &mut Self::Part, other: Self::Part) {
        other.cases.into_iter().for_each(|Reverse(ranked)| part.add(ranked, self.count));
    }

    fn finish(&self, part: Self::Part) -> Self::Output {
        // The reversed order is from the best to the worst.
        part.cases.into_sorted_vec().into_iter().map(|Reverse(ranked)| ranked).collect()
    }
}
