//! Blocks whose equations are loops of links: k_i + sum_j c_ij e^(i psi_j) = 0, where each direction psi_j is an integer
//! combination of the unknown angles.
//!
//! Two rows r and t are those of one loop, r + i t, if each direction turns them in one sense: with
//! r = sum (p cos psi + q sin psi) + k, the row t has -q cos psi + p sin psi or the negative. That is also so if the rows
//! come from an elimination, in either order and with either sign: r + i t is then the loop times 1, -1, i or -i, or its
//! conjugate.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use rustc_hash::FxHashSet;

use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

/// The most loops of a group of which all positions can be listed.
pub const MOST_LOOPS: usize = 3;

/// The largest factor of an unknown in a direction.
const LARGEST_FACTOR: i64 = 4;

/// The most terms of a row, with its sums multiplied out.
const MOST_TERMS: usize = 1000;

/// The loops of a block, with as many directions as unknowns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loops {
    /// The factor of each unknown in each direction.
    pub directions: Vec<Vec<i64>>,
    /// The factor of each direction in each unknown: the inverse.
    pub unknowns: Vec<Vec<i64>>,
    /// k_i as real and imaginary part, by loop.
    pub constants: Vec<[NodeId; 2]>,
    /// c_ij, by loop and direction.
    pub factors: Vec<Vec<[NodeId; 2]>>,
}

impl Loops {
    /// The loops of two or three pairs of rows; `None` if the rows have another form.
    pub fn of(graph: &mut Graph, rows: &[NodeId], unknowns: &[SymbolId]) -> Option<Self> {
        let is_size = |loops: usize| (2..=MOST_LOOPS).contains(&loops);
        if rows.len() != unknowns.len() || !rows.len().is_multiple_of(2) || !is_size(rows.len() / 2) {
            return None;
        }
        let waves: Option<Vec<Waves>> = rows.iter().map(|&row| Waves::of(graph, row, unknowns)).collect();
        let pairs = paired(graph, waves?)?;
        let senses = senses(&pairs)?;
        let directions: Vec<Vec<i64>> =
            senses.iter().map(|(of, sense)| of.0.iter().map(|factor| factor * sense).collect()).collect();
        if directions.len() != unknowns.len() {
            return None;
        }
        let inverse = inverse(&directions)?;
        let zero = graph.zero();
        let factors = pairs.iter().map(|pair| {
            let factor = |of: &Direction| pair.waves.get(of).map_or([zero; 2], |(factor, _)| *factor);
            senses.keys().map(factor).collect()
        });
        let factors = factors.collect();
        let constants = pairs.iter().map(|pair| pair.constant).collect();
        Some(Self { directions, unknowns: inverse, constants, factors })
    }
}

impl Loops {
    /// k_i and c_ij, by loop.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeId> {
        self.constants.iter().chain(self.factors.iter().flatten()).flatten().copied().collect()
    }

    /// These loops with other expressions.
    #[must_use]
    pub fn map(self, f: impl Fn(NodeId) -> NodeId) -> Self {
        let constants = self.constants.into_iter().map(|part| part.map(&f)).collect();
        let of_loop = |factors: Vec<[NodeId; 2]>| factors.into_iter().map(|part| part.map(&f)).collect();
        Self { constants, factors: self.factors.into_iter().map(of_loop).collect(), ..self }
    }
}

/// The factors of the unknowns, of which the first that is not zero is positive. Plain angles are in the order of the
/// unknowns.
type Direction = Reverse<Vec<i64>>;

/// A row as k + sum (p cos psi + q sin psi).
struct Waves {
    constant: NodeId,
    /// p and q, by direction.
    parts: BTreeMap<Direction, [NodeId; 2]>,
}

impl Waves {
    fn of(graph: &mut Graph, row: NodeId, unknowns: &[SymbolId]) -> Option<Self> {
        let mut holding: FxHashSet<NodeId> = FxHashSet::default();
        for id in graph.reachable(&[row]) {
            let itself = graph.as_symbol(id).is_some_and(|symbol| unknowns.contains(&symbol));
            if itself || graph.children(id).iter().any(|child| holding.contains(child)) {
                holding.insert(id);
            }
        }
        let (mut constant, mut parts) = (Vec::new(), BTreeMap::<Direction, [Vec<NodeId>; 2]>::new());
        let mut open = vec![(row, graph.one())];
        let mut count = 0;
        while let Some((node, factor)) = open.pop() {
            count += 1;
            if count > MOST_TERMS || !graph.budget().spend(1) {
                return None;
            }
            if !holding.contains(&node) {
                constant.push(graph.multiply(factor, node));
                continue;
            }
            match graph.node(node).clone() {
                Node::Sum { .. } => {
                    for (times, term) in graph.terms(node) {
                        open.push((term, graph.scale(times, factor)));
                    }
                }
                Node::Product { coefficient, factors } => {
                    let (with, mut still): (Vec<_>, Vec<_>) =
                        factors.into_iter().partition(|(base, _)| holding.contains(base));
                    let &[(base, 1)] = with.as_slice() else { return None };
                    still.extend([(graph.number(coefficient), 1), (factor, 1)]);
                    open.push((base, graph.product(&still)));
                }
                Node::Call(function @ (Function::Cos | Function::Sin), angle) => {
                    let (direction, offset) = direction(graph, angle[0], unknowns)?;
                    let waves = shifted(graph, function, direction.1, offset);
                    let of = parts.entry(direction.0).or_default();
                    for (part, wave) in of.iter_mut().zip(waves) {
                        part.push(graph.multiply(factor, wave));
                    }
                }
                _ => return None,
            }
        }
        let constant = total(graph, constant);
        let parts = parts.into_iter().map(|(of, parts)| (of, parts.map(|part| total(graph, part))));
        let parts: Vec<(Direction, [NodeId; 2])> = parts.collect();
        let parts = parts.into_iter().filter(|(_, parts)| !parts.iter().all(|&part| graph.is_zero(part))).collect();
        Some(Self { constant, parts })
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
            Some(place) => {
                factors[place] += times.as_integer().filter(|times| times.abs() <= LARGEST_FACTOR)?;
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

/// One loop r + i t, or its conjugate.
struct Pair {
    constant: [NodeId; 2],
    /// c and the sense in which the direction turns.
    waves: BTreeMap<Direction, ([NodeId; 2], i64)>,
}

impl Pair {
    /// The loop of two rows.
    fn of(graph: &mut Graph, r: &Waves, t: &Waves) -> Option<Self> {
        if r.parts.is_empty() || !r.parts.keys().eq(t.parts.keys()) {
            return None;
        }
        let mut waves = BTreeMap::new();
        for (direction, &[p, q]) in &r.parts {
            let turned = [graph.negate(q), p];
            let back = [q, graph.negate(p)];
            let sense = match t.parts[direction] {
                other if other == turned => 1,
                other if other == back => -1,
                _ => return None,
            };
            // p cos psi + q sin psi is the real part of (p - i sense q) e^(i sense psi).
            let imaginary = graph.scale(Number::integer(-sense), q);
            waves.insert(direction.clone(), ([p, imaginary], sense));
        }
        Some(Self { constant: [r.constant, t.constant], waves })
    }

    fn conjugate(&mut self, graph: &mut Graph) {
        self.constant[1] = graph.negate(self.constant[1]);
        for ([_, imaginary], sense) in self.waves.values_mut() {
            *imaginary = graph.negate(*imaginary);
            *sense = -*sense;
        }
    }
}

/// The loops of all rows, such that each direction turns in one sense.
fn paired(graph: &mut Graph, mut rows: Vec<Waves>) -> Option<Vec<Pair>> {
    let mut pairs: Vec<Pair> = Vec::new();
    while !rows.is_empty() {
        let first = rows.remove(0);
        let found = rows.iter().enumerate().find_map(|(place, row)| Some((place, Pair::of(graph, &first, row)?)));
        let (place, pair) = found?;
        rows.remove(place);
        pairs.push(pair);
    }
    // Most directions turn as they are written.
    for pair in &mut pairs {
        if pair.waves.values().map(|(_, sense)| sense).sum::<i64>() < 0 {
            pair.conjugate(graph);
        }
    }
    let mut known: BTreeMap<Direction, i64> = BTreeMap::new();
    let mut settled = Vec::new();
    while !pairs.is_empty() {
        let is_joined = |pair: &Pair| pair.waves.keys().any(|direction| known.contains_key(direction));
        let place = pairs.iter().position(is_joined).unwrap_or(0);
        let mut pair = pairs.remove(place);
        let differs = |(direction, (_, sense)): (&Direction, &([NodeId; 2], i64))| {
            known.get(direction).is_some_and(|other| other != sense)
        };
        if pair.waves.iter().any(differs) {
            pair.conjugate(graph);
        }
        known.extend(pair.waves.iter().map(|(direction, (_, sense))| (direction.clone(), *sense)));
        settled.push(pair);
    }
    Some(settled)
}

/// The sense of each direction; `None` if one turns in both.
fn senses(pairs: &[Pair]) -> Option<BTreeMap<Direction, i64>> {
    let mut senses = BTreeMap::new();
    for (direction, (_, sense)) in pairs.iter().flat_map(|pair| &pair.waves) {
        if senses.insert(direction.clone(), *sense).is_some_and(|other| other != *sense) {
            return None;
        }
    }
    Some(senses)
}

/// The inverse of a matrix of integers, if it has integers only: its determinant is 1 or -1.
fn inverse(matrix: &[Vec<i64>]) -> Option<Vec<Vec<i64>>> {
    let whole = determinant(matrix);
    let minor = |row: usize, column: usize| -> i64 {
        let rows = matrix.iter().enumerate().filter(|(place, _)| *place != row).map(|(_, entries)| {
            entries.iter().enumerate().filter(|(place, _)| *place != column).map(|(_, entry)| *entry).collect()
        });
        let sign = if (row + column).is_multiple_of(2) { 1 } else { -1 };
        sign * determinant(&rows.collect::<Vec<Vec<i64>>>())
    };
    let places = 0..matrix.len();
    let column = |row: usize| places.clone().map(|column| whole * minor(column, row)).collect();
    (whole.abs() == 1).then(|| places.clone().map(column).collect())
}

fn determinant(matrix: &[Vec<i64>]) -> i64 {
    let Some((first, rest)) = matrix.split_first() else { return 1 };
    let terms = first.iter().enumerate().filter(|(_, entry)| **entry != 0).map(|(column, entry)| {
        let minor = rest.iter().map(|row| [&row[..column], &row[column + 1..]].concat());
        let sign = if column.is_multiple_of(2) { 1 } else { -1 };
        sign * entry * determinant(&minor.collect::<Vec<Vec<i64>>>())
    });
    terms.sum()
}
