//! The rigid links of a linkage, and the guides on which one slides along another, from the vectors that the user wrote.
//!
//! Vectors of constant length that turn with one angle and meet are one link; those of constant direction that begin at
//! the origin are the ground. A vector whose length is a coordinate is a guide: its end slides, without turning, on the
//! link from which it begins.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::chain::{Chain, Chains, Link, Mean};
use super::joints::Joints;
use super::opened::Site;
use super::scene::Body;
use crate::graph::{Function, Graph, NodeId, Number, SymbolId};
use crate::ids::{BodyId, Table};

/// A rigid link.
#[derive(Debug, Clone)]
pub(super) struct RigidLink {
    /// The name of a body on it, or of the coordinates that it moves with.
    pub(super) name: String,
    direction: usize,
    joints: BTreeSet<usize>,
}

/// A guide: the joint at its second end, on its second link, slides on its first.
#[derive(Debug, Clone)]
pub(super) struct Guide {
    /// The coordinate that is its length.
    pub(super) coordinate: SymbolId,
    pub(super) ends: [usize; 2],
    pub(super) links: [usize; 2],
    /// A quarter turn from its direction.
    pub(super) normal: [NodeId; 2],
}

/// A vector, or a part of one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    /// From its start to its end, in the order of the chain.
    pub(super) vector: [NodeId; 2],
    pub(super) of: LegOf,
}

/// The kind of a leg; directions are by index, 0 for a constant one.
#[derive(Debug, Clone, Copy)]
pub(super) enum LegOf {
    Rigid {
        direction: usize,
    },
    /// A guide whose length depends on a coordinate, with its normal, a quarter turn from its direction.
    Guide {
        direction: usize,
        length: NodeId,
        normal: [NodeId; 2],
    },
    /// Two coordinates: its end moves freely.
    Free,
}

#[derive(Debug)]
pub(super) struct Links {
    /// The symbols of the coordinates.
    moving: BTreeSet<SymbolId>,
    joints: Joints,
    /// An angle of each direction but the constant one.
    directions: Vec<NodeId>,
    /// The ground comes first.
    links: Vec<RigidLink>,
    pub(super) guides: Vec<Guide>,
    /// The link of each body.
    pub(super) bodies: Table<BodyId, usize>,
    /// The loops that begin at a joint which they do not name.
    pub(super) floating: Vec<usize>,
    /// True if the sides of all loops are sums of vectors.
    pub(super) is_complete: bool,
}

/// A leg between two joints.
struct Edge {
    ends: [usize; 2],
    vector: [NodeId; 2],
    of: LegOf,
}

/// The index of the ground.
pub(super) const GROUND: usize = 0;

impl Links {
    pub(super) fn of(
        graph: &mut Graph,
        moving: BTreeSet<SymbolId>,
        chains: &Chains,
        bodies: &Table<BodyId, Body>,
    ) -> Self {
        let mut links = Self {
            moving,
            joints: Joints::default(),
            directions: Vec::new(),
            links: Vec::new(),
            guides: Vec::new(),
            bodies: Table::default(),
            floating: Vec::new(),
            is_complete: true,
        };
        let zero = graph.zero();
        let origin = links.joints.add([zero; 2]);
        let mut edges = Vec::new();
        for (sides, zeros) in chains.loops.iter().zip(&chains.zeros) {
            let mut end = |side: usize| match zeros[side] {
                true => Some(origin),
                false => links.trace(graph, &sides[side], &mut edges),
            };
            let [one, other] = [end(0), end(1)];
            match (one, other) {
                (Some(one), Some(other)) => links.joints.merge(one, other),
                _ => links.is_complete = false,
            }
        }
        for chain in chains.points.iter().chain(&chains.centers) {
            links.trace(graph, chain, &mut edges);
        }
        links.merge_parallel(graph, &edges);
        links.join(links.joints.find(origin), 0, &[]);
        for edge in &edges {
            let [from, to] = edge.ends.map(|end| links.joints.find(end));
            match edge.of {
                LegOf::Rigid { direction } => links.join(from, direction, &[to]),
                LegOf::Guide { direction, .. } => {
                    [from, to].into_iter().for_each(|end| links.join(end, direction, &[]))
                }
                LegOf::Free => {}
            }
        }
        links.add_bodies(graph, bodies, &chains.means);
        for Edge { ends, of, .. } in edges {
            let LegOf::Guide { direction, length, normal } = of else { continue };
            let ends = ends.map(|end| links.joints.find(end));
            let symbols = graph.symbols_of(&[length]);
            let mut coordinates = symbols.into_iter().filter(|symbol| links.moving.contains(symbol));
            let (Some(coordinate), None) = (coordinates.next(), coordinates.next()) else { continue };
            let [Some(base), Some(block)] = ends.map(|end| links.link_at(end, direction)) else { continue };
            if links.guides.iter().all(|guide| guide.ends != ends || guide.coordinate != coordinate) {
                links.guides.push(Guide { coordinate, ends, links: [base, block], normal });
            }
        }
        let floating = chains.loops.iter().enumerate();
        links.floating = floating.filter(|(_, chains)| links.floats(graph, chains)).map(|(index, _)| index).collect();
        links.name(graph, bodies);
        links
    }

    /// Merges the ends of equal vectors that begin at one joint, until no more are found.
    fn merge_parallel(&mut self, graph: &mut Graph, edges: &[Edge]) {
        let mut directed = Vec::new();
        for Edge { ends: [from, to], vector, .. } in edges {
            directed.push((*from, *vector, *to));
            directed.push((*to, vector.map(|part| graph.negate(part)), *from));
        }
        let mut is_changed = true;
        while is_changed {
            is_changed = false;
            let mut reached = FxHashMap::default();
            for &(from, vector, to) in &directed {
                let to = self.joints.find(to);
                let other = *reached.entry((self.joints.find(from), vector)).or_insert(to);
                if self.joints.find(other) != to {
                    self.joints.merge(other, to);
                    is_changed = true;
                }
            }
        }
    }

    /// True for a loop whose sides both leave the origin on moving links, one of which is elsewhere in other statements:
    /// it is written from another joint, which only the user knows.
    fn floats(&self, graph: &mut Graph, [left, right]: &[Chain; 2]) -> bool {
        if left.start.is_some() || right.start.is_some() {
            return false;
        }
        let ends = [left.links.first().or(right.links.last()), right.links.first().or(left.links.last())];
        let directions = ends.map(|end| end.and_then(|link| self.direction_of(graph, link)).unwrap_or(0));
        let Some(origin) = self.links[GROUND].joints.first().copied() else { return false };
        let is_elsewhere = |direction: usize| {
            let home = self.link_at(origin, direction);
            let slides = |link: usize| {
                let mut guides = self.guides.iter();
                guides
                    .any(|Guide { links, .. }| links.contains(&link) && home.is_some_and(|home| links.contains(&home)))
            };
            let mut links = self.links.iter().enumerate();
            links.any(|(index, link)| link.direction == direction && Some(index) != home && !slides(index))
        };
        directions.iter().all(|&direction| direction > 0) && directions.into_iter().any(is_elsewhere)
    }

    /// The index of the known direction of a vector.
    fn direction_of(&self, graph: &mut Graph, link: &Link) -> Option<usize> {
        let angle = link.angle?;
        let mut known = self.directions.iter();
        let is_parallel = |&other: &NodeId| {
            let difference = graph.subtract(angle, other);
            !self.moves(graph, &[difference])
        };
        known.position(is_parallel).map(|at| at + 1)
    }

    pub(super) fn link(&self, index: usize) -> &RigidLink {
        &self.links[index]
    }

    /// All links.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        0..self.links.len()
    }

    /// The direction of a link; links that turn by one angle have the same.
    pub(super) fn direction(&self, link: usize) -> usize {
        self.links[link].direction
    }

    /// The links of each pin at which several meet.
    pub(super) fn meeting(&self) -> Vec<Vec<usize>> {
        let joints: BTreeSet<usize> = self.links.iter().flat_map(|link| link.joints.iter().copied()).collect();
        let pins = joints.into_iter().map(|joint| self.at(joint).collect::<Vec<_>>());
        pins.filter(|links| links.len() > 1).collect()
    }

    /// The joint at a position, if a vector begins or ends there.
    pub(super) fn joint(&self, position: [NodeId; 2]) -> Option<usize> {
        self.joints.known(position)
    }

    /// The position of a joint.
    pub(super) fn position(&self, joint: usize) -> [NodeId; 2] {
        self.joints.position(joint)
    }

    /// The links in which a position is fixed.
    pub(super) fn holding(&mut self, graph: &mut Graph, position: [NodeId; 2]) -> BTreeSet<usize> {
        let joint = self.joints.known(position);
        let mut holding = BTreeSet::new();
        for index in 0..self.links.len() {
            let RigidLink { direction, joints, .. } = self.links[index].clone();
            let is_joint = joint.is_some_and(|joint| joints.contains(&joint));
            if is_joint || joint.is_none() && self.is_fixed(graph, direction, &joints, position) {
                holding.insert(index);
            }
        }
        holding
    }

    /// The links in which a mean of points is fixed, although the points may be written across a loop.
    fn holding_mean(&mut self, graph: &mut Graph, mean: &Mean) -> BTreeSet<usize> {
        let zero = graph.zero();
        let mut holding: BTreeSet<usize> = (0..self.links.len()).collect();
        for &point in &mean.points {
            let of_point = self.holding(graph, point);
            holding.retain(|link| of_point.contains(link));
        }
        let turns_with = |link: &usize| self.turns_with(graph, self.links[*link].direction, [zero; 2], mean.offset);
        holding.into_iter().filter(turns_with).collect()
    }

    /// The link of a direction at a joint.
    pub(super) fn link_at(&self, joint: usize, direction: usize) -> Option<usize> {
        self.links.iter().position(|link| link.direction == direction && link.joints.contains(&joint))
    }

    pub(super) fn is_coordinate(&self, symbol: SymbolId) -> bool {
        self.moving.contains(&symbol)
    }

    pub(super) fn is_origin(&self, graph: &mut Graph, joint: usize) -> bool {
        let zero = graph.zero();
        self.joints.known([zero; 2]) == Some(joint)
    }

    /// The links at a joint.
    pub(super) fn at(&self, joint: usize) -> impl Iterator<Item = usize> {
        let links = self.links.iter().enumerate();
        links.filter(move |(_, link)| link.joints.contains(&joint)).map(|(index, _)| index)
    }

    /// Makes a position a joint of the links in which it is fixed.
    pub(super) fn hold(&mut self, position: [NodeId; 2], holding: &BTreeSet<usize>) -> usize {
        let joint = self.joints.add(position);
        let joint = self.joints.find(joint);
        for &link in holding {
            self.links[link].joints.insert(joint);
        }
        joint
    }

    /// The pins: each link at each joint where several meet.
    pub(super) fn pins(&self) -> Vec<Site> {
        let joints: BTreeSet<usize> = self.links.iter().flat_map(|link| link.joints.iter().copied()).collect();
        let pins = joints.into_iter().filter(|&joint| self.at(joint).nth(1).is_some());
        pins.flat_map(|joint| self.at(joint).map(move |link| Site::Pin { joint, link })).collect()
    }

    /// The pins about which one link turns by an angle relative to another, on this one.
    pub(super) fn pins_of_angle(&self, graph: &mut Graph, angle: NodeId) -> Vec<Site> {
        let mut pins = Vec::new();
        for (index, link) in self.links.iter().enumerate().filter(|(_, link)| link.direction > 0) {
            if graph.budget().check().is_err() {
                break;
            }
            for (_, other) in self.links.iter().enumerate().filter(|(other, _)| *other != index) {
                let mut rest = graph.subtract(angle, self.directions[link.direction - 1]);
                if let Some(at) = other.direction.checked_sub(1) {
                    rest = graph.add(rest, self.directions[at]);
                }
                if !self.moves(graph, &[rest]) {
                    let shared = link.joints.intersection(&other.joints);
                    pins.extend(shared.map(|&joint| Site::Pin { joint, link: index }));
                }
            }
        }
        pins.dedup();
        pins
    }

    /// The coordinates with which a link turns.
    pub(super) fn turns(&self, graph: &Graph, link: usize) -> Vec<SymbolId> {
        let angle = self.links[link].direction.checked_sub(1).map(|at| self.directions[at]);
        let symbols = angle.map(|angle| graph.symbols_of(&[angle])).unwrap_or_default();
        symbols.into_iter().filter(|symbol| self.moving.contains(symbol)).collect()
    }

    /// True if a link has a direction.
    pub(super) fn has_direction(&self, link: usize, direction: usize) -> bool {
        self.links[link].direction == direction
    }

    fn moves(&self, graph: &Graph, nodes: &[NodeId]) -> bool {
        graph.symbols_of(nodes).iter().any(|symbol| self.moving.contains(symbol))
    }

    /// The index of the direction of an angle, which is added if it is not known.
    fn add_direction(&mut self, graph: &mut Graph, angle: NodeId) -> usize {
        if !self.moves(graph, &[angle]) {
            return 0;
        }
        for at in 0..self.directions.len() {
            let difference = graph.subtract(angle, self.directions[at]);
            if !self.moves(graph, &[difference]) {
                return at + 1;
            }
        }
        self.directions.push(angle);
        self.directions.len()
    }

    /// The legs of a vector: its rigid part, and its parts whose lengths move. `None` if it is not written as `r@phi`,
    /// `(x, y)@phi` or `(x, y)` and moves.
    pub(super) fn legs(&mut self, graph: &mut Graph, link: &Link) -> Option<Vec<Leg>> {
        let sign = |graph: &mut Graph, node: NodeId| if link.is_reversed { graph.negate(node) } else { node };
        let zero = graph.zero();
        let Some(parts) = link.parts else {
            if self.moves(graph, &link.vector) {
                return None;
            }
            let vector = link.vector.map(|part| sign(graph, part));
            return Some(vec![Leg { vector, of: LegOf::Rigid { direction: 0 } }]);
        };
        let direction = link.angle.map_or(0, |angle| self.add_direction(graph, angle));
        let angle = link.angle.unwrap_or(zero);
        let [cosine, sine] = [Function::Cos, Function::Sin].map(|function| graph.call(function, &[angle]));
        let (along, across) = ([cosine, sine], [graph.negate(sine), cosine]);
        let backwards = along.map(|part| graph.negate(part));
        let vector_of = |graph: &mut Graph, length: NodeId, unit: [NodeId; 2]| {
            unit.map(|part| graph.multiply(length, part)).map(|part| sign(graph, part))
        };
        if parts.iter().all(|&part| self.moves(graph, &[part])) {
            let vector = link.vector.map(|part| sign(graph, part));
            return Some(vec![Leg { vector, of: LegOf::Free }]);
        }
        let (mut rigid, mut legs) = ([zero; 2], Vec::new());
        for (length, unit, normal) in [(parts[0], along, across), (parts[1], across, backwards)] {
            let vector = vector_of(graph, length, unit);
            if self.moves(graph, &[length]) {
                legs.push(Leg { vector, of: LegOf::Guide { direction, length, normal } });
            } else {
                rigid = [0, 1].map(|axis| graph.add(rigid[axis], vector[axis]));
            }
        }
        if !rigid.iter().all(|&part| graph.is_zero(part)) {
            legs.insert(0, Leg { vector: rigid, of: LegOf::Rigid { direction } });
        }
        if link.is_reversed {
            legs.reverse();
        }
        Some(legs)
    }

    /// Adds the joints and the legs of a chain; returns its last joint, or `None` if a vector is not understood.
    fn trace(&mut self, graph: &mut Graph, chain: &Chain, edges: &mut Vec<Edge>) -> Option<usize> {
        if chain.links.is_empty() && chain.start.is_none() {
            return None;
        }
        let zero = graph.zero();
        let mut last = self.joints.add(chain.start.unwrap_or([zero; 2]));
        for link in &chain.links {
            for Leg { vector, of } in self.legs(graph, link)? {
                let from = self.joints.position(last);
                let next = self.joints.add(moved(graph, from, vector));
                edges.push(Edge { ends: [last, next], vector, of });
                last = next;
            }
        }
        Some(last)
    }

    /// Joins a joint, and others on the same link, to the links of a direction that hold one of them.
    fn join(&mut self, joint: usize, direction: usize, others: &[usize]) {
        let mut joints: BTreeSet<usize> = others.iter().copied().chain([joint]).collect();
        let meets = |link: &RigidLink, joints: &BTreeSet<usize>| {
            link.direction == direction && !link.joints.is_disjoint(joints)
        };
        let Some(first) = self.links.iter().position(|link| meets(link, &joints)) else {
            self.links.push(RigidLink { name: String::new(), direction, joints });
            return;
        };
        let later = self.links.split_off(first + 1);
        for link in later {
            match meets(&link, &joints) {
                true => joints.extend(link.joints),
                false => self.links.push(link),
            }
        }
        self.links[first].joints.extend(joints);
    }

    /// Finds the link of each body. A mass without an angle belongs to what slides at its centre, or to the only link
    /// there; where several links meet, it is a body of its own.
    fn add_bodies(&mut self, graph: &mut Graph, bodies: &Table<BodyId, Body>, means: &[Option<Mean>]) {
        let mut held = Vec::new();
        for (at, body) in bodies.iter().enumerate() {
            let angle = body.inertia.map(|(_, angle)| angle);
            let direction = angle.map(|angle| self.add_direction(graph, angle));
            let Some((_, center)) = body.mass else {
                // A moment of inertia without a mass turns with the first link of its angle.
                let joint = self.joints.add([graph.zero(); 2]);
                let first = self.links.iter().find(|link| Some(link.direction) == direction);
                held.push(first.map_or((joint, direction.unwrap_or(0)), |link| {
                    (link.joints.first().copied().unwrap_or(joint), link.direction)
                }));
                continue;
            };
            let mut holding = self.holding(graph, center);
            if let Some(mean) = means.get(at).and_then(Option::as_ref) {
                holding.extend(self.holding_mean(graph, mean));
            }
            let of_angle = |index: &&usize| self.links[**index].direction == direction.unwrap_or(0);
            let only = || holding.first().filter(|_| direction.is_none() && holding.len() == 1);
            let found = holding.iter().find(of_angle).or_else(only).copied();
            let center = self.joints.add(center);
            let center = self.joints.find(center);
            let direction = found.map_or(direction.unwrap_or(0), |index| self.links[index].direction);
            let joint = found.and_then(|index| self.links[index].joints.first().copied());
            self.join(center, direction, joint.as_slice());
            held.push((center, direction));
        }
        for (joint, direction) in held {
            self.join(joint, direction, &[]);
            self.bodies.push(self.link_at(joint, direction).unwrap_or(GROUND));
        }
    }

    /// True if a position is constant in the frame of a link: with d = position - joint and the angle phi of the link,
    /// d' = phi' (-`d_y`, `d_x`) for each coordinate.
    fn is_fixed(&self, graph: &mut Graph, direction: usize, joints: &BTreeSet<usize>, position: [NodeId; 2]) -> bool {
        let formulas: Vec<[NodeId; 2]> = joints.iter().flat_map(|&joint| self.joints.formulas(joint)).collect();
        formulas.into_iter().any(|joint| self.turns_with(graph, direction, joint, position))
    }

    /// True if the vector between two positions turns with a direction.
    fn turns_with(&self, graph: &mut Graph, direction: usize, from: [NodeId; 2], to: [NodeId; 2]) -> bool {
        let angle = match direction.checked_sub(1) {
            Some(at) => self.directions[at],
            None => graph.zero(),
        };
        let [x, y] = [0, 1].map(|axis| graph.subtract(to[axis], from[axis]));
        self.moving.iter().all(|&symbol| {
            let derivatives = graph.partial(&[x, y, angle], symbol);
            let [dx, dy, turned] = [0, 1, 2].map(|at| derivatives[at]);
            let (across, along) = (graph.multiply(turned, y), graph.multiply(turned, x));
            let rest = [graph.add(dx, across), graph.subtract(dy, along)];
            rest.iter().all(|&part| graph.is_zero(part))
        })
    }

    fn name(&mut self, graph: &Graph, bodies: &Table<BodyId, Body>) {
        self.links[GROUND].name = "ground".to_owned();
        for (body, &link) in bodies.iter().zip(&self.bodies) {
            if self.links[link].name.is_empty() {
                self.links[link].name.clone_from(&body.name.field);
            }
        }
        let mut taken: BTreeSet<String> = self.links.iter().map(|link| link.name.clone()).collect();
        for index in 0..self.links.len() {
            if !self.links[index].name.is_empty() {
                continue;
            }
            let slides_by = self.guides.iter().find(|guide| guide.links[1] == index).map(|guide| guide.coordinate);
            let symbols = match self.links[index].direction.checked_sub(1) {
                Some(at) if slides_by.is_none() => graph.symbols_of(&[self.directions[at]]),
                _ => slides_by.into_iter().collect(),
            };
            let symbols = symbols.into_iter().filter(|symbol| self.moving.contains(symbol));
            let mut name = symbols.map(|symbol| graph.symbol_name(symbol)).collect::<Vec<_>>().join("_");
            if name.is_empty() {
                "link".clone_into(&mut name);
            }
            let mut number = 1;
            let mut unique = name.clone();
            while !taken.insert(unique.clone()) {
                number += 1;
                unique = format!("{name}_{number}");
            }
            self.links[index].name = unique;
        }
    }
}

/// The end of a vector from a position.
pub(super) fn moved(graph: &mut Graph, from: [NodeId; 2], vector: [NodeId; 2]) -> [NodeId; 2] {
    [0, 1].map(|axis| graph.sum(&[(Number::ONE, from[axis]), (Number::ONE, vector[axis])]))
}
