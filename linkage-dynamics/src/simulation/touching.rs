//! Frictions and stops of a scene in motion, by whatever coordinates it is followed.

use nalgebra::{SMatrix, SVector};

use super::motion::{Motion, Road};
use crate::contact::{Change, Contact, Contacts, ReducedContact, ReducedEquations, changes};
use crate::integrate::Guard;
use crate::{Mode, Scene};
use linkage_runtime::{Error, Mechanism, Real};

impl<S, W, T, const U: usize, const V: usize, const N: usize, const C: usize> Motion<'_, S, W, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    /// M, Q and the contacts in the coordinates of the motion.
    ///
    /// # Errors
    /// [`Error::ChangePoint`] so near to one that [J A] does not tell how rates depend on each other, if it is not passed.
    fn equations(&self, t: T, y: &SVector<T, N>) -> Result<ReducedEquations<T, V, C>, Error> {
        match &self.road {
            Road::Inputs => ReducedEquations::of(self.scene, t, y),
            Road::Others(independent) | Road::Over(independent, _) => {
                let (q, _) = S::parts(y);
                match (self.regular(independent, &q), &self.road) {
                    (Some(factors), _) => Ok(self.equations_by(independent, &factors, (t, y))?.0),
                    (None, Road::Over(_, step)) => self.equations_over(independent, step, (t, y)),
                    (None, _) => Err(self.change_point(&q)),
                }
            }
        }
    }

    /// The contacts with their s and s' alone: nothing is told of what would move them.
    pub(super) fn contacts_alone(&self, t: T, y: &SVector<T, N>) -> Result<ReducedEquations<T, V, C>, Error> {
        let (q, rates) = Self::unpack(y);
        let (unknowns, inputs) = self.velocity(t, y)?;
        let velocity = Self::joined(&q, (unknowns, inputs));
        let contacts = self.scene.contacts(t, &q, &velocity)?.map(|contact| ReducedContact {
            name: contact.name,
            value: contact.along.value,
            row: SVector::zeros(),
            drift: contact.along.unknowns.dot(&unknowns) + contact.along.inputs.dot(&inputs),
            bias: T::zero(),
            law: contact.law,
        });
        let coordinates = <S::Mechanism as Mechanism<T, U, V>>::INPUTS;
        let (mass, forces) = (SMatrix::identity(), SVector::zeros());
        Ok(ReducedEquations { scene: S::NAME, coordinates, mass, forces, rates, contacts })
    }

    /// How far each contact is from another mode, with the closures closed.
    pub(super) fn margins(&self, t: T, y: &SVector<T, N>) -> Result<[Guard<T>; C], Error> {
        // A step in the inputs may have gone where nothing closes: it will be taken again.
        let y = self.closed(t, y).unwrap_or(*y);
        let is_free = self.contacts.modes.iter().all(|&mode| mode == Mode::Open);
        let equations = if is_free { self.contacts_alone(t, &y)? } else { self.equations(t, &y)? };
        self.contacts.guards(&equations)
    }

    /// What rounding may leave of each s.
    fn resolution(&self, t: T, y: &SVector<T, N>) -> Result<[T; C], Error> {
        let (q, _) = Self::unpack(y);
        let velocity = Self::joined(&q, self.velocity(t, y)?);
        let contacts = self.scene.contacts(t, &q, &velocity)?;
        let mut resolution = [T::zero(); C];
        for (resolution, Contact { along, .. }) in resolution.iter_mut().zip(&contacts) {
            *resolution = match self.road {
                Road::Inputs => self.scales.resolution_by_inputs(self.scene.mechanism(), &q, along)?,
                Road::Others(_) | Road::Over(..) => self.scales.resolution::<S::Mechanism>(&q, along),
            };
        }
        Ok(resolution)
    }

    /// The modes at the start, and y with the rates from there on.
    pub(super) fn begin(&mut self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        let (q, rates) = Self::unpack(y);
        let mut contacts = self.contacts.with_resolution(self.resolution(t, y)?);
        let rates = contacts.start(t, &rates, |rates| self.equations(t, &Self::pack(&q, rates)))?;
        self.names = self.contacts_alone(t, y)?.contacts.map(|contact| contact.name);
        self.contacts = contacts;
        Ok(Self::pack(&q, &rates))
    }

    /// What happens at this state: y from here on, and what each contact has done.
    pub(super) fn settled(&mut self, t: T, y: &SVector<T, N>) -> Result<(SVector<T, N>, [Option<Change>; C]), Error> {
        self.decided(t, y, y, false)
    }

    /// The same where the rates have just become those of `y`, from those of `before`.
    pub(super) fn resumed(
        &mut self,
        t: T,
        before: &SVector<T, N>,
        y: &SVector<T, N>,
    ) -> Result<(SVector<T, N>, [Option<Change>; C]), Error> {
        self.decided(t, before, y, true)
    }

    fn decided(
        &mut self,
        t: T,
        before: &SVector<T, N>,
        y: &SVector<T, N>,
        anew: bool,
    ) -> Result<(SVector<T, N>, [Option<Change>; C]), Error> {
        if C == 0 {
            return Ok((*y, [None; C]));
        }
        let (q, rates) = Self::unpack(y);
        self.contacts = self.contacts.with_resolution(self.resolution(t, y)?);
        let mut contacts = self.contacts;
        let at = |rates: &SVector<T, V>| self.equations(t, &Self::pack(&q, rates));
        let rates = if anew { contacts.resume(t, &rates, at)? } else { contacts.settle(t, &rates, at)? };
        let after = Self::pack(&q, &rates);
        let done = changes((&self.contacts, &self.equations(t, before)?), (&contacts, &self.equations(t, &after)?));
        self.contacts = contacts;
        Ok((after, done))
    }

    /// y with the rates of what is held made zero, and whether the modes are still those of this state.
    pub(super) fn reviewed(
        &self,
        contacts: &Contacts<T, C>,
        t: T,
        y: &SVector<T, N>,
    ) -> Result<(SVector<T, N>, bool), Error> {
        if C == 0 {
            return Ok((*y, true));
        }
        if contacts.modes.iter().all(|&mode| mode == Mode::Open) && contacts.review(&self.contacts_alone(t, y)?)?.1 {
            return Ok((*y, true));
        }
        let (rates, holds) = contacts.review(&self.equations(t, y)?)?;
        Ok((Self::pack(&S::parts(y).0, &rates), holds))
    }

    /// The forces of the contacts, and those of the drives by input, zero where there is none.
    ///
    /// A drive of the input `v_i` does the work of its force alone: in any coordinates among which the prescribed inputs
    /// are it is what is left of M v'' = Q + S' f in its row.
    pub(super) fn loads(&self, t: T, y: &SVector<T, N>) -> Result<([T; C], SVector<T, V>), Error> {
        let (q, _) = S::parts(y);
        let (free, places) = match &self.road {
            Road::Inputs => (ReducedEquations::unprescribed(self.scene, t, y)?.0, core::array::from_fn(Some)),
            Road::Others(independent) | Road::Over(independent, _) => {
                let factors = self.regular(independent, &q).ok_or_else(|| self.change_point(&q))?;
                let place = |input: usize| independent.free.iter().position(|&free| free == U + input);
                (self.unprescribed_by(independent, &factors, (t, y))?.0, core::array::from_fn(place))
            }
        };
        let motion = self.contacts.motion(&self.equations(t, y)?)?;
        let mut left = free.mass * motion.acceleration - free.forces;
        for (contact, &force) in free.contacts.iter().zip(&motion.forces) {
            left -= contact.row * force;
        }
        let places: [Option<usize>; V] = places;
        let held = self.held(t);
        let drives = SVector::from_fn(|input, _| match places[input] {
            Some(place) if held[input] => left[place],
            _ => T::zero(),
        });
        Ok((motion.forces.into(), drives))
    }
}
