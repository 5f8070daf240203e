//! The distance of each group of unknowns from a singularity.

use super::scales::positive;
use super::{EliminationOf, Jacobian};
use crate::scalar::arithmetic::*;
use crate::scalar::{larger, largest, relative, smallest};
use crate::{Column, Group, Matrix, Mechanism, PerUnknown};

/// The diagonal blocks of J, one for each group.
pub struct Blocks<M: Mechanism> {
    jacobian: Matrix<M::Scalar, M::U, M::U>,
    /// The largest magnitude that each entry of J could have at these lengths.
    scales: Matrix<M::Scalar, M::U, M::U>,
    /// The scales of the residuals: the sums of the magnitudes of their terms.
    residual_scales: PerUnknown<M>,
    determinants: Column<M::Scalar, M::G>,
}

impl<M: Mechanism> Blocks<M> {
    /// Evaluates the blocks at a position.
    pub fn of(mechanism: &M, pose: &M::Pose) -> Self {
        Self {
            jacobian: mechanism.jacobian_unknowns(pose),
            scales: mechanism.jacobian_unknowns_scales(pose),
            residual_scales: mechanism.residual_scales(pose),
            determinants: mechanism.block_determinants(pose),
        }
    }

    /// The determinants of the blocks.
    pub fn determinants(&self) -> &Column<M::Scalar, M::G> {
        &self.determinants
    }

    /// The regularity of the block of a group: its determinant divided by the largest value that its formula could take
    /// at these lengths; for more than two unknowns the smallest pivot of the equilibrated block. 1 is far from
    /// singular, 0 is singular. [`PositionError::Singular`](crate::PositionError::Singular) contains it.
    pub fn regularity(&self, group: usize) -> M::Scalar {
        // An index that is out of range has regularity 0.
        let Some(block) = M::GROUPS.get(group) else { return M::Scalar::zero() };
        let scale = match (block.equations, block.unknowns) {
            (&[i], &[j]) => self.scales.part(i, j),
            (&[i, k], &[j, l]) => {
                let scales = &self.scales;
                larger(scales.part(i, j) * scales.part(k, l), scales.part(i, l) * scales.part(k, j))
            }
            _ => {
                let unknowns = self.equilibrated(block, M::Scalar::one());
                let pivots = EliminationOf::<M>::new(Jacobian { unknowns, inputs: Matrix::zeros() }).pivots();
                return smallest(pivots);
            }
        };
        relative(self.determinants.part(group), scale).abs()
    }

    /// The regularity and the name of the group nearest to a singularity; the name is empty if there are no groups.
    pub fn weakest(&self) -> (M::Scalar, &'static str) {
        let mut weakest = (M::Scalar::one(), M::GROUPS.first().map_or("", |group| group.name));
        for (place, group) in M::GROUPS.iter().enumerate() {
            let regularity = self.regularity(place);
            // NaN counts as singular.
            let is_better = regularity >= weakest.0;
            if !is_better {
                weakest = (regularity, group.name);
            }
        }
        weakest
    }

    /// The equilibrated block of a group: its rows are divided by the scales of their residuals, its columns by the
    /// largest entry that they could then have. The rest of the matrix has `diagonal` on its diagonal.
    pub fn equilibrated(&self, block: &Group, diagonal: M::Scalar) -> Matrix<M::Scalar, M::U, M::U> {
        let rows = self.residual_scales.map(positive);
        let mut matrix = Matrix::identity() * diagonal;
        for (column, &unknown) in block.unknowns.iter().enumerate() {
            let possible = block.equations.iter().map(|&row| self.scales.part(row, unknown) / rows.part(row));
            let scale = positive(largest(possible));
            for (row, &equation) in block.equations.iter().enumerate() {
                if let Some(entry) = matrix.get_mut(row, column) {
                    *entry = self.jacobian.part(equation, unknown) / rows.part(equation) / scale;
                }
            }
        }
        matrix
    }
}
