//! Frictions and stops of a scene in the current independent coordinates.

use super::motion::{Motion, Parametrisation, Reduced};
use super::scales::{resolution as resolution_of, resolution_by_inputs};
use super::state::Loads;
use crate::contact::{Change, Contact, ContactReview, Contacts, ReducedContact, ReducedEquations, changes};
use crate::integrate::Guard;
use crate::scene::coordinate_name;
use crate::{Accelerations, Equations, Mode, MotionError, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::{Column, Dim, Matrix, Mechanism, PerInput};

/// A number for each contact of a scene.
type PerContact<S> = Column<<S as Scene>::Scalar, <S as Scene>::Contacts>;
/// y, and the change of each contact.
type Changed<S> = (StateColumn<S>, Column<Option<Change>, <S as Scene>::Contacts>);

impl<S: Scene, W> Motion<'_, S, W> {
    /// M, Q and the contacts in the current coordinates.
    ///
    /// # Errors
    /// [`PathError::ChangePoint`](linkage_runtime::PathError::ChangePoint) if [J A] is nearly singular and no step over
    /// a change point is in progress.
    fn equations(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<Reduced<S>, MotionError> {
        match &self.parametrisation {
            Parametrisation::Inputs => ReducedEquations::of(self.scene, t, y),
            Parametrisation::Others(independent) | Parametrisation::Over(independent, _) => {
                let q = S::parts(y).q;
                match (self.regular(independent, &q), &self.parametrisation) {
                    (Some(factors), _) => Ok(self.equations_by(independent, &factors, (t, y))?.0),
                    (None, Parametrisation::Over(_, step)) => self.equations_over(independent, step, (t, y)),
                    (None, _) => Err(self.change_point_error(&q)),
                }
            }
        }
    }

    /// The contacts with s and s' only, without derivatives by the coordinates: no equations of motion are needed.
    pub(super) fn contacts_alone(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<Reduced<S>, MotionError> {
        let (q, rates) = Self::unpack(y);
        let velocity = self.velocity(t, y)?;
        let rates_of_all = S::Mechanism::rates(velocity.unknowns, velocity.inputs);
        let contacts = self.scene.contacts(t, &q, &rates_of_all)?.map(|contact| ReducedContact {
            name: contact.name,
            value: contact.along.value,
            row: Column::zeros(),
            drift: contact.along.unknowns.dot(&velocity.unknowns) + contact.along.inputs.dot(&velocity.inputs),
            bias: S::Scalar::zero(),
            law: contact.law,
        });
        let coordinates = Column::from_fn(|input| coordinate_name::<S::Mechanism>(S::U::COUNT + input));
        let (mass, forces) = (Matrix::identity(), Column::zeros());
        let bearings = Column::repeat(None);
        Ok(ReducedEquations { scene: S::NAME, coordinates, mass, forces, rates, contacts, bearings })
    }

    /// The event functions of the contacts, at the projected state.
    pub(super) fn margins(
        &self,
        t: S::Scalar,
        y: &StateColumn<S>,
    ) -> Result<Column<Guard<S::Scalar>, S::Contacts>, MotionError> {
        // If the projection fails, y itself is used: a step in the inputs may have left the range in which the
        // mechanism can be assembled, and will be repeated.
        let y = self.projected(t, y).unwrap_or(*y);
        let is_free = self.contacts.modes.iter().all(|&mode| mode == Mode::Open);
        let equations = if is_free { self.contacts_alone(t, &y)? } else { self.equations(t, &y)? };
        self.contacts.guards(&equations).map_err(|error| error.at(t))
    }

    /// The rounding error of each s.
    fn resolution(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<PerContact<S>, MotionError> {
        let (q, _) = Self::unpack(y);
        let velocity = self.velocity(t, y)?;
        let contacts = self.scene.contacts(t, &q, &S::Mechanism::rates(velocity.unknowns, velocity.inputs))?;
        let mut resolution = Column::zeros();
        for (resolution, Contact { along, .. }) in resolution.iter_mut().zip(&contacts) {
            *resolution = match self.parametrisation {
                Parametrisation::Inputs => resolution_by_inputs(self.scene.mechanism(), &self.scales, &q, along)?,
                Parametrisation::Others(_) | Parametrisation::Over(..) => {
                    resolution_of::<S::Mechanism>(&self.scales, &q, along)
                }
            };
        }
        Ok(resolution)
    }

    /// Finds the modes at the start; returns y with the rates after any impact.
    pub(super) fn begin(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<StateColumn<S>, MotionError> {
        let (q, rates) = Self::unpack(y);
        let mut contacts = self.contacts.with_resolution(self.resolution(t, y)?);
        let at = |rates: &PerInput<S::Mechanism>| self.equations(t, &Self::pack(&q, rates));
        let rates = contacts.start(t, &rates, at).map_err(|error| error.at(t))?;
        self.names = self.contacts_alone(t, y)?.contacts.map(|contact| contact.name);
        self.contacts = contacts;
        Ok(Self::pack(&q, &rates))
    }

    /// Applies a contact event at this state; returns y after it and the change of each contact.
    pub(super) fn settled(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<Changed<S>, MotionError> {
        self.changed(t, y, y, false)
    }

    /// Updates the modes after the user has changed the rates from `before` to `y`.
    pub(super) fn resumed(
        &mut self,
        t: S::Scalar,
        before: &StateColumn<S>,
        y: &StateColumn<S>,
    ) -> Result<Changed<S>, MotionError> {
        self.changed(t, before, y, true)
    }

    /// Settles the contacts at y; `has_new_rates` if the rates differ from those before.
    fn changed(
        &mut self,
        t: S::Scalar,
        before: &StateColumn<S>,
        y: &StateColumn<S>,
        has_new_rates: bool,
    ) -> Result<Changed<S>, MotionError> {
        if S::Contacts::COUNT == 0 {
            return Ok((*y, Column::repeat(None)));
        }
        let (q, rates) = Self::unpack(y);
        self.contacts = self.contacts.with_resolution(self.resolution(t, y)?);
        let mut contacts = self.contacts;
        let at = |rates: &PerInput<S::Mechanism>| self.equations(t, &Self::pack(&q, rates));
        let rates = if has_new_rates { contacts.resume(t, &rates, at) } else { contacts.settle(t, &rates, at) };
        let rates = rates.map_err(|error| error.at(t))?;
        let after = Self::pack(&q, &rates);
        let done = changes((&self.contacts, &self.equations(t, before)?), (&contacts, &self.equations(t, &after)?));
        self.contacts = contacts;
        Ok((after, done))
    }

    /// Returns y with s' = 0 of the held contacts, and true if the modes are still valid.
    pub(super) fn reviewed(
        &self,
        contacts: &Contacts<S::Scalar, S::Contacts>,
        t: S::Scalar,
        y: &StateColumn<S>,
    ) -> Result<(StateColumn<S>, bool), MotionError> {
        if S::Contacts::COUNT == 0 {
            return Ok((*y, true));
        }
        if contacts.modes.iter().all(|&mode| mode == Mode::Open)
            && contacts.review(&self.contacts_alone(t, y)?)?.modes_hold
        {
            return Ok((*y, true));
        }
        let ContactReview { rates, modes_hold } =
            contacts.review(&self.equations(t, y)?).map_err(|error| error.at(t))?;
        Ok((Self::pack(&S::parts(y).q, &rates), modes_hold))
    }

    /// The forces of the contacts in the modes of `contacts`, of the drives by input, zero without a drive, and in the
    /// joints.
    ///
    /// The force of the drive of `v_i` is the residual of M v'' = Q + S' f in its row, in any coordinates that include
    /// the prescribed inputs.
    pub(super) fn loads(
        &self,
        contacts: &Contacts<S::Scalar, S::Contacts>,
        t: S::Scalar,
        y: &StateColumn<S>,
    ) -> Result<Loads<S>, MotionError> {
        let q = S::parts(y).q;
        let (free, places) = match &self.parametrisation {
            Parametrisation::Inputs => (ReducedEquations::unprescribed(self.scene, t, y)?.0, Column::from_fn(Some)),
            Parametrisation::Others(independent) | Parametrisation::Over(independent, _) => {
                let factors = self.regular(independent, &q).ok_or_else(|| self.change_point_error(&q))?;
                let place = |input: usize| independent.free.iter().position(|&free| free == S::U::COUNT + input);
                (self.unprescribed_by(independent, &factors, (t, y))?.0, Column::from_fn(place))
            }
        };
        let motion = contacts.motion(&self.equations(t, y)?).map_err(|error| error.at(t))?;
        let residual = motion.residual(&free);
        let places: Column<Option<usize>, S::V> = places;
        let prescribed = self.prescribed_inputs(t);
        let drives: PerInput<S::Mechanism> = Column::from_fn(|input| match places[input] {
            Some(place) if prescribed[input] => residual[place],
            _ => S::Scalar::zero(),
        });
        let velocity = self.velocity(t, y)?;
        let rates = S::Mechanism::rates(velocity.unknowns, velocity.inputs);
        let accelerations = self.accelerations(t, y, &motion.acceleration)?;
        let joints = self.scene.reactions(t, &q, &rates, &accelerations, &motion.forces)?;
        Loads {
            contacts: motion.forces,
            are_unique: motion.are_unique,
            drives: drives.into(),
            drive_power: drives.dot(&velocity.inputs),
            joints,
        }
        .finite(t)
    }

    /// u'' and v'' from the accelerations of the independent coordinates.
    fn accelerations(
        &self,
        t: S::Scalar,
        y: &StateColumn<S>,
        free: &PerInput<S::Mechanism>,
    ) -> Result<Accelerations<S>, MotionError> {
        let (Parametrisation::Others(independent) | Parametrisation::Over(independent, _)) = &self.parametrisation
        else {
            let Equations { ratios, bias, .. } = self.scene.equations(t, y)?;
            return Ok(Accelerations::<S> { unknowns: ratios * *free + bias, inputs: *free });
        };
        let (q, free_rates) = Self::unpack(y);
        let factors = self.regular(independent, &q).ok_or_else(|| self.change_point_error(&q))?;
        let (unknowns, inputs) = factors.basis();
        let rates = S::Mechanism::rates(unknowns * free_rates, inputs * free_rates);
        let mechanism = self.scene.mechanism();
        let bias = -factors.solve(&mechanism.gamma(&mechanism.pose_at(&q), &rates));
        Ok(Accelerations::<S> { unknowns: unknowns * *free, inputs: inputs * *free } + bias)
    }
}
