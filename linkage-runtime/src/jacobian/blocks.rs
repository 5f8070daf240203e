//! The distance of each group of unknowns from a singularity.

use super::scales::scale_or_one;
use super::{EliminationOf, Jacobian};
use crate::scalar::arithmetic::*;
use crate::scalar::{larger, largest, relative, smallest};
use crate::{Build, Column, Dim, Group, Matrix, Mechanism, Name, PerUnknown};

/// The diagonal blocks of J, one for each group.
pub struct Blocks<'a, M: Mechanism> {
    mechanism: &'a M,
    jacobian: Matrix<M::Scalar, M::U, M::U>,
    /// The largest magnitude that each entry of J can have at any angles, with the lengths of this pose.
    scales: Matrix<M::Scalar, M::U, M::U>,
    /// The scales of the residuals: the sums of the magnitudes of their terms.
    residual_scales: PerUnknown<M>,
    determinants: Column<M::Scalar, M::G>,
}

impl<'a, M: Mechanism> Blocks<'a, M> {
    /// Evaluates the blocks at a position.
    pub fn of(mechanism: &'a M, pose: &M::Pose) -> Self {
        Self {
            mechanism,
            jacobian: mechanism.jacobian_unknowns(pose),
            scales: mechanism.jacobian_unknowns_scales(pose),
            residual_scales: mechanism.residual_scales(pose),
            determinants: mechanism.block_determinants(pose),
        }
    }

    /// The number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.residual_scales.dim().count()
    }

    /// The determinants of the blocks.
    pub fn determinants(&self) -> &Column<M::Scalar, M::G> {
        &self.determinants
    }

    /// The regularity of the block of a group, from 0 if it is singular to about 1: its determinant divided by the
    /// largest product of entries that it could be made of at these lengths; for more than two unknowns the smallest
    /// pivot of the equilibrated block. [`PositionError::Singular`](crate::PositionError::Singular) contains it.
    pub fn regularity(&self, group: usize) -> M::Scalar {
        // An index that is out of range has regularity 0.
        let Some(members) = self.mechanism.group(group) else { return M::Scalar::zero() };
        let scale = match (members.equations, members.unknowns) {
            (&[i], &[j]) => self.scales.part(i, j),
            (&[i, k], &[j, l]) => {
                let scales = &self.scales;
                larger(scales.part(i, j) * scales.part(k, l), scales.part(i, l) * scales.part(k, j))
            }
            _ => {
                let unknowns = self.equilibrated(&members, M::Scalar::one());
                let pivots = EliminationOf::<M>::new(Jacobian {
                    unknowns,
                    inputs: unknowns.dims().0.zero_matrix(self.mechanism.dims().1),
                })
                .pivots();
                return smallest(pivots);
            }
        };
        relative(self.determinants.part(group), scale).abs()
    }

    /// The regularity and the name of the group nearest to a singularity; the name is empty if there are no groups.
    pub fn least_regular(&self) -> (M::Scalar, M::Name) {
        let mut least =
            (M::Scalar::one(), self.mechanism.group(0).map_or_else(|| Name::from_static(""), |group| group.name));
        for (place, group) in self.mechanism.groups().enumerate() {
            let regularity = self.regularity(place);
            // NaN counts as singular.
            let is_more_regular = regularity >= least.0;
            if !is_more_regular {
                least = (regularity, group.name);
            }
        }
        least
    }

    /// The equilibrated block of a group, in the upper left corner: its rows are divided by the scales of their
    /// residuals, its columns by the largest entry that they could then have at any angle. The rest of the matrix is
    /// `diagonal` times the identity.
    pub fn equilibrated(&self, group: &Group<'_, M::Name>, diagonal: M::Scalar) -> Matrix<M::Scalar, M::U, M::U> {
        let rows = self.residual_scales.map(scale_or_one);
        let mut matrix = self.jacobian.dims().0.identity() * diagonal;
        for (column, &unknown) in group.unknowns.iter().enumerate() {
            let possible = group.equations.iter().map(|&row| self.scales.part(row, unknown) / rows.part(row));
            let scale = scale_or_one(largest(possible));
            for (row, &equation) in group.equations.iter().enumerate() {
                if let Some(entry) = matrix.get_mut(row, column) {
                    *entry = self.jacobian.part(equation, unknown) / rows.part(equation) / scale;
                }
            }
        }
        matrix
    }
}
