//! All branches, and the positions on those that exist.

use linkage_ir::Name;
use linkage_ir::code::Code;
use linkage_runtime::PositionError;

use crate::error::Error;
use crate::machine::Machine;
use crate::machine::defect::Defect;
use crate::machine::failure::{Evaluated, Failure};
use crate::machine::value::Value;

/// The most branches that are listed: those of `Position::MOST_BRANCHES` of the compiler, and the numbers of modes.
const MOST_COMBINATIONS: usize = 1 << 20;

impl<'c> Machine<'c> {
    /// A value for each list of numbers below these counts.
    pub(super) fn combinations(&mut self, code: &'c Code, counts: &Value, of: &Value) -> Evaluated<Value> {
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
    pub(super) fn existing(&mut self, code: &'c Code, branches: &Value, assemble: &Value) -> Evaluated<Value> {
        let mut found = Vec::new();
        for branch in branches.as_list()? {
            match self.closure(code, assemble, [branch.clone()], true) {
                Ok(pose) => {
                    let fields = [(Name::BRANCH, branch.clone()), (Name::POSE, pose)];
                    found.push(Value::record(fields));
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
}
