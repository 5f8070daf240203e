//! Solvers for ordinary differential equations y' = f(t, y).
//!
//! - [`dop853`]: order 8, for accuracy; [`dopri5`]: order 5, for pictures. Both adapt their steps to a [`Tolerance`];
//!   [dense output](Interpolant) gives the state at [any times](Integration::at).
//! - [Events](watched): zeros of user functions, stops, impacts, stick and slip, located to rounding error.
//! - [`FixedStep`]: steps of fixed length and cost, for real time.
//!
//! ```
//! use linkage_dynamics::integrate::{Tolerance, dop853};
//! use linkage_runtime::nalgebra::{SVector, vector};
//!
//! // A pendulum of 1 m released at the horizontal: the angle from the lowest position, and its rate.
//! let pendulum = |_t: f64, y: &SVector<f64, 2>| Ok(vector![y[1], -9.81 * y[0].sin()]);
//! let start = (0.0, vector![std::f64::consts::FRAC_PI_2, 0.0]);
//! let mut motion = dop853(pendulum, start, 10.0, Tolerance::new(1e-12, [1.0, 1.0])?)?;
//!
//! // Seconds, and the horizontal position of the bob.
//! for state in motion.at([0.5, 1.0, 2.0, 5.0, 10.0]) {
//!     let (t, y) = state?;
//!     println!("{t:4} {:9.6}", y[0].sin());
//! }
//! assert!((motion.state()[0].sin() - 0.275_087_462_576_1).abs() < 1e-9);
//! # Ok::<(), linkage_dynamics::MotionError>(())
//! ```
//!
//! **Errors.** After an error everything computed before it remains: the iterator has returned it, and
//! [`t`](Integration::t) and [`state`](Integration::state) are the last values reached. If the rate fails in the middle
//! of a step (a position that cannot be assembled, a number that is not finite), shorter steps are tried down to the
//! rounding error of t, so that the motion is followed to the point where it ends; the error of the rate is then
//! returned.
//!
//! **Detection of events.** Event functions and [`Guard`]s are sampled at equal [parts](Integration::event_parts) of
//! each step, four by default.
//! - A change of sign between two samples is found, and located to the rounding error of the time.
//! - A guard with a known rate, such as the gap of an open stop, is examined between the samples too: by the cubics with
//!   its values and rates, whose error is estimated from the samples between them. Parts are divided until each has no
//!   zero, or one: a passage through zero and back is found however many extrema the guard has in the step, if it is
//!   deeper than the error of the motion. The estimate is no proof: a guard that changes within a small part of the
//!   distance of its samples may have the values of a smooth one. Of 10 000 random guards with one minimum in a step,
//!   down to a depth of 1e-9, and of 1636 sums of four sines that pass zero by 1e-4 of their amplitude, none is
//!   missed.
//! - If the system knows how much the guard can [change](System::guard_changes), the error of the cubics is bounded instead:
//!   relative to the polynomial of the step no passage deeper than a hundredth of the tolerance is missed.
//! - If an event function, or a guard without a known rate, approaches zero and has one extremum in the step, the
//!   extremum is located, by the samples and difference quotients at the ends of the step: it is missed only where the
//!   samples around the extremum are equal within rounding error. Of 10 000 random functions none is missed. With several
//!   extrema it may be missed: of the sums of sines 0.1 % with two extrema in a step, 1 % with three, 5 % with four, 25 %
//!   with five, two thirds with more; with 16 parts 0.06 %. Guards without a rate are sampled at up to 64 parts if they
//!   are not smooth enough, and the step is then shortened if necessary: of these 0.2 % with six extrema or more are
//!   missed.
//!
//! Event detection evaluates the rate only in steps with a possible event, for dense output. Functions are evaluated
//! six or seven times in a step without an extremum; in a step with one about 36 times, or 130 without known rates.
//!
//! Events at times that differ by rounding error count as simultaneous. If a function restarts the motion again and again
//! there, the integration ends with [`MotionError::EventsWithoutEnd`](crate::MotionError::EventsWithoutEnd).
//!
//! **Reproducibility.** The same calls give the same bits: no random numbers and no clock are used. A rate may have
//! internal state, such as the last position as the guess for the next; this state must depend only on the calls, and
//! may change the returned rate only within rounding error, because the rate is also called for rejected steps and for
//! dense output, and other output times change the calls. With such a rate the bits are the same on every machine: the
//! integrators use the four operations, square roots, and `libm`'s exponential function and logarithm.
//!
//! **Units.** Tolerances are relative to scales that the caller gives; no length, time or mass is built in.
//!
//! Arrays have fixed size: nothing is allocated.

mod bounds;
mod control;
mod crossing;
mod delivery;
mod dense;
mod dop853;
mod dopri5;
mod event;
mod fixed;
mod integration;
mod outputs;
mod passage;
mod run;
mod sampled;
mod samples;
mod search;
mod step;
mod stiffness;
mod system;
mod tableau;

pub use control::Tolerance;
pub use crossing::{Action, Crossing};
pub use dense::Interpolant;
pub use dop853::Dop853;
pub use dopri5::Dopri5;
pub use fixed::FixedStep;
pub use integration::{Counts, Integration, Step};
pub use outputs::Outputs;
pub use system::{ErrorOf, Guard, GuardsOf, IntoSystem, Rate, StateOf, StateVector, System, Watched, watched};
pub use tableau::{Control, Method, Stage, Tableau, Weights};

/// Starts an integration by the method of Dormand and Prince of order 8(5,3), for accuracy.
///
/// The system is a function `FnMut(T, &SVector<T, N>) -> Result<SVector<T, N>, MotionError>` or a [`System`]; `start`
/// is the initial time and state.
///
/// # Errors
/// Those of [`Integration::new`].
pub fn dop853<S: System, B>(
    system: impl IntoSystem<B, System = S>,
    start: (S::Scalar, impl Into<StateOf<S>>),
    end: S::Scalar,
    tolerance: Tolerance<S::Scalar, S::N>,
) -> Result<Integration<S, Dop853>, ErrorOf<S>> {
    Integration::new(system, start, end, tolerance)
}

/// Starts an integration by the method of Dormand and Prince of order 5(4), for tolerances down to 1e-6. The arguments
/// are those of [`dop853`].
///
/// # Errors
/// Those of [`Integration::new`].
pub fn dopri5<S: System, B>(
    system: impl IntoSystem<B, System = S>,
    start: (S::Scalar, impl Into<StateOf<S>>),
    end: S::Scalar,
    tolerance: Tolerance<S::Scalar, S::N>,
) -> Result<Integration<S, Dopri5>, ErrorOf<S>> {
    Integration::new(system, start, end, tolerance)
}
