//! Motions from differential equations: y' = f(t, y).
//!
//! - [`dop853`]: order 8, for accuracy; [`dopri5`]: order 5, for pictures. Both choose their steps by a
//!   [`Tolerance`]; between the steps [dense output](Interpolant) gives the state at [any times](Integration::at).
//! - [Events](watched): stops, impacts, stick and slip, the user's zeros, found to rounding.
//! - [`FixedStep`]: so many evaluations a step and no more, for real time.
//!
//! ```
//! use linkage_runtime::integrate::{Tolerance, dop853};
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
//! # Ok::<(), linkage_runtime::Error>(())
//! ```
//!
//! **Failure.** Every function that may fail says so, and what was computed until then stays: an iterator has given
//! it, and [`t`](Integration::t) and [`state`](Integration::state) tell how far the motion went. Where the rate cannot
//! be had in the middle of a step (a position that cannot be assembled, a number that is not finite), shorter steps are
//! tried down to rounding, so that the motion is followed up to the place where it ends; the rate's own error is then
//! returned.
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

use nalgebra::SVector;

pub use control::Tolerance;
pub use dense::Interpolant;
pub use dop853::Dop853;
pub use dopri5::Dopri5;
pub use event::{Action, Crossing};
pub use fixed::FixedStep;
pub use outputs::Outputs;
pub use run::{Counts, Integration, Step};
pub use system::{System, Watched, watched};
pub use tableau::{Control, Method, Stage, Tableau, Weights};

use crate::{Error, Real};

/// An integration by the method of Dormand and Prince of order 8(5,3): the choice where accuracy counts.
///
/// The system is a closure `FnMut(T, &SVector<T, N>) -> Result<SVector<T, N>, Error>` or a [`System`]; `start` is the
/// time and the state there.
///
/// # Errors
/// As [`Integration::new`].
pub fn dop853<S: System<T, N, K, C>, T: Real, const N: usize, const K: usize, const C: usize>(
    system: S,
    start: (T, SVector<T, N>),
    end: T,
    tolerance: Tolerance<T, N>,
) -> Result<Integration<Dop853, S, T, N, K, C>, Error> {
    Integration::new(system, start, end, tolerance)
}

/// An integration by the method of Dormand and Prince of order 5(4): the choice for tolerances down to 1e-6. Else as
/// [`dop853`].
///
/// # Errors
/// As [`Integration::new`].
pub fn dopri5<S: System<T, N, K, C>, T: Real, const N: usize, const K: usize, const C: usize>(
    system: S,
    start: (T, SVector<T, N>),
    end: T,
    tolerance: Tolerance<T, N>,
) -> Result<Integration<Dopri5, S, T, N, K, C>, Error> {
    Integration::new(system, start, end, tolerance)
}
