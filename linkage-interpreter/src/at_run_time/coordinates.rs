//! Coordinates, rates and accelerations as two columns.

use linkage_runtime::{Bounded, Build as _, Column, Dim};
use smallvec::SmallVec;

use super::{AllCoordinates, Count, MOST, MOST_INPUTS};

/// Coordinates of a mechanism at run time, or their rates or accelerations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoordinatesAtRunTime<V: Dim> {
    /// The dependent coordinates.
    pub unknowns: Column<f64, Count>,
    /// The inputs.
    pub inputs: Column<f64, V>,
}

/// The unknowns, then the inputs.
type List = Bounded<f64, { MOST + MOST_INPUTS }>;

impl<V: Dim> CoordinatesAtRunTime<V> {
    /// All numbers, the unknowns first.
    pub(crate) fn all(&self) -> SmallVec<[f64; MOST]> {
        self.unknowns.iter().chain(&self.inputs).copied().collect()
    }
}

impl<V: Dim> From<List> for CoordinatesAtRunTime<V> {
    fn from(list: List) -> Self {
        let all = list.as_ref();
        let (unknowns, inputs) = all.split_at(all.len().saturating_sub(V::least().count()));
        Self { unknowns: column(unknowns), inputs: column(inputs) }
    }
}

impl<V: Dim> From<CoordinatesAtRunTime<V>> for List {
    fn from(coordinates: CoordinatesAtRunTime<V>) -> Self {
        let all: Column<f64, AllCoordinates> = column(&coordinates.all());
        all.dim().array(|place| all[place])
    }
}

/// The column of these numbers; it has none of them if a column of this type cannot be as long, as after damaged code.
pub(crate) fn column<R: Dim>(numbers: &[f64]) -> Column<f64, R> {
    Column::from_slice(numbers).unwrap_or_else(|| R::least().repeat(f64::NAN))
}
