//! Frictions and stops of a scene in the current independent coordinates.

use super::motion::{Motion, Parametrisation, Reduced};
use super::scales::{resolution as resolution_of, resolution_by_inputs};
use crate::contact::{Change, Contact, ContactReview, Contacts, ReducedContact, ReducedEquations, changes};
use crate::integrate::Guard;
use crate::scene::Loads;
use crate::{Accelerations, Equations, Mode, MotionErrorOf, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::{Build, Column, Dim, Mechanism, PerInput};

/// A number for each contact of a scene.
type PerContact<S> = Column<<S as Scene>::Scalar, <S as Scene>::Contacts>;
/// The event function of each contact of a scene.
type PerGuard<S> = Column<Guard<<S as Scene>::Scalar>, <S as Scene>::Contacts>;
/// y, and the change of each contact.
type Changed<S> = (StateColumn<S>, Column<Option<Change>, <S as Scene>::Contacts>);

/// The reason why contacts settle.
#[derive(Debug, Clone, Copy)]
enum Settling {
    /// An event function of a contact has fallen through zero.
    AtEvent,
    /// The rates differ from those before.
    NewRates,
    /// Impacts follow each other within the rounding error of the time.
    Together,
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// M, Q and the contacts in the current coordinates.
    ///
    /// # Errors
    /// [`MotionError::ChangePoint`](crate::MotionError::ChangePoint) if [J A] is nearly singular and the position is on no known sheet.
    fn equations(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<Reduced<S>, MotionErrorOf<S>> {
        let t = self.beside(t);
        let (q, rates) = self.unpack(y);
        match self.frame(&q, &rates)? {
            None => ReducedEquations::of(&*self.scene, t, y),
            Some((independent, frame)) => Ok(self.equations_by(independent, &frame, (t, y))?.0),
        }
    }

    /// The contacts with s and s' only, in the rates of all inputs, those of u as drift: no equations of motion are
    /// needed.
    pub(super) fn contacts_alone(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<Reduced<S>, MotionErrorOf<S>> {
        let t = self.beside(t);
        let (q, _) = self.unpack(y);
        let velocity = self.velocity(y)?;
        let rates_of_all = S::Mechanism::rates(velocity.unknowns, velocity.inputs);
        let contacts = self.scene.contacts(t, &q, &rates_of_all)?.map(|contact| ReducedContact {
            name: contact.name,
            value: contact.along.value,
            row: contact.along.inputs,
            drift: contact.along.unknowns.dot(&velocity.unknowns),
            bias: S::Scalar::zero(),
            law: contact.law,
        });
        let (_, v) = self.dims();
        let coordinates = v.column(|input| self.scene.mechanism().input_name(input));
        let (mass, forces) = (v.identity(), v.zeros());
        let (rates, bearings) = (velocity.inputs, contacts.dim().repeat(None));
        Ok(ReducedEquations { scene: self.scene.name(), coordinates, mass, forces, rates, contacts, bearings })
    }

    /// The event functions of the contacts, at the projected state.
    pub(super) fn margins(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<PerGuard<S>, MotionErrorOf<S>> {
        // If the projection fails, y itself is used: a step in the inputs may have left the range in which the
        // mechanism can be assembled, and will be repeated.
        let y = self.projected(t, y).unwrap_or(*y);
        let is_free = self.contacts.modes.iter().all(|&mode| mode == Mode::Open);
        let equations = if is_free { self.contacts_alone(t, &y)? } else { self.equations(t, &y)? };
        self.contacts.guards(&equations).map_err(|error| error.at(t))
    }

    /// The rounding error of each s.
    fn resolution(&self, t: S::Scalar, y: &StateColumn<S>) -> Result<PerContact<S>, MotionErrorOf<S>> {
        let (q, _) = self.unpack(y);
        let velocity = self.velocity(y)?;
        let contacts = self.scene.contacts(t, &q, &S::Mechanism::rates(velocity.unknowns, velocity.inputs))?;
        let mut resolution = contacts.dim().zeros();
        for (resolution, Contact { along, .. }) in resolution.iter_mut().zip(&contacts) {
            *resolution = match self.parametrisation {
                Parametrisation::Inputs => resolution_by_inputs(self.scene.mechanism(), &self.scales, &q, along)?,
                Parametrisation::Others(_) | Parametrisation::Over(_) => {
                    resolution_of::<S::Mechanism>(&self.scales, &q, along)
                }
            };
        }
        Ok(resolution)
    }

    /// Finds the modes at the start; returns y with the rates after any impact.
    pub(super) fn begin(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        let (q, rates) = self.unpack(y);
        let mut contacts = self.contacts.with_resolution(self.resolution(t, y)?);
        let at = |rates: &PerInput<S::Mechanism>| self.equations(t, &self.pack(&q, rates));
        let rates = contacts.start(t, &rates, at).map_err(|error| error.at(t))?;
        self.names = self.contacts_alone(t, y)?.contacts.map(|contact| contact.name);
        self.contacts = contacts;
        Ok(self.pack(&q, &rates))
    }

    /// Applies a contact event at this state; returns y after it and the change of each contact.
    pub(super) fn settled(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<Changed<S>, MotionErrorOf<S>> {
        self.changed(t, y, Settling::AtEvent)
    }

    /// Applies one impact without rebound to all stops that are touched.
    pub(super) fn settled_together(
        &mut self,
        t: S::Scalar,
        y: &StateColumn<S>,
    ) -> Result<Changed<S>, MotionErrorOf<S>> {
        self.changed(t, y, Settling::Together)
    }

    /// Updates the modes after the rates have changed to those of y.
    pub(super) fn resumed(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<Changed<S>, MotionErrorOf<S>> {
        self.changed(t, y, Settling::NewRates)
    }

    /// Settles the contacts at y.
    fn changed(
        &mut self,
        t: S::Scalar,
        y: &StateColumn<S>,
        settling: Settling,
    ) -> Result<Changed<S>, MotionErrorOf<S>> {
        if self.names.dim().count() == 0 {
            return Ok((*y, self.names.dim().repeat(None)));
        }
        let (q, rates) = self.unpack(y);
        // In the change point itself a change of a contact may lead to any of the motions that cross.
        if self.is_at_change_point(&q) {
            return Err(self.change_point_error(&q));
        }
        self.contacts = self.contacts.with_resolution(self.resolution(t, y)?);
        let mut contacts = self.contacts;
        let at = |rates: &PerInput<S::Mechanism>| self.equations(t, &self.pack(&q, rates));
        let rates = match settling {
            Settling::AtEvent => contacts.settle(t, &rates, at),
            Settling::NewRates => contacts.resume(t, &rates, at),
            Settling::Together => contacts.settle_together(t, &rates, at),
        };
        let rates = rates.map_err(|error| error.at(t))?;
        let after = self.pack(&q, &rates);
        let done = changes(&self.contacts.modes, &contacts);
        self.contacts = contacts;
        Ok((after, done))
    }

    /// Returns y with s' = 0 of the held contacts, and true if the modes are still valid.
    pub(super) fn reviewed(
        &self,
        contacts: &Contacts<S::Scalar, S::Contacts>,
        t: S::Scalar,
        y: &StateColumn<S>,
    ) -> Result<(StateColumn<S>, bool), MotionErrorOf<S>> {
        if self.names.dim().count() == 0 {
            return Ok((*y, true));
        }
        if contacts.modes.iter().all(|&mode| mode == Mode::Open)
            && contacts.review(&self.contacts_alone(t, y)?)?.modes_hold
        {
            return Ok((*y, true));
        }
        let ContactReview { rates, modes_hold } =
            contacts.review(&self.equations(t, y)?).map_err(|error| error.at(t))?;
        Ok((self.pack(&self.scene.parts_of(y).q, &rates), modes_hold))
    }

    /// Returns y with each s on the stop on which it rests by these contacts; `most` is the largest distance from it.
    pub(super) fn on_stops(
        &self,
        contacts: &Contacts<S::Scalar, S::Contacts>,
        t: S::Scalar,
        y: &StateColumn<S>,
        most: S::Scalar,
    ) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        if !contacts.has_stops() {
            return Ok(*y);
        }
        let Some(change) = contacts.return_to_stops(t, &self.equations(t, y)?, most)? else { return Ok(*y) };
        let (q, rates) = self.unpack(y);
        let there = Self::moved(&q, &self.velocity(&self.pack(&q, &change))?);
        self.projected(t, &self.pack(&there, &rates))
    }

    /// The forces of the contacts in the modes of `contacts`, of the drives by input, zero without a drive, and in the
    /// joints.
    ///
    /// The force of the drive of `v_i` is the residual of `M v'' = Q + S' f` in its row, in any coordinates that include
    /// the prescribed inputs.
    pub(super) fn loads(
        &self,
        contacts: &Contacts<S::Scalar, S::Contacts>,
        t: S::Scalar,
        y: &StateColumn<S>,
    ) -> Result<Loads<S>, MotionErrorOf<S>> {
        let t = self.beside(t);
        let (q, rates) = self.unpack(y);
        let (free, places) = match self.frame(&q, &rates)? {
            None => (ReducedEquations::unprescribed(&*self.scene, t, y)?.0, rates.dim().column(Some)),
            Some((independent, frame)) => {
                let place =
                    |input: usize| independent.free.iter().position(|&free| free == self.dims().0.count() + input);
                (self.unprescribed_by(independent, &frame, (t, y))?.0, rates.dim().column(place))
            }
        };
        let motion = contacts.motion(&self.equations(t, y)?).map_err(|error| error.at(t))?;
        let residual = motion.residual(&free);
        let places: Column<Option<usize>, S::V> = places;
        let prescribed = self.prescribed_inputs(t);
        let drives: PerInput<S::Mechanism> = places.dim().column(|input| match places[input] {
            Some(place) if prescribed[input] => residual[place],
            _ => S::Scalar::zero(),
        });
        let velocity = self.velocity(y)?;
        let rates = S::Mechanism::rates(velocity.unknowns, velocity.inputs);
        let accelerations = self.accelerations(t, y, &motion.acceleration)?;
        if self.scene.joints().next().is_some() && self.is_next_to_change_point(&q) {
            return Err(self.no_reactions_error(&q));
        }
        let joints = self.scene.reactions(t, &q, &rates, &accelerations, &motion.forces)?;
        Loads {
            contacts: motion.forces,
            are_unique: motion.are_unique,
            drives: drives.into(),
            drive_power: drives.dot(&velocity.inputs),
            joints,
            accelerations,
        }
        .finite(t)
    }

    /// `u''` and `v''` from the accelerations of the independent coordinates.
    fn accelerations(
        &self,
        t: S::Scalar,
        y: &StateColumn<S>,
        free: &PerInput<S::Mechanism>,
    ) -> Result<Accelerations<S>, MotionErrorOf<S>> {
        let (q, free_rates) = self.unpack(y);
        let Some((_, frame)) = self.frame(&q, &free_rates)? else {
            let Equations { ratios, bias, .. } = self.scene.equations(t, y)?;
            return Ok(Accelerations::<S> { unknowns: ratios * *free + bias, inputs: *free });
        };
        Ok(frame.accelerations(free))
    }
}
