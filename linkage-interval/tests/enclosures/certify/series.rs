//! Series against identities and difference quotients.

use linkage_interval::Interval;
use linkage_interval::certify::Series;
use linkage_runtime::Number;

type Function = (&'static str, fn(Series<f64>) -> Series<f64>);

/// All functions of one variable, with 0 < x < 1 in all domains.
const FUNCTIONS: [Function; 18] = [
    ("square", Number::square),
    ("abs", |x| Number::abs(-x)),
    ("sqrt", Number::sqrt),
    ("exp", Number::exponential),
    ("ln", Number::logarithm),
    ("sine", Number::sine),
    ("cosine", Number::cosine),
    ("tan", Number::tangent),
    ("asin", Number::arcsine),
    ("acos", Number::arccosine),
    ("atan", Number::arctangent),
    ("arctangent of y", |x| x.arctangent2(Series::exactly(0.7))),
    ("arctangent of x", |x| Series::exactly(-0.7).arctangent2(x)),
    ("hypotenuse", |x| x.hypotenuse(x * x - Series::exactly(2.0))),
    ("product", |x| x * x * x),
    ("quotient", |x| (x + Series::one()) / (x * x + Series::exactly(0.3))),
    ("difference", |x| Series::pi() - x * x),
    ("negative", |x| -(x * x)),
];

/// x(t) = 0.4 + 0.9 t + 0.35 t^2 and its derivatives.
fn line(t: f64) -> f64 {
    0.4 + t * (0.9 + 0.35 * t)
}

/// Central differences with h = 2^-10: errors of h^2 / 12 times the fourth derivative, below 1e-4.
#[test]
fn derivatives_are_limits_of_difference_quotients() {
    const H: f64 = 1.0 / 1024.0;
    let x = Series { value: 0.4, first: 0.9, second: 0.7 };
    for (name, function) in FUNCTIONS {
        let found = function(x);
        let [before, at, after] = [-H, 0.0, H].map(|t| function(Series::constant(line(t))).value);
        assert_eq!(found.value, at, "{name}");
        let (first, second) = ((after - before) / (2.0 * H), (after - 2.0 * at + before) / (H * H));
        assert!((found.first - first).abs() < 1e-4, "{name}: {} {first}", found.first);
        assert!((found.second - second).abs() < 1e-3, "{name}: {} {second}", found.second);
    }
}

/// Over intervals each derivative contains that at every number inside.
#[test]
fn derivatives_over_an_interval_contain_those_inside() {
    let interval = |value: f64, radius: f64| Interval::around(value, radius).unwrap();
    let wide = Series { value: interval(0.4, 0.01), first: interval(0.9, 0.02), second: interval(0.7, 0.03) };
    type Wide = fn(Series<Interval>) -> Series<Interval>;
    type Thin = fn(Series<f64>) -> Series<f64>;
    let functions: [(Wide, Thin); 6] = [
        (Number::square, Number::square),
        (Number::sqrt, Number::sqrt),
        (Number::sine, Number::sine),
        (Number::cosine, Number::cosine),
        (|x| x * x / (x + Series::one()), |x| x * x / (x + Series::one())),
        (|x| x.hypotenuse(Series::one()), |x| x.hypotenuse(Series::one())),
    ];
    for (place, (of_interval, of_number)) in functions.into_iter().enumerate() {
        let all = of_interval(wide);
        for part in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            let one =
                of_number(Series { value: 0.4 + 0.01 * part, first: 0.9 - 0.02 * part, second: 0.7 + 0.03 * part });
            assert!(
                all.value.contains(one.value) && all.first.contains(one.first) && all.second.contains(one.second),
                "{place}"
            );
        }
    }
}

/// Nothing is known of the derivative of |x| over an interval that contains zero.
#[test]
fn magnitude_has_no_derivative_at_zero() {
    let x = Series::line(Interval::around(0.0, 1.0).unwrap(), Interval::one());
    assert_eq!(Number::abs(x).first, Interval::ENTIRE);
}
