//! Each elementary function of the language across each of its cuts, poles, kinks and edges: in value, in derivative and
//! in certificate, as an output and in an equation.
//!
//! The table of the compiler states these places. A function without a line here fails, and so does a place of a kind
//! that the function has not.

use linkage::certify::{Certify, CertifyError, Enclosure, Series};
use linkage::{Certifiable, Column, D, Formulas, Interval};
use linkage_compiler::graph::{Exception, Place, written};
use linkage_interpreter::{CertifiableAtRunTime, Mechanism, Program};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// The part of the line before a place and behind it that is taken.
const BEFORE: f64 = 0.5;
const BEHIND: f64 = 0.35;

/// Functions by their names and formulas, of one argument a + da s, or of two, b + db s the second.
const FORMULAS: [(&str, &str); 17] = [
    ("sin", "sin(a + da * s)"),
    ("cos", "cos(a + da * s)"),
    ("tan", "tan(a + da * s)"),
    ("asin", "asin(a + da * s)"),
    ("acos", "acos(a + da * s)"),
    ("atan", "atan(a + da * s)"),
    ("atan2", "atan2(a + da * s, b + db * s)"),
    ("sqrt", "sqrt(a + da * s)"),
    ("abs", "abs(a + da * s)"),
    ("exp", "exp(a + da * s)"),
    ("ln", "ln(a + da * s)"),
    ("hypot", "hypot(a + da * s, b + db * s)"),
    ("inverse", "1 / (a + da * s)"),
    ("modulus", "sqrt((a + da * s)^2)"),
    ("sign", "(a + da * s) / abs(a + da * s)"),
    ("norm", "norm((a + da * s, b + db * s))"),
    ("angle", "angle((b + db * s, a + da * s))"),
];

/// A function with its mechanisms, which are texts: as an output, as the right side of an equation, and in the equation of an
/// unknown.
struct Case {
    name: &'static str,
    output: Mechanism,
    equation: Mechanism,
    inverse: Mechanism,
}

impl Case {
    fn of(&(name, formula): &(&'static str, &str)) -> Self {
        let parameters = if formula.contains("db") { "a = 0, da = 0, b = 0, db = 0" } else { "a = 0, da = 0" };
        let compiled = |text: &str| {
            let text = format!("mechanism Function {{ param {parameters}; {text} derive intervals; }}");
            Program::compile(&text).unwrap_or_else(|messages| panic!("{text}: {messages:?}")).mechanisms()[0].clone()
        };
        Self {
            name,
            output: compiled(&format!("input t; unknown s; equation s = t; output f = {formula};")),
            equation: compiled(&format!("input s; unknown f; equation f = {formula};")),
            inverse: compiled(&format!("input f; unknown s; equation {formula} + s / 100 = f;")),
        }
    }

    /// All checks at a place.
    fn check(&self, line: &Line, exception: Exception) {
        line.with(&self.output, |m| output(m, line, exception));
        line.with(&self.equation, |m| equation(m, line, exception));
        line.with(&self.inverse, |m| inverse(m, line));
    }

    /// The certified extremes of the output along a whole line.
    fn certificate(&self, line: &Line) -> Enclosure {
        line.with(&self.output, |m| range(m, -BEFORE, -BEFORE, BEHIND).unwrap()[0])
    }
}

fn cases() -> Vec<Case> {
    FORMULAS.iter().map(Case::of).collect()
}

type AtRunTime<'p> = CertifiableAtRunTime<'p, D<1>>;

/// The name of a function, its value and its places.
type Composed = (&'static str, fn(&[f64]) -> f64, Vec<Place>);

/// Functions that are no rows of the table, but have such places: their values and places.
fn composed() -> [Composed; 5] {
    let places = |name: &str| written().find(|row| row.function.name() == name).unwrap().places.to_vec();
    let at_zero = |exception| vec![Place { exception, at: &[0.0], across: &[1.0] }];
    [
        ("inverse", |x| 1.0 / x[0], at_zero(Exception::Pole)),
        ("modulus", |x| x[0].abs(), at_zero(Exception::Kink)),
        ("sign", |x| x[0].signum(), at_zero(Exception::Cut)),
        ("norm", |x| x[0].hypot(x[1]), places("hypot")),
        ("angle", |x| x[0].atan2(x[1]), places("atan2")),
    ]
}

/// A function along a line of its arguments.
struct Line {
    value: fn(&[f64]) -> f64,
    at: Vec<f64>,
    across: Vec<f64>,
    name: &'static str,
}

impl Line {
    fn value(&self, s: f64) -> f64 {
        let arguments: Vec<f64> = self.at.iter().zip(&self.across).map(|(at, across)| at + s * across).collect();
        (self.value)(&arguments)
    }

    /// Calls a function with a mechanism whose parameters a, da, b, db are those of the line.
    fn with<R>(&self, of: &Mechanism, call: impl FnOnce(&AtRunTime<'_>) -> R) -> R {
        let all: Vec<f64> = self.at.iter().zip(&self.across).flat_map(|(&at, &across)| [at, across]).collect();
        let design = of.design().with_parameters(&all);
        let prepared = design.prepared().unwrap();
        let result = call(&prepared.certifiable().unwrap());
        assert_eq!(prepared.failure(), None);
        result
    }

    /// Places of the line on both sides of zero, denser next to it.
    fn samples() -> Vec<f64> {
        let dense = (0..400).map(|step| BEFORE * (f64::from(step) - 399.5) / 399.5);
        let near = (1..13).map(|digits| -10_f64.powi(-digits));
        let before: Vec<f64> = dense.chain(near).collect();
        before.iter().flat_map(|&s| [s, -s * BEHIND / BEFORE]).collect()
    }

    /// Difference quotients of neighbours on one side: by the mean-value theorem derivatives between them.
    fn slopes(&self, sides: &[f64]) -> Vec<f64> {
        let quotient = |side: f64, k: i32| {
            let [one, other] = [side * 0.9_f64.powi(k), side * 0.9_f64.powi(k + 1)];
            (self.value(one) - self.value(other)) / (one - other)
        };
        let all = sides.iter().flat_map(|&side| (0..60).map(move |k| quotient(side, k)));
        all.filter(|slope| slope.is_finite()).collect()
    }
}

/// True if a value is in an interval; the values of the samples have rounding errors of their own.
fn has(interval: Interval, value: f64, relative: f64) -> bool {
    let slack = relative * (1.0 + value.abs());
    interval.least() <= value + slack && interval.most() >= value - slack
}

const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// That of a quotient of differences of 1e-4 of the values.
const OF_SLOPES: f64 = 1e-10;

fn range<'p>(m: &AtRunTime<'p>, unknown: f64, from: f64, to: f64) -> Result<[Enclosure; 2], CertifyError<&'p str>> {
    let found = Certify::new(m).range(&position(unknown, from), to)?;
    let quantities = found.quantities();
    let value = quantities.as_slice().first().copied();
    let unknown = found.velocity_ratios()[0];
    Ok([value.unwrap_or(unknown), found.quantity_ratios().as_slice().first().copied().unwrap_or(unknown)])
}

fn position<'p>(unknown: f64, input: f64) -> <AtRunTime<'p> as linkage::Mechanism>::Coordinates {
    <AtRunTime<'p> as linkage::Mechanism>::coordinates(Column::from_slice(&[unknown]).unwrap(), [input].into())
}

/// An output over the place: all values on both sides are in the extremes, which are not sharp; nothing bounds the rate, but that
/// of an angle at pi, which has no jump.
fn output(m: &AtRunTime<'_>, line: &Line, exception: Exception) {
    let [value, rate] = range(m, -BEFORE, -BEFORE, BEHIND).unwrap();
    for s in Line::samples() {
        let sample = line.value(s);
        assert!(!sample.is_finite() || has(value.values(), sample, ROUNDING), "{} {s} {sample} {value:?}", line.name);
    }
    let has_rate = ["atan2", "angle"].contains(&line.name) && line.at != [0.0, 0.0];
    assert!(!value.is_sharp && rate.is_sharp == has_rate, "{} {value:?} {rate:?}", line.name);
    for slope in line.slopes(&[-BEFORE, BEHIND]) {
        assert!(has(rate.values(), slope, OF_SLOPES), "{} {slope} {rate:?}", line.name);
    }
    assert_eq!(rate.values().width().is_infinite(), !has_rate, "{} {rate:?}", line.name);
    // Of a quotient by zero nothing is known.
    let is_infinite = matches!(exception, Exception::Pole | Exception::Edge) || line.name == "sign";
    assert_eq!(value.values().width().is_infinite(), is_infinite, "{} {value:?}", line.name);
    // The formulas themselves, over boxes with the place inside, at each end of them, and outside of them.
    let m = m.over(m.parameters().map(|value| Series::constant(value.into())));
    for (from, to) in [(-BEFORE, BEHIND), (-BEFORE, 0.0), (0.0, BEHIND), (-BEFORE, -0.01), (0.01, BEHIND)] {
        let s = Series::line(Interval::new(from, to).unwrap(), Interval::from(1.0));
        let found = m.quantities(&Column::from_slice(&[s]).unwrap(), &Column::from([s]));
        let Series { value, first, .. } = found.as_slice()[0];
        for s in Line::samples().into_iter().filter(|&s| from <= s && s <= to) {
            let sample = line.value(s);
            assert!(!sample.is_finite() || has(value, sample, ROUNDING), "{} {s} {sample} {value:?}", line.name);
        }
        if from < 0.0 && to > 0.0 {
            assert!(first.width().is_infinite(), "{} {first:?}", line.name);
        }
        let sides: Vec<f64> =
            [(from < -0.1, -BEFORE), (to > 0.1, BEHIND)].iter().filter(|side| side.0).map(|side| side.1).collect();
        let slopes = line.slopes(&sides);
        let is_beside = from > 0.0 || to < 0.0;
        for slope in slopes.into_iter().filter(|_| !is_beside) {
            assert!(has(first, slope, OF_SLOPES), "{} {slope} {first:?}", line.name);
        }
    }
}

/// The right side of an equation over the place: the motion up to it is certified, and none over it.
fn equation(m: &AtRunTime<'_>, line: &Line, exception: Exception) {
    let start = line.value(-BEFORE);
    let up_to = range(m, start, -BEFORE, -0.01);
    assert!(up_to.is_ok(), "{} {:?}", line.name, up_to.err());
    let over = range(m, start, -BEFORE, BEHIND).err();
    let input = match over {
        Some(CertifyError::NoBounds { group: "f", input, .. }) => input,
        // The bounds grow before a pole.
        Some(CertifyError::Undecided { input, .. }) if exception == Exception::Pole => input,
        _ => panic!("{} {over:?}", line.name),
    };
    assert!(input.magnitude() < 1e-4, "{} {input:?}", line.name);
    if line.value(BEHIND).is_finite() {
        let back = range(m, line.value(BEHIND), BEHIND, -BEFORE).err();
        assert!(
            matches!(back, Some(CertifyError::NoBounds { .. } | CertifyError::Undecided { .. })),
            "{} {back:?}",
            line.name
        );
    }
}

/// A function of an unknown: a motion over the place has no certificate, neither as a function of
/// the input nor as a curve.
fn inverse(m: &AtRunTime<'_>, line: &Line) {
    let [start, near, limit] = [-BEFORE, -1e-3, -1e-9].map(|s| line.value(s) + s / 100.0);
    let has_pole = (line.value(-1e-12) - limit).abs() > 1.0;
    let beyond = if has_pole { 1e30 * limit } else { limit + (near - start).signum() };
    let position = position(-BEFORE, start);
    let certify = Certify::new(m).most_tests(120);
    let over = certify.range(&position, beyond).map(|found| found.inputs());
    assert!(over.is_err(), "{} {over:?}", line.name);
    let curve = certify.curve(&position).map(|curve| curve.boxes());
    assert!(curve.is_err(), "{} {curve:?}", line.name);
}

/// Each function of the language has a line here.
#[test]
fn all_functions_are_taken_across_their_places() {
    let names: Vec<&str> = FORMULAS.iter().map(|case| case.0).collect();
    let rows: Vec<&str> = written().map(|row| row.function.name()).collect();
    assert_eq!(names[..rows.len()], rows);
    let of_rows = written().map(|row| (row.function.name(), row.value, row.places.to_vec()));
    let mut count = 0;
    for ((name, value, places), case) in of_rows.chain(composed()).zip(cases()) {
        assert_eq!(name, case.name);
        for Place { exception, at, across } in places {
            let line = Line { value, at: at.to_vec(), across: across.to_vec(), name };
            case.check(&line, exception);
            count += 1;
        }
    }
    assert_eq!(count, 18);
}

/// The value at each place does what the table says.
#[test]
fn places_are_of_their_kind() {
    for row in written() {
        for &Place { exception, at, across } in row.places {
            let line = Line { value: row.value, at: at.to_vec(), across: across.to_vec(), name: row.function.name() };
            let f = |s: f64| line.value(s);
            let slope = |s: f64| (f(s) - f(s / 2.0)) / (s / 2.0);
            let is_right = match exception {
                Exception::Cut => (f(1e-9) - f(-1e-9)).abs() > 1.0,
                Exception::Pole => f(-1e-12).abs() > 2.0 * f(-1e-4).abs() && f(-1e-4).abs() > 2.0 * f(-0.1).abs(),
                Exception::Kink => (f(1e-9) - f(-1e-9)).abs() < 1e-8 && (slope(1e-9) - slope(-1e-9)).abs() > 1.0,
                Exception::Edge => f(-1e-9).is_finite() && f(1e-9).is_nan(),
            };
            assert!(is_right, "{} {exception:?} {at:?}", row.function.name());
        }
    }
}

/// A function is finite and smooth outside of its places: along random lines its extremes are sharp.
#[test]
fn functions_are_smooth_elsewhere() {
    let random = &mut SmallRng::seed_from_u64(44);
    for (row, case) in written().zip(&cases()).flat_map(|pair| [pair; 4]) {
        let is_finite = !row.may_be_undefined();
        for _ in 0..1000 {
            let arguments: Vec<f64> = (0..row.function.arity()).map(|_| random.random_range(-50.0..50.0)).collect();
            assert!(!is_finite || (row.value)(&arguments).is_finite(), "{} {arguments:?}", row.function.name());
        }
        // From 0.1 to 0.95 the arguments are at no place.
        let [at, across] = [0.6, 0.9]
            .map(|most| (0..row.function.arity()).map(|_| random.random_range(0.1..most)).collect::<Vec<_>>());
        let at: Vec<f64> =
            at.iter().zip(&across).map(|(&at, across): (&f64, _)| at.max(0.1 + BEFORE * across)).collect();
        let across = at
            .iter()
            .zip(&across)
            .map(|(at, &across): (_, &f64)| across.min((0.95 - at) / BEHIND).min((at - 0.1) / BEFORE))
            .collect();
        let line = Line { value: row.value, at, across, name: row.function.name() };
        let found = case.certificate(&line);
        let values: Vec<f64> =
            (0..=2000).map(|k| line.value(-BEFORE + (BEFORE + BEHIND) * f64::from(k) / 2e3)).collect();
        let [least, largest] = [f64::min, f64::max].map(|of| values.iter().copied().reduce(of).unwrap());
        assert!(found.is_sharp, "{} {found:?}", row.function.name());
        assert!(
            has(found.least, least, 1e-6) && has(found.largest, largest, 1e-6),
            "{} {found:?}",
            row.function.name()
        );
    }
}
