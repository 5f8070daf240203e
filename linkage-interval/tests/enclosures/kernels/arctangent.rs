//! The error of the arctangent.
//!
//! q is the quotient of which it is computed, t = fl(above fl(1 / below)). Above and below are rounded where they are
//! difference and sum, 1 / below is and so is the product: |t - q| <= 4.1 u |q|, u = 2^-53, and without difference and
//! sum 2.1 u |q|. Then t + t_rest is q with a relative error far below u: above - t below is formed of four products of
//! halves of 26 and 27 bits, of which at least the first three are exact. The first difference is exact, since the
//! product is above within a part of 2^-24; the others are below 2^-24 |above|, so that each of four rounding errors is
//! below 2^-77 |above|; those of t below_rest and of the quotient by `below` are below 2^-100 |q|. Altogether the
//! relative error is below 2^-74. No step but t^2 underflows in the range of the function.
//!
//! atan(t + t_rest) differs from atan t + t_rest (1 - t^2) by t_rest t^4, and by t_rest^2 as |atan''| < 1; atan t from the
//! value of the polynomial by the error of that. By Taylor's formula
//! q - q^3/3 <= atan q <= q - q^3/3 + q^5/5.

use dashu_float::FBig;
use dashu_float::ops::Abs;
use dashu_float::round::mode::HalfEven;
use linkage_interval::Interval;
use linkage_runtime::__shared::{
    ARCTANGENT_COEFFICIENTS, ARCTANGENT_ERROR, QUARTER_PI, arctangent_polynomial, arctangent_rest, turned,
};
use linkage_runtime::Number;

use crate::kernels::approximation::{Approximation, big};
use crate::kernels::tracked::{Tracked, parts, power, within};

/// In ulp: documented by the module of the runtime.
const ULPS: f64 = 0.98;

/// The largest quotient: tan(pi/8), and the rounding errors of the test for it.
const LARGEST: f64 = 0.414_213_562_373_1;

/// (-1)^i / (2i + 3): the last, which bounds the remainder, is 0.1716^30 / 63.
fn series() -> Vec<FBig<HalfEven, 2>> {
    (0..31).map(|i| big(if i % 2 == 0 { 1.0 } else { -1.0 }) / big(f64::from(2 * i + 3))).collect()
}

/// The relative error in 2^-53, and that in ulp, of `eighths` pi/4 + atan t for t in an interval on one side of zero.
fn bounds(polynomial: &Approximation, eighths: f64, t: Interval) -> [f64; 2] {
    let (near, far) = (t.mignitude(), t.magnitude());
    let is_middle = eighths == 1.0 || eighths == 3.0;
    let t_rest = if is_middle { 4.1 } else { 2.1 } * 0.5 * f64::EPSILON * far;
    let computed = Tracked::run(|| {
        let coefficients = ARCTANGENT_COEFFICIENTS.map(Tracked::constant);
        let [t, t_rest] = [t, within(t_rest)].map(Tracked::exactly);
        let (eighths, quarter_pi) = (Tracked::constant(eighths), QUARTER_PI.map(Tracked::constant));
        // That of -t is the negative.
        let rest = arctangent_rest(t, t_rest, |z| arctangent_polynomial(z, coefficients));
        turned(t, rest, eighths, quarter_pi)
    });
    let of_polynomial = Interval::from(polynomial.bound(t * t));
    let rest = Interval::from(t_rest);
    let of_quarter = Interval::from(eighths * 2f64.powi(-107));
    let of_quotient = Interval::from(far) * 2f64.powi(-74).into();
    let approximation =
        (power(far, 3) * of_polynomial + rest * power(far, 4) + rest * rest + of_quarter + of_quotient).most();
    // The angle is monotone; t is q within 4.1 u.
    let quotient = |t: f64| Interval::from(t) * Interval::around(1.0, 1e-15).unwrap();
    let cubic = |q: Interval| q - q * q * q / 3.0.into();
    let least = if t.least() >= 0.0 {
        cubic(quotient(near))
    } else {
        let q = quotient(far);
        -cubic(q) - power(q.most(), 5) / 5.0.into()
    };
    let exact = (Interval::from(eighths) * Interval::pi() / 4.0.into() + least).least();
    let ulp = exact.next_up() - exact;
    let relative = (computed.error() + approximation) / exact * (1.0 + 1e-12);
    [relative / (0.5 * f64::EPSILON), 0.5 + (computed.inner_error() + approximation) / ulp * (1.0 + 1e-12)]
}

/// For every multiple of pi/4 to which an arctangent is added, and both signs; to 2^-40, below which the arctangent is t
/// but for 2^-80.
#[test]
fn arctangent() {
    let polynomial = Approximation::new(&ARCTANGENT_COEFFICIENTS, &series(), LARGEST * LARGEST + 1e-9);
    let quarter = QUARTER_PI.iter().fold(big(0.0), |sum, &part| sum + big(part));
    let pi = big(0.0).atan2(&big(-1.0));
    assert!((quarter - pi / big(4.0)).abs() <= big(2f64.powi(-107)));
    let small = (0..40).flat_map(|range| {
        let end = LARGEST * 2f64.powi(-range);
        parts(0.5 * end, end, if range < 3 { 64 } else { 16 }).map(|t| (0.0, t))
    });
    // Only 4 pi/4 - atan t occurs with 4.
    let others = parts(0.0, LARGEST, 128).flat_map(|t| {
        let signs = [1.0, 2.0, 3.0].map(|eighths| (eighths, t));
        signs.into_iter().chain([1.0, 2.0, 3.0, 4.0].map(|eighths| (eighths, -t)))
    });
    let most = small.chain(others).fold([0.0_f64; 2], |most, (eighths, t)| {
        let found = bounds(&polynomial, eighths, t);
        [most[0].max(found[0]), most[1].max(found[1])]
    });
    println!("arctangent: relative {} of 2^-53, {} ulp", most[0], most[1]);
    assert!(most[0] <= ARCTANGENT_ERROR);
    assert!(most[1] <= ULPS);
}
