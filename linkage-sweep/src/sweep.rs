//! Sweeps: a plan for a mechanism, divided into chunks.

use std::marker::PhantomData;

use linkage_runtime::lanes::{Batch, Lanes, Values};
use linkage_runtime::{Dim, PositionError, real};

use crate::bind::{Bound, bind};
use crate::chunk::Chunk;
use crate::column::places;
use crate::count::positive;
use crate::source::Source;
use crate::{Column, Plan, SweepError};

/// Half of a small second-level cache of present processors: the other half is for all else that a thread touches.
const BYTES: usize = 1 << 18;
/// Default chunks have whole vectors of this many rows.
const ROWS: usize = 16;

/// All positions of a plan, in chunks.
#[derive(Debug, Clone)]
pub struct Sweep<M: Lanes> {
    plan: Plan,
    bound: Bound<M::Scalar>,
    branch: M::Branch,
    case_factors: usize,
    rows_per_chunk: Option<usize>,
    pub(crate) threads: Option<usize>,
    mechanism: PhantomData<fn() -> M>,
}

impl<M: Lanes> Sweep<M> {
    /// A sweep of a mechanism on one assembly branch. Columns that the plan does not name are those of the design
    /// `base`.
    ///
    /// # Errors
    /// The plan is checked: [`SweepError::EmptyPlan`], [`EmptySample`](SweepError::EmptySample),
    /// [`Zero`](SweepError::Zero), [`TooManyRows`](SweepError::TooManyRows), [`Twice`](SweepError::Twice),
    /// [`UnknownColumn`](SweepError::UnknownColumn), [`MissingInput`](SweepError::MissingInput),
    /// [`NotFinite`](SweepError::NotFinite), [`NegativeDeviation`](SweepError::NegativeDeviation).
    pub fn new(base: &M, branch: M::Branch, plan: Plan) -> Result<Self, SweepError> {
        let bound = bind(base, &plan)?;
        let mechanism = PhantomData;
        Ok(Self { plan, bound, branch, case_factors: 0, rows_per_chunk: None, threads: None, mechanism })
    }

    /// Makes the rows of the last `factors` of the plan one case: for example all positions of one design. Otherwise
    /// each row is a case. A chunk has whole cases, so that a case has to fit into memory.
    ///
    /// # Errors
    /// [`SweepError::TooManyFactors`].
    pub fn with_case(mut self, factors: usize) -> Result<Self, SweepError> {
        let most = self.plan.factors.len();
        if factors > most {
            return Err(SweepError::TooManyFactors { factors, most });
        }
        self.case_factors = factors;
        Ok(self)
    }

    /// Sets the rows per chunk, which are rounded up to whole cases. Otherwise a chunk with all columns takes 256 KiB,
    /// so that it stays in the second-level cache of a core while it is computed and reduced: larger chunks wait for
    /// memory, and smaller ones take more calls.
    ///
    /// # Errors
    /// [`SweepError::Zero`].
    pub fn with_rows_per_chunk(mut self, rows: usize) -> Result<Self, SweepError> {
        self.rows_per_chunk = Some(positive(rows, "rows per chunk")?);
        Ok(self)
    }

    /// Sets the number of threads. Otherwise a sweep runs on rayon's current pool, which has a thread for each core. There
    /// are at most as many threads as chunks, and at most eight for each core: more have nothing to do and take memory.
    ///
    /// # Errors
    /// [`SweepError::Zero`].
    pub fn with_threads(mut self, threads: usize) -> Result<Self, SweepError> {
        self.threads = Some(positive(threads, "threads")?);
        Ok(self)
    }

    pub(crate) fn branch(&self) -> M::Branch {
        self.branch
    }

    /// The plan.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.bound.rows
    }

    /// The number of rows of a case.
    #[must_use]
    pub fn rows_per_case(&self) -> u64 {
        self.bound.strides.get(self.case_factors).copied().unwrap_or(1)
    }

    /// The number of rows of each chunk but the last, which may have fewer.
    #[must_use]
    pub fn rows_per_chunk(&self) -> u64 {
        let row = (M::GIVEN.len() + M::FOUND.len()) * size_of::<M::Scalar>() + 1;
        let rows = self.rows_per_chunk.unwrap_or_else(|| (BYTES / row / ROWS).max(1) * ROWS);
        let case = self.rows_per_case();
        let cases = (rows as u64).div_ceil(case);
        cases.checked_mul(case).map_or(self.rows(), |rows| rows.min(self.rows()))
    }

    /// The number of chunks.
    #[must_use]
    pub fn chunks(&self) -> u64 {
        self.rows().div_ceil(self.rows_per_chunk())
    }

    /// The given numbers of a row by name.
    ///
    /// # Errors
    /// [`SweepError::OutOfRange`].
    pub fn row(&self, number: u64) -> Result<Vec<(&'static str, M::Scalar)>, SweepError> {
        let numbers = self.numbers(number)?;
        Ok(M::GIVEN.iter().copied().zip(numbers).collect())
    }

    /// The reason why a row is rejected, or `None` if it is accepted: if its position, its rates and its accelerations exist.
    /// Points and outputs that do not exist are no reason.
    ///
    /// # Errors
    /// [`SweepError::OutOfRange`].
    pub fn rejection(&self, number: u64) -> Result<Option<PositionError>, SweepError> {
        let numbers = self.numbers(number)?;
        Ok(self.reason(|column| numbers.get(column).copied()))
    }

    /// Computes a chunk: these columns and the mask of accepted rows. A column and the mask depend on the sweep and the
    /// number of the chunk only, not on the other columns.
    ///
    /// # Errors
    /// [`SweepError::OutOfRange`], [`UnknownColumn`](SweepError::UnknownColumn),
    /// [`UnknownIndex`](SweepError::UnknownIndex), [`Twice`](SweepError::Twice), [`Memory`](SweepError::Memory).
    pub fn chunk(&self, number: u64, columns: &[Column]) -> Result<Chunk<M>, SweepError> {
        let mut chunk = Chunk::new(&places::<M>(columns)?);
        self.compute(number, &mut chunk)?;
        Ok(chunk)
    }

    /// Computes another chunk with the columns of this one, and uses its memory again.
    ///
    /// # Errors
    /// [`SweepError::OutOfRange`] and [`Memory`](SweepError::Memory).
    pub fn compute(&self, number: u64, chunk: &mut Chunk<M>) -> Result<(), SweepError> {
        let rows_per_chunk = self.rows_per_chunk();
        let chunks = self.chunks();
        if number >= chunks {
            return Err(SweepError::OutOfRange { quantity: "chunk", number, count: chunks });
        }
        // Less than the number of rows, as the chunk exists.
        let first = number * rows_per_chunk;
        let rows = rows_per_chunk.min(self.rows() - first);
        let rows = usize::try_from(rows).map_err(|_| SweepError::Memory { entries: usize::MAX })?;
        chunk.fill(&self.bound.sources, self.branch, number, first, rows)
    }

    /// Writes the numbers of a given column, by its index in [`Lanes::GIVEN`], in consecutive rows. No position is
    /// computed.
    ///
    /// # Errors
    /// [`SweepError::UnknownIndex`] and [`OutOfRange`](SweepError::OutOfRange).
    pub fn given_numbers(&self, index: usize, first_row: u64, numbers: &mut [M::Scalar]) -> Result<(), SweepError> {
        let source = self.bound.sources.get(index).ok_or(SweepError::UnknownIndex {
            mechanism: M::NAME,
            kind: "given",
            index,
            count: M::GIVEN.len(),
        })?;
        let end = first_row.saturating_add(numbers.len() as u64);
        if end > self.rows() {
            return Err(SweepError::OutOfRange { quantity: "row", number: end - 1, count: self.rows() });
        }
        source.fill(first_row, numbers);
        Ok(())
    }

    /// The reason why a row with these given numbers is rejected; those of constant columns may be missing.
    pub(crate) fn reason(&self, number: impl Fn(usize) -> Option<M::Scalar>) -> Option<PositionError> {
        let given = M::Given::default().array(|column| match self.bound.sources.get(column) {
            Some(Source::Constant(value)) => Values::Same(*value),
            _ => Values::Same(number(column).unwrap_or_else(|| real(f64::NAN))),
        });
        match Batch::<M>::new(given, self.branch) {
            Ok(batch) => batch.lane_of_coordinates(0).err(),
            Err(error) => Some(error.into()),
        }
    }

    /// The given numbers of a row.
    pub(crate) fn numbers(&self, number: u64) -> Result<Vec<M::Scalar>, SweepError> {
        if number >= self.rows() {
            return Err(SweepError::OutOfRange { quantity: "row", number, count: self.rows() });
        }
        let value = |source: &Source<M::Scalar>| {
            let mut value = [real(0.0)];
            source.fill(number, &mut value);
            value[0]
        };
        Ok(self.bound.sources.iter().map(value).collect())
    }
}
