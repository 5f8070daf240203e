//! Linkages in motion.
//!
//! - [`Scene`]: a mechanism with forces, the trait that a simulation takes;
//! - [`simulation`]: scenes in motion, through dead points and change points;
//! - [`contact`]: dry friction and stops;
//! - [`integrate`]: motions from differential equations, with events;
//! - [`MotionError`]: why a motion cannot be computed.

#![cfg_attr(not(feature = "std"), no_std)]
// Without elementary functions there is nothing; `linkage` says so.
#![cfg(any(feature = "std", feature = "libm"))]
#![warn(missing_docs)]

#[doc(hidden)]
pub mod __rt;
pub mod contact;
mod equations;
mod equilibrium;
mod error;
mod inertia;
pub mod integrate;
mod scene;
pub mod simulation;

pub use contact::{Contact, ContactCoordinate, ContactLaw, Mode};
pub use equations::Equations;
pub use equilibrium::Balance;
pub use error::MotionError;
pub use scene::{Coordinates, Energy, Inputs, Power, Prescribed, Rates, Scene, StateColumn, Unreduced};
