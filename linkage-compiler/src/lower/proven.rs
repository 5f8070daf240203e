//! Finiteness analysis: results that need no `is_finite` check, since the checks of half chords imply that they are
//! finite.

use std::ops::Range;

use linkage_ir::{Name, ValueId};
use rustc_hash::FxHashMap;

use super::value::{Pattern, Statement, Value};
use super::values::Values;
use crate::graph::Function;
use crate::program::{Finite, Intrinsic};

/// For each result, true if it is finite whenever all half chords pass their checks and the other results are finite.
///
/// The check of a half chord requires that both factors are finite. In IEEE 754 a sum, product, square, square root,
/// absolute value, sine or cosine is finite only if its operands are, so that these are finite, too.
///
/// The `conclusive` results are checked, and whatever they are computed from is finite then. That proves no other result by a product
/// with a small number: a half of x would be finite since x is, and x since its half is checked.
pub(super) fn proven(
    values: &Values,
    statements: &[Statement],
    results: &[ValueId],
    conclusive: Range<usize>,
) -> Vec<bool> {
    let mut proven = Proven {
        values,
        named: FxHashMap::default(),
        finite: vec![false; values.all.len()],
        implied: vec![false; values.all.len()],
        checked: vec![false; values.all.len()],
    };
    let (mut chords, mut checked) = (Vec::new(), Vec::new());
    for statement in statements {
        proven.statement(statement, &mut chords, &mut checked);
    }
    if conclusive.is_empty() && chords.is_empty() {
        return vec![false; results.len()];
    }
    let mut finite = std::mem::take(&mut proven.finite);
    proven.follow(checked, &mut finite);
    let mut implied = finite.clone();
    for result in &results[conclusive] {
        let operands = proven.operands(proven.itself(*result));
        proven.follow(operands, &mut implied);
    }
    for chord in chords {
        finite[chord.index()] = true;
    }
    (proven.finite, proven.implied) = (finite, implied);
    for result in results {
        let id = proven.itself(*result);
        proven.checked[id.index()] = true;
    }
    results.iter().map(|result| proven.is_finite(proven.itself(*result))).collect()
}

struct Proven<'a> {
    values: &'a Values,
    /// The value that each variable is finite with.
    named: FxHashMap<ValueId, ValueId>,
    /// True for values that are finite if the checks of half chords pass.
    finite: Vec<bool>,
    /// True for these, and for those from which the conclusive results are computed.
    implied: Vec<bool>,
    /// True for results, which are checked.
    checked: Vec<bool>,
}

impl Proven<'_> {
    /// Takes note of a value that is finite if the statement passes, and of factors that it checks.
    fn statement(&mut self, statement: &Statement, chords: &mut Vec<ValueId>, checked: &mut Vec<ValueId>) {
        let (Statement::Let(pattern, value) | Statement::LetElse(pattern, value, _)) = statement else { return };
        let Some(bound) = first(pattern) else { return };
        if bound != *value && matches!(pattern, Pattern::Bound(_)) {
            self.named.insert(bound, *value);
        }
        let call = match self.values.get(*value) {
            Value::Try(inside) => *inside,
            _ => *value,
        };
        let Value::Intrinsic(of, _, arguments) = self.values.get(call) else { return };
        match of.row().finite {
            Finite::Unknown => {}
            Finite::With(index) => {
                self.named.insert(bound, arguments[index]);
            }
            Finite::Checks(index) => {
                self.named.remove(&bound);
                chords.push(bound);
                checked.extend(self.factors(arguments[index]));
            }
        }
    }

    /// The factors in a list or a triangle.
    fn factors(&self, id: ValueId) -> Vec<ValueId> {
        match self.values.get(id) {
            Value::List(all) => all.clone(),
            Value::Struct(_, members, _) => {
                let factors = members.iter().filter(|(field, _)| *field == Name::FACTORS);
                factors.flat_map(|(_, value)| self.factors(*value)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Marks these values and their operands.
    fn follow(&self, mut stack: Vec<ValueId>, finite: &mut [bool]) {
        while let Some(id) = stack.pop() {
            let id = self.itself(id);
            if std::mem::replace(&mut finite[id.index()], true) {
                continue;
            }
            stack.extend(self.operands(id));
        }
    }

    /// The operands that are finite if a value is.
    fn operands(&self, id: ValueId) -> Vec<ValueId> {
        let mut operands = Vec::new();
        match self.values.get(id) {
            Value::Quotient(above, _) => operands.push(*above),
            value @ (Value::Call(Function::Abs | Function::Sqrt | Function::Sin | Function::Cos, _)
            | Value::Intrinsic(Intrinsic::Square | Intrinsic::SineInLane | Intrinsic::CosineInLane, ..)
            | Value::Sum(_)
            | Value::Product(_)
            | Value::Square(_)) => value.each_part(|part| operands.push(part)),
            _ => {}
        }
        operands
    }

    fn is_finite(&self, id: ValueId) -> bool {
        let value = |id: ValueId| self.values.get(id);
        let is_small =
            |id: ValueId| matches!(value(id), Value::Constant(number) | Value::Exact(number) if number.to_f64() <= 1.0);
        let is_finite = |id: ValueId| self.finite[self.itself(id).index()];
        let is_checked = |id: ValueId| self.checked[self.itself(id).index()];
        self.finite[id.index()]
            || self.implied[id.index()]
            || match value(id) {
                Value::Call(Function::Sin | Function::Cos, angle) => is_finite(angle[0].value),
                Value::Intrinsic(Intrinsic::SineInLane | Intrinsic::CosineInLane, _, angle) => is_finite(angle[0]),
                // `atan2` of NaN is NaN, but of infinities finite: its arguments must be checked results.
                Value::Call(Function::Atan2, parts) => parts.iter().all(|part| is_checked(part.value)),
                Value::Intrinsic(Intrinsic::Arctangent2InLane, _, parts) => parts.iter().all(|part| is_checked(*part)),
                // Half a chord, for instance.
                Value::Product(factors) => {
                    matches!(*factors.as_slice(), [number, other] if is_small(number) && is_finite(other))
                }
                _ => false,
            }
    }

    /// The value that a variable, or the negative of one, is finite with.
    fn itself(&self, id: ValueId) -> ValueId {
        let mut id = self.values.itself(id);
        loop {
            id = match (self.values.get(id), self.named.get(&id)) {
                (Value::Negative(inside), _) => self.values.itself(*inside),
                (_, Some(value)) => self.values.itself(*value),
                _ => return id,
            }
        }
    }
}

/// The first value that a pattern binds: the number among what it takes apart.
fn first(pattern: &Pattern) -> Option<ValueId> {
    match pattern {
        Pattern::Bound(bound) => Some(*bound),
        Pattern::Tuple(all) => first(all.first()?),
        Pattern::Case(_, inside) => first(inside),
        _ => None,
    }
}
