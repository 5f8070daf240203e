//! The statements that take the arguments of a kernel apart.

use std::collections::BTreeSet;

use linkage_ir::{Name, ValueId};

use super::checks::Checked;
use super::naming::Hint;
use super::value::{Leaf, Pattern, Statement, Value};
use super::writer::{Absorbed, Writer};
use crate::graph::{Function, NodeId, SymbolId};
use crate::program::{Expression, Shape, Source};

impl Writer<'_> {
    /// Binds the symbols of the user that lines use: `let Type { field, other: name, .. } = *value;`. They are named first,
    /// so that they keep their names.
    pub(super) fn sources(&mut self, of: Absorbed<'_>) {
        let own: BTreeSet<SymbolId> = self.kernel.steps.iter().flat_map(|step| step.introduced()).collect();
        let symbols: BTreeSet<SymbolId> = of.schedule.symbols().filter(|symbol| !own.contains(symbol)).collect();
        for &symbol in &symbols {
            self.introduce(of, symbol);
        }
        let mut unbound = symbols;
        for source in &self.kernel.sources {
            self.source(source, &mut unbound);
        }
        for symbol in unbound {
            // An argument that is a number, such as time.
            let argument = self.variable(self.context.derivation.graph.symbol_name(symbol));
            if let Some(own) = self.symbols.insert(symbol, argument) {
                self.values.alias(own, argument);
            }
        }
        if self.kernel.is_on_pose {
            self.directions(of);
        }
    }

    fn source(&mut self, source: &Source, unbound: &mut BTreeSet<SymbolId>) {
        let pattern = match self.shape(&source.shape, unbound) {
            Some(pattern) => pattern,
            // A call that may fail is kept.
            None if may_fail(&source.from) => Pattern::Ignored,
            None => return,
        };
        let from = self.expression(&source.from, &Checked::default());
        self.let_value(pattern, from);
    }

    /// The pattern of a shape with the symbols that are used; `None` if no symbol is used.
    fn shape(&self, shape: &Shape, unbound: &mut BTreeSet<SymbolId>) -> Option<Pattern> {
        let mut all = |shapes: &[Shape]| {
            let patterns: Vec<_> = shapes.iter().map(|shape| self.shape(shape, unbound)).collect();
            let is_used = patterns.iter().any(Option::is_some);
            is_used.then(|| patterns.into_iter().map(|pattern| pattern.unwrap_or(Pattern::Ignored)).collect())
        };
        match shape {
            Shape::Symbol(symbol) => {
                let known = self.symbols.get(symbol).copied();
                unbound.remove(symbol);
                known.map(Pattern::Bound)
            }
            Shape::Ignored => None,
            Shape::List(shapes) => all(shapes).map(Pattern::List),
            Shape::Tuple(shapes) => all(shapes).map(Pattern::Tuple),
            Shape::Fields { of, fields, is_whole } => {
                let named =
                    fields.iter().map(|(field, shape)| Some((self.field_name(field), self.shape(shape, unbound)?)));
                let named: Vec<(Name, Pattern)> = named.flatten().collect();
                let is_whole = *is_whole && named.len() == fields.len();
                (!named.is_empty()).then(|| Pattern::Struct { of: of.clone(), fields: named, is_whole })
            }
        }
    }

    /// Adds `let (sin_theta, cos_theta) = (pose.theta.im, pose.theta.re);` for the directions that are used.
    fn directions(&mut self, of: Absorbed<'_>) {
        let mut used: Vec<(NodeId, Function, ValueId)> = Vec::new();
        for &id in of.schedule.used() {
            if let Value::Given(Leaf::Direction(function, angle)) = of.schedule.value(id) {
                used.push((*angle, *function, of.id(id)));
            }
        }
        used.sort_unstable();
        for parts in used.chunk_by(|one, other| one.0 == other.0) {
            let field = self.context.pose.direction(parts[0].0);
            let mut values = Vec::new();
            for &(_, function, id) in parts {
                self.values.bind(id, false);
                self.hint(id, Hint::Direction(function, field.to_owned()));
                let pose = self.variable(self.context.pose_argument);
                let direction = self.field(pose, field);
                values.push(self.field(direction, if function == Function::Sin { "im" } else { "re" }));
            }
            let mut patterns: Vec<Pattern> = parts.iter().map(|&(.., id)| Pattern::Bound(id)).collect();
            let (pattern, value) = match (patterns.pop(), values.as_slice()) {
                (Some(pattern), &[value]) => (pattern, value),
                (last, _) => {
                    (Pattern::Tuple(patterns.into_iter().chain(last).collect()), self.add(Value::Tuple(values)))
                }
            };
            self.statements.push(Statement::Let(pattern, value));
        }
    }
}

fn may_fail(value: &Expression) -> bool {
    match value {
        Expression::Try(_) => true,
        Expression::Field(of, _) => may_fail(of),
        _ => false,
    }
}
