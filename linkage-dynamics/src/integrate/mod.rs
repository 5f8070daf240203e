//! Motions from differential equations: y' = f(t, y).
//!
//! - [`dop853`]: order 8, for accuracy; [`dopri5`]: order 5, for pictures. Both choose their steps by a
//!   [`Tolerance`]; between the steps [dense output](Interpolant) gives the state at [any times](Integration::at).
//! - [Events](watched): stops, impacts, stick and slip, the user's zeros, found to rounding.
//! - [`FixedStep`]: so many evaluations a step and no more, for real time.
//!
//! ```
//! use linkage_dynamics::integrate::{Tolerance, dop853};
//! use linkage_runtime::nalgebra::{SVector, vector};
//!
//! // A pendulum of 1 m let go at the horizontal: the angle from below in radians, and its speed.
//! let pendulum = |_t: f64, y: &SVector<f64, 2>| Ok(vector![y[1], -9.81 * y[0].sin()]);
//! let start = (0.0, vector![std::f64::consts::FRAC_PI_2, 0.0]);
//! let mut motion = dop853(pendulum, start, 10.0, Tolerance::new(1e-12, [1.0, 1.0])?)?;
//!
//! // Seconds, and the horizontal place of the bob.
//! for state in motion.at([0.5, 1.0, 2.0, 5.0, 10.0]) {
//!     let (t, y) = state?;
//!     println!("{t:4} {:9.6}", y[0].sin());
//! }
//! assert!((motion.state()[0].sin() - 0.275_087_462_576_1).abs() < 1e-9);
//! # Ok::<(), linkage_dynamics::MotionError>(())
//! ```
//!
//! **Failure.** Every function that may fail says so, and what was computed until then stays: an iterator has given
//! it, and [`t`](Integration::t) and [`state`](Integration::state) tell how far the motion went. Where the rate cannot
//! be had in the middle of a step (a position that cannot be assembled, a number that is not finite), shorter steps are
//! tried down to rounding, so that the motion is followed up to the place where it ends; the rate's own error is then
//! returned.
//!
//! **Which events are found.** An event function, or a [`Guard`], is looked at between the equal
//! [parts](Integration::event_parts) of each step, four without that setting.
//! - A passage through zero that is not taken back within a part is found, to rounding of the time.
//! - What comes near zero and turns once in the step is followed to where it turns, so that a passage there and back is
//!   found however short it is. Of a guard whose rate the system knows the sign of the rate tells that it turns; of event
//!   functions, and of guards without a rate, values tell, and differences at the ends of the step: they miss it only
//!   where the function is the same to rounding errors at the parts around the turn. The accuracy is that of the motion:
//!   a passage shallower than its error may be there or not. Of 10 000 random functions with one minimum in a step, down
//!   to a depth of 1e-9, none is missed.
//! - What turns more often in one step may be missed: of random sums of four sines that pass zero by 1e-4 of their
//!   height, 0.1 % with two extrema in a step, 1 % with three, 5 % with four, 25 % with five, two thirds with more; looked
//!   at in 16 parts 0.06 %. Guards without a rate are looked at in up to 64 parts where they bend, and the step is made
//!   shorter if that is not enough: of these 0.2 % with six extrema and more.
//!
//! This takes no evaluation of the rate but in a step in which something passes zero or turns towards it, which is
//! given dense output; functions are looked at six or seven times in a step in which none turns, and some thirty times, without known rates
//! some 130 times, in one in which one does. Without events it takes nothing.
//!
//! **Reproducible.** Nothing is drawn by chance and no clock is read: the same calls give the same bits. A rate may keep
//! a state of its own, such as the last position as the guess for the next; then it must depend on nothing but the
//! calls it gets, and what it returns may depend on that guess only within rounding, for it is called for rejected
//! steps and for dense output as well, and asking for other output times changes the calls. [`dop853`] itself
//! computes by the four operations and square roots except for its first step, so that with a [first
//! step](Integration::first_step) given and such a rate the bits are those of every machine.
//!
//! **Units.** Tolerances are pure numbers beside sizes that the caller gives; no length, time or mass is built in.
//!
//! Everything lies in arrays of fixed size: nothing is allocated.

mod control;
mod delivery;
mod dense;
mod dop853;
mod dopri5;
mod event;
mod fixed;
mod outputs;
mod run;
mod samples;
mod step;
mod system;
mod tableau;

pub use control::Tolerance;
pub use dense::Interpolant;
pub use dop853::Dop853;
pub use dopri5::Dopri5;
pub use event::{Action, Crossing};
pub use fixed::FixedStep;
pub use outputs::Outputs;
pub use run::{Counts, Integration, Step};
pub use system::{Guard, IntoSystem, Rate, StateOf, StateVector, System, Watched, watched};
pub use tableau::{Control, Method, Stage, Tableau, Weights};

use crate::MotionError;

/// An integration by the method of Dormand and Prince of order 8(5,3): the choice where accuracy counts.
///
/// The system is a closure `FnMut(T, &SVector<T, N>) -> Result<SVector<T, N>, MotionError>` or a [`System`]; `start` is
/// the time and the state there.
///
/// # Errors
/// As [`Integration::new`].
pub fn dop853<S: System, B>(
    system: impl IntoSystem<B, System = S>,
    start: (S::Scalar, impl Into<StateOf<S>>),
    end: S::Scalar,
    tolerance: Tolerance<S::Scalar, S::N>,
) -> Result<Integration<S, Dop853>, MotionError> {
    Integration::new(system, start, end, tolerance)
}

/// An integration by the method of Dormand and Prince of order 5(4): the choice for tolerances down to 1e-6. Else as
/// [`dop853`].
///
/// # Errors
/// As [`Integration::new`].
pub fn dopri5<S: System, B>(
    system: impl IntoSystem<B, System = S>,
    start: (S::Scalar, impl Into<StateOf<S>>),
    end: S::Scalar,
    tolerance: Tolerance<S::Scalar, S::N>,
) -> Result<Integration<S, Dopri5>, MotionError> {
    Integration::new(system, start, end, tolerance)
}
