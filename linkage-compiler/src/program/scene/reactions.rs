//! `reactions`: the forces in joints, and the Lagrange multipliers of the loop equations and constraints.

use linkage_ir::Intrinsic;

use super::{ERRORS, Joint, ScenePlan};
use crate::derivation::{Reactions, Step, needed};
use crate::graph::SymbolId;
use crate::model::LoadKind;
use crate::program::doc::lines;
use crate::program::expression::{Expression, Pattern, Statement, Type};
use crate::program::function::{Body, Output, Shape, Source, Value, results};
use crate::program::names::{Arguments, Order};
use crate::program::plan::unnamed;

/// The field of the multipliers.
pub const MULTIPLIERS: &str = "multipliers";

impl ScenePlan<'_, '_, '_> {
    pub(super) fn reactions(&mut self) {
        let Some(derived) = self.scene.reactions.clone().filter(|_| self.signatures.has_reactions()) else { return };
        let (outputs, value) = self.shown(&derived);
        let nodes: Vec<_> = outputs.iter().map(|output| output.node).collect();
        let steps = self.plan.derivation.transposed_solution(&derived.multipliers);
        let steps = needed(&self.plan.derivation.graph, steps, &nodes);
        let doc = self.doc_of_reactions(&derived);
        let has_inertia = self.signatures.has_inertia;
        if !has_inertia {
            let body = self.reactions_at_rest(&derived, steps, outputs, value);
            self.add(self.signatures.reactions(), doc, body);
            return;
        }
        let count = outputs.len();
        let Arguments { rates, accelerations, contact_forces, .. } = self.signatures.arguments.clone();
        let mut sources: Vec<Source> = [(&rates, Order::Rate), (&accelerations, Order::Acceleration)]
            .map(|(name, order)| Source { from: Expression::name(name).dereferenced(), ..self.plan.coordinates(order) })
            .into();
        if !derived.contact_forces.is_empty() {
            let from = Expression::name(&contact_forces).dereferenced();
            sources.push(Source { from, shape: Shape::list(&derived.contact_forces) });
        }
        let body = self.on_pose(sources, steps, outputs).checked("the reactions", results(0..count));
        let mut of_motion =
            lines(["The reactions of [`Self::reactions`] with these rates, accelerations and forces of contacts."]);
        of_motion.extend(lines(ERRORS));
        self.add(self.signatures.reactions_of(), of_motion, Body { value: Value::Plain(value), ..body });
        let body = self.reactions_in_motion();
        self.add(self.signatures.reactions(), doc, body);
    }

    /// The results, and the struct that holds them.
    fn shown(&mut self, derived: &Reactions) -> (Vec<Output>, Expression) {
        let (mut outputs, mut members) = (Vec::new(), Vec::new());
        let loads = &self.plan.mechanism.opened.loads;
        for &Joint { place, .. } in &self.signatures.joints {
            let Some(index) = derived.opened.iter().position(|&other| other == place) else { continue };
            let (load, first) = (&loads[place], outputs.len());
            let parts = match load.kind {
                LoadKind::Pin { .. } => ["x", "y"].map(|axis| format!("{}_{axis}", load.field)).into(),
                LoadKind::Guide { .. } => load.fields(),
            };
            for (&node, name) in derived.forces[index].iter().zip(&parts) {
                outputs.push(Output::named(node, name.clone()));
            }
            let parts = results(first..first + 2);
            match load.kind {
                LoadKind::Pin { .. } => members.push((load.field.clone(), Expression::vector(parts))),
                LoadKind::Guide { .. } => members.extend(load.fields().into_iter().zip(parts)),
            }
        }
        if self.signatures.has_multipliers() {
            let first = outputs.len();
            outputs.extend(unnamed(self.plan.variables(&derived.multipliers.names)));
            members.push((MULTIPLIERS.to_owned(), Expression::vector(results(first..outputs.len()))));
        }
        (outputs, Expression::structure(Type::Bare(self.signatures.reactions_type.clone()), members))
    }

    fn doc_of_reactions(&self, derived: &Reactions) -> Vec<String> {
        let mut doc = lines(["The forces in the joints in the motion of the scene."]);
        if !self.signatures.contacts.is_empty() {
            doc.extend(lines([
                "",
                "Frictions and stops are those of a motion that starts here: what is at rest sticks if it can.",
            ]));
        }
        if self.signatures.has_multipliers() && !derived.multipliers.eliminations.is_empty() {
            doc.extend(lines(["", "Psi are here the loops and equations as written, before unknowns are eliminated."]));
        }
        doc.extend(lines(ERRORS));
        doc
    }

    /// The reactions of a scene without inertia.
    fn reactions_at_rest(
        &self,
        derived: &Reactions,
        steps: Vec<Step>,
        outputs: Vec<Output>,
        value: Expression,
    ) -> Body {
        let Arguments { rates, input_rates, pose, .. } = self.signatures.arguments.clone();
        let derivation = &self.plan.derivation;
        let nodes = steps.iter().flat_map(Step::nodes).chain(outputs.iter().map(|output| output.node));
        let used: Vec<SymbolId> = derivation.graph.symbols_of(&nodes.collect::<Vec<_>>());
        let takes_rates = derivation.coordinates.iter().any(|coordinate| used.contains(&coordinate.rate));
        debug_assert!(derived.contact_forces.is_empty(), "contacts need inertia");
        let count = outputs.len();
        let source = Source { from: Expression::name(&rates), ..self.plan.coordinates(Order::Rate) };
        let sources = takes_rates.then_some(source).into_iter().collect();
        let mut body = self.on_pose(sources, steps, outputs).checked("the reactions", results(0..count));
        if takes_rates {
            let on = [Expression::name(&pose).borrowed(), Expression::name(&input_rates)];
            let all = self.mechanism().driver_call("velocity", on).tried();
            body.before.push(Statement::Let(Pattern::bound(rates), all));
        }
        Body { value: Value::Plain(value), ..body }
    }

    /// The reactions in the motion that follows from a state.
    fn reactions_in_motion(&self) -> Body {
        let at = |name: &String| Expression::name(name);
        let Arguments { time, q, rates, accelerations, input_rates, input_accelerations, pose, .. } =
            &self.signatures.arguments;
        let mut body = Body::default();
        if !self.signatures.contacts.is_empty() {
            let state = [Expression::own(), at(time), at(q), at(input_rates).converted()];
            return Body { value: Value::Result(Expression::call(Intrinsic::Reactions, state)), ..body };
        }
        let fields = [("rates", rates), ("input_accelerations", input_accelerations)];
        let fields = fields.map(|(field, name)| (field.to_owned(), Pattern::bound(name.clone()))).to_vec();
        let both = Pattern::Struct { of: Type::Runtime("StateRates", Vec::new()), fields, is_whole: true };
        let moving = Expression::own_call("rates", [at(time), at(q), at(input_rates)]).tried();
        body.before.push(Statement::Let(both, moving));
        self.pose_at(&mut body);
        let on = [at(pose).borrowed(), at(rates).borrowed(), at(input_accelerations)];
        let all = self.mechanism().driver_call("acceleration", on).tried();
        body.before.push(Statement::Let(Pattern::bound(accelerations.clone()), all));
        let motion = [at(time), at(q), at(rates).borrowed(), at(accelerations).borrowed()];
        Body { value: Value::Result(Expression::own_call("reactions_of", motion)), ..body }
    }
}
