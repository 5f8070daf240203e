//! `drives` and `drive_forces`: the laws of driven inputs, and inverse dynamics.

use linkage_ir::Intrinsic;
use linkage_ir::Operations;

use super::{ERRORS, ScenePlan};
use crate::derivation::Prescribed;
use crate::graph::NodeId;
use crate::ids::InputId;
use crate::program::doc::{lines, without_result};
use crate::program::expression::{Expression, Type};
use crate::program::function::{Body, Output, Value, results};
use crate::program::names::Arguments;
use crate::program::plan::unnamed;

impl ScenePlan<'_, '_, '_> {
    /// The names of the driven inputs, for doc comments.
    fn driven(&self) -> String {
        let names = self.signatures.driven.iter().map(|&at| format!("`{}`", self.signatures.inputs[at]));
        names.collect::<Vec<_>>().join(", ")
    }

    /// One value for each driven input, by name.
    fn each_drive(&self, values: impl IntoIterator<Item = Expression>) -> Expression {
        let names = self.signatures.driven.iter().map(|&at| self.signatures.inputs[at].clone());
        Expression::structure(Type::Bare(self.signatures.drives_type.clone()), names.zip(values))
    }

    /// The laws of the driven inputs with their derivatives.
    pub(super) fn drives(&mut self) {
        let doc = vec![format!("The prescribed value, rate and acceleration of {}.", self.driven())];
        let laws = self.scene.drives.values();
        let many = laws.len();
        let nodes = laws.flat_map(|Prescribed { value, rate, acceleration }| [*value, *rate, *acceleration]);
        let nodes: Vec<NodeId> = nodes.collect();
        let kernel = self.on_parameters(unnamed(nodes));
        let law = |at: usize| {
            let members = ["value", "rate", "acceleration"].map(str::to_owned).into_iter();
            let members = members.zip(results(3 * at..3 * at + 3));
            Expression::structure(Type::Runtime("Prescribed", Vec::new()), members)
        };
        let body = Body::of(kernel, self.each_drive((0..many).map(law)));
        self.add(self.signatures.drives(), without_result(doc), body);
    }

    /// Inverse dynamics: `M_d v'' - Q_d`.
    pub(super) fn drive_forces(&mut self) {
        let mut doc = vec![
            format!("The forces (for angles, torques) that drive {}, by inverse dynamics: `M v'' - Q`,", self.driven()),
            "at this position and these rates of the inputs.".to_owned(),
        ];
        if !self.signatures.contacts.is_empty() {
            doc.extend(lines([
                "",
                "Frictions and stops are those of a motion that starts here: what is at rest sticks if it can.",
            ]));
            doc.extend(lines(ERRORS));
            let Arguments { time, q, input_rates, .. } = &self.signatures.arguments;
            let at = |name: &String| Expression::name(name);
            let state = [Expression::own(), at(time), at(q), at(input_rates).converted()];
            let mut body = Body::default();
            let forces = body.bound("forces", Expression::call(Intrinsic::DriveForces, state).tried());
            let forces = self.signatures.driven.iter().map(|&at| forces.clone().field(&self.signatures.inputs[at]));
            let value = self.each_drive(forces.collect::<Vec<_>>());
            self.add(self.signatures.drive_forces(), doc, Body { value: Value::Plain(value), ..body });
            return;
        }
        doc.extend(lines(ERRORS));
        let (mut body, forces) = self.driving(Vec::new());
        body = self.checked_with_effects(body, "the driving force", forces.clone());
        let body = Body { value: Value::Plain(self.each_drive(forces)), ..self.with_rates(body) };
        self.add(self.signatures.drive_forces(), doc, body);
    }

    /// A body that computes other results and then the forces of the drives; returns these as well.
    pub(super) fn driving(&mut self, others: Vec<Output>) -> (Body, Vec<Expression>) {
        let driven = self.signatures.driven.clone();
        let free = match self.scene.mass_matrix {
            Some(_) => self.signatures.free.clone(),
            None => Vec::new(),
        };
        let first = others.len();
        let mut outputs = others;
        outputs.extend(self.minor(&free, &free).into_iter().map(Output::from));
        outputs.extend(self.right_sides(&free).into_iter().map(Output::from));
        outputs.extend(self.minor(&driven, &free).into_iter().map(Output::from));
        let sides = self.right_sides(&driven);
        let inputs = self.signatures.inputs.clone();
        let name = |at: &InputId| format!("{}_drive", inputs[*at]);
        for (side, at) in sides.into_iter().zip(&driven) {
            let force = self.plan.derivation.graph.negate(side);
            // With free inputs, the name belongs to the sum that includes the coupling terms.
            outputs.push(Output { node: force, name: free.is_empty().then(|| name(at)) });
        }
        let entries = first..first + free.len().pow(2);
        let right = entries.end..entries.end + free.len();
        let coupling = right.end..right.end + free.len() * driven.len();
        let forces = results(coupling.end..outputs.len());
        let mut body = self.on_motion(outputs, None);
        if free.is_empty() {
            return (body, forces);
        }
        let accelerations = self.solve_free(&mut body, results(entries), results(right));
        body.operations +=
            Operations { multiplications: coupling.len(), additions: coupling.len(), ..Operations::default() };
        let coupling = results(coupling);
        let rows = coupling.chunks(free.len()).zip(forces).zip(&driven);
        let forces = rows.map(|((row, force), at)| {
            let terms = row.iter().zip(&accelerations);
            let terms = terms.map(|(entry, a)| Expression::Product(vec![entry.clone(), a.clone()]));
            let sum = std::iter::once(force).chain(terms).collect();
            (name(at), Expression::Sum(sum))
        });
        let forces: Vec<(String, Expression)> = forces.collect();
        let forces = forces.into_iter().map(|(name, sum)| body.bound(name, sum)).collect();
        (body, forces)
    }
}
