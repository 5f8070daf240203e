//! Each operation against 400 bits: the exact arguments are anywhere within their bounds, and the exact result must be
//! within the bound of the result. Values are those of `f64`, and the bounds of exact arguments are not too large.
//!
//! ```text
//! EVALUATIONS=1000000 cargo test --release -p linkage-rounding --test operations -- --nocapture
//! ```

mod exact;

use exact::{Big, big, double, evaluate};
use linkage_rounding::Rounded;
use nalgebra::{ComplexField, RealField};
use num_traits::Signed;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// Operations of one or two arguments; what limits their arguments; the largest bound for exact arguments, in ulps.
const OPERATIONS: [(&str, Arguments, f64); 22] = [
    ("add", Arguments::Any, 0.5),
    ("sub", Arguments::Any, 0.5),
    ("mul", Arguments::Any, 1.0),
    ("div", Arguments::Any, 1.0),
    ("rem", Arguments::Similar, 0.0),
    ("mul_add", Arguments::Any, 2.0),
    ("sqrt", Arguments::Positive, 1.3),
    ("hypot", Arguments::Any, 2.1),
    ("atan2", Arguments::Any, 2.1),
    ("sin", Arguments::Angle, 2.1),
    ("cos", Arguments::Angle, 2.1),
    ("tan", Arguments::Angle, 2.1),
    ("asin", Arguments::Sine, 2.1),
    ("acos", Arguments::Sine, 2.1),
    ("atan", Arguments::Any, 2.1),
    ("exp", Arguments::Exponent, 2.1),
    ("exp_m1", Arguments::Exponent, 2.1),
    ("exp2", Arguments::Exponent, 2.1),
    ("ln", Arguments::Positive, 2.1),
    ("ln_1p", Arguments::Positive, 2.1),
    ("log2", Arguments::Positive, 2.1),
    ("powf", Arguments::Power, 2.1),
];

#[derive(Debug, Clone, Copy, PartialEq)]
enum Arguments {
    /// Every magnitude from the smallest to the largest double.
    Any,
    /// Ratios up to 1000.
    Similar,
    Positive,
    Angle,
    Sine,
    Exponent,
    Power,
}

fn evaluations() -> usize {
    let all: usize = linkage_trials::count("EVALUATIONS", 3_000, 3_000);
    all / OPERATIONS.len()
}

fn rounded(name: &str, x: Rounded, y: Rounded) -> Rounded {
    of(name, x, y)
}

/// The operation in any scalar.
fn of<T: RealField + Copy>(name: &str, x: T, y: T) -> T {
    match name {
        "add" => x + y,
        "sub" => x - y,
        "mul" => x * y,
        "div" => x / y,
        "rem" => x % y,
        "mul_add" => x.mul_add(y, x),
        "sqrt" => x.sqrt(),
        "hypot" => linkage_runtime::Real::hypotenuse(x, y),
        "atan2" => linkage_runtime::Real::arctangent2(x, y),
        "sin" => linkage_runtime::Real::sine(x),
        "cos" => linkage_runtime::Real::cosine(x),
        "tan" => linkage_runtime::Real::tangent(x),
        "asin" => linkage_runtime::Real::arcsine(x),
        "acos" => linkage_runtime::Real::arccosine(x),
        "atan" => linkage_runtime::Real::arctangent(x),
        "exp" => linkage_runtime::Real::exponential(x),
        "exp_m1" => x.exp_m1(),
        "exp2" => x.exp2(),
        "ln" => linkage_runtime::Real::logarithm(x),
        "ln_1p" => x.ln_1p(),
        "log2" => x.log2(),
        "powf" => x.powf(y),
        other => panic!("{other}"),
    }
}

/// Arguments: moderate, extreme, of few bits, nearly equal.
fn draw(random: &mut SmallRng, arguments: Arguments) -> [f64; 2] {
    let mut signed = |exponents: std::ops::Range<i32>| -> f64 {
        let size = random.random_range(1.0..2.0_f64) * 2_f64.powi(random.random_range(exponents));
        let size = if random.random_bool(0.1) { f64::from(size as f32) } else { size };
        if random.random_bool(0.5) { -size } else { size }
    };
    match arguments {
        Arguments::Any => {
            let [x, y] = match signed(0..3).abs() {
                0.0..2.0 => [signed(-3..3), signed(-3..3)],
                2.0..4.0 => [signed(-1022..1023), signed(-1022..1023)],
                _ => [signed(-40..40), signed(-1074..-1000)],
            };
            // Cancellation.
            let near = x * (1.0 + f64::EPSILON * signed(0..10).round());
            let kind = signed(0..4).abs();
            [
                x,
                if kind < 2.0 {
                    -near
                } else if kind < 2.1 {
                    0.0
                } else {
                    y
                },
            ]
        }
        Arguments::Similar => [signed(-3..10), signed(0..3)],
        Arguments::Positive => {
            let near_one = 1.0 + signed(-50..-1);
            [if signed(0..2) > 0.0 { near_one } else { signed(-1022..1023).abs() }, 1.0]
        }
        Arguments::Angle => {
            let turns = (signed(0..15) * 0.5).round() * std::f64::consts::FRAC_PI_2;
            [if signed(0..2) > 0.0 { turns } else { signed(-40..18) }, 1.0]
        }
        Arguments::Sine => {
            let x = signed(-30..-1);
            [if signed(0..2) > 0.0 { x } else { (1.0 - signed(-50..-1).abs()).copysign(x) }, 1.0]
        }
        Arguments::Exponent => [signed(-40..9), 1.0],
        Arguments::Power => [signed(-10..10).abs(), signed(-3..5)],
    }
}

/// A bound of zero, of some ulps, or comparable with the value.
fn bound(random: &mut SmallRng, value: f64) -> f64 {
    match random.random_range(0..4) {
        0 => 0.0,
        1 => value.abs() * f64::EPSILON * random.random_range(0.0..4.0),
        2 => value.abs() * 2_f64.powi(random.random_range(-40..0)),
        _ => value.abs() * 2_f64.powi(random.random_range(-2..2)),
    }
}

/// A number within the bound, often at its end.
fn within(random: &mut SmallRng, number: Rounded) -> Big {
    let part = if random.random_bool(0.5) { random.random_range(-1.0..1.0) } else { 1.0 };
    let part = if random.random_bool(0.5) { part } else { -part };
    big(number.value()) + big(number.error()) * big(part)
}

#[test]
fn results_are_within_their_bounds() {
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(53));
    for (name, arguments, ulps) in OPERATIONS {
        let (mut known, mut worst) = (0, 0.0_f64);
        for round in 0..evaluations() {
            let [x, y] = draw(&mut random, arguments);
            if !(x.is_finite() && y.is_finite()) {
                continue;
            }
            let mut error = |value: f64| if round % 2 == 0 { 0.0 } else { bound(&mut random, value) };
            let (x, y) = (Rounded::with_error(x, error(x)), Rounded::with_error(y, error(y)));
            let found = rounded(name, x, y);
            let plain = of(name, x.value(), y.value());
            let context = || format!("{name}({x:?}, {y:?}) = {found:?}");
            assert!(found.value().to_bits() == plain.to_bits() || plain.is_nan(), "{} is not {plain:e}", context());
            if !found.error().is_finite() {
                assert!(x.error() > 0.0 || y.error() > 0.0 || !plain.is_finite(), "{}", context());
                continue;
            }
            let (exact_x, exact_y) = (within(&mut random, x), within(&mut random, y));
            let Some(exact) = evaluate(name, &exact_x, &exact_y) else { continue };
            known += 1;
            let off = double(&(exact - big(found.value()))).abs();
            // The last of the 400 bits.
            let slack = 1e-110 * found.value().abs();
            assert!(off <= found.error() + slack, "{} is off by {off:e}", context());
            // A zero with a sign has the angle -pi, and the number zero pi.
            let is_cut = name == "atan2" && x.value() == 0.0 && x.value().is_sign_negative() && y.value() < 0.0;
            if x.error() == 0.0 && y.error() == 0.0 && !is_cut {
                // Near underflow and overflow the rounding error is not computed.
                let moderate = |number: Rounded| (1e-280..1e280).contains(&number.value().abs());
                let is_moderate = moderate(found) && [x, y].iter().all(|x| x.value() == 0.0 || moderate(*x));
                let most = if is_moderate { ulps + 1e-9 } else { ulps + 4.0 };
                assert!(found.ulps() <= most, "{}: {} ulp", context(), found.ulps());
            } else {
                worst = worst.max((off - slack) / found.error());
            }
        }
        println!("{name}: {known} results, at most {worst:.3} of the bound");
        assert!(known > evaluations() / 3, "{name}: {known}");
        // Bounds that are never approached are too large.
        assert!(worst > 0.3, "{name}: at most {worst} of the bound");
    }
}

/// Operations without a rounding error have none.
#[test]
fn exact_operations() {
    let [x, zero, one] = [0.1, 0.0, 1.0].map(Rounded::from);
    for exact in [x + zero, x * one, x - x, x * zero, x / one, zero / x, (one + one).sqrt() * zero, zero.sqrt()] {
        assert_eq!(exact.error(), 0.0, "{exact}");
    }
    let [five, twelve] = [5.0, 12.0].map(Rounded::from);
    assert_eq!((five * five + twelve * twelve).sqrt().error(), 0.0);
    assert!(five.hypot(twelve).ulps() < 1e-14 && zero.hypot(-x).error() == 0.0);
    assert_eq!(Rounded::from(2.0).powf(Rounded::from(-7.0)).error(), 0.0);
    assert_eq!(zero.sin_cos(), (zero, one));
    assert_eq!((zero.sin().error(), zero.cos().error()), (0.0, 0.0));
}

/// Functions that jump: each double within the bound of the argument has its result within that of the result.
#[test]
fn jumps() {
    type Jump = (&'static str, fn(Rounded) -> Rounded, fn(f64) -> f64);
    let jumps: [Jump; 8] = [
        ("floor", |x| x.floor(), f64::floor),
        ("ceil", |x| x.ceil(), f64::ceil),
        ("round", |x| x.round(), f64::round),
        ("trunc", |x| x.trunc(), f64::trunc),
        ("fract", |x| x.fract(), f64::fract),
        ("signum", |x| Signed::signum(&x), f64::signum),
        ("argument", |x| x.argument(), |x| if x >= 0.0 { 0.0 } else { std::f64::consts::PI }),
        ("copysign", |x| Rounded::from(3.0).copysign(x), |x| 3_f64.copysign(x)),
    ];
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(7));
    for (name, found, exact) in jumps {
        let mut moved = 0;
        for _ in 0..1000 {
            let near = f64::from(random.random_range(-3..4)) / 2.0 + random.random_range(-2.0..2.0) * f64::EPSILON;
            let number = if random.random_bool(0.5) { near } else { random.random_range(-3.0..3.0) };
            let number = Rounded::with_error(number, bound(&mut random, number.abs().max(f64::EPSILON)));
            let found = found(number);
            assert_eq!(found.value().to_bits(), exact(number.value()).to_bits(), "{name} of {number:?}");
            for part in [-1.0, -0.5, 0.5, 1.0] {
                let point = number.value() + part * number.error();
                // A point that is rounded may lie outside.
                if (point - number.value()).abs() > number.error() {
                    continue;
                }
                let off = exact(point) - found.value();
                moved += usize::from(off != 0.0);
                assert!(
                    off.abs() <= found.error() * (1.0 + f64::EPSILON),
                    "{name} of {number:?} is {found:?}, not {off} more"
                );
            }
        }
        assert!(moved > 100, "{name}: {moved}");
    }
}

/// An angle near the cut of atan2 may be on its other side.
#[test]
fn across_the_cut() {
    use std::f64::consts::{PI, TAU};
    let angle = |y: Rounded, x: f64| linkage_runtime::Real::arctangent2(y, Rounded::from(x));
    for y in [1e-20, -1e-20, 0.0] {
        let found = angle(Rounded::with_error(y, 1e-18), -1.0);
        assert!((TAU - 1e-15..TAU + 1e-9).contains(&found.error()), "{found:?}");
        // Not on the positive axis, and not away from the axis.
        assert!(angle(Rounded::with_error(y, 1e-18), 1.0).error() < 3e-18);
        assert!(angle(Rounded::with_error(y + 1e-10, 1e-18), -1.0).error() < 1e-15);
    }
    // The number zero has the angle pi; the zero with a sign has -pi.
    assert!(angle(Rounded::from(0.0), -1.0).error() < 1e-15);
    assert!((angle(Rounded::from(-0.0), -1.0).value() + PI).abs() < 1e-15);
    assert!(angle(Rounded::from(-0.0), -1.0).error() >= TAU - 1e-15);
}

/// Nothing is known of a quotient whose divisor may be zero, and of what follows from it.
#[test]
fn unknown() {
    let near = Rounded::with_error(1.0, 1.0);
    let unknown = Rounded::from(1.0) / near;
    assert_eq!((unknown.value(), unknown.error()), (1.0, f64::INFINITY));
    let zero = Rounded::from(0.0);
    for number in [
        unknown + near,
        unknown * zero,
        unknown.sqrt(),
        unknown.exp(),
        near.ln(),
        unknown.mul_add(zero, near),
        zero.sinh(),
    ] {
        assert_eq!(number.error(), f64::INFINITY, "{number}");
        assert!(number.is_finite());
    }
    // Sines and angles are bounded.
    assert!(unknown.sin().error() < 2.1 && unknown.atan2(near).error() < 6.3);
    assert_eq!(Rounded::from(f64::MAX).powi(2).error(), f64::INFINITY);
    // Poles and ends of domains within the bound.
    let near_to = |value: f64| Rounded::with_error(value, 1e-15);
    let pole = near_to(std::f64::consts::FRAC_PI_2);
    for number in [near_to(1.0).asin(), near_to(-1.0).acos(), pole.tan(), near_to(1e-16).ln(), near_to(1e-16).recip()] {
        assert_eq!(number.error(), f64::INFINITY, "{number}");
    }
    // The root of 1.1e-15, and of none below zero.
    assert!((2.3e-8..6e-8).contains(&near_to(1e-16).sqrt().error()));
    for error in [f64::NAN, -1.0] {
        assert_eq!(Rounded::with_error(1.0, error).error(), f64::INFINITY);
    }
}

/// A converted double may be a rounded constant; the given one is exact.
#[test]
fn constants() {
    let of = |value: f64| nalgebra::convert::<f64, Rounded>(value);
    for exact in [0.0, 1.0, -3.0, 0.375, 1e15, 1e22, 2_f64.powi(-1000)] {
        assert_eq!(of(exact).error() == 0.0, exact != 1e22, "{exact}");
    }
    // The double of ten digits ends in zeros by chance; it is 4e-18 off.
    let by_chance = of(0.297_514_004_4);
    assert!(0.297_514_004_4_f64.to_bits().trailing_zeros() >= 20 && by_chance.error() > 0.0);
    for exact in [0.5_f64.powi(24), 1.0 + 2_f64.powi(-10), 3.051_757_812_5e-5, 4095.0 * 2_f64.powi(-300)] {
        assert_eq!(of(exact).error(), 0.0, "{exact}");
    }
    let tenth = of(0.1);
    assert!(double(&(big(1.0) / big(10.0) - big(0.1))).abs() <= tenth.error() && tenth.ulps() < 1.0);
    assert_eq!(Rounded::from(0.1).error(), 0.0);
    let pi = Rounded::pi();
    assert!(1.224_646_799_147_353_2e-16 <= pi.error() && pi.ulps() < 1.0);
}

/// Comparisons are those of the values; a choice is off by the larger error, and a whole number by what the exact number
/// may have in its place.
#[test]
fn decisions() {
    let (small, large) = (Rounded::with_error(1.0, 5.0), Rounded::with_error(2.0, 1.0));
    assert!(small < large && small == Rounded::from(1.0));
    assert_eq!((RealField::max(small, large).value(), RealField::max(small, large).error()), (2.0, 5.0));
    assert_eq!(((-small).abs().error(), small.copysign(-large).value()), (5.0, -1.0));
    assert!((5.0..5.1).contains(&small.floor().error()) && (2.0..2.1).contains(&Signed::signum(&small).error()));
    assert_eq!(Rounded::with_error(1.5, 0.4).trunc().error(), 0.0);
    assert_eq!(format!("{small}"), "1 ± 5.0e0");
    assert_eq!(Rounded::with_error(1.0, f64::EPSILON).ulps(), 1.0);
    assert_eq!(Rounded::with_error(0.0, 3.0 * f64::from_bits(1)).ulps(), 3.0);
    assert_eq!(Rounded::with_error(f64::MAX, 2_f64.powi(970)).ulps(), 0.5);
    assert_eq!(Rounded::unknown(f64::NAN).ulps(), f64::INFINITY);
}
