//! The fields of a pose: the directions of all angles in sines and cosines of formulas, the inputs and other
//! coordinates that formulas use as numbers, the determinants, and the values of user functions.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::names::{Taken, name_of};
use crate::derivation::{ContactFormula, Derivation, Row};
use crate::graph::{Function, Graph, Node, NodeId, SymbolId, Texts};
use crate::ids::{ColumnId, GroupId};

/// Formulas that a kernel need not compute.
#[derive(Debug, Clone, Default)]
pub struct Given {
    /// The angles with known sine and cosine.
    pub directions: BTreeSet<NodeId>,
    /// Expressions with the symbol that holds their value.
    pub values: FxHashMap<NodeId, SymbolId>,
    /// True if an expression without symbols is computed when the function runs, not rounded to a double.
    pub is_exact: bool,
}

impl Given {
    /// True if a sine, a cosine or another formula is known.
    pub fn holds(&self, graph: &Graph, id: NodeId) -> bool {
        match graph.node(id) {
            Node::Call(Function::Sin | Function::Cos, angle) => self.directions.contains(&angle[0]),
            _ => self.values.contains_key(&id),
        }
    }

    /// The value of an expression without symbols, if it is rounded to a double.
    pub fn constant(&self, graph: &Graph, id: NodeId) -> Option<f64> {
        graph.constant_value(id).filter(|_| !self.is_exact)
    }
}

/// The fields of a pose.
#[derive(Debug, Clone)]
pub struct PosePlan {
    /// Angles and the fields that hold their directions.
    pub directions: BTreeMap<NodeId, String>,
    /// Coordinates held as numbers: index, field, symbol.
    pub values: Vec<(ColumnId, String, SymbolId)>,
    /// Determinants that vary: group, field, symbol.
    pub determinants: Vec<(GroupId, String, SymbolId)>,
    /// Values of user functions: expression, field, symbol.
    pub externals: Vec<(NodeId, String, SymbolId)>,
    /// Formulas that a kernel on a pose need not compute.
    pub given: Given,
}

impl PosePlan {
    pub fn new(derivation: &mut Derivation) -> Self {
        let formulas = formulas(derivation);
        let numeric: Vec<NodeId> = formulas.iter().copied().chain(formulas_of_scenes(derivation)).collect();
        let graph = &mut derivation.graph;
        // `pose_at` computes the sines that only determinants use.
        let mut angles = BTreeSet::new();
        let mut bare = BTreeSet::new();
        let mut externals = BTreeSet::new();
        let stops = |id: NodeId| {
            graph.constant_value(id).is_some()
                || matches!(graph.node(id), Node::Call(Function::Sin | Function::Cos, _) | Node::External(..))
        };
        for id in graph.sweep(&formulas, |_| false, stops) {
            match graph.node(id) {
                _ if graph.constant_value(id).is_some() => {}
                Node::Call(Function::Sin | Function::Cos, angle) => {
                    angles.insert(angle[0]);
                }
                Node::Symbol(symbol) => {
                    bare.insert(*symbol);
                }
                Node::External(..) => {
                    externals.insert(id);
                }
                _ => {}
            }
        }
        let mut texts = Texts::default();
        let mut taken = Taken::unreserved();
        let mut unique = |preferred: String| taken.unique(&preferred);
        let mut determinants = Vec::new();
        for (number, group) in derivation.groups.enumerated() {
            if let Some(determinant) = group.determinant
                && graph.constant_value(determinant.value).is_none()
            {
                let name = graph.symbol_name(determinant.symbol).to_owned();
                determinants.push((number, unique(name), determinant.symbol));
            }
        }
        let mut name = |angle| name_of(texts.of(graph, angle)).unwrap_or_else(|| "angle".to_owned());
        let directions: BTreeMap<NodeId, String> = angles.iter().map(|&angle| (angle, unique(name(angle)))).collect();
        let bare_angles: BTreeSet<SymbolId> = angles.iter().filter_map(|&angle| graph.as_symbol(angle)).collect();
        bare.extend(graph.needed_as_numbers(&numeric));
        bare.extend(&derivation.counted_by_ranges);
        // Near a dead point the functions need the angles of groups that are solved by factorisation in full.
        let factorised = derivation.groups.iter().filter(|group| group.determinant.is_none());
        let factorised = factorised.flat_map(|group| derivation.unknowns.at(&group.unknowns));
        bare.extend(factorised.map(|unknown| derivation.coordinates[unknown].value));
        bare.extend(derivation.inputs.iter().map(|&input| derivation.coordinates[input].value));
        let mut values = Vec::new();
        for (index, coordinate) in derivation.coordinates.enumerated() {
            let has_direction = bare_angles.contains(&coordinate.value);
            if has_direction && bare.contains(&coordinate.value) {
                values.push((index, unique(format!("{}_angle", coordinate.name)), coordinate.value));
            } else if !has_direction {
                values.push((index, unique(coordinate.name.clone()), coordinate.value));
            }
        }
        let mut of_functions = Vec::new();
        for id in externals {
            let Node::External(external, _) = graph.node(id) else { continue };
            let name = graph.external_name(external).unwrap_or_default().to_owned();
            let field = unique(name);
            of_functions.push((id, field.clone(), graph.symbol(field)));
        }
        let by_name = of_functions.iter().map(|(node, _, symbol)| (*node, *symbol)).collect();
        let given = Given { directions: angles, values: by_name, is_exact: false };
        Self { directions, values, determinants, externals: of_functions, given }
    }

    /// The angles whose directions a pose holds.
    pub fn angles(&self) -> impl Iterator<Item = NodeId> {
        self.directions.keys().copied()
    }

    pub fn direction(&self, angle: NodeId) -> &str {
        self.directions.get(&angle).map_or("", String::as_str)
    }
}

/// The formulas of the scenes that depend on coordinates other than through the motion of the mechanism.
fn formulas_of_scenes(derivation: &Derivation) -> impl Iterator<Item = NodeId> {
    derivation.scenes.iter().flat_map(|scene| {
        let energies = [scene.potential, scene.applied, scene.dissipated];
        let contacts = scene.contacts.iter().flat_map(|contact| {
            match &contact.law {
                // A friction depends on the rate of its scalar, not on its value.
                ContactFormula::Friction { limit, .. } => vec![*limit],
                ContactFormula::Stop { range: [lower, upper], .. } => vec![*lower, *upper, contact.value],
            }
        });
        scene.forces.iter().copied().chain(energies).chain(contacts)
    })
}

fn formulas(derivation: &Derivation) -> Vec<NodeId> {
    let mut formulas = derivation.residual.to_vec();
    formulas.extend(&derivation.residual_scales);
    formulas.extend(derivation.implied.iter().flat_map(|implied| [implied.residual, implied.scale]));
    formulas.extend(derivation.jacobian.iter().flat_map(Row::values));
    formulas.extend(&derivation.gamma);
    formulas.extend(derivation.eta.iter().flatten());
    formulas.extend(derivation.ratio_derivatives.iter().flat_map(|second| second.terms.iter().flatten()));
    formulas.extend(derivation.sensitivity.iter().flat_map(|first| first.jacobian.iter().flat_map(Row::values)));
    formulas.extend(derivation.groups.iter().filter_map(|group| Some(group.determinant?.scale)));
    for quantity in derivation.points.iter().chain(&derivation.outputs) {
        formulas.extend(&quantity.value);
        formulas.extend(quantity.jacobian.iter().flat_map(Row::values));
        formulas.extend(&quantity.rate);
        formulas.extend(&quantity.acceleration);
        formulas.extend(&quantity.jerk);
        formulas.extend(quantity.along_inputs.iter().flatten());
        formulas.extend(quantity.by_parameters.iter().flat_map(Row::values));
    }
    let eliminations = derivation.scenes.iter().filter_map(|scene| scene.reactions.as_ref());
    let multiples =
        eliminations.flat_map(|reactions| reactions.multipliers.eliminations.iter().flat_map(|one| &one.multiples));
    formulas.extend(multiples.map(|(_, multiple)| multiple));
    formulas
}
