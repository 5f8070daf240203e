//! The arguments of an operation, as the values that they must be.

use std::sync::Arc;

use linkage_ir::Name;
use linkage_runtime::__rt::Triangle;
use linkage_runtime::Elbow;

use crate::machine::defect::Defect;
use crate::machine::groups::numbers;
use crate::machine::scalar::{Scalar, Single};
use crate::machine::value::Value;

/// The arguments of an operation.
pub(super) struct Arguments<'v>(pub(super) &'v [Value]);

impl<'v> Arguments<'v> {
    pub(super) fn at(&self, place: usize) -> Result<&'v Value, Defect> {
        self.0.get(place).ok_or_else(|| Defect::new("an argument that is not given"))
    }

    pub(super) fn names(&self) -> Result<[&'v Arc<str>; 2], Defect> {
        Ok([self.at(0)?.as_text()?, self.at(1)?.as_text()?])
    }

    pub(super) fn number<S: Scalar>(&self, place: usize) -> Result<S, Defect> {
        let value = self.at(place)?;
        S::of(value).ok_or_else(|| value.expected("a number"))
    }
}

/// True if every number is finite.
pub(super) fn are_finite(value: &Value) -> bool {
    let mut are = true;
    value.each_leaf(&mut |leaf| {
        are &= match leaf {
            Value::Number(number) => number.is_finite(),
            Value::Wide(number) => nalgebra::ComplexField::is_finite(number),
            _ => true,
        }
    });
    are
}

pub(super) fn side(value: &Value) -> Result<Elbow, Defect> {
    match value {
        Value::Side(true) => Ok(Elbow::Left),
        Value::Side(false) => Ok(Elbow::Right),
        other => Err(other.expected("a side")),
    }
}

pub(super) fn triangle<S: Single>(value: &Value) -> Result<Triangle<S>, Defect> {
    let number = |name| {
        let value = value.field(name)?;
        S::of(value).ok_or_else(|| value.expected("a number"))
    };
    Ok(Triangle {
        links: numbers(value.field(Name::LINKS)?)?,
        line: numbers(value.field(Name::LINE)?)?,
        scale: number(Name::SCALE)?,
        reach_squared: number(Name::REACH_SQUARED)?,
        distance_squared: number(Name::DISTANCE_SQUARED)?,
        factors: numbers(value.field(Name::FACTORS)?)?,
    })
}

/// The number that a value is.
pub(super) fn number(value: &Value) -> Result<f64, Defect> {
    f64::of(value).ok_or_else(|| value.expected("a number"))
}
