//! The errors of the functions that are `libm`'s, against 31 digits, and for comparison those of the standard library's.
//!
//! `SAMPLES=200000 cargo test --release -p linkage-runtime --test runtime elementary -- --nocapture` prints the errors that the
//! page on accuracy of the manual lists.

use linkage_double::DoubleDouble;
use linkage_runtime::Real;
use nalgebra::ComplexField;

use crate::pairs::{float_ulps, random, ulps};

/// No function may be worse.
const MOST_ULPS: f64 = 1.0;

/// A function over doubles, floats and 31 digits, and the ranges of its arguments.
struct Row {
    name: &'static str,
    double: fn(f64) -> f64,
    single: fn(f32) -> f32,
    exact: fn(DoubleDouble) -> DoubleDouble,
    ranges: &'static [Range],
}

/// Arguments evenly from the first to the second number, or with evenly distributed exponents.
enum Range {
    Even(f64, f64),
    Powers(i32, i32),
}

use Range::{Even, Powers};

const ROWS: [Row; 8] = [
    Row {
        name: "tangent",
        double: Real::tangent,
        single: Real::tangent,
        exact: ComplexField::tan,
        ranges: &[Even(-0.8, 0.8), Even(-10.0, 10.0), Even(-1e5, 1e5), Powers(-300, -1)],
    },
    Row {
        name: "arcsine",
        double: Real::arcsine,
        single: Real::arcsine,
        exact: ComplexField::asin,
        ranges: &[Even(-1.0, 1.0), Powers(-300, -1)],
    },
    Row {
        name: "arccosine",
        double: Real::arccosine,
        single: Real::arccosine,
        exact: ComplexField::acos,
        ranges: &[Even(-1.0, 1.0), Powers(-60, -1)],
    },
    Row {
        name: "arctangent",
        double: Real::arctangent,
        single: Real::arctangent,
        exact: ComplexField::atan,
        ranges: &[Even(-3.0, 3.0), Even(-100.0, 100.0), Powers(-300, 300)],
    },
    Row {
        name: "exponential",
        double: Real::exponential,
        single: Real::exponential,
        exact: ComplexField::exp,
        ranges: &[Even(-1.0, 1.0), Even(-60.0, 60.0), Even(-700.0, 700.0), Powers(-60, -1)],
    },
    Row {
        name: "logarithm",
        double: Real::logarithm,
        single: Real::logarithm,
        exact: ComplexField::ln,
        ranges: &[Even(0.5, 2.0), Even(0.99, 1.01), Even(0.0, 100.0), Powers(-300, 300)],
    },
    Row {
        name: "sine beyond 1e5",
        double: Real::sine,
        single: Real::sine,
        exact: ComplexField::sin,
        ranges: &[Even(1.001e5, 1e6), Even(1e6, 1e12)],
    },
    Row {
        name: "cosine beyond 1e5",
        double: Real::cosine,
        single: Real::cosine,
        exact: ComplexField::cos,
        ranges: &[Even(1.001e5, 1e6), Even(1e6, 1e12)],
    },
];

impl Range {
    fn arguments(&self, count: usize) -> impl Iterator<Item = f64> {
        random(11).zip(random(12)).take(count).map(|(part, other)| match *self {
            Even(from, to) => from + (to - from) * part,
            Powers(from, to) => {
                let exponent = (f64::from(from) + f64::from(to - from) * other).floor();
                (1.0 + part) * 2f64.powi(exponent as i32)
            }
        })
    }
}

fn exact_ulps(found: f64, exact: DoubleDouble) -> f64 {
    ulps(found, [exact.high(), exact.low()])
}

#[test]
fn errors() {
    let count = linkage_trials::count("SAMPLES", 4000, 4000);
    for row in &ROWS {
        let mut largest = [(0.0, 0.0); 3];
        for x in row.ranges.iter().flat_map(|range| range.arguments(count)) {
            let single = x as f32;
            // What a float rounds to is none of its arguments.
            let (exact, of_single) = ((row.exact)(x.into()), (row.exact)(f64::from(single).into()).high());
            let is_single = of_single.abs() > f64::from(f32::MIN_POSITIVE) && of_single.abs() < f64::from(f32::MAX);
            let platform = platform(row.name, std::hint::black_box(x));
            let errors = [
                exact_ulps((row.double)(x), exact),
                if is_single { float_ulps((row.single)(single), of_single).into() } else { 0.0 },
                exact_ulps(platform, exact),
            ];
            for (error, largest) in errors.into_iter().zip(&mut largest) {
                assert!(error.is_finite(), "{} {x:e}", row.name);
                *largest = if error > largest.0 { (error, x) } else { *largest };
            }
        }
        let [double, single, platform] = largest;
        println!(
            "| {} | {:.3} at {:e} | {:.3} at {:e} | {:.3} |",
            row.name, double.0, double.1, single.0, single.1, platform.0
        );
        assert!(double.0 <= MOST_ULPS && single.0 <= MOST_ULPS, "{}: {double:?} {single:?}", row.name);
    }
}

/// The function of the standard library, for comparison.
fn platform(name: &str, x: f64) -> f64 {
    match name {
        "tangent" => x.tan(),
        "arcsine" => x.asin(),
        "arccosine" => x.acos(),
        "arctangent" => x.atan(),
        "exponential" => x.exp(),
        "logarithm" => x.ln(),
        "sine beyond 1e5" => x.sin(),
        _ => x.cos(),
    }
}
