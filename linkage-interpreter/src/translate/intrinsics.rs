//! The functions that emitted code calls and does not define: those that depend on types, or are other expressions here.

use linkage_compiler::lower::{self, ValueId};
use linkage_compiler::program::{Intrinsic, Type as TypeOf};

use super::{Translated, Translator};
use crate::code::{Constant, Expression, Id, Made, Type};

impl Translator<'_> {
    pub(super) fn intrinsic(
        &mut self,
        of: Intrinsic,
        of_type: Option<&TypeOf>,
        arguments: &[ValueId],
    ) -> Translated<Id> {
        let of = match of {
            // The value itself.
            Intrinsic::Into | Intrinsic::Iter | Intrinsic::Copied | Intrinsic::EachSized => {
                return self.value(arguments[0]);
            }
            Intrinsic::From => {
                let value = self.value(arguments[0])?;
                let made = match of_type {
                    Some(TypeOf::Bare(name)) if *name == self.context.types.inputs => Made::Inputs,
                    Some(TypeOf::Bare(name)) if *name == self.context.types.driver => Made::Mechanism,
                    Some(TypeOf::List(..)) => Made::List,
                    Some(TypeOf::Runtime("SMatrix" | "Matrix", _) | TypeOf::Sized("Matrix", _)) => Made::Matrix,
                    Some(TypeOf::Runtime(..) | TypeOf::Sized(..) | TypeOf::Tuple(_) | TypeOf::Column(..)) => {
                        return Ok(value);
                    }
                    other => return Err(format!("from of {other:?}")),
                };
                return Ok(self.add(Expression::Made(made, value)));
            }
            Intrinsic::Zeros => {
                let (rows, columns) = match of_type {
                    Some(TypeOf::Runtime(_, sizes)) if sizes.len() == 2 => (sizes[0], sizes[1]),
                    other => return Err(format!("zeros of {other:?}")),
                };
                let zero = self.add(Expression::Number(Constant::Double(0.0)));
                let column = self.add(Expression::Repeated(zero, rows));
                let all = self.add(Expression::Repeated(column, columns));
                return Ok(self.add(Expression::Made(Made::Matrix, all)));
            }
            Intrinsic::OnlyBranch => {
                let name = self.context.types.branch.clone();
                let name = self.names.of(&name);
                return Ok(self.add(Expression::Record(name, Vec::new(), None)));
            }
            Intrinsic::All => return self.of_type(Type::Branch, "all", arguments),
            Intrinsic::Coordinates => return self.of_type(Type::Pose, "coordinates", arguments),
            Intrinsic::Square => {
                let value = self.value(arguments[0])?;
                return Ok(self.add(Expression::Square(value)));
            }
            // Of each number.
            Intrinsic::Map | Intrinsic::AreAll => {
                let of = match arguments.get(1).map(|id| self.code.operation(*id)) {
                    Some(lower::Value::Function(Intrinsic::Widened, _)) => Intrinsic::Widened,
                    _ if of == Intrinsic::AreAll => Intrinsic::IsFinite,
                    _ => of,
                };
                let count = if of == Intrinsic::Map { arguments.len() } else { 1 };
                let arguments = self.values(&arguments[..count])?;
                return Ok(self.add(Expression::Intrinsic(of, arguments)));
            }
            // Numbers of any kind.
            Intrinsic::Pi | Intrinsic::Unknown => return Err(format!("{of:?}")),
            of => of,
        };
        let arguments = self.values(arguments)?;
        Ok(self.add(Expression::Intrinsic(of, arguments)))
    }

    /// A call of a function of a pose or a branch.
    fn of_type(&mut self, of: Type, name: &str, arguments: &[ValueId]) -> Translated<Id> {
        let all = match of {
            Type::Pose => &self.context.of_pose,
            Type::Branch => &self.context.of_branch,
        };
        let place = all.iter().position(|other| other == name).ok_or_else(|| format!("a call of {name}"))?;
        let arguments = self.values(arguments)?;
        Ok(self.add(Expression::OfType(of, place, arguments)))
    }
}
