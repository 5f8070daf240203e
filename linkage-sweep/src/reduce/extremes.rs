//! The least and the largest number of a column.

use linkage_runtime::lanes::Lanes;

use super::Reducer;
use crate::{Block, Column, Place, SweepError};

/// Finds the least and the largest number of a column in the accepted rows in which it exists.
#[derive(Debug, Clone)]
pub struct Extremes {
    column: Column,
}

/// The least and the largest number of a column; none if it exists in no row.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bounds<T> {
    /// The least number.
    pub least: Option<Extreme<T>>,
    /// The largest number.
    pub most: Option<Extreme<T>>,
}

/// A number and the first row that has it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extreme<T> {
    /// The number.
    pub value: T,
    /// The row in the sweep.
    pub row: u64,
}

impl Extremes {
    /// The extremes of a column.
    #[must_use]
    pub fn of(column: Column) -> Self {
        Self { column }
    }
}

impl<T: PartialOrd> Extreme<T> {
    /// Replaces a number by one that is better, or equal in a lower row.
    fn replace(best: &mut Option<Self>, other: Self, is_better: impl Fn(&T, &T) -> bool) {
        let is_replaced = best.as_ref().is_none_or(|best| {
            is_better(&other.value, &best.value) || (other.value == best.value && other.row < best.row)
        });
        if is_replaced {
            *best = Some(other);
        }
    }
}

impl<T: PartialOrd + Copy> Bounds<T> {
    fn add(&mut self, least: Extreme<T>, most: Extreme<T>) {
        Extreme::replace(&mut self.least, least, |a, b| a < b);
        Extreme::replace(&mut self.most, most, |a, b| a > b);
    }
}

impl<M: Lanes> Reducer<M> for Extremes {
    type Part = (Place, Bounds<M::Scalar>);
    type Output = Bounds<M::Scalar>;

    fn columns(&self) -> Vec<Column> {
        vec![self.column.clone()]
    }

    fn start(&self) -> Result<Self::Part, SweepError> {
        Ok((self.column.place::<M>()?, Bounds { least: None, most: None }))
    }

    fn fold(&self, (place, bounds): &mut Self::Part, block: &Block<'_, M>) {
        for (row, value) in block.accepted(*place) {
            bounds.add(Extreme { value, row }, Extreme { value, row });
        }
    }

    fn merge(&self, (_, bounds): &mut Self::Part, (_, other): Self::Part) {
        if let (Some(least), Some(most)) = (other.least, other.most) {
            bounds.add(least, most);
        }
    }

    fn finish(&self, (_, bounds): Self::Part) -> Self::Output {
        bounds
    }
}
