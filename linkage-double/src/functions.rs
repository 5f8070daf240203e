//! The elementary functions, each with a relative error of at most 2 ulp (2^-103). They begin with the value in doubles of
//! `libm`, which has the same bits on every target.

use core::f64::consts::{FRAC_2_PI, LN_2};

use nalgebra::ComplexField;

use super::DoubleDouble;

pub(super) const ZERO: DoubleDouble = constant(0.0, 0.0);
pub(super) const ONE: DoubleDouble = constant(1.0, 0.0);
pub(super) const PI: DoubleDouble = constant(core::f64::consts::PI, 1.224_646_799_147_353_2e-16);
pub(super) const E: DoubleDouble = constant(core::f64::consts::E, 1.445_646_891_729_250_2e-16);
pub(super) const LN_TWO: DoubleDouble = constant(LN_2, 2.319_046_813_846_299_6e-17);
pub(super) const LN_TEN: DoubleDouble = constant(core::f64::consts::LN_10, -2.170_756_223_382_249_4e-16);
pub(super) const INVERSE_PI: DoubleDouble = constant(core::f64::consts::FRAC_1_PI, -1.967_867_667_518_248_6e-17);
pub(super) const TWO_BY_ROOT_PI: DoubleDouble = constant(core::f64::consts::FRAC_2_SQRT_PI, 1.533_545_961_316_588e-17);

/// pi/2 in three doubles, to 2^-161.
const HALF_PI: [f64; 3] = [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// 1/n!; the first omitted term, (pi/4)^29/29!, is 2^-113.
const INVERSE_FACTORIALS: [DoubleDouble; 28] = {
    let mut inverse = [ONE; 28];
    let mut n = 1;
    while n < inverse.len() {
        inverse[n] = inverse[n - 1].over(constant(n as f64, 0.0));
        n += 1;
    }
    inverse
};

/// 2^51: beyond it the number of quarter turns, which is computed in doubles, may be off by one.
const LARGEST_ANGLE: f64 = 2_251_799_813_685_248.0;

const fn constant(high: f64, low: f64) -> DoubleDouble {
    DoubleDouble { high, low }
}

/// 2^exponent, exactly, as two factors that are in the range of doubles.
fn powers_of_two(exponent: i32) -> [f64; 2] {
    let half = exponent / 2;
    [half, exponent - half].map(|exponent| {
        let biased = 1023 + exponent.clamp(-1022, 1023);
        f64::from_bits(u64::from(biased.unsigned_abs()) << 52)
    })
}

/// x times 2^exponent.
fn scaled(x: DoubleDouble, exponent: i32) -> DoubleDouble {
    let [a, b] = powers_of_two(exponent);
    constant(x.high * a * b, x.low * a * b)
}

/// Converts an integral double in the range of `i32` to an integer.
fn integer(x: f64) -> Option<i32> {
    let integer = x as i32;
    (f64::from(integer) == x).then_some(integer)
}

/// The sum of x^n/n! for n from `first` to `last` in steps of `step`, with alternating signs if `sign` is -1, divided
/// by x^first; `power` is x^step.
#[inline(always)]
fn series(power: DoubleDouble, first: usize, step: usize, last: usize, sign: f64) -> DoubleDouble {
    let terms = INVERSE_FACTORIALS.get(first..=last).unwrap_or_default().iter().step_by(step).rev();
    terms.fold(ZERO, |sum, &term| term + sum * power * DoubleDouble::from(sign))
}

pub(super) fn sin_cos(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    if x.high.abs() >= LARGEST_ANGLE || x.high.is_nan() {
        return (f64::NAN.into(), f64::NAN.into());
    }
    // x = k pi/2 + r, |r| <= pi/4; each product is exact.
    let k = ComplexField::round(x.high * FRAC_2_PI);
    let r = HALF_PI.into_iter().fold(x, |rest, part| rest - DoubleDouble::product(k, part));
    let sine = r * series(r * r, 1, 2, 27, -1.0);
    let cosine = (ONE - sine * sine).root();
    match (k - 4.0 * ComplexField::floor(0.25 * k)) as u8 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// The angle computed in doubles, corrected by the tangent of the rotation from its direction to (x, y): the correction
/// is so small that angle and tangent are equal.
pub(super) fn atan2(y: DoubleDouble, x: DoubleDouble) -> DoubleDouble {
    let angle = DoubleDouble::from(libm::atan2(y.high, x.high));
    if (y.high == 0.0 && x.high >= 0.0) || !angle.high.is_finite() {
        return angle;
    }
    // x and y are scaled to about 1, so that no product overflows or underflows.
    let exponent = integer(-ComplexField::floor(libm::log2(y.high.abs().max(x.high.abs())))).unwrap_or(0);
    let (y, x) = (scaled(y, exponent), scaled(x, exponent));
    let (sine, cosine) = sin_cos(angle);
    let tangent = (y * cosine - x * sine) / (x * cosine + y * sine);
    angle + tangent
}

pub(super) fn asin(x: DoubleDouble) -> DoubleDouble {
    atan2(x, ((ONE - x) * (ONE + x)).root())
}

pub(super) fn acos(x: DoubleDouble) -> DoubleDouble {
    atan2(((ONE - x) * (ONE + x)).root(), x)
}

/// e^x - 1 for |x| <= 0.35, a little more than ln(2) / 2: the series at x / 16, then four doublings of the argument by
/// e^2x - 1 = m (m + 2), m = e^x - 1.
fn small_exp_m1(x: DoubleDouble) -> DoubleDouble {
    let part = scaled(x, -4);
    (0..4).fold(part * series(part, 1, 1, 18, 1.0), |m, _| m * (m + 2.0.into()))
}

pub(super) fn exp(x: DoubleDouble) -> DoubleDouble {
    // Beyond these limits the result overflows or underflows.
    if x.high.is_nan() || x.high > 709.8 {
        return (x.high + f64::INFINITY).into();
    }
    if x.high < -746.0 {
        return ZERO;
    }
    let k = ComplexField::round(x.high / LN_2);
    let rest = x - LN_TWO * k.into();
    scaled(small_exp_m1(rest) + ONE, integer(k).unwrap_or(0))
}

pub(super) fn exp_m1(x: DoubleDouble) -> DoubleDouble {
    if x.high.abs() <= 0.35 { small_exp_m1(x) } else { exp(x) - ONE }
}

/// The logarithm of x from its value `near` computed in doubles: near + ln(1 + q) = near + q - q^2/2, where
/// q = x / e^near - 1 is computed by `remainder`.
fn logarithm(near: f64, remainder: impl FnOnce(DoubleDouble) -> DoubleDouble) -> DoubleDouble {
    if !near.is_finite() {
        return near.into();
    }
    let near = DoubleDouble::from(near);
    let q = remainder(near);
    near + (q - q * q * 0.5.into())
}

pub(super) fn ln_1p(x: DoubleDouble) -> DoubleDouble {
    logarithm(libm::log1p(x.high), |near| {
        let m = exp_m1(near);
        (x - m) / (ONE + m)
    })
}

pub(super) fn ln(x: DoubleDouble) -> DoubleDouble {
    // Near 1 the subtraction of 1 is exact.
    if (0.7..1.4).contains(&x.high) {
        return ln_1p(x - ONE);
    }
    logarithm(libm::log(x.high), |near| x * exp(-near) - ONE)
}

pub(super) fn powi(x: DoubleDouble, n: i32) -> DoubleDouble {
    let (mut power, mut base, mut left) = (ONE, x, n.unsigned_abs());
    while left > 0 {
        if left & 1 == 1 {
            power *= base;
        }
        left >>= 1;
        if left > 0 {
            base *= base;
        }
    }
    if n < 0 { ONE / power } else { power }
}

/// x^exponent; for an integer exponent by multiplication.
pub(super) fn powf(x: DoubleDouble, exponent: DoubleDouble) -> DoubleDouble {
    match integer(exponent.high) {
        Some(n) if exponent.low == 0.0 => powi(x, n),
        _ if x.high == 0.0 => libm::pow(x.high, exponent.high).into(),
        _ => exp(ln(x) * exponent),
    }
}

/// The cube root: one step of Newton's method from that of the nearest double.
pub(super) fn cbrt(x: DoubleDouble) -> DoubleDouble {
    let root = libm::cbrt(x.high);
    if root == 0.0 || !root.is_finite() {
        return root.into();
    }
    let square = DoubleDouble::product(root, root);
    DoubleDouble::from(root) - (square * root.into() - x) / (square * 3.0.into())
}

pub(super) fn hypot(x: DoubleDouble, y: DoubleDouble) -> DoubleDouble {
    let size = x.high.abs().max(y.high.abs());
    if size == 0.0 || !size.is_finite() {
        return size.into();
    }
    let exponent = integer(ComplexField::floor(libm::log2(size))).unwrap_or(0);
    let (x, y) = (scaled(x, -exponent), scaled(y, -exponent));
    scaled((x * x + y * y).root(), exponent)
}

pub(super) fn sinh(x: DoubleDouble) -> DoubleDouble {
    let m = exp_m1(x);
    // Far below zero m + 1 = e^x loses its digits.
    if m.high.is_finite() && m.high > -0.9 { scaled(m + m / (m + ONE), -1) } else { scaled(exp(x) - exp(-x), -1) }
}

pub(super) fn tanh(x: DoubleDouble) -> DoubleDouble {
    // Beyond 40 it differs from 1 by less than 2^-114.
    if x.high.abs() > 40.0 {
        return x.high.signum().into();
    }
    let m = exp_m1(scaled(x, 1));
    m / (m + 2.0.into())
}

pub(super) fn asinh(x: DoubleDouble) -> DoubleDouble {
    let size = if x.high < 0.0 { -x } else { x };
    let value = ln_1p(size + size * size / (ONE + hypot(ONE, size)));
    if x.high < 0.0 { -value } else { value }
}

pub(super) fn floor(x: DoubleDouble) -> DoubleDouble {
    let high = ComplexField::floor(x.high);
    let low = if high == x.high { ComplexField::floor(x.low) } else { 0.0 };
    DoubleDouble::ordered(high, low)
}
