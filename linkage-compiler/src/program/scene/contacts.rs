//! The functions of a scene with frictions and stops: its contacts, and the equations of motion before they are solved.

use linkage_ir::Intrinsic;

use super::ScenePlan;
use crate::derivation::{BearingRow, ContactFormula};
use crate::graph::{NodeId, SymbolId};
use crate::ids::ColumnId;
use crate::program::doc::{fenced, lines};
use crate::program::expression::{Expression, Type};
use crate::program::function::{Body, Value, results};
use crate::program::names::Order;
use crate::program::plan::unnamed;

impl ScenePlan<'_, '_, '_> {
    /// `contacts`: each friction and stop with its scalar s, the derivatives of s, and its limits.
    pub(super) fn contacts(&mut self) {
        let mut doc = lines(["The frictions and stops at a position and the rates `q'`, in the order of the scene."]);
        let formulas = self.scene.contacts.iter().enumerate().map(|(place, contact)| {
            let value = self.plan.text(contact.value);
            match &contact.law {
                ContactFormula::Friction { limit, .. } => {
                    let reaction = if self.bearing(place).is_some() { " |R|" } else { "" };
                    format!("{}: |f| <= {}{reaction} along {value}", contact.label, self.plan.text(*limit))
                }
                ContactFormula::Stop { range: [lower, upper], restitution } => {
                    let [lower, upper, restitution] = [lower, upper, restitution].map(|&node| self.plan.text(node));
                    format!("{}: {lower} <= {value} <= {upper}, s'+ = -({restitution}) s'-", contact.label)
                }
            }
        });
        doc.extend(fenced(formulas));
        doc.extend(lines([
            "",
            "# Errors",
            "`PositionError::NotFinite` with the name of the contact if a number is not finite, `InputError::OutOfRange` with its name if",
            "the limit of a friction is negative.",
        ]));
        let zero = self.plan.derivation.graph.zero();
        let derivation = &self.plan.derivation;
        let (u, v) = (derivation.unknowns.len(), derivation.inputs.len());
        let (mut nodes, mut contacts): (Vec<NodeId>, Vec<Expression>) = (Vec::new(), Vec::new());
        for (place, contact) in self.scene.contacts.iter().enumerate() {
            let first = nodes.len();
            let entries = derivation.unknowns.iter().chain(&derivation.inputs);
            nodes.extend(entries.map(|index| contact.row.get(index).copied().unwrap_or(zero)));
            nodes.extend([contact.value, contact.bias]);
            let (law, numbers): (_, &[&str]) = match &contact.law {
                ContactFormula::Friction { limit, .. } => {
                    nodes.push(*limit);
                    match self.bearing(place) {
                        Some(_) => ("ContactLaw::Bearing", &["factor"]),
                        None => ("ContactLaw::Friction", &["limit"]),
                    }
                }
                ContactFormula::Stop { range, restitution } => {
                    nodes.extend(range);
                    nodes.push(*restitution);
                    ("ContactLaw::Stop", &["lower", "upper", "restitution"])
                }
            };
            let result = |place: usize| Expression::Result(first + place);
            let along = [
                ("value", result(u + v)),
                ("unknowns", Expression::sized_vector(results(first..first + u))),
                ("inputs", Expression::sized_vector(results(first + u..first + u + v))),
                ("bias", result(u + v + 1)),
            ];
            let numbers = numbers.iter().enumerate().map(|(at, name)| (*name, result(u + v + 2 + at)));
            contacts.push(structure(
                "Contact",
                [
                    ("name", Expression::text(&contact.label)),
                    ("along", structure("ContactCoordinate", along)),
                    ("law", structure(law, numbers)),
                ],
            ));
        }
        let sources = vec![self.plan.coordinates(Order::Rate)];
        let body = self.on_coordinates(sources, Vec::new(), unnamed(nodes));
        let valid =
            Expression::call(Intrinsic::ValidateContacts, [Expression::mechanism(), Expression::List(contacts)]);
        let body = Body { value: Value::Result(valid), ..body };
        self.add(self.signatures.contacts(), doc, body);
    }

    /// The reaction that limits a friction.
    fn bearing(&self, contact: usize) -> Option<&[BearingRow; 2]> {
        self.scene.reactions.as_ref()?.bearings.get(contact)?.as_ref()
    }

    /// `bearings`: the reactions that limit frictions, before the motion is known.
    pub(super) fn bearings(&mut self) {
        let contacts = 0..self.scene.contacts.len();
        let bearings: Vec<[BearingRow; 2]> = contacts.filter_map(|place| self.bearing(place).cloned()).collect();
        if bearings.is_empty() {
            return;
        }
        let zero = self.plan.derivation.graph.zero();
        let derivation = &self.plan.derivation;
        let (mut nodes, mut values): (Vec<NodeId>, Vec<Expression>) = (Vec::new(), Vec::new());
        for components in &bearings {
            let rows = components.iter().map(|row| {
                let mut entries = |entries: Vec<NodeId>| {
                    let first = nodes.len();
                    nodes.extend(&entries);
                    Expression::sized_vector(results(first..first + entries.len()))
                };
                let accelerations = |places: &[ColumnId]| -> Vec<NodeId> {
                    places.iter().map(|place| row.accelerations.get(place).copied().unwrap_or(zero)).collect()
                };
                let multipliers = derivation.residual.ids();
                let multipliers = multipliers.map(|at| row.multipliers.get(&at).copied().unwrap_or(zero)).collect();
                let members = [
                    ("unknowns", entries(accelerations(&derivation.unknowns))),
                    ("inputs", entries(accelerations(&derivation.inputs))),
                    ("rows", entries(multipliers)),
                    ("contacts", entries(row.contacts.clone())),
                ];
                nodes.push(row.constant);
                let constant = [("constant", Expression::Result(nodes.len() - 1))];
                structure("ReactionRow", constant.into_iter().chain(members))
            });
            let rows = rows.collect();
            values.push(structure("Bearing", [("components", Expression::List(rows))]));
        }
        let count = nodes.len();
        let sources = vec![self.plan.coordinates(Order::Rate)];
        let body = self.on_coordinates(sources, Vec::new(), unnamed(nodes));
        let body = body.checked("the reactions", results(0..count));
        let body = Body { value: Value::Plain(Expression::List(values)), ..body };
        let doc = lines([
            "The reactions that limit frictions, in terms of the accelerations, the multipliers and the forces of contacts.",
            "",
            "# Errors",
            "`PositionError::NotFinite` if a number is not finite.",
        ]);
        self.add(self.signatures.bearings(), doc, body);
    }

    /// `equations`: M, Q, W and `u''` at `v'' = 0`.
    pub(super) fn equations(&mut self) {
        let (u, v) = (self.plan.signatures.unknowns.len(), self.signatures.inputs.len());
        let (inertia, forces) = (self.layers.inertia.iter().flatten(), &self.layers.forces);
        let ratios = self.plan.derivation.ratios.iter().flatten();
        let symbols: Vec<SymbolId> = inertia.chain(forces).chain(ratios).chain(&self.scene.bias).copied().collect();
        let outputs = unnamed(self.plan.variables(&symbols));
        let count = outputs.len();
        let body = self.on_motion(outputs, None);
        let body = self.checked_with_effects(body, "the equations of motion", results(0..count));
        let body = self.with_rates(body);
        let (forces, ratios) = (v * v + v, v * v + v + u * v);
        let members = [
            ("mass", Expression::sized_matrix(&results(0..v * v), v, v)),
            ("forces", Expression::sized_vector(results(v * v..forces))),
            ("ratios", Expression::sized_matrix(&results(forces..ratios), u, v)),
            ("bias", Expression::sized_vector(results(ratios..count))),
        ];
        let body = Body { value: Value::Plain(structure("Equations", members)), ..body };
        let doc = lines([
            "M and Q of `M v'' = Q` without frictions and stops, W of `u' = W v'`, and `u''` at `v'' = 0`.",
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` with the name of the body or effect if its force is not",
            "finite.",
        ]);
        self.add(self.signatures.equations(), doc, body);
    }
}

/// A struct of the runtime with these fields.
fn structure<'m>(of: &'static str, members: impl IntoIterator<Item = (&'m str, Expression)>) -> Expression {
    let members = members.into_iter().map(|(name, value)| (name.to_owned(), value));
    Expression::structure(Type::Runtime(of, Vec::new()), members)
}
