//! Position solvers selected by type, with their accuracy and time.
//!
//! | type | method | starts from |
//! |---|---|---|
//! | [`ClosedForm`] | `assemble`, group by group | the branch |
//! | [`Newton<K>`](Newton) | the prediction of the velocity ratios, then `K` Newton steps | a position nearby |
//! | [`Table<M, N>`](Table) | cubics between `N` positions | the table, one input |
//!
//! Each computes in the scalar of the mechanism: `f32`, `f64`, or `DoubleDouble` with 31 digits (feature
//! `double-double`).
//!
//! # Accuracy and time
//!
//! Largest error against 45-digit arithmetic at poses far from dead points (position in radians, velocity relative),
//! and time for the position and for position with velocity, from the input, on two cores in 2026. Newton's method
//! starts one degree away. The example `accuracy_cost` measures all of it on the machine that it runs on, with
//! acceleration and poses near a dead point; `linkage::price` measures any mechanism, with the feature `double-double`.
//!
//! | | four-bar | | Jansen leg | | double butterfly | |
//! |---|---|---|---|---|---|---|
//! | `f32`, closed form | 1e-7, 6e-7 | 78, 81 ns | 8e-7, 9e-7 | 137, 171 ns | none | |
//! | `f64`, closed form | 3e-16, 4e-16 | 78, 80 ns | 1e-15, 2e-15 | 161, 184 ns | none | |
//! | `DoubleDouble`, closed form | 3e-32, 3e-32 | 2.2, 2.3 µs | 5e-32, 1e-31 | 3.5, 4.1 µs | none | |
//! | `DoubleDouble`, `Newton<4>` | | | | | 3e-32, 4e-32 | 93, 109 µs |
//! | `Newton<1>` | 3e-9, 5e-9 | 84, 93 ns | 8e-7, 1e-6 | 312, 334 ns | 2e-9, 2e-9 | 1.5, 2.1 µs |
//! | `Newton<2>` | 4e-16, 3e-16 | 142, 150 ns | 9e-13, 1e-12 | 490, 511 ns | 2e-16, 5e-16 | 2.1, 2.7 µs |
//! | `Newton<3>` | 3e-16, 4e-16 | 192, 200 ns | 8e-16, 9e-16 | 611, 633 ns | 4e-16, 4e-16 | 2.7, 3.3 µs |
//! | `Table`, 1024 intervals | 4e-12, 4e-12 | 58, 63 ns | 5e-10, 9e-10 | 145, 168 ns | 3e-12, 3e-12 | 0.09, 0.66 µs |
//!
//! Closed form in `f64` is the default: no other method is as accurate in less time, and the velocity adds almost
//! nothing. `f32` halves the memory, hardly the time. A table saves a quarter of the four-bar's time, a tenth of the
//! leg's, and all but a twentieth of the butterfly's, which otherwise takes Newton's method. The remaining time is
//! spent on the sines of the pose, so that 64 intervals are hardly faster than 1024, only smaller, and four digits less
//! accurate.
//!
//! Newton's method serves groups without closed form: from one degree away two steps reach rounding error on four-bar
//! and butterfly, three on the leg. [`newton`](crate::newton) to convergence takes a quarter to three quarters longer.
//! That pays for its checks and adds no digits.
//!
//! Near a dead point no method in doubles is accurate: with a transmission angle mu, the rounding error of the input
//! alone causes errors of eps / sin(mu) in the angles, eps / sin^2(mu) in the velocity and eps / sin^3(mu) in
//! the acceleration. Closed form in `f64` returns an error at sin(mu) = 1e-9, where 31 digits still give seven of the
//! acceleration. At *given* angles, determinants as sines of differences keep every digit down to 1e-9, where products
//! of stored sines have lost nine digits and are no faster. The butterfly's determinant has no such form; near dead points
//! the emitted functions solve it in twice the precision, which keeps the digits at forty times the time.
//!
//! Products of stored sines, and Newton's method to a tolerance, are inferior in error or time everywhere and are not
//! offered here.

mod newton;
mod table;

use core::borrow::Borrow;

pub use newton::Newton;
pub use table::Table;

use crate::{Assembly, Mechanism, PositionErrorOf};

/// A position solver for mechanisms `M`, selected by its type at compile time.
///
/// ```
/// use linkage_runtime::accuracy::{ClosedForm, PositionMethod};
/// use linkage_runtime::{Assembly, D, PositionError};
///
/// /// The velocity ratio of the first unknown, by any position solver.
/// fn ratio<M, R>(m: &M, from: &R::From, input: M::Inputs) -> Result<M::Scalar, PositionError<M::Name>>
/// where
///     M: Assembly<V = D<1>>,
///     R: PositionMethod<M>,
/// {
///     let position = R::position(m, from, input)?;
///     let pose = std::borrow::Borrow::borrow(&position);
///     Ok(-m.solve_jacobian(pose, &m.jacobian_inputs(pose).column(0))?[0])
/// }
/// ```
pub trait PositionMethod<M: Mechanism> {
    /// The starting data: a branch, a position or a table.
    type From;
    /// The result: a pose, or a pose with its coordinates.
    type Position: Borrow<M::Pose>;

    /// Computes the position at these inputs.
    ///
    /// # Errors
    /// Those of the solver. A position on another branch than that of `from` is an error.
    fn position(
        mechanism: &M,
        from: &Self::From,
        inputs: impl Into<M::Inputs>,
    ) -> Result<Self::Position, PositionErrorOf<M>>;
}

/// Closed form, group by group, on a given branch, not on one motion: [`Assembly::assemble`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClosedForm;

impl<M: Assembly> PositionMethod<M> for ClosedForm {
    type From = M::Branch;
    type Position = M::Pose;

    #[inline(always)]
    fn position(
        mechanism: &M,
        branch: &M::Branch,
        inputs: impl Into<M::Inputs>,
    ) -> Result<M::Pose, PositionErrorOf<M>> {
        mechanism.assemble(inputs.into(), *branch)
    }
}

/// Coordinates and their pose.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Reached<Q, P> {
    /// The coordinates; angles are continuous over full turns.
    pub coordinates: Q,
    /// The pose at these coordinates.
    pub pose: P,
}

impl<Q, P> Reached<Q, P> {
    /// Computes the pose at these coordinates, which are not checked (see [`Mechanism::pose_at`]).
    pub fn at<M: Mechanism<Coordinates = Q, Pose = P>>(mechanism: &M, coordinates: Q) -> Self {
        Self { pose: mechanism.pose_at(&coordinates), coordinates }
    }
}

impl<Q, P> Borrow<P> for Reached<Q, P> {
    fn borrow(&self) -> &P {
        &self.pose
    }
}
