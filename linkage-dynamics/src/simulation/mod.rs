//! Simulation of scenes: integrates the equations of motion that `linkage!` emits, with the constraints Psi = 0
//! satisfied.
//!
//! [`simulate`] takes a scene with `inertia`, a [`Start`] and an end, and returns an iterator over the states, with all
//! coordinates and their rates by name.
//!
//! 1. *Coordinates.* The state is y = (q, v') with the emitted equations in the inputs v. After each step Newton's
//!    method projects q onto the constraints with the inputs fixed: one or two iterations to rounding error, without a
//!    change of branch or turn, also for groups without closed form.
//! 2. *Dead points of the input*, where J is singular: near one the simulation uses other independent coordinates, the
//!    columns without pivot after elimination of [J A] with complete pivoting, and returns to the inputs beyond it. A
//!    step that passes a singularity of its own coordinates is repeated in others.
//! 3. *Change points*, where [J A] itself loses rank (the links of a parallelogram in line) and no choice of
//!    coordinates is regular: the motion is smooth on its sheet, the positions reached by the branch whose tangent
//!    continues. Position, basis and bias are interpolated near the crossing from positions around it, with an estimate
//!    of their error that adds to that of each step: step lengths, events and contacts are as everywhere. Where two
//!    branches only come near each other, shorter steps follow the branch of the motion.
//!
//! Contacts change where their guards fall through zero ([detection of events](crate::integrate)): the rate of the gap
//! of a stop is known, so that even a brief touch within a step is found. Frictions and stops are simulated forward in
//! time only: [`MotionError::Irreversible`](crate::MotionError::Irreversible).
//!
//! Steps end at the kinks of laws; where the rate of a drive jumps, an impulse acts on the other coordinates.
//!
//! The assembly branch changes only at these dead points and change points. A motion that cannot be followed ends with
//! a [`MotionError`](crate::MotionError), and earlier states remain valid.
//!
//! Prescribed inputs follow their laws. The same calls give the same bits. Nothing is allocated.

mod advance;
mod change_point;
mod corners;
mod data;
mod equations;
mod failure;
mod frame;
mod held;
mod independent;
mod jumps;
mod kinks;
mod motion;
mod on_sheet;
mod outputs;
mod parametrisation;
mod real_time;
mod run;
pub(crate) mod scales;
mod sheet;
mod start;
mod state;
mod touching;
mod watch;

pub use crate::scene::Loads;
pub use data::{AtSingularity, Passages, Simulation};
pub use held::IntoHeldScene;
pub use motion::Motion;
pub use outputs::States;
pub use real_time::RealTime;
pub use run::simulate;
pub use start::Start;
pub use state::{State, Touch};
pub use watch::{EventFunctions, Then, Unwatched, Watch};
