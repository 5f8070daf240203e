//! The closures near a position: what their derivatives say of it, and how they are closed.
//!
//! - [`Scales`]: sizes of coordinates and closures, so that no unit has a say in a verdict;
//! - [`Jacobian`] and [`Elimination`]: [J A], its pivots, what it leaves free, and solutions of it;
//! - [`Blocks`]: how near each group is to a singularity;
//! - [`contract()`]: the loops closed by Newton's method near a position;
//! - [`root()`]: where a number on the way changes its sign;
//! - [`rounding`]: what counts as rounding.

mod blocks;
mod cholesky;
mod contract;
mod elimination;
mod root;
pub mod rounding;
mod scales;
mod vector;

pub use blocks::Blocks;
pub use cholesky::Cholesky;
pub use contract::{Closing, contract, correction};
pub use elimination::{Elimination, Order};
pub use root::root;
pub use scales::{Jacobian, Scales, largest_entries, positive};
pub use vector::Vector;

use crate::Mechanism;

/// A vector of the coordinates of a mechanism.
pub type VectorOf<M> = Vector<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;

/// [J A] of a mechanism.
pub type JacobianOf<M> = Jacobian<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;

/// The sizes of the coordinates and closures of a mechanism.
pub type ScalesOf<M> = Scales<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;

/// The elimination of [J A] of a mechanism.
pub type EliminationOf<M> = Elimination<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;
