//! What the contacts of a scene are doing, and how that changes.

use super::bounded::{Bounds, bounded};
use super::held::{Held, Response, slipping};
use super::reduced::{ReducedContact, ReducedEquations};
use super::{ContactLaw, Mode};
use crate::MotionError;
use crate::integrate::{Crossing, Guard};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Column, Dim, InputError, Real, real};

/// A rate or a gap below this many roundings of its terms is zero.
pub(super) const NOTHING: f64 = 16.0;

/// The modes of the contacts of a scene, with what is remembered from one event to the next.
///
/// [`begin`](Self::begin) at the start of a motion, and [`settle`](Self::settle) wherever an event function of
/// [`events`](Self::events) has fallen through zero; between them [`motion`](Self::motion) is smooth. Time runs forward:
/// what an impact or friction has taken does not say where the motion came from.
///
/// **The end of bouncing.** A stop comes to rest where what its rebound would have left is less than the square root
/// of the scalar's rounding of the greatest rate that it was hit with since it last rested, or where the rebound would
/// be over within the rounding of the time, or no higher than one rounding of the place
/// ([`with_resolution`](Self::with_resolution); simulations do it).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contacts<T: Real, C: Dim> {
    /// By contact, in the order of the scene.
    pub modes: Column<Mode, C>,
    /// The greatest rate that a stop was hit with since it last rested.
    pub(super) hardest: Column<T, C>,
    /// How exactly the places of stops are known, beside roundings of their values.
    pub(super) resolution: Column<T, C>,
}

/// Accelerations, and the forces of the contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactMotion<T: Real, V: Dim, C: Dim> {
    /// v''.
    pub acceleration: Column<T, V>,
    /// By contact, along its s: the work of a contact is its force times the change of s. Where more contacts are
    /// held than the motion needs, their forces are not unique, and these are some that hold them.
    pub forces: Column<T, C>,
}

impl Mode {
    /// Whether s'' = 0 is kept by a force.
    #[must_use]
    pub fn is_held(self) -> bool {
        matches!(self, Self::Stick | Self::AtLower | Self::AtUpper)
    }

    /// 1 at a lower, -1 at an upper stop.
    pub(super) fn inward<T: Real>(self) -> T {
        if self == Self::AtUpper { -T::one() } else { T::one() }
    }
}

/// The stop that is nearer, and how far it is.
pub(super) fn nearer<T: Real, V: Dim>(contact: &ReducedContact<T, V>, lower: T, upper: T) -> (Mode, T) {
    let (below, above) = (contact.value - lower, upper - contact.value);
    if below <= above { (Mode::AtLower, below) } else { (Mode::AtUpper, above) }
}

/// What rounding may leave of the gap between values of this size.
fn rounding<T: Real>(value: T, bound: T) -> T {
    rounding_of(value.abs() + bound.abs())
}

/// What rounding may leave of terms of this size.
pub(crate) fn rounding_of<T: Real>(size: T) -> T {
    real::<T>(NOTHING) * T::default_epsilon() * size
}

pub(super) fn is_nothing<T: Real>((sum, size): (T, T)) -> bool {
    sum.abs() <= rounding_of(size)
}

impl<T: Real, C: Dim> Contacts<T, C> {
    /// The modes at the start of a motion, and the rates v' there: those given, but what touches a stop and moves
    /// towards it is thrown back at once. `evaluate` gives the equations at other rates.
    ///
    /// # Errors
    /// [`InputError::BeyondStop`] if a stop is passed already; else as [`settle`](Self::settle).
    pub fn begin<V: Dim>(
        t: T,
        rates: &Column<T, V>,
        evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C>, MotionError>,
    ) -> Result<(Self, Column<T, V>), MotionError> {
        let mut contacts = Self::open();
        let rates = contacts.start(t, rates, evaluate)?;
        Ok((contacts, rates))
    }

    /// The same with the resolution that these have; the rates.
    pub(crate) fn start<V: Dim>(
        &mut self,
        t: T,
        rates: &Column<T, V>,
        evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C>, MotionError>,
    ) -> Result<Column<T, V>, MotionError> {
        let mut evaluate = evaluate;
        let equations = evaluate(rates)?;
        for (contact, &resolution) in equations.contacts.iter().zip(&self.resolution) {
            if let ContactLaw::Stop { lower, upper, .. } = contact.law {
                within(equations.scene, contact.name, (contact.value, resolution), [lower, upper])?;
            }
        }
        self.resume(t, rates, evaluate)
    }

    /// Nothing acts.
    pub(crate) fn open() -> Self {
        Self { modes: Column::repeat(Mode::Open), hardest: Column::zeros(), resolution: Column::zeros() }
    }

    /// With what rounding may leave of each s where that is more than its value tells: a coordinate that is solved for
    /// is as near to a stop at zero as the closures are to zero. Nearer than this it touches, and a rebound that is no
    /// higher than a sixteenth of it is none.
    #[must_use]
    pub fn with_resolution(self, resolution: Column<T, C>) -> Self {
        Self { resolution, ..self }
    }

    /// On which side a stop is nearer, and what rounding may leave of the gap.
    pub(super) fn nearest<V: Dim>(
        &self,
        place: usize,
        contact: &ReducedContact<T, V>,
        [lower, upper]: [T; 2],
    ) -> (Mode, T, T) {
        let (side, gap) = nearer(contact, lower, upper);
        let bound = if side == Mode::AtLower { lower } else { upper };
        (side, gap, self.resolution[place].max(rounding(contact.value, bound)))
    }

    /// The modes that go with other rates v', given by a blow from outside; and the rates from here on, as those of
    /// [`begin`](Self::begin). What rests on a stop and keeps no rate rests on.
    ///
    /// # Errors
    /// As [`settle`](Self::settle).
    pub fn resume<V: Dim>(
        &mut self,
        t: T,
        rates: &Column<T, V>,
        evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C>, MotionError>,
    ) -> Result<Column<T, V>, MotionError> {
        let mut evaluate = evaluate;
        let equations = evaluate(rates)?;
        for (mode, contact) in self.modes.iter_mut().zip(&equations.contacts) {
            let rate = contact.rate(rates);
            match contact.law {
                ContactLaw::Friction { .. } => *mode = slip_or_stick(rate),
                ContactLaw::Stop { .. } if is_nothing(rate) => {}
                ContactLaw::Stop { .. } => *mode = Mode::Open,
            }
        }
        self.settle(t, rates, evaluate)
    }

    /// The accelerations in these modes.
    ///
    /// # Errors
    /// [`MotionError::NoInertia`], [`PositionError::NotFinite`](linkage_runtime::PositionError::NotFinite) as for the
    /// accelerations of free inputs.
    pub fn motion<V: Dim>(&self, equations: &ReducedEquations<T, V, C>) -> Result<ContactMotion<T, V, C>, MotionError> {
        let held = Held::new(equations, &self.modes)?;
        let mut forces = Column::<T, C>::zeros();
        for (place, contact) in equations.contacts.iter().enumerate() {
            forces[place] = slipping(self.modes[place], &contact.law);
        }
        if held.factors.rank < held.factors.count {
            // Some forces within their limits; what no force could hold the event functions tell.
            if let Ok(solution) = bounded(&held.response.matrix, &self.bounds(&held.response, equations)) {
                for place in (0..C::COUNT).filter(|&place| self.modes[place].is_held()) {
                    forces[place] = solution.forces[place];
                }
            }
        } else {
            for (&contact, &force) in held.factors.order.iter().zip(&held.forces).take(held.factors.rank) {
                forces[contact] = force;
            }
        }
        Ok(ContactMotion { acceleration: held.acceleration(equations), forces })
    }

    /// v'' alone.
    ///
    /// # Errors
    /// As [`motion`](Self::motion).
    pub fn acceleration<V: Dim>(&self, equations: &ReducedEquations<T, V, C>) -> Result<Column<T, V>, MotionError> {
        Ok(Held::new(equations, &self.modes)?.acceleration(equations))
    }

    /// By contact: of one that slips s', positive as it began; of an open stop how far it is; of one that sticks or
    /// rests what is left of what holds it. Something happens where it falls through zero.
    ///
    /// # Errors
    /// As [`motion`](Self::motion).
    pub fn events<V: Dim>(&self, equations: &ReducedEquations<T, V, C>) -> Result<Column<T, C>, MotionError> {
        let mut values = Column::repeat(T::one());
        if self.modes.iter().any(|mode| mode.is_held()) {
            values = Held::new(equations, &self.modes)?.margins(equations, &self.modes);
        }
        for ((value, mode), contact) in values.iter_mut().zip(self.modes).zip(&equations.contacts) {
            match (mode, contact.law) {
                (Mode::SlipForward, _) => *value = contact.rate(&equations.rates).0,
                (Mode::SlipBackward, _) => *value = -contact.rate(&equations.rates).0,
                (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => *value = nearer(contact, lower, upper).1,
                _ => {}
            }
        }
        Ok(values)
    }

    /// The guards with what is known of their change: of an open stop its rate.
    pub(crate) fn guards<V: Dim>(
        &self,
        equations: &ReducedEquations<T, V, C>,
    ) -> Result<Column<Guard<T>, C>, MotionError> {
        let values = self.events(equations)?;
        Ok(Column::from_fn(|place| {
            let contact = &equations.contacts[place];
            let rate = match (self.modes[place], contact.law) {
                (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => {
                    let (side, _) = nearer(contact, lower, upper);
                    Some(contact.rate(&equations.rates).0 * side.inward())
                }
                _ => None,
            };
            Guard { value: values[place], rate }
        }))
    }

    /// Which way the event functions pass through zero.
    #[must_use]
    pub fn crossings() -> Column<Crossing, C> {
        Column::repeat(Crossing::Falling)
    }

    /// The rates v' with those of what is held made zero, if they are not, and whether the modes are still those of
    /// this state: not where something slips the other way than its mode says, where more is held than the limits
    /// can, or where a stop has been passed. Rounding and the error of a step may do that at the end of a step; then
    /// [`settle`](Self::settle) mends it.
    ///
    /// # Errors
    /// As [`motion`](Self::motion).
    pub fn review<V: Dim>(&self, equations: &ReducedEquations<T, V, C>) -> Result<(Column<T, V>, bool), MotionError> {
        let values = self.events(equations)?;
        let mut holds = true;
        for (place, (&value, contact)) in values.iter().zip(&equations.contacts).enumerate() {
            holds &= match (self.modes[place], contact.law) {
                (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => {
                    let (side, gap, rounding) = self.nearest(place, contact, [lower, upper]);
                    let (rate, _) = contact.rate(&equations.rates);
                    -gap <= rounding || rate * side.inward() > T::zero()
                }
                // It has just begun, and rounding has left it on the other side.
                (mode @ (Mode::SlipForward | Mode::SlipBackward), _) if value < T::zero() => {
                    let acceleration = contact.row.dot(&self.acceleration(equations)?) + contact.bias;
                    acceleration * (if mode == Mode::SlipForward { T::one() } else { -T::one() }) > T::zero()
                }
                _ => value >= T::zero(),
            };
        }
        let rates = if self.modes.iter().any(|mode| mode.is_held()) {
            Held::new(equations, &self.modes)?.rates(equations)
        } else {
            equations.rates
        };
        Ok((rates, holds))
    }

    /// What the forces of the contacts that are held may be.
    pub(super) fn bounds<V: Dim>(
        &self,
        response: &Response<T, V, C>,
        equations: &ReducedEquations<T, V, C>,
    ) -> Column<Option<Bounds<T>>, C> {
        let endless = real::<T>(f64::INFINITY);
        Column::from_fn(|place| {
            let [lower, upper] = match (self.modes[place], equations.contacts[place].law) {
                (Mode::Stick, ContactLaw::Friction { limit }) => [-limit, limit],
                (Mode::AtLower, _) => [T::zero(), endless],
                (Mode::AtUpper, _) => [-endless, T::zero()],
                _ => return None,
            };
            Some(Bounds { lower, upper, bias: response.bias[place] })
        })
    }
}

pub(super) fn slip_or_stick<T: Real>((rate, size): (T, T)) -> Mode {
    if is_nothing((rate, size)) {
        Mode::Stick
    } else if rate > T::zero() {
        Mode::SlipForward
    } else {
        Mode::SlipBackward
    }
}

/// Refuses a scalar, of this resolution, beyond its stops by more than rounding.
pub(crate) fn within<T: Real>(
    scene: &'static str,
    stop: &'static str,
    (value, resolution): (T, T),
    [lower, upper]: [T; 2],
) -> Result<(), InputError> {
    for (gap, bound) in [(lower - value, lower), (value - upper, upper)] {
        if gap > resolution.max(rounding(value, bound)) {
            return Err(InputError::BeyondStop { scene, stop, gap: to_f64(gap) });
        }
    }
    Ok(())
}
