//! Limits of inputs: the conditions f(v) >= 0 under which groups can be assembled, as functions of one input.
//!
//! If a group depends on the inputs alone, directly or through linear equations, f may have one of two forms,
//! recognised by their derivatives: `f''' = -k^2 f'` means a + b cos(k v) + c sin(k v), where k is the rate of an angle
//! in f, and `f''' = 0` means a + b v + c v^2. The limits of all other groups are found by search.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::assembly::Assembly;
use super::data::Derivation;
use super::step::Step;
use crate::algebra::simplify;
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId, operation};
use crate::ids::{GroupId, InputId, Table};
use crate::structure::GroupKind;

/// The condition f(v) >= 0 under which a group can be assembled.
#[derive(Debug, Clone, Copy)]
pub struct Bound {
    pub group: GroupId,
    /// k, if f is periodic.
    pub rate: Option<NodeId>,
    /// a, b and c, free of v.
    pub coefficients: [NodeId; 3],
}

impl Derivation {
    /// The bounds on one input in closed form, and true if there are other bounds.
    pub fn bounds(&mut self, assembly: &Assembly, input: InputId) -> (Vec<Bound>, bool) {
        let mut is_searched = assembly.steps.iter().any(|step| matches!(step, Step::Newton { .. }));
        let formulas: FxHashMap<NodeId, NodeId> = assembly
            .steps
            .iter()
            .filter_map(|step| match step {
                Step::Let { symbol, node } => Some((self.graph.variable(*symbol), *node)),
                _ => None,
            })
            .collect();
        let mut bounds = Vec::new();
        let on_inputs = self.on_inputs();
        for (group, functions) in &assembly.bounds {
            for &function in functions {
                let bound = on_inputs[*group].then(|| self.bound(*group, function, input, &formulas));
                match bound {
                    Some(Some(bound)) => bounds.extend(bound),
                    _ => is_searched = true,
                }
            }
        }
        (bounds, is_searched)
    }

    /// For each group, true if it depends on the inputs alone, directly or through linear groups.
    fn on_inputs(&self) -> Table<GroupId, bool> {
        let mut on_inputs = Table::default();
        // The unknowns of linear groups that depend on the inputs alone.
        let mut known = BTreeSet::new();
        for group in &self.groups {
            let symbols = self.graph.symbols_of(&self.residual.at(&group.equations));
            let is_on_inputs = (self.unknowns.enumerated())
                .filter(|(unknown, _)| !group.unknowns.contains(unknown) && !known.contains(unknown))
                .all(|(_, &column)| !symbols.contains(&self.coordinates[column].value));
            if is_on_inputs && matches!(group.kind, GroupKind::Linear | GroupKind::Sliders) {
                known.extend(group.unknowns.iter().copied());
            }
            on_inputs.push(is_on_inputs);
        }
        on_inputs
    }

    /// Converts a function to one of the two forms: `None` if it has neither, `Some(None)` if it does not depend on the
    /// input.
    fn bound(
        &mut self,
        group: GroupId,
        function: NodeId,
        input: InputId,
        formulas: &FxHashMap<NodeId, NodeId>,
    ) -> Option<Option<Bound>> {
        let input = self.coordinates[self.inputs[input]].value;
        let function = self.written_out(function, formulas);
        let graph = &mut self.graph;
        if !graph.symbols_of(&[function]).contains(&input) {
            return Some(None);
        }
        if has_kink(graph, function, input) {
            return None;
        }
        let slope = graph.partial(&[function], input)[0];
        let curvature = graph.partial(&[slope], input)[0];
        let third = graph.partial(&[curvature], input)[0];
        let rate = if vanishes(graph, third) {
            None
        } else {
            let rates = rates(graph, function, input);
            Some(rates.into_iter().find(|&rate| {
                let square = graph.power(rate, 2);
                let opposite = graph.multiply(square, slope);
                let circular = graph.add(third, opposite);
                vanishes(graph, circular)
            })?)
        };
        let (variable, zero) = (graph.variable(input), graph.zero());
        let by = std::iter::once((variable, zero)).collect();
        let at_zero = graph.replace(&[function, slope, curvature], &by);
        let [value, slope, curvature] = [at_zero[0], at_zero[1], at_zero[2]];
        let coefficients = if let Some(rate) = rate {
            let square = graph.power(rate, 2);
            let [sine, cosine] = [(slope, rate), (curvature, square)].map(|(part, by)| graph.divide(part, by));
            [graph.add(value, cosine), graph.negate(cosine), sine]
        } else {
            [value, slope, graph.scale(Number::ratio(1, 2), curvature)]
        };
        let coefficients = coefficients.map(|node| simplify(graph, &[node], &BTreeSet::new())[0]);
        Some(Some(Bound { group, rate, coefficients }))
    }

    /// Replaces names in a function by their formulas.
    fn written_out(&mut self, mut function: NodeId, formulas: &FxHashMap<NodeId, NodeId>) -> NodeId {
        loop {
            let names: Vec<SymbolId> = self.graph.symbols_of(&[function]).into_iter().collect();
            let mut by = FxHashMap::default();
            for name in names {
                let name = self.graph.variable(name);
                if let Some(&formula) = formulas.get(&name) {
                    by.insert(name, formula);
                }
            }
            if by.is_empty() || self.graph.budget().check().is_err() {
                return function;
            }
            function = self.graph.replace(&[function], &by)[0];
        }
    }
}

/// True if an expression has a kink or a jump where something that depends on a symbol is zero, as |w| at w = 0: on each
/// side of it the derivatives may be those of a line.
fn has_kink(graph: &Graph, function: NodeId, symbol: SymbolId) -> bool {
    graph.reachable(&[function]).into_iter().any(|node| match graph.node(node) {
        Node::Call(function, arguments) => {
            let kinks = (operation(*function).kinks)(graph, arguments);
            kinks.into_iter().any(|argument| graph.depends_on(argument, symbol))
        }
        _ => false,
    })
}

/// True if the identities simplify an expression to zero.
fn vanishes(graph: &mut Graph, id: NodeId) -> bool {
    let form = simplify(graph, &[id], &BTreeSet::new())[0];
    graph.is_zero(form)
}

/// The constant derivatives of the angles in a function with respect to an input.
fn rates(graph: &mut Graph, function: NodeId, input: SymbolId) -> Vec<NodeId> {
    let mut angles = Vec::new();
    for id in graph.reachable(&[function]) {
        if let Node::Call(Function::Sin | Function::Cos, angle) = graph.node(id) {
            angles.push(angle[0]);
        }
    }
    let mut rates = Vec::new();
    for rate in graph.partial(&angles, input) {
        let is_constant = !graph.is_zero(rate) && !graph.symbols_of(&[rate]).contains(&input);
        if is_constant && !rates.contains(&rate) {
            rates.push(rate);
        }
    }
    rates
}
