//! Floats of 160 bits, 48 digits, with the trigonometry of dashu.

use std::cell::RefCell;
use std::collections::{HashMap, VecDeque};

use dashu_float::FBig;
use dashu_float::ops::Abs;
use dashu_float::round::mode::HalfEven;
use linkage_compiler::graph::{Function, Number, operation};

pub type Big = FBig<HalfEven, 2>;

/// Bits of every operation.
pub const PRECISION: usize = 160;

/// A double, exactly.
pub fn big(value: f64) -> Big {
    Big::try_from(value).expect("a finite number").with_precision(PRECISION).value()
}

pub fn pi() -> Big {
    big(0.0).atan2(&big(-1.0))
}

/// Cosine and sine of one angle.
type Direction = (Big, Big);

/// An angle, to a double and in full, and its direction.
type Known = (f64, Big, Direction);

thread_local! {
    static RECENT: RefCell<VecDeque<Known>> = const { RefCell::new(VecDeque::new()) };
    static TABLE: RefCell<HashMap<i64, Direction>> = RefCell::new(HashMap::new());
    static INVERSE_FACTORIALS: Vec<Big> = inverse_factorials();
}

/// 1, 1/2, 1/6, ...: down to the first that is below the last digit of a sum that begins with 1, at an angle of 2^-11.
fn inverse_factorials() -> Vec<Big> {
    let next = |(n, value): &(i32, Big)| Some((n + 1, value / big(f64::from(n + 1))));
    std::iter::successors(Some((0, big(1.0))), next).map(|(_, value)| value).take(20).collect()
}

/// Cosine and sine by addition to those of an angle nearby: dashu's, which cost more than all else, are computed at
/// multiples of 2^-10, each once. An iterate is added to the one before.
pub fn direction(angle: &Big) -> Direction {
    const STEPS: f64 = 1024.0;
    let double = angle.double();
    RECENT.with_borrow_mut(|recent| {
        let near = recent.iter().find(|known| (known.0 - double).abs() < 1e-9 || known.1 == *angle);
        let value = if let Some((_, from, direction)) = near {
            if from == angle {
                return direction.clone();
            }
            turned(direction, &(angle - from))
        } else {
            let nearest = (double * STEPS).round();
            let from = big(nearest / STEPS);
            TABLE.with_borrow_mut(|table| {
                let known = table.entry(nearest as i64).or_insert_with(|| {
                    let (sine, cosine) = from.sin_cos();
                    (cosine, sine)
                });
                turned(known, &(angle - &from))
            })
        };
        recent.push_front((double, angle.clone(), value.clone()));
        recent.truncate(32);
        value
    })
}

/// A direction turned by an angle of at most 2^-11, whose sine and cosine are Taylor series.
fn turned((cosine, sine): &Direction, angle: &Big) -> Direction {
    let size = angle.double().abs();
    if size == 0.0 {
        return (cosine.clone(), sine.clone());
    }
    // The first negligible power of the angle.
    let bits = (PRECISION + 16) as f64;
    let terms = ((bits / -size.log2()).ceil() as usize + 1).min(19);
    INVERSE_FACTORIALS.with(|factors| {
        let square = angle * angle;
        let series = |from: usize| {
            let powers = (from..=terms.max(from)).step_by(2).collect::<Vec<_>>();
            let last = factors[powers[powers.len() - 1]].clone();
            powers[..powers.len() - 1].iter().rev().fold(last, |sum, &n| &factors[n] - &square * sum)
        };
        let (c, s) = (series(0), angle * series(1));
        (cosine * &c - sine * &s, sine * &c + cosine * &s)
    })
}

/// The scalar that a tape is evaluated in.
pub trait Scalar: Clone {
    fn number(value: Number) -> Self;
    fn of(value: f64) -> Self;
    fn pi() -> Self;
    fn add(&self, other: &Self) -> Self;
    fn multiply(&self, other: &Self) -> Self;
    fn negate(&self) -> Self;
    fn power(&self, exponent: i32) -> Self;
    fn call(function: Function, arguments: &[Self]) -> Self;
    fn double(&self) -> f64;
}

impl Scalar for f64 {
    fn number(value: Number) -> Self {
        value.to_f64()
    }
    fn of(value: f64) -> Self {
        value
    }
    fn pi() -> Self {
        std::f64::consts::PI
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn multiply(&self, other: &Self) -> Self {
        self * other
    }
    fn negate(&self) -> Self {
        -self
    }
    fn power(&self, exponent: i32) -> Self {
        self.powi(exponent)
    }
    fn call(function: Function, arguments: &[Self]) -> Self {
        (operation(function).value)(arguments)
    }
    fn double(&self) -> f64 {
        *self
    }
}

impl Scalar for Big {
    fn number(value: Number) -> Self {
        let integer = |value: i64| Self::from(value).with_precision(PRECISION).value();
        match value {
            Number::Ratio(numerator, 1) => integer(numerator),
            Number::Ratio(numerator, denominator) => integer(numerator) / integer(denominator),
            Number::Float(value) => big(value),
        }
    }
    fn of(value: f64) -> Self {
        big(value)
    }
    fn pi() -> Self {
        pi()
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn multiply(&self, other: &Self) -> Self {
        self * other
    }
    fn negate(&self) -> Self {
        -self.clone()
    }
    fn power(&self, exponent: i32) -> Self {
        let power = (1..exponent.abs()).fold(self.clone(), |power, _| &power * self);
        if exponent < 0 { big(1.0) / power } else { power }
    }
    fn call(function: Function, arguments: &[Self]) -> Self {
        let x = &arguments[0];
        match function {
            Function::Sin => direction(x).1,
            Function::Cos => direction(x).0,
            Function::Tan => x.tan(),
            Function::Asin => x.asin(),
            Function::Acos => x.acos(),
            Function::Atan => x.atan(),
            Function::Atan2 => x.atan2(&arguments[1]),
            Function::Sqrt => x.sqrt(),
            Function::Abs => x.clone().abs(),
            Function::Exp => x.exp(),
            Function::Ln => x.ln(),
            Function::Hypot => (x * x + &arguments[1] * &arguments[1]).sqrt(),
            Function::IfNonzero => arguments[if x.double() == 0.0 { 2 } else { 1 }].clone(),
        }
    }
    fn double(&self) -> f64 {
        self.to_f64().value()
    }
}
