//! The function of a scene whose zeros are the kinks of its laws.

use super::ScenePlan;
use crate::derivation::Kink;
use crate::program::doc::{fenced, lines, without_result};
use crate::program::expression::Expression;
use crate::program::function::{Body, Value, results};
use crate::program::names::Order;
use crate::program::plan::unnamed;

impl ScenePlan<'_, '_, '_> {
    /// `kinks`: the arguments at whose zeros a law has a kink or a jump.
    pub(super) fn kinks(&mut self) {
        let kinks = self.scene.kinks.clone();
        if kinks.is_empty() {
            return;
        }
        let mut doc = lines(["The expressions at whose zeros a law has a kink, at a position and the rates `q'`."]);
        let formulas =
            kinks.iter().map(|Kink { label, argument, .. }| format!("{label}: {}", self.plan.text(*argument)));
        doc.extend(fenced(formulas));
        let nodes: Vec<_> = kinks.iter().map(|kink| kink.argument).collect();
        let sources = vec![self.plan.coordinates(Order::Rate)];
        let body = self.on_coordinates(sources, Vec::new(), unnamed(nodes));
        let body = Body { value: Value::Plain(Expression::List(results(0..kinks.len()))), ..body };
        self.add(self.signatures.kinks(kinks.len()), without_result(doc), body);
    }
}
