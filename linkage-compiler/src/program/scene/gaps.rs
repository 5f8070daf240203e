//! The function of a scene that bounds the changes of the gaps of its stops.

use super::ScenePlan;
use crate::graph::NodeId;
use crate::program::doc::{fenced, lines, without_result};
use crate::program::expression::Expression;
use crate::program::function::{Body, Source, Value, results};
use crate::program::names::Order;
use crate::program::plan::unnamed;

impl ScenePlan<'_, '_, '_> {
    /// `gap_changes`: a bound for each stop whose gap is no polynomial in the coordinates.
    pub(super) fn gap_changes(&mut self) {
        let known = self.scene.contacts.iter().zip(&self.scene.gap_changes);
        let known = known.filter_map(|(contact, change)| Some((contact.label.clone(), (*change)?)));
        let known: Vec<(String, NodeId)> = known.collect();
        if known.is_empty() {
            return;
        }
        let mut doc = lines([
            "Bounds of the changes of the gaps of stops while each coordinate moves from its value by so much, or by less, in any complex",
            "direction, where the rates are the moves: no number where no bound is known.",
        ]);
        doc.extend(fenced(known.iter().map(|(label, change)| format!("{label}: {}", self.plan.text(*change)))));
        let moves = Source {
            from: Expression::name(self.signatures.moves.clone()).dereferenced(),
            ..self.plan.coordinates(Order::Rate)
        };
        let body = self.on_coordinates(vec![moves], Vec::new(), unnamed(known.iter().map(|of| of.1)));
        let body = Body { value: Value::Plain(Expression::List(results(0..known.len()))), ..body };
        self.add(self.signatures.gap_changes(known.len()), without_result(doc), body);
    }
}
