//! The kind of a group: which Assur group it is.
//!
//! A loop equation of two rows is a complex equation x + i y = 0. Let V be the sum of its terms that contain an
//! unknown. The unknown is
//! - an angle phi of a revolute joint if it rotates V: dV/dphi = i V; a mirrored angle if dV/dphi = -i V, which is an
//!   angle after -phi is put for phi
//! - a length s of a sliding joint if it moves V along a line: the direction D = dV/ds does not depend on s
//!
//! With two unknowns these are the four cases of M. A. Chace, "Vector analysis of linkages", Journal of
//! Engineering for Industry 85, 1963: two angles, an angle and a length, an angle and a length along a line that it
//! rotates, two lengths.

use rustc_hash::FxHashMap;

use super::distance::Distance;
use super::loops::Loops;
use super::obstacle::Obstacle;
use crate::graph::{Graph, Node, NodeId, Number, SymbolId};

/// The kind of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum GroupKind {
    /// Two angles: two links between three revolute joints.
    Rrr,
    /// An angle, and a length along a line that does not turn with it: a link and a slider on a guide.
    Rrp,
    /// An angle, and a length along a line that turns with it: a slider on a turning guide.
    Rpr,
    /// Two lengths along given lines: two sliders.
    Sliders,
    /// The two coordinates of a point at given distances from two others.
    Circles,
    /// An angle of a link whose end is at a given distance from a point.
    LinkToCircle,
    /// A length along a line, to a given distance from a point.
    SliderToCircle,
    /// One unknown that enters linearly: gears, belts, a slider whose link is known.
    Linear,
    /// One angle phi in a cos(phi) + b sin(phi) + c = 0: a link whose end is known in one direction.
    Angle,
    /// One unknown in any other way.
    Scalar,
    /// Two unknowns in any other way.
    Pair,
    /// The angles and lengths of the links of two or three loops: see [`Loops`].
    Loops(usize),
    /// More than two unknowns that depend on one another in any other way.
    Irreducible(usize, Obstacle),
}

impl GroupKind {
    /// A description for documentation.
    #[must_use]
    pub fn description(self) -> String {
        match self {
            Self::Rrr => "dyad RRR: two angles".to_owned(),
            Self::Rrp => "dyad RRP: an angle, and a length along a given line".to_owned(),
            Self::Rpr => "dyad RPR: an angle, and a length along a line that turns with it".to_owned(),
            Self::Sliders => "dyad PRP or RPP: two lengths along given lines".to_owned(),
            Self::Circles => "dyad RRR: a point at two distances".to_owned(),
            Self::LinkToCircle => "dyad RRR: an angle and a distance".to_owned(),
            Self::SliderToCircle => "dyad RRP: a length along a given line and a distance".to_owned(),
            Self::Linear => "one unknown, linear".to_owned(),
            Self::Angle => "one angle".to_owned(),
            Self::Scalar => "one unknown".to_owned(),
            Self::Pair => "two unknowns".to_owned(),
            Self::Loops(2) => "two loops of links: up to 6 positions".to_owned(),
            Self::Loops(_) => "three loops of links: up to 20 positions".to_owned(),
            Self::Irreducible(count, _) => format!("irreducible group of {count} unknowns"),
        }
    }

    /// The reason why its positions can only be found near a guess; `None` if it has a closed form, or a list of all.
    #[must_use]
    pub fn obstacle(self) -> Option<String> {
        match self {
            Self::Scalar => Some("its equation is neither linear nor a cos + b sin = c nor a distance".to_owned()),
            Self::Pair => Some("its two equations are not those of a dyad".to_owned()),
            Self::Irreducible(count, obstacle) => {
                Some(format!("its {count} unknowns depend on one another, and {}", obstacle.text()))
            }
            _ => None,
        }
    }

    /// True if its position has a closed form.
    #[must_use]
    pub fn is_closed(self) -> bool {
        !matches!(self, Self::Loops(_) | Self::Scalar | Self::Pair | Self::Irreducible(..))
    }

    /// The most positions at given inputs, of a group of which all are listed by number.
    #[must_use]
    pub fn most_modes(self) -> Option<usize> {
        match self {
            Self::Loops(2) => Some(6),
            Self::Loops(_) => Some(20),
            _ => None,
        }
    }
}

/// The kind of a group, and its mirrored angles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Class {
    pub kind: GroupKind,
    pub mirrored: Vec<SymbolId>,
}

impl Class {
    /// Classifies the group of these scalar equations and unknowns.
    pub fn of(graph: &mut Graph, rows: &[NodeId], unknowns: &[SymbolId]) -> Self {
        match (rows, unknowns) {
            (&[row], &[unknown]) => Self::of_one(graph, row, unknown),
            (&[x, y], &[a, b]) => Self::of_pair(graph, [x, y], a, b),
            _ => Self::plain(match Loops::of(graph, rows, unknowns) {
                Ok(loops) => GroupKind::Loops(loops.constants.len()),
                Err(obstacle) => GroupKind::Irreducible(unknowns.len(), obstacle),
            }),
        }
    }

    fn plain(kind: GroupKind) -> Self {
        Self { kind, mirrored: Vec::new() }
    }

    fn of_one(graph: &mut Graph, row: NodeId, unknown: SymbolId) -> Self {
        let kind = scalar(graph, row, unknown);
        if kind.is_closed() {
            return Self::plain(kind);
        }
        for mirrored in [&[][..], &[unknown]] {
            let seen = mirror(graph, &[row], mirrored)[0];
            if let Some(kind) = to_circle(graph, seen, unknown) {
                return Self { kind, mirrored: mirrored.to_vec() };
            }
        }
        Self::plain(kind)
    }

    fn of_pair(graph: &mut Graph, rows: [NodeId; 2], a: SymbolId, b: SymbolId) -> Self {
        for mirrored in [&[][..], &[a], &[b], &[a, b]] {
            let seen = mirror(graph, &rows, mirrored);
            let kind = pair(graph, [seen[0], seen[1]], a, b);
            if kind.is_closed() {
                return Self { kind, mirrored: mirrored.to_vec() };
            }
        }
        Self::plain(GroupKind::Pair)
    }
}

/// The expressions with the negatives of some unknowns in place of these.
pub fn mirror(graph: &mut Graph, rows: &[NodeId], unknowns: &[SymbolId]) -> Vec<NodeId> {
    let mut by = FxHashMap::default();
    for &unknown in unknowns {
        let variable = graph.variable(unknown);
        by.insert(variable, graph.negate(variable));
    }
    graph.replace(rows, &by)
}

fn scalar(graph: &mut Graph, row: NodeId, unknown: SymbolId) -> GroupKind {
    let slope = graph.partial(&[row], unknown)[0];
    if !graph.depends_on(slope, unknown) {
        return GroupKind::Linear;
    }
    // d^2 V / dphi^2 = -V
    let part = terms_with(graph, row, unknown);
    let curvature = graph.partial(&[slope], unknown)[0];
    let sum = graph.add(curvature, part);
    if graph.is_zero(sum) { GroupKind::Angle } else { GroupKind::Scalar }
}

/// The kind of a group of one unknown whose row gives the length of a vector.
fn to_circle(graph: &mut Graph, row: NodeId, unknown: SymbolId) -> Option<GroupKind> {
    let vector = Distance::of(graph, row, &[unknown])?.vector;
    let line = direction(graph, vector, unknown);
    if line.is_some() {
        Some(GroupKind::SliderToCircle)
    } else {
        is_angle(graph, vector, unknown).then_some(GroupKind::LinkToCircle)
    }
}

/// Two circles on which the point (x, y) lies.
pub struct Circles {
    /// x and y.
    pub point: [SymbolId; 2],
    /// The distances from the centres.
    pub distances: [Distance; 2],
    pub centres: [[NodeId; 2]; 2],
}

impl Circles {
    /// The circles of two rows; `None` if a row has another form. The first of two unknowns is x, unless a row has
    /// them in another order.
    pub fn of(graph: &mut Graph, rows: [NodeId; 2], unknowns: [SymbolId; 2]) -> Option<Self> {
        let [one, other] = rows.map(|row| Distance::of(graph, row, &unknowns));
        let distances = [one?, other?];
        let [x, y] = unknowns;
        let is_turned = |distance: &Distance| distance.is_ordered && !graph.depends_on(distance.vector[0], x);
        let point = if distances.iter().any(is_turned) { [y, x] } else { [x, y] };
        let centres = distances.each_ref().map(|distance| centre(graph, distance, point));
        let [first, second] = centres;
        Some(Self { point, distances, centres: [first?, second?] })
    }
}

/// The vector c of V = (x, y) - c, but for the order of the components of V and their signs.
fn centre(graph: &mut Graph, distance: &Distance, point: [SymbolId; 2]) -> Option<[NodeId; 2]> {
    let [first, second] = distance.vector;
    let vector = if graph.depends_on(first, point[0]) { [first, second] } else { [second, first] };
    let mut centre = vector;
    for axis in [0, 1] {
        let variable = graph.variable(point[axis]);
        centre[axis] = [Number::ONE, Number::MINUS_ONE].into_iter().find_map(|sign| {
            let signed = graph.scale(sign, vector[axis]);
            let centre = graph.subtract(variable, signed);
            let is_free = point.iter().all(|&unknown| !graph.depends_on(centre, unknown));
            is_free.then_some(centre)
        })?;
    }
    Some(centre)
}

fn pair(graph: &mut Graph, rows: [NodeId; 2], a: SymbolId, b: SymbolId) -> GroupKind {
    if two_links(graph, rows, a, b) || two_links(graph, rows, b, a) {
        return GroupKind::Rrr;
    }
    if Circles::of(graph, rows, [a, b]).is_some() {
        return GroupKind::Circles;
    }
    let [angle_a, angle_b] = [a, b].map(|unknown| is_angle(graph, rows, unknown));
    let [line_a, line_b] = [a, b].map(|unknown| direction(graph, rows, unknown));
    match (angle_a, angle_b, line_a, line_b) {
        (true, _, _, Some(line)) => slider(graph, line, a),
        (_, true, Some(line), _) => slider(graph, line, b),
        (_, _, Some(first), Some(second))
            if first.iter().all(|&part| !graph.depends_on(part, b))
                && second.iter().all(|&part| !graph.depends_on(part, a)) =>
        {
            GroupKind::Sliders
        }
        _ => GroupKind::Pair,
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

/// The kind of a group of an angle and a length along a line: RRP if the line does not depend on the angle, RPR if it
/// turns with the angle.
fn slider(graph: &mut Graph, line: [NodeId; 2], angle: SymbolId) -> GroupKind {
    if line.iter().all(|&part| !graph.depends_on(part, angle)) {
        GroupKind::Rrp
    } else if is_angle(graph, line, angle) && line.iter().all(|&part| terms_with(graph, part, angle) == part) {
        GroupKind::Rpr
    } else {
        GroupKind::Pair
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
    let is_constant = derivatives.iter().all(|&part| !graph.depends_on(part, unknown));
    is_constant.then(|| [derivatives[0], derivatives[1]])
}

/// The terms of a sum that depend on a symbol.
fn terms_with(graph: &mut Graph, row: NodeId, symbol: SymbolId) -> NodeId {
    let terms: Vec<_> = terms(graph, row).into_iter().filter(|&(_, term)| graph.depends_on(term, symbol)).collect();
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

        /// The kind of the group of a loop of vectors r@(phi - offset) and the ground d@0.
        fn kind(&mut self, vectors: &[(&str, &str, &str)], unknowns: [&str; 2]) -> GroupKind {
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
            Class::of(&mut self.graph, &rows, &unknowns).kind
        }
    }

    #[test]
    fn the_four_cases_of_chace() {
        for (vectors, unknowns, kind) in [
            (&[("l", "phi", ""), ("r", "psi", "")][..], ["phi", "psi"], GroupKind::Rrr),
            (&[("l", "phi", "delta"), ("r", "psi", ""), ("r", "phi", "")], ["phi", "psi"], GroupKind::Rrr),
            (&[("l", "phi", ""), ("s", "delta", "")], ["phi", "s"], GroupKind::Rrp),
            (&[("s", "delta", ""), ("l", "phi", "")], ["s", "phi"], GroupKind::Rrp),
            (&[("s", "phi", "delta"), ("l", "phi", "")], ["phi", "s"], GroupKind::Rpr),
            // A guide that turns with phi only in part.
            (&[("s", "phi", ""), ("s", "delta", ""), ("l", "phi", "")], ["phi", "s"], GroupKind::Pair),
            (&[("s", "delta", ""), ("t", "psi", "")], ["s", "t"], GroupKind::Sliders),
            // An angle measured from the other link.
            (&[("l", "phi", "psi"), ("r", "psi", "")], ["phi", "psi"], GroupKind::Rrr),
            (&[("l", "phi", "psi"), ("r", "psi", ""), ("r", "phi", "")], ["phi", "psi"], GroupKind::Pair),
        ] {
            assert_eq!(Plane::new().kind(vectors, unknowns), kind, "{vectors:?}");
        }
    }

    /// V = l@(phi - delta) + r@psi + s@chi with angles in either sense.
    #[test]
    fn mirrored_angles() {
        for (signs, mirrored) in
            [([1, 1], &[][..]), ([-1, 1], &["phi"]), ([1, -1], &["psi"]), ([-1, -1], &["phi", "psi"])]
        {
            let mut plane = Plane::new();
            let [l, r, d, delta] = ["l", "r", "d", "delta"].map(|name| plane.variable(name));
            let angles = ["phi", "psi"].map(|name| plane.variable(name));
            let g = &mut plane.graph;
            let [phi, psi] = [0, 1].map(|index| g.scale(Number::integer(signs[index]), angles[index]));
            let phi = g.subtract(phi, delta);
            let row = |g: &mut Graph, function, ground: NodeId| {
                let [one, other] = [(l, phi), (r, psi)].map(|(length, angle)| {
                    let part = g.call(function, &[angle]);
                    g.multiply(length, part)
                });
                g.sum(&[(Number::ONE, one), (Number::ONE, other), (Number::MINUS_ONE, ground)])
            };
            let zero = g.zero();
            let rows = [row(g, Function::Cos, d), row(g, Function::Sin, zero)];
            let unknowns = ["phi", "psi"].map(|name| plane.symbols[name]);
            let found = Class::of(&mut plane.graph, &rows, &unknowns);
            let mirrored = mirrored.iter().map(|name| plane.symbols[name]).collect();
            assert_eq!(found, Class { kind: GroupKind::Rrr, mirrored });
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
        assert_eq!(Class::of(g, &[row], &[phi_symbol]).kind, GroupKind::Angle);
        assert_eq!(Class::of(g, &[row], &[s_symbol]).kind, GroupKind::Linear);
        let rolled = g.add(row, phi);
        assert_eq!(Class::of(g, &[rolled], &[phi_symbol]).kind, GroupKind::Scalar);
        let (twice, symbol) = (g.scale(Number::integer(2), phi), phi_symbol);
        let double = g.call(Function::Sin, &[twice]);
        assert_eq!(Class::of(g, &[double], &[symbol]).kind, GroupKind::Scalar);
    }
}
