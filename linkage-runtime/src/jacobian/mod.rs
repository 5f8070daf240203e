//! The Jacobian [J A] of the constraints at a position, its singularities, and Newton's method.
//!
//! - [`Scales`]: scales of coordinates and residuals, which make all tests independent of units;
//! - [`Jacobian`] and [`Elimination`]: [J A], its pivots, its null space, and its linear systems;
//! - [`Blocks`]: the distance of each group from a singularity;
//! - [`contract()`]: undamped Newton's method from near a solution;
//! - [`root()`], [`first_not_positive`]: the point at which a function changes its sign;
//! - [`first_zero()`]: an interval around the first zero of a function with slopes, also of two zeros next to each other;
//! - [`first_resolved_zero()`]: the same of a function that may oscillate;
//! - [`ulp`]: tolerances in ulps.

mod blocks;
mod contract;
mod elimination;
mod first_zero;
mod resolved;
mod root;
mod scales;
pub mod ulp;
mod vector;

pub use crate::dense::Cholesky;
pub use blocks::Blocks;
pub use contract::{Iteration, contract, correction};
pub use elimination::{Elimination, Order};
pub use first_zero::{Sample, first_zero};
pub use resolved::first_resolved_zero;
pub use root::{first_not_positive, root};
pub use scales::{Jacobian, Scales, largest_entries, scale_or_one};
pub use vector::Vector;

use crate::Mechanism;

/// A vector of the coordinates of a mechanism.
pub type VectorOf<M> = Vector<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;

/// [J A] of a mechanism.
pub type JacobianOf<M> = Jacobian<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;

/// The scales of the coordinates and residuals of a mechanism.
pub type ScalesOf<M> = Scales<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;

/// The elimination of [J A] of a mechanism.
pub type EliminationOf<M> = Elimination<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;
