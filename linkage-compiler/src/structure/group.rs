//! Classification of a block as an Assur group.
//!
//! A loop equation of two rows is a complex equation x + i y = 0. Let V be the sum of its terms that contain an
//! unknown. The unknown is
//! - an angle phi of a revolute joint if it rotates V: dV/dphi = i V
//! - a length s of a sliding joint if it moves V along a line: the direction D = dV/ds does not depend on s
//!
//! With two unknowns these are the four cases of M. A. Chace, "Vector analysis of linkages", Journal of
//! Engineering for Industry 85, 1963: two angles, an angle and a length, an angle and a length along a line that it
//! rotates, two lengths.

use crate::graph::{Graph, Node, NodeId, Number, SymbolId};

/// The kind of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Two angles: two links between three revolute joints.
    Rrr,
    /// An angle, and a length along a line that does not turn with it: a link and a slider on a guide.
    Rrp,
    /// An angle, and a length along a line that turns with it: a slider on a turning guide.
    Rpr,
    /// Two lengths along given lines: two sliders.
    Sliders,
    /// One unknown that enters linearly: gears, belts, a slider whose link is known.
    Linear,
    /// One angle phi in a cos(phi) + b sin(phi) + c = 0: a link whose end is known in one direction.
    Angle,
    /// One unknown in any other way.
    Scalar,
    /// Two unknowns in any other way.
    Pair,
    /// More than two unknowns that depend on one another.
    Irreducible(usize),
}

impl Group {
    /// A description for documentation.
    #[must_use]
    pub fn description(self) -> String {
        match self {
            Self::Rrr => "dyad RRR: two angles".to_owned(),
            Self::Rrp => "dyad RRP: an angle, and a length along a given line".to_owned(),
            Self::Rpr => "dyad RPR: an angle, and a length along a line that turns with it".to_owned(),
            Self::Sliders => "dyad PRP or RPP: two lengths along given lines".to_owned(),
            Self::Linear => "one unknown, linear".to_owned(),
            Self::Angle => "one angle".to_owned(),
            Self::Scalar => "one unknown".to_owned(),
            Self::Pair => "two unknowns".to_owned(),
            Self::Irreducible(count) => format!("irreducible group of {count} unknowns"),
        }
    }

    /// Classifies the block of these scalar equations and unknowns.
    pub fn of(graph: &mut Graph, rows: &[NodeId], unknowns: &[SymbolId]) -> Self {
        match (rows, unknowns) {
            (&[row], &[unknown]) => scalar(graph, row, unknown),
            (&[x, y], &[a, b]) => pair(graph, [x, y], a, b),
            _ => Self::Irreducible(unknowns.len()),
        }
    }
}

fn scalar(graph: &mut Graph, row: NodeId, unknown: SymbolId) -> Group {
    let slope = graph.partial(&[row], unknown)[0];
    if !depends_on(graph, slope, unknown) {
        return Group::Linear;
    }
    // d^2 V / dphi^2 = -V
    let part = terms_with(graph, row, unknown);
    let curvature = graph.partial(&[slope], unknown)[0];
    let sum = graph.add(curvature, part);
    if graph.is_zero(sum) { Group::Angle } else { Group::Scalar }
}

fn pair(graph: &mut Graph, rows: [NodeId; 2], a: SymbolId, b: SymbolId) -> Group {
    if two_links(graph, rows, a, b) || two_links(graph, rows, b, a) {
        return Group::Rrr;
    }
    let [angle_a, angle_b] = [a, b].map(|unknown| is_angle(graph, rows, unknown));
    let [line_a, line_b] = [a, b].map(|unknown| direction(graph, rows, unknown));
    match (angle_a, angle_b, line_a, line_b) {
        (true, _, _, Some(line)) => slider(graph, line, a),
        (_, true, Some(line), _) => slider(graph, line, b),
        (_, _, Some(first), Some(second))
            if first.iter().all(|&part| !depends_on(graph, part, b))
                && second.iter().all(|&part| !depends_on(graph, part, a)) =>
        {
            Group::Sliders
        }
        _ => Group::Pair,
    }
}

/// True for two links with the angles a + k b and b: the terms that contain `a` rotate with a + k b, the other terms
/// that contain `b` rotate with b. k is not zero if `a` is measured from the other link.
fn two_links(graph: &mut Graph, rows: [NodeId; 2], a: SymbolId, b: SymbolId) -> bool {
    let link_a = rows.map(|row| terms_with(graph, row, a));
    let others = [0, 1].map(|row| graph.subtract(rows[row], link_a[row]));
    if !is_angle(graph, rows, a) || !is_angle(graph, others, b) {
        return false;
    }
    let [x, y] = link_a;
    let derivatives = graph.partial(&link_a, b);
    (-2..=2).any(|k| derivatives == [graph.scale(Number::integer(-k), y), graph.scale(Number::integer(k), x)])
}

/// The group of an angle and a length along a line: RRP if the line does not depend on the angle, RPR if it turns with
/// the angle.
fn slider(graph: &mut Graph, line: [NodeId; 2], angle: SymbolId) -> Group {
    if line.iter().all(|&part| !depends_on(graph, part, angle)) {
        Group::Rrp
    } else if is_angle(graph, line, angle) && line.iter().all(|&part| terms_with(graph, part, angle) == part) {
        Group::Rpr
    } else {
        Group::Pair
    }
}

/// True if an unknown is an angle: dV/dphi = i V for the terms V of two rows that contain it.
fn is_angle(graph: &mut Graph, rows: [NodeId; 2], unknown: SymbolId) -> bool {
    let [x, y] = rows.map(|row| terms_with(graph, row, unknown));
    let derivatives = graph.partial(&[x, y], unknown);
    let minus_y = graph.negate(y);
    !(graph.is_zero(x) && graph.is_zero(y)) && derivatives == [minus_y, x]
}

/// The direction D = dV/ds of the line of a length; None if it depends on s.
fn direction(graph: &mut Graph, rows: [NodeId; 2], unknown: SymbolId) -> Option<[NodeId; 2]> {
    let derivatives = graph.partial(&rows, unknown);
    let is_constant = derivatives.iter().all(|&part| !depends_on(graph, part, unknown));
    is_constant.then(|| [derivatives[0], derivatives[1]])
}

fn depends_on(graph: &Graph, node: NodeId, symbol: SymbolId) -> bool {
    graph.symbols_of(&[node]).contains(&symbol)
}

/// The terms of a sum that depend on a symbol.
fn terms_with(graph: &mut Graph, row: NodeId, symbol: SymbolId) -> NodeId {
    let terms: Vec<_> = terms(graph, row).into_iter().filter(|&(_, term)| depends_on(graph, term, symbol)).collect();
    graph.sum(&terms)
}

fn terms(graph: &Graph, row: NodeId) -> Vec<(Number, NodeId)> {
    match graph.node(row) {
        Node::Sum { terms, .. } => terms.clone(),
        _ => vec![(Number::ONE, row)],
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::graph::Function;

    struct Plane {
        graph: Graph,
        symbols: BTreeMap<&'static str, SymbolId>,
    }

    impl Plane {
        fn new() -> Self {
            let mut graph = Graph::default();
            let symbols = ["phi", "psi", "s", "t", "l", "r", "d", "delta"].map(|name| (name, graph.symbol(name)));
            Self { graph, symbols: BTreeMap::from(symbols) }
        }

        fn variable(&mut self, name: &str) -> NodeId {
            self.graph.variable(self.symbols[name])
        }

        /// The group of a loop of vectors r@(phi - offset) and the ground d@0.
        fn group(&mut self, vectors: &[(&str, &str, &str)], unknowns: [&str; 2]) -> Group {
            let ground = self.variable("d");
            let (mut x, mut y) = (vec![(Number::ONE, ground)], Vec::new());
            for (modulus, angle, offset) in vectors {
                let modulus = self.variable(modulus);
                let mut angle = self.variable(angle);
                if !offset.is_empty() {
                    let offset = self.variable(offset);
                    angle = self.graph.subtract(angle, offset);
                }
                for (row, function) in [(&mut x, Function::Cos), (&mut y, Function::Sin)] {
                    let part = self.graph.call(function, &[angle]);
                    row.push((Number::ONE, self.graph.multiply(modulus, part)));
                }
            }
            let rows = [self.graph.sum(&x), self.graph.sum(&y)];
            let unknowns = unknowns.map(|name| self.symbols[name]);
            Group::of(&mut self.graph, &rows, &unknowns)
        }
    }

    #[test]
    fn the_four_cases_of_chace() {
        for (vectors, unknowns, group) in [
            (&[("l", "phi", ""), ("r", "psi", "")][..], ["phi", "psi"], Group::Rrr),
            (&[("l", "phi", "delta"), ("r", "psi", ""), ("r", "phi", "")], ["phi", "psi"], Group::Rrr),
            (&[("l", "phi", ""), ("s", "delta", "")], ["phi", "s"], Group::Rrp),
            (&[("s", "delta", ""), ("l", "phi", "")], ["s", "phi"], Group::Rrp),
            (&[("s", "phi", "delta"), ("l", "phi", "")], ["phi", "s"], Group::Rpr),
            // A guide that turns with phi only in part.
            (&[("s", "phi", ""), ("s", "delta", ""), ("l", "phi", "")], ["phi", "s"], Group::Pair),
            (&[("s", "delta", ""), ("t", "psi", "")], ["s", "t"], Group::Sliders),
            // An angle measured from the other link.
            (&[("l", "phi", "psi"), ("r", "psi", "")], ["phi", "psi"], Group::Rrr),
            (&[("l", "phi", "psi"), ("r", "psi", ""), ("r", "phi", "")], ["phi", "psi"], Group::Pair),
        ] {
            assert_eq!(Plane::new().group(vectors, unknowns), group, "{vectors:?}");
        }
    }

    #[test]
    fn single_unknowns() {
        let mut plane = Plane::new();
        let [phi, s, l, d] = ["phi", "s", "l", "d"].map(|name| plane.variable(name));
        let (phi_symbol, s_symbol) = (plane.symbols["phi"], plane.symbols["s"]);
        let g = &mut plane.graph;
        let (sine, cosine) = (g.call(Function::Sin, &[phi]), g.call(Function::Cos, &[phi]));
        let (high, wide) = (g.multiply(l, sine), g.multiply(d, cosine));
        let row = g.sum(&[(Number::ONE, high), (Number::ONE, wide), (Number::ONE, s)]);
        assert_eq!(Group::of(g, &[row], &[phi_symbol]), Group::Angle);
        assert_eq!(Group::of(g, &[row], &[s_symbol]), Group::Linear);
        let rolled = g.add(row, phi);
        assert_eq!(Group::of(g, &[rolled], &[phi_symbol]), Group::Scalar);
        let (twice, symbol) = (g.scale(Number::integer(2), phi), phi_symbol);
        let double = g.call(Function::Sin, &[twice]);
        assert_eq!(Group::of(g, &[double], &[symbol]), Group::Scalar);
    }
}
