//! Dynamics of planar linkages.
//!
//! - [`Scene`]: the trait of a mechanism with inertia and forces;
//! - [`simulation`]: integration of scenes, through dead points and change points;
//! - [`contact`]: dry friction and stops;
//! - [`integrate`]: solvers for ordinary differential equations, with events;
//! - [`MotionError`]: the error type of all of these.

#![cfg_attr(not(feature = "std"), no_std)]
// The crate is empty without `std` or `libm`; `linkage` then emits a `compile_error!`.
#![cfg(any(feature = "std", feature = "libm"))]
#![warn(missing_docs)]

#[doc(hidden)]
pub mod __rt;
pub mod contact;
mod energy;
mod equations;
mod equilibrium;
mod error;
mod inertia;
pub mod integrate;
mod reactions;
mod scene;
pub mod simulation;
mod unreduced;

pub use contact::{Bearing, Contact, ContactCoordinate, ContactLaw, Mode, ReactionRow};
pub use energy::{Energy, Power};
pub use equations::Equations;
pub use equilibrium::Balance;
pub use error::{CrossingRates, MotionError};
pub use scene::{
    Accelerations, Coordinates, Inputs, Kink, MotionErrorOf, NameOf, Prescribed, Rates, Scene, StateColumn, StateParts,
    StateRates, prescribed_after,
};
pub use unreduced::Unreduced;
