//! Plans: the rows of a sweep.

#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};

/// The rows of a sweep: the product of its factors, of which the last one varies fastest.
///
/// Columns are named as in [`Lanes::GIVEN`](linkage_runtime::lanes::Lanes::GIVEN). A parameter that the plan does not
/// name is that of the design; a rate or acceleration is 0; an input must be named.
///
/// ```
/// use linkage_sweep::{Distribution, Plan, Sequence};
///
/// // A full turn, in degrees, of each of a million cranks.
/// let columns = [
///     ("crank", Distribution::Normal { mean: 1.0, deviation: 0.01 }),
///     ("rod", Distribution::Uniform { from: 2.5, to: 3.5 }),
/// ];
/// let plan = Plan::new().sample(columns, 1_000_000, Sequence::QuasiRandom).turn("theta", 360);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub struct Plan {
    /// The factors, the slowest first.
    pub factors: Vec<Factor>,
    /// Columns with the same number in all rows.
    #[cfg_attr(feature = "serde", serde(default))]
    pub constants: Vec<(String, f64)>,
    /// The seed of samples.
    #[cfg_attr(feature = "serde", serde(default))]
    pub seed: u64,
}

/// One factor of the rows of a plan.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub enum Factor {
    /// Equidistant numbers, both ends included. A count of one is `from` alone.
    Grid {
        /// The column.
        column: String,
        /// The first number.
        from: f64,
        /// The last number.
        to: f64,
        /// The number of rows.
        count: u64,
    },
    /// Equidistant angles from 0 on, over one turn; its end, which equals its start, is excluded.
    Turn {
        /// The column, an angle.
        column: String,
        /// The number of rows.
        count: u64,
    },
    /// Points of several columns at once.
    Sample {
        /// The columns and their distributions.
        columns: Vec<(String, Distribution)>,
        /// The number of points.
        count: u64,
        /// The kind of points.
        sequence: Sequence,
    },
}

/// The distribution of a sampled column.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub enum Distribution {
    /// Each number between two ends is equally probable.
    Uniform {
        /// The first end.
        from: f64,
        /// The second end.
        to: f64,
    },
    /// The normal distribution.
    Normal {
        /// The mean.
        mean: f64,
        /// The standard deviation.
        deviation: f64,
    },
}

/// The kind of sampled points.
///
/// A number depends on the seed of the plan, the index of its column in
/// [`Lanes::GIVEN`](linkage_runtime::lanes::Lanes::GIVEN) and the number of the point only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub enum Sequence {
    /// Independent random numbers, by ChaCha with 8 rounds.
    #[default]
    Random,
    /// Points that fill the space more evenly: the additive recurrence R_d of M. Roberts ("The unreasonable
    /// effectiveness of quasirandom sequences", 2018), shifted by a random vector. It suits up to about ten columns.
    QuasiRandom,
}

impl Plan {
    /// A plan without factors.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a factor of equidistant numbers, both ends included.
    #[must_use]
    pub fn grid(self, column: impl Into<String>, from: f64, to: f64, count: u64) -> Self {
        self.with(Factor::Grid { column: column.into(), from, to, count })
    }

    /// Adds a factor of equidistant angles over one turn.
    #[must_use]
    pub fn turn(self, column: impl Into<String>, count: u64) -> Self {
        self.with(Factor::Turn { column: column.into(), count })
    }

    /// Adds a factor of sampled points.
    #[must_use]
    pub fn sample<N: Into<String>>(
        self,
        columns: impl IntoIterator<Item = (N, Distribution)>,
        count: u64,
        sequence: Sequence,
    ) -> Self {
        let columns = columns.into_iter().map(|(name, distribution)| (name.into(), distribution)).collect();
        self.with(Factor::Sample { columns, count, sequence })
    }

    /// Sets a column to the same number in all rows.
    #[must_use]
    pub fn constant(mut self, column: impl Into<String>, value: f64) -> Self {
        self.constants.push((column.into(), value));
        self
    }

    /// Sets the seed of samples, which is 0 otherwise.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Adds a factor, which varies faster than those before it.
    #[must_use]
    pub fn with(mut self, factor: Factor) -> Self {
        self.factors.push(factor);
        self
    }
}

impl Factor {
    /// The number of rows of this factor.
    #[must_use]
    pub fn count(&self) -> u64 {
        match self {
            Self::Grid { count, .. } | Self::Turn { count, .. } | Self::Sample { count, .. } => *count,
        }
    }

    /// The names of its columns.
    pub fn columns(&self) -> impl Iterator<Item = &str> {
        let (one, several) = match self {
            Self::Grid { column, .. } | Self::Turn { column, .. } => (Some(column.as_str()), &[][..]),
            Self::Sample { columns, .. } => (None, &columns[..]),
        };
        one.into_iter().chain(several.iter().map(|(name, _)| name.as_str()))
    }
}
