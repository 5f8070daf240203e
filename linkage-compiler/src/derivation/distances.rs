//! Position in closed form of the groups with an equation for a distance, |W| = q.
//!
//! - a point: X = P + V = Q - W, |V| = p, |W| = q. With D = Q - P this is the triangle of an RRR dyad.
//! - a link: V + W = D, where V = p e^(i phi) and -D is the rest of the vector whose length is given
//! - a slider: s E - D = -W. W x E = D x E = h, W . E = -g, g^2 = (q n - h) (q n + h), n = |E|
//!
//! The derivative of an equation for |W| is w W . dW, where w is 1 / q times a number, or twice a number if it is one for
//! |W|^2. So the determinants are w V x W, w D x V and w g, up to sign.

use super::closed_form::Solver;
use super::plane::{Vector, dot, length, square_of};
use crate::graph::{NodeId, Number, SymbolId};
use crate::structure::{self, Circles, Distance};

impl Solver<'_> {
    pub(super) fn circles(&mut self, rows: [NodeId; 2], unknowns: [SymbolId; 2]) -> Option<NodeId> {
        let Circles { point, distances: [first, second], centres: [p, q] } = Circles::of(self.graph, rows, unknowns)?;
        self.reach_to(&[first.bound, second.bound]);
        let d = [0, 1].map(|axis| self.graph.subtract(q[axis], p[axis]));
        let d = self.line(d);
        let written = <[NodeId; 2]>::try_from(self.equations.as_slice()).ok()?;
        let centres = Circles::of(self.graph, written, unknowns)?.centres.concat();
        let scale = self.scale(&centres);
        let (half_chord, v) = self.triangle(d, [first.length, second.length], scale, 1);
        for axis in [0, 1] {
            let coordinate = self.graph.add(p[axis], v[axis]);
            self.name(point[axis], coordinate);
        }
        // V x (V - D) = D x V
        let determinant = self.graph.product(&[(first.weight, 1), (second.weight, 1), (half_chord, 1)]);
        Some(if point == unknowns { determinant } else { self.graph.negate(determinant) })
    }

    pub(super) fn link_to_circle(&mut self, row: NodeId, phi: SymbolId) -> Option<NodeId> {
        let distance = Distance::of(self.graph, row, &[phi])?;
        self.reach_to(&[distance.bound]);
        let (v, rest) = self.parted(distance.vector, phi);
        let d = self.negated(rest);
        let d = self.line(d);
        let at_zero = self.at_zero(v, &[phi]);
        let p = length(self.graph, at_zero);
        let scale = self.scale_of_rest(phi)?;
        let (half_chord, solved) = self.triangle(d, [p, distance.length], scale, 1);
        let square = square_of(self.graph, p);
        let v = self.link(phi, solved);
        self.direction_of_link(phi, v, at_zero, square);
        self.assembly.of_dyads.insert(phi, self.group);
        // (V - D) . i V = D x V
        Some(self.graph.multiply(distance.weight, half_chord))
    }

    pub(super) fn slider_to_circle(&mut self, row: NodeId, s: SymbolId) -> Option<NodeId> {
        let distance = Distance::of(self.graph, row, &[s])?;
        self.reach_to(&[distance.bound]);
        let slope = self.graph.partial(&distance.vector, s);
        let line = [slope[0], slope[1]];
        let rest = self.at_zero(distance.vector, &[s]);
        let d = self.negated(rest);
        let scales = [self.scale(&[distance.length]), self.scale_of_rest(s)?];
        let guide = self.guide(d, line, distance.length, scales);
        let g = &mut *self.graph;
        let forward = dot(g, d, line);
        let rest = g.add(forward, guide.along);
        let value = g.divide(rest, guide.square);
        self.name(s, value);
        // (s E - D) . E = g
        Some(self.graph.multiply(distance.weight, guide.along))
    }

    /// The scale of the terms without an unknown of the vector whose length the equation gives.
    fn scale_of_rest(&mut self, unknown: SymbolId) -> Option<NodeId> {
        let rows = structure::mirror(self.graph, &self.equations.clone(), self.mirrored);
        let vector = Distance::of(self.graph, rows[0], &[unknown])?.vector;
        let mut rest: Vector = vector;
        for part in &mut rest {
            let all = self.graph.terms(*part);
            let free: Vec<(Number, NodeId)> =
                all.into_iter().filter(|(_, term)| !self.graph.symbols_of(&[*term]).contains(&unknown)).collect();
            *part = self.graph.sum(&free);
        }
        Some(self.scale(&rest))
    }
}
