//! The numbers of one given column.

use std::f64::consts::TAU;

use linkage_runtime::{Real, real};

use crate::Distribution;
use crate::random::{Quasi, Random, Stream};

/// The numbers of one given column as a function of the row.
#[derive(Debug, Clone)]
pub enum Source<T> {
    /// One number for all rows.
    Constant(T),
    /// Numbers of a factor of the plan.
    Factor(Numbers),
}

/// The numbers of one column of a factor.
#[derive(Debug, Clone)]
pub struct Numbers {
    /// The numbers of one period.
    pub series: Series,
    /// The length of a period.
    pub count: u64,
    /// The number of consecutive rows with the same number.
    pub stride: u64,
}

/// A number for each index.
#[derive(Debug, Clone)]
pub enum Series {
    /// Equidistant, both ends included.
    Grid { from: f64, to: f64 },
    /// Equidistant angles over one turn.
    Turn,
    /// Random numbers.
    Random(Distribution, Stream),
    /// Quasi-random numbers.
    Quasi(Distribution, Quasi),
}

impl<T: Real> Source<T> {
    /// Writes the numbers of the rows from `first` on.
    pub fn fill(&self, first: u64, rows: &mut [T]) {
        match self {
            Self::Constant(value) => rows.fill(*value),
            Self::Factor(numbers) => numbers.fill(first, rows),
        }
    }
}

impl Numbers {
    fn fill<T: Real>(&self, first: u64, rows: &mut [T]) {
        let count = self.count;
        match self.series {
            Series::Grid { from, to } => self.runs(first, rows, |index| match index + 1 == count && index > 0 {
                true => to,
                false => from + (to - from) * (index as f64 / (count - 1).max(1) as f64),
            }),
            Series::Turn => self.runs(first, rows, |index| TAU * (index as f64 / count as f64)),
            Series::Random(distribution, stream) => {
                let mut random = Random::new(stream);
                self.runs(first, rows, |index| distribution.value(random.bits(index)));
            }
            Series::Quasi(distribution, quasi) => {
                self.runs(first, rows, |index| distribution.value(quasi.bits(index)));
            }
        }
    }

    /// Writes each number to its run of rows.
    fn runs<T: Real>(&self, first: u64, mut rows: &mut [T], mut value: impl FnMut(u64) -> f64) {
        let mut index = first / self.stride % self.count;
        let mut rest = self.stride - first % self.stride;
        while !rows.is_empty() {
            let length = usize::try_from(rest).map_or(rows.len(), |rest| rest.min(rows.len()));
            let (run, others) = rows.split_at_mut(length);
            run.fill(real(value(index)));
            rows = others;
            rest = self.stride;
            index = if index + 1 == self.count { 0 } else { index + 1 };
        }
    }
}
