//! Position in closed form, group by group (Chace's cases), without sines of solved angles.
//!
//! The solution of an angle is its direction (cos, sin). The two solutions of a group are the intersections of a circle
//! with a line or another circle: they differ in the sign of a square root, the half chord. It equals the determinant
//! of the group's block of J up to sign, and is accurate because it is not computed from rounded sines. With plane
//! vectors, a . b their scalar and a x b their vector product, V and W the links, D the vector between the outer
//! joints, E the direction of a guide:
//!
//! - RRR: V + W = D, |V| = p, |W| = q. D x V = k, (2 k)^2 = ((p + q)^2 - D^2) (D^2 - (p - q)^2),
//!   V . D = (D^2 + p^2 - q^2) / 2, V x W = -k
//! - RRP: V + s E = D, |V| = p. V x E = D x E = h, V . E = -g, g^2 = (p n - h) (p n + h), n = |E|
//! - RPR: (s E + P) e^(i phi) = D. (s E + P) . E = g, g^2 = (|D| n)^2 - (P x E)^2
//! - an angle: a cos phi + b sin phi = h. b cos phi - a sin phi = g, g^2 = (n - h) (n + h), n = |(a, b)|
//! - two sliders and one linear unknown have one solution.

use std::collections::{BTreeMap, BTreeSet};

use super::assembly::Assembly;
use super::plane::{Vector, cross, dot, length, quotient, square_of, turned, unsigned, with_products};
use super::scale;
use super::step::{ChordGeometry, Step};
use crate::algebra::{cramer, simplify};
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};
use crate::ids::{GroupId, Id};
use crate::structure::GroupKind;

/// The state of the solution of one group.
pub(super) struct Solver<'a> {
    pub(super) graph: &'a mut Graph,
    pub(super) group: GroupId,
    /// The residuals in terms of the unknowns of earlier groups.
    pub(super) equations: Vec<NodeId>,
    pub(super) assembly: &'a mut Assembly,
    /// The angles in place of which the rows of the group contain their negatives.
    pub(super) mirrored: &'a [SymbolId],
    /// The ranges of angles that count turns.
    pub(super) ranges: &'a BTreeMap<SymbolId, [NodeId; 2]>,
}

/// The solution of a link on a guide: g = `along`, h = `across`, n^2 = `square`.
pub(super) struct Guide {
    pub(super) along: NodeId,
    pub(super) across: NodeId,
    pub(super) square: NodeId,
}

impl Solver<'_> {
    pub(super) fn name(&mut self, symbol: SymbolId, node: NodeId) -> NodeId {
        self.assembly.steps.push(Step::Let { symbol, node });
        self.graph.variable(symbol)
    }

    fn fresh(&mut self, name: &str, node: NodeId) -> NodeId {
        let symbol = self.graph.symbol(name);
        self.name(symbol, node)
    }

    /// The expressions with some symbols set to zero.
    pub(super) fn at_zero<const N: usize>(&mut self, nodes: [NodeId; N], symbols: &[SymbolId]) -> [NodeId; N] {
        let zero = self.graph.zero();
        let by = symbols.iter().map(|&symbol| (self.graph.variable(symbol), zero)).collect();
        let replaced = self.graph.replace(&nodes, &by);
        std::array::from_fn(|index| replaced[index])
    }

    /// Splits two rows into the terms with a symbol and the other terms.
    pub(super) fn parted(&mut self, rows: [NodeId; 2], symbol: SymbolId) -> (Vector, Vector) {
        let with = rows.map(|row| {
            let terms = self.graph.terms(row);
            let holding: Vec<_> =
                terms.into_iter().filter(|&(_, term)| self.graph.symbols_of(&[term]).contains(&symbol)).collect();
            self.graph.sum(&holding)
        });
        let rest = [0, 1].map(|row| self.graph.subtract(rows[row], with[row]));
        (with, rest)
    }

    pub(super) fn negated(&mut self, vector: Vector) -> Vector {
        vector.map(|part| self.graph.negate(part))
    }

    /// Names the vector between the outer joints.
    pub(super) fn line(&mut self, [x, y]: Vector) -> Vector {
        let number = self.group.number();
        [("x", x), ("y", y)].map(|(axis, part)| match self.graph.node(part) {
            Node::Sum { .. } | Node::Product { .. } => self.fresh(&format!("line_{number}_{axis}"), part),
            _ => part,
        })
    }

    /// The direction of an angle from that in the rows of the group, or the reverse.
    fn seen(&mut self, angle: SymbolId, [cosine, sine]: Vector) -> Vector {
        [cosine, if self.mirrored.contains(&angle) { self.graph.negate(sine) } else { sine }]
    }

    /// Names a solved direction and the angle itself, which is computed only if it is used.
    fn direction(&mut self, angle: SymbolId, direction: Vector) {
        let direction = self.seen(angle, direction);
        let named = self.named_direction(angle, direction);
        self.solve_angle(angle, named);
    }

    fn named_direction(&mut self, angle: SymbolId, [cosine, sine]: Vector) -> Vector {
        let name = self.graph.symbol_name(angle).to_owned();
        let named =
            [("cos", cosine), ("sin", sine)].map(|(function, part)| self.fresh(&format!("{function}_{name}"), part));
        self.assembly.named_directions.insert(angle, named);
        named
    }

    /// The direction of a solved link from its vector `link`, whose squared length is `square` and which is `at_zero`
    /// where its angle is zero: e^(i angle) = link / `at_zero`.
    ///
    /// A link along its angle keeps the quotient link / length without a name, so that length e^(i angle) in other
    /// formulas cancels to the link.
    pub(super) fn direction_of_link(&mut self, angle: SymbolId, link: Vector, at_zero: Vector, square: NodeId) {
        let direction = quotient(self.graph, link, at_zero, square);
        if at_zero.iter().any(|&part| self.graph.is_zero(part)) {
            let direction = self.seen(angle, direction);
            self.named_direction(angle, direction);
            self.solve_angle(angle, direction);
        } else {
            self.direction(angle, direction);
        }
    }

    fn solve_angle(&mut self, angle: SymbolId, direction: Vector) {
        self.assembly.directions.insert(angle, direction);
        let [cosine, sine] = direction;
        let principal = self.graph.call(Function::Atan2, &[sine, cosine]);
        let range = self.ranges.get(&angle).copied();
        self.assembly.steps.push(Step::Turn { symbol: angle, principal, range });
    }

    /// Names the vector of a link.
    pub(super) fn link(&mut self, angle: SymbolId, [x, y]: Vector) -> Vector {
        let name = self.graph.symbol_name(angle).to_owned();
        [("x", x), ("y", y)].map(|(axis, part)| self.fresh(&format!("link_{name}_{axis}"), part))
    }

    /// The square root of a product of two non-negative factors, with the sign of the branch; see [`Step::Chord`].
    fn chord(&mut self, factors: [NodeId; 2], size: NodeId, of: ChordGeometry<NodeId>) -> NodeId {
        self.assembly.bounds.push((self.group, factors.to_vec()));
        let symbol = self.graph.symbol(format!("chord_{}", self.group.number()));
        self.assembly.steps.push(Step::Chord { group: self.group, symbol, factors, size, of });
        self.graph.variable(symbol)
    }

    /// The sum of the magnitudes of the terms of several expressions.
    pub(super) fn scale(&mut self, nodes: &[NodeId]) -> NodeId {
        let scales: Vec<_> = nodes.iter().map(|&node| (Number::ONE, scale::of(self.graph, node))).collect();
        self.graph.sum(&scales)
    }

    /// The sum of the magnitudes of the terms of the equations without these unknowns.
    fn scale_without(&mut self, unknowns: &[SymbolId]) -> NodeId {
        let mut rest = Vec::new();
        for equation in self.equations.clone() {
            let terms = match self.graph.node(equation).clone() {
                Node::Sum { constant, mut terms } => {
                    terms.push((constant, self.graph.one()));
                    terms
                }
                _ => vec![(Number::ONE, equation)],
            };
            let is_free = |&(_, term): &(Number, NodeId)| {
                let symbols = self.graph.symbols_of(&[term]);
                unknowns.iter().all(|unknown| !symbols.contains(unknown))
            };
            let free: Vec<_> = terms.into_iter().filter(is_free).collect();
            rest.push(self.graph.sum(&free));
        }
        self.scale(&rest)
    }

    /// The geometry of a chord of a circle of radius `radius`, by the scales of the radius and of the offset.
    fn reach(&mut self, radius: NodeId, scales: [NodeId; 2]) -> ChordGeometry<NodeId> {
        let is_sum = |id: NodeId| matches!(self.graph.node(id), Node::Sum { .. });
        let may_cancel = self.graph.reachable(&[radius]).into_iter().any(is_sum);
        ChordGeometry::Circle { scales, may_cancel }
    }

    /// Adds the checks that some numbers are not negative: distances or their squares.
    pub(super) fn reach_to(&mut self, bounds: &[Option<NodeId>]) {
        for &bound in bounds.iter().flatten() {
            self.assembly.steps.push(Step::Reach { group: self.group, length: bound });
            self.assembly.bounds.push((self.group, vec![bound]));
        }
    }

    /// Adds a check that a determinant is not zero, unless it is a constant.
    fn solvable(&mut self, determinant: NodeId, numerators: Vec<NodeId>, scales: Vec<NodeId>) {
        if self.graph.constant_value(determinant).is_none() {
            self.assembly.steps.push(Step::Solvable { group: self.group, determinant, numerators, scales });
        }
    }

    pub(super) fn linear(&mut self, row: NodeId, unknown: SymbolId) -> Option<NodeId> {
        let slope = self.graph.partial(&[row], unknown)[0];
        let [rest] = self.at_zero([row], &[unknown]);
        let minus = self.graph.negate(rest);
        let scale = self.scale_without(&[unknown]);
        self.solvable(slope, vec![minus], vec![scale]);
        let value = self.graph.divide(minus, slope);
        self.name(unknown, value);
        Some(slope)
    }

    /// `is_rising` if the row increases with the angle on the branch of the positive root.
    pub(super) fn angle(&mut self, row: NodeId, phi: SymbolId, is_rising: bool) -> Option<NodeId> {
        let zero = self.graph.zero();
        let ([part, _], [rest, _]) = self.parted([row, zero], phi);
        let slope = self.graph.partial(&[part], phi)[0];
        let [a, b] = self.at_zero([part, slope], &[phi]);
        let h = self.graph.negate(rest);
        let n = length(self.graph, [a, b]);
        let factors = [self.graph.subtract(n, h), self.graph.add(n, h)];
        let square = square_of(self.graph, n);
        let scales = [self.scale(&[a, b]), self.scale_without(&[phi])];
        let of = self.reach(n, scales);
        let chord = self.chord(factors, n, of);
        let g = if is_rising { chord } else { self.graph.negate(chord) };
        // (cos, sin) . (a, b) = h and (cos, sin) x (a, b) = g
        let direction = with_products(self.graph, [a, b], square, h, g);
        if self.graph.is_zero(a) || self.graph.is_zero(b) {
            self.named_direction(phi, direction);
            self.solve_angle(phi, direction);
        } else {
            self.direction(phi, direction);
        }
        Some(g)
    }

    pub(super) fn sliders(&mut self, rows: [NodeId; 2], s: SymbolId, t: SymbolId) -> Option<NodeId> {
        let (along, other) = (self.graph.partial(&rows, s), self.graph.partial(&rows, t));
        let rest = self.at_zero(rows, &[s, t]);
        let right = self.negated(rest);
        let jacobian = [[along[0], other[0]], [along[1], other[1]]];
        let whole = crate::algebra::determinant(self.graph, jacobian);
        let [along_s, along_t] = [&along, &other].map(|guide| [guide[0], guide[1]]);
        let numerators = [(right, along_t), (along_s, right)]
            .map(|(one, two)| crate::algebra::determinant(self.graph, [[one[0], two[0]], [one[1], two[1]]]));
        let of_right = self.scale_without(&[s, t]);
        let scales = [&other, &along].map(|guide| {
            let scale = self.scale(guide);
            self.graph.multiply(of_right, scale)
        });
        self.solvable(whole, numerators.to_vec(), scales.to_vec());
        let [first, second] = cramer(self.graph, jacobian, whole, right);
        self.name(s, first);
        self.name(t, second);
        Some(whole)
    }

    /// True if the terms without `a` rotate with `b`, and those with `a` rotate with `a`: two links.
    pub(super) fn is_link(&mut self, rows: &[NodeId; 2], a: SymbolId, b: SymbolId) -> bool {
        let (link, rest) = self.parted(*rows, a);
        let ([x, y], _) = self.parted(rest, b);
        let minus = self.graph.negate(y);
        let [link_x, link_y] = link;
        let minus_link = self.graph.negate(link_y);
        self.graph.partial(&[x, y], b) == [minus, x]
            && self.graph.partial(&link, a) == [minus_link, link_x]
            && !(self.graph.is_zero(x) && self.graph.is_zero(y))
    }

    /// Solves an RRR dyad. `left` is the sign of D x V if the elbow is left of the line from the first to the second
    /// outer joint.
    pub(super) fn two_links(&mut self, rows: [NodeId; 2], a: SymbolId, b: SymbolId, left: i64) -> Option<NodeId> {
        let (v, rest) = self.parted(rows, a);
        let (w, rest) = self.parted(rest, b);
        let d = self.negated(rest);
        let d = self.line(d);
        // V rotates with a + k b.
        let slope = self.graph.partial(&v, b);
        let k = (-2..=2).find(|&k| {
            slope == [self.graph.scale(Number::integer(-k), v[1]), self.graph.scale(Number::integer(k), v[0])]
        })?;
        let (at_v, at_w) = (self.at_zero(v, &[a, b]), self.at_zero(w, &[b]));
        let [p, q] = [at_v, at_w].map(|at_zero| length(self.graph, at_zero));
        let scale = self.scale_without(&[a, b]);
        let (half_chord, solved) = self.triangle(d, [p, q], scale, left);
        let cross_product = self.graph.negate(half_chord);
        let (p2, q2) = (square_of(self.graph, p), square_of(self.graph, q));
        let v = self.link(a, solved);
        let g = &mut *self.graph;
        let rest = [g.subtract(d[0], v[0]), g.subtract(d[1], v[1])];
        let w = self.link(b, rest);
        self.direction_of_link(b, w, at_w, q2);
        if k == 0 {
            self.direction_of_link(a, v, at_v, p2);
        } else {
            let [cosine, sine] = self.seen(b, self.assembly.directions[&b]);
            let mut first = quotient(self.graph, v, at_v, p2);
            for _ in 0..k.abs() {
                let back = if k > 0 { self.graph.negate(sine) } else { sine };
                first = turned(self.graph, first, [cosine, back]);
            }
            self.direction(a, first);
        }
        self.assembly.of_dyads.extend([(a, self.group), (b, self.group)]);
        Some(cross_product)
    }

    /// Solves for the end of a link of length p on a guide of direction E = `line`, where the link and s E make D = `d`,
    /// by the scales of p and of D.
    pub(super) fn guide(&mut self, d: Vector, line: Vector, p: NodeId, scales: [NodeId; 2]) -> Guide {
        let n = length(self.graph, line);
        let across = cross(self.graph, d, line);
        let across = self.fresh(&format!("offset_{}", self.group.number()), across);
        let g = &mut *self.graph;
        let reach = g.multiply(p, n);
        let factors = [g.subtract(reach, across), g.add(reach, across)];
        let of_line = self.scale(&line);
        let scales = scales.map(|scale| self.graph.multiply(scale, of_line));
        let of = self.reach(reach, scales);
        let along = self.chord(factors, reach, of);
        Guide { along, across, square: square_of(self.graph, n) }
    }

    /// Solves the triangle of two links of lengths p and q whose outer joints are D apart, D = `d`: D x V, and the first
    /// link V. `left` is the sign of D x V on the left.
    pub(super) fn triangle(&mut self, d: Vector, lengths: [NodeId; 2], scale: NodeId, left: i64) -> (NodeId, Vector) {
        // The product of the factors of the chord does not depend on the signs of p and q.
        let [p, q] = lengths.map(|length| unsigned(self.graph, length));
        let g = &mut *self.graph;
        let distance_squared = dot(g, d, d);
        let distance_squared = self.fresh(&format!("distance_squared_{}", self.group.number()), distance_squared);
        let g = &mut *self.graph;
        let (sum, difference) = (g.add(p, q), g.subtract(p, q));
        let squares = g.multiply(sum, difference);
        let (sum, difference) = (g.power(sum, 2), g.power(difference, 2));
        let factors = [g.subtract(sum, distance_squared), g.subtract(distance_squared, difference)];
        let triangle = ChordGeometry::Triangle { links: [p, q], line: d, distance_squared, scale };
        let twice = self.chord(factors, sum, triangle);
        let g = &mut *self.graph;
        let half_chord = g.scale(Number::ratio(left.into(), 2), twice);
        // Both products and the divisor are doubled, which saves two factors of 1/2.
        let along = g.add(distance_squared, squares);
        let across = g.scale(Number::integer(-left), twice);
        let divisor = g.scale(Number::integer(2), distance_squared);
        // The line is divided, and not the link, so that little is left to do when the root of the chord is there.
        let [x, y] = d.map(|part| g.divide(part, divisor));
        let number = self.group.number();
        let divided = [("x", x), ("y", y)].map(|(axis, part)| match self.graph.node(part) {
            Node::Product { .. } => self.fresh(&format!("divided_line_{number}_{axis}"), part),
            _ => part,
        });
        let one = self.graph.one();
        (half_chord, with_products(self.graph, divided, one, along, across))
    }

    pub(super) fn slider(&mut self, rows: [NodeId; 2], phi: SymbolId, s: SymbolId, group: GroupKind) -> Option<NodeId> {
        let slope = self.graph.partial(&rows, s);
        let line = [slope[0], slope[1]];
        if group == GroupKind::Rrp {
            let (v, rest) = self.parted(rows, phi);
            let rest = self.at_zero(rest, &[s]);
            let d = self.negated(rest);
            let at_zero = self.at_zero(v, &[phi]);
            let p = length(self.graph, at_zero);
            let scales = [self.scale(&at_zero), self.scale_without(&[phi, s])];
            let Guide { along, across, square } = self.guide(d, line, p, scales);
            let g = &mut *self.graph;
            let minus = g.negate(along);
            let solved = with_products(g, line, square, minus, across);
            let forward = dot(g, d, line);
            let rest = g.add(forward, along);
            let value = g.divide(rest, square);
            let p2 = square_of(g, p);
            self.name(s, value);
            let v = self.link(phi, solved);
            self.direction_of_link(phi, v, at_zero, p2);
            return Some(along);
        }
        let (turning, rest) = self.parted(rows, phi);
        let d = self.negated(rest);
        let d = self.line(d);
        let e = self.at_zero(line, &[phi]);
        let p = self.at_zero(turning, &[phi, s]);
        let n = length(self.graph, e);
        let g = &mut *self.graph;
        let square = square_of(g, n);
        let distance_squared = dot(g, d, d);
        let distance_squared = self.fresh(&format!("distance_squared_{}", self.group.number()), distance_squared);
        let g = &mut *self.graph;
        let across = cross(g, p, e);
        let across = simplify(g, &[across], &BTreeSet::new())[0];
        let reach = g.call(Function::Sqrt, &[distance_squared]);
        let reach = g.multiply(reach, n);
        let factors = [g.subtract(reach, across), g.add(reach, across)];
        let (of_line, of_arm, of_rest) = (self.scale(&e), self.scale(&p), self.scale_without(&[phi, s]));
        let scales = [of_rest, of_arm].map(|scale| self.graph.multiply(scale, of_line));
        // The squared distance is a named sum, so that it may vanish by cancellation.
        let along = self.chord(factors, reach, ChordGeometry::Circle { scales, may_cancel: true });
        // The reach is a square root; the bound uses its square.
        let g = &mut *self.graph;
        let (whole, part) = (g.multiply(distance_squared, square), g.power(across, 2));
        let bound = g.subtract(whole, part);
        self.assembly.bounds.pop();
        self.assembly.bounds.push((self.group, vec![bound]));
        let g = &mut *self.graph;
        let offset = dot(g, p, e);
        let offset = simplify(g, &[offset], &BTreeSet::new())[0];
        let forward = g.subtract(along, offset);
        let value = g.divide(forward, square);
        let value = self.name(s, value);
        let g = &mut *self.graph;
        let arm = [0, 1].map(|axis| {
            let part = g.multiply(value, e[axis]);
            g.add(part, p[axis])
        });
        let direction = quotient(g, d, arm, distance_squared);
        self.direction(phi, direction);
        Some(self.graph.negate(along))
    }
}
