//! Random expressions of a place and an angle: as text of the language, and as numbers of any kind.

use std::fmt;

use nalgebra::ComplexField;
use rand::Rng;
use rand::rngs::SmallRng;

/// An expression of `x` and `phi`.
#[derive(Debug, Clone)]
pub enum Expression {
    X,
    Phi,
    Number(f64),
    Sum(Box<[Self; 2]>),
    Product(Box<[Self; 2]>),
    Quotient(Box<[Self; 2]>),
    Call(&'static str, Vec<Self>),
}

use Expression::{Call, Number, Phi, Product, Quotient, Sum, X};

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            X => f.write_str("x"),
            Phi => f.write_str("phi"),
            Number(value) => write!(f, "({value})"),
            Sum(of) => write!(f, "({} + {})", of[0], of[1]),
            Product(of) => write!(f, "{}*{}", of[0], of[1]),
            Quotient(of) => write!(f, "{}/({})", of[0], of[1]),
            Call(name, of) => {
                let all: Vec<String> = of.iter().map(ToString::to_string).collect();
                write!(f, "{name}({})", all.join(", "))
            }
        }
    }
}

impl Expression {
    /// The value; `hypot` and `atan2` by functions that are analytic.
    pub fn at<T: ComplexField + From<f64>>(&self, [x, phi]: &[T; 2]) -> T {
        let of = |part: &Self| part.at(&[x.clone(), phi.clone()]);
        let length = |y: &T, x: &T| (y.clone() * y.clone() + x.clone() * x.clone()).sqrt();
        match self {
            X => x.clone(),
            Phi => phi.clone(),
            Number(value) => T::from(*value),
            Sum(parts) => of(&parts[0]) + of(&parts[1]),
            Product(parts) => of(&parts[0]) * of(&parts[1]),
            Quotient(parts) => of(&parts[0]) / of(&parts[1]),
            Call(name, arguments) => {
                let all: Vec<T> = arguments.iter().map(of).collect();
                match (*name, all.as_slice()) {
                    ("sin", [x]) => x.clone().sin(),
                    ("cos", [x]) => x.clone().cos(),
                    ("tan", [x]) => x.clone().tan(),
                    ("asin", [x]) => x.clone().asin(),
                    ("acos", [x]) => x.clone().acos(),
                    ("atan", [x]) => x.clone().atan(),
                    ("exp", [x]) => x.clone().exp(),
                    ("ln", [x]) => x.clone().ln(),
                    ("sqrt", [x]) => x.clone().sqrt(),
                    ("hypot", [y, x]) => length(y, x),
                    ("atan2", [y, x]) => T::from(2.0) * (y.clone() / (length(y, x) + x.clone())).atan(),
                    _ => panic!("{name} of {} arguments", all.len()),
                }
            }
        }
    }

    /// A gap with one to three terms, whose angles move by so many radians while x and phi move by 1.
    pub fn random(random: &mut SmallRng, fastest: f64) -> Self {
        let slopes = [X, Phi].map(|of| scaled(random.random_range(-0.3..0.3), of));
        let [first, second] = slopes;
        (0..random.random_range(1..=3)).fold(sum(first, second), |all, _| sum(all, term(random, fastest)))
    }
}

fn sum(a: Expression, b: Expression) -> Expression {
    Sum(Box::new([a, b]))
}

fn scaled(factor: f64, of: Expression) -> Expression {
    Product(Box::new([Number(factor), of]))
}

fn product(a: Expression, b: Expression) -> Expression {
    Product(Box::new([a, b]))
}

fn call<const N: usize>(name: &'static str, of: [Expression; N]) -> Expression {
    Call(name, of.into())
}

/// The sine of an angle, or its cosine.
fn wave(random: &mut SmallRng, fastest: f64) -> Expression {
    let mut speed = || 3.0 * (fastest / 3.0).powf(random.random_range(0.0..1.0));
    let (by_x, by_phi) = (speed(), speed());
    let mut angle = match random.random_range(0..4) {
        0 => scaled(by_phi.round(), Phi),
        1 => sum(scaled(by_x, X), scaled(-by_phi.round(), Phi)),
        _ => scaled(by_x, X),
    };
    if random.random_range(0..8) == 0 {
        angle = sum(angle, scaled(0.3 * by_x, product(X, X)));
    }
    let angle = sum(angle, Number(random.random_range(-3.0..3.0)));
    call(if random.random_range(0..2) == 0 { "sin" } else { "cos" }, [angle])
}

/// A term with a place where its function is not analytic at some distance.
fn term(random: &mut SmallRng, fastest: f64) -> Expression {
    let one = wave(random, fastest);
    let two = wave(random, fastest);
    let above = |least: f64, of: Expression| sum(Number(1.0 + least), of);
    let of = match random.random_range(0..16) {
        0 => product(X, one),
        1 => product(one, two),
        2 => call("exp", [scaled(0.7, one)]),
        3 => Quotient(Box::new([two, above(0.3, one)])),
        4 => call("sqrt", [above(0.2, one)]),
        5 => call("hypot", [above(-0.4, scaled(0.3, one)), two]),
        6 => call("atan", [scaled(3.0, one)]),
        7 => call("atan2", [two, above(0.4, one)]),
        8 => call("ln", [above(0.4, one)]),
        9 => call("asin", [scaled(0.8, one)]),
        10 => call("acos", [scaled(0.8, one)]),
        11 => call("tan", [one]),
        _ => one,
    };
    scaled(random.random_range(0.05..0.5), of)
}
