//! Events: zeros of functions of the state, and the actions there.

use nalgebra::ComplexField;

use super::dense::Interpolant;
use super::samples::Samples;
use super::system::{Guard, StateOf, System};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::jacobian::first_not_positive;
use linkage_runtime::{Column, Dim, real};

/// The most events of one guard at one time: guards that are zero within rounding error may trigger each other.
const MAX_REPEATS: u32 = 8;

/// The largest number of equal parts of a step at whose ends guards are sampled.
const MAX_PARTS: usize = 64;

/// Two values of a function within this many ulps count as equal, so that a constant with rounding errors has no
/// extremum. At 0 each such error costs the evaluations of dense output; at 1e4 extrema of a relative depth of 1e-12
/// are missed.
const EQUAL_ULPS: f64 = 16.0;

/// The direction in which an event function passes through zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Crossing {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Either direction.
    Either,
}

/// The action at an event, on a state `Y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action<Y> {
    /// Records the event; the motion continues.
    Record,
    /// Ends the integration.
    Stop,
    /// Restarts the motion from this state: after an impact, or where the law of the rate changes. The step length is
    /// kept.
    Restart(Y),
}

/// The sign of each function up to the time reached, for the user's event functions and for the guards of the system:
/// an event is a change of sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct EventSigns<K: Dim, C: Dim> {
    events: Column<EventSign, K>,
    guards: Column<EventSign, C>,
}

/// The sign of one function, and its events at the time reached.
#[derive(Debug, Clone, Copy)]
struct EventSign {
    /// 1 or -1; 0 for an event function that has been zero since the start, or a guard that has not been positive.
    sign: i8,
    /// True if it has an event at the time reached that is not delivered yet.
    is_pending: bool,
    /// The number of its events at the last event time.
    count: u32,
    /// |value| at the time reached if the function has its event there, else -1.
    residual: f64,
    /// The direction of its events; None for a guard, whose event is where it falls below zero, not at zero.
    crossing: Option<Crossing>,
}

/// The value and the rate of a function at one time of a step.
#[derive(Debug, Clone, Copy)]
struct FunctionSample {
    value: f64,
    /// Its rate times the length of the step; zero if unknown.
    rate: f64,
    /// True if the system supplies the rate.
    is_known: bool,
}

/// The values and rates of all functions at one time of a step.
#[derive(Debug, Clone, Copy)]
struct Sample<K: Dim, C: Dim> {
    /// The fraction of the step.
    at: f64,
    events: Column<FunctionSample, K>,
    guards: Column<FunctionSample, C>,
}

/// The result of a search in a step.
pub(super) enum Found<S: System> {
    /// No event.
    Nothing,
    /// Possibly an event, found on the cubic, which is not accurate enough to decide.
    Perhaps,
    /// The first events.
    Hit(Hit<S>),
    /// A guard changes too much between samples for its events to be found.
    TooCoarse,
}

/// The first events in a step: there may be several at one time.
pub(super) struct Hit<S: System> {
    /// The fraction of the step.
    pub(super) at: f64,
    pub(super) t: S::Scalar,
    pub(super) state: StateOf<S>,
}

/// A step, with the system whose functions are sampled along it.
struct SampledStep<'a, S: System> {
    system: &'a mut S,
    step: &'a Interpolant<S::Scalar, S::N>,
    /// The rounding error of the time, as a fraction of the step.
    resolution: f64,
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

/// A sample of the functions of a system.
type SampleOf<S> = Sample<<S as System>::Events, <S as System>::Guards>;

/// Samples the functions at a time and state, which is the fraction `at` of a step of this length.
fn sampled<S: System>(
    system: &mut S,
    (at, length): (f64, S::Scalar),
    (t, state): (S::Scalar, &StateOf<S>),
) -> Result<SampleOf<S>, MotionError> {
    let unknown = FunctionSample { value: 0.0, rate: 0.0, is_known: false };
    let (mut events, mut guards) = (Column::repeat(unknown), Column::repeat(unknown));
    if S::Events::COUNT > 0 {
        events = system.events(t, state)?.map(|value| FunctionSample { value: to_f64(value), ..unknown });
    }
    if S::Guards::COUNT > 0 {
        guards = system.guards(t, state)?.map(|Guard { value, rate }| FunctionSample {
            value: to_f64(value),
            rate: rate.map_or(0.0, |rate| to_f64(rate * length)),
            is_known: rate.is_some(),
        });
    }
    let sample = Sample { at, events, guards };
    if sample.each().all(|sample| sample.value.is_finite()) {
        Ok(sample)
    } else {
        Err(MotionError::NotFinite { quantity: "an event function", t: to_f64(t) })
    }
}

impl<K: Dim, C: Dim> Sample<K, C> {
    /// The values of the guards without a known rate.
    fn unknown(&self) -> Column<Option<f64>, C> {
        self.guards.map(|guard| if guard.is_known { None } else { Some(guard.value) })
    }

    fn each(&self) -> impl Iterator<Item = &FunctionSample> {
        self.events.iter().chain(&self.guards)
    }

    fn each_mut(&mut self) -> impl Iterator<Item = &mut FunctionSample> {
        self.events.iter_mut().chain(&mut self.guards)
    }
}

impl<S: System> SampledStep<'_, S> {
    /// Samples the functions at a fraction of the step, with the rates that the system supplies.
    fn sample(&mut self, at: f64) -> Result<SampleOf<S>, MotionError> {
        let Self { system, step, .. } = self;
        sampled(*system, (at, step.length()), (step.time(at), &step.at_fraction(real(at))))
    }

    /// Samples the functions slightly nearer to the middle of the step, for a difference quotient.
    fn nearby_sample(&mut self, at: f64) -> Result<SampleOf<S>, MotionError> {
        let little = ComplexField::sqrt(self.resolution);
        self.sample(if at < 0.5 { at + little } else { at - little })
    }

    /// Samples the functions with all rates; those that the system does not supply by difference quotients.
    fn sample_with_rates(&mut self, at: f64) -> Result<SampleOf<S>, MotionError> {
        let mut sample = self.sample(at)?;
        if sample.each().any(|sample| !sample.is_known) {
            let nearby = self.nearby_sample(at)?;
            for (here, there) in sample.each_mut().zip(nearby.each()).filter(|(here, _)| !here.is_known) {
                let change = if is_same(here.value, there.value) { 0.0 } else { there.value - here.value };
                here.rate = change / (nearby.at - at);
            }
        }
        Ok(sample)
    }
}

/// Returns true if the values are equal within rounding error.
fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= EQUAL_ULPS * f64::EPSILON * a.abs().max(b.abs())
}

impl EventSign {
    fn new(crossing: Option<Crossing>) -> Self {
        Self { sign: 0, is_pending: false, count: 0, residual: -1.0, crossing }
    }

    fn is_guard(&self) -> bool {
        self.crossing.is_none()
    }

    /// Returns true if an event function has reached or passed zero since the last sign, or a guard has passed it: at
    /// zero a guard holds, such as a stop with zero load. A guard that started at zero or below has passed it if it is
    /// negative and falling.
    fn passed(&self, sample: &FunctionSample) -> bool {
        match self.sign {
            0 => self.is_guard() && sample.value < 0.0 && sample.rate < 0.0,
            1 if self.is_guard() => sample.value < 0.0,
            own => sign(sample.value) != own,
        }
    }

    /// Returns true if the passage from this sign is an event.
    fn is_event(&self) -> bool {
        match self.crossing {
            Some(Crossing::Rising) => self.sign < 0,
            Some(Crossing::Falling) => self.sign > 0,
            Some(Crossing::Either) => true,
            None => self.sign >= 0,
        }
    }

    /// Returns the value with its sign reversed if needed: positive before the passage, zero or negative after it.
    fn distance_before(&self, sample: &FunctionSample) -> f64 {
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
    fn rate_away(&self, sample: &FunctionSample) -> f64 {
        if self.sign < 0 { -sample.rate } else { sample.rate }
    }

    /// Returns true if the function approaches zero after the first sample and has turned away from it before the
    /// second. At one of them its rate may be zero.
    fn has_extremum(&self, before: &FunctionSample, here: &FunctionSample) -> bool {
        let (start, end) = (self.rate_away(before), self.rate_away(here));
        self.sign != 0 && !self.passed(here) && start <= 0.0 && end >= 0.0 && start < end
    }

    /// Returns true if the function is nearer to zero at the second sample.
    fn approaches_zero(&self, before: &FunctionSample, here: &FunctionSample) -> bool {
        let change = here.value - before.value;
        !is_same(here.value, before.value) && (if self.sign < 0 { -change } else { change }) < 0.0
    }
}

impl<K: Dim, C: Dim> EventSigns<K, C> {
    pub(super) fn new(crossings: Column<Crossing, K>) -> Self {
        Self {
            events: crossings.map(|crossing| EventSign::new(Some(crossing))),
            guards: Column::repeat(EventSign::new(None)),
        }
    }

    fn each(&self) -> impl Iterator<Item = &EventSign> {
        self.events.iter().chain(&self.guards)
    }

    fn each_mut(&mut self) -> impl Iterator<Item = &mut EventSign> {
        self.events.iter_mut().chain(&mut self.guards)
    }

    /// Returns true if an event is not delivered yet.
    pub(super) fn has_pending(&self) -> bool {
        self.each().any(|function| function.is_pending)
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
        let next = self.each_mut().enumerate().find(|(_, function)| function.is_pending);
        next.map_or((0, false), |(event, function)| {
            function.is_pending = false;
            function.count += 1;
            (event, function.count > if event < K::COUNT { 1 } else { MAX_REPEATS })
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
    ) -> Result<(), MotionError> {
        let length = later - t;
        let now = sampled(system, (0.0, length), (t, state))?;
        for (function, guard) in self.guards.iter_mut().zip(&now.guards) {
            function.sign = if guard.value > 0.0 || !guard.is_known { 1 } else { 0 };
        }
        if K::COUNT > 0 {
            let next = system.events(later, after)?.map(to_f64);
            if !next.iter().all(|value| value.is_finite()) {
                return Err(MotionError::NotFinite { quantity: "an event function", t: to_f64(later) });
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

    fn any_event(&self, sample: &Sample<K, C>) -> bool {
        self.each().zip(sample.each()).any(|(function, sample)| function.passed(sample) && function.is_event())
    }

    /// Updates the signs from these samples.
    fn update(&mut self, sample: &Sample<K, C>) {
        for (function, sample) in self.each_mut().zip(sample.each()) {
            if function.sign == 0 {
                let is_above = !function.is_guard() || sample.value > 0.0 || function.passed(sample);
                function.sign = if is_above { sign(sample.value) } else { 0 };
            } else if function.passed(sample) {
                function.sign = -function.sign;
            }
        }
    }

    /// Finds the first events of the step after the fraction `from`, sampling at the ends of `parts` equal parts.
    /// Guards that are not close to a parabola between samples are sampled more often.
    ///
    /// If a function approaches zero at one sample and leaves it at the next, its extremum between them is located, so
    /// that two passages through zero are not missed. The cubic, which interpolates only states and rates at the ends
    /// of the step, costs no evaluation, but it yields no events, only [`Found::Perhaps`].
    pub(super) fn search<S: System<Events = K, Guards = C>>(
        &mut self,
        system: &mut S,
        (step, is_cubic): (&Interpolant<S::Scalar, S::N>, bool),
        (from, parts): (f64, usize),
        resolution: f64,
    ) -> Result<Found<S>, MotionError> {
        let mut course = SampledStep { system, step, resolution };
        let (signs, mut parts) = (*self, parts);
        loop {
            let found = if is_cubic {
                self.search_cubic(&mut course, parts)?
            } else {
                self.search_dense(&mut course, (from, parts))?
            };
            match found {
                Found::TooCoarse if parts < MAX_PARTS => {
                    *self = signs;
                    parts *= 2;
                }
                found => return Ok(found),
            }
        }
    }

    /// Searches the cubic for a possible event: a function that passes zero, or approaches it and has an extremum.
    fn search_cubic<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        parts: usize,
    ) -> Result<Found<S>, MotionError> {
        let mut samples = Samples::new();
        let mut before = course.sample(0.0)?;
        samples.push(before.unknown());
        let mut older = None;
        for part in 1..=parts {
            let here = course.sample(part as f64 / parts as f64)?;
            samples.push(here.unknown());
            if samples.are_too_coarse() {
                return Ok(Found::TooCoarse);
            }
            if self.any_event(&here) || self.any_extremum(&before, &here) {
                return Ok(Found::Perhaps);
            }
            // A function without a known rate has an extremum if a value is nearer to zero than both neighbours; at the
            // ends of the step one neighbour is a sample close by.
            let has_extremum = match &older {
                Some(older) => self.any_unknown([older, &before, &here], |function, [older, before, here]| {
                    function.approaches_zero(older, before) && !function.approaches_zero(before, here)
                }),
                None if self.any_unknown([&before, &here], |function, [before, here]| {
                    !function.approaches_zero(before, here)
                }) =>
                {
                    let nearby = course.nearby_sample(0.0)?;
                    self.any_unknown([&before, &nearby, &here], |function, [before, nearby, here]| {
                        function.approaches_zero(before, nearby) && !function.approaches_zero(before, here)
                    })
                }
                None => false,
            };
            if has_extremum {
                return Ok(Found::Perhaps);
            }
            if part == parts
                && self.any_unknown([&before, &here], |function, [before, here]| function.approaches_zero(before, here))
            {
                let nearby = course.nearby_sample(1.0)?;
                if self.any_unknown([&nearby, &here], |function, [nearby, here]| function.approaches_zero(here, nearby))
                {
                    return Ok(Found::Perhaps);
                }
            }
            self.update(&here);
            (older, before) = (Some(before), here);
        }
        Ok(Found::Nothing)
    }

    fn any_extremum(&self, before: &Sample<K, C>, here: &Sample<K, C>) -> bool {
        self.each()
            .zip(before.each().zip(here.each()))
            .any(|(function, (before, here))| function.has_extremum(before, here))
    }

    /// Returns true if `is_so` holds for a function without a known rate.
    fn any_unknown<const P: usize>(
        &self,
        samples: [&Sample<K, C>; P],
        is_so: impl Fn(&EventSign, [&FunctionSample; P]) -> bool,
    ) -> bool {
        let events = (0..K::COUNT)
            .any(|i| self.events[i].sign != 0 && is_so(&self.events[i], samples.map(|sample| &sample.events[i])));
        let unknown = |i: usize| samples.iter().all(|sample| !sample.guards[i].is_known);
        let guards = |i: usize| is_so(&self.guards[i], samples.map(|sample| &sample.guards[i]));
        events || (0..C::COUNT).any(|i| self.guards[i].sign != 0 && unknown(i) && guards(i))
    }

    /// Searches the dense output for the first events.
    fn search_dense<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        (from, parts): (f64, usize),
    ) -> Result<Found<S>, MotionError> {
        let mut samples = Samples::new();
        let mut before = course.sample_with_rates(from)?;
        if from == 0.0 {
            samples.push(before.unknown());
        }
        // The fractions of the step around the first event.
        let mut happened = None;
        for part in 1..=parts {
            let at = part as f64 / parts as f64;
            if at <= from {
                continue;
            }
            let here = course.sample_with_rates(at)?;
            samples.push(here.unknown());
            if samples.are_too_coarse() {
                return Ok(Found::TooCoarse);
            }
            if happened.is_none() {
                happened = self.bracket(course, before, &here)?;
            }
            if happened.is_some() && (C::COUNT == 0 || samples.are_enough()) {
                break;
            }
            before = here;
        }
        happened.map_or(Ok(Found::Nothing), |between| self.locate(course, between).map(Found::Hit))
    }

    /// Returns the fractions of the step before and after the first event between two samples.
    fn bracket<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        before: Sample<K, C>,
        here: &Sample<K, C>,
    ) -> Result<Option<(f64, f64)>, MotionError> {
        let mut before = before;
        // Each function has at most one extremum here.
        for _ in 0..K::COUNT + C::COUNT {
            let Some(turn) = self.first_beyond_extremum(course, &before, here)? else { break };
            if self.any_event(&turn) {
                return Ok(Some((before.at, turn.at)));
            }
            self.update(&turn);
            before = turn;
        }
        if self.any_event(here) {
            return Ok(Some((before.at, here.at)));
        }
        self.update(here);
        Ok(None)
    }

    /// Returns the earliest sample at which a function that approaches zero and leaves it between two samples is beyond
    /// zero.
    fn first_beyond_extremum<S: System<Events = K, Guards = C>>(
        &self,
        course: &mut SampledStep<'_, S>,
        before: &Sample<K, C>,
        here: &Sample<K, C>,
    ) -> Result<Option<Sample<K, C>>, MotionError> {
        let mut first: Option<Sample<K, C>> = None;
        for (place, (function, (start, end))) in self.each().zip(before.each().zip(here.each())).enumerate() {
            if !function.has_extremum(start, end) {
                continue;
            }
            let mut passed = None;
            // The extremum is where the rate away from zero is no longer negative; if it is zero at the start, where it
            // becomes positive.
            let still = if function.rate_away(start) == 0.0 { f64::MIN_POSITIVE } else { 0.0 };
            // Near an extremum an error of the time of sqrt(resolution) changes the value by its rounding error only.
            let enough = ComplexField::sqrt(course.resolution);
            first_not_positive::<_, MotionError>(
                [before.at, here.at],
                [still - function.rate_away(start), -function.rate_away(end)],
                enough,
                |at| {
                    let sample = course.sample_with_rates(at)?;
                    let Some(own) = sample.each().nth(place) else { return Ok(None) };
                    if function.passed(own) {
                        passed = Some(sample);
                        return Ok(None);
                    }
                    Ok(Some(still - function.rate_away(own)))
                },
            )?;
            first = match (first, passed) {
                (Some(first), Some(passed)) if passed.at < first.at => Some(passed),
                (None, passed) => passed,
                (first, _) => first,
            };
        }
        Ok(first)
    }

    /// Locates the first events between two fractions of the step.
    fn locate<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        (start, end): (f64, f64),
    ) -> Result<Hit<S>, MotionError> {
        let ends = [self.least_distance(&course.sample(start)?), self.least_distance(&course.sample(end)?)];
        let resolution = course.resolution;
        let at = first_not_positive::<_, MotionError>([start, end], ends, resolution, |at| {
            Ok(Some(self.least_distance(&course.sample(at)?)))
        })?;
        let there = course.sample(at)?;
        for (function, sample) in self.each_mut().zip(there.each()) {
            function.is_pending = function.passed(sample) && function.is_event();
            function.residual = if function.is_pending { sample.value.abs() } else { -1.0 };
        }
        self.update(&there);
        let step = course.step;
        Ok(Hit { at, t: step.time(at), state: step.at_fraction(real(at)) })
    }

    /// The least distance before a passage that is an event: positive before the first event, then zero or negative.
    fn least_distance(&self, sample: &Sample<K, C>) -> f64 {
        self.each()
            .zip(sample.each())
            .filter(|(function, _)| (function.sign != 0 || function.is_guard()) && function.is_event())
            .fold(f64::INFINITY, |least, (function, sample)| least.min(function.distance_before(sample)))
    }
}
