//! The runtime library of the kinematics emitted by `linkage!`.
//!
//! - [`Mechanism`], [`Kinematic`]: the traits that every emitted mechanism implements;
//! - [`position`]: damped Newton's method, which returns an error if it does not converge;
//! - [`mod@limits`]: the range of an input on one assembly branch;
//! - [`continuation`]: path following through dead points and change points;
//! - `circuits`: the positions that are connected by motion, with `std`;
//! - `range_of_motion`: one motion between the ends of the input, with `std`;
//! - [`lanes`]: many positions at once;
//! - [`accuracy`]: position solvers selected by type, with their accuracy and time;
//! - [`PositionError`], [`PathError`], [`InputError`]: the errors, with mechanism, residual and distance from a
//!   singularity;
//! - [`singularity`]: singular configurations, and the attainable accuracy of a position;
//! - [`derivation`]: the formulas behind the code, as data;
//! - [`analysis`]: the numbers of an analysis by hand at a position.

#![cfg_attr(not(feature = "std"), no_std)]
// The crate is empty without elementary functions; `linkage` reports the missing feature.
#![cfg(any(feature = "std", feature = "libm"))]
#![warn(missing_docs)]

#[doc(hidden)]
pub mod __rt;
#[doc(hidden)]
pub mod __shared;
pub mod accuracy;
pub mod analysis;
mod arctangent;
mod bounded;
mod branch;
mod build;
mod chord;
#[cfg(feature = "std")]
pub mod circuits;
mod column;
pub mod continuation;
mod dense;
pub mod derivation;
mod dim;
mod elementary;
mod error;
pub mod extremes;
mod formulas;
mod group;
pub mod held;
mod hypotenuse;
mod implied;
#[doc(hidden)]
pub mod jacobian;
mod joints;
pub mod kinematic;
#[doc(hidden)]
pub mod lane;
pub mod lanes;
pub mod limits;
mod linear;
mod matrix;
mod mechanism;
#[doc(hidden)]
pub mod modes;
mod motion;
mod native;
mod newton;
mod number;
mod origin;
pub mod position;
#[cfg(feature = "std")]
pub mod range_of_motion;
mod ranges;
#[cfg(feature = "std")]
mod same_position;
mod scalar;
#[cfg(feature = "serde")]
mod serialised;
mod shown;
mod sine;
pub mod singularity;
pub mod skeleton;
mod turn;
mod wide;

pub use branch::{Assembled, Elbow, Side, Slider, Slope};
pub use build::Build;
pub use column::Column;
pub use dim::{Bounded, D, Dim, UpTo};
pub use error::{BorrowedName, InputError, InputValues, Name, PathError, PositionError};
pub use formulas::{Certifiable, Formulas};
pub use group::Group;
pub use joints::{Joint, JointForces};
pub use kinematic::Kinematic;
pub use limits::Limits;
pub use matrix::Matrix;
pub use mechanism::{Assembly, Branches, Mechanism, Named, PathErrorOf, PerInput, PerUnknown, PositionErrorOf};
pub use modes::AssemblyMode;
pub use motion::{OutputMotion, PointMotion};
pub use nalgebra;
pub use number::Number;
pub use position::{AnyBranch, Solution, newton, newton_any_branch};
pub use ranges::{RangeEnd, Ranged};
pub use scalar::{Real, real};
