//! What the code emitted by `linkage!` stands on.
//!
//! - [`Mechanism`]: the trait that general algorithms take;
//! - [`Scene`]: the trait that integrators take;
//! - [`position`]: Newton's method with damping and honest failure;
//! - [`mod@limits`]: how far an input can go;
//! - [`continuation`]: a mechanism followed along its motion, through dead points and change points;
//! - [`accuracy`]: roads to the position by type, and what their digits cost;
//! - [`integrate`]: motions from differential equations, with events;
//! - [`contact`]: dry friction and stops;
//! - [`simulation`]: scenes in motion, through dead points and change points;
//! - [`Error`]: which mechanism, what residual, how near singular;
//! - [`singularity`]: singular configurations, and how accurate a position can be;
//! - [`derivation`]: the formulas behind the code, as data;
//! - [`drawing`]: the linkage as SVG;
//! - [`sheet`]: the derivation as HTML.

#![cfg_attr(not(feature = "std"), no_std)]
// Without elementary functions there is nothing; `linkage` says so.
#![cfg(any(feature = "std", feature = "libm"))]
#![warn(missing_docs)]

#[doc(hidden)]
pub mod __rt;
pub mod accuracy;
mod branch;
pub mod contact;
pub mod continuation;
pub mod derivation;
#[cfg(feature = "drawing")]
pub mod drawing;
mod equations;
mod equilibrium;
mod error;
mod inertia;
pub mod integrate;
pub mod limits;
mod linear;
mod mechanism;
mod motion;
mod newton;
pub mod position;
mod scalar;
mod scene;
#[cfg(feature = "sheet")]
pub mod sheet;
pub mod simulation;
mod sine;
pub mod singularity;
mod turn;

pub use branch::{Elbow, Side, Slider, Slope};
pub use contact::{Along, Contact, ContactLaw, Mode};
pub use equations::Equations;
pub use equilibrium::Balance;
pub use error::Error;
use error::finite;
pub use limits::Limits;
use linear::{Factorization, product_of_pivots, same_signs};
pub use mechanism::{Assembly, Group, Mechanism};
pub use motion::{OutputMotion, PointMotion};
pub use nalgebra;
pub use position::{Solution, newton};
pub use scalar::{Real, real};
pub use scene::{Coordinates, Energy, Inputs, Power, Scene, Unreduced};
