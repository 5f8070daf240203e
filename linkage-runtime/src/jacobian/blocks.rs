//! How near each group of unknowns is to a singularity.

use super::scales::positive;
use super::{EliminationOf, Jacobian};
use crate::scalar::arithmetic::*;
use crate::scalar::{larger, largest, relative, smallest};
use crate::{Column, Group, Matrix, Mechanism, PerUnknown};

/// The blocks of J on its diagonal, one for each group.
pub struct Blocks<M: Mechanism> {
    jacobian: Matrix<M::Scalar, M::U, M::U>,
    /// What its entries could be at these lengths.
    sizes: Matrix<M::Scalar, M::U, M::U>,
    /// The sizes of the closures: the sums of the magnitudes of their terms.
    closures: PerUnknown<M>,
    determinants: Column<M::Scalar, M::G>,
}

impl<M: Mechanism> Blocks<M> {
    /// At a position.
    pub fn of(mechanism: &M, pose: &M::Pose) -> Self {
        Self {
            jacobian: mechanism.jacobian_unknowns(pose),
            sizes: mechanism.jacobian_unknowns_sizes(pose),
            closures: mechanism.closure_sizes(pose),
            determinants: mechanism.block_determinants(pose),
        }
    }

    /// The determinants.
    pub fn determinants(&self) -> &Column<M::Scalar, M::G> {
        &self.determinants
    }

    /// How regular the block of a group is: its determinant beside the largest value that its formula could take at these
    /// lengths; of more than two unknowns the smallest pivot of the equilibrated block. 1 is far from singular, 0 is
    /// singular. It is that of [`PositionError::Singular`](crate::PositionError::Singular).
    pub fn regularity(&self, group: usize) -> M::Scalar {
        // There is one at each place that is asked for.
        let Some(block) = M::GROUPS.get(group) else { return M::Scalar::zero() };
        let size = match (block.equations, block.unknowns) {
            (&[i], &[j]) => self.sizes.part(i, j),
            (&[i, k], &[j, l]) => {
                let sizes = &self.sizes;
                larger(sizes.part(i, j) * sizes.part(k, l), sizes.part(i, l) * sizes.part(k, j))
            }
            _ => {
                let unknowns = self.equilibrated(block, M::Scalar::one());
                let pivots = EliminationOf::<M>::new(Jacobian { unknowns, inputs: Matrix::zeros() }).pivots();
                return smallest(pivots);
            }
        };
        relative(self.determinants.part(group), size).abs()
    }

    /// The group that is nearest to a singularity, and how regular it is; of no group the first name is none.
    pub fn weakest(&self) -> (M::Scalar, &'static str) {
        let mut weakest = (M::Scalar::one(), M::GROUPS.first().map_or("", |group| group.name));
        for (place, group) in M::GROUPS.iter().enumerate() {
            let regularity = self.regularity(place);
            // What is not a number is not regular either.
            let is_better = regularity >= weakest.0;
            if !is_better {
                weakest = (regularity, group.name);
            }
        }
        weakest
    }

    /// The block of a group, its rows divided by the sizes of their closures and its columns by the largest entry that
    /// they could then have, in the corner of a diagonal with this entry.
    pub fn equilibrated(&self, block: &Group, diagonal: M::Scalar) -> Matrix<M::Scalar, M::U, M::U> {
        let rows = self.closures.map(positive);
        let mut matrix = Matrix::identity() * diagonal;
        for (column, &unknown) in block.unknowns.iter().enumerate() {
            let possible = block.equations.iter().map(|&row| self.sizes.part(row, unknown) / rows.part(row));
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
