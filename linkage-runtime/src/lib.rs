//! What the kinematics emitted by `linkage!` stands on.
//!
//! - [`Mechanism`]: the trait that general algorithms take;
//! - [`position`]: Newton's method with damping and honest failure;
//! - [`mod@limits`]: how far an input can go;
//! - [`continuation`]: a mechanism followed along its motion, through dead points and change points;
//! - [`accuracy`]: roads to the position by type, and what their digits cost;
//! - [`PositionError`], [`PathError`], [`InputError`]: which mechanism, what residual, how near singular;
//! - [`singularity`]: singular configurations, and how accurate a position can be;
//! - [`derivation`]: the formulas behind the code, as data.

#![cfg_attr(not(feature = "std"), no_std)]
// Without elementary functions there is nothing; `linkage` says so.
#![cfg(any(feature = "std", feature = "libm"))]
#![warn(missing_docs)]

#[doc(hidden)]
pub mod __rt;
#[doc(hidden)]
pub mod __shared;
pub mod accuracy;
mod branch;
mod column;
pub mod continuation;
pub mod derivation;
mod dim;
mod error;
#[doc(hidden)]
pub mod jacobian;
pub mod limits;
mod linear;
mod matrix;
mod mechanism;
mod motion;
mod newton;
pub mod position;
mod scalar;
mod sine;
pub mod singularity;
mod turn;

pub use branch::{Elbow, Side, Slider, Slope};
pub use column::Column;
pub use dim::{D, Dim};
pub use error::{InputError, PathError, PositionError};
pub use limits::Limits;
pub use matrix::Matrix;
pub use mechanism::{Assembly, Group, Mechanism, PerInput, PerUnknown};
pub use motion::{OutputMotion, PointMotion};
pub use nalgebra;
pub use position::{AnyBranch, Solution, newton, newton_any_branch};
pub use scalar::{Real, real};
