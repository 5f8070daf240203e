//! Checks of the results of a kernel: that they are finite, unless that is proven.

use linkage_ir::ValueId;
use rustc_hash::FxHashSet;

use super::naming::Hint;
use super::value::{Signed, Statement, Value};
use super::writer::Writer;
use crate::ids::GroupId;
use crate::program::{self, Expression, Intrinsic, Variable};

/// The results of a kernel, and what is known of them.
#[derive(Debug, Default)]
pub(super) struct Checked {
    pub(super) results: Vec<ValueId>,
    /// For each result, true if it needs no check: it is finite if the checks before it pass, or need not be finite.
    pub(super) is_proven: Vec<bool>,
    /// For each result the dyad, if any, whose well-conditioned triangle guarantees that it is finite.
    pub(super) dyads: Vec<Option<GroupId>>,
}

impl Checked {
    pub(super) fn is_proven(&self, value: &Expression) -> bool {
        match value {
            Expression::Result(index) => self.is_proven.get(*index).copied().unwrap_or_default(),
            _ => false,
        }
    }

    /// The results that need a check, each with its dyad.
    fn unproven(&self) -> impl Iterator<Item = (ValueId, Option<GroupId>)> {
        let all = self.results.iter().zip(&self.dyads).zip(&self.is_proven);
        all.filter(|(_, is_proven)| !**is_proven).map(|((value, dyad), _)| (*value, *dyad))
    }
}

impl Writer<'_> {
    /// Adds the checks of a position; numbers of dyads are checked only if a triangle is not well conditioned.
    pub(super) fn check_position(&mut self, checked: &Checked) {
        let (of_dyads, others): (Vec<_>, Vec<_>) = checked.unproven().partition(|(_, dyad)| dyad.is_some());
        let [of_dyads, others] = [of_dyads, others].map(|values| values.into_iter().map(|(value, _)| value).collect());
        self.check_finite("the position", others, None);
        let well_conditioned: Vec<ValueId> = self.well_conditioned.values().copied().collect();
        let before = std::mem::take(&mut self.statements);
        self.check_finite("the position", of_dyads, None);
        let of_dyads = std::mem::replace(&mut self.statements, before);
        if well_conditioned.is_empty() {
            self.statements.extend(of_dyads);
        } else if !of_dyads.is_empty() {
            self.statements.push(Statement::Unless(well_conditioned, of_dyads));
        }
    }

    /// These conditions, and that results are finite. The directions of dyads are finite: their chords are regular.
    pub(super) fn conditions(&mut self, mut conditions: Vec<ValueId>, checked: &Checked) -> Vec<ValueId> {
        let numbers = checked.unproven().filter(|(_, dyad)| dyad.is_none()).map(|(value, _)| value).collect();
        let numbers = self.to_check(numbers);
        if !numbers.is_empty() {
            // A sum is finite only if all its terms are. Where finite terms overflow, it is not.
            let sum = self.add(Value::Sum(numbers.into_iter().map(Signed::positive).collect()));
            conditions.push(self.call(Intrinsic::IsFinite, [sum]));
        }
        conditions
    }

    /// Binds true if all conditions are true. Each has a name, so that none of them is skipped by a branch.
    pub(super) fn let_all(&mut self, to: &program::Pattern<Variable>, conditions: Vec<ValueId>) {
        if let [only] = conditions.as_slice() {
            let to = self.planned_pattern(to);
            self.let_value(to, *only);
            return;
        }
        let mut all = Vec::new();
        for condition in conditions {
            if !self.values.is_bound[condition.index()] {
                let name = match self.values.get(condition) {
                    Value::Intrinsic(Intrinsic::IsFinite, ..) => "are_finite",
                    Value::Intrinsic(of, ..) => of.row().name.trim_start_matches("lane::"),
                    _ => "is_right",
                };
                self.values.bind(condition, false);
                self.hint(condition, Hint::Preferred(name.to_owned()));
                self.let_itself(condition);
            }
            all.push(condition);
        }
        let all = self.add(Value::All(all));
        let to = self.planned_pattern(to);
        self.let_value(to, all);
    }

    /// Each value once, without zero and one.
    fn to_check(&self, values: Vec<ValueId>) -> Vec<ValueId> {
        let mut seen = FxHashSet::default();
        let mut is_kept = |value: &ValueId| match self.values.is_bound[value.index()] {
            true => seen.insert(*value),
            false => self.values.is_formula(*value),
        };
        values.into_iter().filter(&mut is_kept).collect()
    }

    /// `finite(NAME, what, [values])?;`, unless all values are zero or one; `detail` finds a more precise error.
    pub(super) fn check_finite(&mut self, what: &str, values: Vec<ValueId>, detail: Option<ValueId>) {
        let values = self.to_check(values);
        if values.is_empty() {
            return;
        }
        let arguments = [self.mechanism(), self.text(what), self.list(values)];
        let mut check = self.call(Intrinsic::Finite, arguments);
        if let Some(detail) = detail {
            check = self.call(Intrinsic::OrElse, [check, detail]);
        }
        let check = self.tried(check);
        self.statements.push(Statement::Do(check));
    }
}
