//! Scenes in motion: the equations that `linkage!` emits for a scene, integrated, with the closures held.
//!
//! [`simulate`] takes a scene with `inertia`, a start and an end, and gives the states one after the other with all
//! coordinates and their rates by name.
//!
//! 1. *Coordinates.* The motion is that of y = (q, v') by the emitted equations in the inputs. After each step the
//!    closures are closed again by Newton's method from where the integrator has left them, with the inputs held: one or
//!    two iterations to rounding, on the branch and in the turn where the motion is, also where a group has no
//!    closed form.
//! 2. *Dead points of the input*, where J has no inverse: near one the motion is followed in other independent
//!    coordinates, those that elimination with complete pivoting of [J A] leaves over, and in the inputs again when these
//!    are good again. No step goes over a singularity of its own coordinates.
//! 3. *Change points*, where [J A] itself loses rank, as where the links of a parallelogram are in line, and no
//!    coordinate helps: a step of a collocation method goes over it along the branch whose tangent continues; it stands
//!    if the closures hold there where the step says, and at the change point to rounding. Where two branches only come
//!    near each other the motion follows its own round the bend.
//!
//! Contacts begin and end where their guards say ([which are found](crate::integrate)): of a stop, on a coordinate or an
//! output, the rate of the gap is known, so that it is not missed however briefly it is touched within a step. Frictions
//! and stops are followed forward in time only: [`MotionError::Irreversible`](crate::MotionError::Irreversible).
//!
//! The branch never changes but like this: what cannot be followed ends with a [`MotionError`](crate::MotionError), and what was
//! computed until then stays.
//!
//! Prescribed inputs keep to their laws. Reproducible: the same calls give the same bits. Nothing is allocated.

mod advance;
mod equations;
mod independent;
mod motion;
mod outputs;
mod over;
mod real_time;
mod road;
mod run;
pub(crate) mod scales;
mod state;
mod touching;
mod verdict;
mod watch;

pub use motion::Motion;
pub use outputs::States;
pub use real_time::RealTime;
pub use road::{AtSingularity, Passages};
pub use run::{Simulation, simulate};
pub use state::{Loads, State, Touch};
pub use watch::{EventFunctions, Then, Unwatched, Watch};
