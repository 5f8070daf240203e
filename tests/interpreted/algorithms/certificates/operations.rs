//! A number of any kind that knows the operations that made it.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::{Add, Div, Mul, Neg, Sub};

use linkage::Number;

/// The hash of a tree of operations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Operations(u64);

/// An operation on these.
fn made(of: impl Hash) -> Operations {
    let mut hasher = DefaultHasher::new();
    of.hash(&mut hasher);
    Operations(hasher.finish())
}

/// The given numbers with this name.
pub fn given(name: &str, count: usize) -> Vec<Operations> {
    (0..count).map(|place| made((name, place))).collect()
}

impl Add for Operations {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        made(("+", self, other))
    }
}

impl Sub for Operations {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        made(("-", self, other))
    }
}

impl Mul for Operations {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        made(("*", self, other))
    }
}

impl Div for Operations {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        made(("/", self, other))
    }
}

impl Neg for Operations {
    type Output = Self;
    fn neg(self) -> Self {
        made(("negative", self))
    }
}

impl Number for Operations {
    fn exactly(value: f64) -> Self {
        made(("exactly", value.to_bits()))
    }
    fn near(value: f64) -> Self {
        made(("near", value.to_bits()))
    }
    fn unknown() -> Self {
        made("unknown")
    }
    fn pi() -> Self {
        made("pi")
    }
    fn zero() -> Self {
        made("zero")
    }
    fn one() -> Self {
        made("one")
    }
    fn ratio(numerator: f64, denominator: f64) -> Self {
        made(("ratio", numerator.to_bits(), denominator.to_bits()))
    }
    fn square(self) -> Self {
        made(("square", self))
    }
    fn abs(self) -> Self {
        made(("abs", self))
    }
    fn sqrt(self) -> Self {
        made(("sqrt", self))
    }
    fn exponential(self) -> Self {
        made(("exp", self))
    }
    fn logarithm(self) -> Self {
        made(("ln", self))
    }
    fn sine_cosine(self) -> (Self, Self) {
        (made(("one of both, the sine", self)), made(("one of both, the cosine", self)))
    }
    fn sine(self) -> Self {
        made(("sine", self))
    }
    fn cosine(self) -> Self {
        made(("cosine", self))
    }
    fn tangent(self) -> Self {
        made(("tan", self))
    }
    fn arcsine(self) -> Self {
        made(("asin", self))
    }
    fn arccosine(self) -> Self {
        made(("acos", self))
    }
    fn arctangent(self) -> Self {
        made(("atan", self))
    }
    fn arctangent2(self, x: Self) -> Self {
        made(("arctangent2", self, x))
    }
    fn hypotenuse(self, y: Self) -> Self {
        made(("hypotenuse", self, y))
    }
}
