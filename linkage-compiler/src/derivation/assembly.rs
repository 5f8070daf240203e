//! The steps that solve all groups, and their results.

use std::collections::BTreeMap;
use std::ops::Range;

use rustc_hash::FxHashMap;

use super::plane::{Vector, turned};
use super::step::Step;
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};
use crate::ids::{ColumnId, GroupId};
use crate::structure::{Choice, Loops};

/// The steps that solve all groups, and their results.
#[derive(Debug, Clone, Default)]
pub struct Assembly {
    pub steps: Vec<Step>,
    /// The steps of each group that has a closed form.
    pub closed: BTreeMap<GroupId, Range<usize>>,
    /// The determinants of the groups that have a formula.
    pub determinants: BTreeMap<GroupId, NodeId>,
    /// The groups that have two solutions, in the order of solution.
    pub chords: Vec<Chord>,
    /// The group of each angle of an RRR dyad.
    pub of_dyads: BTreeMap<SymbolId, GroupId>,
    /// Functions that must be non-negative for a group with two solutions to be assembled.
    pub bounds: Vec<(GroupId, Vec<NodeId>)>,
    /// The loops of the groups of which all positions can be listed, in terms of what is known before.
    pub loops: BTreeMap<GroupId, Loops>,
    /// The coordinates without closed form, and the symbols of their guesses.
    pub guesses: Vec<(ColumnId, SymbolId)>,
    /// The cosine and sine of each solved angle, for formulas.
    pub(super) directions: BTreeMap<SymbolId, Vector>,
    /// Their names.
    pub named_directions: BTreeMap<SymbolId, Vector>,
}

/// A group with two solutions, which differ in the sign of its half chord.
#[derive(Debug, Clone, Copy)]
pub struct Chord {
    pub group: GroupId,
    pub choice: Choice,
    /// True if the determinant of the group and the half chord have opposite signs.
    pub is_opposite: bool,
}

impl Assembly {
    /// The steps that solve all groups without a guess; `None` if Newton's method needs one for a group.
    #[must_use]
    pub fn listed_steps(&self) -> Option<Vec<Step>> {
        let listed = |step: &Step| match step.clone() {
            Step::Newton { group, targets, known, system, .. } => {
                let loops = self.loops.get(&group)?.clone();
                Some(Step::Modes { group, targets, loops, known, system })
            }
            step => Some(step),
        };
        self.steps.iter().map(listed).collect()
    }

    /// Replaces cosines and sines of solved angles by their symbols.
    pub fn solved(&self, graph: &mut Graph, roots: &[NodeId]) -> Vec<NodeId> {
        let mut by = FxHashMap::default();
        for id in graph.reachable(roots) {
            let &Node::Call(function @ (Function::Sin | Function::Cos), ref angle) = graph.node(id) else { continue };
            let angle = angle[0];
            if let Some([cosine, sine]) = self.direction(graph, angle) {
                by.insert(id, if function == Function::Cos { cosine } else { sine });
            }
        }
        graph.replace(roots, &by)
    }

    /// Steps that follow the assembly, with cosines and sines of solved angles replaced by their symbols.
    pub fn solved_steps(&self, graph: &mut Graph, steps: Vec<Step>) -> Vec<Step> {
        let nodes: Vec<NodeId> = steps.iter().flat_map(Step::nodes).collect();
        let solved: FxHashMap<NodeId, NodeId> = nodes.iter().copied().zip(self.solved(graph, &nodes)).collect();
        steps.into_iter().map(|step| step.map(|node| solved.get(&node).copied().unwrap_or(node))).collect()
    }

    /// The direction of an angle that is an integer combination of solved angles plus other terms; None if it contains
    /// no solved angle, or one with another factor.
    fn direction(&self, graph: &mut Graph, angle: NodeId) -> Option<Vector> {
        let (constant, terms) = match graph.node(angle).clone() {
            Node::Sum { constant, terms } => (constant, terms),
            Node::Product { coefficient, factors } if !coefficient.is_one() => {
                (Number::ZERO, vec![(coefficient, graph.product(&factors))])
            }
            _ => (Number::ZERO, vec![(Number::ONE, angle)]),
        };
        let known = |graph: &Graph, term: NodeId| graph.as_symbol(term).and_then(|s| self.directions.get(&s).copied());
        let (solved, rest): (Vec<_>, Vec<_>) = terms.into_iter().partition(|(_, term)| known(graph, *term).is_some());
        if solved.is_empty() {
            return None;
        }
        let mut rest = rest;
        let one = graph.one();
        rest.push((constant, one));
        let rest = graph.sum(&rest);
        let mut total = [Function::Cos, Function::Sin].map(|function| graph.call(function, &[rest]));
        for (times, term) in solved {
            let times = times.as_integer().filter(|times| times.abs() <= 4)?;
            let [c, s] = known(graph, term)?;
            let s = if times < 0 { graph.negate(s) } else { s };
            for _ in 0..times.abs() {
                total = turned(graph, total, [c, s]);
            }
        }
        Some(total)
    }
}
