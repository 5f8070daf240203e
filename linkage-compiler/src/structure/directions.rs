//! Rows of a group as k + sum (p cos psi + q sin psi) + sum s (...): each direction psi is an integer combination of the
//! unknown angles, and each s is an unknown length with a factor of the form k + sum (p cos psi + q sin psi).

use std::cmp::Reverse;
use std::collections::BTreeMap;

use rustc_hash::FxHashSet;

use super::obstacle::Obstacle;
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

/// The largest factor of an unknown in a direction.
const LARGEST_FACTOR: i64 = 4;

/// The most terms of a row, with its sums multiplied out.
const MOST_TERMS: usize = 1000;

/// The factors of the unknowns, of which the first that is not zero is positive. Plain angles are in the order of the
/// unknowns.
pub type Direction = Reverse<Vec<i64>>;

/// k + sum (p cos psi + q sin psi).
#[derive(Debug, Clone)]
pub struct Waves {
    pub constant: NodeId,
    /// p and q, by direction.
    pub parts: BTreeMap<Direction, [NodeId; 2]>,
}

impl Waves {
    fn is_zero(&self, graph: &Graph) -> bool {
        self.parts.is_empty() && graph.is_zero(self.constant)
    }
}

/// A row of a group.
#[derive(Debug, Clone)]
pub struct Row {
    pub free: Waves,
    /// The factor of each length, by its place among the unknowns.
    pub lengths: BTreeMap<usize, Waves>,
}

impl Row {
    /// # Errors
    /// The reason why it has another form.
    pub fn of(graph: &mut Graph, row: NodeId, unknowns: &[SymbolId]) -> Result<Self, Obstacle> {
        let mut holding: FxHashSet<NodeId> = FxHashSet::default();
        for id in graph.reachable(&[row]) {
            let itself = graph.as_symbol(id).is_some_and(|symbol| unknowns.contains(&symbol));
            if itself || graph.children(id).iter().any(|child| holding.contains(child)) {
                holding.insert(id);
            }
        }
        let mut parts = BTreeMap::<Option<usize>, Parts>::new();
        let mut open = vec![Term { factor: graph.one(), factors: vec![row], length: None, wave: None }];
        let mut count = 0;
        while let Some(mut term) = open.pop() {
            count += 1;
            if count > MOST_TERMS || graph.budget().spend(1).is_err() {
                return Err(Obstacle::NotLoops);
            }
            let Some(node) = term.factors.pop() else {
                parts.entry(term.length).or_default().add(graph, &term);
                continue;
            };
            if !holding.contains(&node) {
                term.factor = graph.multiply(term.factor, node);
                open.push(term);
                continue;
            }
            if let Some(symbol) = graph.as_symbol(node) {
                let index = unknowns.iter().position(|&unknown| unknown == symbol);
                if term.length.is_some() {
                    return Err(Obstacle::ProductOfLengths);
                }
                open.push(Term { length: index, ..term });
                continue;
            }
            match graph.node(node).clone() {
                Node::Sum { .. } => {
                    for (times, part) in graph.terms(node) {
                        let mut next = term.clone();
                        next.factor = graph.scale(times, next.factor);
                        next.factors.push(part);
                        open.push(next);
                    }
                }
                Node::Product { coefficient, factors } => {
                    term.factor = graph.scale(coefficient, term.factor);
                    for (base, exponent) in factors {
                        match (holding.contains(&base), exponent) {
                            (false, _) => term.factor = graph.product(&[(term.factor, 1), (base, exponent)]),
                            (true, 1) => term.factors.push(base),
                            (true, _) if graph.as_symbol(base).is_some() => return Err(Obstacle::ProductOfLengths),
                            (true, _) => return Err(Obstacle::NotLoops),
                        }
                    }
                    open.push(term);
                }
                Node::Call(function @ (Function::Cos | Function::Sin), angle) if term.wave.is_none() => {
                    let (direction, offset) = direction(graph, angle[0], unknowns).ok_or(Obstacle::NotLoops)?;
                    let waves = shifted(graph, function, direction.1, offset);
                    open.push(Term { wave: Some((direction.0, waves)), ..term });
                }
                Node::External(..) => return Err(Obstacle::UserFunction),
                _ => return Err(Obstacle::NotLoops),
            }
        }
        let free = parts.remove(&None).unwrap_or_default().total(graph);
        let mut lengths = BTreeMap::new();
        for (length, parts) in parts {
            let factor = parts.total(graph);
            if let Some(index) = length.filter(|_| !factor.is_zero(graph)) {
                lengths.insert(index, factor);
            }
        }
        Ok(Self { free, lengths })
    }
}

/// A product while it is multiplied out.
#[derive(Debug, Clone)]
struct Term {
    /// Its known part, and the factors still to be read.
    factor: NodeId,
    factors: Vec<NodeId>,
    /// The length in it, and the wave with its p and q.
    length: Option<usize>,
    wave: Option<(Direction, [NodeId; 2])>,
}

/// The terms of a sum of waves.
#[derive(Debug, Default)]
struct Parts {
    constant: Vec<NodeId>,
    waves: BTreeMap<Direction, [Vec<NodeId>; 2]>,
}

impl Parts {
    fn add(&mut self, graph: &mut Graph, term: &Term) {
        let Some((direction, waves)) = &term.wave else {
            self.constant.push(term.factor);
            return;
        };
        for (part, wave) in self.waves.entry(direction.clone()).or_default().iter_mut().zip(waves) {
            part.push(graph.multiply(term.factor, *wave));
        }
    }

    fn total(self, graph: &mut Graph) -> Waves {
        let constant = total(graph, self.constant);
        let parts = self.waves.into_iter().map(|(of, parts)| (of, parts.map(|part| total(graph, part))));
        let parts: Vec<(Direction, [NodeId; 2])> = parts.collect();
        let parts = parts.into_iter().filter(|(_, parts)| !parts.iter().all(|&part| graph.is_zero(part))).collect();
        Waves { constant, parts }
    }
}

fn total(graph: &mut Graph, nodes: Vec<NodeId>) -> NodeId {
    let terms: Vec<(Number, NodeId)> = nodes.into_iter().map(|node| (Number::ONE, node)).collect();
    graph.sum(&terms)
}

/// An angle as sense * direction + offset.
fn direction(graph: &mut Graph, angle: NodeId, unknowns: &[SymbolId]) -> Option<((Direction, i64), NodeId)> {
    let (mut factors, mut offset) = (vec![0; unknowns.len()], Vec::new());
    for (times, term) in graph.terms(angle) {
        let (times, symbol) = match graph.node(term) {
            Node::Product { coefficient, factors } if matches!(factors.as_slice(), [(_, 1)]) => {
                (times.multiply(*coefficient), factors[0].0)
            }
            _ => (times, term),
        };
        let symbol = graph.as_symbol(symbol);
        match unknowns.iter().position(|&unknown| Some(unknown) == symbol) {
            Some(index) => {
                factors[index] += times.as_integer().filter(|times| times.abs() <= LARGEST_FACTOR)?;
            }
            None if graph.symbols_of(&[term]).iter().any(|symbol| unknowns.contains(symbol)) => return None,
            None => offset.push((times, term)),
        }
    }
    let first = factors.iter().find(|factor| **factor != 0)?;
    let sense = first.signum();
    factors.iter_mut().for_each(|factor| *factor *= sense);
    Some(((Reverse(factors), sense), graph.sum(&offset)))
}

/// p and q of cos or sin of sense * psi + offset.
fn shifted(graph: &mut Graph, function: Function, sense: i64, offset: NodeId) -> [NodeId; 2] {
    let [cosine, sine] = [Function::Cos, Function::Sin].map(|function| graph.call(function, &[offset]));
    let (of_cosine, of_sine) = match function {
        Function::Cos => (cosine, graph.negate(sine)),
        _ => (sine, cosine),
    };
    [of_cosine, graph.scale(Number::integer(sense), of_sine)]
}
