//! The half chords of groups with two solutions, as calls of the runtime.

use std::collections::{BTreeMap, BTreeSet};

use linkage_ir::ValueId;

use super::naming::{Hint, Hinted};
use super::schedule::Line;
use super::value::{Pattern, Statement, Value};
use super::writer::{Absorbed, Writer};
use crate::derivation::ChordGeometry;
use crate::ids::{GroupId, Id};
use crate::program::{Intrinsic, LaneResult, Type};

impl Writer<'_> {
    pub(super) fn chord(&mut self, of: Absorbed<'_>, line: &Line) {
        let Line::Chord { group, symbol, factors, size, of: geometry } = line else { return };
        let factors = self.all_signed(of, factors);
        let factors = self.list(factors);
        let size = self.signed(of, *size);
        let geometry = geometry.map(|value| self.signed(of, value));
        let branch = self.variable(self.context.branch);
        let side = self.field(branch, &self.context.derivation.groups[*group].branch(self.context.derivation));
        let (function, arguments) = self.chord_call(*group, (factors, size, side), geometry);
        if self.is_flagged() {
            let Some(form) = function.row().in_lane.filter(|form| form.result == LaneResult::Flagged) else {
                self.dangle(|| format!("the form of `{}` over lanes", function.row().name));
                return;
            };
            let call = self.call(form.function, form.takes.iter().map(|&index| arguments[index]));
            let name = self.introduce(of, *symbol);
            let flag = self.values.bound();
            self.hint(flag, Hint::Regular(name));
            self.let_value(Pattern::Tuple(vec![Pattern::Bound(name), Pattern::Bound(flag)]), call);
            self.flags.push(flag);
            return;
        }
        let call = self.call(function, arguments);
        let name = Pattern::Bound(self.introduce(of, *symbol));
        // The check of a triangle says how well it is conditioned.
        let pattern = match function {
            Intrinsic::ElbowChord => Pattern::Tuple(vec![name, self.well_conditioned(*group)]),
            _ => name,
        };
        match self.otherwise {
            Some(otherwise) => {
                let found = Pattern::Case(Intrinsic::Some, Box::new(pattern));
                self.statements.push(Statement::LetElse(found, call, otherwise));
            }
            None => {
                let call = self.tried(call);
                self.let_value(pattern, call);
            }
        }
    }

    /// The function of the runtime that computes a chord, and its arguments.
    fn chord_call(
        &mut self,
        group: GroupId,
        (factors, size, side): (ValueId, ValueId, ValueId),
        of: ChordGeometry<ValueId>,
    ) -> (Intrinsic, Vec<ValueId>) {
        // One that returns no error is called where another function finds it.
        let is_regular = self.otherwise.is_some() || self.is_flagged();
        match of {
            ChordGeometry::Triangle { links, line, distance_squared, scale } => {
                let [links, line] = [links, line].map(|pair| self.list(pair));
                let members = [
                    ("links", links),
                    ("line", line),
                    ("scale", scale),
                    ("reach_squared", size),
                    ("distance_squared", distance_squared),
                    ("factors", factors),
                ];
                let members = members.map(|(name, value)| (self.field_name(name), value)).to_vec();
                let triangle = self.add(Value::Struct(Box::new(Type::Runtime("Triangle", Vec::new())), members, None));
                if is_regular {
                    (Intrinsic::RegularElbowChord, vec![triangle, side])
                } else {
                    (Intrinsic::ElbowChord, vec![self.origin(), self.group(group), triangle, side])
                }
            }
            ChordGeometry::Circle { scales, may_cancel } => {
                let chord = if may_cancel { Intrinsic::ReachChord } else { Intrinsic::Chord };
                let scales = self.list(scales);
                // Another function finds the error.
                let origin = if self.otherwise.is_some() { self.error_name() } else { self.origin() };
                (chord, vec![origin, self.group(group), factors, size, scales, side])
            }
            ChordGeometry::RegularCircle { scale: None } => (Intrinsic::RegularChord, vec![factors, size, side]),
            ChordGeometry::RegularCircle { scale: Some(scale) } => {
                (Intrinsic::RegularReachChord, vec![factors, size, scale, side])
            }
        }
    }

    /// The pattern of the flag that is true if the triangle of a dyad is well conditioned.
    fn well_conditioned(&mut self, group: GroupId) -> Pattern {
        let flag = self.bound(format!("is_well_conditioned_{}", group.number()));
        self.well_conditioned.insert(group, flag);
        Pattern::Bound(flag)
    }

    /// Keeps the flags of these dyads: nothing reads the others.
    pub(super) fn keep_conditions(&mut self, of: &BTreeSet<GroupId>) {
        let (kept, unused): (BTreeMap<_, _>, BTreeMap<_, _>) =
            std::mem::take(&mut self.well_conditioned).into_iter().partition(|(group, _)| of.contains(group));
        self.well_conditioned = kept;
        let unused: BTreeSet<ValueId> = unused.into_values().collect();
        for statement in &mut self.statements {
            let Statement::Let(Pattern::Tuple(parts), _) = statement else { continue };
            for part in parts {
                if matches!(part, Pattern::Bound(flag) if unused.contains(flag)) {
                    *part = Pattern::Ignored;
                }
            }
        }
        self.hints.retain(|hinted| !matches!(hinted, Hinted::Value(id, _) if unused.contains(id)));
    }
}
