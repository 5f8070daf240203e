//! Position, velocity and acceleration in closed form as a person writes them for speed: link vectors instead of
//! directions, determinants from half chords, nothing computed twice.
//!
//! `checked` makes the checks of the emitted code and returns what it returns, directions included, or nothing instead of an
//! error; `bare` returns link vectors, and NaN and dead points go unnoticed. `at` starts from coordinates, with the sines of the emitted `motion`.

pub mod chain;
pub mod four_bar;
pub mod jansen;
pub mod slider_crank;
pub mod stephenson_iii;

use linkage::nalgebra::{Complex, UnitComplex};

pub type Vector = [f64; 2];

/// Products of squared lengths between this and its inverse neither overflow nor underflow.
pub const SMALLEST: f64 = 1e-62;

/// `None` if a check fails.
pub type Checked<T> = Option<T>;

/// The direction of a link with this inverse of its length.
pub fn direction([x, y]: Vector, inverse: f64) -> UnitComplex<f64> {
    UnitComplex::new_unchecked(Complex { re: x * inverse, im: y * inverse })
}

pub fn dot([a, b]: Vector, [c, d]: Vector) -> f64 {
    a * c + b * d
}

/// v turned by a right angle, times `by`.
pub fn turned([x, y]: Vector, by: f64) -> Vector {
    [-y * by, x * by]
}

pub fn plus([a, b]: Vector, [c, d]: Vector) -> Vector {
    [a + c, b + d]
}

pub fn minus([a, b]: Vector, [c, d]: Vector) -> Vector {
    [a - c, b - d]
}

pub fn times([x, y]: Vector, by: f64) -> Vector {
    [x * by, y * by]
}

/// The second derivative of a vector that turns: v turned by the acceleration, minus v times the squared rate.
pub fn bent(v: Vector, rate: f64, acceleration: f64) -> Vector {
    minus(turned(v, acceleration), times(v, rate * rate))
}

/// Two links between joints, V + W = D, and their motion.
#[derive(Clone, Copy)]
pub struct Dyad {
    pub first: Vector,
    pub second: Vector,
    /// The determinant V x W.
    pub determinant: f64,
    inverse: f64,
}

impl Dyad {
    /// The dyad of links p and q with V left of D, for the side 1, or right of it, for the side -1.
    #[inline(always)]
    pub fn new<const CHECKED: bool>(d: Vector, [p, q]: Vector, side: f64) -> Checked<Self> {
        let square = dot(d, d);
        let (sum, difference) = (p + q, p - q);
        let reach = sum * sum;
        let (low, high) = (reach - square, square - difference * difference);
        let product = low * high;
        if CHECKED
            && !(low > reach * (1.0 / 16.0)
                && high > square * (1.0 / 16.0)
                && square > f64::EPSILON * reach
                && product > SMALLEST
                && product < 1.0 / SMALLEST)
        {
            return None;
        }
        let root = product.sqrt();
        let along = square + sum * difference;
        let half = times(d, 0.5 / square);
        let across = times(half, side);
        let first = [along * half[0] - root * across[1], along * half[1] + root * across[0]];
        let determinant = (-0.5 * side) * root;
        // Of the determinant, without waiting for it.
        let inverse = (-2.0 * side) / root;
        Some(Self { first, second: minus(d, first), determinant, inverse })
    }

    /// The dyad of links with these vectors and this determinant, by a sine of a difference.
    #[inline(always)]
    pub fn at<const CHECKED: bool>([first, second]: [Vector; 2], determinant: f64, size: f64) -> Checked<Self> {
        if CHECKED && !(determinant.abs() > 8.0 * f64::EPSILON * size.abs() && determinant.is_finite()) {
            return None;
        }
        Some(Self { first, second, determinant, inverse: 1.0 / determinant })
    }

    /// The rates a and b with V' + W' = `d_rate`.
    #[inline(always)]
    pub fn rates(&self, d_rate: Vector) -> Vector {
        [dot(d_rate, times(self.second, self.inverse)), dot(d_rate, times(self.first, -self.inverse))]
    }

    /// The second derivatives of a and b with V'' + W'' = `d_acceleration`.
    #[inline(always)]
    pub fn accelerations(&self, [a, b]: Vector, d_acceleration: Vector) -> Vector {
        self.rates(plus(plus(d_acceleration, times(self.first, a * a)), times(self.second, b * b)))
    }
}

/// A vector at an angle with this sine and cosine.
pub fn at((sine, cosine): (f64, f64), length: f64) -> Vector {
    [cosine * length, sine * length]
}

/// An error if one of some accelerations is not finite: a position or a rate that is not makes them so.
#[inline(always)]
pub fn finite<const CHECKED: bool, const N: usize>(values: [f64; N]) -> Checked<()> {
    let sum: f64 = values.iter().sum();
    if CHECKED && !sum.is_finite() {
        return None;
    }
    Some(())
}
