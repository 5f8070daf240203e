//! The steps of a solution: names, checks and linear or nonlinear solves, in order.

use std::collections::BTreeSet;

use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::BlockId;

/// One step of a solution. Later steps refer to its results by their symbols.
#[derive(Debug, Clone)]
pub enum Step {
    /// Names a value.
    Let { symbol: SymbolId, node: NodeId },
    /// Names an angle: its principal value plus a given number of turns.
    Turn { symbol: SymbolId, principal: NodeId },
    /// Fails if a determinant is zero relative to `scale`.
    Guard { block: BlockId, determinant: NodeId, scale: NodeId },
    /// Factorises the matrix of a block, given by rows with their scales; fails if it is singular.
    Factor { block: BlockId, matrix: Vec<Vec<NodeId>>, row_scales: Vec<NodeId> },
    /// Solves the factorised system of a block and names the solution.
    Solve { block: BlockId, targets: Vec<SymbolId>, right: Vec<NodeId> },
    /// Names the square root of a product of two factors, with the sign of the branch; fails if a factor is negative by
    /// more than the rounding error of its terms. `size` is n of the factors n - h and n + h, or (p + q)^2 of a
    /// triangle.
    Chord { block: BlockId, symbol: SymbolId, factors: [NodeId; 2], size: NodeId, of: ChordGeometry<NodeId> },
    /// Fails if the determinant of linear unknowns is zero; `numerators` are their numerators by Cramer's rule,
    /// `scales` the sums of the magnitudes of the terms of each numerator.
    Solvable { block: BlockId, determinant: NodeId, numerators: Vec<NodeId>, scales: Vec<NodeId> },
    /// Names the unknowns of a block, found by Newton's method from `start`. `system` holds its residuals, their scales
    /// and its Jacobian by rows, in terms of the unknowns and of `known`.
    Newton { block: BlockId, targets: Vec<SymbolId>, start: Vec<NodeId>, known: Vec<NodeId>, system: Vec<NodeId> },
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
}

impl<V: Copy> ChordGeometry<V> {
    fn values(&self) -> Vec<V> {
        match *self {
            Self::Triangle { links: [p, q], line: [x, y], distance_squared, scale } => {
                vec![p, q, x, y, distance_squared, scale]
            }
            Self::Circle { scales, .. } => scales.to_vec(),
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
            Self::Solve { targets, .. } | Self::Newton { targets, .. } => targets.clone(),
            Self::Guard { .. } | Self::Factor { .. } | Self::Solvable { .. } => Vec::new(),
        }
    }

    /// The expressions of a step.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeId> {
        match self {
            Self::Let { node, .. } => vec![*node],
            Self::Turn { principal, .. } => vec![*principal],
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
        }
    }
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
