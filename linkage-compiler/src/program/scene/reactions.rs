//! `reactions`: the Lagrange multipliers of the loop equations and constraints.

use super::{ERRORS, ScenePlan};
use crate::derivation::needed;
use crate::graph::SymbolId;
use crate::program::doc::lines;
use crate::program::expression::{Expression, Pattern, Statement};
use crate::program::function::{Body, Source, Value, results};
use crate::program::names::{Arguments, Order};
use crate::program::plan::unnamed;

impl ScenePlan<'_, '_, '_> {
    pub(super) fn reactions(&mut self) {
        let Some(reactions) = self.scene.reactions.clone() else { return };
        let mut doc = lines([
            "The Lagrange multipliers lambda of `M q'' + Psi_q' lambda = F` in the motion of the scene, two for each `loop` and",
            "one for each `equation`. For a `loop`, lambda is the force of its left side on its right side where they meet.",
        ]);
        if !reactions.eliminations.is_empty() {
            doc.extend(lines(["", "Psi are here the loops and equations as written, before unknowns are eliminated."]));
        }
        doc.extend(lines(ERRORS));
        let Arguments { time, q, rates, accelerations, input_rates, input_accelerations, pose, .. } =
            self.signatures.arguments.clone();
        let steps = self.plan.derivation.transposed_solution(&reactions);
        let nodes = self.plan.variables(&reactions.names);
        let steps = needed(&self.plan.derivation.graph, steps, &nodes);
        let used = |of: fn(&crate::derivation::Coordinate) -> SymbolId| {
            let derivation = &self.plan.derivation;
            let nodes: Vec<_> = steps.iter().flat_map(|step| step.nodes()).collect();
            let used = derivation.graph.symbols_of(&nodes);
            derivation.coordinates.iter().any(|coordinate| used.contains(&of(coordinate)))
        };
        let (takes_rate, takes_acceleration) = (used(|c| c.rate), used(|c| c.acceleration));
        let count = nodes.len();
        let by_name = |name: &str, order| Source { from: Expression::name(name), ..self.plan.coordinates(order) };
        let sources = vec![by_name(&rates, Order::Rate), by_name(&accelerations, Order::Acceleration)];
        let mut body = self.on_pose(sources, steps, unnamed(nodes)).checked("the reactions", results(0..count));
        let at = |name: &str| Expression::name(name);
        let on = at(&pose).borrowed();
        if takes_acceleration {
            let both = Pattern::Tuple(vec![Pattern::Name(rates.clone()), Pattern::Name(input_accelerations.clone())]);
            let moving = Expression::call("rates", [at(&time), at(&q), at(&input_rates)]).tried();
            body.before.push(Statement::Let(both, moving));
            let all = [on, at(&rates).borrowed(), at(&input_accelerations)];
            let all = self.mechanism().method("acceleration", all).tried();
            body.before.push(Statement::Let(Pattern::Name(accelerations), all));
        } else if takes_rate {
            let all = self.mechanism().method("velocity", [on, at(&input_rates)]).tried();
            body.before.push(Statement::Let(Pattern::Name(rates), all));
        }
        let body = Body { value: Value::Plain(Expression::vector(results(0..count))), ..body };
        self.add(self.signatures.reactions(), doc, body);
    }
}
