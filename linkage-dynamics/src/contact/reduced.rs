//! The equations of motion and the contacts in some choice of independent coordinates.

use nalgebra::{SMatrix, SVector};

use super::{Contact, ContactLaw};
use crate::{Coordinates, Equations, Scene};
use linkage_runtime::{Error, Mechanism, Real};

/// M v'' = Q + S' f with the contacts' s' = S v' + `drift` and s'' = S v'' + `bias`, where v are `V` coordinates that
/// move independently: the inputs of a scene, or any others.
///
/// A coordinate whose motion is prescribed no force can accelerate: see [`prescribe`](Self::prescribe).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReducedEquations<T, const V: usize, const C: usize> {
    /// The scene, as errors give it.
    pub scene: &'static str,
    /// The coordinates, as errors give them.
    pub coordinates: [&'static str; V],
    /// M.
    pub mass: SMatrix<T, V, V>,
    /// Q, without contacts.
    pub forces: SVector<T, V>,
    /// v'.
    pub rates: SVector<T, V>,
    /// The contacts in the order of the scene.
    pub contacts: [ReducedContact<T, V>; C],
}

/// A contact by the independent coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReducedContact<T, const V: usize> {
    /// The label that errors give.
    pub name: &'static str,
    /// s.
    pub value: T,
    /// Its row of S: `ds/dv`.
    pub row: SVector<T, V>,
    /// What is left of s' where v' is zero: of prescribed coordinates only.
    pub drift: T,
    /// What is left of s'' where v'' is zero.
    pub bias: T,
    /// What it does.
    pub law: ContactLaw<T>,
}

impl<T: Real, const V: usize> ReducedContact<T, V> {
    /// Of a contact where the velocity is (u', v') = `basis` times the rates of the independent coordinates, and the
    /// acceleration that times theirs plus `bias`.
    #[must_use]
    pub fn new<const U: usize>(
        contact: &Contact<T, U, V>,
        (of_unknowns, of_inputs): (&SMatrix<T, U, V>, &SMatrix<T, V, V>),
        (bias_of_unknowns, bias_of_inputs): (&SVector<T, U>, &SVector<T, V>),
    ) -> Self {
        let Contact { name, along, law } = contact;
        Self {
            name,
            value: along.value,
            row: of_unknowns.tr_mul(&along.unknowns) + of_inputs.tr_mul(&along.inputs),
            drift: T::zero(),
            bias: along.bias + along.unknowns.dot(bias_of_unknowns) + along.inputs.dot(bias_of_inputs),
            law: *law,
        }
    }

    /// s' at these rates, and the sum of the magnitudes of its terms.
    pub(super) fn rate(&self, rates: &SVector<T, V>) -> (T, T) {
        let terms = self.row.component_mul(rates);
        (terms.sum() + self.drift, terms.abs().sum() + self.drift.abs())
    }
}

impl<T: Real, const V: usize, const C: usize> ReducedEquations<T, V, C> {
    /// Those of a scene in its inputs, whose prescribed ones stay prescribed.
    ///
    /// # Errors
    /// Those of [`Scene::equations`] and [`Scene::contacts`].
    pub fn of<S: Scene<T, U, V, N, C>, const U: usize, const N: usize>(
        scene: &S,
        t: T,
        state: &SVector<T, N>,
    ) -> Result<Self, Error> {
        Self::with_velocity(scene, t, state).map(|(reduced, _)| reduced)
    }

    /// The same, and q'.
    pub(crate) fn with_velocity<S: Scene<T, U, V, N, C>, const U: usize, const N: usize>(
        scene: &S,
        t: T,
        state: &SVector<T, N>,
    ) -> Result<(Self, Coordinates<S::Mechanism, T, U, V>), Error> {
        let (mut reduced, velocity) = Self::unprescribed(scene, t, state)?;
        for (at, law) in scene.prescribed(t).into_iter().enumerate() {
            if let Some([_, _, acceleration]) = law {
                reduced.prescribe(at, acceleration);
            }
        }
        Ok((reduced, velocity))
    }

    /// The same where no input is prescribed yet.
    pub(crate) fn unprescribed<S: Scene<T, U, V, N, C>, const U: usize, const N: usize>(
        scene: &S,
        t: T,
        state: &SVector<T, N>,
    ) -> Result<(Self, Coordinates<S::Mechanism, T, U, V>), Error> {
        let Equations { mass, forces, ratios, bias } = scene.equations(t, state)?;
        let (q, rates) = S::parts(state);
        let rates: SVector<T, V> = rates.into();
        let velocity = <S::Mechanism as Mechanism<T, U, V>>::with_inputs(&q, rates);
        let velocity = <S::Mechanism as Mechanism<T, U, V>>::with_unknowns(&velocity, ratios * rates);
        let (identity, none) = (SMatrix::identity(), SVector::zeros());
        let contacts = scene
            .contacts(t, &q, &velocity)?
            .map(|contact| ReducedContact::new(&contact, (&ratios, &identity), (&bias, &none)));
        let coordinates = <S::Mechanism as Mechanism<T, U, V>>::INPUTS;
        Ok((Self { scene: S::NAME, coordinates, mass, forces, rates, contacts }, velocity))
    }

    /// Gives a coordinate this acceleration: its rate and acceleration act on the others as they do, and no force or
    /// impulse changes them. Its row of M becomes that of the identity.
    pub fn prescribe(&mut self, at: usize, acceleration: T) {
        self.forces -= self.mass.column(at) * acceleration;
        self.forces[at] = acceleration;
        self.mass.row_mut(at).fill(T::zero());
        self.mass.column_mut(at).fill(T::zero());
        self.mass[(at, at)] = T::one();
        for contact in &mut self.contacts {
            contact.drift += contact.row[at] * self.rates[at];
            contact.bias += contact.row[at] * acceleration;
            contact.row[at] = T::zero();
        }
    }
}
