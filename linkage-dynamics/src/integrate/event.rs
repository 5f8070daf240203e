//! Events: zeros of functions of the state, and the actions there.

use super::crossing::Crossing;
use super::sampled::{FunctionSample, Sample, is_same, sampled};
use super::system::{ErrorOf, StateOf, System};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Build, Column, Dim, Name};

/// The most events of one guard at one time: guards that are zero within rounding error may trigger each other.
const MAX_REPEATS: u32 = 8;

/// The sign of each function up to the time reached, for the user's event functions and for the guards of the system:
/// an event is a change of sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct EventSigns<K: Dim, C: Dim> {
    pub(super) events: Column<EventSign, K>,
    pub(super) guards: Column<EventSign, C>,
}

/// The sign of one function, and its events at the time reached.
#[derive(Debug, Clone, Copy)]
pub(super) struct EventSign {
    /// 1 or -1; 0 for an event function that has been zero since the start, or a guard that has not been positive.
    pub(super) sign: i8,
    /// True if it has an event at the time reached that is not delivered yet.
    pub(super) is_pending: bool,
    /// The number of its events at the last event time.
    count: u32,
    /// |value| at the time reached if the function has its event there, else -1.
    pub(super) residual: f64,
    /// The largest |value| at the start of a step since the last restart.
    pub(super) largest: f64,
    /// The direction of its events; None for a guard, whose event is where it falls below zero, not at zero.
    crossing: Option<Crossing>,
}

/// The sign of a value that is not NaN.
fn sign(value: f64) -> i8 {
    if value > 0.0 {
        1
    } else if value < 0.0 {
        -1
    } else {
        0
    }
}

impl EventSign {
    fn new(crossing: Option<Crossing>) -> Self {
        Self { sign: 0, is_pending: false, count: 0, residual: -1.0, largest: 0.0, crossing }
    }

    pub(super) fn is_guard(&self) -> bool {
        self.crossing.is_none()
    }

    /// Returns true if an event function has reached or passed zero since the last sign, or a guard has passed it: at
    /// zero a guard holds, such as a stop with zero load. A guard that started at zero or below has passed it if it is
    /// negative and falling.
    pub(super) fn passed(&self, sample: &FunctionSample) -> bool {
        match self.sign {
            0 => self.is_guard() && sample.value < 0.0 && sample.rate < 0.0,
            1 if self.is_guard() => sample.value < 0.0,
            own => sign(sample.value) != own,
        }
    }

    /// Returns true if the passage from this sign is an event.
    pub(super) fn is_event(&self) -> bool {
        match self.crossing {
            Some(Crossing::Rising) => self.sign < 0,
            Some(Crossing::Falling) => self.sign > 0,
            Some(Crossing::Either) => true,
            None => self.sign >= 0,
        }
    }

    /// Returns the value with its sign reversed if needed: positive before the passage, zero or negative after it.
    pub(super) fn distance_before(&self, sample: &FunctionSample) -> f64 {
        let distance = if self.sign < 0 { -sample.value } else { sample.value };
        let passed = self.passed(sample);
        if passed == (distance <= 0.0) {
            distance
        } else if passed {
            0.0
        } else {
            f64::MIN_POSITIVE
        }
    }

    /// Returns the rate away from zero: negative if the function approaches zero.
    pub(super) fn rate_away(&self, sample: &FunctionSample) -> f64 {
        if self.sign < 0 { -sample.rate } else { sample.rate }
    }

    /// Returns true if the function approaches zero after the first sample and has turned away from it before the
    /// second. At one of them its rate may be zero.
    pub(super) fn has_extremum(&self, before: &FunctionSample, here: &FunctionSample) -> bool {
        let (start, end) = (self.rate_away(before), self.rate_away(here));
        !self.has_known_course(here)
            && self.sign != 0
            && !self.passed(here)
            && start <= 0.0
            && end >= 0.0
            && start < end
    }

    /// Returns true for a guard with a known rate that has not fallen through zero.
    pub(super) fn has_known_course(&self, sample: &FunctionSample) -> bool {
        self.is_guard() && sample.is_known && self.sign >= 0
    }

    /// Returns true if the function is nearer to zero at the second sample.
    pub(super) fn approaches_zero(&self, before: &FunctionSample, here: &FunctionSample) -> bool {
        let change = here.value - before.value;
        !is_same(here.value, before.value) && (if self.sign < 0 { -change } else { change }) < 0.0
    }
}

impl<K: Dim, C: Dim> EventSigns<K, C> {
    pub(super) fn new(crossings: Column<Crossing, K>, guards: C) -> Self {
        Self {
            events: crossings.map(|crossing| EventSign::new(Some(crossing))),
            guards: guards.repeat(EventSign::new(None)),
        }
    }

    pub(super) fn each(&self) -> impl Iterator<Item = &EventSign> {
        self.events.iter().chain(&self.guards)
    }

    pub(super) fn each_mut(&mut self) -> impl Iterator<Item = &mut EventSign> {
        self.events.iter_mut().chain(&mut self.guards)
    }

    pub(super) fn guards(&self) -> impl Iterator<Item = &EventSign> {
        self.guards.iter()
    }

    /// Returns true if an event is not delivered yet.
    pub(super) fn has_pending(&self) -> bool {
        self.each().any(|function| function.is_pending)
    }

    /// Updates the largest values from the sample at the start of a step.
    pub(super) fn grow(&mut self, start: &Sample<K, C>) -> Column<f64, C> {
        for (function, sample) in self.each_mut().zip(start.each()) {
            function.largest = function.largest.max(sample.value.abs());
        }
        self.guards.map(|guard| guard.largest)
    }

    /// Forgets the largest values: after a restart the guards are other functions.
    pub(super) fn forget_largest(&mut self) {
        self.each_mut().for_each(|function| function.largest = 0.0);
    }

    /// Drops undelivered events.
    pub(super) fn drop_pending(&mut self) {
        self.each_mut().for_each(|function| function.is_pending = false);
    }

    /// Resets the event counts at a new event time.
    pub(super) fn reset_counts(&mut self) {
        self.each_mut().for_each(|function| function.count = 0);
    }

    /// Takes the next undelivered event; returns its index, and true if it has occurred too often at this time.
    pub(super) fn take_pending(&mut self) -> (usize, bool) {
        let events = self.events.dim().count();
        let next = self.each_mut().enumerate().find(|(_, function)| function.is_pending);
        next.map_or((0, false), |(event, function)| {
            function.is_pending = false;
            function.count += 1;
            (event, function.count > if event < events { 1 } else { MAX_REPEATS })
        })
    }

    /// Sets the signs at the start of a motion, or at a restart. An event function that is zero there has the sign that
    /// it takes a little later, at `after`; after its own event it counts as zero up to its residual. A guard counts as
    /// positive, because its law of the rate holds at the start: if it stays negative its event repeats; with a known
    /// rate only if it is falling.
    pub(super) fn begin<S: System<Events = K, Guards = C>>(
        &mut self,
        system: &mut S,
        (t, state): (S::Scalar, &StateOf<S>),
        (later, after): (S::Scalar, &StateOf<S>),
    ) -> Result<(), ErrorOf<S>> {
        let length = later - t;
        let now = sampled(system, (0.0, length), (t, state))?;
        for (function, guard) in self.guards.iter_mut().zip(&now.guards) {
            function.sign = if guard.value > 0.0 || !guard.is_known { 1 } else { 0 };
        }
        if self.events.dim().count() > 0 {
            let next = system.events(later, after)?.map(to_f64);
            if !next.iter().all(|value| value.is_finite()) {
                return Err(MotionError::NotFinite {
                    quantity: Name::from_static("an event function"),
                    t: to_f64(later),
                });
            }
            for ((function, FunctionSample { value, .. }), next) in self.events.iter_mut().zip(now.events).zip(next) {
                let on_zero = value == 0.0 || value.abs() <= function.residual;
                function.sign = sign(if on_zero { next - value } else { value });
            }
        }
        Ok(())
    }

    /// Takes the signs of the event functions before a change of the law, so that a zero there is an event after it.
    pub(super) fn keep_events(&mut self, before: &Self) {
        for (function, before) in self.events.iter_mut().zip(&before.events).filter(|(_, before)| before.sign != 0) {
            function.sign = before.sign;
        }
    }

    pub(super) fn any_event(&self, sample: &Sample<K, C>) -> bool {
        self.each().zip(sample.each()).any(|(function, sample)| function.passed(sample) && function.is_event())
    }

    /// Updates the signs from these samples.
    pub(super) fn update(&mut self, sample: &Sample<K, C>) {
        for (function, sample) in self.each_mut().zip(sample.each()) {
            if function.sign == 0 {
                let is_above = !function.is_guard() || sample.value > 0.0 || function.passed(sample);
                function.sign = if is_above { sign(sample.value) } else { 0 };
            } else if function.passed(sample) {
                function.sign = -function.sign;
            }
        }
    }
}
