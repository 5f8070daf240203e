//! Chunks: consecutive rows of a sweep as columns.

use linkage_runtime::lanes::{Batch, Lanes, Values};
use linkage_runtime::nalgebra::ComplexField;
use linkage_runtime::{Dim, real};

use crate::source::Source;
use crate::{Place, SweepError};

/// Consecutive rows of a sweep: the columns asked for, each as a slice, and the mask of accepted rows.
///
/// A row is accepted if its position, its rates and its accelerations exist, with any columns asked for. A point or an
/// output that does not exist in an accepted row is missing in its own column, which has a [mask](Self::mask) of its own.
#[derive(Debug)]
pub struct Chunk<M: Lanes> {
    number: u64,
    first_row: u64,
    /// The columns asked for, in this order.
    places: Vec<Place>,
    /// The given columns; empty if not needed.
    given: Vec<Vec<M::Scalar>>,
    /// The found columns; empty if not asked for.
    found: Vec<Vec<M::Scalar>>,
    accepted: Vec<bool>,
    rejected: usize,
    /// An empty vector, whose memory is used again.
    slices: Slices<'static, M::Scalar>,
}

/// Found columns to write to.
type Slices<'a, T> = Vec<Option<&'a mut [T]>>;

impl<M: Lanes> Chunk<M> {
    /// An empty chunk with these columns.
    pub(crate) fn new(places: &[Place]) -> Self {
        Self {
            number: 0,
            first_row: 0,
            places: places.to_vec(),
            given: vec![Vec::new(); M::GIVEN.len()],
            found: vec![Vec::new(); M::FOUND.len()],
            accepted: Vec::new(),
            rejected: 0,
            slices: Vec::new(),
        }
    }

    /// The number of the chunk.
    #[must_use]
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The number of its first row in the sweep.
    #[must_use]
    pub fn first_row(&self) -> u64 {
        self.first_row
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.accepted.len()
    }

    /// False for each row without a position, rates and accelerations; its found columns are NaN.
    #[must_use]
    pub fn accepted(&self) -> &[bool] {
        &self.accepted
    }

    /// The number of rejected rows.
    #[must_use]
    pub fn rejected(&self) -> usize {
        self.rejected
    }

    /// The columns asked for, in this order, with their names.
    pub fn columns(&self) -> impl Iterator<Item = (Place, &'static str, &[M::Scalar])> {
        self.places.iter().map(|&place| (place, place.name::<M>(), self.at(place)))
    }

    /// A column, or `None` if it was not asked for. A found number that does not exist is NaN.
    #[must_use]
    pub fn column(&self, place: Place) -> Option<&[M::Scalar]> {
        self.places.contains(&place).then(|| self.at(place))
    }

    /// The mask of a column, or `None` if it was not asked for: false for each row in which the number does not exist. A
    /// given number exists in all rows, a found one at most in the accepted ones.
    pub fn mask(&self, place: Place) -> Option<impl Iterator<Item = bool>> {
        self.column(place).map(|values| values.iter().map(ComplexField::is_finite))
    }

    /// A column; empty if it was not computed.
    pub(crate) fn at(&self, place: Place) -> &[M::Scalar] {
        let column = match place {
            Place::Given(index) => self.given.get(index),
            Place::Found(index) => self.found.get(index),
        };
        column.map_or(&[], Vec::as_slice)
    }

    /// Computes rows.
    pub(crate) fn fill(
        &mut self,
        sources: &[Source<M::Scalar>],
        branch: M::Branch,
        number: u64,
        first_row: u64,
        rows: usize,
    ) -> Result<(), SweepError> {
        (self.number, self.first_row) = (number, first_row);
        resize(&mut self.accepted, false, rows)?;
        for (column, (values, source)) in self.given.iter_mut().zip(sources).enumerate() {
            if matches!(source, Source::Factor(_)) || self.places.contains(&Place::Given(column)) {
                resize(values, real(0.0), rows)?;
                source.fill(first_row, values);
            }
        }
        for place in &self.places {
            if let Place::Found(column) = place
                && let Some(values) = self.found.get_mut(*column)
            {
                resize(values, real(0.0), rows)?;
            }
        }
        let given = M::Given::default().array(|column| match (sources.get(column), self.given.get(column)) {
            (Some(Source::Constant(value)), _) => Values::Same(*value),
            (_, values) => Values::Each(values.map_or(&[], Vec::as_slice)),
        });
        let mut slices: Slices<'_, M::Scalar> = emptied(std::mem::take(&mut self.slices));
        slices.extend(self.found.iter_mut().map(|values| (!values.is_empty()).then_some(values.as_mut_slice())));
        let rejected = Batch::<M>::new(given, branch).and_then(|batch| batch.run(&mut slices, &mut self.accepted));
        self.slices = emptied(slices);
        self.rejected = rejected?;
        Ok(())
    }
}

/// The vector without entries, with the same memory as long as the standard library collects in place.
fn emptied<'a, T>(mut slices: Slices<'_, T>) -> Slices<'a, T> {
    slices.clear();
    slices.into_iter().map(|_| None).collect()
}

/// Changes the number of entries, or returns an error if there is no memory for them.
fn resize<T: Clone>(values: &mut Vec<T>, value: T, entries: usize) -> Result<(), SweepError> {
    let more = entries.saturating_sub(values.len());
    values.try_reserve_exact(more).map_err(|_| SweepError::Memory { entries })?;
    values.resize(entries, value);
    Ok(())
}
