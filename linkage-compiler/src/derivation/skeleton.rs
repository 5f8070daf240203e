//! The parts of a drawing, guessed from the vectors of loops and points: bars, sliders, pivots on the ground.

use std::collections::{BTreeMap, BTreeSet};

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
    /// The loops, by index, that are drawn from the origin because nothing says where they begin.
    pub unplaced: Vec<usize>,
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
        let starts = starts(mechanism, graph);
        let mut tracer = Tracer { mechanism, graph, moving, joints: Joints::default(), edges: Vec::new() };
        let origin = [tracer.graph.zero(); 2];
        for (sides, start) in mechanism.loops.iter().zip(&starts) {
            if sides.iter().any(|side| !side.links.is_empty()) {
                let [one, other] = sides.each_ref().map(|side| tracer.trace(side, start.unwrap_or(origin)));
                tracer.joints.merge(one, other);
            }
        }
        for point in &mechanism.points {
            tracer.trace(&point.chain, origin);
        }
        tracer.merge();
        let unplaced = (0..starts.len()).filter(|&at| starts[at].is_none()).collect();
        Self { unplaced, ..tracer.finish(&driving) }
    }
}

/// The positions at which vectors begin, by the vector.
type Placed = BTreeMap<[NodeId; 2], BTreeSet<[NodeId; 2]>>;

/// The position at which each loop begins. The first one and those from a point are from the origin. Another may be written
/// from any joint, since it closes wherever it is: it begins where a vector that it shares with a point or with another loop
/// says, and at the origin if one of several such vectors says so. None where no vector does.
fn starts(mechanism: &Mechanism, graph: &mut Graph) -> Vec<Option<[NodeId; 2]>> {
    let origin = [graph.zero(); 2];
    let is_anywhere = |at: usize| {
        let sides = &mechanism.loops[at];
        sides.iter().all(|side| side.start.is_none()) && sides.iter().any(|side| !side.links.is_empty())
    };
    let all = 0..mechanism.loops.len();
    let first = all.clone().find(|&at| is_anywhere(at));
    let (mut left, known): (Vec<usize>, Vec<usize>) = all.partition(|&at| is_anywhere(at) && Some(at) != first);
    let mut starts = vec![Some(origin); mechanism.loops.len()];
    if left.is_empty() {
        return starts;
    }
    let mut placed = Placed::new();
    for point in &mechanism.points {
        place(&point.chain, origin, graph, &mut placed);
    }
    for side in known.iter().flat_map(|&at| &mechanism.loops[at]) {
        place(side, origin, graph, &mut placed);
    }
    loop {
        let count = left.len();
        left.retain(|&at| {
            let start = start(&mechanism.loops[at], graph, &placed);
            for (side, start) in mechanism.loops[at].iter().flat_map(|side| start.map(|start| (side, start))) {
                place(side, start, graph, &mut placed);
            }
            starts[at] = start;
            start.is_none()
        });
        if left.len() == count {
            return starts;
        }
    }
}

/// Notes the vectors of a chain, which begins at a position if it has none of its own.
fn place(chain: &Chain, start: [NodeId; 2], graph: &mut Graph, placed: &mut Placed) {
    let mut at = chain.start.unwrap_or(start);
    for link in &chain.links {
        let next = moved(graph, at, link, Number::ONE);
        placed.entry(link.vector).or_default().insert(if link.is_reversed { next } else { at });
        at = next;
    }
}

/// The position at which a loop begins, by the vectors that are placed.
fn start(sides: &[Chain; 2], graph: &mut Graph, placed: &Placed) -> Option<[NodeId; 2]> {
    let origin = [graph.zero(); 2];
    let mut first = None;
    for side in sides {
        for (index, link) in side.links.iter().enumerate() {
            for &from in placed.get(&link.vector).into_iter().flatten() {
                // Back to the begin of the loop.
                let before = &side.links[..index + usize::from(link.is_reversed)];
                let at = before.iter().rev().fold(from, |at, link| moved(graph, at, link, Number::MINUS_ONE));
                if at == origin {
                    return Some(origin);
                }
                first.get_or_insert(at);
            }
        }
    }
    first
}

/// A position moved along a link, or back.
fn moved(graph: &mut Graph, at: [NodeId; 2], link: &Link, sign: Number) -> [NodeId; 2] {
    let sign = if link.is_reversed { sign.negate() } else { sign };
    [0, 1].map(|axis| graph.sum(&[(Number::ONE, at[axis]), (sign, link.vector[axis])]))
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
    /// Adds the joints and vectors of a chain, which begins at a position if it has none of its own; returns its last joint.
    fn trace(&mut self, chain: &Chain, start: [NodeId; 2]) -> usize {
        let mut last = self.joints.add(chain.start.unwrap_or(start));
        for &link in &chain.links {
            let from = self.joints.position(last);
            let to = moved(self.graph, from, &link, Number::ONE);
            let next = self.joints.add(to);
            self.edges.push(Edge { ends: [last, next], link });
            last = next;
        }
        last
    }

    /// Merges joints that the vectors show to be one: a position at the end of a vector from any formula of its start, such
    /// as `D - l4@theta4` and the joint C of the loop `B + l3@theta3 = C`, `C + l4@theta4 = D`. A position at rest need not be
    /// that of a joint: in `a@t + b@p + c@q - d@0 = 0` the end of c is at d@0, the other end of a vector that begins at the
    /// origin.
    fn merge(&mut self) {
        let mut is_changed = true;
        while is_changed {
            is_changed = false;
            for edge in 0..self.edges.len() {
                let Edge { ends: [from, to], link } = self.edges[edge];
                for (start, end, sign) in [(from, to, Number::ONE), (to, from, Number::MINUS_ONE)] {
                    let formulas: Vec<[NodeId; 2]> = self.joints.formulas(self.joints.find(start)).collect();
                    for at in formulas {
                        let moved = moved(self.graph, at, &link, sign);
                        let known = self.joints.known(moved).or_else(|| {
                            let is_new = !self.moves(&moved) && !self.rests(end);
                            is_new.then(|| self.joints.add(moved))
                        });
                        if let Some(known) = known
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

    /// True if a formula of a joint has no coordinates.
    fn rests(&self, joint: usize) -> bool {
        self.joints.formulas(self.joints.find(joint)).any(|formula| !self.moves(&formula))
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
        let is_fixed: Vec<bool> = (0..self.joints.len()).map(|joint| self.rests(joint)).collect();
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
        Skeleton { joints, parts, guides, unplaced: Vec::new() }.compact()
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
        Self { joints: used.iter().map(|&joint| self.joints[joint].clone()).collect(), parts, ..self }
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
