//! What the code emitted by `linkage!` stands on.
//!
//! - [`Mechanism`]: the trait that general algorithms take;
//! - [`position`]: Newton's method with damping and honest failure;
//! - [`limits`]: how far an input can go;
//! - [`integrate`]: motions from differential equations, with events;
//! - [`Error`]: which mechanism, what residual, how near singular;
//! - [`derivation`]: the formulas behind the code, as data;
//! - [`drawing`]: the linkage as SVG;
//! - [`sheet`]: the derivation as HTML.

#![cfg_attr(not(feature = "std"), no_std)]
#![warn(missing_docs)]

mod branch;
pub mod derivation;
#[cfg(feature = "drawing")]
pub mod drawing;
mod error;
pub mod integrate;
pub mod limits;
mod linear;
mod mechanism;
mod motion;
mod newton;
pub mod position;
mod scalar;
#[cfg(feature = "sheet")]
pub mod sheet;
mod sine;

pub use branch::{Elbow, Side, Slider, Slope, chord, existing, side_of};
pub use error::{Error, finite, finite_matrix};
pub use limits::{Bound, Limits, Search, limits};
pub use linear::{Factorization, product_of_pivots, regular, same_signs};
pub use mechanism::Mechanism;
pub use motion::{OutputMotion, PointMotion};
pub use nalgebra;
pub use position::{Solution, newton, newton_group};
pub use scalar::{Real, real, unit};
