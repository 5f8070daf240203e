//! Position group by group: in closed form, or by Newton's method.

use rustc_hash::FxHashMap;

use super::assembly::{Assembly, Chord};
use super::closed_form::Solver;
use super::data::{Derivation, Group};
use super::step::Step;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::GroupId;
use crate::structure::{self, Choice, GroupKind, Loops};

impl Derivation {
    /// Solves the position group by group: in closed form if there is one, else by Newton's method.
    pub fn assembly(&mut self) -> Assembly {
        let mut assembly = Assembly::default();
        for id in self.groups.ids() {
            let group = self.groups[id].clone();
            let start = assembly.steps.len();
            let closed = self.assemble(id, &group, &mut assembly);
            if closed.is_some() {
                assembly.closed.insert(id, start..assembly.steps.len());
            }
            if let (Some(determinant), Some(choice)) = (closed, Choice::of(group.kind, group.slide)) {
                let is_opposite = self.graph.leads_negative(determinant);
                assembly.chords.push(Chord { group: id, choice, is_opposite });
            }
            if closed.is_none() {
                self.find_loops(id, &group, &mut assembly);
                self.iterate(id, &group, &mut assembly);
            }
            let Some(determinant) = group.determinant else { continue };
            let node = closed.unwrap_or_else(|| assembly.solved(&mut self.graph, &[determinant.value])[0]);
            assembly.steps.push(Step::Let { symbol: determinant.symbol, node });
            assembly.determinants.insert(id, self.graph.variable(determinant.symbol));
        }
        assembly
    }

    /// Finds the loops of a group of which all positions can be listed.
    fn find_loops(&mut self, id: GroupId, group: &Group, assembly: &mut Assembly) {
        if !matches!(group.kind, GroupKind::Loops(_)) {
            return;
        }
        let equations = self.residual.at(&group.equations);
        let symbols: Vec<SymbolId> =
            group.unknowns.iter().map(|&index| self.coordinates[self.unknowns[index]].value).collect();
        if let Ok(loops) = Loops::of(&mut self.graph, &equations, &symbols) {
            let nodes = loops.nodes();
            let solved = assembly.solved(&mut self.graph, &nodes);
            let solved: FxHashMap<NodeId, NodeId> = nodes.into_iter().zip(solved).collect();
            assembly.loops.insert(id, loops.map(|node| solved.get(&node).copied().unwrap_or(node)));
        }
    }

    fn assemble(&mut self, id: GroupId, group: &Group, assembly: &mut Assembly) -> Option<NodeId> {
        let equations = self.residual.at(&group.equations);
        let rows = assembly.solved(&mut self.graph, &equations);
        let rows = structure::mirror(&mut self.graph, &rows, &group.mirrored);
        let symbols: Vec<SymbolId> =
            group.unknowns.iter().map(|&index| self.coordinates[self.unknowns[index]].value).collect();
        let mirrored = &group.mirrored;
        let ranges = &self.ranges_of_turns;
        let mut solver = Solver { graph: &mut self.graph, group: id, equations, assembly, mirrored, ranges };
        let determinant = match (group.kind, rows.as_slice(), symbols.as_slice()) {
            (GroupKind::Linear, &[row], &[unknown]) => solver.linear(row, unknown),
            (GroupKind::Angle, &[row], &[phi]) => {
                solver.angle(row, phi, group.slide.is_none_or(|slide| slide.is_far_rising))
            }
            (GroupKind::Sliders, &[x, y], &[s, t]) => solver.sliders([x, y], s, t),
            (GroupKind::Circles, &[one, other], &[x, y]) => solver.circles([one, other], [x, y]),
            (GroupKind::LinkToCircle, &[row], &[phi]) => solver.link_to_circle(row, phi),
            (GroupKind::SliderToCircle, &[row], &[s]) => solver.slider_to_circle(row, s),
            (GroupKind::Rrr, &[x, y], &[a, b]) => {
                // The first angle may be measured relative to the other link.
                if solver.is_link(&[x, y], a, b) {
                    solver.two_links([x, y], a, b, 1)
                } else {
                    let determinant = solver.two_links([x, y], b, a, -1)?;
                    Some(solver.graph.negate(determinant))
                }
            }
            (GroupKind::Rrp | GroupKind::Rpr, &[x, y], &[a, b]) => {
                let slope = solver.graph.partial(&[x, y], b);
                let is_slider = |graph: &Graph| slope.iter().all(|&part| !graph.symbols_of(&[part]).contains(&b));
                let (phi, s, swapped) = if is_slider(solver.graph) { (a, b, false) } else { (b, a, true) };
                let determinant = solver.slider([x, y], phi, s, group.kind)?;
                Some(if swapped { solver.graph.negate(determinant) } else { determinant })
            }
            _ => None,
        }?;
        // A mirrored angle changes the sign of its column of J.
        Some(if mirrored.len().is_multiple_of(2) { determinant } else { self.graph.negate(determinant) })
    }
}
