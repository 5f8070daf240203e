//! `check`: the ranges of masses, inertias, frictions and stops.

use linkage_ir::Intrinsic;

use super::ScenePlan;
use crate::derivation::ContactFormula;
use crate::graph::NodeId;
use crate::program::doc::lines;
use crate::program::expression::{Expression, Statement};
use crate::program::function::{Body, Value};
use crate::program::plan::unnamed;

impl ScenePlan<'_, '_, '_> {
    pub(super) fn check(&mut self) {
        let doc = match self.signatures.contacts.as_slice() {
            [] => lines([
                "Checks that masses and inertias are finite and not negative.",
                "",
                "# Errors",
                "`InputError::OutOfRange` with the name of a mass or an inertia that is negative, `PositionError::NotFinite` with the name",
                "of one that is not finite.",
            ]),
            _ => lines([
                "Checks the masses, inertias, frictions, and the ranges and restitutions of stops.",
                "",
                "# Errors",
                "With the name of the parameter or stop: `InputError::OutOfRange` if a mass, an inertia or a friction is negative or a",
                "restitution is not between 0 and 1, `InputError::EmptyRange` if the range of a stop is empty, `PositionError::NotFinite` if",
                "a number is not finite.",
            ]),
        };
        let mut nodes: Vec<NodeId> = self.scene.masses.iter().map(|(_, node)| *node).collect();
        let masses = self.labelled(self.scene.masses.iter().map(|(label, _)| label.as_str()), 0, 1);
        let mut stops = Vec::new();
        for contact in &self.scene.contacts {
            if let ContactFormula::Stop { range, restitution } = contact.law {
                stops.push(contact.label.as_str());
                nodes.extend(range);
                nodes.push(restitution);
            }
        }
        let masses = Expression::call(Intrinsic::NotNegative, [Expression::mechanism(), masses]);
        let mut body = Body { kernel: Some(self.on_parameters(unnamed(nodes))), ..Body::default() };
        body.value = if stops.is_empty() {
            Value::Result(masses)
        } else {
            body.after.push(Statement::Do(masses.tried()));
            let stops = self.labelled(stops.into_iter(), self.scene.masses.len(), 3);
            Value::Result(Expression::call(Intrinsic::ValidateStops, [Expression::mechanism(), stops]))
        };
        self.add(self.signatures.check(), doc, body);
    }

    /// `[("label", result, …), …]`, each with the next `each` results, starting at `from`.
    fn labelled<'l>(&self, labels: impl Iterator<Item = &'l str>, from: usize, each: usize) -> Expression {
        let entry = |(at, label): (usize, &str)| {
            let results = (0..each).map(|index| Expression::Result(from + each * at + index));
            Expression::Tuple(std::iter::once(Expression::text(label)).chain(results).collect())
        };
        Expression::List(labels.enumerate().map(entry).collect())
    }
}
