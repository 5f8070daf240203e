//! The parts of a drawing, guessed from the vectors of loops and points: bars, sliders, pivots on the ground.

use std::collections::BTreeSet;

use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::model::{Chain, Driver, Joints, Link, Mechanism};

/// The joints and the parts of a drawing.
#[derive(Debug, Clone, Default)]
pub struct Skeleton {
    /// The name and the position of each joint.
    pub joints: Vec<(String, [NodeId; 2])>,
    pub parts: Vec<Part>,
    /// The direction of the vector of each slider and sleeve, in the order of the parts.
    pub guides: Vec<[NodeId; 2]>,
}

/// A part of a drawing, by indices of joints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Part {
    /// A pivot on the ground.
    Ground(usize),
    /// A rigid link through joints; `is_driven` if it turns with an input about a pivot on the ground.
    Bar { joints: Vec<usize>, is_driven: bool },
    /// A block on a fixed guide.
    Slider(usize),
    /// A block at `pin` that slides on an arm through `on`, towards `towards` if a joint is fixed there.
    Sleeve { pin: usize, on: usize, towards: Option<usize> },
    /// The path of a point.
    Trace(usize),
}

/// A vector between two joints.
#[derive(Clone, Copy)]
struct Edge {
    ends: [usize; 2],
    link: Link,
}

/// Joints that turn as one body, with the angles of its vectors.
struct Body {
    angles: Vec<NodeId>,
    joints: BTreeSet<usize>,
}

impl Body {
    fn meets(&self, other: &Self) -> bool {
        !self.joints.is_disjoint(&other.joints)
    }
}

/// Makes one body of three that meet in three joints, a rigid triangle, until there are no more.
fn join_triangles(mut bodies: Vec<Body>) -> Vec<Body> {
    while let Some([first, second, third]) = triangle(&bodies) {
        // From the last, so that the others keep their places.
        for at in [third, second] {
            let Body { angles, joints } = bodies.remove(at);
            bodies[first].angles.extend(angles);
            bodies[first].joints.extend(joints);
        }
    }
    bodies
}

/// The places of three bodies that meet in three joints, in order.
fn triangle(bodies: &[Body]) -> Option<[usize; 3]> {
    let later = |at: usize| bodies.iter().enumerate().skip(at + 1);
    for (first, one) in bodies.iter().enumerate() {
        for (second, other) in later(first).filter(|(_, other)| one.meets(other)) {
            let is_third = |third: &Body| {
                let corners = [(one, other), (other, third), (third, one)];
                let shared = corners.map(|(a, b)| a.joints.intersection(&b.joints).copied().collect::<BTreeSet<_>>());
                let all: BTreeSet<usize> = shared.iter().flatten().copied().collect();
                shared.iter().all(|joints| !joints.is_empty()) && all.len() > 2
            };
            if let Some((third, _)) = later(second).find(|(_, third)| is_third(third)) {
                return Some([first, second, third]);
            }
        }
    }
    None
}

impl Skeleton {
    pub(super) fn of(mechanism: &Mechanism, driver: &Driver, graph: &mut Graph) -> Self {
        let symbols = |ids: &mut dyn Iterator<Item = crate::ids::CoordinateId>| -> BTreeSet<SymbolId> {
            ids.map(|id| mechanism.coordinates[id].symbol).collect()
        };
        let moving = symbols(&mut mechanism.coordinates.ids());
        let driving = symbols(&mut driver.inputs.iter().copied());
        let mut tracer = Tracer { mechanism, graph, moving, joints: Joints::default(), edges: Vec::new() };
        for [left, right] in &mechanism.loops {
            if !left.links.is_empty() || !right.links.is_empty() {
                let [one, other] = [left, right].map(|side| tracer.trace(side));
                tracer.joints.merge(one, other);
            }
        }
        for point in &mechanism.points {
            tracer.trace(&point.chain);
        }
        tracer.merge();
        tracer.finish(&driving)
    }
}

struct Tracer<'a> {
    mechanism: &'a Mechanism,
    graph: &'a mut Graph,
    /// The symbols of the coordinates.
    moving: BTreeSet<SymbolId>,
    joints: Joints,
    edges: Vec<Edge>,
}

impl Tracer<'_> {
    /// Adds the joints and vectors of a chain; returns its last joint.
    fn trace(&mut self, chain: &Chain) -> usize {
        let zero = self.graph.zero();
        let mut last = self.joints.add(chain.start.unwrap_or([zero; 2]));
        for &link in &chain.links {
            let sign = if link.is_reversed { Number::MINUS_ONE } else { Number::ONE };
            let from = self.joints.position(last);
            let to = [0, 1].map(|axis| self.graph.sum(&[(Number::ONE, from[axis]), (sign, link.vector[axis])]));
            let next = self.joints.add(to);
            self.edges.push(Edge { ends: [last, next], link });
            last = next;
        }
        last
    }

    /// Merges joints that the vectors show to be one: a position at the end of a vector from any formula of its start, such
    /// as `D - l4@theta4` and the joint C of the loop `B + l3@theta3 = C`, `C + l4@theta4 = D`.
    fn merge(&mut self) {
        let mut is_changed = true;
        while is_changed {
            is_changed = false;
            for edge in 0..self.edges.len() {
                let Edge { ends: [from, to], link } = self.edges[edge];
                let sign = if link.is_reversed { Number::MINUS_ONE } else { Number::ONE };
                let backwards = if link.is_reversed { Number::ONE } else { Number::MINUS_ONE };
                for (start, end, sign) in [(from, to, sign), (to, from, backwards)] {
                    let formulas: Vec<[NodeId; 2]> = self.joints.formulas(self.joints.find(start)).collect();
                    for at in formulas {
                        let moved =
                            [0, 1].map(|axis| self.graph.sum(&[(Number::ONE, at[axis]), (sign, link.vector[axis])]));
                        if let Some(known) = self.joints.known(moved)
                            && known != self.joints.find(end)
                        {
                            self.joints.merge(known, end);
                            is_changed = true;
                        }
                    }
                }
            }
        }
    }

    fn moves(&self, nodes: &[NodeId]) -> bool {
        self.graph.symbols_of(nodes).iter().any(|symbol| self.moving.contains(symbol))
    }

    /// The bodies of the links whose length is constant.
    fn bodies(&mut self) -> Vec<Body> {
        let mut bodies: Vec<Body> = Vec::new();
        for edge in std::mem::take(&mut self.edges) {
            let Some(angle) = edge.link.angle.filter(|&angle| self.moves(&[angle]) && !self.changes(&edge.link)) else {
                self.edges.push(edge);
                continue;
            };
            let ends = edge.ends.map(|end| self.joints.find(end));
            let mut body = Body { angles: vec![angle], joints: BTreeSet::from(ends) };
            let mut rest = Vec::new();
            for other in bodies {
                let is_rigid = self.is_constant_apart(angle, other.angles[0]);
                match is_rigid && !other.joints.is_disjoint(&body.joints) {
                    true => body.joints.extend(other.joints),
                    false => rest.push(other),
                }
            }
            rest.push(body);
            bodies = rest;
        }
        join_triangles(bodies)
    }

    /// True if the length of a link depends on a coordinate.
    fn changes(&mut self, link: &Link) -> bool {
        match (link.length, link.angle) {
            (Some(length), _) => self.moves(&[length]),
            (None, Some(angle)) => {
                // (x, y)@angle: the parts of the vector without the angle.
                let turning = self.graph.symbols_of(&[angle]);
                let symbols = self.graph.symbols_of(&link.vector);
                symbols.iter().any(|symbol| self.moving.contains(symbol) && !turning.contains(symbol))
            }
            (None, None) => self.moves(&link.vector),
        }
    }

    /// The derivative of a vector of variable length by the coordinate that is its length, up to a factor.
    fn direction(&mut self, link: &Link) -> [NodeId; 2] {
        let turning = link.angle.map_or_else(Vec::new, |angle| self.graph.symbols_of(&[angle]));
        let symbols = self.graph.symbols_of(&link.vector);
        let mut lengths =
            symbols.into_iter().filter(|symbol| self.moving.contains(symbol) && !turning.contains(symbol));
        match lengths.next() {
            Some(length) => link.vector.map(|part| self.graph.partial(&[part], length)[0]),
            None => link.vector,
        }
    }

    fn is_constant_apart(&mut self, one: NodeId, other: NodeId) -> bool {
        let difference = self.graph.subtract(one, other);
        !self.moves(&[difference])
    }

    fn finish(mut self, driving: &BTreeSet<SymbolId>) -> Skeleton {
        let bodies = self.bodies();
        let is_fixed: Vec<bool> = (0..self.joints.len())
            .map(|joint| self.joints.formulas(joint).any(|formula| !self.moves(&formula)))
            .collect();
        let (mut parts, mut guides) = (Vec::new(), Vec::new());
        let mut pivots: BTreeSet<usize> = BTreeSet::new();
        for body in &bodies {
            let fixed = body.joints.iter().copied().find(|&joint| is_fixed[joint]);
            let is_input = self.graph.symbols_of(&body.angles).iter().any(|symbol| driving.contains(symbol));
            pivots.extend(fixed);
            let first = fixed.into_iter();
            let joints = first.chain(body.joints.iter().copied().filter(|&joint| Some(joint) != fixed)).collect();
            parts.push(Part::Bar { joints, is_driven: is_input && fixed.is_some() });
        }
        for edge in std::mem::take(&mut self.edges) {
            let [from, to] = edge.ends.map(|end| self.joints.find(end));
            if !self.changes(&edge.link) {
                continue;
            }
            match edge.link.angle.filter(|&angle| self.moves(&[angle])) {
                Some(angle) => {
                    let arm = bodies.iter().find(|body| {
                        let mut angles = body.angles.iter();
                        body.joints.contains(&from) && angles.any(|&other| self.is_constant_apart(angle, other))
                    });
                    let towards = arm.and_then(|arm| arm.joints.iter().copied().find(|&joint| joint != from));
                    pivots.extend(is_fixed[from].then_some(from));
                    // A loop and a point may have one vector.
                    let sleeve = Part::Sleeve { pin: to, on: from, towards };
                    if !parts.contains(&sleeve) {
                        parts.push(sleeve);
                        guides.push(self.direction(&edge.link));
                    }
                }
                None => {
                    let along = edge.link.vector.map(|part| self.moves(&[part]));
                    let block = [(from, to), (to, from)].into_iter().find(|(end, _)| is_fixed[*end]);
                    // A vector of two unknown components is no guide.
                    let is_free = edge.link.angle.is_none() && along == [true, true];
                    if let Some((_, block)) = block.filter(|(_, block)| !is_free && !is_fixed[*block])
                        && !parts.contains(&Part::Slider(block))
                    {
                        parts.push(Part::Slider(block));
                        guides.push(self.direction(&edge.link));
                    }
                }
            }
        }
        // A declared point that moves and is no joint leaves its path: the end of a link, or a point of one.
        for point in &self.mechanism.points {
            let Some(joint) = self.joints.known([point.x, point.y]) else { continue };
            let holding = bodies.iter().filter(|body| body.joints.contains(&joint)).count();
            let slides = parts.iter().any(|part| match *part {
                Part::Slider(block) => block == joint,
                Part::Sleeve { pin, .. } => pin == joint,
                _ => false,
            });
            if holding == 1 && !is_fixed[joint] && !slides && !parts.contains(&Part::Trace(joint)) {
                parts.push(Part::Trace(joint));
            }
        }
        let grounds = pivots.into_iter().map(Part::Ground);
        parts.splice(0..0, grounds);
        let joints = self.named();
        Skeleton { joints, parts, guides }.compact()
    }

    /// The name of each joint: that of a point there, `O` for the origin, or else a number.
    fn named(&mut self) -> Vec<(String, [NodeId; 2])> {
        let points = &self.mechanism.points;
        let mut taken: BTreeSet<&str> = points.iter().map(|point| point.name.text.as_str()).collect();
        let zero = [self.graph.zero(); 2];
        let mut numbers = (1..).map(|number: usize| number.to_string());
        let mut named = Vec::new();
        for joint in 0..self.joints.len() {
            let here: Vec<[NodeId; 2]> = self.joints.formulas(self.joints.find(joint)).collect();
            let point = points.iter().find(|point| here.contains(&[point.x, point.y]));
            let name = match point {
                Some(point) => point.name.text.clone(),
                None if here.contains(&zero) && taken.insert("O") => "O".to_owned(),
                None => numbers.next().unwrap_or_default(),
            };
            // Of several formulas for a joint at rest, the constant one.
            let constant = here.iter().find(|joint| !self.moves(&joint[..]));
            named.push((name, constant.copied().unwrap_or_else(|| self.joints.position(joint))));
        }
        named
    }
}

impl Skeleton {
    /// Keeps the joints that a part needs.
    fn compact(self) -> Self {
        let mut used: Vec<usize> = self.parts.iter().flat_map(Part::joints).collect();
        used.sort_unstable();
        used.dedup();
        let index = |joint: usize| used.binary_search(&joint).unwrap_or_default();
        let parts = self.parts.into_iter().map(|part| part.map(index)).collect();
        Self { joints: used.iter().map(|&joint| self.joints[joint].clone()).collect(), parts, guides: self.guides }
    }
}

impl Part {
    fn joints(&self) -> Vec<usize> {
        match self {
            Self::Ground(joint) | Self::Slider(joint) | Self::Trace(joint) => vec![*joint],
            Self::Bar { joints, .. } => joints.clone(),
            Self::Sleeve { pin, on, towards } => [*pin, *on].into_iter().chain(*towards).collect(),
        }
    }

    fn map(self, f: impl Fn(usize) -> usize) -> Self {
        match self {
            Self::Ground(joint) => Self::Ground(f(joint)),
            Self::Slider(joint) => Self::Slider(f(joint)),
            Self::Trace(joint) => Self::Trace(f(joint)),
            Self::Bar { joints, is_driven } => Self::Bar { joints: joints.into_iter().map(f).collect(), is_driven },
            Self::Sleeve { pin, on, towards } => Self::Sleeve { pin: f(pin), on: f(on), towards: towards.map(f) },
        }
    }
}
