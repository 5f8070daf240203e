//! The differential equations of a scene in the coordinates that are independent for the time being.
//!
//! q' = N z' and M_r z'' = Q_r with M_r = N' M N and Q_r = N' (F - M b), where N spans what [J A] leaves free and b is
//! q'' at z'' = 0. With the inputs for z these are the equations that are emitted.

use nalgebra::{SMatrix, SVector};

use super::independent::{Factors, Independent};
use super::motion::{LEAST_PART, Motion, Position, Road};
use super::watch::Watch;
use crate::Inputs;
use crate::contact::{ReducedContact, ReducedEquations};
use crate::integrate::{Crossing, Guard, System};
use crate::{Mode, Scene};
use linkage_runtime::__shared::finite;
use linkage_runtime::{Error, Mechanism, Real, real};

impl<S, W, T, const U: usize, const V: usize, const N: usize, const C: usize> Motion<'_, S, W, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    /// y' in the coordinates of a choice.
    pub(super) fn rate_by(
        &self,
        independent: &Independent<T, U, V>,
        factors: &Factors<T, U, V>,
        (t, y): (T, &SVector<T, N>),
    ) -> Result<SVector<T, N>, Error> {
        self.rate_of(&self.equations_by(independent, factors, (t, y))?)
    }

    /// y' from the equations and the velocity.
    fn rate_of(
        &self,
        (equations, velocity): &(ReducedEquations<T, V, C>, Position<S, T, U, V, N, C>),
    ) -> Result<SVector<T, N>, Error> {
        let accelerations = self.contacts.acceleration(equations)?;
        finite(S::NAME, "the acceleration", accelerations.data.0[0])?;
        Ok(Self::pack(velocity, &accelerations))
    }

    /// M_r, Q_r and the contacts in the coordinates of a choice, and q'.
    pub(super) fn equations_by(
        &self,
        independent: &Independent<T, U, V>,
        factors: &Factors<T, U, V>,
        (t, y): (T, &SVector<T, N>),
    ) -> Result<(ReducedEquations<T, V, C>, Position<S, T, U, V, N, C>), Error> {
        let (mut equations, velocity) = self.unprescribed_by(independent, factors, (t, y))?;
        // What is prescribed moves as its law says, whatever the forces.
        for (input, law) in self.scene.prescribed(t).iter().enumerate() {
            let Some([_, _, acceleration]) = *law else { continue };
            if let Some(at) = independent.free.iter().position(|&free| free == U + input) {
                equations.prescribe(at, acceleration);
            }
        }
        Ok((equations, velocity))
    }

    /// The same where no input is prescribed yet.
    pub(super) fn unprescribed_by(
        &self,
        independent: &Independent<T, U, V>,
        factors: &Factors<T, U, V>,
        (t, y): (T, &SVector<T, N>),
    ) -> Result<(ReducedEquations<T, V, C>, Position<S, T, U, V, N, C>), Error> {
        let mechanism = self.scene.mechanism();
        let (q, rates) = Self::unpack(y);
        let basis = factors.basis();
        let velocity = Self::joined(&q, independent.apart(&(basis * rates), &rates));
        let gamma = mechanism.gamma(&mechanism.pose_at(&q), &velocity);
        let (of_unknowns, of_inputs) = independent.apart(&-factors.solve(&gamma), &SVector::zeros());
        let mut unknowns = SMatrix::<T, U, V>::zeros();
        let mut inputs = SMatrix::<T, V, V>::zeros();
        for column in 0..V {
            let unit = SVector::from_fn(|k, _| if k == column { T::one() } else { T::zero() });
            let (of_unknowns, of_inputs) = independent.apart(&basis.column(column).into_owned(), &unit);
            unknowns.set_column(column, &of_unknowns);
            inputs.set_column(column, &of_inputs);
        }
        let all = self.scene.unreduced(t, &q, &velocity)?;
        let moved = all.unknowns * unknowns + all.mixed * inputs;
        let mass = unknowns.tr_mul(&moved) + inputs.tr_mul(&(all.mixed.tr_mul(&unknowns) + all.inputs * inputs));
        let left_unknowns = all.unknown_forces - all.unknowns * of_unknowns - all.mixed * of_inputs;
        let left_inputs = all.input_forces - all.mixed.tr_mul(&of_unknowns) - all.inputs * of_inputs;
        let forces = unknowns.tr_mul(&left_unknowns) + inputs.tr_mul(&left_inputs);
        let contacts = self
            .scene
            .contacts(t, &q, &velocity)?
            .map(|contact| ReducedContact::new(&contact, (&unknowns, &inputs), (&of_unknowns, &of_inputs)));
        let name = |column: usize| {
            if column < U { S::Mechanism::UNKNOWNS[column] } else { S::Mechanism::INPUTS[column - U] }
        };
        let coordinates = independent.free.map(name);
        Ok((ReducedEquations { scene: S::NAME, coordinates, mass, forces, rates, contacts }, velocity))
    }
}

impl<S, W, T, const U: usize, const V: usize, const N: usize, const K: usize, const C: usize> System<T, N, K, C>
    for Motion<'_, S, W, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    W: Watch<T, Position<S, T, U, V, N, C>, Inputs<S::Mechanism, T, U, V>, K, C>,
    T: Real,
{
    #[inline]
    fn rate(&mut self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        let (Road::Others(independent) | Road::Over(independent, _)) = &self.road else {
            if self.contacts.modes.iter().all(|&mode| mode == Mode::Open) {
                return self.scene.derivative(t, y);
            }
            return self.rate_of(&ReducedEquations::with_velocity(self.scene, t, y)?);
        };
        let (q, _) = Self::unpack(y);
        let factors = self.factors(independent, &q);
        // No step goes over a singularity of the choice, or near it, unnoticed.
        let least = independent.regularity() * real(LEAST_PART);
        let mut pivots = factors.pivots();
        pivots.zip_apply(&independent.pivots, |pivot, start| {
            *pivot *= if start < T::zero() { -T::one() } else { T::one() }
        });
        if !pivots.iter().all(|&pivot| pivot >= least) {
            return Err(self.singular(&q));
        }
        self.rate_by(independent, &factors, (t, y))
    }

    fn events(&mut self, t: T, y: &SVector<T, N>) -> Result<[T; K], Error> {
        let state = self.state(t, y)?;
        self.watch.values(&state)
    }

    fn crossings(&self) -> [Crossing; K] {
        self.watch.crossings()
    }

    fn guards(&mut self, t: T, y: &SVector<T, N>) -> Result<[Guard<T>; C], Error> {
        self.margins(t, y)
    }
}
