//! The search for a change point ahead, where [J A] loses rank and no choice of coordinates is regular.
//!
//! The crossing is where the smallest pivot of [J A] falls through zero. The nodes of the [sheet](super::sheet) before it
//! are found from the current position, those beyond it one by one, each from the polynomial of all before it, so that
//! the branch beyond is the one whose tangent continues. The positions satisfy the constraints at the crossing to
//! rounding error: the branches cross and do not only come near each other. There the distance from the constraints
//! that no change of the coordinates removes has a saddle point, so that an error of the interpolated position counts
//! with its square only.

use super::frame::Change;
use super::independent::{Choice, FactorsOf};
use super::motion::Motion;
use super::sheet::{ABSCISSAE, Errors, NODES, NodeOf, Sheet, SheetOf, weights};
use crate::{Coordinates, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::jacobian::EliminationOf as Elimination;
use linkage_runtime::jacobian::ulp::nearly_zero;
use linkage_runtime::{Build, Dim, Mechanism, PerInput, real};

/// The largest residual at the change point, in ulps of the residual scales. At a quarter or four times this value all
/// simulation tests pass.
const CROSSING_ULPS: f64 = 256.0;

/// The half lengths of the lines across a change point, divided by the scales of the coordinates. On long ones the
/// polynomial has a larger error, on short ones rounding errors are larger: the first with an error below the tolerance
/// is taken, else the one with the least.
const HALF_LENGTHS: [f64; 9] = [0.5, 0.36, 0.25, 0.18, 0.125, 0.09, 0.06, 0.04, 0.025];

/// The shortest line, divided by the distance to the change point: its nodes are found from the current position.
const SHORTEST: f64 = 0.4;

/// The longest way from one position to the next by extrapolation.
const STRIDE: f64 = 0.25;

/// The largest distance of a node from its guess, divided by its distance from the crossing: the other sheet is about as
/// far away as the crossing.
const MAX_CORRECTION: f64 = 0.2;

/// The largest distance of a change point for which a sheet is built, in radians or divided by the scales of the
/// lengths, and the distance to which the motion approaches one that is farther away.
const REACH: f64 = 1.2;
const APPROACH: f64 = 0.9;

/// The longest way, along the motion, in which a change point is searched.
const SEARCH_RANGE: f64 = 3.0;

/// The largest estimated error of a sheet.
const MAX_ERROR: f64 = 1e-3;

/// The result of the search for a change point ahead.
#[allow(clippy::large_enum_variant, reason = "nothing is allocated, and one such value exists at a time")]
pub(super) enum Ahead<S: Scene> {
    /// No change point.
    Clear,
    /// Possibly one: the next step must be no longer than this.
    Near(S::Scalar),
    /// A change point, and the sheet that goes on through it.
    Sheet(SheetOf<S>),
}

/// A line of independent coordinates that begins at the current position.
struct Line<'a, S: Scene> {
    independent: &'a Choice<S>,
    start: NodeOf<S>,
    /// dz for each unit of length.
    along: PerInput<S::Mechanism>,
    /// The estimated distance to the crossing.
    distance: S::Scalar,
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// Looks for a change point ahead and builds the sheet through it; `direction` is 1 or -1, that of time, `tolerance`
    /// the relative tolerance of a step.
    pub(super) fn change_point_ahead(
        &self,
        independent: &Choice<S>,
        y: &StateColumn<S>,
        direction: S::Scalar,
        tolerance: S::Scalar,
    ) -> Ahead<S> {
        // At a change point forces in joints are infinite or undetermined, and with them these frictions.
        if self.scene.has_bearings() {
            return Ahead::Clear;
        }
        let (q, rates) = self.unpack(y);
        let factors = self.factors(independent, &q);
        let velocity = factors.rates(&rates);
        let speed = self.scaled_norm(&velocity);
        let pivots = &independent.pivots;
        let smaller = |least, at| if pivots[at].abs() < pivots[least].abs() { at } else { least };
        let smallest = (1..pivots.dim().count()).fold(0, smaller);
        let Some(line) = self.line_across(independent, &factors, &q, smallest) else { return Ahead::Clear };
        // The time until the pivot is zero, by linear extrapolation.
        let approach = self.across(independent, &line.along).dot(&rates);
        let length = line.distance / approach;
        let is_ahead = length * direction > S::Scalar::zero() && speed > S::Scalar::zero();
        // The comparisons are false for NaN.
        let is_near = (length * speed).abs() <= real(SEARCH_RANGE);
        if !(is_ahead && is_near) {
            return Ahead::Clear;
        }
        if line.distance > real(REACH) {
            return Ahead::Near(length.abs() * (S::Scalar::one() - real::<S::Scalar>(APPROACH) / line.distance));
        }
        self.sheet_across(&line, tolerance).map_or(Ahead::Near(length.abs() * real(0.5)), Ahead::Sheet)
    }

    /// dx/dz of a line with this dz/dx.
    fn across(&self, independent: &Choice<S>, along: &PerInput<S::Mechanism>) -> PerInput<S::Mechanism> {
        let scales = independent.of(&self.scales.coordinates);
        let size = along.component_div(&scales);
        size.component_div(&scales) * size.dot(&size).recip()
    }

    /// The line from `q` along which a pivot falls most steeply.
    fn line_across<'a>(
        &self,
        independent: &'a Choice<S>,
        factors: &FactorsOf<S>,
        q: &Coordinates<S>,
        pivot: usize,
    ) -> Option<Line<'a, S>> {
        let scales = independent.of(&self.scales.coordinates);
        let value = independent.pivots[pivot];
        let little = S::Scalar::default_epsilon().sqrt();
        let (unknowns, inputs) = factors.basis();
        let mut slope = scales.dim().zeros();
        for (column, slope) in slope.iter_mut().enumerate() {
            let step = scales[column] * little;
            let by = Change::<S> { unknowns: unknowns.column(column) * step, inputs: inputs.column(column) * step };
            *slope = (self.factors(independent, &Self::moved(q, &by)).pivots()[pivot] - value) / little;
        }
        let steepness = slope.norm();
        let distance = value.abs() / steepness;
        if !distance.is_finite() {
            return None;
        }
        let towards = if value > S::Scalar::zero() { -steepness.recip() } else { steepness.recip() };
        let along = slope.component_mul(&scales) * towards;
        let start = NodeOf::<S> {
            q: Self::column(q),
            basis: (unknowns, inputs),
            bias: self.bias(factors, q, &along),
            pivots: factors.pivots(),
        };
        Some(Line { independent, start, along, distance })
    }

    /// The sheet through the change point on a line.
    fn sheet_across(&self, line: &Line<S>, tolerance: S::Scalar) -> Option<SheetOf<S>> {
        let (mut best, mut is_shortest): (Option<(S::Scalar, S::Scalar)>, _) = (None, true);
        let mut sheet = self.unknown_sheet(line);
        for half in HALF_LENGTHS.map(real::<S::Scalar>) {
            // Nearer to the change point shorter lines are possible.
            is_shortest = half >= line.distance * real(SHORTEST);
            if !is_shortest {
                break;
            }
            if self.find_sheet(line, half, &mut sheet).is_none() {
                continue;
            }
            let error = sheet.errors.largest();
            if error <= tolerance {
                return Some(sheet);
            }
            if best.is_some_and(|(least, _)| least <= error) {
                break;
            }
            best = Some((error, half));
        }
        let (error, half) = best?;
        let is_enough = error <= real(MAX_ERROR) && is_shortest;
        (is_enough && self.find_sheet(line, half, &mut sheet).is_some()).then_some(sheet)
    }

    /// A sheet whose nodes are all at the current position.
    fn unknown_sheet(&self, line: &Line<S>) -> SheetOf<S> {
        let one = S::Scalar::one();
        Sheet {
            independent: *line.independent,
            vanishes: line.independent.pivots.dim().repeat(false),
            centre: line.independent.of(&line.start.q) + line.along * line.distance,
            reach: line.along,
            across: self.across(line.independent, &line.along),
            nodes: [line.start; NODES],
            errors: Errors { position: one, basis: one, bias: one },
        }
    }

    /// Finds the sheet through the change point with a line of this half length; `None` if there is none.
    // The sheet is large: it is not moved.
    fn find_sheet(&self, line: &Line<S>, half: S::Scalar, sheet: &mut SheetOf<S>) -> Option<()> {
        let Line { independent, start, along, distance } = line;
        let z = independent.of(&start.q);
        (sheet.centre, sheet.reach) = (z + *along * *distance, *along * half);
        sheet.across = self.across(independent, &sheet.reach);
        let reach = sheet.reach;
        let middle = NODES / 2;
        // Before the crossing each node is found from the nearest one, the first from the current position.
        let here = sheet.x(&z);
        let away = |node: usize| (here - real(ABSCISSAE[node])).abs();
        let first = (0..middle).reduce(|best, node| if away(node) < away(best) { node } else { best })?;
        sheet.nodes[first] = self.reached(sheet, (here, start), first, half)?;
        for node in (0..first).rev() {
            sheet.nodes[node] = self.reached(sheet, (real(ABSCISSAE[node + 1]), &sheet.nodes[node + 1]), node, half)?;
        }
        for node in first + 1..middle {
            sheet.nodes[node] = self.reached(sheet, (real(ABSCISSAE[node - 1]), &sheet.nodes[node - 1]), node, half)?;
        }
        // Beyond it from the polynomial of all nodes before.
        for node in middle..NODES {
            let x = real::<S::Scalar>(ABSCISSAE[node]);
            let known = weights(&ABSCISSAE[..node], x).zip(&sheet.nodes);
            let guess = known.fold(Change::<S>::zero(self.dims()), |sum, (weight, node)| sum + node.q * weight);
            let most = half * x * real(MAX_CORRECTION);
            sheet.nodes[node] = self.node(independent, (&sheet.z(node), guess), &reach, most)?;
        }
        self.centre(sheet, &reach, half * real(MAX_CORRECTION))?;
        if !self.is_crossing(sheet) {
            return None;
        }
        sheet.errors = self.errors_of(sheet)?;
        Some(())
    }

    /// The node reached from a known position at x, in strides, each by its tangent and curvature.
    fn reached(
        &self,
        sheet: &SheetOf<S>,
        (x, from): (S::Scalar, &NodeOf<S>),
        node: usize,
        half: S::Scalar,
    ) -> Option<NodeOf<S>> {
        let way = real::<S::Scalar>(ABSCISSAE[node]) - x;
        let mut strides = 1.0;
        while (way * half).abs() > real(STRIDE * strides) {
            strides += 1.0;
        }
        let stride = way / real(strides);
        let (mut here, mut taken) = (*from, 0.0);
        while taken < strides {
            taken += 1.0;
            // At the end z is exactly that of the node.
            let z =
                if taken < strides { sheet.centre + sheet.reach * (x + stride * real(taken)) } else { sheet.z(node) };
            let (unknowns, inputs) = &here.basis;
            let by = sheet.reach * stride;
            let guess = here.q
                + Change::<S> { unknowns: *unknowns * by, inputs: *inputs * by }
                + here.bias * (stride * stride * real(0.5));
            let most = half * stride.abs();
            here = self.node(&sheet.independent, (&z, guess), &sheet.reach, most)?;
        }
        Some(here)
    }

    /// True if the sheet satisfies the constraints at each of its crossings to rounding error: the largest residual there
    /// that no change of the coordinates removes to first order, the product of the left null vectors and the residual,
    /// divided by its scale.
    fn is_crossing(&self, sheet: &SheetOf<S>) -> bool {
        let mechanism = self.scene.mechanism();
        let mut crossings = (0..sheet.vanishes.dim().count()).filter(|&pivot| sheet.vanishes[pivot]);
        crossings.all(|pivot| {
            let q = sheet.position(sheet.zero_of(pivot));
            let pose = mechanism.pose_at(&S::Mechanism::coordinates(q.unknowns, q.inputs));
            let jacobian = self.scales.jacobian(mechanism, &pose);
            let residual = mechanism.residual(&pose).component_div(&self.scales.residuals);
            let order = &sheet.independent.order;
            let unresolved = Elimination::<S::Mechanism>::in_order_above(nearly_zero(), order, jacobian)
                .left_null_product(&residual)
                .largest();
            unresolved <= S::Scalar::default_epsilon() * real(CROSSING_ULPS)
        })
    }
}
