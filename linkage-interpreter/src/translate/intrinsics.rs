//! The functions that emitted code calls and does not define, as operations of the machine. A new one has no case here: it
//! does not compile.

use linkage_compiler::lower::{self, ValueId};
use linkage_compiler::program::{Intrinsic, Type as TypeOf};

use super::{Translated, Translator};
use crate::code::{Constant, Expression, Id, Operation, Type};

impl Translator<'_> {
    pub(super) fn intrinsic(
        &mut self,
        of: Intrinsic,
        of_type: Option<&TypeOf>,
        arguments: &[ValueId],
    ) -> Translated<Id> {
        let to_points = |arguments: &[ValueId]| {
            let word = arguments.get(1).map(|id| self.code.operation(*id));
            matches!(word, Some(lower::Value::Text(text)) if text.starts_with("point"))
        };
        let operation = match of {
            // The value itself.
            Intrinsic::Into | Intrinsic::Iter | Intrinsic::Copied | Intrinsic::EachSized => {
                return self.value(arguments[0]);
            }
            Intrinsic::From => match of_type {
                Some(TypeOf::Bare(name)) if *name == self.context.types.inputs => Operation::InputsOf,
                Some(TypeOf::Bare(name)) if *name == self.context.types.driver => Operation::MechanismOf,
                Some(TypeOf::List(..)) => Operation::Listed,
                Some(TypeOf::Runtime("SMatrix" | "Matrix", _) | TypeOf::Sized("Matrix", _)) => Operation::Matrix,
                Some(TypeOf::Runtime(..) | TypeOf::Sized(..) | TypeOf::Tuple(_) | TypeOf::Column(..)) => {
                    return self.value(arguments[0]);
                }
                other => return Err(format!("from of {other:?}")),
            },
            Intrinsic::Zeros => {
                let (rows, columns) = match of_type {
                    Some(TypeOf::Runtime(_, sizes)) if sizes.len() == 2 => (sizes[0], sizes[1]),
                    other => return Err(format!("zeros of {other:?}")),
                };
                let zero = self.add(Expression::Number(Constant::Double(0.0)));
                let column = self.add(Expression::Repeated(zero, rows));
                let all = self.add(Expression::Repeated(column, columns));
                return Ok(self.add(Expression::Operation(Operation::Matrix, vec![all])));
            }
            Intrinsic::OnlyBranch => {
                let name = self.context.types.branch.clone();
                let name = self.names.of(&name);
                return Ok(self.add(Expression::Record(name, Vec::new(), None)));
            }
            Intrinsic::Default => Operation::Memory,
            Intrinsic::New => Operation::NearestTurns,
            Intrinsic::All => return self.of_type(Type::Branch, "all", arguments),
            Intrinsic::Coordinates => return self.of_type(Type::Pose, "coordinates", arguments),
            Intrinsic::Parts => Operation::Parts,
            Intrinsic::Map => match arguments.get(1).map(|id| self.code.operation(*id)) {
                Some(lower::Value::Function(Intrinsic::Widened, _)) => {
                    let value = self.value(arguments[0])?;
                    return Ok(self.add(Expression::Operation(Operation::Widened, vec![value])));
                }
                _ => Operation::Map,
            },
            Intrinsic::AreAll => {
                let value = self.value(arguments[0])?;
                return Ok(self.add(Expression::Operation(Operation::AreFinite, vec![value])));
            }
            Intrinsic::Square => {
                let value = self.value(arguments[0])?;
                return Ok(self.add(Expression::Square(value)));
            }
            Intrinsic::Some => Operation::Present,
            Intrinsic::Ok => Operation::Success,
            Intrinsic::Err => Operation::Failure,
            Intrinsic::ValueOf => Operation::ValueOf,
            Intrinsic::And => Operation::And,
            Intrinsic::OrElse => Operation::OrElse,
            Intrinsic::Get => Operation::Get,
            Intrinsic::UnwrapOr => Operation::UnwrapOr,
            Intrinsic::IsFinite => Operation::AreFinite,
            Intrinsic::Sum => Operation::Sum,
            Intrinsic::SineCosine => Operation::SineCosine,
            Intrinsic::SinesCosines => Operation::SinesCosines,
            Intrinsic::Largest => Operation::Largest,
            Intrinsic::Unit => Operation::Direction,
            Intrinsic::Finite => Operation::Finite,
            Intrinsic::FiniteEach => Operation::FiniteEach,
            Intrinsic::FinitePoints => Operation::FinitePoints,
            Intrinsic::FiniteVectors => Operation::FiniteVectors,
            Intrinsic::FiniteOutputs => Operation::FiniteOutputs,
            Intrinsic::FiniteMatrix => Operation::FiniteMatrix,
            Intrinsic::FiniteMatrices if to_points(arguments) => Operation::FinitePointMatrices,
            Intrinsic::FiniteMatrices => Operation::FiniteOutputMatrices,
            Intrinsic::PointMotions => Operation::PointMotions,
            Intrinsic::OutputMotions => Operation::OutputMotions,
            Intrinsic::At => Operation::At,
            Intrinsic::Regular => Operation::Regular,
            Intrinsic::IsNonzero => Operation::IsNonzero,
            Intrinsic::Closes => Operation::Closes,
            Intrinsic::Solvable => Operation::Solvable,
            Intrinsic::Reachable => Operation::Reachable,
            Intrinsic::Implied => Operation::Implied,
            Intrinsic::NotNegative => Operation::NotNegative,
            Intrinsic::ValidateStops => Operation::ValidateStops,
            Intrinsic::ValidateContacts => Operation::ValidateContacts,
            Intrinsic::ElbowChord => Operation::ElbowChord,
            Intrinsic::RegularElbowChord => Operation::RegularElbowChord,
            Intrinsic::Chord => Operation::Chord,
            Intrinsic::ReachChord => Operation::ReachChord,
            Intrinsic::RegularChord => Operation::RegularChord,
            Intrinsic::RegularReachChord => Operation::RegularReachChord,
            Intrinsic::SineInLane => Operation::SineInLane,
            Intrinsic::CosineInLane => Operation::CosineInLane,
            Intrinsic::SineCosineInLane => Operation::SineCosineInLane,
            Intrinsic::Arctangent2InLane => Operation::Arctangent2InLane,
            Intrinsic::HypotenuseInLane => Operation::HypotenuseInLane,
            Intrinsic::IsModerateInLane => Operation::IsModerateInLane,
            Intrinsic::HasArctangent2InLane => Operation::HasArctangent2InLane,
            Intrinsic::HasHypotenuseInLane => Operation::HasHypotenuseInLane,
            Intrinsic::IsSolvableInLane => Operation::IsSolvableInLane,
            Intrinsic::IsReachableInLane => Operation::IsReachableInLane,
            Intrinsic::ElbowChordInLane => Operation::ElbowChordInLane,
            Intrinsic::ChordInLane => Operation::ChordInLane,
            Intrinsic::ReachChordInLane => Operation::ReachChordInLane,
            Intrinsic::ProductOfPivots => Operation::ProductOfPivots,
            Intrinsic::Factorization => Operation::Factorization,
            Intrinsic::Solve => Operation::Solve,
            Intrinsic::Refined => Operation::Refined,
            Intrinsic::NewtonGroup => Operation::NewtonGroup,
            Intrinsic::Modes => Operation::Modes,
            Intrinsic::ModesWithLengths => Operation::ModesWithLengths,
            Intrinsic::Take => Operation::Take,
            Intrinsic::Newton => Operation::Newton,
            Intrinsic::NewtonAnyBranch => Operation::NewtonAnyBranch,
            Intrinsic::Turns => Operation::Turns,
            Intrinsic::InTurn => Operation::InTurn,
            Intrinsic::InRange => Operation::InRange,
            Intrinsic::TurnsFound => Operation::TurnsFound,
            Intrinsic::Countable => Operation::Countable,
            Intrinsic::SideOf => Operation::SideOf,
            Intrinsic::SideAt => Operation::SideAt,
            Intrinsic::NumberOfMode => Operation::NumberOfMode,
            Intrinsic::Combinations => Operation::Combinations,
            Intrinsic::Existing => Operation::Existing,
            Intrinsic::NoClosedForm => Operation::NoClosedForm,
            Intrinsic::NoList => Operation::NoList,
            Intrinsic::TooManyBranches => Operation::TooManyBranches,
            Intrinsic::Limits => Operation::Limits,
            Intrinsic::LimitOfAngle => Operation::LimitOfAngle,
            Intrinsic::LimitOfLength => Operation::LimitOfLength,
            Intrinsic::SearchLength => Operation::SearchLength,
            Intrinsic::Ranged => Operation::Ranged,
            Intrinsic::RangedDirection => Operation::RangedDirection,
            Intrinsic::RangedModuloTurns => Operation::RangedModuloTurns,
            // All convert each number.
            Intrinsic::Widened | Intrinsic::WidenedDirection | Intrinsic::WidenedByName | Intrinsic::WidenedColumn => {
                Operation::Widened
            }
            Intrinsic::Rounded | Intrinsic::RoundedByName | Intrinsic::RoundedEach => Operation::Rounded,
            Intrinsic::Reduced => Operation::Reduced,
            Intrinsic::Reactions => Operation::Reactions,
            Intrinsic::DriveForces => Operation::DriveForces,
            Intrinsic::BearingLoss => Operation::BearingLoss,
            Intrinsic::EquationsAt => Operation::EquationsAt,
            Intrinsic::Equilibrium => Operation::Equilibrium,
            // Numbers of any kind.
            Intrinsic::Pi | Intrinsic::Unknown => return Err(format!("{of:?}")),
        };
        let arguments = self.values(arguments)?;
        Ok(self.add(Expression::Operation(operation, arguments)))
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
