//! The numbers that formulas are computed in: doubles, twice the precision, and lanes of doubles.

use linkage_ir::{ElementaryFunction, Number};
use linkage_runtime::__rt::{Wide, real};
use linkage_runtime::Real;
use linkage_runtime::derivation::value_of;

use super::defect::Defect;
use super::value::Value;
use crate::tape::{Binary, Ternary, Traced, Unary};

/// A number of formulas.
pub(crate) trait Scalar: Clone {
    /// The number that a value is.
    fn of(value: &Value) -> Option<Self>;
    fn into_value(self) -> Value;
    /// A constant as emitted code writes it.
    fn constant(number: Number) -> Self;
    /// The multiple of pi by a count, divided by a number of parts.
    fn turn(count: i32, parts: u32) -> Self;
    fn plus(self, other: &Self) -> Self;
    fn minus(self, other: &Self) -> Self;
    fn times(self, other: &Self) -> Self;
    fn over(self, other: &Self) -> Self;
    fn negative(self) -> Self;
    /// An elementary function.
    fn call(function: ElementaryFunction, arguments: &[Self]) -> Result<Self, Defect>;
}

/// One number, for which the functions of the runtime are generic.
pub(crate) trait Single: Scalar + Real {}

impl Single for f64 {}
impl Single for Wide {}

/// The double that a constant is in emitted code, which writes zero without its sign.
fn double(number: Number) -> f64 {
    match number {
        Number::Ratio(above, 1) => above as f64,
        Number::Ratio(above, below) => above as f64 / below as f64,
        Number::Float(0.0) => 0.0,
        Number::Float(value) => value,
    }
}

fn turn<T: Real>(count: i32, parts: u32) -> T {
    let turned = if count == 1 { T::pi() } else { T::pi() * real(count.into()) };
    if parts == 1 { turned } else { turned / real(parts.into()) }
}

macro_rules! single {
    ($($T:ty: $($variant:ident),+;)*) => {$(
        impl Scalar for $T {
            #[inline]
            fn of(value: &Value) -> Option<Self> {
                match value {
                    $(Value::$variant(number) => Some((*number).into()),)+
                    _ => None,
                }
            }

            #[inline]
            fn into_value(self) -> Value {
                self.into()
            }

            #[inline]
            fn constant(number: Number) -> Self {
                real(double(number))
            }

            #[inline]
            fn turn(count: i32, parts: u32) -> Self {
                turn(count, parts)
            }

            #[inline]
            fn plus(self, other: &Self) -> Self {
                self + *other
            }

            #[inline]
            fn minus(self, other: &Self) -> Self {
                self - *other
            }

            #[inline]
            fn times(self, other: &Self) -> Self {
                self * *other
            }

            #[inline]
            fn over(self, other: &Self) -> Self {
                self / *other
            }

            #[inline]
            fn negative(self) -> Self {
                -self
            }

            #[inline]
            fn call(function: ElementaryFunction, arguments: &[Self]) -> Result<Self, Defect> {
                value_of(function, arguments)
                    .ok_or_else(|| Defect::new(format!("{function:?} of {} numbers", arguments.len())))
            }
        }
    )*};
}

single! {
    f64: Number;
    // A double is exact in twice the precision.
    Wide: Wide, Number;
}

impl Scalar for Traced {
    fn of(value: &Value) -> Option<Self> {
        match value {
            Value::Traced(traced) => Some(traced.clone()),
            Value::Number(number) => Some(Self::Constant(*number)),
            _ => None,
        }
    }

    fn into_value(self) -> Value {
        match self {
            Self::Constant(value) => Value::Number(value),
            register => Value::Traced(register),
        }
    }

    fn constant(number: Number) -> Self {
        Self::Constant(double(number))
    }

    fn turn(count: i32, parts: u32) -> Self {
        Self::Constant(turn(count, parts))
    }

    fn plus(self, other: &Self) -> Self {
        self.binary(Binary::Plus, other)
    }

    fn minus(self, other: &Self) -> Self {
        self.binary(Binary::Minus, other)
    }

    fn times(self, other: &Self) -> Self {
        self.binary(Binary::Times, other)
    }

    fn over(self, other: &Self) -> Self {
        self.binary(Binary::Over, other)
    }

    fn negative(self) -> Self {
        self.unary(Unary::Negative)
    }

    fn call(function: ElementaryFunction, arguments: &[Self]) -> Result<Self, Defect> {
        match (function, arguments) {
            (ElementaryFunction::Sqrt, [x]) => Ok(x.unary(Unary::Sqrt)),
            (ElementaryFunction::Abs, [x]) => Ok(x.unary(Unary::Abs)),
            (ElementaryFunction::IfNonzero, [a, value, limit]) => Ok(a.ternary(Ternary::IfNonzero, [value, limit])),
            // Others have forms over lanes, or none.
            _ => Err(Defect::new(format!("{function:?} over lanes"))),
        }
    }
}
