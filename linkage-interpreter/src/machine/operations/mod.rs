//! The functions of the runtime, applied to values.

mod arguments;
mod branches;
mod checked;
mod lanes;
mod parts;
mod scenes;

use std::sync::Arc;

use linkage_ir::Intrinsic;
use linkage_ir::code::{Code, Type, Value as Operation};
use linkage_ir::{Name, ValueId};
use linkage_runtime::__rt::{self as rt, Wide};
use linkage_runtime::PositionError;
use linkage_runtime::{Elbow, Ranged};

use super::defect::Defect;
use super::failure::Evaluated;
use super::groups::{MOST_UNKNOWNS, each, factorised, list, numbers, pivots, sized};
use super::scalar::Single;
use super::value::Value;
use super::{Kind, Load, Machine};
use crate::error::Error;
use arguments::{Arguments, are_finite, number as number_of, side, triangle};
use lanes::in_lanes;

pub(super) use parts::of_runtime;

/// A chord and whether its triangle is well conditioned.
fn flagged<S: Single>((chord, is_well_conditioned): (S, bool)) -> Value {
    Value::list([chord.into_value(), Value::Flag(is_well_conditioned)])
}

fn perhaps<S: Single>(found: Option<S>) -> Value {
    found.map_or(Value::Absent, S::into_value)
}

impl<'c> Machine<'c> {
    /// Applies a function of the runtime: the value of its success, or its value.
    pub(super) fn operation(
        &mut self,
        code: &'c Code,
        of: Intrinsic,
        of_type: Option<&'c Type>,
        arguments: &'c [ValueId],
    ) -> Evaluated<Value> {
        // Those that evaluate an argument in a way of their own.
        match (of, arguments) {
            (Intrinsic::Ok, [value]) => return self.value(code, *value),
            (Intrinsic::Err, [error]) => {
                return match self.value(code, *error)? {
                    Value::Outcome(outcome) => match &*outcome {
                        Err(error) => Err(error.clone().into()),
                        Ok(_) => Err(Defect::new("an error that is none").into()),
                    },
                    other => Err(other.expected("an error").into()),
                };
            }
            (Intrinsic::And, [one, other]) => {
                self.success(code, *one)?;
                return self.success(code, *other);
            }
            // The value itself.
            (Intrinsic::Into | Intrinsic::Iter | Intrinsic::Copied | Intrinsic::EachSized, [value, ..]) => {
                return self.value(code, *value);
            }
            (Intrinsic::From, [value]) => {
                let value = self.value(code, *value)?;
                return Ok(self.from(of_type, value)?);
            }
            (Intrinsic::Zeros, []) => return zeros(of_type),
            (Intrinsic::OnlyBranch, []) => return Ok(Value::record([])),
            // Of each number.
            (Intrinsic::AreAll, [all, _]) => return Ok(Value::Flag(are_finite(&self.value(code, *all)?))),
            (Intrinsic::Map, [all, function]) if is_widened(code, *function) => {
                return self.operation(code, Intrinsic::Widened, None, std::slice::from_ref(all));
            }
            // The last is a function.
            (Intrinsic::Limits, [arguments @ .., _]) => return self.limits(code, arguments),
            _ => {}
        }
        let values = self.values(code, arguments)?;
        match self.kind {
            Kind::Double => self.applied::<f64>(code, of, &values),
            Kind::Wide => self.applied::<Wide>(code, of, &values),
            Kind::Traced => match in_lanes(of, &Arguments(&values))? {
                Some(value) => Ok(value),
                None => self.applied::<f64>(code, of, &values),
            },
        }
    }

    fn applied<S: Single + 'static>(&mut self, code: &'c Code, of: Intrinsic, values: &[Value]) -> Evaluated<Value> {
        let arguments = Arguments(values);
        if let Some(value) = self.of_values(of, &arguments)? {
            return Ok(value);
        }
        if let Some(value) = self.checked(of, &arguments)? {
            return Ok(value);
        }
        let number = |place| arguments.number::<S>(place);
        Ok(match of {
            Intrinsic::SineCosine => {
                let (sine, cosine) = number(0)?.sine_cosine();
                list([sine, cosine])
            }
            // Each has the digits that it has alone.
            Intrinsic::SinesCosines => {
                let of_part = |part: &[Value]| {
                    sized!(part.len(), N => {
                        let all = S::sines_cosines(each::<S, N>(part)?);
                        Ok(all.map(|(sine, cosine)| list([sine, cosine])).to_vec())
                    })
                };
                let parts = arguments.at(0)?.as_list()?.chunks(MOST_UNKNOWNS).map(of_part);
                Value::list(parts.collect::<Evaluated<Vec<_>>>()?.into_iter().flatten())
            }
            Intrinsic::Largest => {
                let all = arguments.at(0)?.as_list()?.iter();
                let all = all.map(|value| S::of(value).ok_or_else(|| value.expected("a number")));
                rt::largest(all.collect::<Result<Vec<S>, _>>()?).into_value()
            }
            Intrinsic::Regular => {
                let [mechanism, group] = arguments.names()?;
                rt::regular(&**mechanism, &**group, number(2)?, number(3)?).map_err(Error::from)?;
                Value::unit()
            }
            Intrinsic::IsNonzero => Value::Flag(rt::is_nonzero(number(0)?, number(1)?)),
            Intrinsic::Closes => Value::Flag(rt::closes(number(0)?, number(1)?)),
            Intrinsic::Solvable => sized!(arguments.at(3)?.as_list()?.len(), N => {
                let [numerators, scales] = [3, 4].map(|place| arguments.at(place).and_then(numbers::<S, N>));
                let (determinant, numerators, scales) = (number(2)?, numerators?, scales?);
                self.located(&arguments, |mechanism, group| {
                    rt::solvable(mechanism, group, determinant, numerators, scales).map(|()| Value::unit())
                })
            })?,
            Intrinsic::Reachable => {
                let distance = number(2)?;
                self.located(&arguments, |mechanism, group| {
                    rt::reachable(mechanism, group, distance).map(|()| Value::unit())
                })?
            }
            Intrinsic::Implied => {
                let [names, residuals, scales] = [arguments.at(1)?, arguments.at(2)?, arguments.at(3)?];
                let mechanism = arguments.at(0)?.as_text()?;
                let rows = names.as_list()?.iter().zip(residuals.as_list()?).zip(scales.as_list()?);
                for ((name, residual), scale) in rows {
                    let name = name.as_text()?;
                    let [residual, scale] =
                        [residual, scale].map(|value| S::of(value).ok_or_else(|| value.expected("a number")));
                    rt::implied(&**mechanism, [&**name], [residual?], [scale?]).map_err(Error::from)?;
                }
                Value::unit()
            }
            Intrinsic::ElbowChord => {
                let (triangle, side) = (triangle::<S>(arguments.at(2)?)?, side(arguments.at(3)?)?);
                self.located(&arguments, |mechanism, group| {
                    rt::elbow_chord(mechanism, group, triangle, side).map(flagged)
                })?
            }
            Intrinsic::RegularElbowChord => {
                perhaps(rt::regular_elbow_chord(triangle::<S>(arguments.at(0)?)?, side(arguments.at(1)?)?))
            }
            Intrinsic::Chord => {
                let (factors, radius) = (numbers::<S, 2>(arguments.at(2)?)?, number(3)?);
                let (scales, side) = (numbers(arguments.at(4)?)?, side(arguments.at(5)?)?);
                self.located(&arguments, |mechanism, group| {
                    rt::chord(mechanism, group, factors, radius, scales, side).map(S::into_value)
                })?
            }
            Intrinsic::ReachChord => {
                let (factors, radius) = (numbers::<S, 2>(arguments.at(2)?)?, number(3)?);
                let (scales, side) = (numbers(arguments.at(4)?)?, side(arguments.at(5)?)?);
                self.located(&arguments, |mechanism, group| {
                    rt::reach_chord(mechanism, group, factors, radius, scales, side).map(S::into_value)
                })?
            }
            Intrinsic::RegularChord => {
                perhaps(rt::regular_chord(numbers::<S, 2>(arguments.at(0)?)?, number(1)?, side(arguments.at(2)?)?))
            }
            Intrinsic::RegularReachChord => {
                let factors = numbers::<S, 2>(arguments.at(0)?)?;
                perhaps(rt::regular_reach_chord(factors, number(1)?, number(2)?, side(arguments.at(3)?)?))
            }
            Intrinsic::ProductOfPivots => pivots::<S>(arguments.at(0)?)?,
            Intrinsic::Factorization => factorised::<S>(arguments.names()?, arguments.at(2)?, arguments.at(3)?)?,
            Intrinsic::InRange => rt::in_range(number(0)?, number(1)?, number(2)?).into_value(),
            Intrinsic::SideOf => Value::Side(rt::side_of::<S, Elbow>(number(0)?) == Elbow::Left),
            Intrinsic::Refined => {
                let Value::Factors(factors) = arguments.at(0)? else {
                    return Err(arguments.at(0)?.expected("factors").into());
                };
                let rough = arguments.at(1)?;
                let precise = match factors.loses_digits() {
                    true => self.closure(code, arguments.at(2)?, [rough.clone()], false)?,
                    false => Value::Absent,
                };
                if matches!(precise, Value::Absent) { rough.clone() } else { precise }
            }
            Intrinsic::NewtonGroup => {
                self.newton_group(code, arguments.names()?, arguments.at(2)?, arguments.at(3)?)?
            }
            Intrinsic::Modes => {
                let names = [arguments.at(1)?.as_text()?, arguments.at(2)?.as_text()?];
                let functions = [arguments.at(4)?, arguments.at(5)?];
                self.modes(code, arguments.at(0)?, names, arguments.at(3)?, None, functions)?
            }
            Intrinsic::ModesWithLengths => {
                let names = [arguments.at(1)?.as_text()?, arguments.at(2)?.as_text()?];
                let (are, functions) = (arguments.at(4)?, [arguments.at(5)?, arguments.at(6)?]);
                self.modes(code, arguments.at(0)?, names, arguments.at(3)?, Some(are), functions)?
            }
            Intrinsic::Map => {
                let closure = arguments.at(1)?;
                let mut mapped = Vec::new();
                for value in arguments.at(0)?.as_list()? {
                    // Of items that are outcomes the errors stay.
                    mapped.push(self.closure(code, closure, [value.clone()], false)?);
                }
                Value::list(mapped)
            }
            Intrinsic::OrElse => match arguments.at(0)? {
                Value::Outcome(outcome) => match &**outcome {
                    Ok(value) => value.clone(),
                    Err(error) => {
                        let error = Value::outcome(Err(error.clone()));
                        self.closure(code, arguments.at(1)?, [error], true)?
                    }
                },
                other => return Err(other.expected("an outcome").into()),
            },
            Intrinsic::Newton => self.newton(arguments.at(0)?, arguments.at(1)?, false)?,
            Intrinsic::NewtonAnyBranch => self.newton(arguments.at(0)?, arguments.at(1)?, true)?,
            Intrinsic::Reactions => self.load(values, Load::Joints)?,
            Intrinsic::DriveForces => self.load(values, Load::Drives)?,
            Intrinsic::BearingLoss => self.load(values, Load::LossOfBearings)?,
            Intrinsic::Combinations => self.combinations(code, arguments.at(0)?, arguments.at(1)?)?,
            Intrinsic::Existing => self.existing(code, arguments.at(0)?, arguments.at(1)?)?,
            Intrinsic::Reduced => self.reduced(&arguments)?,
            Intrinsic::Equilibrium => self.equilibrium(code, &arguments)?,
            Intrinsic::Ranged => ranged(&arguments, rt::ranged)?,
            Intrinsic::RangedDirection => ranged(&arguments, rt::ranged_direction)?,
            Intrinsic::RangedModuloTurns => ranged(&arguments, rt::ranged_modulo_turns)?,
            // `Equations::at` is called by scenes of the runtime only, and others have cases above.
            other => return Err(Defect::new(format!("{other:?} in a function")).into()),
        })
    }

    /// Calls a function with the names of a mechanism and a group; an error has the inputs, if they are given.
    fn located(
        &self,
        arguments: &Arguments,
        call: impl for<'n> FnOnce(&'n str, &'n str) -> Result<Value, PositionError<&'n str>>,
    ) -> Evaluated<Value> {
        let group = arguments.at(1)?.as_text()?;
        let inputs = match arguments.at(0)? {
            Value::Text(mechanism) => return Ok(call(mechanism, group).map_err(Error::from)?),
            Value::At(inputs) => inputs,
            other => return Err(other.expected("a name").into()),
        };
        call(&self.driver.name, group).map_err(|error| {
            let mut error = error.map_names(Arc::from);
            if let PositionError::Unbuildable { inputs: known, .. } = &mut error {
                *known = self.driver.input_values(inputs);
            }
            Error::Position(error).into()
        })
    }
}

/// True for the function that takes a number to twice the precision.
fn is_widened(code: &Code, id: ValueId) -> bool {
    matches!(code.values.get(id.index()), Some(Operation::Function(Intrinsic::Widened, _)))
}

/// The matrix of a type whose entries are zero.
fn zeros(of_type: Option<&Type>) -> Evaluated<Value> {
    let Some(Type::Runtime(_, sizes)) = of_type else { return Err(Defect::new("zeros of no matrix").into()) };
    let &[rows, columns] = sizes.as_slice() else { return Err(Defect::new("zeros of no matrix").into()) };
    let column = Value::list(std::iter::repeat_n(Value::Number(0.0), rows));
    Ok(Value::Matrix(std::iter::repeat_n(column, columns).collect()))
}

/// A value with a range.
fn ranged(arguments: &Arguments, made: impl Fn(f64, Option<f64>, Option<f64>) -> Ranged<f64>) -> Result<Value, Defect> {
    let end = |place| match arguments.at(place)? {
        Value::Absent => Ok(None),
        value => number_of(value).map(Some),
    };
    let Ranged { value, least, most, is_direction } = made(arguments.number(0)?, end(1)?, end(2)?);
    let end = |end: Option<f64>| end.map_or(Value::Absent, Value::Number);
    Ok(Value::record([
        (Name::VALUE, Value::Number(value)),
        (Name::LEAST, end(least)),
        (Name::MOST, end(most)),
        (Name::IS_DIRECTION, Value::Flag(is_direction)),
    ]))
}

#[cfg(all(test, feature = "compiler"))]
mod tests {
    use linkage_ir::code::{Readable, Returned};

    use super::*;
    use crate::Program;
    use crate::machine::Failure;

    /// Those that have cases where values are computed: functions of poses and branches, and a square; and those that code of a
    /// scalar does not call.
    const ELSEWHERE: [Intrinsic; 6] =
        [Intrinsic::All, Intrinsic::Coordinates, Intrinsic::Square, Intrinsic::Sum, Intrinsic::Pi, Intrinsic::Unknown];

    /// Each row of the table has its case here: none ends as one that the machine does not know.
    #[test]
    fn every_intrinsic_is_run() {
        let program = Program::compile("mechanism M { input x; output y = x; }").unwrap();
        let driver = program.mechanisms()[0].driver();
        let code = Code {
            slots: 1,
            values: vec![Operation::List(Vec::new())],
            statements: Vec::new(),
            value: Returned::Plain(ValueId::new(0)),
            readable: Readable::default(),
        };
        let is_known = |of: Intrinsic| {
            let arguments = vec![ValueId::new(0); of.row().roles.len()];
            [Kind::Double, Kind::Traced].into_iter().any(|kind| {
                let result = Machine::new(driver, None, &[], kind).operation(&code, of, None, &arguments);
                let unknown = Defect::new(format!("{of:?} in a function"));
                !matches!(result.map_err(|failure| *failure), Err(Failure::Defect(defect)) if defect == unknown)
            })
        };
        // `Equations::at` is called by scenes of the runtime only.
        for &of in Intrinsic::ALL.iter().filter(|of| **of != Intrinsic::EquationsAt) {
            assert_eq!(is_known(of), !ELSEWHERE.contains(&of), "{of:?}");
        }
    }
}
