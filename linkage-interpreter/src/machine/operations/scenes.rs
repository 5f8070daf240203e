//! Accelerations and the position at rest of a scene.

use std::cell::RefCell;

use linkage_dynamics::__rt::{self as dynamics, Balance};
use linkage_dynamics::MotionError;
use linkage_ir::Name;
use linkage_ir::code::Code;

use super::arguments::Arguments;
use crate::error::Error;
use crate::machine::Machine;
use crate::machine::defect::Defect;
use crate::machine::failure::Evaluated;
use crate::machine::groups::{columns, list, numbers, sized};
use crate::machine::value::Value;

impl<'c> Machine<'c> {
    /// The position at rest near the start.
    pub(super) fn equilibrium(&mut self, code: &'c Code, arguments: &Arguments) -> Evaluated<Value> {
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
        code: &'c Code,
        evaluation: &Value,
        at: [f64; N],
    ) -> Evaluated<(Value, Balance<f64, N>)> {
        let found = self.closure(code, evaluation, [list(at)], true)?;
        let [q, balance] = found.as_list()? else { return Err(found.expected("a pair").into()) };
        let [forces, scales] = [Name::FORCES, Name::SCALES].map(|name| balance.field(name).and_then(numbers));
        let slopes = columns(balance.field(Name::SLOPES)?)?;
        Ok((q.clone(), Balance { forces: forces?, scales: scales?, slopes }))
    }

    /// The accelerations of the free inputs from masses and forces.
    pub(super) fn reduced(&self, arguments: &Arguments) -> Evaluated<Value> {
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
