//! Arctangent of y / x in the quadrant of (x, y), for `f64` and `f32`, without branches.
//!
//! One division: the quotient of the smaller by the larger magnitude, or near the diagonals that of their difference
//! by their sum, is below tan(pi/8). Its rounding error, found by Dekker's product, enters the result. No fused
//! multiply-add is used, so that every target computes the same bits.
//!
//! Largest errors found by `tests/arctangent.rs`, in ulp:
//!
//! | 2e7 arguments              | `f64` | `f32` |
//! |----------------------------|-------|-------|
//! | all directions             | 0.68  | 0.69  |
//! | magnitudes 2^-30 to 2^30   | 0.68  | 0.67  |
//! | near axes and diagonals    | 0.73  | 0.72  |
//!
//! For `f64` no error is larger than 0.98 ulp, or 1.25 2^-53 of the exact angle. `linkage-interval/tests/enclosures/kernels` proves
//! that from the rounding to nearest of + - * and /, as for the sine: the sum of the error of the quotient t + t_rest,
//! which is below 2^-74 of it, the error of the polynomial against the power series, the rounding errors of
//! `arctangent_rest` and `turned` over intervals that cover t, and what it leaves out, t_rest t^4 and t_rest^2.

use crate::native::{Arithmetic, Native};

/// An upper bound of the relative error of `arctangent2` for `f64`, if `is_regular`, in 2^-53: 1.244 is proved as the
/// module says.
pub const ARCTANGENT_ERROR: f64 = 1.25;

/// The polynomial of `f64`, by the Remez algorithm; the largest relative error of atan t is 2^-58.4.
pub const ARCTANGENT_COEFFICIENTS: [f64; 11] = [
    0.333_333_333_333_332,
    -0.199_999_999_999_540_85,
    0.142_857_142_802_487_5,
    -0.111_111_107_861_477_83,
    0.090_908_978_366_934_28,
    -0.076_920_616_409_417_69,
    0.066_631_204_230_199_41,
    -0.058_480_091_767_690_07,
    0.050_398_465_996_449_73,
    -0.038_078_346_848_112_996,
    0.017_922_306_047_841_733,
];

/// pi/4 of `f64` in two parts.
pub const QUARTER_PI: [f64; 2] = [f64::from_bits(0x3fe9_21fb_5444_2d18), 3.061_616_997_868_383e-17];

/// A scalar with an arctangent of this module.
pub(crate) trait Arctangent: Native {
    /// The least and largest magnitude, other than zero, that is computed here, the first also the least quotient: no
    /// intermediate result that matters overflows or underflows.
    const RANGE: [Self; 2];

    const TWO: Self;
    const FOUR: Self;

    /// pi/4 in two parts: the first has two bits less than the type, so that three times it is exact.
    const QUARTER_PI: [Self; 2];

    /// tan(pi/8)
    const MIDDLE: Self;

    /// The upper half of the digits.
    fn upper(self) -> Self;

    /// (t - atan t) / t^3, where `z` is t^2, for |t| <= tan(pi/8).
    fn polynomial(z: Self) -> Self;
}

impl Arctangent for f64 {
    // 2^-900 and 2^1000
    const RANGE: [Self; 2] = [Self::from_bits(0x07b0_0000_0000_0000), Self::from_bits(0x7e70_0000_0000_0000)];
    const TWO: Self = 2.0;
    const FOUR: Self = 4.0;
    const QUARTER_PI: [Self; 2] = QUARTER_PI;
    const MIDDLE: Self = 0.414_213_562_373_095_03;

    #[inline(always)]
    fn upper(self) -> Self {
        Self::from_bits(self.to_bits() & 0xffff_ffff_f800_0000)
    }

    #[inline(always)]
    fn polynomial(z: Self) -> Self {
        arctangent_polynomial(z, ARCTANGENT_COEFFICIENTS)
    }
}

impl Arctangent for f32 {
    // 2^-100 and 2^100
    const RANGE: [Self; 2] = [Self::from_bits(0x0d80_0000), Self::from_bits(0x7180_0000)];
    const TWO: Self = 2.0;
    const FOUR: Self = 4.0;
    const QUARTER_PI: [Self; 2] = [Self::from_bits(0x3f49_0fdc), Self::from_bits(0xb3ae_ef4c)];
    const MIDDLE: Self = 0.414_213_57;

    #[inline(always)]
    fn upper(self) -> Self {
        Self::from_bits(self.to_bits() & 0xffff_f000)
    }

    #[inline(always)]
    fn polynomial(z: Self) -> Self {
        /// By the Remez algorithm; the largest relative error of atan t is 2^-28.7.
        const COEFFICIENTS: [f32; 5] = [0.333_333_16, -0.199_984_9, 0.142_438_49, -0.105_959_95, 0.060_834_36];
        let [a, b, c, d, e] = COEFFICIENTS;
        let w = z * z;
        (a + z * b) + w * ((c + z * d) + w * e)
    }
}

/// True if `arctangent2` is right: both magnitudes and their quotient are zero or in `RANGE`, and not both are zero.
#[inline(always)]
pub(crate) fn is_regular<F: Arctangent>((y, x): (F, F)) -> bool {
    let [least, most] = F::RANGE;
    let (y, x) = (y.magnitude(), x.magnitude());
    let (small, large) = if y > x { (x, y) } else { (y, x) };
    let is_small_right = ((small >= least) & (small >= least * large)) | (small == F::ZERO);
    (large >= least) & (large <= most) & is_small_right
}

/// The angle of (x, y) with x from -pi to pi, if `is_regular`.
#[inline(always)]
pub(crate) fn arctangent2<F: Arctangent>((y, x): (F, F)) -> F {
    let (rise, run) = (y.magnitude(), x.magnitude());
    let is_steep = rise > run;
    let (small, large) = if is_steep { (run, rise) } else { (rise, run) };
    let is_middle = small > F::MIDDLE * large;
    // Difference and sum are rounded; what they lose is computed exactly, since `large` is the larger.
    let (difference, sum) = (large - small, large + small);
    let difference_rest = (large - difference) - small;
    let sum_rest = (large - sum) + small;
    let (above, above_rest) = if is_middle { (-difference, -difference_rest) } else { (small, F::ZERO) };
    let (below, below_rest) = if is_middle { (sum, sum_rest) } else { (large, F::ZERO) };
    // t + t_rest = above / below
    let inverse = F::ONE / below;
    let t = above * inverse;
    let (t_upper, below_upper) = (t.upper(), below.upper());
    let (t_lower, below_lower) = (t - t_upper, below - below_upper);
    let product_rest = ((above - t_upper * below_upper) - t_upper * below_lower) - t_lower * below_upper;
    let remainder = (product_rest - t_lower * below_lower) + (above_rest - t * below_rest);
    let t_rest = remainder * inverse;
    let rest = arctangent_rest(t, t_rest, F::polynomial);
    // The angle is `eighths` pi/4 plus or minus that.
    let eighths = if is_middle { F::ONE } else { F::ZERO };
    let eighths = if is_steep { F::TWO - eighths } else { eighths };
    let is_left = x < F::ZERO;
    let eighths = if is_left { F::FOUR - eighths } else { eighths };
    let is_opposed = is_steep != is_left;
    let (t, rest) = if is_opposed { (-t, -rest) } else { (t, rest) };
    turned(t, rest, eighths, F::QUARTER_PI).with_sign_of(y)
}

/// atan(t + t_rest) - t, in the arithmetic of floats or of their rounding errors.
#[inline(always)]
pub fn arctangent_rest<T: Arithmetic>(t: T, t_rest: T, polynomial: impl FnOnce(T) -> T) -> T {
    // The derivative of atan is 1 - t^2 to t^4.
    let z = t * t;
    t_rest - z * (t * polynomial(z) + t_rest)
}

/// `eighths` pi/4 + t + rest, as `arctangent_rest`.
#[inline(always)]
pub fn turned<T: Arithmetic>(t: T, rest: T, eighths: T, [quarter_pi, quarter_pi_rest]: [T; 2]) -> T {
    let base = eighths * quarter_pi;
    let angle = base + t;
    let angle_rest = ((base - angle) + t) + (eighths * quarter_pi_rest + rest);
    angle + angle_rest
}

/// The polynomial of `Arctangent` for `f64`.
#[inline(always)]
pub fn arctangent_polynomial<T: Arithmetic>(z: T, coefficients: [T; 11]) -> T {
    let [a, b, c, d, e, f, g, h, i, j, k] = coefficients;
    let w = z * z;
    let v = w * w;
    let first = (a + z * b) + w * (c + z * d);
    let second = (e + z * f) + w * (g + z * h);
    let third = (i + z * j) + w * k;
    first + v * (second + v * third)
}
