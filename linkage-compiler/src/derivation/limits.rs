//! Where an input ends: what must not be negative for a group to be assembled, as a function of one input.
//!
//! A group that stands on inputs alone has a bound f(v) >= 0 of one of two forms, told by its derivatives:
//! f''' = -f' is a + b cos(v) + c sin(v), and f''' = 0 is a + b v + c v^2. All other groups are searched.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::{Assembly, Derivation};
use crate::graph::{NodeId, Number, SymbolId};
use crate::simplify::equality::{Verdict, is_zero};
use crate::simplify::schedule::Stage;
use crate::simplify::simplify;

/// f(v) >= 0 where a block can be assembled.
#[derive(Debug, Clone, Copy)]
pub struct Bound {
    pub block: usize,
    /// Whether v is an angle.
    pub is_angle: bool,
    /// a, b and c, free of v.
    pub coefficients: [NodeId; 3],
}

impl Derivation {
    /// The bounds on one input, by its place in q, and whether blocks are left that must be searched.
    pub fn bounds(&mut self, assembly: &Assembly, input: usize) -> (Vec<Bound>, bool) {
        let mut is_searched = assembly.stages.iter().any(|stage| matches!(stage, Stage::Newton { .. }));
        let formulas: FxHashMap<NodeId, NodeId> = assembly
            .stages
            .iter()
            .filter_map(|stage| match stage {
                Stage::Let { symbol, node } => Some((self.graph.variable(*symbol), *node)),
                _ => None,
            })
            .collect();
        let mut bounds = Vec::new();
        for (block, functions) in &assembly.bounds {
            let stands_on_inputs = self.stands_on_inputs(*block);
            for &function in functions {
                let bound = stands_on_inputs.then(|| self.bound(*block, function, input, &formulas));
                match bound {
                    Some(Some(bound)) => bounds.extend(bound),
                    _ => is_searched = true,
                }
            }
        }
        (bounds, is_searched)
    }

    /// Whether no unknown of another block enters the closures of a block.
    fn stands_on_inputs(&self, block: usize) -> bool {
        let block = &self.blocks[block];
        let rows: Vec<NodeId> = block.equations.iter().map(|&equation| self.residual[equation]).collect();
        let symbols = self.graph.symbols_of(&rows);
        let others = (0..self.unknowns.len()).filter(|place| !block.unknowns.contains(place));
        others.map(|place| self.coordinates[self.unknowns[place]].value).all(|symbol| !symbols.contains(&symbol))
    }

    /// A function in one of the two forms; none if it has neither, an empty one if the input has no say in it.
    fn bound(
        &mut self,
        block: usize,
        function: NodeId,
        input: usize,
        formulas: &FxHashMap<NodeId, NodeId>,
    ) -> Option<Option<Bound>> {
        let input = self.coordinates[input].value;
        let function = self.written_out(function, formulas);
        let graph = &mut self.graph;
        if !graph.symbols_of(&[function]).contains(&input) {
            return Some(None);
        }
        let slope = graph.partial(&[function], input)[0];
        let curvature = graph.partial(&[slope], input)[0];
        let third = graph.partial(&[curvature], input)[0];
        let circular = graph.add(third, slope);
        let is_length = is_zero(graph, third) == Verdict::Equal;
        let is_angle = !is_length && is_zero(graph, circular) == Verdict::Equal;
        if !is_length && !is_angle {
            return None;
        }
        let (variable, zero) = (graph.variable(input), graph.zero());
        let by = std::iter::once((variable, zero)).collect();
        let at_zero = graph.replace(&[function, slope, curvature], &by);
        let [value, slope, curvature] = [at_zero[0], at_zero[1], at_zero[2]];
        let coefficients = if is_angle {
            [graph.add(value, curvature), graph.negate(curvature), slope]
        } else {
            [value, slope, graph.scale(Number::ratio(1, 2), curvature)]
        };
        let coefficients = coefficients.map(|node| simplify(graph, &[node], &BTreeSet::new())[0]);
        Some(Some(Bound { block, is_angle, coefficients }))
    }

    /// A function with the formulas of the names it is made of.
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
            if by.is_empty() {
                return function;
            }
            function = self.graph.replace(&[function], &by)[0];
        }
    }
}
