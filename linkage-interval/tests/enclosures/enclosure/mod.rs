//! Every operation and function against 48 digits: the results for numbers inside are in the interval, and the interval
//! of a number is narrow.
//!
//! `EVALUATIONS=1000000 cargo test --release -p linkage-interval --test enclosures enclosure -- --nocapture` takes so many for each
//! and prints the widths that the documentation of the crate lists.

mod numbers;
mod precise;

use dashu_float::ops::Abs;
use linkage_interval::Interval;
use linkage_runtime::Number;

use numbers::Numbers;
use precise::{Big, big, doubles, encloses};

/// Evaluations in 48 digits of each function.
fn evaluations() -> usize {
    linkage_trials::count("EVALUATIONS", 100, 400)
}

fn interval([least, most]: [f64; 2]) -> Interval {
    Interval::new(least, most).unwrap()
}

type Bounds = fn(Interval, Interval) -> Interval;
type Exact = fn(&Big, &Big) -> Option<Big>;
type Random = fn(&mut Numbers) -> [[f64; 2]; 2];

/// Checks a function of two numbers, the second of which may be unused. `excess_allowed` is the number of
/// doubles between the bounds at a point, which is 0 if they are neighbours.
struct Case {
    name: &'static str,
    excess_allowed: i64,
    of_intervals: Bounds,
    /// `None` outside the domain.
    exact: Exact,
    numbers: Random,
}

impl Case {
    fn check(&self) {
        let mut random = Numbers::new(7);
        let mut largest = 0;
        // Four numbers inside each box.
        for _ in 0..evaluations() / 4 {
            let [a, b] = (self.numbers)(&mut random);
            let result = (self.of_intervals)(interval(a), interval(b));
            assert!(result.least() <= result.most(), "{}: {a:?}, {b:?}: {result:?}", self.name);
            assert!(result.least() < f64::INFINITY && result.most() > f64::NEG_INFINITY, "{}", self.name);
            for (x, y) in random.inside(a).into_iter().zip(random.inside(b)) {
                let Some(exact) = (self.exact)(&big(x), &big(y)) else { continue };
                assert!(encloses(result, &exact), "{}({a:?}, {b:?}): {x:e}, {y:e}: {exact}, {result:?}", self.name);
            }
            let (x, y) = (a[0], b[1]);
            let Some(exact) = (self.exact)(&big(x), &big(y)) else { continue };
            let at_point = (self.of_intervals)(x.into(), y.into());
            assert!(encloses(at_point, &exact), "{}({x:e}, {y:e}): {exact}, {at_point:?}", self.name);
            let excess = doubles(at_point.least(), at_point.most()) - 1;
            assert!(excess <= self.excess_allowed, "{}({x:e}, {y:e}): {exact}, {at_point:?}", self.name);
            largest = largest.max(excess);
            // The interval of a part is in that of the whole, but for the error of functions that are not rounded exactly.
            let part = Interval::new(at_point.least(), at_point.most()).unwrap();
            let beyond = doubles(part.least(), result.least()).max(doubles(result.most(), part.most()));
            assert!(beyond <= self.excess_allowed, "{}({x:e}, {y:e}): {part:?} {result:?}", self.name);
        }
        println!("{}: {largest} doubles between the bounds", self.name);
    }
}

fn any_two(random: &mut Numbers) -> [[f64; 2]; 2] {
    [random.pair(Numbers::mixed), random.pair(Numbers::mixed)]
}

#[test]
fn operators() {
    let case = |name, of_intervals: Bounds, exact: Exact, excess_allowed| {
        Case { name, excess_allowed, of_intervals, exact, numbers: any_two }.check();
    };
    // One more double where a product of halves could underflow or overflow.
    case("sum", |a, b| a + b, |a, b| Some(a + b), 0);
    case("difference", |a, b| a - b, |a, b| Some(a - b), 0);
    case("product", |a, b| a * b, |a, b| Some(a * b), 1);
    case("quotient", |a, b| a / b, |a, b| (*b != Big::ZERO).then(|| a / b), 1);
    case("square", |a, _| a.square(), |a, _| Some(a * a), 1);
    case("magnitude", |a, _| a.abs(), |a, _| Some(a.clone().abs()), 0);
    case("root", |a, _| a.sqrt(), |a, _| (*a >= Big::ZERO).then(|| a.sqrt()), 1);
    case("hypotenuse", |a, b| a.hypotenuse(b), |a, b| Some((a * a + b * b).sqrt()), 6);
}

fn angles(random: &mut Numbers) -> [[f64; 2]; 2] {
    [random.pair(Numbers::angle).map(|angle| angle.clamp(-1e5, 1e5)), [0.0; 2]]
}

#[test]
fn functions_of_angles() {
    let case = |name, of_intervals: Bounds, exact: Exact, excess_allowed| {
        Case { name, excess_allowed, of_intervals, exact, numbers: angles }.check();
    };
    case("sine", |a, _| a.sine(), |a, _| Some(a.sin()), 4);
    case("cosine", |a, _| a.cosine(), |a, _| Some(a.cos()), 4);
    // It is defined at every double, but an interval with a pole has no bounds.
    case("tangent", |a, _| a.tangent(), |a, _| Some(a.tan()), 10);
}

fn sines(random: &mut Numbers) -> [[f64; 2]; 2] {
    [random.pair(Numbers::sine).map(|sine| sine.clamp(-1.0, 1.0)), [0.0; 2]]
}

#[test]
fn angles_of_functions() {
    let case = |name, of_intervals: Bounds, exact: Exact, numbers: Random, excess_allowed| {
        Case { name, excess_allowed, of_intervals, exact, numbers }.check();
    };
    case("arcsine", |a, _| a.arcsine(), |a, _| Some(a.asin()), sines, 8);
    case("arccosine", |a, _| a.arccosine(), |a, _| Some(a.acos()), sines, 8);
    case("arctangent", |a, _| a.arctangent(), |a, _| Some(a.atan()), any_two, 4);
    let exact = |y: &Big, x: &Big| (*y != Big::ZERO || *x != Big::ZERO).then(|| y.atan2(x));
    case("angle", |y, x| y.arctangent2(x), exact, any_two, 4);
}

#[test]
fn exponential_and_logarithm() {
    let exponents = |random: &mut Numbers| {
        let number = |random: &mut Numbers| {
            let (some, any) = (random.between(-750.0, 720.0), random.mixed());
            if any.abs() < 1.0 { any } else { some }
        };
        [random.pair(number), [0.0; 2]]
    };
    let positive = |random: &mut Numbers| [random.pair(|random| random.mixed().abs().max(f64::from_bits(1))), [0.0; 2]];
    let case = |name, of_intervals: Bounds, exact: Exact, numbers: Random, excess_allowed| {
        Case { name, excess_allowed, of_intervals, exact, numbers }.check();
    };
    case("exponential", |a, _| a.exponential(), |a, _| Some(a.exp()), exponents, 4);
    case("logarithm", |a, _| a.logarithm(), |a, _| Some(a.ln()), positive, 6);
}

/// The operators round exactly between 2^-900 and 2^900: parts of the operands give parts of the results.
#[test]
fn parts_of_operands() {
    let mut random = Numbers::new(11);
    let mut nested = || {
        let [least, most] = random.pair(|random| random.between(-10.0, 10.0));
        let [.., one, other] = random.inside([least, most]);
        [[least, most], [one.min(other), one.max(other)]].map(interval)
    };
    for _ in 0..10 * evaluations() {
        let ([a, part_of_a], [b, part_of_b]) = (nested(), nested());
        let results = |a: Interval, b: Interval| [a + b, a - b, a * b, a / b, a.square(), a.sqrt(), a.abs()];
        for (part, whole) in results(part_of_a, part_of_b).into_iter().zip(results(a, b)) {
            assert!(part.is_within(whole) || whole == Interval::ENTIRE, "{a:?} {b:?}: {part:?} {whole:?}");
        }
    }
}
