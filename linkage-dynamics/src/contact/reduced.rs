//! The equations of motion and the contacts in any choice of independent coordinates.

use super::bearing::{ReducedBearing, Reduction};
use super::{Contact, ContactLaw};
use crate::scene::{Rates, StateColumn};
use crate::{Equations, MotionError, Scene, StateParts};
use linkage_runtime::{BorrowedName, Build, Column, Dim, Matrix, Mechanism, PerInput, Real};

/// `M v'' = Q + S' f`, where v are `V` independent coordinates, the inputs of a scene or others, and f the forces of the
/// contacts, whose scalars s have `s' = S v' + drift` and `s'' = S v'' + bias`.
///
/// No force accelerates a coordinate whose motion is prescribed: see [`prescribe`](Self::prescribe).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound(serialize = "T: serde::Serialize, N: serde::Serialize"))
)]
pub struct ReducedEquations<T: Real, V: Dim, C: Dim, N: BorrowedName = &'static str> {
    /// The name of the scene, used in errors.
    pub scene: N,
    /// The names of the coordinates, used in errors.
    pub coordinates: Column<N, V>,
    /// M.
    pub mass: Matrix<T, V, V>,
    /// Q, without contacts.
    pub forces: Column<T, V>,
    /// v'.
    pub rates: Column<T, V>,
    /// The contacts in the order of the scene.
    pub contacts: Column<ReducedContact<T, V, N>, C>,
    /// The reactions of the contacts with the law [`ContactLaw::Bearing`].
    pub bearings: Column<Option<ReducedBearing<T, V, C>>, C>,
}

/// A contact in the independent coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound(serialize = "T: serde::Serialize, N: serde::Serialize"))
)]
pub struct ReducedContact<T: Real, V: Dim, N = &'static str> {
    /// The name used in errors.
    pub name: N,
    /// s.
    pub value: T,
    /// Its row of S: `ds/dv`.
    pub row: Column<T, V>,
    /// s' at v' = 0: nonzero only with prescribed coordinates.
    pub drift: T,
    /// `s''` at `v'' = 0`.
    pub bias: T,
    /// The law of its force.
    pub law: ContactLaw<T>,
}

impl<T: Real, V: Dim, N: BorrowedName> ReducedContact<T, V, N> {
    /// Reduces a contact to independent coordinates z, in which `(u', v') = N z'` and `(u'', v'') = N z'' + bias`; N and
    /// the bias are given as their rows of u and of v.
    pub(crate) fn new<U: Dim>(
        contact: &Contact<T, U, V, N>,
        (of_unknowns, of_inputs): (&Matrix<T, U, V>, &Matrix<T, V, V>),
        (bias_of_unknowns, bias_of_inputs): (&Column<T, U>, &Column<T, V>),
    ) -> Self {
        let Contact { name, along, law } = contact;
        Self {
            name: *name,
            value: along.value,
            row: of_unknowns.tr_mul(&along.unknowns) + of_inputs.tr_mul(&along.inputs),
            drift: T::zero(),
            bias: along.bias + along.unknowns.dot(bias_of_unknowns) + along.inputs.dot(bias_of_inputs),
            law: *law,
        }
    }

    /// s' at these rates, and the sum of the magnitudes of its terms.
    pub(crate) fn rate(&self, rates: &Column<T, V>) -> (T, T) {
        let terms = self.row.component_mul(rates);
        (terms.sum() + self.drift, terms.abs().sum() + self.drift.abs())
    }
}

impl<T: Real, V: Dim, C: Dim, N: BorrowedName> ReducedEquations<T, V, C, N> {
    /// Builds the equations of a scene in its inputs, with the prescribed motions applied.
    ///
    /// # Errors
    /// Those of [`Scene::equations`], [`Scene::contacts`] and [`Scene::bearings`].
    pub fn of<S>(scene: &S, t: T, state: &StateColumn<S>) -> Result<Self, MotionError<N>>
    where
        S: Scene<Scalar = T, V = V, Contacts = C, Mechanism: Mechanism<Name = N>>,
    {
        Self::with_rates(scene, t, state).map(|(reduced, _)| reduced)
    }

    /// Builds the equations in the inputs, and q'.
    pub(crate) fn with_rates<S>(scene: &S, t: T, state: &StateColumn<S>) -> Result<(Self, Rates<S>), MotionError<N>>
    where
        S: Scene<Scalar = T, V = V, Contacts = C, Mechanism: Mechanism<Name = N>>,
    {
        let (mut reduced, rates) = Self::unprescribed(scene, t, state)?;
        reduced.prescribe_all(&scene.prescribed(t).map(|law| law.map(|law| law.acceleration)));
        Ok((reduced, rates))
    }

    /// Prescribes the accelerations that are known.
    pub(crate) fn prescribe_all(&mut self, accelerations: &Column<Option<T>, V>) {
        for (at, acceleration) in accelerations.iter().enumerate() {
            if let Some(acceleration) = *acceleration {
                self.prescribe(at, acceleration);
            }
        }
    }

    /// Builds the equations in the inputs before the prescribed motions are applied, and q'.
    pub(crate) fn unprescribed<S>(scene: &S, t: T, state: &StateColumn<S>) -> Result<(Self, Rates<S>), MotionError<N>>
    where
        S: Scene<Scalar = T, V = V, Contacts = C, Mechanism: Mechanism<Name = N>>,
    {
        let Equations { mass, forces, ratios, bias } = scene.equations(t, state)?;
        let StateParts { q, input_rates } = scene.parts_of(state);
        let input_rates: PerInput<S::Mechanism> = input_rates.into();
        let rates = S::Mechanism::rates(ratios * input_rates, input_rates);
        let (_, v) = ratios.dims();
        let (identity, none) = (v.identity(), v.zeros());
        let (basis, bias) = ((&ratios, &identity), (&bias, &none));
        let found = scene.contacts(t, &q, &rates)?;
        let mut bearings = scene.contact_count().repeat(None);
        if scene.has_bearings() {
            let mechanism = scene.mechanism();
            let pose = mechanism.pose_at(&q);
            let all = scene.unreduced(t, &q, &rates)?;
            let reduction = Reduction { basis, bias, all: &all, contacts: &found };
            bearings = reduction.bearings(scene.name(), &scene.bearings(t, &q, &rates)?, |rows| {
                Ok((mechanism.solve_jacobian(&pose, rows)?, v.zeros()))
            })?;
        }
        let contacts = found.map(|contact| ReducedContact::new(&contact, basis, bias));
        let coordinates = v.column(|input| scene.mechanism().input_name(input));
        Ok((Self { scene: scene.name(), coordinates, mass, forces, rates: input_rates, contacts, bearings }, rates))
    }

    /// The numbers of coordinates and of contacts.
    pub(crate) fn dims(&self) -> (V, C) {
        (self.forces.dim(), self.contacts.dim())
    }

    /// True if the limit of a friction depends on a reaction.
    pub(super) fn has_bearings(&self) -> bool {
        self.contacts.iter().any(|contact| matches!(contact.law, ContactLaw::Bearing { .. }))
    }

    /// Prescribes the acceleration of a coordinate. Its row and column of M become those of the identity, its terms
    /// move to the right side, and no force or impulse changes it.
    pub fn prescribe(&mut self, at: usize, acceleration: T) {
        self.forces -= self.mass.column(at) * acceleration;
        self.forces[at] = acceleration;
        let (v, _) = self.dims();
        let identity = v.identity();
        self.mass = v.matrix(v, |row, column| {
            let of = if row == at || column == at { &identity } else { &self.mass };
            of[(row, column)]
        });
        for contact in &mut self.contacts {
            contact.drift += contact.row[at] * self.rates[at];
            contact.bias += contact.row[at] * acceleration;
            contact.row[at] = T::zero();
        }
    }
}
