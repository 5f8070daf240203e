//! The functions of the runtime, applied to values.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use linkage_dynamics::__rt::{self as dynamics, Balance, Contact, ContactCoordinate, ContactLaw};
use linkage_dynamics::MotionError;
use linkage_runtime::__rt::{self as rt, Triangle, Wide};
use linkage_runtime::{AssemblyMode, Column, D, Elbow, PositionError, Ranged};

use super::defect::Defect;
use super::failure::{Evaluated, Failure};
use super::groups::{columns, factorised, list, numbers, pivots, sized};
use super::scalar::{Scalar, Single};

use super::value::{Record, Turning, Value};
use super::{Kind, Machine};
use crate::code::{Function, Id, Name, Operation};
use crate::error::Error;
use crate::tape::{Chord, Flag, Test, Traced};

impl Operation {
    /// True if it returns an outcome, not a value.
    pub(super) fn is_fallible(self) -> bool {
        match self {
            Self::Finite
            | Self::FiniteEach
            | Self::FinitePoints
            | Self::FiniteVectors
            | Self::FiniteOutputs
            | Self::FiniteMatrix
            | Self::FinitePointMatrices
            | Self::FiniteOutputMatrices
            | Self::PointMotions
            | Self::OutputMotions
            | Self::Regular
            | Self::Solvable
            | Self::Reachable
            | Self::Implied
            | Self::NotNegative
            | Self::ValidateStops
            | Self::ValidateContacts
            | Self::ElbowChord
            | Self::Chord
            | Self::ReachChord
            | Self::Factorization
            | Self::NewtonGroup
            | Self::Modes
            | Self::ModesWithLengths
            | Self::Take
            | Self::Newton
            | Self::NewtonAnyBranch
            | Self::Countable
            | Self::Existing
            | Self::NoClosedForm
            | Self::NoList
            | Self::TooManyBranches
            | Self::Limits
            | Self::Failure
            | Self::And
            | Self::OrElse
            | Self::Reduced
            | Self::Reactions
            | Self::DriveForces
            | Self::BearingLoss
            | Self::EquationsAt
            | Self::Equilibrium
            | Self::Success => true,
            Self::ValueOf
            | Self::Present
            | Self::UnwrapOr
            | Self::Map
            | Self::Get
            | Self::AreFinite
            | Self::Sum
            | Self::Largest
            | Self::Listed
            | Self::Matrix
            | Self::InputsOf
            | Self::MechanismOf
            | Self::Parts
            | Self::SineCosine
            | Self::SinesCosines
            | Self::Direction
            | Self::At
            | Self::IsNonzero
            | Self::Closes
            | Self::RegularElbowChord
            | Self::RegularChord
            | Self::RegularReachChord
            | Self::SineInLane
            | Self::CosineInLane
            | Self::SineCosineInLane
            | Self::Arctangent2InLane
            | Self::HypotenuseInLane
            | Self::IsModerateInLane
            | Self::HasArctangent2InLane
            | Self::HasHypotenuseInLane
            | Self::IsSolvableInLane
            | Self::IsReachableInLane
            | Self::ElbowChordInLane
            | Self::ChordInLane
            | Self::ReachChordInLane
            | Self::ProductOfPivots
            | Self::Solve
            | Self::Refined
            | Self::Memory
            | Self::Turns
            | Self::NearestTurns
            | Self::InTurn
            | Self::InRange
            | Self::TurnsFound
            | Self::SideOf
            | Self::SideAt
            | Self::NumberOfMode
            | Self::ModeOfGuess
            | Self::Combinations
            | Self::LimitOfAngle
            | Self::LimitOfLength
            | Self::SearchLength
            | Self::SearchTurn
            | Self::NoSearch
            | Self::UnknownAngle
            | Self::Ranged
            | Self::RangedDirection
            | Self::RangedModuloTurns
            | Self::Widened
            | Self::Rounded => false,
        }
    }
}

impl Operation {
    /// The error of a function that is not there for mechanisms at run time, as [`WITHOUT`](super::WITHOUT) says.
    fn unavailable(self) -> Error {
        let function = match self {
            Self::Newton => "newton",
            Self::NewtonAnyBranch => "newton_any_branch",
            Self::Reactions => "reactions",
            Self::DriveForces => "drive_forces",
            Self::BearingLoss => "bearing_loss",
            Self::EquationsAt => "Equations::at",
            // The parts of its arguments are evaluated first.
            Self::LimitOfAngle | Self::LimitOfLength | Self::SearchLength | Self::SearchTurn | Self::Limits => "limits",
            _ => "",
        };
        Error::NotAvailable { function: function.into() }
    }
}

/// The arguments of an operation.
struct Arguments<'v>(&'v [Value]);

impl<'v> Arguments<'v> {
    fn at(&self, place: usize) -> Result<&'v Value, Defect> {
        self.0.get(place).ok_or_else(|| Defect::new("an argument that is not given"))
    }

    fn names(&self) -> Result<[&'v Arc<str>; 2], Defect> {
        Ok([self.at(0)?.as_text()?, self.at(1)?.as_text()?])
    }

    fn number<S: Scalar>(&self, place: usize) -> Result<S, Defect> {
        let value = self.at(place)?;
        S::of(value).ok_or_else(|| value.expected("a number"))
    }
}

/// True if every number is finite.
fn are_finite(value: &Value) -> bool {
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

/// The error of a quantity that is not finite.
fn not_finite([mechanism, quantity]: [&Arc<str>; 2]) -> Error {
    Error::Position(PositionError::NotFinite { mechanism: mechanism.clone(), quantity: quantity.clone() })
}

fn side(value: &Value) -> Result<Elbow, Defect> {
    match value {
        Value::Side(true) => Ok(Elbow::Left),
        Value::Side(false) => Ok(Elbow::Right),
        other => Err(other.expected("a side")),
    }
}

fn triangle<S: Single>(value: &Value) -> Result<Triangle<S>, Defect> {
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

/// A chord and whether its triangle is well conditioned.
fn flagged<S: Single>((chord, is_well_conditioned): (S, bool)) -> Value {
    Value::list([chord.into_value(), Value::Flag(is_well_conditioned)])
}

fn perhaps<S: Single>(found: Option<S>) -> Value {
    found.map_or(Value::Absent, S::into_value)
}

impl<'c> Machine<'c> {
    /// Applies a function of the runtime: the value of its success, or its value.
    pub(super) fn operation(&mut self, code: &'c Function, of: Operation, arguments: &'c [Id]) -> Evaluated<Value> {
        // Those that evaluate an argument in a way of their own.
        match (of, arguments) {
            (Operation::Success, [value]) => return self.value(code, *value),
            (Operation::Failure, [error]) => {
                return match self.value(code, *error)? {
                    Value::Outcome(outcome) => match &*outcome {
                        Err(error) => Err(error.clone().into()),
                        Ok(_) => Err(Defect::new("an error that is none").into()),
                    },
                    other => Err(other.expected("an error").into()),
                };
            }
            (Operation::And, [one, other]) => {
                self.success(code, *one)?;
                return self.success(code, *other);
            }
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

    fn applied<S: Single + 'static>(
        &mut self,
        code: &'c Function,
        of: Operation,
        values: &[Value],
    ) -> Evaluated<Value> {
        let arguments = Arguments(values);
        if let Some(value) = self.of_values(of, &arguments)? {
            return Ok(value);
        }
        if let Some(value) = self.checked(of, &arguments)? {
            return Ok(value);
        }
        let number = |place| arguments.number::<S>(place);
        Ok(match of {
            Operation::SineCosine => {
                let (sine, cosine) = number(0)?.sine_cosine();
                list([sine, cosine])
            }
            Operation::SinesCosines => sized!(arguments.at(0)?.as_list()?.len(), N => {
                let all = S::sines_cosines(numbers::<S, N>(arguments.at(0)?)?);
                Ok(Value::list(all.map(|(sine, cosine)| list([sine, cosine]))))
            })?,
            Operation::Largest => {
                let all = arguments.at(0)?.as_list()?.iter();
                let all = all.map(|value| S::of(value).ok_or_else(|| value.expected("a number")));
                rt::largest(all.collect::<Result<Vec<S>, _>>()?).into_value()
            }
            Operation::Regular => {
                let [mechanism, group] = arguments.names()?;
                rt::regular(&**mechanism, &**group, number(2)?, number(3)?).map_err(Error::from)?;
                Value::unit()
            }
            Operation::IsNonzero => Value::Flag(rt::is_nonzero(number(0)?, number(1)?)),
            Operation::Closes => Value::Flag(rt::closes(number(0)?, number(1)?)),
            Operation::Solvable => sized!(arguments.at(3)?.as_list()?.len(), N => {
                let [numerators, scales] = [3, 4].map(|place| arguments.at(place).and_then(numbers::<S, N>));
                let (determinant, numerators, scales) = (number(2)?, numerators?, scales?);
                self.located(&arguments, |mechanism, group| {
                    rt::solvable(mechanism, group, determinant, numerators, scales).map(|()| Value::unit())
                })
            })?,
            Operation::Reachable => {
                let distance = number(2)?;
                self.located(&arguments, |mechanism, group| {
                    rt::reachable(mechanism, group, distance).map(|()| Value::unit())
                })?
            }
            Operation::Implied => {
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
            Operation::ElbowChord => {
                let (triangle, side) = (triangle::<S>(arguments.at(2)?)?, side(arguments.at(3)?)?);
                self.located(&arguments, |mechanism, group| {
                    rt::elbow_chord(mechanism, group, triangle, side).map(flagged)
                })?
            }
            Operation::RegularElbowChord => {
                perhaps(rt::regular_elbow_chord(triangle::<S>(arguments.at(0)?)?, side(arguments.at(1)?)?))
            }
            Operation::Chord => {
                let (factors, radius) = (numbers::<S, 2>(arguments.at(2)?)?, number(3)?);
                let (scales, side) = (numbers(arguments.at(4)?)?, side(arguments.at(5)?)?);
                self.located(&arguments, |mechanism, group| {
                    rt::chord(mechanism, group, factors, radius, scales, side).map(S::into_value)
                })?
            }
            Operation::ReachChord => {
                let (factors, radius) = (numbers::<S, 2>(arguments.at(2)?)?, number(3)?);
                let (scales, side) = (numbers(arguments.at(4)?)?, side(arguments.at(5)?)?);
                self.located(&arguments, |mechanism, group| {
                    rt::reach_chord(mechanism, group, factors, radius, scales, side).map(S::into_value)
                })?
            }
            Operation::RegularChord => {
                perhaps(rt::regular_chord(numbers::<S, 2>(arguments.at(0)?)?, number(1)?, side(arguments.at(2)?)?))
            }
            Operation::RegularReachChord => {
                let factors = numbers::<S, 2>(arguments.at(0)?)?;
                perhaps(rt::regular_reach_chord(factors, number(1)?, number(2)?, side(arguments.at(3)?)?))
            }
            Operation::ProductOfPivots => pivots::<S>(arguments.at(0)?)?,
            Operation::Factorization => factorised::<S>(arguments.names()?, arguments.at(2)?, arguments.at(3)?)?,
            Operation::InRange => rt::in_range(number(0)?, number(1)?, number(2)?).into_value(),
            Operation::SideOf => Value::Side(rt::side_of::<S, Elbow>(number(0)?) == Elbow::Left),
            Operation::Refined => {
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
            Operation::NewtonGroup => {
                self.newton_group(code, arguments.names()?, arguments.at(2)?, arguments.at(3)?)?
            }
            Operation::Modes => {
                let names = [arguments.at(1)?.as_text()?, arguments.at(2)?.as_text()?];
                let functions = [arguments.at(4)?, arguments.at(5)?];
                self.modes(code, arguments.at(0)?, names, arguments.at(3)?, None, functions)?
            }
            Operation::ModesWithLengths => {
                let names = [arguments.at(1)?.as_text()?, arguments.at(2)?.as_text()?];
                let (are, functions) = (arguments.at(4)?, [arguments.at(5)?, arguments.at(6)?]);
                self.modes(code, arguments.at(0)?, names, arguments.at(3)?, Some(are), functions)?
            }
            Operation::Map => {
                let closure = arguments.at(1)?;
                let mut mapped = Vec::new();
                for value in arguments.at(0)?.as_list()? {
                    // Of items that are outcomes the errors stay.
                    mapped.push(self.closure(code, closure, [value.clone()], false)?);
                }
                Value::list(mapped)
            }
            Operation::OrElse => match arguments.at(0)? {
                Value::Outcome(outcome) => match &**outcome {
                    Ok(value) => value.clone(),
                    Err(error) => {
                        let error = Value::outcome(Err(error.clone()));
                        self.closure(code, arguments.at(1)?, [error], true)?
                    }
                },
                other => return Err(other.expected("an outcome").into()),
            },
            Operation::Combinations => self.combinations(code, arguments.at(0)?, arguments.at(1)?)?,
            Operation::Existing => self.existing(code, arguments.at(0)?, arguments.at(1)?)?,
            Operation::Reduced => self.reduced(&arguments)?,
            Operation::Equilibrium => self.equilibrium(code, &arguments)?,
            Operation::Ranged => ranged(&arguments, rt::ranged)?,
            Operation::RangedDirection => ranged(&arguments, rt::ranged_direction)?,
            Operation::RangedModuloTurns => ranged(&arguments, rt::ranged_modulo_turns)?,
            other => return Err(other.unavailable().into()),
        })
    }

    /// Operations on values that are no numbers of one scalar.
    fn of_values(&mut self, of: Operation, arguments: &Arguments) -> Evaluated<Option<Value>> {
        let value = || arguments.at(0);
        Ok(Some(match of {
            Operation::Present => value()?.clone(),
            Operation::ValueOf => match value()? {
                Value::Outcome(outcome) => outcome.as_ref().as_ref().map_or(Value::Absent, Value::clone),
                other => other.clone(),
            },
            Operation::UnwrapOr => match value()? {
                Value::Absent => arguments.at(1)?.clone(),
                present => present.clone(),
            },
            Operation::Get => {
                let place = arguments.at(1)?.as_count()?;
                value()?.as_list()?.get(place).cloned().unwrap_or(Value::Absent)
            }
            Operation::AreFinite => Value::Flag(are_finite(value()?)),
            Operation::Listed => match value()? {
                Value::Record(record) => Value::list(record.fields.iter().map(|(_, value)| value.clone())),
                other => Value::list(other.as_list()?.iter().cloned()),
            },
            Operation::Matrix => Value::Matrix(value()?.as_list()?.into()),
            Operation::Direction => Value::list([value()?.clone(), arguments.at(1)?.clone()]),
            Operation::InputsOf => {
                let all = value()?.as_record()?;
                self.named(self.driver.types.inputs, &self.driver.inputs, |name| all.get(name).cloned())?
            }
            Operation::MechanismOf => {
                let mut all = value()?.as_list()?.iter().cloned();
                self.named(self.driver.types.mechanism, &self.driver.parameters, |_| all.next())?
            }
            Operation::Parts => {
                let scene = self.scene.ok_or_else(|| Defect::new("a state without a scene"))?;
                let mut all = value()?.as_list()?.iter().cloned();
                let q = self.named(self.driver.types.coordinates, &self.driver.coordinates, |_| all.next())?;
                let rates = self.named(self.driver.types.inputs, &self.driver.inputs, |_| all.next())?;
                Value::record(scene.types.state, [(Name::Q, q), (Name::INPUT_RATES, rates)])
            }
            Operation::At => {
                Value::At(arguments.at(1)?.as_list()?.iter().map(|value| f64::of(value).unwrap_or(f64::NAN)).collect())
            }
            Operation::Solve => match value()? {
                Value::Factors(factors) => factors.solve(arguments.at(1)?)?,
                other => return Err(other.expected("factors").into()),
            },
            Operation::Take => match (value()?, arguments.at(3)?) {
                (Value::Modes(modes), Value::Mode(mode)) => {
                    modes.take([arguments.at(1)?.as_text()?, arguments.at(2)?.as_text()?], *mode)?
                }
                (other, _) => return Err(other.expected("modes").into()),
            },
            Operation::Memory => Value::Memory(Rc::default()),
            Operation::Turns => Value::Turns(Rc::new(Turning::given(value()?)?)),
            Operation::NearestTurns => Value::Turns(Rc::new(Turning::nearest(value()?)?)),
            Operation::InTurn => match value()? {
                Value::Turns(turns) => turns.number(arguments.at(1)?.as_count()?, arguments.at(2)?)?,
                other => return Err(other.expected("turns").into()),
            },
            Operation::TurnsFound => match value()? {
                Value::Turns(turns) => turns.found()?,
                other => return Err(other.expected("turns").into()),
            },
            Operation::SideAt => Value::Side(value()?.as_count()? == 0),
            Operation::NumberOfMode => Value::Mode(AssemblyMode::Number(value()?.as_count()?)),
            Operation::ModeOfGuess => Value::Mode(AssemblyMode::OfGuess),
            Operation::UnknownAngle | Operation::NoSearch => Value::Absent,
            Operation::Widened => value()?.map_leaves(&mut |leaf| match leaf {
                Value::Number(number) => Value::Wide((*number).into()),
                other => other.clone(),
            }),
            Operation::Rounded => rounded(value()?),
            _ => return Ok(None),
        }))
    }

    /// A record with these fields.
    fn named(&self, of: Name, names: &[Name], mut value: impl FnMut(Name) -> Option<Value>) -> Result<Value, Defect> {
        let fields = names.iter().map(|name| {
            let value = value(*name).ok_or_else(|| Defect::new("a field that is not given"))?;
            Ok((*name, value))
        });
        let fields = fields.collect::<Result<Vec<_>, _>>()?;
        Ok(Value::Record(Rc::new(Record { of, fields })))
    }

    /// Checks that numbers are finite, and the values made of those that are.
    fn checked(&self, of: Operation, arguments: &Arguments) -> Evaluated<Option<Value>> {
        let checked = |place: usize| -> Evaluated<&Value> {
            let value = arguments.at(place)?;
            if are_finite(value) { Ok(value) } else { Err(not_finite(arguments.names()?).into()) }
        };
        let points = |all: &Value| self.named(self.driver.types.points, &self.driver.points, entries(all)?);
        let outputs = |all: &Value| self.named(self.driver.types.outputs, &self.driver.outputs, entries(all)?);
        let motions = |of: Name, names: [Name; 3]| {
            let all = arguments.at(1)?;
            if !are_finite(all) {
                return Err(Box::from(not_finite([arguments.at(0)?.as_text()?, &"motion".into()])));
            }
            let motion = |value: &Value| {
                let parts = value.as_list()?.iter().cloned();
                Ok::<_, Defect>(Value::record(of, names.into_iter().zip(parts)))
            };
            let all = all.as_list()?.iter().map(motion).collect::<Result<Vec<_>, _>>()?;
            Ok(Value::list(all))
        };
        Ok(Some(match of {
            Operation::Finite | Operation::FiniteMatrix => {
                checked(2)?;
                Value::unit()
            }
            Operation::FiniteEach => {
                let scene = arguments.at(0)?.as_text()?;
                for pair in arguments.at(1)?.as_list()? {
                    let [quantity, value] = pair.as_list()? else {
                        return Err(pair.expected("a pair").into());
                    };
                    if !are_finite(value) {
                        return Err(not_finite([scene, quantity.as_text()?]).into());
                    }
                }
                Value::unit()
            }
            Operation::FinitePoints | Operation::FiniteVectors => points(checked(2)?)?,
            Operation::FiniteOutputs => outputs(checked(2)?)?,
            Operation::FinitePointMatrices => points(&matrices(checked(2)?)?)?,
            Operation::FiniteOutputMatrices => outputs(&matrices(checked(2)?)?)?,
            Operation::PointMotions => {
                points(&motions(self.driver.types.point_motion, [Name::POSITION, Name::VELOCITY, Name::ACCELERATION])?)?
            }
            Operation::OutputMotions => {
                outputs(&motions(self.driver.types.output_motion, [Name::VALUE, Name::RATE, Name::ACCELERATION])?)?
            }
            Operation::Countable => {
                let mechanism = arguments.at(0)?.as_text()?;
                for guess in arguments.at(1)?.as_list()? {
                    let guess = f64::of(guess).ok_or_else(|| guess.expected("a number"))?;
                    rt::countable(&**mechanism, [guess]).map_err(Error::from)?;
                }
                Value::unit()
            }
            Operation::NoClosedForm | Operation::NoList => {
                let [mechanism, group] = arguments.names()?.map(Arc::clone);
                return Err(Error::Position(PositionError::NoClosedForm { mechanism, group }).into());
            }
            Operation::TooManyBranches => {
                let mechanism = arguments.at(0)?.as_text()?.clone();
                return Err(Error::Position(PositionError::TooManyBranches { mechanism }).into());
            }
            Operation::ValidateStops => {
                let scene = arguments.at(0)?.as_text()?;
                for stop in arguments.at(1)?.as_list()? {
                    let [name, lower, upper, restitution] = stop.as_list()? else {
                        return Err(stop.expected("a stop").into());
                    };
                    let [lower, upper, restitution] = [lower, upper, restitution].map(number);
                    let stop = (&**name.as_text()?, lower?, upper?, restitution?);
                    dynamics::validate_stops(&**scene, [stop]).map_err(Error::from)?;
                }
                Value::unit()
            }
            Operation::ValidateContacts => {
                let scene = arguments.at(0)?.as_text()?;
                for contact in arguments.at(1)?.as_list()? {
                    self.validate(scene, contact)?;
                }
                arguments.at(1)?.clone()
            }
            Operation::NotNegative => {
                let scene = arguments.at(0)?.as_text()?;
                for pair in arguments.at(1)?.as_list()? {
                    let [quantity, value] = pair.as_list()? else {
                        return Err(pair.expected("a pair").into());
                    };
                    let value = f64::of(value).ok_or_else(|| value.expected("a number"))?;
                    dynamics::not_negative(&**scene, [(&**quantity.as_text()?, value)]).map_err(Error::from)?;
                }
                Value::unit()
            }
            _ => return Ok(None),
        }))
    }

    /// Checks the numbers of a contact.
    fn validate(&self, scene: &Arc<str>, contact: &Value) -> Evaluated<()> {
        let (along, law) = (contact.field(Name::ALONG)?, contact.field(Name::LAW)?.as_record()?);
        // Of the derivatives only whether they are finite matters: the types of others have their number.
        let bias = if are_finite(along) { number(along.field(Name::BIAS)?)? } else { f64::NAN };
        let along = ContactCoordinate {
            value: number(along.field(Name::VALUE)?)?,
            unknowns: Column::zeros(),
            inputs: Column::zeros(),
            bias,
        };
        let of_law = |name| number(law.get(name).unwrap_or(&Value::Absent));
        let law = match self.driver.names.text(law.of) {
            "ContactLaw::Friction" => ContactLaw::Friction { limit: of_law(Name::LIMIT)? },
            "ContactLaw::Bearing" => ContactLaw::Bearing { factor: of_law(Name::FACTOR)? },
            _ => ContactLaw::Stop {
                lower: of_law(Name::LOWER)?,
                upper: of_law(Name::UPPER)?,
                restitution: of_law(Name::RESTITUTION)?,
            },
        };
        let contact: Contact<f64, D<0>, D<0>, &str> =
            Contact { name: contact.field(Name::NAME)?.as_text()?, along, law };
        dynamics::validate_contacts(&**scene, [contact]).map_err(Error::from)?;
        Ok(())
    }

    /// The position at rest near the start.
    fn equilibrium(&mut self, code: &'c Function, arguments: &Arguments) -> Evaluated<Value> {
        let (scene, start, evaluation) = (arguments.at(0)?.as_text()?, arguments.at(1)?, arguments.at(2)?);
        sized!(start.as_list()?.len(), N => {
            let start = numbers::<f64, N>(start)?;
            let machine = RefCell::new(self);
            // The error of an evaluation, in place of the one that stands for it.
            let failed = RefCell::new(None);
            let evaluate = |at: [f64; N]| {
                let evaluated = machine.borrow_mut().balance(code, evaluation, at);
                evaluated.map_err(|failure| {
                    *failed.borrow_mut() = Some(failure);
                    MotionError::NotFinite { quantity: "", t: f64::NAN }
                })
            };
            match dynamics::equilibrium(&**scene, start, evaluate) {
                Ok(found) => Ok(found),
                Err(MotionError::NotFinite { quantity: "", .. }) => {
                    Err(failed.into_inner().unwrap_or_else(|| Defect::new("an error without a reason").into()))
                }
                Err(error) => Err(Error::from(error).into()),
            }
        })
    }

    /// A position and the balance of its forces.
    fn balance<const N: usize>(
        &mut self,
        code: &'c Function,
        evaluation: &Value,
        at: [f64; N],
    ) -> Evaluated<(Value, Balance<f64, N>)> {
        let found = self.closure(code, evaluation, [list(at)], true)?;
        let [q, balance] = found.as_list()? else { return Err(found.expected("a pair").into()) };
        let [forces, scales] = [Name::FORCES, Name::SCALES].map(|name| balance.field(name).and_then(numbers));
        let slopes = columns(balance.field(Name::SLOPES)?)?;
        Ok((q.clone(), Balance { forces: forces?, scales: scales?, slopes }))
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

    /// A value for each list of numbers below these counts.
    fn combinations(&mut self, code: &'c Function, counts: &Value, of: &Value) -> Evaluated<Value> {
        let counts = counts.as_list()?.iter().map(Value::as_count).collect::<Result<Vec<_>, _>>()?;
        let all = counts.iter().try_fold(1_usize, |all, count| all.checked_mul(*count));
        let all = all.filter(|all| *all <= MOST_COMBINATIONS).ok_or_else(|| Defect::new("too many branches"))?;
        let mut found = Vec::with_capacity(all);
        for place in 0..all {
            let (mut numbers, mut left) = (counts.clone(), place);
            for number in numbers.iter_mut().rev() {
                let count = *number;
                (*number, left) = (left % count, left / count);
            }
            let numbers = Value::list(numbers.into_iter().map(|number| Value::Count(number as i64)));
            found.push(self.closure(code, of, [numbers], false)?);
        }
        Ok(Value::list(found))
    }

    /// The positions on those of these branches that exist.
    fn existing(&mut self, code: &'c Function, branches: &Value, assemble: &Value) -> Evaluated<Value> {
        let mut found = Vec::new();
        for branch in branches.as_list()? {
            match self.closure(code, assemble, [branch.clone()], true) {
                Ok(pose) => {
                    let fields = [(Name::BRANCH, branch.clone()), (Name::POSE, pose)];
                    found.push(Value::record(self.driver.types.assembled, fields));
                }
                Err(failure) => match *failure {
                    Failure::Error(Error::Position(
                        PositionError::Unbuildable { .. }
                        | PositionError::NoMode { .. }
                        | PositionError::Undetermined { .. }
                        | PositionError::NotImplied { .. },
                    )) => {}
                    other => return Err(Box::new(other)),
                },
            }
        }
        Ok(Value::list(found))
    }

    /// The accelerations of the free inputs from masses and forces.
    fn reduced(&self, arguments: &Arguments) -> Evaluated<Value> {
        let (scene, coordinates) = (arguments.at(0)?.as_text()?, arguments.at(1)?.as_list()?);
        sized!(coordinates.len(), N => {
            let mut names = [""; N];
            for (name, value) in names.iter_mut().zip(coordinates) {
                *name = value.as_text()?;
            }
            let (masses, forces) = (columns::<f64, N, N>(arguments.at(2)?)?, numbers(arguments.at(3)?)?);
            Ok(list(dynamics::reduced(&**scene, names, masses, forces).map_err(Error::from)?))
        })
    }
}

/// The most branches that are listed: those of `Position::MOST_BRANCHES` of the compiler, and the numbers of modes.
const MOST_COMBINATIONS: usize = 1 << 20;

/// The matrices of these columns.
fn matrices(all: &Value) -> Result<Value, Defect> {
    let matrix = |columns: &Value| Ok(Value::Matrix(columns.as_list()?.into()));
    all.as_list()?.iter().map(matrix).collect::<Result<Vec<_>, _>>().map(Value::list)
}

fn number(value: &Value) -> Result<f64, Defect> {
    f64::of(value).ok_or_else(|| value.expected("a number"))
}

/// A value with a range.
fn ranged(arguments: &Arguments, made: impl Fn(f64, Option<f64>, Option<f64>) -> Ranged<f64>) -> Result<Value, Defect> {
    let end = |place| match arguments.at(place)? {
        Value::Absent => Ok(None),
        value => number(value).map(Some),
    };
    let Ranged { value, least, most, is_direction } = made(arguments.number(0)?, end(1)?, end(2)?);
    let end = |end: Option<f64>| end.map_or(Value::Absent, Value::Number);
    Ok(Value::record(
        Name::RANGED,
        [
            (Name::VALUE, Value::Number(value)),
            (Name::LEAST, end(least)),
            (Name::MOST, end(most)),
            (Name::IS_DIRECTION, Value::Flag(is_direction)),
        ],
    ))
}

/// The entries of a list, one after the other.
fn entries(all: &Value) -> Result<impl FnMut(Name) -> Option<Value> + use<'_>, Defect> {
    let mut all = all.as_list()?.iter().cloned();
    Ok(move |_| all.next())
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

/// The forms over lanes; `None` for an operation that has none of its own.
fn in_lanes(of: Operation, arguments: &Arguments) -> Evaluated<Option<Value>> {
    let number = |place| arguments.number::<Traced>(place);
    let flag = |flag: Flag| match flag {
        Flag::Constant(flag) => Value::Flag(flag),
        register => Value::TracedFlag(register),
    };
    let none = Traced::Constant(0.0);
    let test = |of: Test| Ok::<_, Defect>(flag(number(0)?.test(of, &none)));
    let test_of_two = |of: Test| Ok::<_, Defect>(flag(number(0)?.test(of, &number(1)?)));
    let chord = |of: Chord, place: usize, numbers: Vec<Traced>| {
        let (chord, is_right) = Traced::chord(of, side(arguments.at(place)?)?, &numbers);
        Ok::<_, Defect>(Value::list([chord.into_value(), flag(is_right)]))
    };
    Ok(Some(match of {
        Operation::SineInLane => number(0)?.sine().into_value(),
        Operation::CosineInLane => number(0)?.cosine().into_value(),
        Operation::SineCosineInLane => Value::list(number(0)?.sine_cosine().map(Traced::into_value)),
        Operation::Arctangent2InLane => number(0)?.arctangent2(&number(1)?).into_value(),
        Operation::HypotenuseInLane => number(0)?.hypotenuse(&number(1)?).into_value(),
        Operation::InRange => number(0)?.in_range(&number(1)?, &number(2)?).into_value(),
        Operation::IsModerateInLane => test(Test::IsModerate)?,
        Operation::IsSolvableInLane => test(Test::IsSolvable)?,
        Operation::IsReachableInLane => test(Test::IsReachable)?,
        Operation::HasArctangent2InLane => test_of_two(Test::HasArctangent2)?,
        Operation::HasHypotenuseInLane => test_of_two(Test::HasHypotenuse)?,
        Operation::IsNonzero => test_of_two(Test::IsNonzero)?,
        Operation::Closes => test_of_two(Test::Closes)?,
        Operation::AreFinite => {
            let mut are_finite = Flag::Constant(true);
            arguments.at(0)?.each_leaf(&mut |leaf| {
                if let Some(number) = Traced::of(leaf) {
                    are_finite = are_finite.and(&number.test(Test::IsFinite, &none));
                }
            });
            flag(are_finite)
        }
        Operation::ElbowChordInLane => {
            let of = arguments.at(0)?;
            let mut numbers = Vec::new();
            for name in
                [Name::LINKS, Name::LINE, Name::SCALE, Name::REACH_SQUARED, Name::DISTANCE_SQUARED, Name::FACTORS]
            {
                of.field(name)?.each_leaf(&mut |leaf| numbers.extend(Traced::of(leaf)));
            }
            chord(Chord::Elbow, 1, numbers)?
        }
        Operation::ChordInLane => chord(Chord::Factors, 1, traced(arguments.at(0)?))?,
        Operation::ReachChordInLane => {
            let mut numbers = traced(arguments.at(0)?);
            numbers.extend([number(1)?, number(2)?]);
            chord(Chord::Reach, 3, numbers)?
        }
        _ => return Ok(None),
    }))
}

/// The numbers of a list.
fn traced(value: &Value) -> Vec<Traced> {
    let mut all = Vec::new();
    value.each_leaf(&mut |leaf| all.extend(Traced::of(leaf)));
    all
}
