//! A scene as a system of differential equations: its coordinates, velocities, states, and projection onto the
//! constraints.

use super::corners::Corners;
use super::frame::{Change, Frame};
use super::independent::{Choice, FactorsOf, Independent, LEAST_PIVOT_RATIO};
use super::sheet::Sheet;
use super::state::{State, Touch};
use super::watch::Unwatched;
use crate::contact::{Contacts, ReducedEquations};
use crate::integrate::Interpolant;
use crate::{Coordinates, MotionErrorOf, NameOf, Scene, StateColumn, StateParts};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::{all_finite, smallest};
use linkage_runtime::held::Held;
use linkage_runtime::jacobian::ulp::nearly_zero;
use linkage_runtime::jacobian::{Elimination, Iteration, Jacobian, ScalesOf, contract, correction};
use linkage_runtime::{Build, Column, D, Dim, Mechanism, Name, PerInput, Real, newton, real};

/// The parametrisation of a scene.
pub(super) type ParametrisationOf<S> = Parametrisation<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;
/// The states of a scene within a step.
pub(super) type Polynomial<S> = Interpolant<<S as Scene>::Scalar, <S as Scene>::State>;
/// The equations of motion of a scene in independent coordinates.
pub(super) type Reduced<S> = ReducedEquations<<S as Scene>::Scalar, <S as Scene>::V, <S as Scene>::Contacts, NameOf<S>>;
/// The pose of a scene's mechanism.
type PoseOf<S> = <<S as Scene>::Mechanism as Mechanism>::Pose;
/// A choice of coordinates other than the inputs, and the frame at a position.
pub(super) type ChosenFrame<'a, S> = Option<(&'a Choice<S>, Frame<S>)>;
/// The choice of coordinates in which the motion is integrated.
#[allow(clippy::large_enum_variant, reason = "nothing is allocated, and one such value exists at a time")]
#[derive(Debug, Clone, Copy)]
pub(super) enum Parametrisation<T: Real, U: Dim, V: Dim> {
    /// The inputs, by the emitted equations.
    Inputs,
    /// Other coordinates.
    Others(Independent<T, U, V>),
    /// Other coordinates, on a sheet through a change point.
    Over(Sheet<T, U, V>),
}

impl<T: Real, U: Dim, V: Dim> Parametrisation<T, U, V> {
    /// The choice of coordinates other than the inputs.
    pub(super) fn independent(&self) -> Option<&Independent<T, U, V>> {
        match self {
            Self::Inputs => None,
            Self::Others(independent) | Self::Over(Sheet { independent, .. }) => Some(independent),
        }
    }
}

/// The limit on Newton iterations of the projection onto the constraints after a step: mostly one is needed; near a
/// change point, where each at first only halves the error, a dozen.
const MAX_CORRECTIONS: usize = 16;

/// After a Newton step shorter than this many sqrt(epsilon) the error is below one ulp, by quadratic convergence.
const LAST_CORRECTION_SQRT_EPSILONS: f64 = 1e-3;

/// A scene as a [`System`](crate::integrate::System) for an integrator.
#[derive(Debug, Clone)]
pub struct Motion<'a, S: Scene, W> {
    pub(super) scene: Held<'a, S>,
    pub(super) watch: W,
    pub(super) scales: ScalesOf<S::Mechanism>,
    pub(super) parametrisation: ParametrisationOf<S>,
    pub(super) contacts: Contacts<S::Scalar, S::Contacts>,
    pub(super) names: Column<NameOf<S>, S::Contacts>,
    /// The largest estimated errors of interpolated y' since they were last asked for.
    pub(super) uncertainty: Option<StateColumn<S>>,
    pub(super) corners: Corners<S::Scalar, NameOf<S>>,
}

impl<'a, S: Scene> Motion<'a, S, Unwatched> {
    /// Starts in the inputs, with all contacts open. The motion is from the first to the second time.
    pub(super) fn new(scene: Held<'a, S>, scales: ScalesOf<S::Mechanism>, [start, end]: [S::Scalar; 2]) -> Self {
        let count = scene.contact_count();
        let (contacts, names) = (Contacts::open(count), count.repeat(Name::from_static("")));
        let (parametrisation, uncertainty, corners) = (Parametrisation::Inputs, None, Corners::new(start, end));
        Self { scene, watch: Unwatched, scales, parametrisation, contacts, names, uncertainty, corners }
    }
}

impl<'a, S: Scene, W> Motion<'a, S, W> {
    /// Replaces the user's events.
    pub(super) fn watched<W2>(self, watch: W2) -> Motion<'a, S, W2> {
        let Self { scene, scales, parametrisation, contacts, names, uncertainty, corners, .. } = self;
        Motion { scene, watch, scales, parametrisation, contacts, names, uncertainty, corners }
    }

    /// The numbers of unknowns and inputs.
    #[inline]
    pub(super) fn dims(&self) -> (S::U, S::V) {
        let (u, v, _) = self.scene.mechanism().dims();
        (u, v)
    }

    /// Packs a position and the rates of the independent coordinates into y.
    pub(super) fn pack(&self, q: &Coordinates<S>, rates: &PerInput<S::Mechanism>) -> StateColumn<S> {
        self.scene.state_of(q, &(*rates).into())
    }

    pub(super) fn unpack(&self, y: &StateColumn<S>) -> (Coordinates<S>, PerInput<S::Mechanism>) {
        let StateParts { q, input_rates } = self.scene.parts_of(y);
        (q, input_rates.into())
    }

    /// True for each prescribed input.
    pub(super) fn prescribed_inputs(&self, t: S::Scalar) -> Column<bool, S::V> {
        self.scene.prescribed(t).map(|law| law.is_some())
    }

    /// Returns the factors of [J A] if no pivot is too small.
    pub(super) fn regular(&self, independent: &Choice<S>, q: &Coordinates<S>) -> Option<FactorsOf<S>> {
        let factors = self.factors(independent, q);
        (smallest(factors.pivots().iter().copied()) > independent.regularity() * real(LEAST_PIVOT_RATIO))
            .then_some(factors)
    }

    /// The choice of coordinates other than the inputs, and the frame at a position; `None` in the inputs.
    ///
    /// # Errors
    /// The change-point error if [J A] is nearly singular and the position is on no known sheet.
    pub(super) fn frame(
        &self,
        q: &Coordinates<S>,
        rates: &PerInput<S::Mechanism>,
    ) -> Result<ChosenFrame<'_, S>, MotionErrorOf<S>> {
        match &self.parametrisation {
            Parametrisation::Inputs => Ok(None),
            Parametrisation::Others(independent) => {
                let factors = self.regular(independent, q).ok_or_else(|| self.change_point_error(q))?;
                Ok(Some((independent, self.exact_frame(&factors, q, rates))))
            }
            Parametrisation::Over(sheet) => Ok(Some((&sheet.independent, self.frame_on(sheet, q, rates)?))),
        }
    }

    /// A position as columns.
    pub(super) fn column(q: &Coordinates<S>) -> Change<S> {
        let (unknowns, inputs) = S::Mechanism::parts(q);
        Change::<S> { unknowns, inputs }
    }

    pub(super) fn moved(q: &Coordinates<S>, change: &Change<S>) -> Coordinates<S> {
        let there = Self::column(q) + *change;
        S::Mechanism::coordinates(there.unknowns, there.inputs)
    }

    /// The largest change divided by the scale of its coordinate; for rates, an angular frequency.
    pub(super) fn scaled_norm(&self, change: &Change<S>) -> S::Scalar {
        change.relative_to(&self.scales.coordinates).largest()
    }

    /// u' and v'.
    pub(super) fn velocity(&self, y: &StateColumn<S>) -> Result<Change<S>, MotionErrorOf<S>> {
        let (q, rates) = self.unpack(y);
        let mechanism = self.scene.mechanism();
        match &self.parametrisation {
            Parametrisation::Inputs => {
                let pose = mechanism.pose_at(&q);
                let right = mechanism.jacobian_inputs(&pose) * -rates;
                Ok(Change::<S> { unknowns: mechanism.solve_jacobian(&pose, &right)?, inputs: rates })
            }
            Parametrisation::Others(independent) => Ok(self.factors(independent, &q).rates(&rates)),
            Parametrisation::Over(sheet) => Ok(self.frame_on(sheet, &q, &rates)?.rates(&rates)),
        }
    }

    /// Packs a position and the rates of the inputs into y.
    pub(super) fn with_input_rates(
        &self,
        q: &Coordinates<S>,
        rates: &PerInput<S::Mechanism>,
    ) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        match &self.parametrisation {
            Parametrisation::Inputs => Ok(self.pack(q, rates)),
            Parametrisation::Others(independent) => {
                let mechanism = self.scene.mechanism();
                let pose = mechanism.pose_at(q);
                let right = mechanism.jacobian_inputs(&pose) * -*rates;
                let rates = Change::<S> { unknowns: mechanism.solve_jacobian(&pose, &right)?, inputs: *rates };
                Ok(self.pack(q, &independent.of(&rates)))
            }
            Parametrisation::Over(sheet) => {
                // v' = N_v z'.
                let (_, inputs) = self.frame_on(sheet, q, &rates.dim().zeros())?.basis;
                let jacobian =
                    Jacobian::<S::Scalar, S::V, D<0>> { unknowns: inputs, inputs: rates.dim().zero_matrix(D) };
                let elimination = Elimination::new(jacobian);
                let is_regular = elimination.regularity() > nearly_zero();
                if !is_regular {
                    return Err(self.singular_error(q));
                }
                Ok(self.pack(q, &elimination.solve(rates).unknowns))
            }
        }
    }

    pub(super) fn state(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<State<S>, MotionErrorOf<S>> {
        let (q, _) = self.unpack(y);
        let Change::<S> { unknowns, inputs } = self.velocity(y)?;
        let time = [t];
        let all = time.iter().chain(y.iter()).chain(unknowns.iter()).chain(inputs.iter());
        all_finite(self.scene.name(), Name::from_static("the state"), all)?;
        let rates = S::Mechanism::rates(unknowns, inputs);
        let touch = |place: usize| Touch { name: self.names[place], mode: self.contacts.modes[place], change: None };
        Ok(State { t, q, rates, event: None, kink: None, contacts: self.names.dim().column(touch) })
    }

    /// Projects y onto the constraints, with prescribed inputs set to their laws.
    pub(super) fn projected(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        let (mut q, mut rates) = self.unpack(y);
        let laws = self.prescribed(t);
        let mut inputs = S::Mechanism::inputs(&q);
        for (input, law) in laws.iter().enumerate() {
            if let Some(law) = law {
                inputs[input] = law.value;
                let place = |independent: &Choice<S>| {
                    independent.free.iter().position(|&free| free == self.dims().0.count() + input)
                };
                let at = self.parametrisation.independent().map_or(Some(input), place);
                if let Some(at) = at {
                    rates[at] = law.rate;
                }
            }
        }
        if laws.iter().any(Option::is_some) {
            q = S::Mechanism::with_inputs(&q, inputs);
        }
        let q = match &self.parametrisation {
            Parametrisation::Inputs => self.projected_in_inputs(&q)?,
            Parametrisation::Others(independent) => self.projected_in(independent, &q)?,
            Parametrisation::Over(sheet) => {
                let Frame { q, is_interpolated, .. } = self.frame_on(sheet, &q, &rates)?;
                if is_interpolated { self.corrected_on(sheet, &q) } else { self.projected_in(&sheet.independent, &q)? }
            }
        };
        Ok(self.pack(&q, &rates))
    }

    /// Projects `q` with the same inputs. Mostly one Newton step suffices.
    fn projected_in_inputs(&self, q: &Coordinates<S>) -> Result<Coordinates<S>, MotionErrorOf<S>> {
        let mechanism = self.scene.mechanism();
        let enough = S::Scalar::default_epsilon().sqrt() * real(LAST_CORRECTION_SQRT_EPSILONS);
        let projected = self.newton_near(q, enough, |pose| {
            Ok(Some(Change::<S> { unknowns: correction(mechanism, pose)?, inputs: self.dims().1.zeros() }))
        })?;
        // No convergence nearby: the damped search returns a position or the error.
        projected.map_or_else(|| Ok(newton(mechanism, q)?.coordinates), Ok)
    }

    /// Projects `q` with the same independent coordinates. It iterates until the steps stop shrinking, because a change
    /// point amplifies rounding errors.
    pub(super) fn projected_in(
        &self,
        independent: &Choice<S>,
        q: &Coordinates<S>,
    ) -> Result<Coordinates<S>, MotionErrorOf<S>> {
        let mechanism = self.scene.mechanism();
        let projected = self.newton_near(q, S::Scalar::zero(), |pose| {
            let factors = independent.factors(mechanism, pose, &self.scales);
            let is_singular = factors.pivots().iter().any(|pivot| pivot.is_zero());
            Ok((!is_singular).then(|| factors.solve(&mechanism.residual(pose))))
        })?;
        projected.ok_or_else(|| self.change_point_error(q))
    }

    /// Iterates these Newton steps from `q` until one is no longer than `enough`, or until they are rounding error and
    /// stop shrinking.
    fn newton_near(
        &self,
        q: &Coordinates<S>,
        enough: S::Scalar,
        step: impl Fn(&PoseOf<S>) -> Result<Option<Change<S>>, MotionErrorOf<S>>,
    ) -> Result<Option<Coordinates<S>>, MotionErrorOf<S>> {
        let mechanism = self.scene.mechanism();
        let small = S::Scalar::default_epsilon().sqrt();
        let mut last = None;
        contract(*q, MAX_CORRECTIONS, |q| {
            let Some(step) = step(&mechanism.pose_at(q))? else { return Ok(Iteration::Failed) };
            let (next, size) = (Self::moved(q, &-step), self.scaled_norm(&step));
            if size <= enough {
                return Ok(Iteration::Converged(next));
            }
            let is_rounding = last.is_some_and(|last| last < small && size > last * real(0.5));
            last = Some(size);
            Ok(if is_rounding { Iteration::Converged(*q) } else { Iteration::Step(next, size) })
        })
    }
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// The frame by the factors of [J A] at `q`.
    pub(super) fn exact_frame(
        &self,
        factors: &FactorsOf<S>,
        q: &Coordinates<S>,
        rates: &PerInput<S::Mechanism>,
    ) -> Frame<S> {
        let (basis, bias) = (factors.basis(), self.bias(factors, q, rates));
        Frame { q: *q, basis, bias, is_interpolated: false }
    }

    /// The `q''` at `z'' = 0`.
    pub(super) fn bias(&self, factors: &FactorsOf<S>, q: &Coordinates<S>, rates: &PerInput<S::Mechanism>) -> Change<S> {
        let mechanism = self.scene.mechanism();
        let velocity = factors.rates(rates);
        let rates = S::Mechanism::rates(velocity.unknowns, velocity.inputs);
        -factors.solve(&mechanism.gamma(&mechanism.pose_at(q), &rates))
    }

    /// The factors of [J A] at a position, in the order of a choice.
    pub(super) fn factors(&self, independent: &Choice<S>, q: &Coordinates<S>) -> FactorsOf<S> {
        let mechanism = self.scene.mechanism();
        independent.factors(mechanism, &mechanism.pose_at(q), &self.scales)
    }
}
