//! The equations of motion and the contacts in some choice of independent coordinates.

use super::{Contact, ContactLaw};
use crate::scene::{Rates, StateColumn, coordinate_name};
use crate::{Equations, MotionError, Scene};
use linkage_runtime::{Column, Dim, Matrix, Mechanism, PerInput, Real};

/// M v'' = Q + S' f with the contacts' s' = S v' + `drift` and s'' = S v'' + `bias`, where v are `V` coordinates that
/// move independently: the inputs of a scene, or any others.
///
/// A coordinate whose motion is prescribed no force can accelerate: see [`prescribe`](Self::prescribe).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReducedEquations<T: Real, V: Dim, C: Dim> {
    /// The scene, as errors give it.
    pub scene: &'static str,
    /// The coordinates, as errors give them.
    pub coordinates: Column<&'static str, V>,
    /// M.
    pub mass: Matrix<T, V, V>,
    /// Q, without contacts.
    pub forces: Column<T, V>,
    /// v'.
    pub rates: Column<T, V>,
    /// The contacts in the order of the scene.
    pub contacts: Column<ReducedContact<T, V>, C>,
}

/// A contact by the independent coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReducedContact<T: Real, V: Dim> {
    /// The label that errors give.
    pub name: &'static str,
    /// s.
    pub value: T,
    /// Its row of S: `ds/dv`.
    pub row: Column<T, V>,
    /// What is left of s' where v' is zero: of prescribed coordinates only.
    pub drift: T,
    /// What is left of s'' where v'' is zero.
    pub bias: T,
    /// What it does.
    pub law: ContactLaw<T>,
}

impl<T: Real, V: Dim> ReducedContact<T, V> {
    /// Of a contact where the velocity is (u', v') = `basis` times the rates of the independent coordinates, and the
    /// acceleration that times theirs plus `bias`.
    #[must_use]
    pub fn new<U: Dim>(
        contact: &Contact<T, U, V>,
        (of_unknowns, of_inputs): (&Matrix<T, U, V>, &Matrix<T, V, V>),
        (bias_of_unknowns, bias_of_inputs): (&Column<T, U>, &Column<T, V>),
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
    pub(super) fn rate(&self, rates: &Column<T, V>) -> (T, T) {
        let terms = self.row.component_mul(rates);
        (terms.sum() + self.drift, terms.abs().sum() + self.drift.abs())
    }
}

impl<T: Real, V: Dim, C: Dim> ReducedEquations<T, V, C> {
    /// Those of a scene in its inputs, whose prescribed ones stay prescribed.
    ///
    /// # Errors
    /// Those of [`Scene::equations`] and [`Scene::contacts`].
    pub fn of<S>(scene: &S, t: T, state: &StateColumn<S>) -> Result<Self, MotionError>
    where
        S: Scene<Scalar = T, V = V, Contacts = C>,
    {
        Self::with_rates(scene, t, state).map(|(reduced, _)| reduced)
    }

    /// The same, and q'.
    pub(crate) fn with_rates<S>(scene: &S, t: T, state: &StateColumn<S>) -> Result<(Self, Rates<S>), MotionError>
    where
        S: Scene<Scalar = T, V = V, Contacts = C>,
    {
        let (mut reduced, rates) = Self::unprescribed(scene, t, state)?;
        for (at, law) in scene.prescribed(t).into_iter().enumerate() {
            if let Some(law) = law {
                reduced.prescribe(at, law.acceleration);
            }
        }
        Ok((reduced, rates))
    }

    /// The same where no input is prescribed yet.
    pub(crate) fn unprescribed<S>(scene: &S, t: T, state: &StateColumn<S>) -> Result<(Self, Rates<S>), MotionError>
    where
        S: Scene<Scalar = T, V = V, Contacts = C>,
    {
        let Equations { mass, forces, ratios, bias } = scene.equations(t, state)?;
        let (q, input_rates) = S::parts(state);
        let input_rates: PerInput<S::Mechanism> = input_rates.into();
        let rates = S::Mechanism::rates(ratios * input_rates, input_rates);
        let (identity, none) = (Matrix::identity(), Column::zeros());
        let contacts = scene
            .contacts(t, &q, &rates)?
            .map(|contact| ReducedContact::new(&contact, (&ratios, &identity), (&bias, &none)));
        let coordinates = Column::from_fn(|input| coordinate_name::<S::Mechanism>(S::U::COUNT + input));
        Ok((Self { scene: S::NAME, coordinates, mass, forces, rates: input_rates, contacts }, rates))
    }

    /// Gives a coordinate this acceleration: its rate and acceleration act on the others as they do, and no force or
    /// impulse changes them. Its row of M becomes that of the identity.
    pub fn prescribe(&mut self, at: usize, acceleration: T) {
        self.forces -= self.mass.column(at) * acceleration;
        self.forces[at] = acceleration;
        let identity = Matrix::identity();
        self.mass = Matrix::from_fn(|row, column| {
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
