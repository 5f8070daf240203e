//! The modes of the contacts of a scene, and their events.

use super::bounded::{Bounds, bounded};
use super::held::{Held, Response, slipping};
use super::motion::{ContactMotion, nearer};
use super::reduced::{ReducedContact, ReducedEquations};
use super::tolerance::{gap_tolerance, is_negligible, sum_tolerance, within};
use super::{ContactLaw, Mode, reaction};
use crate::MotionError;
use crate::integrate::{Crossing, Guard};
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real, real};

/// The modes of the contacts of a scene, with the memory needed from one event to the next.
///
/// Call [`begin`](Self::begin) at the start of a motion, and [`settle`](Self::settle) wherever one of the
/// [`events`](Self::events) has fallen through zero; between events [`motion`](Self::motion) is smooth. Time runs
/// forward: energy that impacts and friction dissipate cannot be recovered.
///
/// **The end of bouncing.** s comes to rest on a stop where the rebound rate is less than sqrt(epsilon) times the
/// greatest impact rate since it last rested, or where the rebound would be shorter than the rounding error of the
/// time, or lower than that of the gap ([`with_resolution`](Self::with_resolution), which simulations call). So it does
/// where s leaves a stop by the impact of another contact, so that a body that rocks between two stops rests on both.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(serialize = "T: serde::Serialize", deserialize = "T: serde::Deserialize<'de>, C: Default"))
)]
pub struct Contacts<T: Real, C: Dim> {
    /// The mode of each contact, in the order of the scene.
    pub modes: Column<Mode, C>,
    /// The greatest impact rate of each stop since s last rested on it.
    pub(super) hardest: Column<T, C>,
    /// The error of each s where it exceeds the rounding error of its value, else zero.
    pub(super) resolution: Column<T, C>,
    /// True for each stop that was hit when the contacts settled last.
    pub(super) is_hit: Column<bool, C>,
}

/// The rates at a state and the validity of the modes there: see [`Contacts::review`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(serialize = "T: serde::Serialize", deserialize = "T: serde::Deserialize<'de>, V: Default"))
)]
pub struct ContactReview<T: Real, V: Dim> {
    /// The rates v' with s' = 0 of the held contacts.
    pub rates: Column<T, V>,
    /// False if a contact slips against its mode, exceeds its limit, or is beyond a stop.
    pub modes_hold: bool,
}

impl Mode {
    /// Returns true if a force keeps `s'' = 0`.
    #[must_use]
    pub fn is_held(self) -> bool {
        matches!(self, Self::Stick | Self::AtLower | Self::AtUpper)
    }

    /// The direction of s away from the stop: 1 at a lower, -1 at an upper stop.
    pub(super) fn inward<T: Real>(self) -> T {
        if self == Self::AtUpper { -T::one() } else { T::one() }
    }
}

impl<T: Real, C: Dim> Contacts<T, C> {
    /// Finds the modes at the start of a motion and the rates v': the given rates, after the impact of any s that
    /// touches a stop and moves towards it. `evaluate` computes the equations at given rates.
    ///
    /// # Errors
    /// [`InputError::BeyondStop`](linkage_runtime::InputError::BeyondStop) if an s is beyond its stop; those of
    /// [`settle`](Self::settle).
    pub fn begin<V: Dim, N: BorrowedName>(
        t: T,
        rates: &Column<T, V>,
        mut evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
    ) -> Result<(Self, Column<T, V>), MotionError<N>> {
        let equations = evaluate(rates)?;
        let mut contacts = Self::open(equations.contacts.dim());
        let rates = contacts.start_from(&equations, t, rates, evaluate)?;
        Ok((contacts, rates))
    }

    /// Does the same as [`begin`](Self::begin), with the resolution stored here; returns the rates.
    pub(crate) fn start<V: Dim, N: BorrowedName>(
        &mut self,
        t: T,
        rates: &Column<T, V>,
        mut evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
    ) -> Result<Column<T, V>, MotionError<N>> {
        let equations = evaluate(rates)?;
        self.start_from(&equations, t, rates, evaluate)
    }

    fn start_from<V: Dim, N: BorrowedName>(
        &mut self,
        equations: &ReducedEquations<T, V, C, N>,
        t: T,
        rates: &Column<T, V>,
        evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
    ) -> Result<Column<T, V>, MotionError<N>> {
        for (contact, &resolution) in equations.contacts.iter().zip(&self.resolution) {
            if let ContactLaw::Stop { lower, upper, .. } = contact.law {
                within(equations.scene, contact.name, (contact.value, resolution), [lower, upper])?;
            }
        }
        self.resume(t, rates, evaluate)
    }

    /// Contacts in given modes, for [`motion`](Self::motion) at one state.
    #[must_use]
    pub fn in_modes(modes: Column<Mode, C>) -> Self {
        let c = modes.dim();
        Self { modes, hardest: c.zeros(), resolution: c.zeros(), is_hit: c.repeat(false) }
    }

    /// All contacts open.
    pub(crate) fn open(c: C) -> Self {
        Self::in_modes(c.repeat(Mode::Open))
    }

    /// Sets the error of each s where it exceeds the rounding error of its value: a solved coordinate is only as
    /// accurate as the constraints. At a smaller distance s touches its stop; a rebound lower than a sixteenth of it
    /// counts as rest.
    #[must_use]
    pub fn with_resolution(self, resolution: Column<T, C>) -> Self {
        Self { resolution, ..self }
    }

    /// Returns the nearer stop, the gap to it, and the tolerance of the gap.
    pub(super) fn nearest<V: Dim, N: BorrowedName>(
        &self,
        place: usize,
        contact: &ReducedContact<T, V, N>,
        [lower, upper]: [T; 2],
    ) -> (Mode, T, T) {
        let (side, gap) = nearer(contact, lower, upper);
        let bound = if side == Mode::AtLower { lower } else { upper };
        (side, gap, self.resolution[place].max(gap_tolerance(contact.value, bound)))
    }

    /// Recomputes the modes after an external impulse that has changed the rates to v'; returns the rates as
    /// [`begin`](Self::begin) does. An s that rests on a stop with zero rate stays at rest.
    ///
    /// # Errors
    /// Those of [`settle`](Self::settle).
    pub fn resume<V: Dim, N: BorrowedName>(
        &mut self,
        t: T,
        rates: &Column<T, V>,
        evaluate: impl FnMut(&Column<T, V>) -> Result<ReducedEquations<T, V, C, N>, MotionError<N>>,
    ) -> Result<Column<T, V>, MotionError<N>> {
        let mut evaluate = evaluate;
        let equations = evaluate(rates)?;
        for (mode, contact) in self.modes.iter_mut().zip(&equations.contacts) {
            let rate = contact.rate(rates);
            match contact.law {
                ContactLaw::Friction { .. } | ContactLaw::Bearing { .. } => *mode = slip_or_stick(rate),
                ContactLaw::Stop { .. } if is_negligible(rate) => {}
                ContactLaw::Stop { .. } => *mode = Mode::Open,
            }
        }
        self.settle(t, rates, evaluate)
    }

    /// Computes the accelerations and contact forces in these modes.
    ///
    /// # Errors
    /// [`MotionError::NoInertia`], [`PositionError::NotFinite`](linkage_runtime::PositionError::NotFinite) as for the
    /// accelerations of free inputs. With a [`Bearing`](ContactLaw::Bearing) [`MotionError::NoMotion`] or
    /// [`MotionError::SeveralMotions`] where none or several accelerations satisfy the laws in these modes, and
    /// [`MotionError::UndecidedMotion`].
    pub fn motion<V: Dim, N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
    ) -> Result<ContactMotion<T, V, C>, MotionError<N>> {
        if equations.has_bearings() {
            return reaction::motion(equations, &self.modes);
        }
        let held = Held::new(equations, &self.modes)?;
        let mut forces = self.modes.dim().zeros();
        for (place, contact) in equations.contacts.iter().enumerate() {
            forces[place] = slipping(self.modes[place], &contact.law);
        }
        if held.factors.rank < held.factors.count {
            // One solution within the limits. If there is none, the event functions report the contact.
            if let Ok(solution) = bounded(&held.response.matrix, &self.bounds(&held.response, equations)) {
                for place in (0..self.modes.dim().count()).filter(|&place| self.modes[place].is_held()) {
                    forces[place] = solution.forces[place];
                }
            }
        } else {
            for (&contact, &force) in held.factors.order.iter().zip(&held.forces).take(held.factors.rank) {
                forces[contact] = force;
            }
        }
        let are_unique = held.factors.rank == held.factors.count;
        Ok(ContactMotion { acceleration: held.acceleration(equations), forces, are_unique })
    }

    /// Computes `v''` alone.
    ///
    /// # Errors
    /// Those of [`motion`](Self::motion).
    pub fn acceleration<V: Dim, N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
    ) -> Result<Column<T, V>, MotionError<N>> {
        if equations.has_bearings() {
            return Ok(reaction::motion(equations, &self.modes)?.acceleration);
        }
        Ok(Held::new(equations, &self.modes)?.acceleration(equations))
    }

    /// The event function of each contact: |s'| while it slips (s' with the sign of the mode), the gap of an open stop,
    /// the margin of a contact that sticks or rests. Its mode changes where the function falls through zero.
    ///
    /// # Errors
    /// Those of [`motion`](Self::motion).
    pub fn events<V: Dim, N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
    ) -> Result<Column<T, C>, MotionError<N>> {
        let mut values = self.modes.dim().repeat(T::one());
        if self.modes.iter().any(|mode| mode.is_held()) {
            values = if equations.has_bearings() {
                reaction::margins(equations, &self.modes)?
            } else {
                Held::new(equations, &self.modes)?.margins(equations, &self.modes)
            };
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

    /// The event functions as guards; the rate is known for open stops. Where slip begins, or where s leaves a stop without
    /// load, s' and the gap are zero within rounding error for some time: a contact slips until s' is negative beyond its
    /// rounding error, and a stop that is touched is hit where s' is negative beyond it.
    pub(crate) fn guards<V: Dim, N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
    ) -> Result<Column<Guard<T>, C>, MotionError<N>> {
        let values = self.events(equations)?;
        Ok(self.modes.dim().column(|place| {
            let contact = &equations.contacts[place];
            let (rate, size) = contact.rate(&equations.rates);
            match (self.modes[place], contact.law) {
                (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => {
                    let (side, gap, tolerance) = self.nearest(place, contact, [lower, upper]);
                    let rate = if is_negligible((rate, size)) { T::zero() } else { rate * side.inward() };
                    let is_touched = rate >= T::zero() && gap.abs() <= tolerance;
                    Guard { value: if is_touched { gap.max(T::zero()) } else { gap }, rate: Some(rate) }
                }
                (Mode::SlipForward | Mode::SlipBackward, _) => {
                    Guard { value: values[place] + sum_tolerance(size), rate: None }
                }
                _ => Guard { value: values[place], rate: None },
            }
        }))
    }

    /// The direction in which the event functions pass through zero.
    #[must_use]
    pub fn crossings(&self) -> Column<Crossing, C> {
        self.modes.dim().repeat(Crossing::Falling)
    }

    /// Returns the rates v' with s' = 0 of the held contacts, and whether the modes are still valid: rounding error and
    /// the error of a step may end them at the end of a step. Then call [`settle`](Self::settle).
    ///
    /// # Errors
    /// Those of [`motion`](Self::motion).
    pub fn review<V: Dim, N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
    ) -> Result<ContactReview<T, V>, MotionError<N>> {
        let values = self.events(equations)?;
        let mut modes_hold = true;
        for (place, (&value, contact)) in values.iter().zip(&equations.contacts).enumerate() {
            modes_hold &= match (self.modes[place], contact.law) {
                (Mode::Open, ContactLaw::Stop { lower, upper, .. }) => {
                    let (side, gap, tolerance) = self.nearest(place, contact, [lower, upper]);
                    let (rate, _) = contact.rate(&equations.rates);
                    -gap <= tolerance || rate * side.inward() > T::zero()
                }
                // Slip has just begun, and rounding error gives its rate the wrong sign.
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
        Ok(ContactReview { rates, modes_hold })
    }

    /// The bounds of the forces of the held contacts.
    pub(super) fn bounds<V: Dim, N: BorrowedName>(
        &self,
        response: &Response<T, V, C>,
        equations: &ReducedEquations<T, V, C, N>,
    ) -> Column<Option<Bounds<T>>, C> {
        let endless = real::<T>(f64::INFINITY);
        self.modes.dim().column(|place| {
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
    if is_negligible((rate, size)) {
        Mode::Stick
    } else if rate > T::zero() {
        Mode::SlipForward
    } else {
        Mode::SlipBackward
    }
}
