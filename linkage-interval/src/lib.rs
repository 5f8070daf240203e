//! Intervals of real numbers, velocities and accelerations of linkages over them, and certified motions.
//!
//! An [`Interval`] contains the exact value of a formula, whatever was rounded, as far as + - * / and the square root of
//! doubles round to nearest (IEEE 754). It depends on nothing else: no function of a C library.
//!
//! ```
//! use linkage_interval::Interval;
//! use linkage_runtime::Number;
//!
//! // 0.1 is not a double: `near` contains it, and the result three tenths.
//! let sum = Interval::near(0.1) + Interval::near(0.2);
//! assert!(sum.contains(0.3) && sum.width() < 1e-15);
//! ```

#![warn(missing_docs)]

pub mod certify;
pub mod enclose;
mod interval;
mod matrix;
mod ratio;
mod series;

pub use interval::Interval;
