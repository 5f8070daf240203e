//! Doubles with the elementary functions of emitted code, and floats of 48 digits.

use linkage::Real;
use linkage_oracle::precise::{self, Big, big};

use super::reader::Arithmetic;

impl Arithmetic for f64 {
    fn decimal(digits: &str) -> Self {
        digits.parse().unwrap()
    }

    fn pi() -> Self {
        std::f64::consts::PI
    }

    fn call(name: &str, operands: &[Self]) -> Option<Self> {
        Some(match (name, operands) {
            ("+", [a, b]) => a + b,
            ("-", [a, b]) => a - b,
            ("-", [a]) => -a,
            ("*", [a, b]) => a * b,
            ("/", [a, b]) => a / b,
            ("sqrt", [a]) => a.sqrt(),
            ("fabs", [a]) => a.abs(),
            ("sin", [a]) => a.sine(),
            ("cos", [a]) => a.cosine(),
            ("tan", [a]) => a.tangent(),
            ("asin", [a]) => a.arcsine(),
            ("acos", [a]) => a.arccosine(),
            ("atan", [a]) => a.arctangent(),
            ("atan2", [y, x]) => y.arctangent2(*x),
            ("exp", [a]) => a.exponential(),
            ("log", [a]) => a.logarithm(),
            ("hypot", [x, y]) => x.hypotenuse(*y),
            _ => return None,
        })
    }

    fn is_less(&self, other: &Self) -> bool {
        self < other
    }
}

impl Arithmetic for Big {
    fn decimal(digits: &str) -> Self {
        big(digits.parse().unwrap())
    }

    fn pi() -> Self {
        precise::pi()
    }

    fn call(name: &str, operands: &[Self]) -> Option<Self> {
        Some(match (name, operands) {
            ("+", [a, b]) => a + b,
            ("-", [a, b]) => a - b,
            ("-", [a]) => -a.clone(),
            ("*", [a, b]) => a * b,
            ("/", [a, b]) => a / b,
            ("sqrt", [a]) => a.sqrt(),
            ("sin", [a]) => a.sin_cos().0,
            ("cos", [a]) => a.sin_cos().1,
            ("fabs", [a]) if *a < big(0.0) => -a.clone(),
            ("fabs", [a]) => a.clone(),
            ("atan2", [y, x]) => y.atan2(x),
            _ => return None,
        })
    }

    fn is_less(&self, other: &Self) -> bool {
        self < other
    }
}
