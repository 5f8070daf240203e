//! Positions of a motion near a change point, where [J A] loses rank.
//!
//! The positions of one motion form a smooth surface, its sheet; only [J A] is singular where another sheet crosses
//! it. So near the crossing the position q, the basis N of `q' = N z'` and the bias b of `q'' = N z'' + b` are not
//! computed from [J A] there: they are interpolated along a line of the independent coordinates z across the
//! crossing, from nodes on both sides of it where [J A] is regular. z includes the prescribed inputs.
//!
//! With one input there is one line, and all nodes are computed once. With V inputs the crossing has V - 1 dimensions,
//! and each position needs a line of its own, which is moved from a known one.

use super::independent::{Independent, LEAST_PIVOT_RATIO};
use crate::Scene;
use linkage_runtime::__shared::same_signs;
use linkage_runtime::jacobian::Vector;
use linkage_runtime::{Build, Column, Dim, Matrix, Real, real};

/// The number of nodes.
pub(super) const NODES: usize = 12;

/// The nodes x on the line, from -1 to 1: the Chebyshev nodes of two intervals, -1 to -0.2 and 0.2 to 1. Their squares
/// are those of 0.04 to 1. An error of the values at the nodes is 6.2 times as large at the crossing, x = 0; with nodes
/// from 0.1 on it is 3 times as large, but the values themselves have errors of 1 / x^3 there.
pub(super) const ABSCISSAE: [f64; NODES] = [
    -0.991_788_483_810_309_6,
    -0.927_044_365_157_106_6,
    -0.802_641_353_064_499_1,
    -0.629_100_038_428_539_7,
    -0.424_957_344_954_122_7,
    -0.237_393_351_594_452_38,
    0.237_393_351_594_452_38,
    0.424_957_344_954_122_7,
    0.629_100_038_428_539_7,
    0.802_641_353_064_499_1,
    0.927_044_365_157_106_6,
    0.991_788_483_810_309_6,
];

/// Nearer to the crossing than the nodes at 0.425, values are interpolated; farther away [J A] is regular enough.
const INTERPOLATED: [usize; 2] = [4, 7];

/// Bisections of the interpolated part, of length 0.85, to 1e-8 of it: an error of the zero counts with its square.
const BISECTIONS: usize = 26;

/// A position, the basis N and the bias.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node<T: Real, U: Dim, V: Dim> {
    pub(super) q: Vector<T, U, V>,
    /// The rows of N of the unknowns and of the inputs.
    pub(super) basis: (Matrix<T, U, V>, Matrix<T, V, V>),
    /// b at given rates.
    pub(super) bias: Vector<T, U, V>,
    /// The pivots of [J A].
    pub(super) pivots: Column<T, U>,
}

/// The estimated errors of interpolated values, nondimensional.
#[derive(Debug, Clone, Copy)]
pub(super) struct Errors<T> {
    /// The error of q divided by the scales.
    pub(super) position: T,
    /// The error of N.
    pub(super) basis: T,
    /// The error of b divided by the squares of the rates.
    pub(super) bias: T,
}

impl<T: Real> Errors<T> {
    pub(super) fn largest(&self) -> T {
        self.position.max(self.basis).max(self.bias)
    }
}

/// A sheet near a change point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheet<T: Real, U: Dim, V: Dim> {
    /// z and the order of elimination, with the pivots at the nodes around the interpolated part.
    pub(super) independent: Independent<T, U, V>,
    /// True for each pivot that changes its sign.
    pub(super) vanishes: Column<bool, U>,
    /// z at x = 0.
    pub(super) centre: Column<T, V>,
    /// dz/dx.
    pub(super) reach: Column<T, V>,
    /// dx/dz.
    pub(super) across: Column<T, V>,
    /// The nodes; their bias is at x' = 1.
    pub(super) nodes: [Node<T, U, V>; NODES],
    pub(super) errors: Errors<T>,
}

/// The sheet of a scene.
pub(super) type SheetOf<S> = Sheet<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;
/// A node of the sheet of a scene.
pub(super) type NodeOf<S> = Node<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;

/// The Lagrange basis polynomials of the first nodes of a line, at x.
pub(super) fn weights<T: Real>(abscissae: &[f64], x: T) -> impl Iterator<Item = T> + '_ {
    abscissae.iter().enumerate().map(move |(own, &node)| {
        let others = abscissae.iter().enumerate().filter(move |(other, _)| *other != own);
        others.fold(T::one(), |product, (_, &other)| product * (x - real(other)) / real(node - other))
    })
}

impl<T: Real, U: Dim, V: Dim> Sheet<T, U, V> {
    /// The coordinate x along the line of the point nearest to z.
    pub(super) fn x(&self, z: &Column<T, V>) -> T {
        self.across.dot(&(*z - self.centre))
    }

    /// z at a node.
    pub(super) fn z(&self, node: usize) -> Column<T, V> {
        self.centre + self.reach * real(ABSCISSAE[node])
    }

    /// q at x on the line, interpolated.
    pub(super) fn position(&self, x: T) -> Vector<T, U, V> {
        let terms = weights(&ABSCISSAE, x).zip(&self.nodes);
        let mut q = terms.fold(Vector::zero(self.nodes[0].q.dims()), |sum, (weight, node)| sum + node.q * weight);
        let z = self.centre + self.reach * x;
        for (&column, &value) in self.independent.free.iter().zip(&z) {
            q.set(column, value);
        }
        q
    }

    /// All values at x on the line, interpolated.
    pub(super) fn at(&self, x: T) -> Node<T, U, V> {
        let (u, v) = self.nodes[0].q.dims();
        let mut basis = (u.zero_matrix(v), v.zero_matrix(v));
        let (mut bias, mut pivots) = (Vector::zero((u, v)), u.zeros());
        for (weight, node) in weights(&ABSCISSAE, x).zip(&self.nodes) {
            basis = (basis.0 + node.basis.0 * weight, basis.1 + node.basis.1 * weight);
            bias = bias + node.bias * weight;
            pivots += node.pivots * weight;
        }
        Node { q: self.position(x), basis, bias, pivots }
    }

    /// True if these pivots have the signs of those on one side of the crossing: between the positions z has no dead
    /// point of its own.
    pub(super) fn has_signs(&self, pivots: &Column<T, U>) -> bool {
        let has_those_of = |node: &Node<T, U, V>| same_signs(node.pivots.as_slice(), pivots.as_slice());
        has_those_of(&self.nodes[0]) || has_those_of(&self.nodes[NODES - 1])
    }

    /// True if [J A] with these pivots is regular enough to be used itself.
    pub(super) fn is_regular(&self, pivots: &Column<T, U>) -> bool {
        self.is_as_regular(T::one(), pivots)
    }

    /// True if the product of the pivots that vanish is this fraction of that at the edges, and no other pivot too small.
    /// Each of them alone may be smaller: where one is zero because of the order of elimination, another is infinite.
    pub(super) fn is_as_regular(&self, least: T, pivots: &Column<T, U>) -> bool {
        let pairs = || pivots.iter().zip(&self.independent.pivots).zip(&self.vanishes);
        let vanishing = pairs().filter(|(_, vanishes)| **vanishes);
        let product = vanishing.fold(T::one(), |product, ((&pivot, &edge), _)| product * (pivot / edge).abs());
        let mut others = pairs().filter(|(_, vanishes)| !**vanishes);
        product >= least && others.all(|((pivot, edge), _)| pivot.abs() >= edge.abs() * real(LEAST_PIVOT_RATIO))
    }

    /// The largest of the pivots that vanish, at the edges of the interpolated part.
    pub(super) fn vanishing_edge(&self) -> T {
        let vanishing = self.independent.pivots.iter().zip(&self.vanishes).filter(|(_, vanishes)| **vanishes);
        vanishing.fold(T::zero(), |largest, (pivot, _)| largest.max(pivot.abs()))
    }

    /// True if a position with these pivots is on the other side of the crossing than the first node.
    pub(super) fn is_beyond(&self, pivots: &Column<T, U>) -> bool {
        let first = &self.nodes[0].pivots;
        (0..pivots.dim().count()).any(|pivot| self.vanishes[pivot] && pivots[pivot] * first[pivot] < T::zero())
    }

    /// Sets the pivots at the edges of the interpolated part from those of the nodes; returns true if each keeps its
    /// sign on both sides of the crossing, and at least one changes it there.
    pub(super) fn set_edges(&mut self) -> bool {
        let [before, after] = INTERPOLATED.map(|node| self.nodes[node].pivots);
        self.independent.pivots = before.zip_map(&after, |a, b| if b.abs() < a.abs() { b } else { a });
        self.vanishes = before.dim().column(|pivot| before[pivot] * after[pivot] < T::zero());
        let keeps = |pivot: usize| {
            let half = NODES / 2;
            self.nodes.iter().enumerate().all(|(node, there)| {
                let own = if node < half { before[pivot] } else { after[pivot] };
                there.pivots[pivot] * own > T::zero()
            })
        };
        (0..before.dim().count()).all(keeps) && self.vanishes.iter().any(|&vanishes| vanishes)
    }

    /// The zero on the line of a pivot that vanishes, by interpolation.
    pub(super) fn zero_of(&self, pivot: usize) -> T {
        let value = |x: T| {
            weights(&ABSCISSAE, x).zip(&self.nodes).fold(T::zero(), |sum, (w, node)| sum + node.pivots[pivot] * w)
        };
        let mut ends = INTERPOLATED.map(|node| real::<T>(ABSCISSAE[node]));
        let is_rising = self.nodes[INTERPOLATED[1]].pivots[pivot] > T::zero();
        for _ in 0..BISECTIONS {
            let middle = (ends[0] + ends[1]) * real(0.5);
            let is_before = (value(middle) < T::zero()) == is_rising;
            ends[usize::from(!is_before)] = middle;
        }
        (ends[0] + ends[1]) * real(0.5)
    }

    /// The zero of the vanishing pivot with the largest slope; `None` if no pivot vanishes.
    pub(super) fn crossing(&self) -> Option<T> {
        let [before, after] = INTERPOLATED.map(|node| self.nodes[node].pivots);
        let change = |pivot: usize| (after[pivot] - before[pivot]).abs();
        let all = (0..before.dim().count()).filter(|&pivot| before[pivot] * after[pivot] < T::zero());
        all.reduce(|best, pivot| if change(pivot) > change(best) { pivot } else { best })
            .map(|pivot| self.zero_of(pivot))
    }
}
