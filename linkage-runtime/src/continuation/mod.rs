//! A mechanism followed along its motion.
//!
//! The positions of a mechanism with one input are a curve, Psi(u, v) = 0. It is followed by arc length, so that the
//! input is a coordinate like the others: at a dead point, where J has no inverse and the input turns back, [J A]
//! still has full rank and the curve just goes on.
//!
//! 1. *Tangent*: what [J A] takes to zero, which is (W, 1) times a factor, by elimination with complete pivoting. Where
//!    [J A] itself is nearly singular the last tangent is kept.
//! 2. *Step*: the tangent predicts, Newton's method across it corrects. The step is taken only if it is an arc: if it
//!    turns little, leaves neither tangent by more than its turn explains, and has the closures on the same side,
//!    which is the sign of det [J A; tangent']. Else it is halved. A prediction is a matter of correctness: a
//!    parallelogram followed without one becomes an antiparallelogram unnoticed.
//! 3. *Events*: where the determinant of a group changes its sign (a dead point), where the input comes to the end of
//!    its range or to where it was sent, and where a number of the user's is zero, the step ends, to rounding.
//! 4. *Change points*, where [J A] loses rank and motions cross: all tangents from the second derivatives, all groups
//!    that are singular there, one or several, and the way on as [`AtChangePoint`] says. Motions that only come near each
//!    other are told from that by the residual, and followed round their bend however sharp.
//!
//! The motion never changes but by a policy: what cannot be followed is an [`PathError`](crate::PathError) that names the group.
//!
//! Steps, turns and verdicts are pure numbers: scaling all lengths by a power of two changes no digit of a path. A
//! mechanism with several inputs is followed [`Along`] a path of its inputs that is given by one parameter.

mod along;
mod change_point;
mod cone;
mod curve;
mod events;
mod groups;
mod options;
mod path;
mod place;
mod tangents;

pub use along::{Along, AlongCoordinates, AlongPose, AlongRates};
pub use events::Event;
pub use groups::Groups;
pub use options::{AtChangePoint, Direction, Options};
pub use path::{Path, PathStep};
pub use tangents::Tangents;
