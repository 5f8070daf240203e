//! Chunks as reducers see them: with cases and the reasons of rejected rows.

use linkage_runtime::lanes::Lanes;
use linkage_runtime::nalgebra::ComplexField;
use linkage_runtime::{PositionError, Real};

use crate::{Chunk, Place, Sweep};

/// A chunk of a sweep. It has the columns that the reducers asked for.
#[derive(Debug)]
pub struct Block<'a, M: Lanes> {
    sweep: &'a Sweep<M>,
    chunk: &'a Chunk<M>,
}

/// A case: consecutive rows, for example all positions of one design.
#[derive(Debug, Clone, Copy)]
pub struct Case<'a, T, const N: usize> {
    /// The number of the case.
    pub number: u64,
    /// The number of its first row.
    pub first_row: u64,
    /// Its columns, in the order asked for.
    pub columns: [&'a [T]; N],
    /// False for each row without a position, rates and accelerations; its found columns are NaN. In the other rows a
    /// number is NaN if it does not exist, as the square root of a negative number.
    pub accepted: &'a [bool],
}

impl<T: Real, const N: usize> Case<'_, T, N> {
    /// The numbers of a column that exist, in the order of their rows; none if there is no such column.
    pub fn numbers(&self, column: usize) -> impl Iterator<Item = T> {
        let values = self.columns.get(column).copied().unwrap_or_default().iter().zip(self.accepted);
        values.filter(|(value, is_accepted)| **is_accepted && value.is_finite()).map(|(value, _)| *value)
    }

    /// True if all rows are accepted and all their numbers exist.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        let values = self.columns.iter().copied().flatten();
        self.accepted.iter().all(|is_accepted| *is_accepted) && values.into_iter().all(T::is_finite)
    }
}

impl<'a, M: Lanes> Block<'a, M> {
    /// The rows.
    #[must_use]
    pub fn chunk(&self) -> &'a Chunk<M> {
        self.chunk
    }

    /// The numbers of a column that exist in accepted rows, with these rows in the sweep; none if it was not asked for.
    pub fn accepted(&self, place: Place) -> impl Iterator<Item = (u64, M::Scalar)> + 'a {
        let values = self.chunk.column(place).unwrap_or_default().iter().zip(self.chunk.accepted());
        let rows = values.zip(self.chunk.first_row()..);
        // The found numbers of rejected rows are NaN too.
        let is_found = matches!(place, Place::Found(_));
        rows.filter_map(move |((value, is_accepted), row)| {
            let exists = if is_found { value.is_finite() } else { *is_accepted };
            exists.then_some((row, *value))
        })
    }

    /// The rejected rows in the sweep, with their reasons.
    pub fn rejected(&self) -> impl Iterator<Item = (u64, Option<PositionError>)> + 'a {
        let Self { sweep, chunk } = *self;
        let count = if chunk.rejected() == 0 { 0 } else { chunk.rows() };
        let rows = chunk.accepted().iter().take(count).zip(chunk.first_row()..).enumerate();
        rows.filter(|(_, (is_accepted, _))| !**is_accepted).map(move |(index, (_, row))| {
            (row, sweep.reason(|column| chunk.at(Place::Given(column)).get(index).copied()))
        })
    }

    /// The cases with these columns; a column that was not asked for is empty.
    pub fn cases<const N: usize>(&self, places: [Place; N]) -> impl Iterator<Item = Case<'a, M::Scalar, N>> + 'a {
        let chunk = self.chunk;
        let columns = places.map(|place| chunk.column(place).unwrap_or_default());
        // A chunk has whole cases, so that the rows of one are those of a slice.
        let rows = self.sweep.rows_per_case();
        let length = usize::try_from(rows).unwrap_or(usize::MAX);
        chunk.accepted().chunks(length).enumerate().map(move |(index, accepted)| {
            let first_row = chunk.first_row() + index as u64 * rows;
            let from = index * length;
            let columns = columns.map(|column| column.get(from..from + accepted.len()).unwrap_or_default());
            Case { number: first_row / rows, first_row, columns, accepted }
        })
    }
}

impl<M: Lanes> Sweep<M> {
    /// A chunk of this sweep with its cases, as reducers see it.
    #[must_use]
    pub fn block<'a>(&'a self, chunk: &'a Chunk<M>) -> Block<'a, M> {
        Block { sweep: self, chunk }
    }
}
