//! `energy` and `power`.

use linkage_ir::Intrinsic;

use super::{ERRORS, ScenePlan};
use crate::program::doc::lines;
use crate::program::expression::{Expression, Type};
use crate::program::function::{Body, Output, Value, results};

impl ScenePlan<'_, '_, '_> {
    pub(super) fn energy(&mut self) {
        let mut doc = lines(["The kinetic energy, and the potential energy of gravity, springs and potentials."]);
        doc.extend(lines([
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if an energy is not finite.",
        ]));
        let members = ["kinetic", "potential"];
        let nodes = [self.scene.kinetic, self.scene.potential];
        let outputs = nodes.into_iter().zip(members).map(|(node, name)| Output::named(node, name)).collect();
        let body = self.on_motion(outputs, None).checked("the energy", results(0..2));
        let body = self.with_rates(body);
        let members = members.map(str::to_owned).into_iter().zip(results(0..2));
        let energy = Expression::structure(Type::Runtime("Energy", Vec::new()), members);
        self.add(self.signatures.energy(), doc, Body { value: Value::Plain(energy), ..body });
    }

    pub(super) fn power(&mut self) {
        let has_contacts = !self.signatures.contacts.is_empty();
        let driven = self.signatures.driven.clone();
        let mut doc = match (has_contacts, driven.is_empty()) {
            (false, _) => lines([
                "The applied power of forces, torques and drives, and the power that dampers dissipate: dE/dt is their difference.",
            ]),
            (true, true) => lines([
                "The applied power of forces and torques, and the power that dampers and frictions, limit `|s'|` each, dissipate:",
                "between impacts dE/dt is their difference.",
            ]),
            (true, false) => lines([
                "The applied power of forces and torques, and the power that dampers and frictions, limit `|s'|` each, dissipate.",
                "The power of the drives, which depends on the modes of the contacts, is not included.",
            ]),
        };
        doc.extend(lines(ERRORS));
        let are_drives_known = !has_contacts && !driven.is_empty();
        let mut outputs = vec![
            Output { node: self.scene.applied, name: (!are_drives_known).then(|| "applied".to_owned()) },
            Output::named(self.scene.dissipated, "dissipated"),
        ];
        let (mut body, applied) = if are_drives_known {
            let speeds = self.plan.rates(&self.plan.derivation.inputs).at(&driven);
            let speeds = self.plan.variables(&speeds);
            outputs.extend(speeds.into_iter().map(Output::from));
            let has_forces = !self.plan.derivation.graph.is_zero(self.scene.applied);
            let (mut body, forces) = self.driving(outputs);
            let speeds = results(2..2 + driven.len());
            let terms = forces.into_iter().zip(speeds).map(|(force, speed)| Expression::Product(vec![force, speed]));
            let all: Vec<Expression> = has_forces.then_some(Expression::Result(0)).into_iter().chain(terms).collect();
            let sum = match all.as_slice() {
                [only] => only.clone(),
                _ => Expression::Sum(all),
            };
            let applied = body.bound("applied".to_owned(), sum);
            (body, applied)
        } else {
            (self.on_motion(outputs, None), Expression::Result(0))
        };
        let mut dissipated = Expression::Result(1);
        if self.signatures.count_bearings() > 0 {
            let arguments = &self.signatures.arguments;
            let state = [&arguments.time, &arguments.q, &arguments.input_rates].map(Expression::name);
            let call =
                Expression::call(Intrinsic::BearingLoss, std::iter::once(Expression::own()).chain(state)).tried();
            let sum = Expression::Sum(vec![dissipated, call]);
            dissipated = body.bound("all_dissipated".to_owned(), sum);
        }
        let values = [applied, dissipated];
        let body = self.checked_with_effects(body, "the power", values.to_vec());
        let body = self.with_rates(body);
        let members = ["applied", "dissipated"].map(str::to_owned).into_iter().zip(values);
        let power = Expression::structure(Type::Runtime("Power", Vec::new()), members);
        self.add(self.signatures.power(), doc, Body { value: Value::Plain(power), ..body });
    }
}
