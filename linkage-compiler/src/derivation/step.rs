//! The steps of a solution: names, checks and linear or nonlinear solves, in order.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::GroupId;
use crate::structure::Loops;

/// One step of a solution. Later steps refer to its results by their symbols.
#[derive(Debug, Clone)]
pub enum Step {
    /// Names a value.
    Let { symbol: SymbolId, node: NodeId },
    /// Names an angle: its principal value plus a given number of turns. With a range of at most a turn, turn 0 is the one in
    /// it.
    Turn { symbol: SymbolId, principal: NodeId, range: Option<[NodeId; 2]> },
    /// Fails if a determinant is zero relative to `scale`.
    Guard { group: GroupId, determinant: NodeId, scale: NodeId },
    /// Factorises the matrix of a group, given by rows with their scales; fails if it is singular.
    Factor { group: GroupId, matrix: Vec<Vec<NodeId>>, row_scales: Vec<NodeId> },
    /// Solves the factorised system of a group and names the solution.
    Solve { group: GroupId, targets: Vec<SymbolId>, right: Vec<NodeId> },
    /// Names the square root of a product of two factors, with the sign of the branch; fails if a factor is negative by
    /// more than the rounding error of its terms. `size` is n of the factors n - h and n + h, or (p + q)^2 of a
    /// triangle.
    Chord { group: GroupId, symbol: SymbolId, factors: [NodeId; 2], size: NodeId, of: ChordGeometry<NodeId> },
    /// Fails if the determinant of linear unknowns is zero; `numerators` are their numerators by Cramer's rule,
    /// `scales` the sums of the magnitudes of the terms of each numerator.
    Solvable { group: GroupId, determinant: NodeId, numerators: Vec<NodeId>, scales: Vec<NodeId> },
    /// Fails if a distance that an equation gives is negative.
    Reach { group: GroupId, length: NodeId },
    /// Names the unknowns of a group, found by Newton's method from `start`. `system` holds its residuals, their scales
    /// and its Jacobian by rows, in terms of the unknowns and of `known`.
    Newton { group: GroupId, targets: Vec<SymbolId>, start: Vec<NodeId>, known: Vec<NodeId>, system: Vec<NodeId> },
    /// Names the unknowns of a group of loops: of all its positions the one whose number the branch has. `system` and
    /// `known` are those of Newton's method.
    Modes { group: GroupId, targets: Vec<SymbolId>, loops: Loops, known: Vec<NodeId>, system: Vec<NodeId> },
    /// Names the product of the pivots of a matrix given by rows.
    Pivots { symbol: SymbolId, matrix: Vec<Vec<NodeId>> },
}

/// The geometry of a half chord.
#[derive(Debug, Clone, Copy)]
pub enum ChordGeometry<V> {
    /// An RRR dyad: the lengths of its links, the vector between its outer joints, the squared distance, and the scale
    /// of the vector.
    Triangle { links: [V; 2], line: [V; 2], distance_squared: V, scale: V },
    /// The chord of a circle of radius n at the distance h from its centre: the scales of n and of h; `may_cancel` if n
    /// is a sum that may cancel to rounding error.
    Circle { scales: [V; 2], may_cancel: bool },
    /// A circle of which only positive factors count: the scale of n if it may cancel.
    RegularCircle { scale: Option<V> },
}

impl<V: Copy> ChordGeometry<V> {
    fn values(&self) -> Vec<V> {
        match *self {
            Self::Triangle { links: [p, q], line: [x, y], distance_squared, scale } => {
                vec![p, q, x, y, distance_squared, scale]
            }
            Self::Circle { scales, .. } => scales.to_vec(),
            Self::RegularCircle { scale } => scale.into_iter().collect(),
        }
    }

    pub(crate) fn map<W>(self, mut f: impl FnMut(V) -> W) -> ChordGeometry<W> {
        match self {
            Self::Triangle { links, line, distance_squared, scale } => ChordGeometry::Triangle {
                links: links.map(&mut f),
                line: line.map(&mut f),
                distance_squared: f(distance_squared),
                scale: f(scale),
            },
            Self::Circle { scales, may_cancel } => ChordGeometry::Circle { scales: scales.map(f), may_cancel },
            Self::RegularCircle { scale } => ChordGeometry::RegularCircle { scale: scale.map(f) },
        }
    }
}

impl Step {
    /// The symbols that a step defines.
    #[must_use]
    pub fn introduced(&self) -> Vec<SymbolId> {
        match self {
            Self::Let { symbol, .. }
            | Self::Turn { symbol, .. }
            | Self::Pivots { symbol, .. }
            | Self::Chord { symbol, .. } => vec![*symbol],
            Self::Solve { targets, .. } | Self::Newton { targets, .. } | Self::Modes { targets, .. } => targets.clone(),
            Self::Guard { .. } | Self::Factor { .. } | Self::Solvable { .. } | Self::Reach { .. } => Vec::new(),
        }
    }

    /// This step with other expressions.
    #[must_use]
    pub fn map(self, f: impl Fn(NodeId) -> NodeId) -> Self {
        let all = |nodes: Vec<NodeId>| nodes.into_iter().map(&f).collect::<Vec<_>>();
        match self {
            Self::Let { symbol, node } => Self::Let { symbol, node: f(node) },
            Self::Turn { symbol, principal, range } => {
                Self::Turn { symbol, principal: f(principal), range: range.map(|range| range.map(&f)) }
            }
            Self::Guard { group, determinant, scale } => {
                Self::Guard { group, determinant: f(determinant), scale: f(scale) }
            }
            Self::Factor { group, matrix, row_scales } => {
                Self::Factor { group, matrix: matrix.into_iter().map(all).collect(), row_scales: all(row_scales) }
            }
            Self::Solve { group, targets, right } => Self::Solve { group, targets, right: all(right) },
            Self::Chord { group, symbol, factors, size, of } => {
                Self::Chord { group, symbol, factors: factors.map(&f), size: f(size), of: of.map(f) }
            }
            Self::Solvable { group, determinant, numerators, scales } => {
                Self::Solvable { group, determinant: f(determinant), numerators: all(numerators), scales: all(scales) }
            }
            Self::Reach { group, length } => Self::Reach { group, length: f(length) },
            Self::Newton { group, targets, start, known, system } => {
                Self::Newton { group, targets, start: all(start), known: all(known), system: all(system) }
            }
            Self::Modes { group, targets, loops, known, system } => {
                Self::Modes { group, targets, loops: loops.map(&f), known: all(known), system: all(system) }
            }
            Self::Pivots { symbol, matrix } => Self::Pivots { symbol, matrix: matrix.into_iter().map(all).collect() },
        }
    }

    /// The expressions of a step.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeId> {
        match self {
            Self::Let { node, .. } => vec![*node],
            Self::Turn { principal, range, .. } => {
                std::iter::once(*principal).chain(range.iter().flatten().copied()).collect()
            }
            Self::Reach { length, .. } => vec![*length],
            Self::Guard { determinant, scale, .. } => vec![*determinant, *scale],
            Self::Chord { factors: [low, high], size, of, .. } => {
                [*low, *high, *size].into_iter().chain(of.values()).collect()
            }
            Self::Solvable { determinant, numerators, scales, .. } => {
                std::iter::once(determinant).chain(numerators).chain(scales).copied().collect()
            }
            Self::Factor { matrix, row_scales, .. } => matrix.iter().flatten().chain(row_scales).copied().collect(),
            Self::Pivots { matrix, .. } => matrix.iter().flatten().copied().collect(),
            Self::Solve { right, .. } => right.clone(),
            Self::Newton { start, known, .. } => start.iter().chain(known).copied().collect(),
            Self::Modes { loops, known, .. } => loops.nodes().into_iter().chain(known.iter().copied()).collect(),
        }
    }
}

/// Puts each of some later steps after the last step that it depends on, in their own order.
#[must_use]
pub fn merged(graph: &Graph, steps: Vec<Step>, later: Vec<Step>) -> Vec<Step> {
    let mut indices: BTreeMap<SymbolId, usize> = BTreeMap::new();
    for (index, step) in steps.iter().enumerate() {
        indices.extend(step.introduced().into_iter().map(|symbol| (symbol, index)));
    }
    let mut placed: Vec<(usize, Step)> = steps.into_iter().enumerate().collect();
    let mut index = 0;
    for step in later {
        let symbols = graph.symbols_of(&step.nodes());
        index = symbols.iter().filter_map(|symbol| indices.get(symbol)).copied().fold(index, usize::max);
        indices.extend(step.introduced().into_iter().map(|symbol| (symbol, index)));
        placed.push((index, step));
    }
    placed.sort_by_key(|(index, _)| *index);
    placed.into_iter().map(|(_, step)| step).collect()
}

/// Keeps all checks, and the steps that `results` and these checks depend on.
#[must_use]
pub fn needed(graph: &Graph, steps: Vec<Step>, results: &[NodeId]) -> Vec<Step> {
    kept(graph, steps, results, |_| true)
}

/// Removes only `Let` and `Turn` steps that nothing depends on; all other steps are kept.
#[must_use]
pub fn needed_names(graph: &Graph, steps: Vec<Step>, results: &[NodeId]) -> Vec<Step> {
    kept(graph, steps, results, |step| matches!(step, Step::Let { .. } | Step::Turn { .. }))
}

fn kept(graph: &Graph, steps: Vec<Step>, results: &[NodeId], may_go: fn(&Step) -> bool) -> Vec<Step> {
    let mut wanted: BTreeSet<SymbolId> = graph.symbols_of(results).into_iter().collect();
    let mut kept = Vec::new();
    for step in steps.into_iter().rev() {
        let introduced = step.introduced();
        let is_wanted = introduced.is_empty() || introduced.iter().any(|symbol| wanted.contains(symbol));
        if is_wanted || !may_go(&step) {
            wanted.extend(graph.symbols_of(&step.nodes()));
            kept.push(step);
        }
    }
    kept.reverse();
    kept
}
