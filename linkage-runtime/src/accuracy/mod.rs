//! Roads to the position, asked for by type: what the price list offers.

mod newton;
mod table;

use core::borrow::Borrow;

pub use newton::Newton;
pub use table::Table;

use crate::{Assembly, Error, Mechanism, Real};

/// A road to the position of mechanisms `M`, asked for by its type: what it is called with is known when the code is
/// compiled, and a call is the direct call.
///
/// ```
/// use linkage_runtime::accuracy::{ClosedForm, Method};
/// use linkage_runtime::{Assembly, Error, Real};
///
/// /// The velocity ratio of the first unknown, whatever the road to the position.
/// fn ratio<T: Real, M, R, const U: usize>(m: &M, from: &R::From, input: M::Inputs) -> Result<T, Error>
/// where
///     M: Assembly<T, U, 1>,
///     R: Method<M, T, U, 1>,
/// {
///     let position = R::position(m, from, input)?;
///     let pose = std::borrow::Borrow::borrow(&position);
///     Ok(-m.solve_jacobian(pose, &m.jacobian_inputs(pose).column(0).into_owned())?[0])
/// }
/// ```
pub trait Method<M: Mechanism<T, U, V>, T: Real, const U: usize, const V: usize> {
    /// What it starts from.
    type From;
    /// What it finds: a pose, or a pose with its coordinates.
    type Position: Borrow<M::Pose>;

    /// The position at these inputs.
    ///
    /// # Errors
    /// Those of the road; never a position of another branch than the one it starts from.
    fn position(mechanism: &M, from: &Self::From, inputs: impl Into<M::Inputs>) -> Result<Self::Position, Error>;
}

/// Position in closed form, group by group, from the branch: the `assemble` of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClosedForm;

impl<M, T, const U: usize, const V: usize> Method<M, T, U, V> for ClosedForm
where
    M: Assembly<T, U, V>,
    T: Real,
{
    type From = M::Branch;
    type Position = M::Pose;

    #[inline(always)]
    fn position(mechanism: &M, branch: &M::Branch, inputs: impl Into<M::Inputs>) -> Result<M::Pose, Error> {
        mechanism.assemble(inputs.into(), *branch)
    }
}

/// A position that was found as coordinates, with what follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached<Q, P> {
    /// The coordinates; angles go on from turn to turn.
    pub coordinates: Q,
    /// The position at these coordinates, ready for use.
    pub pose: P,
}

impl<Q, P> Reached<Q, P> {
    /// The position at these coordinates.
    pub fn at<M, T, const U: usize, const V: usize>(mechanism: &M, coordinates: Q) -> Self
    where
        M: Mechanism<T, U, V, Coordinates = Q, Pose = P>,
        T: Real,
    {
        Self { pose: mechanism.pose_at(&coordinates), coordinates }
    }
}

impl<Q, P> Borrow<P> for Reached<Q, P> {
    fn borrow(&self) -> &P {
        &self.pose
    }
}
