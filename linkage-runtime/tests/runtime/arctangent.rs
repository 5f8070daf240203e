//! The errors of `Real::arctangent2` and `Real::hypotenuse`, against a reference in pairs of doubles.
//!
//! `SAMPLES=20000000 cargo test --release -p linkage-runtime --test runtime arctangent -- --nocapture` measures the errors that
//! the documentation of the modules lists.

use std::f64::consts::{FRAC_PI_4, PI};

use linkage_runtime::{Real, lane};
use num_dual::Dual64;

use crate::pairs::{Pair, float_ulps, plus, random, reference, times, two_product, ulps};

/// A little more than the largest errors found, in units of the last place; the proved bounds are 0.98 and 1.23.
const ANGLE_ULPS: f64 = 0.75;
const LENGTH_ULPS: f64 = 1.25;

/// The angle of (x, y): the library's, and the correction that turns it onto (x, y).
fn angle(y: f64, x: f64) -> Pair {
    let first = y.atan2(x);
    let [sine, cosine] = reference(first);
    let across = times([y, 0.0], cosine);
    let other = times([-x, 0.0], sine);
    let across = plus(plus(across, other[1]), other[0]);
    let along = x * cosine[0] + y * sine[0];
    plus([first, 0.0], (across[0] + across[1]) / along)
}

/// The error of a length: (found^2 - x^2 - y^2) / (2 found).
fn length_ulps(found: f64, x: f64, y: f64) -> f64 {
    let mut rest = two_product(found, found);
    for side in [x, y] {
        let [square, low] = two_product(side, side);
        rest = plus(plus(rest, -square), -low);
    }
    let place = found.next_up() - found;
    ((rest[0] + rest[1]) / (2.0 * found) / place).abs()
}

/// The largest errors of doubles and floats, with the arguments.
#[derive(Default)]
struct Largest([(f64, [f64; 2]); 4]);

impl Largest {
    fn at(&mut self, y: f64, x: f64) {
        let found = y.arctangent2(x);
        assert_eq!(found.to_bits(), (-(-y).arctangent2(x)).to_bits(), "{y:e}, {x:e}");
        let (v, u) = (y as f32, x as f32);
        let exact = f64::from(v).hypot(f64::from(u));
        let errors = [
            ulps(found, angle(y, x)),
            f64::from(float_ulps(v.arctangent2(u), f64::from(v).atan2(f64::from(u)))),
            length_ulps(x.hypotenuse(y), x, y),
            f64::from(float_ulps(u.hypotenuse(v), exact)),
        ];
        // The library computes the others.
        assert!(lane::has_arctangent2(y, x) && lane::has_arctangent2(v, u), "{y:e}, {x:e}");
        assert!(lane::has_hypotenuse(y, x) && lane::has_hypotenuse(v, u), "{y:e}, {x:e}");
        for (error, largest) in errors.into_iter().zip(&mut self.0) {
            assert!(error.is_finite(), "{y:e}, {x:e}");
            if error > largest.0 {
                *largest = (error, [y, x]);
            }
        }
    }

    fn check(&self, what: &str) {
        let [doubles, floats, lengths, float_lengths] = self.0;
        println!("{what}: angles {doubles:?} {floats:?}, lengths {lengths:?} {float_lengths:?}");
        assert!(doubles.0 <= ANGLE_ULPS && floats.0 <= ANGLE_ULPS, "{what}");
        assert!(lengths.0 <= LENGTH_ULPS && float_lengths.0 <= LENGTH_ULPS, "{what}");
    }
}

/// `SAMPLES=20000000` takes so many.
#[test]
fn within_the_promise() {
    let samples = linkage_trials::count("SAMPLES", 20_000, 20_000);
    let mut numbers = random(1);
    let mut next = || numbers.next().unwrap_or_default();
    let mut largest = Largest::default();
    for _ in 0..samples {
        let (sine, cosine) = (std::f64::consts::TAU * next()).sin_cos();
        let size = 0.5 + next();
        largest.at(size * sine, size * cosine);
    }
    largest.check("all directions");
    let mut largest = Largest::default();
    for _ in 0..samples {
        let mut side = || (next() - 0.5) * 2f64.powi((60.0 * (next() - 0.5)) as i32);
        largest.at(side(), side());
    }
    largest.check("magnitudes from 2^-30 to 2^30");
    let mut largest = Largest::default();
    for index in 0..samples {
        let (size, off) = (0.5 + next(), 2f64.powi(-(index as i32 % 54)) * (next() - 0.5));
        // Near an axis, a diagonal, and the limits of the reduction.
        let side = [0.0, size, size * 0.414_213_562_373_095_03][index % 3] * (1.0 + off)
            + if index % 3 == 0 { off } else { 0.0 };
        let (y, x) = if index % 2 == 0 { (side, size) } else { (size, side) };
        largest.at(y, if index % 4 < 2 { x } else { -x });
    }
    largest.check("near axes and diagonals");
}

/// By mpmath, rounded to pairs of doubles.
#[test]
fn reference_is_right() {
    let known = [
        (1.0, 1.0, [FRAC_PI_4, 3.061616997868383e-17]),
        (0.1, -3.0, [3.108271657711546, 1.405526079439615e-16]),
        (-2.5, 0.3, [-1.4513674007765582, 6.452806406452058e-17]),
        (1e-20, -1.0, [PI, 1.2245467991473532e-16]),
        (3e-09, 2.0, [1.5e-09, -1.125e-27]),
        (-0.4142135623730951, 1.0, [-0.3926990816987242, 5.069287735517835e-18]),
    ];
    for (y, x, [value, rest]) in known {
        let found = angle(y, x);
        let error = ((found[0] - value) + (found[1] - rest)).abs();
        assert!(error <= value.abs() * 2f64.powi(-79), "{y}, {x}: {found:?}, {value:e} + {rest:e}");
    }
}

macro_rules! special {
    ($name:ident, $float:ident) => {
        /// Axes, zeros, infinities and numbers that are not computed here have the bits of the library.
        #[test]
        fn $name() {
            let numbers = [
                0.0,
                $float::from_bits(1),
                $float::MIN_POSITIVE,
                1e-30,
                1.0,
                1e30,
                $float::MAX,
                $float::INFINITY,
                $float::NAN,
            ];
            let signed: Vec<$float> = numbers.into_iter().flat_map(|x| [x, -x]).collect();
            for &y in &signed {
                for &x in &signed {
                    let (found, expected) = (y.arctangent2(x), y.atan2(x));
                    let near = found.to_bits().abs_diff(expected.to_bits()) <= 1;
                    assert!(near || found.is_nan() && expected.is_nan(), "atan2({y:e}, {x:e}): {found:e} {expected:e}");
                    if x == 0.0 || y == 0.0 {
                        assert!(
                            found.to_bits() == expected.to_bits() || found.is_nan(),
                            "atan2({y:e}, {x:e}): {found:e}"
                        );
                    }
                    let (found, expected) = (x.hypotenuse(y), x.hypot(y));
                    let near = found.to_bits().abs_diff(expected.to_bits()) <= 1;
                    assert!(near || found.is_nan() && expected.is_nan(), "hypot({x:e}, {y:e}): {found:e} {expected:e}");
                }
            }
        }
    };
}

special!(special_doubles, f64);
special!(special_floats, f32);

/// Lengths that the plain formula does not serve: subnormal, very small and very large floats.
#[test]
fn extreme_lengths_of_floats() {
    let mut largest = (0.0, [0.0; 2]);
    for (mantissas, exponents) in random(7).zip(random(8)).zip(random(9).zip(random(10))).take(40_000) {
        let side = |part: f64, exponent: f64| ((1.0 + part) * 2f64.powi((277.0 * exponent) as i32 - 150)) as f32;
        let (x, y) = (side(mantissas.0, exponents.0), side(mantissas.1, exponents.1));
        // Of similar sides, too.
        for (x, y) in [(x, y), (x, side(mantissas.1, exponents.0))] {
            let exact = f64::from(x).hypot(f64::from(y));
            if exact > 0.0 && exact < f64::from(f32::MAX) {
                let error = float_ulps(x.hypotenuse(y), exact);
                largest = if error > largest.0 { (error, [x, y]) } else { largest };
            }
        }
    }
    println!("{largest:?}");
    assert!(f64::from(largest.0) <= LENGTH_ULPS, "{largest:?}");
    for (side, other) in [(f32::INFINITY, f32::NAN), (f32::NEG_INFINITY, 0.0), (f32::INFINITY, 1e-40)] {
        assert_eq!([side.hypotenuse(other), other.hypotenuse(side)], [f32::INFINITY; 2]);
    }
}

/// Every other scalar has its own functions.
#[test]
fn other_scalars() {
    for (y, x) in random(3).zip(random(4)).take(200) {
        let (y, x) = (Dual64::new(y, 0.3), Dual64::new(x, -0.7));
        assert_eq!(y.arctangent2(x), nalgebra_atan2(y, x));
        assert_eq!(x.hypotenuse(y), nalgebra_hypot(x, y));
    }
}

fn nalgebra_atan2<T: Real>(y: T, x: T) -> T {
    y.atan2(x)
}

fn nalgebra_hypot<T: Real>(x: T, y: T) -> T {
    x.hypot(y)
}

/// Powers of two change no digit.
#[test]
fn every_unit() {
    for (y, x) in random(5).zip(random(6)).take(500) {
        let (angle, length) = (y.arctangent2(x), x.hypotenuse(y));
        for unit in [2f64.powi(-880), 2f64.powi(-400), 2f64.powi(990)] {
            let (y, x) = (y * unit, x * unit);
            assert_eq!(
                [y.arctangent2(x).to_bits(), (x.hypotenuse(y) / unit).to_bits()],
                [angle, length].map(f64::to_bits)
            );
        }
        let (y, x) = (y as f32, x as f32);
        let (angle, length) = (y.arctangent2(x), x.hypotenuse(y));
        for unit in [2f32.powi(-80), 2f32.powi(95)] {
            let (y, x) = (y * unit, x * unit);
            assert_eq!(
                [y.arctangent2(x).to_bits(), (x.hypotenuse(y) / unit).to_bits()],
                [angle, length].map(f32::to_bits)
            );
        }
    }
}
