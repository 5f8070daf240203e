//! Passing a change point, where [J A] loses rank and no choice of coordinates is regular.
//!
//! A motion straight through a change point is smooth; only [J A] is singular there. So it is passed in one step, which
//! does not evaluate the equations at the change point: collocation at eight Gauss nodes (order 16; Hairer, Norsett and
//! Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. (1993), theorem II.7.9). The length of the step is such
//! that the change point lies in its middle, between the fourth and the fifth node, the widest gap. The first four are
//! solved alone, and their polynomial is the first guess at all eight.
//!
//! The step is accepted if the polynomial satisfies the constraints at the nodes, so that the branch beyond is the one
//! whose tangent continues, and at the change point to rounding error, so that the branches cross and do not only come
//! near each other.

use core::convert::Infallible;

use super::motion::{Choice, Motion, Polynomial, Reduced};
use crate::integrate::Interpolant;
use crate::{MotionError, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::larger;
use linkage_runtime::jacobian::ulp::nearly_zero;
use linkage_runtime::jacobian::{EliminationOf as Elimination, root};
use linkage_runtime::{Column, Dim, Matrix, Mechanism, Real, real};

/// The Gauss nodes on [0, 1]: the zeros of the shifted Legendre polynomial of degree 8.
const NODES: [f64; 8] = [
    0.019_855_071_751_231_884,
    0.101_666_761_293_186_64,
    0.237_233_795_041_835_5,
    0.408_282_678_752_175_1,
    0.591_717_321_247_825,
    0.762_766_204_958_164_5,
    0.898_333_238_706_813_4,
    0.980_144_928_248_768_1,
];

/// The limit on fixed-point iterations of the collocation. Each reduces the error by about the step divided by the time
/// scale of the motion.
const MAX_ITERATIONS: usize = 40;

/// The iteration has converged if the change of the state at the end, divided by the largest component, is below this
/// many sqrt(epsilon) and stops shrinking. It never reaches epsilon: near a change point rounding error grows as
/// 1 / distance^2.
const CONVERGED_SQRT_EPSILONS: f64 = 0.01;

/// The largest distance of the change point from the middle, as a fraction of the step. At twice this value all
/// simulation tests pass; at half of it the one of a stop near a change point fails.
const MAX_OFF_MIDDLE: f64 = 0.03;

/// The largest residual at the change point, in ulps of the residual scales. At a quarter or four times this value all
/// simulation tests pass.
const CROSSING_ULPS: f64 = 256.0;

/// The largest distance of the polynomial from the constraints at the nodes, divided by the length of the step. At a
/// tenth or ten times this value all simulation tests pass.
const MAX_PROJECTION: f64 = 1e-3;

/// The longest step over a change point. Lengths of steps here are the largest change of a coordinate: in radians, or
/// divided by the scale of its length. At 1.25 times this value all simulation tests pass; at 0.75 times three fail,
/// crossed cranks among them.
const LONGEST_STEP: f64 = 1.2;

/// If the change point is too far for the longest step, the simulation approaches it until this step remains: not
/// nearer, since the relative rounding error grows as 1 / length^2.
const TARGET_STEP: f64 = 0.9;

/// The longest step for which a change point is searched; it lies in the middle of the step.
const SEARCH_RANGE: f64 = 3.0;

/// Steps below this length are not shortened for the accuracy of dense output.
const SHORTEST_STEP: f64 = 0.04;

/// The result of the search for a change point ahead.
pub(super) enum Ahead<T: Real, N: Dim> {
    /// No change point.
    Clear,
    /// Possibly one: the next step must be no longer than this.
    Near(T),
    /// A change point, and the step over it.
    ChangePoint(Interpolant<T, N>),
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// Computes the step over the change point ahead, if one is near; `direction` is 1 or -1, that of time, `tolerance`
    /// the relative tolerance of a step.
    pub(super) fn change_point_ahead(
        &self,
        independent: &Choice<S>,
        (t, y): (S::Scalar, &StateColumn<S>),
        direction: S::Scalar,
        tolerance: S::Scalar,
    ) -> Result<Ahead<S::Scalar, S::State>, MotionError> {
        // At a change point reactions are infinite or undetermined, and with them these frictions.
        if S::BEARINGS {
            return Ok(Ahead::Clear);
        }
        let (q, rates) = Self::unpack(y);
        let factors = self.factors(independent, &q);
        let velocity = factors.rates(&rates);
        let speed = self.scaled_norm(&velocity);
        let moves = speed > S::Scalar::zero();
        if !moves {
            return Ok(Ahead::Clear);
        }
        let pivots = &independent.pivots;
        let smaller = |least, at| if pivots[at].abs() < pivots[least].abs() { at } else { least };
        let smallest = (1..S::U::COUNT).fold(0, smaller);
        // Twice the time until the smallest pivot is zero, by linear extrapolation.
        let little = direction * S::Scalar::default_epsilon().sqrt() / speed;
        let later = Self::moved(&q, &(velocity * little));
        let change = self.factors(independent, &later).pivots()[smallest] - independent.pivots[smallest];
        let mut length = -independent.pivots[smallest] * little / change * real(2.0);
        let slope = self.rate_by(independent, &factors, (t, y))?;
        for _ in 0..3 {
            let turn = length * direction * speed;
            if !(turn > S::Scalar::zero() && turn <= real(SEARCH_RANGE)) {
                return Ok(Ahead::Clear);
            }
            if turn > real(LONGEST_STEP) {
                return Ok(Ahead::Near(
                    (length * real(0.5)).abs() * (S::Scalar::one() - real::<S::Scalar>(TARGET_STEP) / turn),
                ));
            }
            let nearer = Ahead::Near((length * real(0.25)).abs());
            let Some((step, gap)) = self.collocation(independent, (t, y), &slope, length) else { return Ok(nearer) };
            let Some(middle) = self.zero_of_pivot(independent, &step, smallest) else { return Ok(nearer) };
            let off = (middle - real(0.5)).abs();
            if off > real(MAX_OFF_MIDDLE) {
                length *= middle * real(2.0);
                continue;
            }
            let last = step.last();
            let (q_term, rates_term) = Self::unpack(&last);
            let q_term = self.scaled_norm(&Self::column(&q_term));
            let rates_term = rates_term.component_div(&independent.of(&self.scales.coordinates)).largest();
            // The error of dense output is estimated as 1e-5 times its last term.
            let error = larger(q_term, rates_term / speed) * real(1e-5);
            let is_exact = error <= tolerance.max(real(1e-9));
            if !is_exact && turn > real(SHORTEST_STEP) {
                return Ok(nearer);
            }
            let is_smooth = gap <= turn * real(MAX_PROJECTION);
            let is_crossing = self.unresolved_residual(independent, &step, middle)
                <= S::Scalar::default_epsilon() * real(CROSSING_ULPS);
            return Ok(if is_smooth && is_crossing { Ahead::ChangePoint(step) } else { nearer });
        }
        Ok(Ahead::Clear)
    }

    /// Solves the collocation equations; returns the polynomial and its largest distance from the constraints at the
    /// nodes.
    fn collocation(
        &self,
        independent: &Choice<S>,
        (t, y): (S::Scalar, &StateColumn<S>),
        slope: &StateColumn<S>,
        length: S::Scalar,
    ) -> Option<(Polynomial<S>, S::Scalar)> {
        let near = [NODES[0], NODES[1], NODES[2], NODES[3]];
        let guess = Interpolant::of_slopes((t, *y), length, &near, &[*slope; 4])?;
        let (guess, _) = self.iterated(independent, (t, y), length, &near, guess)?;
        self.iterated(independent, (t, y), length, &NODES, guess)
    }

    /// Solves the collocation equations at these nodes by fixed-point iteration from a guess.
    fn iterated<const P: usize>(
        &self,
        independent: &Choice<S>,
        (t, y): (S::Scalar, &StateColumn<S>),
        length: S::Scalar,
        nodes: &[f64; P],
        mut step: Polynomial<S>,
    ) -> Option<(Polynomial<S>, S::Scalar)> {
        let mut last: Option<S::Scalar> = None;
        for _ in 0..MAX_ITERATIONS {
            let mut slopes = [Column::zeros(); P];
            let mut gap = S::Scalar::zero();
            for (slope, &node) in slopes.iter_mut().zip(nodes) {
                let there = step.at_fraction(real(node));
                let (guess, rates) = Self::unpack(&there);
                let q = self.projected_in(independent, &guess).ok()?;
                gap = larger(gap, self.scaled_norm(&(Self::column(&q) - Self::column(&guess))));
                let (at, factors) = (t + length * real(node), self.factors(independent, &q));
                *slope = self.rate_by(independent, &factors, (at, &Self::pack(&q, &rates))).ok()?;
            }
            let next = Interpolant::of_slopes((t, *y), length, nodes, &slopes)?;
            let end = next.at_fraction(S::Scalar::one());
            let [change, size] = [end - step.at_fraction(S::Scalar::one()), end].map(|state| state.largest());
            let change = change / size;
            step = next;
            if !change.is_finite() {
                return None;
            }
            let small = change <= S::Scalar::default_epsilon().sqrt() * real(CONVERGED_SQRT_EPSILONS);
            if change.is_zero() || (small && last.is_some_and(|last| change >= last * real(0.5))) {
                return Some((step, gap));
            }
            last = Some(change);
        }
        None
    }

    /// M, Q and the contacts at a time within the step over a change point, where [J A] is nearly singular: they are
    /// smooth along the motion, so they are evaluated at the positions of the nodes, with the given time and rates, and
    /// interpolated.
    pub(super) fn equations_over(
        &self,
        independent: &Choice<S>,
        step: &Polynomial<S>,
        (t, y): (S::Scalar, &StateColumn<S>),
    ) -> Result<Reduced<S>, MotionError> {
        let (_, rates) = Self::unpack(y);
        let (start, end) = step.interval();
        let at = (t - start) / (end - start);
        let mut equations = self.contacts_alone(t, y)?;
        equations.mass = Matrix::zeros();
        for contact in &mut equations.contacts {
            contact.drift = S::Scalar::zero();
        }
        for node in NODES {
            let others = NODES.iter().filter(|&&other| other != node);
            // The Lagrange basis polynomial of this node.
            let weight =
                others.fold(S::Scalar::one(), |weight, &other| weight * (at - real(other)) / real(node - other));
            let (guess, _) = Self::unpack(&step.at_fraction(real(node)));
            let q = self.projected_in(independent, &guess)?;
            let factors = self.factors(independent, &q);
            let (there, _) = self.equations_by(independent, &factors, (t, &Self::pack(&q, &rates)))?;
            equations.mass += there.mass * weight;
            equations.forces += there.forces * weight;
            for (contact, there) in equations.contacts.iter_mut().zip(&there.contacts) {
                contact.row += there.row * weight;
                contact.drift += there.drift * weight;
                contact.bias += there.bias * weight;
            }
        }
        Ok(equations)
    }

    /// The fraction of the step at which a pivot is zero.
    fn zero_of_pivot(&self, independent: &Choice<S>, step: &Polynomial<S>, pivot: usize) -> Option<S::Scalar> {
        let value = |s: S::Scalar| self.factors(independent, &Self::unpack(&step.at_fraction(s)).0).pivots()[pivot];
        let ends = [S::Scalar::zero(), S::Scalar::one()];
        let [at_start, at_end] = ends.map(value);
        let changes = at_start * at_end < S::Scalar::zero();
        let look = |s| Ok::<_, Infallible>(Some(value(s)).filter(S::Scalar::is_finite));
        let Ok(zero) = root(ends, [at_start, at_end], S::Scalar::default_epsilon(), look);
        zero.filter(|_| changes)
    }

    /// The largest residual at the change point that no change of the coordinates removes to first order: the product
    /// of the left null vectors and the residual, divided by its scale.
    fn unresolved_residual(&self, independent: &Choice<S>, step: &Polynomial<S>, middle: S::Scalar) -> S::Scalar {
        let mechanism = self.scene.mechanism();
        let pose = mechanism.pose_at(&Self::unpack(&step.at_fraction(middle)).0);
        let jacobian = self.scales.jacobian(mechanism, &pose);
        let residual = mechanism.residual(&pose).component_div(&self.scales.residuals);
        Elimination::<S::Mechanism>::in_order_above(nearly_zero(), &independent.order, jacobian)
            .left_null_product(&residual)
            .largest()
    }
}
