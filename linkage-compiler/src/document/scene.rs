//! The document of a scene: its equations of motion.

use linkage_ir::document::FormulaId;
use rustc_hash::FxHashMap;

use super::data::{ContactEffect, Effect, Equation, JointForce, Kernel, SceneDerivation, SceneDocument, Symbol, with};
use super::driver::Writer;
use super::layout::Layout;
use super::name::{Name, names, texts};
use super::table::{self, Node};
use crate::derivation::{ContactFormula, Derivation, Reactions, Scene};
use crate::graph::{Function, Graph, NodeId, Number, SymbolId};
use crate::ids::{InputId, Table};
use crate::model::{self, Driver, LoadKind, Mechanism};

/// The document of a scene; `kernels` adds its functions.
#[must_use]
pub fn of_scene(
    mechanism: &Mechanism,
    (driver, scene): (&Driver, &model::Scene),
    (derivation, derived): (&Derivation, &Scene),
    kernels: &dyn Fn(&mut table::Table) -> Vec<Kernel>,
) -> SceneDocument {
    let (inputs, unknowns) = (texts(mechanism, &driver.inputs), texts(mechanism, &driver.unknowns));
    let mut names = names(mechanism, derivation, &inputs, &unknowns);
    for parameter in &mechanism.scene_parameters {
        names.insert(parameter.symbol, Name::Plain(&parameter.name.text));
    }
    let contact_forces = numbered(["f", "F", "phi", "force"], scene.contacts.len(), &names);
    let contact_scalars = numbered(["s", "sigma", "xi", "scalar"], scene.contacts.len(), &names);
    let reactions = derived.reactions.as_ref();
    let of_contacts = reactions.iter().flat_map(|reactions| &reactions.contact_forces);
    names.extend(of_contacts.zip(&contact_forces).map(|(&symbol, name)| (symbol, Name::Plain(name))));
    let mut graph = derivation.graph.clone();
    let contacts = Contacts::of(&mut graph, derivation, derived, [&contact_forces, &contact_scalars]);
    names.extend(contacts.names());
    let graph = &graph;
    let shown = |symbol: SymbolId| names.get(&symbol).copied().unwrap_or(Name::Plain(graph.symbol_name(symbol)));
    let own = scene.parameters.iter().map(|&index| mechanism.scene_parameters[index].name.text.as_str());
    let own: Vec<&str> = own.collect();
    let mut writer = Writer {
        layout: Layout::new(graph, &shown),
        derivation,
        parameters: &own,
        inputs: &inputs,
        unknowns: &unknowns,
    };
    let mut mass_matrix = Vec::new();
    for (row, entries) in derived.mass_matrix.iter().flatten().enumerate() {
        for (column, &entry) in entries.iter().enumerate().skip(row) {
            let name = if inputs.len() == 1 { "M".to_owned() } else { format!("M{}{}", row + 1, column + 1) };
            mass_matrix.push(writer.equation(Name::Plain(&name), entry));
        }
    }
    let mut effects = Vec::new();
    let is_zero = |forces: &Table<InputId, NodeId>| forces.iter().all(|&force| graph.is_zero(force));
    for (index, (label, forces)) in derived.parts.iter().enumerate() {
        let equations = writer.forces(graph, forces.iter().copied());
        // An effect without a part in Q is shown, with its other laws or once; the inertia of a body is not.
        let is_other =
            |(at, (other, forces)): (usize, &(String, _))| other == label && (!is_zero(forces) || at < index);
        let is_alone = !derived.parts.iter().enumerate().any(is_other);
        let is_effect = || label.strip_prefix("body ").is_none_or(|body| is_heavy(mechanism, scene, body));
        if equations.is_some() || (is_alone && is_effect()) {
            let forces = equations.unwrap_or_else(|| writer.no_forces());
            effects.push(Effect { name: label.clone(), forces });
        }
    }
    let frictions_and_stops = contacts.list(&mut writer, graph, (mechanism, scene), derived);
    let drives = derived.drives.iter();
    let drives = drives.map(|(&input, drive)| writer.equation(Name::Plain(inputs[input]), drive.value)).collect();
    let potential = !graph.is_zero(derived.potential);
    let potential = potential.then(|| writer.equation(Name::Plain("V"), derived.potential));
    let joints = reactions.map(|reactions| writer.joints(mechanism, scene, reactions)).unwrap_or_default();
    let used = graph.symbols_of(&reactions.iter().flat_map(|reactions| reactions.forces.concat()).collect::<Vec<_>>());
    let of_contacts = reactions.iter().flat_map(|reactions| &reactions.contact_forces);
    let acting = scene.contacts.iter().zip(of_contacts).zip(&contact_forces);
    let acting = acting.filter(|((_, symbol), _)| !joints.is_empty() && used.contains(symbol));
    let contacts =
        acting.map(|((contact, _), name)| Symbol { name: contact.label.clone(), formula: writer.plain(name) });
    let contacts = contacts.collect();
    let multipliers = reactions.iter().flat_map(|reactions| reactions.multipliers.names.iter());
    let multipliers = multipliers.filter(|symbol| !joints.is_empty() && used.contains(symbol));
    let multipliers = multipliers.map(|&symbol| writer.plain(graph.symbol_name(symbol))).collect();
    let record = SceneDerivation {
        scene: scene.name.to_string(),
        mechanism: driver.name.to_string(),
        parameters: writer.symbols(&own),
        mass_matrix,
        forces: effects,
        frictions_and_stops,
        drives,
        potential,
        joints,
        multipliers,
        contacts,
        kernels: kernels(&mut writer.layout.table),
    };
    with(record, writer.layout.table)
}

impl Writer<'_> {
    /// The forces in the joints that a scene shows.
    fn joints(&mut self, mechanism: &Mechanism, scene: &model::Scene, reactions: &Reactions) -> Vec<JointForce> {
        let shown = scene.loads.iter().filter_map(|load| {
            let index = reactions.opened.iter().position(|other| other == load)?;
            Some((&mechanism.opened.loads[*load], reactions.forces[index]))
        });
        let forces = shown.map(|(load, force)| {
            let parts = match &load.kind {
                LoadKind::Pin { .. } => ["R_x", "R_y"],
                LoadKind::Guide { .. } => ["N", "T"],
            };
            let name = name_of_joint(&load.kind);
            let left_out = load.left_out(&mechanism.graph);
            let name = left_out.map_or(name.clone(), |equations| format!("{name}, without the forces of {equations}"));
            let components = [0, 1].map(|axis| self.equation(Name::Plain(parts[axis]), force[axis]));
            JointForce { name, components }
        });
        forces.collect()
    }

    /// The contributions to Q that are not zero, if there is one.
    fn forces(&mut self, graph: &Graph, forces: impl ExactSizeIterator<Item = NodeId>) -> Option<Vec<Equation>> {
        let count = forces.len();
        let nonzero: Vec<(usize, NodeId)> = forces.enumerate().filter(|(_, force)| !graph.is_zero(*force)).collect();
        let equations = nonzero.iter().map(|&(index, force)| {
            let name = if count == 1 { "Q".to_owned() } else { format!("Q{}", index + 1) };
            self.equation(Name::Plain(&name), force)
        });
        let equations: Vec<Equation> = equations.collect();
        (!equations.is_empty()).then_some(equations)
    }

    /// `Q = 0`.
    fn no_forces(&mut self) -> Vec<Equation> {
        vec![Equation { left: self.plain("Q"), right: self.layout.table.add(Node::Integer(0)) }]
    }
}

/// The name of a joint and of the links that it joins.
fn name_of_joint(kind: &LoadKind) -> String {
    match kind {
        LoadKind::Pin { joint, link } => format!("the pin at {joint} on {link}"),
        LoadKind::Guide { coordinate, guide, block, .. } => format!("the guide of {coordinate}, {guide} on {block}"),
    }
}

/// True if gravity acts on a body.
fn is_heavy(mechanism: &Mechanism, scene: &model::Scene, body: &str) -> bool {
    scene.weights.iter().any(|(id, _)| mechanism.bodies[*id].name.text == body)
}

/// Names with numbers from 1, of the first letter with which none is taken.
fn numbered(letters: [&str; 4], count: usize, taken: &FxHashMap<SymbolId, Name<'_>>) -> Vec<String> {
    let is_taken = |name: &str| {
        taken.values().any(|other| match *other {
            Name::Plain(other) => other.replace('_', "") == name.replace('_', ""),
            _ => false,
        })
    };
    let of = |letter: &str| (1..=count).map(|number| format!("{letter}_{number}")).collect::<Vec<_>>();
    let free = letters.iter().map(|letter| of(letter)).find(|names| !names.iter().any(|name| is_taken(name)));
    free.unwrap_or_else(|| of("contact"))
}

/// The formulas of frictions and stops: their forces f and scalars s as symbols.
struct Contacts<'a> {
    symbols: [Vec<SymbolId>; 2],
    names: [&'a [String]; 2],
    shown: Vec<ContactNodes>,
}

/// The formulas of a friction or a stop.
struct ContactNodes {
    /// f ds/dv for each input.
    forces: Vec<NodeId>,
    /// The limit of |f|, or the ends of s.
    bounds: Vec<NodeId>,
    /// The factor of s' at an impact.
    rebound: Option<NodeId>,
}

impl<'a> Contacts<'a> {
    fn of(graph: &mut Graph, derivation: &Derivation, derived: &Scene, names: [&'a [String]; 2]) -> Self {
        let symbols = names.map(|names| names.iter().map(|name| graph.symbol(name.clone())).collect::<Vec<_>>());
        let mut shown = Vec::new();
        for (contact, &force) in derived.contacts.iter().zip(&symbols[0]) {
            let force = graph.variable(force);
            let slope = |column| contact.row.get(column).copied();
            let mut forces = Vec::new();
            for (input, ratios) in derivation.inputs.iter().zip(derivation.ratios.iter()) {
                let mut terms: Vec<(Number, NodeId)> =
                    slope(input).map(|slope| (Number::ONE, slope)).into_iter().collect();
                for (unknown, &ratio) in derivation.unknowns.iter().zip(ratios.iter()) {
                    if let Some(slope) = slope(unknown) {
                        let ratio = graph.variable(ratio);
                        terms.push((Number::ONE, graph.multiply(slope, ratio)));
                    }
                }
                let total = graph.sum(&terms);
                forces.push(graph.multiply(force, total));
            }
            let (bounds, rebound) = match &contact.law {
                ContactFormula::Friction { limit, .. } => (vec![*limit], None),
                ContactFormula::Stop { range, restitution } => (range.to_vec(), Some(graph.negate(*restitution))),
            };
            shown.push(ContactNodes { forces, bounds, rebound });
        }
        Self { symbols, names, shown }
    }

    /// The names of the symbols.
    fn names(&self) -> impl Iterator<Item = (SymbolId, Name<'a>)> {
        let pairs = self.symbols.iter().zip(self.names);
        pairs.flat_map(|(symbols, names)| symbols.iter().copied().zip(names.iter().map(|name| Name::Plain(name))))
    }

    fn list(
        &self,
        writer: &mut Writer<'_>,
        graph: &Graph,
        (mechanism, scene): (&Mechanism, &model::Scene),
        derived: &Scene,
    ) -> Vec<ContactEffect> {
        let names = self.names[0].iter().zip(self.names[1]);
        let contacts = derived.contacts.iter().zip(&scene.contacts).zip(&self.shown).zip(names);
        let contacts = contacts.map(|(((contact, model), shown), (force, scalar))| {
            let [force, scalar] = [force, scalar].map(|name| writer.plain(name));
            let bounds: Vec<FormulaId> = shown.bounds.iter().map(|&bound| writer.formula(bound)).collect();
            let bearing = model.bearing.map(|load| name_of_joint(&mechanism.opened.loads[load].kind));
            // The force in the joint that limits a friction.
            let bearing = bearing.map(|name| Symbol { name, formula: writer.plain("R") });
            let bound = match bounds.as_slice() {
                [least, most] => vec![*least, scalar, *most],
                limits => {
                    let limit = limits.first().copied().unwrap_or(force);
                    let limit = match &bearing {
                        Some(Symbol { formula, .. }) => {
                            let reaction = writer.modulus(*formula);
                            writer.layout.table.add(Node::Multiple(limit, reaction))
                        }
                        None => limit,
                    };
                    vec![writer.modulus(force), limit]
                }
            };
            ContactEffect {
                name: contact.label.clone(),
                force,
                along: Equation { left: scalar, right: writer.formula(contact.value) },
                bound: writer.layout.table.add(Node::AtMost(bound)),
                bearing,
                rebound: shown.rebound.map(|factor| writer.formula(factor)),
                forces: {
                    let forces = writer.forces(graph, shown.forces.iter().copied());
                    forces.unwrap_or_else(|| writer.no_forces())
                },
            }
        });
        contacts.collect()
    }
}

impl Writer<'_> {
    /// |x|.
    fn modulus(&mut self, inside: FormulaId) -> FormulaId {
        self.layout.table.add(Node::Call(Function::Abs, vec![inside]))
    }
}
