//! Roads to the position, asked for by type, and what their digits cost.
//!
//! | type | what | starts from |
//! |---|---|---|
//! | [`ClosedForm`] | `assemble`, group by group | the branch |
//! | [`Newton<K>`](Newton) | the prediction of the velocity ratios, then `K` Newton steps | a position nearby |
//! | [`Table<M, N>`](Table) | cubics between `N` positions | the table, one input |
//!
//! and each of them in the scalar that the mechanism is made of: `f32`, `f64`, or the `DoubleDouble` of 31 digits that
//! the feature `double-double` brings.
//!
//! # The price list
//!
//! Largest error at benign poses against 45 digits (position in radians, velocity relative), and nanoseconds for position
//! and for position with velocity, from the input, on two cores of 2026; Newton's method from one degree away. The example
//! `accuracy_cost` prints all of it, with acceleration and the poses near a dead point, for the machine that it runs on.
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
//! Read honestly: closed form in `f64` is the default because nothing offers its digits for less, and its velocity costs
//! next to nothing on top. `f32` halves the memory, hardly the time. A table saves a quarter of the four-bar's time, a
//! tenth of the leg's, and of the butterfly's, which is found by Newton's method, all but a twentieth; what is left are the
//! sines of the pose, so that 64 intervals are hardly faster than 1024, only smaller, and four digits worse. Newton's
//! method is for groups without closed form: from a degree away two steps reach rounding on four-bar and butterfly, three
//! on the leg. The checks on the way to a tolerance cost a quarter to three quarters more; they buy the verdict of
//! [`newton`](crate::newton), not digits. Near a dead point no road in doubles helps: the input alone leaves the angles
//! uncertain by a rounding over the sine of the transmission angle, velocity by its square, acceleration by its cube, and
//! closed form in `f64` refuses at a sine of 1e-9, where 31 digits still give seven of the acceleration. At *given* angles
//! it is another matter: determinants as sines of differences keep every digit down to 1e-9, where products of stored sines
//! have lost nine and are no faster. The butterfly's determinant has no such form: there a digit goes with each digit of it.
//! Products, and Newton's method to a tolerance, are beaten in error or time everywhere and are not offered here.

mod newton;
mod table;

use core::borrow::Borrow;

pub use newton::Newton;
pub use table::Table;

use crate::{Assembly, Mechanism, PositionError};

/// A road to the position of mechanisms `M`, asked for by its type: which one is known when the code is compiled, and the
/// call is the direct call.
///
/// ```
/// use linkage_runtime::accuracy::{ClosedForm, PositionMethod};
/// use linkage_runtime::{Assembly, D, PositionError};
///
/// /// The velocity ratio of the first unknown, whatever the road to the position.
/// fn ratio<M, R>(m: &M, from: &R::From, input: M::Inputs) -> Result<M::Scalar, PositionError>
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
    /// What it starts from.
    type From;
    /// What it finds: a pose, or a pose with its coordinates.
    type Position: Borrow<M::Pose>;

    /// The position at these inputs.
    ///
    /// # Errors
    /// Those of the road; never a position of another branch than the one it starts from.
    fn position(
        mechanism: &M,
        from: &Self::From,
        inputs: impl Into<M::Inputs>,
    ) -> Result<Self::Position, PositionError>;
}

/// Position in closed form, group by group, from the branch: the `assemble` of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClosedForm;

impl<M: Assembly> PositionMethod<M> for ClosedForm {
    type From = M::Branch;
    type Position = M::Pose;

    #[inline(always)]
    fn position(mechanism: &M, branch: &M::Branch, inputs: impl Into<M::Inputs>) -> Result<M::Pose, PositionError> {
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
    /// The position at these coordinates; nothing is refused, as of [`Mechanism::pose_at`].
    pub fn at<M: Mechanism<Coordinates = Q, Pose = P>>(mechanism: &M, coordinates: Q) -> Self {
        Self { pose: mechanism.pose_at(&coordinates), coordinates }
    }
}

impl<Q, P> Borrow<P> for Reached<Q, P> {
    fn borrow(&self) -> &P {
        &self.pose
    }
}
