//! The errors of sine and cosine.
//!
//! The computed value differs from that of exact operations by the rounding errors; that value differs from sin(r - t) by
//! the error of the polynomial, by t (cos r - 1 + r^2/2) <= t r^4/24 and by t^2/2; and r - t differs from the angle by
//! the relative error of the reduction, which is at least that of the sine. For the cosine the second is
//! t (r - sin r) <= t r^3/6. By Taylor's formula sin x >= x - x^3/6 and cos x >= 1 - x^2/2.
//!
//! An error of a result just below a power of two that is rounded up to it is the error before the rounding: so half an
//! ulp of the exact value is added to that error, never more.

use std::f64::consts::FRAC_PI_4;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use linkage_interval::Interval;
use linkage_runtime::__shared::{SINE_COEFFICIENTS, SINE_ERROR, sine_kernel, sine_polynomials};

use crate::kernels::approximation::{Approximation, big};
use crate::kernels::reduction::Reduction;
use crate::kernels::tracked::{Tracked, half_ulp, parts, power, within};

/// In ulp: documented by the module of the runtime.
const ULPS: [f64; 2] = [0.89, 0.84];

/// The largest |r|: the rounding error of x 2/pi moves k by less than 2^-36 from the nearest integer.
const LARGEST: f64 = FRAC_PI_4 + 1e-9;

/// (-1)^i / (2i + first)!
fn series(first: u32) -> Vec<FBig<HalfEven, 2>> {
    let factorial = |n: u32| (1..=n).fold(big(1.0), |product, n| product * big(f64::from(n)));
    (0..12).map(|i| big(if i % 2 == 0 { 1.0 } else { -1.0 }) / factorial(2 * i + first)).collect()
}

struct Proof {
    reduction: Reduction,
    /// Those of (r - sin r) / r^3 and (1 - r^2/2 - cos r) / r^4.
    polynomials: [Approximation; 2],
}

/// Bounds of the errors of sine and cosine.
struct Bounds {
    relative: [f64; 2],
    ulps: [f64; 2],
}

impl Proof {
    fn new() -> Self {
        let most = LARGEST * LARGEST + 1e-9;
        let [sine, cosine] = SINE_COEFFICIENTS;
        let negated = series(4).into_iter().map(|term| -term).collect::<Vec<_>>();
        let polynomials = [Approximation::new(&sine, &series(3), most), Approximation::new(&cosine, &negated, most)];
        Self { reduction: Reduction::new(), polynomials }
    }

    /// For r in an interval of positive numbers.
    fn bounds(&self, r: Interval) -> Bounds {
        let most = r.most();
        let z = r * r;
        let t = half_ulp(r) + (1.0 + 1e-9) * self.reduction.largest_tail.min(self.reduction.tail * most * 1.01);
        let (sine, cosine) = Tracked::run(|| {
            let constants = [0.5, 1.0].map(Tracked::constant);
            let coefficients = SINE_COEFFICIENTS.map(|row| row.map(Tracked::constant));
            sine_kernel(Tracked::exactly(r), Tracked::exactly(within(t)), constants, |z, w| {
                sine_polynomials(z, w, coefficients)
            })
        });
        let of_t = Interval::from(t) * Interval::from(t);
        let [to_sine, to_cosine] = self.polynomials.each_ref().map(|polynomial| Interval::from(polynomial.bound(z)));
        let approximations = [
            power(most, 3) * to_sine + Interval::from(t) * power(most, 4) / 24.0.into() + of_t,
            power(most, 4) * to_cosine + Interval::from(t) * power(most, 3) / 6.0.into() + of_t,
        ];
        let (from, to) = (Interval::from(r.least()) - t.into(), Interval::from(most) + t.into());
        let exact = [from - power(from.most(), 3) / 6.0.into(), Interval::from(1.0) - to * to / 2.0.into()];
        let mut bounds = Bounds { relative: [0.0; 2], ulps: [0.0; 2] };
        for (i, computed) in [sine, cosine].iter().enumerate() {
            let (exact, approximation) = (exact[i].least(), approximations[i].most());
            let relative = |error: f64| ((error + approximation) / exact + self.reduction.error) * (1.0 + 1e-12);
            bounds.relative[i] = relative(computed.error()) / (0.5 * f64::EPSILON);
            let ulp = exact.next_up() - exact;
            bounds.ulps[i] = 0.5 + relative(computed.inner_error()) * exact / ulp;
        }
        bounds
    }
}

/// From pi/4 down by powers of two to 2^-62, where the sine is r and the cosine 1 but for less than 2^-100.
#[test]
fn sine_and_cosine() {
    let proof = Proof::new();
    let ranges = (0..62).map(|power| {
        let most = if power == 0 { LARGEST } else { 2f64.powi(-power) };
        (2f64.powi(-power - 1), most, if power < 3 { 128 } else { 16 })
    });
    let mut most = Bounds { relative: [0.0; 2], ulps: [0.0; 2] };
    for (least, end, count) in ranges {
        for r in parts(least, end, count) {
            let bounds = proof.bounds(r);
            for i in 0..2 {
                most.relative[i] = most.relative[i].max(bounds.relative[i]);
                most.ulps[i] = most.ulps[i].max(bounds.ulps[i]);
            }
        }
    }
    println!("sine, cosine: relative {:?} of 2^-53, {:?} ulp", most.relative, most.ulps);
    assert!(most.relative.iter().all(|&bound| bound <= SINE_ERROR));
    assert!(most.ulps.iter().zip(ULPS).all(|(&bound, ulps)| bound <= ulps));
}
