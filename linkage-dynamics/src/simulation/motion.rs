//! A scene in motion: by which coordinates, its velocities and states, and its closures closed.

use super::independent::{Factors, Independent};
use super::state::{State, Touch};
use super::watch::Unwatched;
use crate::contact::{Contacts, ReducedEquations};
use crate::integrate::Interpolant;
use crate::{Coordinates, MotionError, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::{all_finite, smallest};
use linkage_runtime::jacobian::{Closing, ScalesOf, VectorOf, contract, correction};
use linkage_runtime::{Column, Dim, Mechanism, PerInput, Real, newton, real};

/// A choice of independent coordinates of a scene.
pub(super) type Choice<S> = Independent<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;
/// [J A] of a scene by a choice.
pub(super) type FactorsOf<S> = Factors<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;
/// The coordinates by which a scene is followed.
pub(super) type RoadOf<S> = Road<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V, <S as Scene>::State>;
/// The states of a scene within a step.
pub(super) type Polynomial<S> = Interpolant<<S as Scene>::Scalar, <S as Scene>::State>;
/// The equations of motion of a scene in independent coordinates.
pub(super) type Reduced<S> = ReducedEquations<<S as Scene>::Scalar, <S as Scene>::V, <S as Scene>::Contacts>;
/// What is known of a scene's mechanism at a position.
type PoseOf<S> = <<S as Scene>::Mechanism as Mechanism>::Pose;
/// Changes, rates or accelerations of u and v.
pub(super) type Change<S> = VectorOf<<S as Scene>::Mechanism>;

/// By which coordinates the motion is followed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Road<T: Real, U: Dim, V: Dim, N: Dim> {
    /// The inputs, by the emitted equations.
    Inputs,
    /// Others.
    Others(Independent<T, U, V>),
    /// The polynomial over a change point, in other coordinates than the inputs, also where it goes on after the end.
    Over(Independent<T, U, V>, Interpolant<T, N>),
}

/// A pivot may fall to this part of the smallest one within a step. At half of it or twice as much every test of
/// simulations holds.
pub(super) const LEAST_PART: f64 = 0.2;

/// Newton steps that close the closures again from where an integrator has left them: mostly one, near a change point, where
/// they only halve at first, a dozen.
const MOST_CORRECTIONS: usize = 16;

/// A step of Newton's method of this many roots of roundings leaves less than a rounding.
const LAST_CORRECTION: f64 = 1e-3;

/// A scene in motion, as an integrator takes it.
#[derive(Debug, Clone)]
pub struct Motion<'a, S: Scene, W> {
    pub(super) scene: &'a S,
    pub(super) watch: W,
    pub(super) scales: ScalesOf<S::Mechanism>,
    pub(super) road: RoadOf<S>,
    pub(super) contacts: Contacts<S::Scalar, S::Contacts>,
    pub(super) names: Column<&'static str, S::Contacts>,
}

impl<'a, S: Scene> Motion<'a, S, Unwatched> {
    /// In the inputs, with no contact acting.
    pub(super) fn new(scene: &'a S, scales: ScalesOf<S::Mechanism>) -> Self {
        let (contacts, names) = (Contacts::open(), Column::repeat(""));
        Self { scene, watch: Unwatched, scales, road: Road::Inputs, contacts, names }
    }
}

impl<'a, S: Scene, W> Motion<'a, S, W> {
    /// The same with other events.
    pub(super) fn watched<W2>(self, watch: W2) -> Motion<'a, S, W2> {
        let Self { scene, scales, road, contacts, names, .. } = self;
        Motion { scene, watch, scales, road, contacts, names }
    }

    /// y of a position and the rates of the independent coordinates.
    pub(super) fn pack(q: &Coordinates<S>, rates: &PerInput<S::Mechanism>) -> StateColumn<S> {
        S::state(q, &(*rates).into())
    }

    pub(super) fn unpack(y: &StateColumn<S>) -> (Coordinates<S>, PerInput<S::Mechanism>) {
        let (q, rates) = S::parts(y);
        (q, rates.into())
    }

    /// Which inputs are prescribed.
    pub(super) fn held(&self, t: S::Scalar) -> Column<bool, S::V> {
        self.scene.prescribed(t).map(|law| law.is_some())
    }

    pub(super) fn factors(&self, independent: &Choice<S>, q: &Coordinates<S>) -> FactorsOf<S> {
        let mechanism = self.scene.mechanism();
        independent.factors(mechanism, &mechanism.pose_at(q), &self.scales)
    }

    /// The factors if the position is apart from a change point that is passed.
    pub(super) fn regular(&self, independent: &Choice<S>, q: &Coordinates<S>) -> Option<FactorsOf<S>> {
        let factors = self.factors(independent, q);
        (smallest(factors.pivots().iter().copied()) > independent.regularity() * real(LEAST_PART)).then_some(factors)
    }

    /// A position without its names.
    pub(super) fn column(q: &Coordinates<S>) -> Change<S> {
        let (unknowns, inputs) = S::Mechanism::parts(q);
        Change::<S> { unknowns, inputs }
    }

    pub(super) fn moved(q: &Coordinates<S>, change: &Change<S>) -> Coordinates<S> {
        let there = Self::column(q) + *change;
        S::Mechanism::coordinates(there.unknowns, there.inputs)
    }

    /// The largest of changes beside the sizes of their coordinates; of rates it is an angular frequency.
    pub(super) fn size_of(&self, change: &Change<S>) -> S::Scalar {
        change.relative_to(&self.scales.coordinates).largest()
    }

    /// u' and v'.
    pub(super) fn velocity(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<Change<S>, MotionError> {
        let (q, rates) = Self::unpack(y);
        let mechanism = self.scene.mechanism();
        match &self.road {
            Road::Inputs => {
                let pose = mechanism.pose_at(&q);
                let right = mechanism.jacobian_inputs(&pose) * -rates;
                Ok(Change::<S> { unknowns: mechanism.solve_jacobian(&pose, &right)?, inputs: rates })
            }
            Road::Others(independent) => Ok(self.factors(independent, &q).rates(&rates)),
            Road::Over(independent, step) => {
                if let Some(factors) = self.regular(independent, &q) {
                    return Ok(factors.rates(&rates));
                }
                // Near the change point [J A] does not tell.
                let (rates, _) = S::parts(&step.slope_at(t));
                Ok(Self::column(&rates))
            }
        }
    }

    /// y of a position and the rates of the inputs.
    pub(super) fn with_input_rates(
        &self,
        q: &Coordinates<S>,
        rates: &PerInput<S::Mechanism>,
    ) -> Result<StateColumn<S>, MotionError> {
        let (Road::Others(independent) | Road::Over(independent, _)) = &self.road else {
            return Ok(Self::pack(q, rates));
        };
        let mechanism = self.scene.mechanism();
        let pose = mechanism.pose_at(q);
        let right = mechanism.jacobian_inputs(&pose) * -*rates;
        let rates = Change::<S> { unknowns: mechanism.solve_jacobian(&pose, &right)?, inputs: *rates };
        Ok(Self::pack(q, &independent.of(&rates)))
    }

    pub(super) fn state(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<State<S>, MotionError> {
        let (q, _) = Self::unpack(y);
        let Change::<S> { unknowns, inputs } = self.velocity(t, y)?;
        all_finite(S::NAME, "the state", [t].iter().chain(y.iter()).chain(unknowns.iter()).chain(inputs.iter()))?;
        let rates = S::Mechanism::rates(unknowns, inputs);
        let touch = |place: usize| Touch { name: self.names[place], mode: self.contacts.modes[place], change: None };
        Ok(State { t, q, rates, event: None, contacts: Column::from_fn(touch) })
    }

    /// y with the closures closed again and prescribed inputs where their laws say.
    pub(super) fn closed(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<StateColumn<S>, MotionError> {
        let (mut q, mut rates) = Self::unpack(y);
        let laws = self.scene.prescribed(t);
        let mut inputs = S::Mechanism::inputs(&q);
        for (input, law) in laws.iter().enumerate() {
            if let Some(law) = law {
                inputs[input] = law.value;
                let at = match &self.road {
                    Road::Inputs => Some(input),
                    Road::Others(independent) | Road::Over(independent, _) => {
                        independent.free.iter().position(|&free| free == S::U::COUNT + input)
                    }
                };
                if let Some(at) = at {
                    rates[at] = law.rate;
                }
            }
        }
        if laws.iter().any(Option::is_some) {
            q = S::Mechanism::with_inputs(&q, inputs);
        }
        let q = match &self.road {
            Road::Inputs => self.closed_in_inputs(&q)?,
            Road::Others(independent) => self.closed_by(independent, &q)?,
            Road::Over(independent, _) if self.regular(independent, &q).is_none() => q,
            Road::Over(independent, _) => self.closed_by(independent, &q)?,
        };
        Ok(Self::pack(&q, &rates))
    }

    /// The position near `q` with the same inputs. One step is mostly so small that the next would be less than rounding.
    fn closed_in_inputs(&self, q: &Coordinates<S>) -> Result<Coordinates<S>, MotionError> {
        let mechanism = self.scene.mechanism();
        let enough = S::Scalar::default_epsilon().sqrt() * real(LAST_CORRECTION);
        let closed = self.closed_near(q, enough, |pose| {
            Ok(Some(Change::<S> { unknowns: correction(mechanism, pose)?, inputs: Column::zeros() }))
        })?;
        // No position near: the search says why.
        closed.map_or_else(|| Ok(newton(mechanism, q)?.coordinates), Ok)
    }

    /// The position near `q` with the same independent coordinates. Near a change point rounding is so enlarged that all is
    /// taken that steps can give.
    pub(super) fn closed_by(&self, independent: &Choice<S>, q: &Coordinates<S>) -> Result<Coordinates<S>, MotionError> {
        let mechanism = self.scene.mechanism();
        let closed = self.closed_near(q, S::Scalar::zero(), |pose| {
            let factors = independent.factors(mechanism, pose, &self.scales);
            let is_singular = factors.pivots().iter().any(|pivot| pivot.is_zero());
            Ok((!is_singular).then(|| factors.solve(&mechanism.residual(pose))))
        })?;
        closed.ok_or_else(|| self.change_point(q))
    }

    /// The position to which these steps of Newton's method lead from where an integrator has left it: by a step that is
    /// no longer than `enough`, or until they are rounding and fall no more.
    fn closed_near(
        &self,
        q: &Coordinates<S>,
        enough: S::Scalar,
        step: impl Fn(&PoseOf<S>) -> Result<Option<Change<S>>, MotionError>,
    ) -> Result<Option<Coordinates<S>>, MotionError> {
        let mechanism = self.scene.mechanism();
        let small = S::Scalar::default_epsilon().sqrt();
        let mut last = None;
        contract(*q, MOST_CORRECTIONS, |q| {
            let Some(step) = step(&mechanism.pose_at(q))? else { return Ok(Closing::Stuck) };
            let (next, size) = (Self::moved(q, &-step), self.size_of(&step));
            if size <= enough {
                return Ok(Closing::Closed(next));
            }
            let is_rounding = last.is_some_and(|last| last < small && size > last * real(0.5));
            last = Some(size);
            Ok(if is_rounding { Closing::Closed(*q) } else { Closing::Step(next, size) })
        })
    }
}
