//! What the contacts of a scene are doing, and how that changes.

use nalgebra::SVector;

use super::bounded::{Bounds, bounded};
use super::held::{Held, Response, nothing, slipping};
use super::impact::{Struck, impact};
use super::reduced::{ReducedContact, ReducedEquations};
use super::{ContactLaw, Mode};
use crate::integrate::Crossing;
use crate::scalar::to_f64;
use crate::{Error, Real, real};

/// A rate or a gap below this many roundings of its terms is zero.
const ROUNDINGS: f64 = 16.0;
/// A flight of fewer roundings of the time than these is none.
const SHORTEST: f64 = 64.0;

/// The modes of the contacts of a scene, with what is remembered from one event to the next.
///
/// [`begin`](Self::begin) at the start of a motion, and [`settle`](Self::settle) wherever an event function of
/// [`events`](Self::events) has fallen through zero; between them [`motion`](Self::motion) is smooth.
///
/// **The end of bouncing.** A stop comes to rest where what its rebound would have left is less than the square root
/// of the scalar's rounding of the greatest rate that it was hit with since it last rested, or where the rebound would
/// be over within the rounding of the time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contacts<T, const C: usize> {
    /// By contact, in the order of the scene.
    pub modes: [Mode; C],
    /// The greatest rate that a stop was hit with since it last rested.
    hardest: [T; C],
}

/// Accelerations, and the forces of the contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactMotion<T, const V: usize, const C: usize> {
    /// v''.
    pub acceleration: SVector<T, V>,
    /// By contact, along its s: the work of a contact is its force times the change of s. Where more contacts are
    /// held than the motion needs, their forces are not unique, and these are some that hold them.
    pub forces: SVector<T, C>,
}

impl Mode {
    /// Whether s'' = 0 is kept by a force.
    #[must_use]
    pub fn is_held(self) -> bool {
        matches!(self, Self::Stick | Self::AtLower | Self::AtUpper)
    }

    /// 1 at a lower, -1 at an upper stop.
    fn inward<T: Real>(self) -> T {
        if self == Self::AtUpper { -T::one() } else { T::one() }
    }
}

/// The stop that is nearer, and how far it is.
fn nearer<T: Real, const V: usize>(contact: &ReducedContact<T, V>, lower: T, upper: T) -> (Mode, T) {
    let (below, above) = (contact.value - lower, upper - contact.value);
    if below <= above { (Mode::AtLower, below) } else { (Mode::AtUpper, above) }
}

/// Whether rounding could have made this gap.
fn touches<T: Real>(gap: T, value: T, bound: T) -> bool {
    gap <= real::<T>(ROUNDINGS) * T::default_epsilon() * (value.abs() + bound.abs())
}

fn is_nothing<T: Real>((sum, size): (T, T)) -> bool {
    sum.abs() <= real::<T>(ROUNDINGS) * T::default_epsilon() * size
}

impl<T: Real, const C: usize> Contacts<T, C> {
    /// The modes at the start of a motion, and the rates v' there: those given, but what touches a stop and moves
    /// towards it is thrown back at once. `evaluate` gives the equations at other rates.
    ///
    /// # Errors
    /// [`Error::BeyondStop`] if a stop is passed already; else as [`settle`](Self::settle).
    pub fn begin<const V: usize>(
        t: T,
        rates: &SVector<T, V>,
        evaluate: impl FnMut(&SVector<T, V>) -> Result<ReducedEquations<T, V, C>, Error>,
    ) -> Result<(Self, SVector<T, V>), Error> {
        let mut evaluate = evaluate;
        let equations = evaluate(rates)?;
        let mut modes = [Mode::Open; C];
        for (mode, contact) in modes.iter_mut().zip(&equations.contacts) {
            match contact.law {
                ContactLaw::Friction { .. } => *mode = slip_or_stick(contact.rate(rates)),
                ContactLaw::Stop { lower, upper, .. } => {
                    within(equations.scene, contact.name, contact.value, [lower, upper])?;
                }
            }
        }
        let mut contacts = Self { modes, hardest: [T::zero(); C] };
        let rates = contacts.settle(t, rates, evaluate)?;
        Ok((contacts, rates))
    }

    /// The accelerations in these modes.
    ///
    /// # Errors
    /// [`Error::NoInertia`], [`Error::NotFinite`] as [`reduced`](crate::reduced).
    pub fn motion<const V: usize>(
        &self,
        equations: &ReducedEquations<T, V, C>,
    ) -> Result<ContactMotion<T, V, C>, Error> {
        let held = Held::new(equations, &self.modes)?;
        let mut forces = SVector::<T, C>::zeros();
        for (place, contact) in equations.contacts.iter().enumerate() {
            forces[place] = slipping(self.modes[place], &contact.law);
        }
        if held.factors.rank < held.factors.count {
            // Some forces within their limits; what no force could hold the event functions tell.
            if let Ok(solution) = bounded(&held.response.matrix, &self.bounds(&held.response, equations)) {
                for place in (0..C).filter(|&place| self.modes[place].is_held()) {
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
    pub fn acceleration<const V: usize>(&self, equations: &ReducedEquations<T, V, C>) -> Result<SVector<T, V>, Error> {
        Ok(Held::new(equations, &self.modes)?.acceleration(equations))
    }

    /// By contact: of one that slips s', positive as it began; of an open stop how far it is; of one that sticks or
    /// rests what is left of what holds it. Something happens where it falls through zero.
    ///
    /// # Errors
    /// As [`motion`](Self::motion).
    pub fn events<const V: usize>(&self, equations: &ReducedEquations<T, V, C>) -> Result<[T; C], Error> {
        let mut values = [T::one(); C];
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

    /// Which way the event functions pass through zero.
    #[must_use]
    pub fn crossings() -> [Crossing; C] {
        [Crossing::Falling; C]
    }

    /// The rates v' with those of what is held made zero, if they are not, and whether the modes are still those of
    /// this state: not where something slips the other way than its mode says, where more is held than the limits
    /// can, or where a stop has been passed. Rounding and the error of a step may do that at the end of a step; then
    /// [`settle`](Self::settle) mends it.
    ///
    /// # Errors
    /// As [`motion`](Self::motion).
    pub fn review<const V: usize>(
        &self,
        equations: &ReducedEquations<T, V, C>,
    ) -> Result<(SVector<T, V>, bool), Error> {
        let values = self.events(equations)?;
        let mut holds = true;
        for ((&value, mode), contact) in values.iter().zip(self.modes).zip(&equations.contacts) {
            holds &= match (mode, contact.law) {
                (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => {
                    let (side, gap) = nearer(contact, lower, upper);
                    let bound = if side == Mode::AtLower { lower } else { upper };
                    let (rate, _) = contact.rate(&equations.rates);
                    gap >= T::zero() || touches(-gap, contact.value, bound) || rate * side.inward() > T::zero()
                }
                // It has just begun, and rounding has left it on the other side.
                (Mode::SlipForward | Mode::SlipBackward, _) if value < T::zero() => {
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

    /// What happens at the state where an event function has just fallen through zero: impacts, and the modes that
    /// follow. Gives the rates v' from here on. `evaluate` gives the equations at other rates.
    ///
    /// # Errors
    /// [`Error::NoContactForces`] if no forces hold what a prescribed motion takes along, and what `evaluate` returns.
    pub fn settle<const V: usize>(
        &mut self,
        t: T,
        rates: &SVector<T, V>,
        mut evaluate: impl FnMut(&SVector<T, V>) -> Result<ReducedEquations<T, V, C>, Error>,
    ) -> Result<SVector<T, V>, Error> {
        let mut equations = evaluate(rates)?;
        // What has no rate, and may be held: on which side if it is a stop.
        let mut at_rest: [Option<Mode>; C] = core::array::from_fn(|place| self.at_rest(place, &equations));
        if let Some(struck) = self.struck(&equations, &at_rest) {
            equations = self.strike(t, struck, &equations, &mut at_rest, &mut evaluate)?;
        }
        self.choose(&equations, &at_rest)?;
        // What slips on keeps its rate, however small: where s turns at a dead centre the mechanism does not stand.
        if self.modes.iter().any(|mode| mode.is_held()) {
            return Ok(Held::new(&equations, &self.modes)?.rates(&equations));
        }
        Ok(equations.rates)
    }

    /// The mode in which a contact would be held, if it has no rate.
    fn at_rest<const V: usize>(&self, place: usize, equations: &ReducedEquations<T, V, C>) -> Option<Mode> {
        let contact = &equations.contacts[place];
        let (rate, size) = contact.rate(&equations.rates);
        match (self.modes[place], contact.law) {
            (Mode::Stick | Mode::AtLower | Mode::AtUpper, _) => Some(self.modes[place]),
            (Mode::SlipForward, _) => (rate <= T::zero() || is_nothing((rate, size))).then_some(Mode::Stick),
            (Mode::SlipBackward, _) => (rate >= T::zero() || is_nothing((rate, size))).then_some(Mode::Stick),
            (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => {
                let (side, gap) = nearer(contact, lower, upper);
                let bound = if side == Mode::AtLower { lower } else { upper };
                (touches(gap, contact.value, bound) && is_nothing((rate, size))).then_some(side)
            }
            (Mode::Open, ContactLaw::Friction { .. }) => None,
        }
    }

    /// The stops that take part in an impact, if there is one.
    fn struck<const V: usize>(
        &self,
        equations: &ReducedEquations<T, V, C>,
        at_rest: &[Option<Mode>; C],
    ) -> Option<[Option<Struck<T>>; C]> {
        let mut hit = false;
        let struck = core::array::from_fn(|place| {
            let contact = &equations.contacts[place];
            let ContactLaw::Stop { lower, upper, restitution } = contact.law else { return None };
            if let Some(side) = at_rest[place] {
                return Some(Struck { inward: side.inward(), restitution: T::zero() });
            }
            let (side, gap) = nearer(contact, lower, upper);
            let bound = if side == Mode::AtLower { lower } else { upper };
            let approaches = contact.rate(&equations.rates).0 * side.inward() < T::zero();
            (touches(gap, contact.value, bound) && approaches).then(|| {
                hit = true;
                Struck { inward: side.inward(), restitution }
            })
        });
        hit.then_some(struck)
    }

    /// An impact: the equations at the rates after it, and what is at rest then.
    fn strike<const V: usize>(
        &mut self,
        t: T,
        mut struck: [Option<Struck<T>>; C],
        equations: &ReducedEquations<T, V, C>,
        at_rest: &mut [Option<Mode>; C],
        evaluate: &mut impl FnMut(&SVector<T, V>) -> Result<ReducedEquations<T, V, C>, Error>,
    ) -> Result<ReducedEquations<T, V, C>, Error> {
        let least = T::default_epsilon().sqrt();
        for place in (0..C).filter(|&place| at_rest[place].is_none()) {
            let Some(of) = &mut struck[place] else { continue };
            let rate = equations.contacts[place].rate(&equations.rates).0.abs();
            self.hardest[place] = self.hardest[place].max(rate);
            if of.restitution * rate <= least * self.hardest[place] {
                of.restitution = T::zero();
            }
        }
        let (rates, _) = impact(equations, &struck)?;
        let mut after = evaluate(&rates)?;
        // A rebound that is over within the rounding of the time is none.
        let free = Response::new(&after, &[T::zero(); C], |place| struck[place].is_some())?;
        let shortest = real::<T>(SHORTEST) * T::default_epsilon() * t.abs();
        let mut again = false;
        for (place, of) in struck.iter_mut().enumerate() {
            let Some(Struck { inward, restitution }) = of else { continue };
            let (rate, back) = (after.contacts[place].rate(&rates).0 * *inward, -free.bias[place].0 * *inward);
            if !restitution.is_zero() && back > T::zero() && real::<T>(2.0) * rate <= shortest * back {
                *restitution = T::zero();
                again = true;
            }
        }
        let mut pushed = [T::zero(); C];
        if again || struck.iter().flatten().any(|of| of.restitution.is_zero()) {
            let (rates, impulses) = impact(equations, &struck)?;
            after = evaluate(&rates)?;
            pushed = impulses;
        }
        for (place, contact) in after.contacts.iter().enumerate() {
            // What rounding leaves is beside the rates before and after.
            let (rate, size) = contact.rate(&after.rates);
            let none = is_nothing((rate, size + equations.contacts[place].rate(&equations.rates).1));
            match contact.law {
                ContactLaw::Friction { .. } => {
                    at_rest[place] = none.then_some(Mode::Stick);
                    self.modes[place] = slip_or_stick((rate, size));
                }
                ContactLaw::Stop { .. } => {
                    let Some(of) = struck[place] else { continue };
                    let side = if of.inward > T::zero() { Mode::AtLower } else { Mode::AtUpper };
                    let rests = of.restitution.is_zero() && (none || pushed[place] > T::zero());
                    at_rest[place] = rests.then_some(side);
                    self.modes[place] = if rests { side } else { Mode::Open };
                }
            }
        }
        if at_rest.iter().any(Option::is_some) {
            let resting = core::array::from_fn(|place| at_rest[place].unwrap_or(Mode::Open));
            after.rates = Held::new(&after, &resting)?.rates(&after);
        }
        Ok(after)
    }

    /// The modes of what has no rate: those in which forces within their bounds hold it or let it go.
    fn choose<const V: usize>(
        &mut self,
        equations: &ReducedEquations<T, V, C>,
        at_rest: &[Option<Mode>; C],
    ) -> Result<(), Error> {
        let slips = |place: usize| at_rest[place].is_none();
        let forces = core::array::from_fn(|place| {
            if slips(place) { slipping(self.modes[place], &equations.contacts[place].law) } else { T::zero() }
        });
        let response = Response::new(equations, &forces, |place| !slips(place))?;
        let supposed = Self { modes: core::array::from_fn(|place| at_rest[place].unwrap_or(Mode::Open)), ..*self };
        let solution = bounded(&response.matrix, &supposed.bounds(&response, equations)).map_err(|place| {
            Error::NoContactForces { scene: equations.scene, contact: equations.contacts[place].name }
        })?;
        for (place, side) in at_rest.iter().enumerate() {
            let Some(side) = *side else { continue };
            let slack = solution.slack[place];
            self.modes[place] = match side {
                Mode::Stick if slack > T::zero() => Mode::SlipForward,
                Mode::Stick if slack < T::zero() => Mode::SlipBackward,
                Mode::AtLower | Mode::AtUpper if slack * side.inward() > T::zero() => Mode::Open,
                held => held,
            };
            // A series of bounces ends where a stop is left from rest, or rested on.
            self.hardest[place] = T::zero();
        }
        // Where the others leave nothing to move, a force at its limit holds as well.
        let acceleration = self.acceleration(equations)?;
        for (place, contact) in equations.contacts.iter().enumerate() {
            let Some(side) = at_rest[place] else { continue };
            let terms = contact.row.component_mul(&acceleration);
            let (sum, size) = (terms.sum() + contact.bias, terms.abs().sum() + contact.bias.abs());
            let goes = match self.modes[place] {
                Mode::SlipForward => sum,
                Mode::SlipBackward => -sum,
                Mode::Open => sum * side.inward(),
                _ => continue,
            };
            if goes <= nothing::<T>() * size {
                self.modes[place] = side;
            }
        }
        Ok(())
    }

    /// What the forces of the contacts that are held may be.
    fn bounds<const V: usize>(
        &self,
        response: &Response<T, V, C>,
        equations: &ReducedEquations<T, V, C>,
    ) -> [Option<Bounds<T>>; C] {
        let endless = real::<T>(f64::INFINITY);
        core::array::from_fn(|place| {
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

fn slip_or_stick<T: Real>((rate, size): (T, T)) -> Mode {
    if is_nothing((rate, size)) {
        Mode::Stick
    } else if rate > T::zero() {
        Mode::SlipForward
    } else {
        Mode::SlipBackward
    }
}

/// Refuses a scalar beyond its stops by more than rounding.
pub(crate) fn within<T: Real>(
    scene: &'static str,
    stop: &'static str,
    value: T,
    [lower, upper]: [T; 2],
) -> Result<(), Error> {
    for (gap, bound) in [(lower - value, lower), (value - upper, upper)] {
        if gap > T::zero() && !touches(gap, value, bound) {
            return Err(Error::BeyondStop { scene, stop, gap: to_f64(gap) });
        }
    }
    Ok(())
}
