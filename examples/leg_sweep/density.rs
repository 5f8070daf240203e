//! A reducer that counts points of the plane in cells.

use linkage::lanes::Lanes;
use linkage_sweep::{Block, Case, Column, Place, Reducer, SweepError};

use crate::gait::columns;

/// A grid of equal cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    pub x: [f64; 2],
    pub y: [f64; 2],
    /// The numbers of columns and rows.
    pub cells: [usize; 2],
}

/// Counts points in the cells of a grid.
pub struct Density<F> {
    grid: Grid,
    points: F,
}

/// The number of points in each cell, row by row from below.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    pub counts: Vec<u64>,
    /// The points beyond the grid.
    pub outside: u64,
}

impl<F> Density<F>
where
    F: Fn(&Case<'_, f64, 2>, &mut dyn FnMut([f64; 2])),
{
    /// Counts the points that a function hands over for each case.
    pub fn new(grid: &Grid, points: F) -> Self {
        Self { grid: grid.clone(), points }
    }
}

impl Grid {
    /// The index of the cell that contains a point.
    fn cell(&self, [x, y]: [f64; 2]) -> Option<usize> {
        let [columns, rows] = self.cells;
        let place = |at: f64, [from, to]: [f64; 2], cells: usize| {
            let place = (at - from) / (to - from) * cells as f64;
            (place >= 0.0 && place < cells as f64).then_some(place as usize)
        };
        Some(place(y, self.y, rows)? * columns + place(x, self.x, columns)?)
    }
}

impl<M: Lanes<Scalar = f64>, F> Reducer<M> for Density<F>
where
    F: Fn(&Case<'_, f64, 2>, &mut dyn FnMut([f64; 2])) + Sync,
{
    type Part = ([Place; 2], Cells);
    type Output = Cells;

    fn columns(&self) -> Vec<Column> {
        columns().to_vec()
    }

    fn start(&self) -> Result<Self::Part, SweepError> {
        let [x, y] = columns();
        let counts = vec![0; self.grid.cells[0] * self.grid.cells[1]];
        Ok(([x.place::<M>()?, y.place::<M>()?], Cells { counts, outside: 0 }))
    }

    fn fold(&self, (places, cells): &mut Self::Part, block: &Block<'_, M>) {
        for case in block.cases(*places) {
            (self.points)(&case, &mut |point| match self.grid.cell(point) {
                Some(cell) => cells.counts[cell] += 1,
                None => cells.outside += 1,
            });
        }
    }

    fn merge(&self, (_, cells): &mut Self::Part, (_, other): Self::Part) {
        cells.counts.iter_mut().zip(other.counts).for_each(|(count, other)| *count += other);
        cells.outside += other.outside;
    }

    fn finish(&self, (_, cells): Self::Part) -> Self::Output {
        cells
    }
}
