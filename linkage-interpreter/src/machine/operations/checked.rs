//! Checks: the runtime's errors for numbers that are not finite or out of range, and values made of those that pass.

use std::sync::Arc;

use linkage_dynamics::__rt::{self as dynamics, Contact, ContactCoordinate, ContactLaw};
use linkage_ir::Intrinsic;
use linkage_ir::Name;
use linkage_runtime::__rt as rt;
use linkage_runtime::{Column, D, PositionError};

use super::arguments::{Arguments, are_finite, number};
use crate::error::Error;
use crate::machine::Machine;
use crate::machine::defect::Defect;
use crate::machine::failure::Evaluated;
use crate::machine::scalar::Scalar as _;
use crate::machine::value::Value;

/// The error of a quantity that is not finite.
fn not_finite([mechanism, quantity]: [&Arc<str>; 2]) -> Error {
    Error::Position(PositionError::NotFinite { mechanism: mechanism.clone(), quantity: quantity.clone() })
}

impl Machine<'_> {
    /// Checks that numbers are finite, and the values made of those that are.
    pub(super) fn checked(&self, of: Intrinsic, arguments: &Arguments) -> Evaluated<Option<Value>> {
        let checked = |place: usize| -> Evaluated<&Value> {
            let value = arguments.at(place)?;
            if are_finite(value) { Ok(value) } else { Err(not_finite(arguments.names()?).into()) }
        };
        let points = |all: &Value| self.named(&self.driver.points, entries(all)?);
        let outputs = |all: &Value| self.named(&self.driver.outputs, entries(all)?);
        let motions = |names: [Name; 3]| {
            let all = arguments.at(1)?;
            if !are_finite(all) {
                return Err(Box::from(not_finite([arguments.at(0)?.as_text()?, &"motion".into()])));
            }
            let motion = |value: &Value| {
                let parts = value.as_list()?.iter().cloned();
                Ok::<_, Defect>(Value::record(names.into_iter().zip(parts)))
            };
            let all = all.as_list()?.iter().map(motion).collect::<Result<Vec<_>, _>>()?;
            Ok(Value::list(all))
        };
        Ok(Some(match of {
            Intrinsic::Finite | Intrinsic::FiniteMatrix => {
                checked(2)?;
                Value::unit()
            }
            Intrinsic::FiniteEach => {
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
            Intrinsic::FinitePoints | Intrinsic::FiniteVectors => points(checked(2)?)?,
            Intrinsic::FiniteOutputs => outputs(checked(2)?)?,
            Intrinsic::FiniteMatrices => {
                let all = matrices(checked(2)?)?;
                if arguments.at(1)?.as_text()?.starts_with("point") { points(&all)? } else { outputs(&all)? }
            }
            Intrinsic::PointMotions => points(&motions([Name::POSITION, Name::VELOCITY, Name::ACCELERATION])?)?,
            Intrinsic::OutputMotions => outputs(&motions([Name::VALUE, Name::RATE, Name::ACCELERATION])?)?,
            Intrinsic::Countable => {
                let mechanism = arguments.at(0)?.as_text()?;
                for guess in arguments.at(1)?.as_list()? {
                    let guess = f64::of(guess).ok_or_else(|| guess.expected("a number"))?;
                    rt::countable(&**mechanism, [guess]).map_err(Error::from)?;
                }
                Value::unit()
            }
            Intrinsic::NoClosedForm | Intrinsic::NoList => {
                let [mechanism, group] = arguments.names()?.map(Arc::clone);
                return Err(Error::Position(PositionError::NoClosedForm { mechanism, group }).into());
            }
            Intrinsic::TooManyBranches => {
                let mechanism = arguments.at(0)?.as_text()?.clone();
                return Err(Error::Position(PositionError::TooManyBranches { mechanism }).into());
            }
            Intrinsic::ValidateStops => {
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
            Intrinsic::ValidateContacts => {
                let scene = arguments.at(0)?.as_text()?;
                for contact in arguments.at(1)?.as_list()? {
                    self.validate(scene, contact)?;
                }
                arguments.at(1)?.clone()
            }
            Intrinsic::NotNegative => {
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
        let law = match law.of {
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
}

/// The matrices of these columns.
fn matrices(all: &Value) -> Result<Value, Defect> {
    let matrix = |columns: &Value| Ok(Value::Matrix(columns.as_list()?.into()));
    all.as_list()?.iter().map(matrix).collect::<Result<Vec<_>, _>>().map(Value::list)
}

/// The entries of a list, one after the other.
fn entries(all: &Value) -> Result<impl FnMut(Name) -> Option<Value> + use<'_>, Defect> {
    let mut all = all.as_list()?.iter().cloned();
    Ok(move |_| all.next())
}
