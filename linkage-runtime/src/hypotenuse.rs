//! The root of a sum of two squares, for `f64` and `f32`, without branches. The largest error found by
//! `tests/arctangent.rs` in 6e7 arguments is 1.20 ulp.
//!
//! None is larger than 1.23 ulp. Let u be half an ulp of 1, and scale the sides by a power of two so that the sum of
//! squares s is from 1 to 4 and an ulp of the root is 2u. The rounding errors of the squares and their sum divided by
//! 2 sqrt s are those of the root, to which u is added. A number from 1/2 to 1, 1 to 2 or 2 to 4 has a rounding error of
//! at most u/2, u or 2u. So the quotient is largest for squares of 2 and 1: (2u + u + 2u) / (2 sqrt 3) = 1.444u. For a
//! square of 2 and one of 1/2 it is 1.424u, for two of 1 or for one of 2 alone 1.415u, and for s below 2 at most 1.021u.

use nalgebra::ComplexField;

use crate::native::Native;

/// An upper bound of the relative error of the hypotenuse of two `f64`, in 2^-53, unless it overflows or is below the
/// least normal number, where a rounding error of 2^-1075 is added.
///
/// Let u' = u / (1 + u), u = 2^-53, which bounds the relative error of every rounded result. The sum of squares has two
/// such errors, whose root has about one, and the root is rounded: (1 + u')^2 - 1 = (2u + 3u^2) / (1 + u)^2, which is
/// below 2u by nearly u^2. In the range a square that underflows adds at most 2^-115 to that.
pub const HYPOTENUSE_ERROR: f64 = 2.0;

/// A scalar with a hypotenuse of this module.
pub(crate) trait Length: Native + ComplexField {
    /// The least and largest sum of squares that is computed here: it does not overflow, and a square that underflows
    /// does not matter.
    const RANGE: [Self; 2];

    /// A power of two and its inverse, which bring other numbers into the range.
    const SCALES: [Self; 2];
}

impl Length for f64 {
    // 2^-960 and 2^1020
    const RANGE: [Self; 2] = [Self::from_bits(0x03f0_0000_0000_0000), Self::from_bits(0x7fb0_0000_0000_0000)];
    // 2^600 and 2^-600
    const SCALES: [Self; 2] = [Self::from_bits(0x6570_0000_0000_0000), Self::from_bits(0x1a70_0000_0000_0000)];
}

impl Length for f32 {
    // 2^-90 and 2^120
    const RANGE: [Self; 2] = [Self::from_bits(0x1280_0000), Self::from_bits(0x7b80_0000)];
    // 2^80 and 2^-80
    const SCALES: [Self; 2] = [Self::from_bits(0x6780_0000), Self::from_bits(0x1780_0000)];
}

/// True if `hypotenuse` is right: the sum of squares is in `RANGE`.
#[inline(always)]
pub(crate) fn is_regular<F: Length>((x, y): (F, F)) -> bool {
    let [least, most] = F::RANGE;
    let square = x * x + y * y;
    (square >= least) & (square <= most)
}

/// sqrt(x^2 + y^2), if `is_regular`.
#[inline(always)]
pub(crate) fn hypotenuse<F: Length>((x, y): (F, F)) -> F {
    (x * x + y * y).sqrt()
}

/// The hypotenuse of other sides, in other units: the same digits in every one. It is as accurate as `hypotenuse`, and
/// half an ulp less where it is subnormal.
pub(crate) fn scaled<F: Length>((x, y): (F, F)) -> F {
    let [large, small] = F::SCALES;
    let (scale, back) = if x * x + y * y < F::ONE { (large, small) } else { (small, large) };
    let (x, y) = (x * scale, y * scale);
    if is_regular((x, y)) {
        return hypotenuse((x, y)) * back;
    }
    // Subnormal floats are scaled twice.
    let sides = (x * scale, y * scale);
    if is_regular(sides) { hypotenuse(sides) * back * back } else { of_no_number(x, y) }
}

/// The hypotenuse of two zeros, or of sides of which one is infinite or NaN; an infinite side is longer than any other.
fn of_no_number<F: Length>(x: F, y: F) -> F {
    let (x, y) = (x.magnitude(), y.magnitude());
    let infinity = F::of_bits(F::EXPONENT);
    if (x == infinity) | (y == infinity) { infinity } else { x + y }
}
