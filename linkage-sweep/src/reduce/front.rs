//! The Pareto front of several scores.

use std::cmp::Ordering;
use std::fmt;

use linkage_runtime::lanes::Lanes;

use super::Reducer;
use crate::{Block, Case, Column, Place, SweepError};

/// Keeps the cases that no other case beats: the Pareto front. A case beats another if none of its scores is less and
/// one is larger; of equal cases the first remains. The scores of a case are computed from the columns asked for; a
/// case without scores, or with NaN, is not ranked.
///
/// Its memory grows with the front, and its time with that of each thread. A front of two scores usually has tens or
/// hundreds of cases, but one of many scores may have most of them.
pub struct Front<F, const N: usize, const K: usize> {
    columns: [Column; N],
    scores: F,
}

/// A case that no other beats, and its scores.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unbeaten<const K: usize> {
    /// The scores.
    #[cfg_attr(feature = "serde", serde(with = "linkage_runtime::__shared::array"))]
    pub scores: [f64; K],
    /// The number of the case.
    pub case: u64,
    /// The number of its first row.
    pub first_row: u64,
}

impl<F, const N: usize, const K: usize> Front<F, N, K> {
    /// The front of the cases with the largest scores, sorted by the first score, the largest first.
    /// [`Sweep::with_case`](crate::Sweep::with_case) sets the rows of a case.
    pub fn new<T>(columns: [Column; N], scores: F) -> Self
    where
        F: Fn(&Case<'_, T, N>) -> Option<[f64; K]>,
    {
        Self { columns, scores }
    }
}

impl<F, const N: usize, const K: usize> fmt::Debug for Front<F, N, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Front").field("columns", &self.columns).finish_non_exhaustive()
    }
}

impl<const K: usize> Unbeaten<K> {
    fn beats(&self, other: &Self) -> bool {
        self.scores.iter().zip(&other.scores).all(|(own, other)| own >= other)
            && (self.scores != other.scores || self.case < other.case)
    }
}

/// The front so far.
#[derive(Debug)]
pub struct Candidates<const N: usize, const K: usize> {
    places: [Place; N],
    cases: Vec<Unbeaten<K>>,
}

impl<const N: usize, const K: usize> Candidates<N, K> {
    fn add(&mut self, new: Unbeaten<K>) {
        if !self.cases.iter().any(|case| case.beats(&new)) {
            self.cases.retain(|case| !new.beats(case));
            self.cases.push(new);
        }
    }
}

impl<M: Lanes, F, const N: usize, const K: usize> Reducer<M> for Front<F, N, K>
where
    F: Fn(&Case<'_, M::Scalar, N>) -> Option<[f64; K]> + Sync,
{
    type Part = Candidates<N, K>;
    type Output = Vec<Unbeaten<K>>;

    fn columns(&self) -> Vec<Column> {
        self.columns.to_vec()
    }

    fn start(&self) -> Result<Self::Part, SweepError> {
        let mut places = [Place::Given(0); N];
        for (place, column) in places.iter_mut().zip(&self.columns) {
            *place = column.place::<M>()?;
        }
        Ok(Candidates { places, cases: Vec::new() })
    }

    fn fold(&self, part: &mut Self::Part, block: &Block<'_, M>) {
        for case in block.cases(part.places) {
            let scores = (self.scores)(&case).filter(|scores| !scores.iter().any(|score| score.is_nan()));
            if let Some(scores) = scores {
                // Adding zero gives both zeros the same sign, so that equal scores have the same bits.
                let scores = scores.map(|score| score + 0.0);
                part.add(Unbeaten { scores, case: case.number, first_row: case.first_row });
            }
        }
    }

    fn merge(&self, part: &mut Self::Part, other: Self::Part) {
        other.cases.into_iter().for_each(|case| part.add(case));
    }

    fn finish(&self, mut part: Self::Part) -> Self::Output {
        // Two cases of a front differ in a score.
        let by_scores = |a: &Unbeaten<K>, b: &Unbeaten<K>| {
            let pairs = b.scores.iter().zip(&a.scores);
            pairs.map(|(b, a)| b.total_cmp(a)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
        };
        part.cases.sort_unstable_by(by_scores);
        part.cases
    }
}
