//! `DERIVATION` of a scene: its equations of motion as data.

use proc_macro2::TokenStream;
use quote::quote;
use rustc_hash::FxHashMap;

use super::document::{Document, formula, kernel_list, list, names, option, symbols, texts};
use super::names::string;
use super::work::Work;
use crate::derivation::{ContactFormula, Derivation, Reactions, Scene};
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::ids::{InputId, Table};
use crate::model::{self, Driver, LoadKind, Mechanism};
use crate::notation::{Formula, Name, Printer};

/// The constant `DERIVATION` of a scene: its equations of motion.
pub(super) fn of_scene(
    mechanism: &Mechanism,
    (driver, scene): (&Driver, &model::Scene),
    (derivation, derived): (&Derivation, &Scene),
    kernels: &[Work],
    root: &TokenStream,
) -> TokenStream {
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
    let own = scene.parameters.iter().map(|&place| mechanism.scene_parameters[place].name.text.as_str());
    let own: Vec<&str> = own.collect();
    let mut document = Document {
        printer: Printer::new(graph, &shown),
        derivation,
        parameters: &own,
        inputs: &inputs,
        unknowns: &unknowns,
    };
    let mut mass_matrix = Vec::new();
    for (row, entries) in derived.mass_matrix.iter().flatten().enumerate() {
        for (column, &entry) in entries.iter().enumerate().skip(row) {
            let name = if inputs.len() == 1 { "M".to_owned() } else { format!("M{}{}", row + 1, column + 1) };
            mass_matrix.push(document.equation(Name::Plain(&name), entry));
        }
    }
    let mut effects = Vec::new();
    let is_zero = |forces: &Table<InputId, NodeId>| forces.iter().all(|&force| graph.is_zero(force));
    for (place, (label, forces)) in derived.parts.iter().enumerate() {
        let equations = document.forces(graph, forces.iter().copied());
        // An effect without a part in Q is shown, with its other laws or once; the inertia of a body is not.
        let is_other =
            |(at, (other, forces)): (usize, &(String, _))| other == label && (!is_zero(forces) || at < place);
        let is_alone = !derived.parts.iter().enumerate().any(is_other);
        let is_effect = || label.strip_prefix("body ").is_none_or(|body| is_heavy(mechanism, scene, body));
        if equations.is_some() || (is_alone && is_effect()) {
            let (label, equations) = (string(label), equations.unwrap_or_else(|| document.no_forces()));
            effects.push(quote!(Effect { name: #label, forces: #equations }));
        }
    }
    let frictions_and_stops = contacts.list(&mut document, graph, (mechanism, scene), derived);
    let drives = list(
        derived
            .drives
            .iter()
            .map(|(&input, drive)| document.equation(Name::Plain(inputs[input]), drive.value))
            .collect::<Vec<_>>(),
    );
    let potential = !graph.is_zero(derived.potential);
    let potential = option(potential.then(|| document.equation(Name::Plain("V"), derived.potential)));
    let joints = reactions.map(|reactions| document.joints(mechanism, scene, reactions)).unwrap_or_default();
    let used = graph.symbols_of(&reactions.iter().flat_map(|reactions| reactions.forces.concat()).collect::<Vec<_>>());
    let of_contacts = reactions.iter().flat_map(|reactions| &reactions.contact_forces);
    let acting = scene.contacts.iter().zip(of_contacts).zip(&contact_forces);
    let acting = acting.filter(|((_, symbol), _)| !joints.is_empty() && used.contains(symbol));
    let acting = acting.map(|((contact, _), name)| {
        let (label, shown) = (string(&contact.label), formula(&Formula::of_name(Name::Plain(name))));
        quote!(Symbol { name: #label, formula: #shown })
    });
    let acting = list(acting);
    let multipliers = reactions.iter().flat_map(|reactions| reactions.multipliers.names.iter());
    let multipliers = multipliers.filter(|symbol| !joints.is_empty() && used.contains(symbol));
    let multipliers =
        list(multipliers.map(|&symbol| formula(&Formula::of_name(Name::Plain(graph.symbol_name(symbol))))));
    let (parameters, kernels) = (symbols(&own), kernel_list(kernels));
    let [text, of] = [&scene.name, &driver.name].map(|name| string(&name.to_string()));
    let name = &scene.name;
    quote! {
        impl #name {
            /// The equations of motion as data: every formula as text, `LaTeX` and `MathML`, and the operations of each
            /// function. If it is not used, it is not in the program.
            pub const DERIVATION: &'static #root::__rt::derivation::prelude::SceneDerivation = {
                use #root::__rt::derivation::prelude::*;
                &SceneDerivation {
                    scene: #text,
                    mechanism: #of,
                    parameters: #parameters,
                    mass_matrix: &[#(#mass_matrix),*],
                    forces: &[#(#effects),*],
                    frictions_and_stops: #frictions_and_stops,
                    drives: #drives,
                    potential: #potential,
                    joints: &[#(#joints),*],
                    multipliers: #multipliers,
                    contacts: #acting,
                    kernels: #kernels,
                }
            };
        }
    }
}

impl Document<'_> {
    /// The forces in the joints that a scene shows.
    fn joints(&mut self, mechanism: &Mechanism, scene: &model::Scene, reactions: &Reactions) -> Vec<TokenStream> {
        let shown = scene.loads.iter().filter_map(|load| {
            let place = reactions.opened.iter().position(|other| other == load)?;
            Some((&mechanism.opened.loads[*load], reactions.forces[place]))
        });
        let forces = shown.map(|(load, force)| {
            let parts = match &load.kind {
                LoadKind::Pin { .. } => ["R_x", "R_y"],
                LoadKind::Guide { .. } => ["N", "T"],
            };
            let name = name_of_joint(&load.kind);
            let left_out = load.left_out(&mechanism.graph);
            let name = left_out.map_or(name.clone(), |equations| format!("{name}, without the forces of {equations}"));
            let name = string(&name);
            let [first, second] = [0, 1].map(|axis| self.equation(Name::Plain(parts[axis]), force[axis]));
            quote!(JointForce { name: #name, components: [#first, #second] })
        });
        forces.collect()
    }

    /// The contributions to Q that are not zero, if there is one.
    fn forces(&mut self, graph: &Graph, forces: impl ExactSizeIterator<Item = NodeId>) -> Option<TokenStream> {
        let count = forces.len();
        let nonzero: Vec<(usize, NodeId)> = forces.enumerate().filter(|(_, force)| !graph.is_zero(*force)).collect();
        let equations = nonzero.iter().map(|&(index, force)| {
            let name = if count == 1 { "Q".to_owned() } else { format!("Q{}", index + 1) };
            self.equation(Name::Plain(&name), force)
        });
        let equations: Vec<TokenStream> = equations.collect();
        (!equations.is_empty()).then(|| list(equations))
    }

    /// `Q = 0`.
    fn no_forces(&self) -> TokenStream {
        let [left, right] = [Name::Plain("Q"), Name::Plain("0")].map(|name| formula(&Formula::of_name(name)));
        list([quote!(Equation { left: #left, right: #right })])
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

    /// `&[ContactEffect]`.
    fn list(
        &self,
        document: &mut Document<'_>,
        graph: &Graph,
        (mechanism, scene): (&Mechanism, &model::Scene),
        derived: &Scene,
    ) -> TokenStream {
        let names = self.names[0].iter().zip(self.names[1]);
        let contacts = derived.contacts.iter().zip(&scene.contacts).zip(&self.shown).zip(names);
        let contacts = contacts.map(|(((contact, model), shown), (force, scalar))| {
            let [force, scalar] = [force, scalar].map(|name| Formula::of_name(Name::Plain(name)));
            let bounds: Vec<Formula> = shown.bounds.iter().map(|&bound| document.printer.formula(bound)).collect();
            let bearing = model.bearing.map(|load| name_of_joint(&mechanism.opened.loads[load].kind));
            let relation = match bounds.as_slice() {
                [least, most] => at_most(&[least, &scalar, most]),
                [limit, ..] if bearing.is_some() => {
                    at_most(&[&modulus(&force), &product(limit, &modulus(&reaction()))])
                }
                limit => at_most(&[&modulus(&force), limit.first().unwrap_or(&force)]),
            };
            let along = {
                let right = document.printer.formula(contact.value);
                let [left, right] = [&scalar, &right].map(formula);
                quote!(Equation { left: #left, right: #right })
            };
            let bearing = option(bearing.map(|joint| {
                let (joint, shown) = (string(&joint), formula(&reaction()));
                quote!(Symbol { name: #joint, formula: #shown })
            }));
            let rebound = option(shown.rebound.map(|factor| formula(&document.printer.formula(factor))));
            let forces = document.forces(graph, shown.forces.iter().copied());
            let forces = forces.unwrap_or_else(|| document.no_forces());
            let (name, force, relation) = (string(&contact.label), formula(&force), formula(&relation));
            quote! {
                ContactEffect {
                    name: #name,
                    force: #force,
                    along: #along,
                    bound: #relation,
                    bearing: #bearing,
                    rebound: #rebound,
                    forces: #forces,
                }
            }
        });
        list(contacts.collect::<Vec<_>>())
    }
}

/// The force in the joint that limits a friction.
fn reaction() -> Formula {
    Formula::of_name(Name::Plain("R"))
}

/// |x|.
fn modulus(Formula { text, latex, mathml }: &Formula) -> Formula {
    Formula {
        text: format!("|{text}|"),
        latex: format!("\\left|{latex}\\right|"),
        mathml: format!("<mrow><mo>|</mo>{mathml}<mo>|</mo></mrow>"),
    }
}

/// The product of two factors.
fn product(one: &Formula, other: &Formula) -> Formula {
    Formula {
        text: format!("{}·{}", one.text, other.text),
        latex: format!("{} \\cdot {}", one.latex, other.latex),
        mathml: format!("<mrow>{}<mo>⋅</mo>{}</mrow>", one.mathml, other.mathml),
    }
}

/// a <= b <= ….
fn at_most(parts: &[&Formula]) -> Formula {
    let joined =
        |of: fn(&Formula) -> &str, sign: &str| parts.iter().map(|part| of(part)).collect::<Vec<_>>().join(sign);
    Formula {
        text: joined(|part| &part.text, " ≤ "),
        latex: joined(|part| &part.latex, " \\leq "),
        mathml: format!("<mrow>{}</mrow>", joined(|part| &part.mathml, "<mo>≤</mo>")),
    }
}
