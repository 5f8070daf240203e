//! The numbers that formulas are computed in: doubles, twice the precision, and lanes of doubles.

use linkage_ir::ElementaryFunction;
use linkage_runtime::__rt::{Wide, real};
use linkage_runtime::Real;
use linkage_runtime::derivation::value_of;

use super::defect::Defect;
use super::value::Value;
use crate::code::Constant;
use crate::tape::{Binary, Ternary, Traced, Unary};

/// A number of formulas.
pub(crate) trait Scalar: Clone {
    /// The number that a value is.
    fn of(value: &Value) -> Option<Self>;
    fn into_value(self) -> Value;
    fn constant(constant: Constant) -> Self;
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

/// The constant as emitted code writes it, over any scalar.
fn constant<T: Real>(constant: Constant) -> T {
    match constant {
        Constant::Double(value) => real(value),
        Constant::Turn(count, parts) => {
            let turned = if count == 1.0 { T::pi() } else { T::pi() * real(count) };
            if parts == 1.0 { turned } else { turned / real(parts) }
        }
    }
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
            fn constant(of: Constant) -> Self {
                constant(of)
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

    fn constant(constant: Constant) -> Self {
        Self::Constant(f64::constant(constant))
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
