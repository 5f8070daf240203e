//! Events: zeros of functions of the state, and the actions there.

use nalgebra::ComplexField;

use super::dense::Interpolant;
use super::samples::Samples;
use super::system::{Guard, StateOf, System};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Column, Dim, real};

/// The most events of one guard at one time: guards that are zero within rounding error may trigger each other.
const MAX_REPEATS: u32 = 8;

/// The largest number of parts of a step between which guards are sampled.
const MAX_PARTS: usize = 64;

/// Two values of a function within this many ulps count as equal, so that a constant has no extremum. At 0 each
/// rounding error of a constant costs dense output; at 1e4 extrema of 1e-12 of the value are missed.
const EQUAL_ULPS: f64 = 16.0;

/// The direction in which an event function passes through zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

/// The sign of each function up to the time reached: the user's events, then the guards.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides<K: Dim, C: Dim> {
    events: Column<Side, K>,
    guards: Column<Side, C>,
}

#[derive(Debug, Clone, Copy)]
struct Side {
    /// 1 or -1; 0 for an event that has been zero since the start, or a guard that has not been positive.
    sign: i8,
    /// Its event at the time reached is not delivered yet.
    waits: bool,
    /// The number of its events at the last event time.
    happened: u32,
    /// The residual |value| of a function at its event just now; -1 for the others.
    residue: f64,
    /// None for a guard, which has its event where it falls below zero, not at zero.
    crossing: Option<Crossing>,
}

/// A sample of a function at one time of a step.
#[derive(Debug, Clone, Copy)]
struct Seen {
    value: f64,
    /// Its rate times the length of the step; zero if unknown.
    rate: f64,
    /// True if the system supplies the rate.
    is_known: bool,
}

/// Samples of all events and guards at one time of a step.
#[derive(Debug, Clone, Copy)]
struct Look<K: Dim, C: Dim> {
    /// The fraction of the step.
    at: f64,
    events: Column<Seen, K>,
    guards: Column<Seen, C>,
}

/// The result of a search in a step.
pub(super) enum Found<S: System> {
    /// No event.
    Nothing,
    /// Possibly an event: the cubic cannot decide.
    Perhaps,
    /// The first events.
    Hit(Hit<S>),
    /// The guards change too much between samples.
    Unclear,
}

/// The first events in the step after some fraction of it.
pub(super) struct Hit<S: System> {
    /// The fraction of the step.
    pub(super) at: f64,
    pub(super) t: S::Scalar,
    pub(super) state: StateOf<S>,
}

/// A system along a step.
struct Course<'a, S: System> {
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

/// Samples of the functions of a system.
type LookAt<S> = Look<<S as System>::Events, <S as System>::Guards>;

fn seen<S: System>(
    system: &mut S,
    (at, length): (f64, S::Scalar),
    (t, state): (S::Scalar, &StateOf<S>),
) -> Result<LookAt<S>, MotionError> {
    let unknown = Seen { value: 0.0, rate: 0.0, is_known: false };
    let (mut events, mut guards) = (Column::repeat(unknown), Column::repeat(unknown));
    if S::Events::COUNT > 0 {
        events = system.events(t, state)?.map(|value| Seen { value: to_f64(value), ..unknown });
    }
    if S::Guards::COUNT > 0 {
        guards = system.guards(t, state)?.map(|Guard { value, rate }| Seen {
            value: to_f64(value),
            rate: rate.map_or(0.0, |rate| to_f64(rate * length)),
            is_known: rate.is_some(),
        });
    }
    let look = Look { at, events, guards };
    if look.each().all(|seen| seen.value.is_finite()) {
        Ok(look)
    } else {
        Err(MotionError::NotFinite { quantity: "an event function", t: to_f64(t) })
    }
}

impl<K: Dim, C: Dim> Look<K, C> {
    /// The values of the guards without a known rate.
    fn unknown(&self) -> Column<Option<f64>, C> {
        self.guards.map(|guard| if guard.is_known { None } else { Some(guard.value) })
    }

    fn each(&self) -> impl Iterator<Item = &Seen> {
        self.events.iter().chain(&self.guards)
    }

    fn each_mut(&mut self) -> impl Iterator<Item = &mut Seen> {
        self.events.iter_mut().chain(&mut self.guards)
    }
}

impl<S: System> Course<'_, S> {
    /// Samples the functions at a fraction of the step, with the rates that the system supplies.
    fn look(&mut self, at: f64) -> Result<LookAt<S>, MotionError> {
        let Self { system, step, .. } = self;
        seen(*system, (at, step.length()), (step.time(at), &step.at_fraction(real(at))))
    }

    /// Samples the functions slightly nearer to the middle of the step, for a difference quotient.
    fn aside(&mut self, at: f64) -> Result<LookAt<S>, MotionError> {
        let little = ComplexField::sqrt(self.resolution);
        self.look(if at < 0.5 { at + little } else { at - little })
    }

    /// Samples the functions with all rates; those that the system does not supply by difference quotients.
    fn whole(&mut self, at: f64) -> Result<LookAt<S>, MotionError> {
        let mut look = self.look(at)?;
        if look.each().any(|seen| !seen.is_known) {
            let aside = self.aside(at)?;
            for (here, there) in look.each_mut().zip(aside.each()).filter(|(here, _)| !here.is_known) {
                let change = if is_same(here.value, there.value) { 0.0 } else { there.value - here.value };
                here.rate = change / (aside.at - at);
            }
        }
        Ok(look)
    }
}

/// Returns true if the values are equal within rounding error.
fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= EQUAL_ULPS * f64::EPSILON * a.abs().max(b.abs())
}

impl Side {
    fn new(crossing: Option<Crossing>) -> Self {
        Self { sign: 0, waits: false, happened: 0, residue: -1.0, crossing }
    }

    fn is_guard(&self) -> bool {
        self.crossing.is_none()
    }

    /// Returns true if an event function has reached or passed zero, or a guard has passed it: a stop with zero load
    /// holds. A guard that started at zero or below has passed it if it is negative and falling.
    fn passed(&self, seen: &Seen) -> bool {
        match self.sign {
            0 => self.is_guard() && seen.value < 0.0 && seen.rate < 0.0,
            1 if self.is_guard() => seen.value < 0.0,
            own => sign(seen.value) != own,
        }
    }

    /// Returns true if the passage from this sign is an event.
    fn counts(&self) -> bool {
        match self.crossing {
            Some(Crossing::Rising) => self.sign < 0,
            Some(Crossing::Falling) => self.sign > 0,
            Some(Crossing::Either) => true,
            None => self.sign >= 0,
        }
    }

    /// Returns a number that is positive before the passage and zero or negative after it.
    fn left(&self, seen: &Seen) -> f64 {
        let left = if self.sign < 0 { -seen.value } else { seen.value };
        let passed = self.passed(seen);
        if passed == (left <= 0.0) {
            left
        } else if passed {
            0.0
        } else {
            f64::MIN_POSITIVE
        }
    }

    /// Returns the rate away from zero: negative if the function approaches zero.
    fn way(&self, seen: &Seen) -> f64 {
        if self.sign < 0 { -seen.rate } else { seen.rate }
    }

    /// Returns true if the function approaches zero and has an extremum between two samples. At one of them its rate
    /// may be zero.
    fn turns(&self, before: &Seen, here: &Seen) -> bool {
        let (start, end) = (self.way(before), self.way(here));
        self.sign != 0 && !self.passed(here) && start <= 0.0 && end >= 0.0 && start < end
    }

    /// Returns true if the function is nearer to zero at the second sample.
    fn nears(&self, before: &Seen, here: &Seen) -> bool {
        let change = here.value - before.value;
        !is_same(here.value, before.value) && (if self.sign < 0 { -change } else { change }) < 0.0
    }
}

impl<K: Dim, C: Dim> Sides<K, C> {
    pub(super) fn new(crossings: Column<Crossing, K>) -> Self {
        Self { events: crossings.map(|crossing| Side::new(Some(crossing))), guards: Column::repeat(Side::new(None)) }
    }

    fn each(&self) -> impl Iterator<Item = &Side> {
        self.events.iter().chain(&self.guards)
    }

    fn each_mut(&mut self) -> impl Iterator<Item = &mut Side> {
        self.events.iter_mut().chain(&mut self.guards)
    }

    /// Returns true if an event is not delivered yet.
    pub(super) fn waits(&self) -> bool {
        self.each().any(|side| side.waits)
    }

    /// Drops undelivered events.
    pub(super) fn forget(&mut self) {
        self.each_mut().for_each(|side| side.waits = false);
    }

    /// Resets the event counts at a new event time.
    pub(super) fn anew(&mut self) {
        self.each_mut().for_each(|side| side.happened = 0);
    }

    /// Takes the next undelivered event; returns its index, and true if it has occurred too often at this time.
    pub(super) fn deliver(&mut self) -> (usize, bool) {
        let next = self.each_mut().enumerate().find(|(_, side)| side.waits);
        next.map_or((0, false), |(event, side)| {
            side.waits = false;
            side.happened += 1;
            (event, side.happened > if event < K::COUNT { 1 } else { MAX_REPEATS })
        })
    }

    /// Sets the signs at the start of a motion. An event function that is zero, within rounding error after its own
    /// event, has the sign that it takes a little later, at `after`. A guard counts as positive, because its law holds
    /// at the start: if it stays negative its event repeats; with a known rate only if it is falling.
    pub(super) fn begin<S: System<Events = K, Guards = C>>(
        &mut self,
        system: &mut S,
        (t, state): (S::Scalar, &StateOf<S>),
        (later, after): (S::Scalar, &StateOf<S>),
    ) -> Result<(), MotionError> {
        let length = later - t;
        let now = seen(system, (0.0, length), (t, state))?;
        for (side, guard) in self.guards.iter_mut().zip(&now.guards) {
            side.sign = if guard.value > 0.0 || !guard.is_known { 1 } else { 0 };
        }
        if K::COUNT > 0 {
            let next = system.events(later, after)?.map(to_f64);
            if !next.iter().all(|value| value.is_finite()) {
                return Err(MotionError::NotFinite { quantity: "an event function", t: to_f64(later) });
            }
            for ((side, Seen { value, .. }), next) in self.events.iter_mut().zip(now.events).zip(next) {
                let on_zero = value == 0.0 || value.abs() <= side.residue;
                side.sign = sign(if on_zero { next - value } else { value });
            }
        }
        Ok(())
    }

    fn any(&self, look: &Look<K, C>) -> bool {
        self.each().zip(look.each()).any(|(side, seen)| side.passed(seen) && side.counts())
    }

    /// Updates the signs from these samples.
    fn follow(&mut self, look: &Look<K, C>) {
        for (side, seen) in self.each_mut().zip(look.each()) {
            if side.sign == 0 {
                let is_above = !side.is_guard() || seen.value > 0.0 || side.passed(seen);
                side.sign = if is_above { sign(seen.value) } else { 0 };
            } else if side.passed(seen) {
                side.sign = -side.sign;
            }
        }
    }

    /// Finds the first events of the step after the fraction `from`, sampling at `parts` equal parts. Guards with
    /// curvature are sampled more often.
    ///
    /// An event function that approaches zero and has one extremum between two samples is followed to the extremum. On
    /// a cubic, which has only the states and rates of the ends, the result is [`Found::Perhaps`] at most: a function
    /// with at most one extremum in the step shows it at the ends.
    pub(super) fn search<S: System<Events = K, Guards = C>>(
        &mut self,
        system: &mut S,
        (step, is_cubic): (&Interpolant<S::Scalar, S::N>, bool),
        (from, parts): (f64, usize),
        resolution: f64,
    ) -> Result<Found<S>, MotionError> {
        let mut course = Course { system, step, resolution };
        let (sides, mut parts) = (*self, parts);
        loop {
            let found =
                if is_cubic { self.glance(&mut course, parts)? } else { self.scan(&mut course, (from, parts))? };
            match found {
                Found::Unclear if parts < MAX_PARTS => {
                    *self = sides;
                    parts *= 2;
                }
                found => return Ok(found),
            }
        }
    }

    /// Checks for a possible event: a function that passes zero, or approaches it and has an extremum.
    fn glance<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut Course<'_, S>,
        parts: usize,
    ) -> Result<Found<S>, MotionError> {
        let mut samples = Samples::new();
        let mut before = course.look(0.0)?;
        samples.push(before.unknown());
        let mut older = None;
        for part in 1..=parts {
            let here = course.look(part as f64 / parts as f64)?;
            samples.push(here.unknown());
            if samples.are_unclear() {
                return Ok(Found::Unclear);
            }
            if self.any(&here) || self.any_turns(&before, &here) {
                return Ok(Found::Perhaps);
            }
            // Without a known rate: a value nearer to zero than both neighbours; at the ends of the step, a difference
            // quotient.
            let turned = match &older {
                Some(older) => self.any_unknown([older, &before, &here], |side, [older, before, here]| {
                    side.nears(older, before) && !side.nears(before, here)
                }),
                None if self.any_unknown([&before, &here], |side, [before, here]| !side.nears(before, here)) => {
                    let aside = course.aside(0.0)?;
                    self.any_unknown([&before, &aside, &here], |side, [before, aside, here]| {
                        side.nears(before, aside) && !side.nears(before, here)
                    })
                }
                None => false,
            };
            if turned {
                return Ok(Found::Perhaps);
            }
            if part == parts && self.any_unknown([&before, &here], |side, [before, here]| side.nears(before, here)) {
                let aside = course.aside(1.0)?;
                if self.any_unknown([&aside, &here], |side, [aside, here]| side.nears(here, aside)) {
                    return Ok(Found::Perhaps);
                }
            }
            self.follow(&here);
            (older, before) = (Some(before), here);
        }
        Ok(Found::Nothing)
    }

    fn any_turns(&self, before: &Look<K, C>, here: &Look<K, C>) -> bool {
        self.each().zip(before.each().zip(here.each())).any(|(side, (before, here))| side.turns(before, here))
    }

    /// Returns true if `is_so` holds for a function without a known rate.
    fn any_unknown<const P: usize>(&self, looks: [&Look<K, C>; P], is_so: impl Fn(&Side, [&Seen; P]) -> bool) -> bool {
        let events = (0..K::COUNT)
            .any(|i| self.events[i].sign != 0 && is_so(&self.events[i], looks.map(|look| &look.events[i])));
        let unknown = |i: usize| looks.iter().all(|look| !look.guards[i].is_known);
        let guards = |i: usize| is_so(&self.guards[i], looks.map(|look| &look.guards[i]));
        events || (0..C::COUNT).any(|i| self.guards[i].sign != 0 && unknown(i) && guards(i))
    }

    fn scan<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut Course<'_, S>,
        (from, parts): (f64, usize),
    ) -> Result<Found<S>, MotionError> {
        let mut samples = Samples::new();
        let mut before = course.whole(from)?;
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
            let here = course.whole(at)?;
            samples.push(here.unknown());
            if samples.are_unclear() {
                return Ok(Found::Unclear);
            }
            if happened.is_none() {
                happened = self.between(course, before, &here)?;
            }
            if happened.is_some() && (C::COUNT == 0 || samples.are_enough()) {
                break;
            }
            before = here;
        }
        happened.map_or(Ok(Found::Nothing), |between| self.hit(course, between).map(Found::Hit))
    }

    /// Returns two fractions of the step around the first event between two samples.
    fn between<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut Course<'_, S>,
        before: Look<K, C>,
        here: &Look<K, C>,
    ) -> Result<Option<(f64, f64)>, MotionError> {
        let mut before = before;
        // Each function has at most one extremum here.
        for _ in 0..K::COUNT + C::COUNT {
            let Some(turn) = self.passed_before(course, &before, here)? else { break };
            if self.any(&turn) {
                return Ok(Some((before.at, turn.at)));
            }
            self.follow(&turn);
            before = turn;
        }
        if self.any(here) {
            return Ok(Some((before.at, here.at)));
        }
        self.follow(here);
        Ok(None)
    }

    /// Returns the first sample at which a function with an extremum between two samples is beyond zero.
    fn passed_before<S: System<Events = K, Guards = C>>(
        &self,
        course: &mut Course<'_, S>,
        before: &Look<K, C>,
        here: &Look<K, C>,
    ) -> Result<Option<Look<K, C>>, MotionError> {
        let mut first: Option<Look<K, C>> = None;
        for (place, (side, (start, end))) in self.each().zip(before.each().zip(here.each())).enumerate() {
            if !side.turns(start, end) {
                continue;
            }
            let mut passed = None;
            // If the rate is zero at the start, a zero rate counts as the side of the start.
            let still = if side.way(start) == 0.0 { f64::MIN_POSITIVE } else { 0.0 };
            // Near an extremum an error of sqrt(epsilon) in the time changes the value by one rounding error.
            let enough = ComplexField::sqrt(course.resolution);
            fall((before.at, here.at), [still - side.way(start), -side.way(end)], enough, |at| {
                let look = course.whole(at)?;
                let Some(seen) = look.each().nth(place) else { return Ok(None) };
                if side.passed(seen) {
                    passed = Some(look);
                    return Ok(None);
                }
                Ok(Some(still - side.way(seen)))
            })?;
            first = match (first, passed) {
                (Some(first), Some(passed)) if passed.at < first.at => Some(passed),
                (None, passed) => passed,
                (first, _) => first,
            };
        }
        Ok(first)
    }

    /// Locates the first events between two fractions of the step.
    fn hit<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut Course<'_, S>,
        (start, end): (f64, f64),
    ) -> Result<Hit<S>, MotionError> {
        let ends = [self.least(&course.look(start)?), self.least(&course.look(end)?)];
        let resolution = course.resolution;
        let at = fall((start, end), ends, resolution, |at| Ok(Some(self.least(&course.look(at)?))))?;
        let there = course.look(at)?;
        for (side, seen) in self.each_mut().zip(there.each()) {
            side.waits = side.passed(seen) && side.counts();
            side.residue = if side.waits { seen.value.abs() } else { -1.0 };
        }
        self.follow(&there);
        let step = course.step;
        Ok(Hit { at, t: step.time(at), state: step.at_fraction(real(at)) })
    }

    /// The least of the functions that may have an event: positive before the first event, then zero or negative.
    fn least(&self, look: &Look<K, C>) -> f64 {
        self.each()
            .zip(look.each())
            .filter(|(side, _)| (side.sign != 0 || side.is_guard()) && side.counts())
            .fold(f64::INFINITY, |least, (side, seen)| least.min(side.left(seen)))
    }
}

/// Finds the point where a positive function becomes zero or negative, to within `enough`: by the ITP method (Oliveira
/// and Takahashi, *An Enhancement of the Bisection Method Average Performance Preserving Minmax Optimality*, ACM Trans.
/// Math. Softw. 47 (2020)), which takes at most one evaluation more than bisection. It ends early if `value` returns
/// None.
fn fall(
    (mut a, mut b): (f64, f64),
    [mut above, mut below]: [f64; 2],
    enough: f64,
    mut value: impl FnMut(f64) -> Result<Option<f64>, MotionError>,
) -> Result<f64, MotionError> {
    let (width, half) = (b - a, 0.5 * enough);
    // half 2^(iterations allowed)
    let mut radius = half;
    while radius < width {
        radius *= 2.0;
    }
    while b - a > enough {
        let middle = 0.5 * (a + b);
        let s = if above > 0.0 && below <= 0.0 {
            let straight = (above * b - below * a) / (above - below);
            let side = if middle >= straight { 1.0 } else { -1.0 };
            let shift = 0.2 / width * (b - a) * (b - a);
            let truncated = if shift <= (middle - straight).abs() { straight + side * shift } else { middle };
            let room = radius - 0.5 * (b - a);
            if (truncated - middle).abs() <= room { truncated } else { middle - side * room }
        } else {
            // At the start of a motion a rounding error in the value may contradict the sign of the departure.
            middle
        };
        // Keep at least `half` away from both ends.
        let s = s.max(a + half).min(b - half);
        let Some(found) = value(s)? else { return Ok(s) };
        if found > 0.0 {
            (a, above) = (s, found);
        } else {
            (b, below) = (s, found);
        }
        radius *= 0.5;
    }
    Ok(b)
}
