//! A motion on its sheet: nodes, the line through a position, and the error of what is interpolated.

use super::frame::{Change, Frame};
use super::independent::{Choice, LEAST_PIVOT_RATIO};
use super::motion::Motion;
use super::sheet::{ABSCISSAE, Errors, Node, NodeOf, SheetOf};
use crate::{Coordinates, MotionErrorOf, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::larger;
use linkage_runtime::{D, Dim, Mechanism, PerInput, real};

/// A line is moved until the crossing is nearer than this to x = 0.
const MAX_OFF_CENTRE: f64 = 0.02;

/// The most corrections of a line's centre: each reduces the distance to about its square.
const MAX_CENTRINGS: usize = 6;

/// The errors of interpolated values are measured at this x, between the nodes and the crossing, where [J A] is just
/// regular enough. At the crossing the polynomial of the nodes is three times as large as here.
const CHECKED: f64 = 0.17;
const GROWTH: f64 = 3.0;

/// The largest distance of a moved node from its first guess, divided by its distance from the crossing: the other
/// sheet is about as far away as the crossing.
const MAX_MOVE: f64 = 0.2;

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
            let guesses = D::map(ABSCISSAE, |node| sheet.position(x + real(node)));
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
    ) -> Result<Frame<S>, MotionErrorOf<S>> {
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
        let frame = if rates.dim().count() == 1 {
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

    /// An interpolated position, corrected by one Newton step in the rows whose pivots do not vanish. In the others, whose
    /// residual is of second order in its error, the error of the interpolation stays.
    pub(super) fn corrected_on(&self, sheet: &SheetOf<S>, q: &Coordinates<S>) -> Coordinates<S> {
        let mechanism = self.scene.mechanism();
        let pose = mechanism.pose_at(q);
        let factors = sheet.independent.factors_above(sheet.vanishing_edge(), mechanism, &pose, &self.scales);
        Self::moved(q, &-factors.solve(&mechanism.residual(&pose)))
    }

    /// True if the motion is beyond the interpolated part and moves away from the crossing.
    pub(super) fn leaves(&self, sheet: &SheetOf<S>, y: &StateColumn<S>) -> bool {
        let (q, rates) = self.unpack(y);
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
            for column in 0..free.dim().count() {
                let along = |node: &NodeOf<S>| Change::<S> {
                    unknowns: node.basis.0.column(column),
                    inputs: node.basis.1.column(column),
                };
                let error = self.scaled_norm(&(along(&exact) - along(&guess)));
                errors.basis = larger(errors.basis, error * free[column]);
            }
            errors.bias = larger(errors.bias, self.scaled_norm(&(exact.bias - guess.bias)) / (reach * reach));
        }
        let grown = |error: S::Scalar| error * real(GROWTH);
        let Errors { position, basis, bias } = errors;
        Some(Errors { position: grown(position), basis: grown(basis), bias: grown(bias) })
    }
}
