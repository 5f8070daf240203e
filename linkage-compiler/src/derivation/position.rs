//! Position group by group: in closed form, or by Newton's method.

use rustc_hash::FxHashMap;

use super::assembly::{Assembly, Chord};
use super::closed_form::Solver;
use super::data::{Block, Derivation};
use super::step::Step;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::BlockId;
use crate::structure::{self, Choice, Group, Loops};

impl Derivation {
    /// Solves the position group by group: in closed form if there is one, else by Newton's method.
    pub fn assembly(&mut self) -> Assembly {
        let mut assembly = Assembly::default();
        for id in self.blocks.ids() {
            let block = self.blocks[id].clone();
            let start = assembly.steps.len();
            let closed = self.assemble(id, &block, &mut assembly);
            if closed.is_some() {
                assembly.closed.insert(id, start..assembly.steps.len());
            }
            if let (Some(determinant), Some(choice)) = (closed, Choice::of(block.group, block.slide)) {
                let is_opposite = self.graph.leads_negative(determinant);
                assembly.chords.push(Chord { block: id, choice, is_opposite });
            }
            if closed.is_none() {
                self.find_loops(id, &block, &mut assembly);
                self.iterate(id, &block, &mut assembly);
            }
            let Some(determinant) = block.determinant else { continue };
            let node = closed.unwrap_or_else(|| assembly.solved(&mut self.graph, &[determinant.value])[0]);
            assembly.steps.push(Step::Let { symbol: determinant.symbol, node });
            assembly.determinants.insert(id, self.graph.variable(determinant.symbol));
        }
        assembly
    }

    /// Finds the loops of a block of which all positions can be listed.
    fn find_loops(&mut self, id: BlockId, block: &Block, assembly: &mut Assembly) {
        if !matches!(block.group, Group::Loops(_)) {
            return;
        }
        let equations = self.residual.at(&block.equations);
        let symbols: Vec<SymbolId> =
            block.unknowns.iter().map(|&place| self.coordinates[self.unknowns[place]].value).collect();
        if let Ok(loops) = Loops::of(&mut self.graph, &equations, &symbols) {
            let nodes = loops.nodes();
            let solved = assembly.solved(&mut self.graph, &nodes);
            let solved: FxHashMap<NodeId, NodeId> = nodes.into_iter().zip(solved).collect();
            assembly.loops.insert(id, loops.map(|node| solved.get(&node).copied().unwrap_or(node)));
        }
    }

    fn assemble(&mut self, id: BlockId, block: &Block, assembly: &mut Assembly) -> Option<NodeId> {
        let equations = self.residual.at(&block.equations);
        let rows = assembly.solved(&mut self.graph, &equations);
        let rows = structure::mirror(&mut self.graph, &rows, &block.mirrored);
        let symbols: Vec<SymbolId> =
            block.unknowns.iter().map(|&place| self.coordinates[self.unknowns[place]].value).collect();
        let mirrored = &block.mirrored;
        let mut group = Solver { graph: &mut self.graph, block: id, equations, assembly, mirrored };
        let determinant = match (block.group, rows.as_slice(), symbols.as_slice()) {
            (Group::Linear, &[row], &[unknown]) => group.linear(row, unknown),
            (Group::Angle, &[row], &[phi]) => {
                group.angle(row, phi, block.slide.is_none_or(|slide| slide.is_far_rising))
            }
            (Group::Sliders, &[x, y], &[s, t]) => group.sliders([x, y], s, t),
            (Group::Circles, &[one, other], &[x, y]) => group.circles([one, other], [x, y]),
            (Group::LinkToCircle, &[row], &[phi]) => group.link_to_circle(row, phi),
            (Group::SliderToCircle, &[row], &[s]) => group.slider_to_circle(row, s),
            (Group::Rrr, &[x, y], &[a, b]) => {
                // The first angle may be measured relative to the other link.
                if group.is_link(&[x, y], a, b) {
                    group.two_links([x, y], a, b, 1)
                } else {
                    let determinant = group.two_links([x, y], b, a, -1)?;
                    Some(group.graph.negate(determinant))
                }
            }
            (Group::Rrp | Group::Rpr, &[x, y], &[a, b]) => {
                let slope = group.graph.partial(&[x, y], b);
                let is_slider = |graph: &Graph| slope.iter().all(|&part| !graph.symbols_of(&[part]).contains(&b));
                let (phi, s, swapped) = if is_slider(group.graph) { (a, b, false) } else { (b, a, true) };
                let determinant = group.slider([x, y], phi, s, block.group)?;
                Some(if swapped { group.graph.negate(determinant) } else { determinant })
            }
            _ => None,
        }?;
        // A mirrored angle changes the sign of its column of J.
        Some(if mirrored.len().is_multiple_of(2) { determinant } else { self.graph.negate(determinant) })
    }
}
