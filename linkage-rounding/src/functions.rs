//! The bounds of the elementary functions. The value is that of the function of `f64`: of the runtime's `Real` where it has
//! one, else of the platform's.
//!
//! A differentiable function f of X, |X - x| <= e, obeys |f(X) - f(x)| <= e L, where L is the largest |f'| between x - e
//! and x + e. If the interval leaves the domain, nothing is known.

use core::f64::consts::{FRAC_PI_2, LN_2, PI};

use linkage_runtime::__shared::{ARCTANGENT_ERROR, HYPOTENUSE_ERROR, SINE_ERROR};
use linkage_runtime::{Real, lane};
use nalgebra::{ComplexField, RealField};

use crate::Rounded;
use crate::residual::{TINY, UNIT, of_length};
use crate::rules::times;

/// Relative error of `libm`'s and the platform's functions, in u: 1 ulp. This is an assumption. For exp, ln, pow, tan, asin,
/// acos, atan and their variants they are found to be better: `linkage-runtime/tests/runtime/elementary.rs`, and B. Gladman,
/// V. Innocente, J. Mather, P. Zimmermann, "Accuracy of Mathematical Functions in Single, Double, Double Extended, and
/// Quadruple Precision". For
/// the others, such as sinh, cbrt and log10, they are not, and nothing is known of the result.
const PLATFORM: f64 = 2.0;

/// 1 + 2^-40: covers the rounding errors of a slope. That of e^(x + e), the largest, is 2^-43, since |x| < 1024.
const SLOPE_MARGIN: f64 = 1.0 + 4096.0 * f64::EPSILON;

/// A value of a function with this relative error, of an argument that moves it by at most `moved`. A result of zero is
/// exact only if the argument is.
#[inline]
fn evaluated(value: f64, relative: f64, moved: f64) -> Rounded {
    Rounded::bounded(value, moved + (relative * UNIT * value.abs() + TINY))
}

/// A function of `libm` or of the platform with the largest slope over the argument's interval.
fn sloped(x: Rounded, value: f64, slope: impl FnOnce(f64, f64) -> f64) -> Rounded {
    // An exact argument has no interval, and a slope may be infinite at the end of the domain.
    if x.error == 0.0 {
        return evaluated(value, PLATFORM, 0.0);
    }
    let slope = slope(x.value, x.error);
    // Also false if the slope is NaN.
    if slope >= 0.0 {
        evaluated(value, PLATFORM, times(x.error, slope * SLOPE_MARGIN))
    } else {
        Rounded::unknown(value)
    }
}

/// 1 / distance, or NaN, for unknown, if the distance from a pole is not positive.
fn inverse(distance: f64) -> f64 {
    if distance > 0.0 { distance.recip() } else { f64::NAN }
}

/// A lower bound of 1 - |X|: 1 - |x| is rounded only if |x| is below 1/2, by at most u.
fn below_one(x: f64, e: f64) -> f64 {
    ((1.0 - x.abs()) - UNIT) - e
}

/// |sin X - sin x| = 2 |sin((X - x) / 2) cos((X + x) / 2)| <= e and <= e (|cos x| + e / 2); so for the cosine. No two
/// sines are farther apart than 2.
#[inline]
pub(crate) fn sine_cosine(x: Rounded) -> (Rounded, Rounded) {
    let (sine, cosine) = Real::sine_cosine(x.value);
    if x.value == 0.0 && x.error == 0.0 {
        return (sine.into(), cosine.into());
    }
    let relative = if lane::is_moderate(x.value) { SINE_ERROR } else { PLATFORM };
    let part = |value: f64, other: f64| {
        // The slope is itself rounded, by less than 4 u of itself, and e / 2 is more than that of e.
        let slope = (other.abs() + x.error).min(1.0);
        let moved = times(x.error, slope * SLOPE_MARGIN);
        evaluated(value, relative, if moved < 2.0 { moved } else { 2.0 })
    };
    (part(sine, cosine), part(cosine, sine))
}

/// tan' = 1 / cos^2, and |cos X| >= |cos x| - e.
pub(crate) fn tan(x: Rounded) -> Rounded {
    sloped(x, Real::tangent(x.value), |x, e| {
        let least = inverse(ComplexField::cos(x).abs() - e * SLOPE_MARGIN - 4.0 * UNIT);
        least * least
    })
}

/// asin' = 1 / sqrt((1 - x) (1 + x)); acos' is its negative.
fn slope_of_asin(x: f64, e: f64) -> f64 {
    ComplexField::sqrt(inverse(below_one(x, e) * (1.0 + (x.abs() - e).max(0.0))))
}

pub(crate) fn asin(x: Rounded) -> Rounded {
    sloped(x, Real::arcsine(x.value), slope_of_asin)
}

pub(crate) fn acos(x: Rounded) -> Rounded {
    sloped(x, Real::arccosine(x.value), slope_of_asin)
}

/// atan' = 1 / (1 + x^2)
pub(crate) fn atan(x: Rounded) -> Rounded {
    sloped(x, Real::arctangent(x.value), |x, e| {
        let least = (x.abs() - e).max(0.0);
        (1.0 + least * least).recip()
    })
}

/// The angle a between p = (x, y) and P obeys |sin a| = |p x (P - p)| / (|p| |P|) <= s, with
/// s = (|x| e_y + |y| e_x) / (|p| (|p| - d)) and d = |P - p| at most. If d < |p|, then |a| < pi/2, hence
/// |a| <= asin s <= s + (pi/2 - 1) s^3. If d >= |p|, P may have any direction: |a| <= pi. If P may lie across the negative
/// x axis, where the angle jumps, its angle may be any from -pi to pi.
pub(crate) fn atan2(y: Rounded, x: Rounded) -> Rounded {
    let value = Real::arctangent2(y.value, x.value);
    let relative = if lane::has_arctangent2(y.value, x.value) { ARCTANGENT_ERROR } else { PLATFORM };
    // The angle of the axis itself is pi, which a zero with a sign does not have.
    let is_on_axis = y.error == 0.0 && y.value.is_sign_positive();
    if x.value - x.error < 0.0 && y.value.abs() <= y.error && !is_on_axis {
        return evaluated(value, relative, (PI + value.abs()) * SLOPE_MARGIN);
    }
    if y.error == 0.0 && x.error == 0.0 {
        let is_zero = value == 0.0 && y.value == 0.0;
        return if is_zero { value.into() } else { evaluated(value, relative, 0.0) };
    }
    let cross = times(x.value.abs(), y.error) + times(y.value.abs(), x.error);
    let length = Real::hypotenuse(x.value, y.value) / SLOPE_MARGIN;
    let least = length - (x.error + y.error);
    let sine = if least > 0.0 && length.is_finite() { cross / length / least * SLOPE_MARGIN } else { 1.0 };
    let moved = if sine < 1.0 { sine + (FRAC_PI_2 - 1.0) * sine * sine * sine } else { PI };
    evaluated(value, relative, moved * SLOPE_MARGIN)
}

/// |P| - |p| = (P - p) (P + p) / (|P| + |p|) in magnitude at most (2 (|x| e_x + |y| e_y) + e_x^2 + e_y^2) / |p|, and at
/// most |P - p| <= e_x + e_y. The value z is off by |x^2 + y^2 - z^2| / (|p| + z), and by a proved bound.
pub(crate) fn hypot(x: Rounded, y: Rounded) -> Rounded {
    let value = Real::hypotenuse(x.value, y.value);
    if value == 0.0 && x.error == 0.0 && y.error == 0.0 {
        return value.into();
    }
    let least = value - (x.error + y.error);
    let across = times(x.value.abs(), x.error) + times(y.value.abs(), y.error);
    let squares = times(x.error, x.error) + times(y.error, y.error);
    // |P| + |p| >= 2 |p| - d
    let near = (2.0 * across + squares) / (value + least) * SLOPE_MARGIN;
    let far = x.error + y.error;
    let moved = if least > 0.0 && near < far { near } else { far };
    let proved = HYPOTENUSE_ERROR * UNIT * value + TINY;
    let rounding = match of_length(x.value, y.value, value) {
        Some(residual) => RealField::min(residual / (2.0 * value) * SLOPE_MARGIN, proved),
        // The magnitude of one side.
        None if x.value == 0.0 || y.value == 0.0 => 0.0,
        None => proved,
    };
    Rounded::bounded(value, moved + rounding)
}

macro_rules! platform_functions {
    ($($(#[$law:meta])* $name:ident $trait:ident::$of:ident |$x:ident, $e:ident| $slope:expr;)*) => {$(
        $(#[$law])*
        pub(crate) fn $name(x: Rounded) -> Rounded {
            sloped(x, $trait::$of(x.value), |$x: f64, $e: f64| $slope)
        }
    )*};
}

platform_functions! {
    /// exp' = exp
    exp Real::exponential |x, e| Real::exponential(x + e);
    /// (e^x - 1)' = e^x
    exp_m1 ComplexField::exp_m1 |x, e| Real::exponential(x + e);
    /// (2^x)' = 2^x ln 2
    exp2 ComplexField::exp2 |x, e| ComplexField::exp2(x + e) * LN_2;
    /// ln' = 1 / x
    ln Real::logarithm |x, e| inverse(x - e);
    /// ln(1 + x)' = 1 / (1 + x); 1 + x is rounded by at most half an ulp of the larger.
    ln_1p ComplexField::ln_1p |x, e| inverse((1.0 + x) - e - UNIT * (1.0 + x.abs()));
    /// log2' = 1 / (x ln 2)
    log2 ComplexField::log2 |x, e| inverse((x - e) * LN_2);
}

/// X^Y = x^y e^t with t = y ln(X/x) + (Y - y) ln X, |ln(X/x)| <= e1 / (|x| - e1), and |e^t - 1| <= |t| + t^2 if
/// |t| <= 1.
fn power(x: Rounded, y: Rounded, value: f64, relative: f64) -> Rounded {
    let turned = times(x.error, inverse(x.value.abs() - x.error));
    let by_base = if x.error == 0.0 { 0.0 } else { times(y.value.abs(), turned) };
    let by_exponent = if y.error == 0.0 {
        0.0
    } else {
        // A logarithm near zero is off by at most 2 u of itself, and the part of e1 is added.
        times(y.error, ComplexField::ln(x.value.abs()).abs() + if x.error == 0.0 { 0.0 } else { turned })
    };
    let t = (by_base + by_exponent) * SLOPE_MARGIN;
    if t <= 1.0 {
        evaluated(value, relative, times(value.abs(), t * (1.0 + t) * SLOPE_MARGIN))
    } else {
        Rounded::unknown(value)
    }
}

/// By the platform; a power of two with a whole exponent is compared with the exact one.
pub(crate) fn powf(x: Rounded, y: Rounded) -> Rounded {
    let value = ComplexField::powf(x.value, y.value);
    let is_exact = x.error == 0.0 && y.error == 0.0;
    if is_exact && x.value == 2.0 && y.value.abs() <= 1022.0 && y.value == ComplexField::trunc(y.value) {
        // The bits of the exponent.
        let exact = f64::from_bits(((y.value + 1023.0) as u64) << 52);
        return Rounded::with_error(value, (value - exact).abs());
    }
    power(x, y, value, PLATFORM)
}

/// By multiplications, each with a relative error of u, which a square doubles: at most |n| u together, and u for the
/// inverse. A power that is nearly infinite may be the inverse of one that has lost digits by underflow.
pub(crate) fn powi(x: Rounded, n: i32) -> Rounded {
    /// 2^1000
    const NEARLY_INFINITE: f64 = f64::from_bits(0x7e70_0000_0000_0000);
    match n {
        0 => Rounded::from(1.0),
        1 => x,
        2 => x.times(x),
        _ => {
            let value = ComplexField::powi(x.value, n);
            if n < 0 && value.abs() > NEARLY_INFINITE {
                return Rounded::unknown(value);
            }
            let count = f64::from(n.unsigned_abs());
            // Products of errors: (1 + u)^n - 1 <= n u (1 + n u) if n u <= 1.
            let relative = (count + 1.0) * (1.0 + 2.0 * count * UNIT);
            power(x, Rounded::from(f64::from(n)), value, relative)
        }
    }
}

/// log_b x = ln x / ln b in the platform's order.
pub(crate) fn log(x: Rounded, base: Rounded) -> Rounded {
    let value = ComplexField::log(x.value, base.value);
    let quotient = ln(x).over(ln(base));
    Rounded::with_error(value, quotient.error + (value - quotient.value).abs())
}
