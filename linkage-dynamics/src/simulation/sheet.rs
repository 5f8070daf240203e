//! Positions of a motion near a change point, where [J A] loses rank.
//!
//! The positions of one motion form a smooth surface, its sheet; only [J A] is singular where another sheet crosses
//! it. So near the crossing the position q, the basis N of q' = N z' and the bias b of q'' = N z'' + b are not
//! computed from [J A] there: they are interpolated along a line of the independent coordinates z across the
//! crossing, from nodes on both sides of it where [J A] is regular. z includes the prescribed inputs.
//!
//! With one input there is one line, and all nodes are computed once. With V inputs the crossing has V - 1 dimensions,
//! and each position needs a line of its own, which is moved from a known one.

use super::frame::Frame;
use super::independent::Independent;
use super::motion::{Change, Choice, LEAST_PIVOT_RATIO, Motion};
use crate::{Coordinates, MotionError, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::{larger, same_signs};
use linkage_runtime::jacobian::Vector;
use linkage_runtime::{Column, Dim, Matrix, Mechanism, PerInput, Real, real};

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

/// A line is moved until the crossing is nearer than this to x = 0.
const MAX_OFF_CENTRE: f64 = 0.02;

/// Bisections of the interpolated part, of length 0.85, to 1e-8 of it: an error of the zero counts with its square.
const BISECTIONS: usize = 26;

/// The most corrections of a line's centre: each reduces the distance to about its square.
const MAX_CENTRINGS: usize = 6;

/// The errors of interpolated values are measured at this x, between the nodes and the crossing, where [J A] is just
/// regular enough. At the crossing the polynomial of the nodes is three times as large as here.
const CHECKED: f64 = 0.17;
const GROWTH: f64 = 3.0;

/// The largest distance of a moved node from its first guess, divided by its distance from the crossing: the other
/// sheet is about as far away as the crossing.
const MAX_MOVE: f64 = 0.2;

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
        let mut q = terms.fold(Vector::zero(), |sum, (weight, node)| sum + node.q * weight);
        let z = self.centre + self.reach * x;
        for (&column, &value) in self.independent.free.iter().zip(&z) {
            q.set(column, value);
        }
        q
    }

    /// All values at x on the line, interpolated.
    pub(super) fn at(&self, x: T) -> Node<T, U, V> {
        let mut basis = (Matrix::zeros(), Matrix::zeros());
        let (mut bias, mut pivots) = (Vector::zero(), Column::zeros());
        for (weight, node) in weights(&ABSCISSAE, x).zip(&self.nodes) {
            basis = (basis.0 + node.basis.0 * weight, basis.1 + node.basis.1 * weight);
            bias = bias + node.bias * weight;
            pivots += node.pivots * weight;
        }
        Node { q: self.position(x), basis, bias, pivots }
    }

    /// True if these pivots have the signs of those on one side of the crossing: between the positions z has no dead
    /// point of its own.
    fn has_signs(&self, pivots: &Column<T, U>) -> bool {
        let has_those_of = |node: &Node<T, U, V>| same_signs(node.pivots.as_slice(), pivots.as_slice());
        has_those_of(&self.nodes[0]) || has_those_of(&self.nodes[NODES - 1])
    }

    /// True if [J A] with these pivots is regular enough to be used itself.
    pub(super) fn is_regular(&self, pivots: &Column<T, U>) -> bool {
        self.is_as_regular(T::one(), pivots)
    }

    /// True if the product of the pivots that vanish is this fraction of that at the edges, and no other pivot too small.
    /// Each of them alone may be smaller: where one is zero because of the order of elimination, another is infinite.
    fn is_as_regular(&self, least: T, pivots: &Column<T, U>) -> bool {
        let pairs = || pivots.iter().zip(&self.independent.pivots).zip(&self.vanishes);
        let vanishing = pairs().filter(|(_, vanishes)| **vanishes);
        let product = vanishing.fold(T::one(), |product, ((&pivot, &edge), _)| product * (pivot / edge).abs());
        let mut others = pairs().filter(|(_, vanishes)| !**vanishes);
        product >= least && others.all(|((pivot, edge), _)| pivot.abs() >= edge.abs() * real(LEAST_PIVOT_RATIO))
    }

    /// True if a position with these pivots is on the other side of the crossing than the first node.
    pub(super) fn is_beyond(&self, pivots: &Column<T, U>) -> bool {
        let first = &self.nodes[0].pivots;
        (0..U::COUNT).any(|pivot| self.vanishes[pivot] && pivots[pivot] * first[pivot] < T::zero())
    }

    /// Sets the pivots at the edges of the interpolated part from those of the nodes; returns true if each keeps its
    /// sign on both sides of the crossing, and at least one changes it there.
    pub(super) fn set_edges(&mut self) -> bool {
        let [before, after] = INTERPOLATED.map(|node| self.nodes[node].pivots);
        self.independent.pivots = before.zip_map(&after, |a, b| if b.abs() < a.abs() { b } else { a });
        self.vanishes = Column::from_fn(|pivot| before[pivot] * after[pivot] < T::zero());
        let keeps = |pivot: usize| {
            let half = NODES / 2;
            self.nodes.iter().enumerate().all(|(node, there)| {
                let own = if node < half { before[pivot] } else { after[pivot] };
                there.pivots[pivot] * own > T::zero()
            })
        };
        (0..U::COUNT).all(keeps) && self.vanishes.iter().any(|&vanishes| vanishes)
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
    fn crossing(&self) -> Option<T> {
        let [before, after] = INTERPOLATED.map(|node| self.nodes[node].pivots);
        let change = |pivot: usize| (after[pivot] - before[pivot]).abs();
        let all = (0..U::COUNT).filter(|&pivot| before[pivot] * after[pivot] < T::zero());
        all.reduce(|best, pivot| if change(pivot) > change(best) { pivot } else { best })
            .map(|pivot| self.zero_of(pivot))
    }
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// Computes a node at these z, by Newton's method from a guess; its bias is at the rates z'. `None` if the method
    /// does not converge, or if the position is farther from the guess than `most`, relative to the scales.
    pub(super) fn node(
        &self,
        independent: &Choice<S>,
        (z, guess): (&PerInput<S::Mechanism>, Change<S>),
        rates: &PerInput<S::Mechanism>,
        most: S::Scalar,
    ) -> Option<NodeOf<S>> {
        let mut guess = guess;
        for (&column, &value) in independent.free.iter().zip(z) {
            guess.set(column, value);
        }
        let there = S::Mechanism::coordinates(guess.unknowns, guess.inputs);
        let q = self.projected_in(independent, &there).ok()?;
        let correction = self.scaled_norm(&(Self::column(&q) - guess));
        // The comparison is false for NaN.
        let is_near = correction <= most;
        if !is_near {
            return None;
        }
        let factors = self.factors(independent, &q);
        Some(NodeOf::<S> {
            q: Self::column(&q),
            basis: factors.basis(),
            bias: self.bias(&factors, &q, rates),
            pivots: factors.pivots(),
        })
    }

    /// Computes the nodes of a sheet at its centre from guesses for their positions, and moves the centre along the
    /// line to the crossing. `None` if a node is farther from its guess than `most` times |x|, or if there is no
    /// crossing.
    pub(super) fn centre(&self, sheet: &mut SheetOf<S>, rates: &PerInput<S::Mechanism>, most: S::Scalar) -> Option<()> {
        for _ in 0..MAX_CENTRINGS {
            for (place, x) in ABSCISSAE.into_iter().enumerate() {
                let guess = (&sheet.z(place), sheet.nodes[place].q);
                sheet.nodes[place] = self.node(&sheet.independent, guess, rates, most * real(x.abs()))?;
            }
            let x = sheet.crossing()?;
            if x.abs() <= real(MAX_OFF_CENTRE) {
                return sheet.set_edges().then_some(());
            }
            let guesses = ABSCISSAE.map(|node| sheet.position(x + real(node)));
            sheet.centre += sheet.reach * x;
            for (node, guess) in sheet.nodes.iter_mut().zip(guesses) {
                node.q = guess;
            }
        }
        None
    }

    /// The sheet on the parallel line through z, with the biases of its nodes at the rates z'.
    pub(super) fn sheet_through(
        &self,
        sheet: &SheetOf<S>,
        z: &PerInput<S::Mechanism>,
        rates: &PerInput<S::Mechanism>,
    ) -> Option<SheetOf<S>> {
        let shift = *z - sheet.centre - sheet.reach * sheet.x(z);
        let mut moved = *sheet;
        moved.centre += shift;
        for node in &mut moved.nodes {
            let (unknowns, inputs) = &node.basis;
            node.q = node.q + Change::<S> { unknowns: *unknowns * shift, inputs: *inputs * shift };
        }
        let most = self.scaled_norm_of(&sheet.independent, &sheet.reach) * real(MAX_MOVE);
        self.centre(&mut moved, rates, most).map(|()| moved)
    }

    /// The largest change of independent coordinates divided by their scales.
    pub(super) fn scaled_norm_of(&self, independent: &Choice<S>, change: &PerInput<S::Mechanism>) -> S::Scalar {
        change.component_div(&independent.of(&self.scales.coordinates)).largest()
    }

    /// The frame at the coordinates z of `q`: exact where [J A] is regular and beyond the ends of the line, else
    /// interpolated.
    ///
    /// # Errors
    /// The change-point error where the sheet is not known, that of a singular J beyond a dead point of z.
    pub(super) fn frame_on(
        &self,
        sheet: &SheetOf<S>,
        q: &Coordinates<S>,
        rates: &PerInput<S::Mechanism>,
    ) -> Result<Frame<S>, MotionError> {
        let factors = self.factors(&sheet.independent, q);
        let pivots = factors.pivots();
        let has_signs = sheet.has_signs(&pivots);
        let exact = || self.exact_frame(&factors, q, rates);
        if sheet.is_regular(&pivots) {
            return if has_signs { Ok(exact()) } else { Err(self.singular_error(q)) };
        }
        let z = sheet.independent.of(&Self::column(q));
        let on = |line: &SheetOf<S>, factor: S::Scalar| {
            let x = line.x(&z);
            if x.abs() <= S::Scalar::one() {
                return Some(Self::interpolated(line, x, factor));
            }
            // A motion begins on its sheet before the line, where another change point may be near.
            (has_signs && line.is_as_regular(real(LEAST_PIVOT_RATIO), &pivots)).then(exact)
        };
        let frame = if S::V::COUNT == 1 {
            // There is one line.
            let speed = sheet.across.dot(rates);
            on(sheet, speed * speed)
        } else {
            self.sheet_through(sheet, &z, rates).and_then(|moved| on(&moved, S::Scalar::one()))
        };
        frame.ok_or_else(|| self.change_point_error(q))
    }

    /// The frame at x on the line of a sheet, with its bias times a factor.
    fn interpolated(sheet: &SheetOf<S>, x: S::Scalar, factor: S::Scalar) -> Frame<S> {
        let Node { q, basis, bias, .. } = sheet.at(x);
        let q = S::Mechanism::coordinates(q.unknowns, q.inputs);
        Frame { q, basis, bias: bias * factor, is_interpolated: true }
    }

    /// True if the motion is beyond the interpolated part and moves away from the crossing.
    pub(super) fn leaves(&self, sheet: &SheetOf<S>, y: &StateColumn<S>) -> bool {
        let (q, rates) = Self::unpack(y);
        let z = sheet.independent.of(&Self::column(&q));
        let x = sheet.x(&z);
        let is_leaving = x * sheet.across.dot(&rates) >= S::Scalar::zero();
        let is_beyond = || sheet.is_regular(&self.factors(&sheet.independent, &q).pivots());
        is_leaving && (x.abs() > S::Scalar::one() || is_beyond())
    }

    /// The errors of interpolated values, from exact ones between the nodes and the crossing.
    pub(super) fn errors_of(&self, sheet: &SheetOf<S>) -> Option<Errors<S::Scalar>> {
        let zero = S::Scalar::zero();
        let mut errors = Errors { position: zero, basis: zero, bias: zero };
        let scales = &self.scales.coordinates;
        let free = sheet.independent.of(scales);
        let reach = self.scaled_norm_of(&sheet.independent, &sheet.reach);
        for x in [-CHECKED, CHECKED] {
            let guess = sheet.at(real(x));
            let z = sheet.centre + sheet.reach * real(x);
            let exact = self.node(&sheet.independent, (&z, guess.q), &sheet.reach, reach * real(CHECKED))?;
            errors.position = larger(errors.position, self.scaled_norm(&(exact.q - guess.q)));
            for column in 0..S::V::COUNT {
                let [exact, guess] = [&exact, &guess].map(|node| Change::<S> {
                    unknowns: node.basis.0.column(column),
                    inputs: node.basis.1.column(column),
                });
                errors.basis = larger(errors.basis, self.scaled_norm(&(exact - guess)) * free[column]);
            }
            errors.bias = larger(errors.bias, self.scaled_norm(&(exact.bias - guess.bias)) / (reach * reach));
        }
        let grown = |error: S::Scalar| error * real(GROWTH);
        let Errors { position, basis, bias } = errors;
        Some(Errors { position: grown(position), basis: grown(basis), bias: grown(bias) })
    }
}
