//! A scene in motion: by which coordinates, its velocities and states, and its closures closed.

use nalgebra::SVector;

use super::independent::{Factors, Independent};
use super::scales::Scales;
use super::state::{State, Touch};
use super::watch::Unwatched;
use crate::Scene;
use crate::contact::Contacts;
use crate::integrate::Interpolant;
use crate::{Coordinates, Inputs};
use linkage_runtime::__shared::all_finite;
use linkage_runtime::__shared::smallest;
use linkage_runtime::{Error, Mechanism, Real, newton, real};

/// By which coordinates the motion is followed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Road<T: Real, const U: usize, const V: usize, const N: usize> {
    /// The inputs, by the emitted equations.
    Inputs,
    /// Others.
    Others(Independent<T, U, V>),
    /// The polynomial over a change point, in other coordinates than the inputs, also where it goes on after the end.
    Over(Independent<T, U, V>, Interpolant<T, N>),
}

/// A pivot may fall to this part of the smallest one within a step.
pub(super) const LEAST_PART: f64 = 0.2;

/// Newton steps that close the closures again from where an integrator has left them.
const MOST_ITERATIONS: usize = 8;

/// A step of Newton's method of this many roots of roundings leaves less than a rounding.
const ENOUGH: f64 = 1e-3;

/// A scene in motion, as an integrator takes it.
#[derive(Debug, Clone)]
pub struct Motion<'a, S, W, T: Real, const U: usize, const V: usize, const N: usize, const C: usize> {
    pub(super) scene: &'a S,
    pub(super) watch: W,
    pub(super) scales: Scales<T, U, V>,
    pub(super) road: Road<T, U, V, N>,
    pub(super) contacts: Contacts<T, C>,
    pub(super) names: [&'static str; C],
}

pub(super) type Position<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
    Coordinates<<S as Scene<T, U, V, N, C>>::Mechanism, T, U, V>;

impl<'a, S, T, const U: usize, const V: usize, const N: usize, const C: usize> Motion<'a, S, Unwatched, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    /// In the inputs, with no contact acting.
    pub(super) fn new(scene: &'a S, scales: Scales<T, U, V>) -> Self {
        Self { scene, watch: Unwatched, scales, road: Road::Inputs, contacts: Contacts::open(), names: [""; C] }
    }
}

impl<'a, S, W, T, const U: usize, const V: usize, const N: usize, const C: usize> Motion<'a, S, W, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    /// The same with other events.
    pub(super) fn watched<W2>(self, watch: W2) -> Motion<'a, S, W2, T, U, V, N, C> {
        let Self { scene, scales, road, contacts, names, .. } = self;
        Motion { scene, watch, scales, road, contacts, names }
    }

    /// y of a position and the rates of the independent coordinates.
    pub(super) fn pack(q: &Position<S, T, U, V, N, C>, rates: &SVector<T, V>) -> SVector<T, N> {
        S::state(q, &Inputs::<S::Mechanism, T, U, V>::from(*rates))
    }

    pub(super) fn unpack(y: &SVector<T, N>) -> (Position<S, T, U, V, N, C>, SVector<T, V>) {
        let (q, rates) = S::parts(y);
        (q, rates.into())
    }

    pub(super) fn joined(
        q: &Position<S, T, U, V, N, C>,
        (unknowns, inputs): (SVector<T, U>, SVector<T, V>),
    ) -> Position<S, T, U, V, N, C> {
        S::Mechanism::with_unknowns(&S::Mechanism::with_inputs(q, inputs), unknowns)
    }

    /// Which inputs are prescribed.
    pub(super) fn held(&self, t: T) -> [bool; V] {
        self.scene.prescribed(t).map(|law| law.is_some())
    }

    pub(super) fn factors(
        &self,
        independent: &Independent<T, U, V>,
        q: &Position<S, T, U, V, N, C>,
    ) -> Factors<T, U, V> {
        let mechanism = self.scene.mechanism();
        independent.factors(mechanism, &mechanism.pose_at(q), &self.scales)
    }

    /// The factors if the position is apart from a change point that is passed.
    pub(super) fn regular(
        &self,
        independent: &Independent<T, U, V>,
        q: &Position<S, T, U, V, N, C>,
    ) -> Option<Factors<T, U, V>> {
        let factors = self.factors(independent, q);
        (smallest(factors.pivots().iter().copied()) > independent.regularity() * real(LEAST_PART)).then_some(factors)
    }

    /// u' and v'.
    pub(super) fn velocity(&self, t: T, y: &SVector<T, N>) -> Result<(SVector<T, U>, SVector<T, V>), Error> {
        let (q, rates) = Self::unpack(y);
        let mechanism = self.scene.mechanism();
        match &self.road {
            Road::Inputs => {
                let pose = mechanism.pose_at(&q);
                let right = mechanism.jacobian_inputs(&pose) * -rates;
                Ok((mechanism.solve_jacobian(&pose, &right)?, rates))
            }
            Road::Others(independent) => {
                Ok(independent.apart(&(self.factors(independent, &q).basis() * rates), &rates))
            }
            Road::Over(independent, step) => {
                if let Some(factors) = self.regular(independent, &q) {
                    return Ok(independent.apart(&(factors.basis() * rates), &rates));
                }
                // Near the change point [J A] does not tell.
                let (rate, _) = Self::unpack(&step.slope_at(t));
                Ok((S::Mechanism::unknowns(&rate), S::Mechanism::inputs(&rate)))
            }
        }
    }

    /// y of a position and the rates of the inputs.
    pub(super) fn with_rates(
        &self,
        q: &Position<S, T, U, V, N, C>,
        rates: &SVector<T, V>,
    ) -> Result<SVector<T, N>, Error> {
        let (Road::Others(independent) | Road::Over(independent, _)) = &self.road else {
            return Ok(Self::pack(q, rates));
        };
        let mechanism = self.scene.mechanism();
        let pose = mechanism.pose_at(q);
        let right = mechanism.jacobian_inputs(&pose) * -rates;
        Ok(Self::pack(q, &independent.of(&mechanism.solve_jacobian(&pose, &right)?, rates)))
    }

    pub(super) fn state(&self, t: T, y: &SVector<T, N>) -> Result<State<T, Position<S, T, U, V, N, C>, C>, Error> {
        let (q, _) = Self::unpack(y);
        let rates = self.velocity(t, y)?;
        all_finite(S::NAME, "the state", [t].iter().chain(y.iter()).chain(rates.0.iter()).chain(rates.1.iter()))?;
        let rate = Self::joined(&q, rates);
        let touch = |place: usize| Touch { name: self.names[place], mode: self.contacts.modes[place], change: None };
        Ok(State { t, q, rate, event: None, contacts: core::array::from_fn(touch) })
    }

    /// y with the closures closed again and prescribed inputs where their laws say.
    pub(super) fn closed(&self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        let (mut q, mut rates) = Self::unpack(y);
        let laws = self.scene.prescribed(t);
        let mut inputs = S::Mechanism::inputs(&q);
        for (input, law) in laws.iter().enumerate() {
            if let Some([position, speed, _]) = *law {
                inputs[input] = position;
                let at = match &self.road {
                    Road::Inputs => Some(input),
                    Road::Others(independent) | Road::Over(independent, _) => {
                        independent.free.iter().position(|&free| free == U + input)
                    }
                };
                if let Some(at) = at {
                    rates[at] = speed;
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

    /// The position near `q` with the same inputs. Where an integrator has left it, one step of Newton's method is
    /// mostly so small that the next would be less than rounding.
    fn closed_in_inputs(&self, q: &Position<S, T, U, V, N, C>) -> Result<Position<S, T, U, V, N, C>, Error> {
        let mechanism = self.scene.mechanism();
        let mut q = *q;
        let mut last = None;
        let enough = T::default_epsilon().sqrt() * real(ENOUGH);
        for _ in 0..MOST_ITERATIONS {
            let pose = mechanism.pose_at(&q);
            let step = mechanism.solve_jacobian(&pose, &mechanism.residual(&pose))?;
            let size = self.scales.speed(&step, &SVector::zeros());
            if !size.is_finite() {
                return Err(Error::NotFinite { mechanism: S::Mechanism::NAME, quantity: "the position" });
            }
            if size.is_zero() || last.is_some_and(|last| size >= last) {
                break;
            }
            q = S::Mechanism::with_unknowns(&q, S::Mechanism::unknowns(&q) - step);
            last = Some(size);
            if size <= enough {
                break;
            }
        }
        if last.is_none_or(|last| last < T::default_epsilon().sqrt()) {
            return Ok(q);
        }
        // No position near: the search says why.
        Ok(newton(mechanism, &q)?.coordinates)
    }

    /// The position near `q` with the same independent coordinates.
    pub(super) fn closed_by(
        &self,
        independent: &Independent<T, U, V>,
        q: &Position<S, T, U, V, N, C>,
    ) -> Result<Position<S, T, U, V, N, C>, Error> {
        let mechanism = self.scene.mechanism();
        let mut q = *q;
        let mut last = None;
        for _ in 0..MOST_ITERATIONS {
            let pose = mechanism.pose_at(&q);
            let step = independent.factors(mechanism, &pose, &self.scales).solve(&mechanism.residual(&pose));
            let (unknowns, inputs) = independent.apart(&-step, &SVector::zeros());
            let size = self.scales.speed(&unknowns, &inputs);
            if !size.is_finite() {
                return Err(Error::NotFinite { mechanism: S::Mechanism::NAME, quantity: "the position" });
            }
            // Steps of Newton's method fall until they are rounding.
            if size.is_zero() || last.is_some_and(|last| size >= last) {
                break;
            }
            q = Self::joined(&q, (S::Mechanism::unknowns(&q) + unknowns, S::Mechanism::inputs(&q) + inputs));
            last = Some(size);
        }
        if last.is_none_or(|last| last < T::default_epsilon().sqrt()) {
            return Ok(q);
        }
        Err(self.change_point(&q))
    }
}
