//! Path following: a mechanism followed along its motion by numerical continuation.
//!
//! The positions of a mechanism with one input form a curve Psi(u, v) = 0, which is followed by arc length. The input
//! is a coordinate like the others: at a dead point, where J is singular and the input reverses, [J A] has full rank
//! and the curve continues.
//!
//! 1. *Tangent*: the null vector of [J A], proportional to (W, 1), by elimination with complete pivoting. Where [J A]
//!    is nearly singular the previous tangent is kept.
//! 2. *Step*: predictor along the tangent, corrector by Newton's method in the plane normal to it. A step is accepted
//!    if it is an arc of one curve: the tangent turns little, the step deviates from neither tangent more than this
//!    turn explains, and the orientation det [J A; tangent'] keeps its sign. Otherwise it is halved. Without these
//!    checks a parallelogram may become an antiparallelogram unnoticed.
//! 3. *Events*: the step ends, to rounding error, where the determinant of a group changes its sign (a dead point),
//!    where the input reaches the end of its range or its target, where a coordinate or an output is at an end of its
//!    declared range if that is asked for, and where a watched function is zero. The first of
//!    several zeros in a step is found, also of two next to each other, from the values and slopes at both ends of the
//!    step: none is missed of a function that deviates from its cubic by less than a few times what the cubic deviates
//!    from its chord. A determinant that touches zero within the error of the position does not change its sign.
//! 4. *Change points*, where [J A] loses rank and motions cross: all tangents follow from the second derivatives, all
//!    singular groups are found, and [`AtChangePoint`] selects the motion. Where motions only come close to each other,
//!    Psi is not zero at the point between them; they are followed round their bend, however sharp it is. A motion passes
//!    a touch with another motion of one group without an event: the circuits search for these.
//!
//! The branch changes only as [`AtChangePoint`] says; otherwise following fails with a [`PathError`](crate::PathError)
//! that names the group.
//!
//! Steps, turns and tolerances are nondimensional: scaling all lengths by a power of two changes no digit of a path. A
//! mechanism with several inputs is followed [`Along`] a path of its inputs, given by one parameter.

mod along;
mod change_point;
mod cone;
mod curve;
mod events;
mod groups;
mod input_path;
mod joint_ranges;
mod options;
mod path;
mod place;
mod step;
mod tangents;
#[cfg(feature = "std")]
mod touches;

pub use along::{Along, AlongCoordinates, AlongPose, AlongRates};
pub use events::Event;
pub use groups::Groups;
pub use input_path::{InputAt, InputPath, Line, OneInput};
pub use options::{AtChangePoint, Direction, Options};
pub use path::{Path, PathStep};
pub use tangents::Tangents;
#[cfg(feature = "std")]
pub(crate) use touches::{TouchOnPath, Touches};
