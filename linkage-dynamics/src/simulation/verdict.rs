//! How near to a singularity a position is, and what is said where the motion cannot go on.

use super::independent::Independent;
use super::motion::{Motion, Position};
use crate::Scene;
use linkage_runtime::{Error, Mechanism, Real, real};

impl<S, W, T, const U: usize, const V: usize, const N: usize, const C: usize> Motion<'_, S, W, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    /// The name of the group whose determinant is smallest beside its size.
    pub(super) fn change_point(&self, q: &Position<S, T, U, V, N, C>) -> Error {
        let mechanism = self.scene.mechanism();
        let (_, group) = weakest(mechanism, &mechanism.pose_at(q));
        Error::ChangePoint { mechanism: S::Mechanism::NAME, group }
    }

    /// Why no coordinates are left: what is prescribed comes to a dead point, or two motions cross.
    pub(super) fn cannot_go_on(&self, t: T, q: &Position<S, T, U, V, N, C>) -> Error {
        let mechanism = self.scene.mechanism();
        let is_driven = self.held(t).contains(&true);
        let freely = Independent::choose(mechanism, &mechanism.pose_at(q), &self.scales, &[false; V]);
        let is_regular = freely.regularity() > T::default_epsilon().sqrt() * real(64.0);
        if is_driven && is_regular { self.singular(q) } else { self.change_point(q) }
    }

    pub(super) fn singular(&self, q: &Position<S, T, U, V, N, C>) -> Error {
        let mechanism = self.scene.mechanism();
        let (regularity, group) = weakest(mechanism, &mechanism.pose_at(q));
        let regularity = linkage_runtime::__shared::to_f64(regularity);
        Error::Singular { mechanism: S::Mechanism::NAME, group, regularity }
    }
}

/// How regular the group is that is nearest to a singularity, and its name: its determinant beside the product of the
/// largest sizes of its columns, of n unknowns to the power 1 / (n - 1). Of two links it is half the sine of the angle
/// between them.
pub(super) fn weakest<M, T, const U: usize, const V: usize>(mechanism: &M, pose: &M::Pose) -> (T, &'static str)
where
    M: Mechanism<T, U, V>,
    T: Real,
{
    let (sizes, _) = mechanism.jacobian_sizes(pose);
    let determinants = mechanism.block_determinants(pose);
    let mut least = (T::one(), "");
    for (determinant, group) in determinants.as_ref().iter().zip(M::GROUPS) {
        let square = |column: usize| {
            group.equations.iter().fold(T::zero(), |sum, &row| sum + sizes[(row, column)] * sizes[(row, column)])
        };
        let product = group.unknowns.iter().fold(T::one(), |product, &column| product * square(column)).sqrt();
        let mut part = determinant.abs() / product;
        if group.unknowns.len() > 2 {
            part = part.powf(real::<T>(1.0 / (group.unknowns.len() - 1) as f64));
        }
        // NaN is not regular either.
        let is_better = part >= least.0;
        if !is_better {
            least = (part, group.name);
        }
    }
    least
}
