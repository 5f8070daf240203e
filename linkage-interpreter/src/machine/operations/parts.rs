//! Operations on values that are no numbers of one scalar: their parts, and what is made of them.

use std::rc::Rc;

use linkage_ir::code::Type;
use linkage_ir::{Constant, Intrinsic, Name};
use linkage_runtime::AssemblyMode;

use super::arguments::{Arguments, are_finite};
use crate::machine::Machine;
use crate::machine::defect::Defect;
use crate::machine::failure::Evaluated;
use crate::machine::scalar::Scalar as _;
use crate::machine::value::{Turning, Value};

/// A constant of the runtime.
pub(crate) fn of_runtime(of: Constant) -> Result<Value, Defect> {
    Ok(match of {
        Constant::None | Constant::Mark | Constant::Angle | Constant::NoSearch => Value::Absent,
        Constant::SearchTurn => Value::Flag(true),
        Constant::OfGuess => Value::Mode(AssemblyMode::OfGuess),
        Constant::Name | Constant::False | Constant::Quantities => {
            return Err(Defect::new(format!("{of:?} as a constant of the runtime")));
        }
    })
}

impl Machine<'_> {
    /// Operations on values that are no numbers of one scalar.
    pub(super) fn of_values(&mut self, of: Intrinsic, arguments: &Arguments) -> Evaluated<Option<Value>> {
        let value = || arguments.at(0);
        Ok(Some(match of {
            Intrinsic::Some | Intrinsic::SearchLength => value()?.clone(),
            Intrinsic::LimitOfAngle | Intrinsic::LimitOfLength => Value::list(arguments.0.iter().cloned()),
            Intrinsic::ValueOf => match value()? {
                Value::Outcome(outcome) => outcome.as_ref().as_ref().map_or(Value::Absent, Value::clone),
                other => other.clone(),
            },
            Intrinsic::UnwrapOr => match value()? {
                Value::Absent => arguments.at(1)?.clone(),
                present => present.clone(),
            },
            Intrinsic::Get => {
                let place = arguments.at(1)?.as_count()?;
                value()?.as_list()?.get(place).cloned().unwrap_or(Value::Absent)
            }
            Intrinsic::IsFinite => Value::Flag(are_finite(value()?)),
            Intrinsic::Unit => Value::list([value()?.clone(), arguments.at(1)?.clone()]),
            Intrinsic::Parts => {
                let mut all = value()?.as_list()?.iter().cloned();
                let q = self.named(&self.driver.coordinates, |_| all.next())?;
                let rates = self.named(&self.driver.inputs, |_| all.next())?;
                Value::record([(Name::Q, q), (Name::INPUT_RATES, rates)])
            }
            Intrinsic::At => {
                Value::At(arguments.at(1)?.as_list()?.iter().map(|value| f64::of(value).unwrap_or(f64::NAN)).collect())
            }
            Intrinsic::Solve => match value()? {
                Value::Factors(factors) => factors.solve(arguments.at(1)?)?,
                other => return Err(other.expected("factors").into()),
            },
            Intrinsic::Take => match (value()?, arguments.at(3)?) {
                (Value::Modes(modes), Value::Mode(mode)) => {
                    modes.take([arguments.at(1)?.as_text()?, arguments.at(2)?.as_text()?], *mode)?
                }
                (other, _) => return Err(other.expected("modes").into()),
            },
            Intrinsic::Default => Value::Memory(Rc::default()),
            Intrinsic::Turns => Value::Turns(Rc::new(Turning::given(value()?)?)),
            Intrinsic::New => Value::Turns(Rc::new(Turning::nearest(value()?)?)),
            Intrinsic::InTurn => match value()? {
                Value::Turns(turns) => turns.number(arguments.at(1)?.as_count()?, arguments.at(2)?)?,
                other => return Err(other.expected("turns").into()),
            },
            Intrinsic::TurnsFound => match value()? {
                Value::Turns(turns) => turns.found()?,
                other => return Err(other.expected("turns").into()),
            },
            Intrinsic::SideAt => Value::Side(value()?.as_count()? == 0),
            Intrinsic::NumberOfMode => Value::Mode(AssemblyMode::Number(value()?.as_count()?)),
            // All convert each number.
            Intrinsic::Widened | Intrinsic::WidenedDirection | Intrinsic::WidenedByName | Intrinsic::WidenedColumn => {
                value()?.map_leaves(&mut |leaf| match leaf {
                    Value::Number(number) => Value::Wide((*number).into()),
                    other => other.clone(),
                })
            }
            Intrinsic::Rounded | Intrinsic::RoundedByName | Intrinsic::RoundedEach => rounded(value()?),
            _ => return Ok(None),
        }))
    }

    /// A value of a type from one with the same numbers.
    pub(super) fn from(&self, of_type: Option<&Type>, value: Value) -> Result<Value, Defect> {
        let types = &self.driver.types;
        Ok(match of_type {
            Some(Type::List(..)) => match &value {
                Value::Record(record) => Value::list(record.fields.iter().map(|(_, value)| value.clone())),
                other => Value::list(other.as_list()?.iter().cloned()),
            },
            Some(Type::Runtime("SMatrix" | "Matrix", _) | Type::Sized("Matrix", _)) => {
                Value::Matrix(value.as_list()?.into())
            }
            // The inputs of coordinates by name.
            Some(Type::Bare(name)) if *name == types.inputs => {
                let all = value.as_record()?;
                self.named(&self.driver.inputs, |name| all.get(name).cloned())?
            }
            // A mechanism from the list of its parameters.
            Some(Type::Bare(name)) if *name == types.driver => {
                let mut all = value.as_list()?.iter().cloned();
                self.named(&self.driver.parameters, |_| all.next())?
            }
            Some(Type::Runtime(..) | Type::Sized(..) | Type::Tuple(_) | Type::Column(..)) => value,
            other => return Err(Defect::new(format!("a value of {other:?}"))),
        })
    }

    /// A record with these fields.
    pub(super) fn named(&self, names: &[Name], mut value: impl FnMut(Name) -> Option<Value>) -> Result<Value, Defect> {
        let fields = names.iter().map(|name| {
            let value = value(*name).ok_or_else(|| Defect::new("a field that is not given"))?;
            Ok((*name, value))
        });
        Ok(Value::record(fields.collect::<Result<Vec<_>, _>>()?))
    }
}

/// The numbers of twice the precision rounded; absent if one is not finite.
fn rounded(wide: &Value) -> Value {
    let mut are_finite = true;
    let rounded = wide.map_leaves(&mut |leaf| match leaf {
        Value::Wide(number) => {
            are_finite &= number.high().is_finite();
            Value::Number(number.high())
        }
        other => other.clone(),
    });
    if are_finite { rounded } else { Value::Absent }
}
