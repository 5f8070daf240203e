//! The complex numbers of a group, and how many an equation has.

use nalgebra::Complex;

/// A complex number.
pub type Number = Complex<f64>;

pub const ZERO: Number = Number { re: 0.0, im: 0.0 };
pub const ONE: Number = Number { re: 1.0, im: 0.0 };

/// The most columns of c: k and six directions.
pub const COLUMNS: usize = 7;
