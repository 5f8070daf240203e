//! Events: zeros of functions of the state, and what happens there.

use nalgebra::ComplexField;

use super::dense::Interpolant;
use super::samples::Samples;
use super::system::{Guard, StateOf, System};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Column, Dim, real};

/// How often a guard may be zero at one time: where several are within rounding, each may move the others.
const MOST_TURNS: u32 = 8;

/// The most parts of a step at which guards are looked at.
const MOST_PARTS: usize = 64;

/// Two values of a function within this many rounding errors of them are the same: a function that keeps its value does
/// not turn. At 0 each rounding error of a constant costs dense output; at 1e4 turns by 1e-12 of the value are missed.
const SAME: f64 = 16.0;

/// Which way an event function passes through zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crossing {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Either way.
    Either,
}

/// What happens at an event, to a state `Y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action<Y> {
    /// The event is recorded and the motion goes on.
    Record,
    /// The integration ends here.
    Stop,
    /// The motion starts anew from this state: after an impact, or where from here on another law holds. The length
    /// of the steps is kept.
    Restart(Y),
}

/// On which side of zero the functions are, as far as the integration has gone: the user's, then the guards.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides<K: Dim, C: Dim> {
    events: Column<Side, K>,
    guards: Column<Side, C>,
}

#[derive(Debug, Clone, Copy)]
struct Side {
    /// 1 or -1; 0 where the function has been zero since the start, or a guard not above it.
    sign: i8,
    /// Its event has happened at the time reached, and is not delivered yet.
    waits: bool,
    /// How often it has had an event at the last time of events.
    happened: u32,
    /// How far from zero rounding has left a function that has just had its event; of the others -1.
    residue: f64,
    /// None of a guard, which may be zero and has its event where it falls below.
    crossing: Option<Crossing>,
}

/// A function at one place of a step.
#[derive(Debug, Clone, Copy)]
struct Seen {
    value: f64,
    /// Its change by the whole step at the rate that it has there, zero where that is not known.
    rate: f64,
    /// The system knows the rate.
    is_known: bool,
}

/// The events and the guards at one place of a step.
#[derive(Debug, Clone, Copy)]
struct Look<K: Dim, C: Dim> {
    /// Part of the step.
    at: f64,
    events: Column<Seen, K>,
    guards: Column<Seen, C>,
}

/// What is found in a step.
pub(super) enum Found<S: System> {
    /// No event.
    Nothing,
    /// Perhaps an event, which a cubic does not tell.
    Perhaps,
    /// The first events.
    Hit(Hit<S>),
    /// The guards change too much in it to be followed.
    Unclear,
}

/// The first events in the step after some part of it.
pub(super) struct Hit<S: System> {
    /// Part of the step.
    pub(super) at: f64,
    pub(super) t: S::Scalar,
    pub(super) state: StateOf<S>,
}

/// A system along a step.
struct Course<'a, S: System> {
    system: &'a mut S,
    step: &'a Interpolant<S::Scalar, S::N>,
    /// The resolution of the time, as a part of the step.
    roundings: f64,
}

/// The sign of a value that is known to be a number.
fn sign(value: f64) -> i8 {
    if value > 0.0 {
        1
    } else if value < 0.0 {
        -1
    } else {
        0
    }
}

/// What a look at the functions of a system shows.
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
    /// The guards whose rates the system does not know.
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
    /// The functions at a part of the step, with the rates that the system knows.
    fn look(&mut self, at: f64) -> Result<LookAt<S>, MotionError> {
        let Self { system, step, .. } = self;
        seen(*system, (at, step.length()), (step.time(at), &step.at_fraction(real(at))))
    }

    /// The functions a little nearer to the middle of the step, where a difference tells their rates best.
    fn aside(&mut self, at: f64) -> Result<LookAt<S>, MotionError> {
        let little = ComplexField::sqrt(self.roundings);
        self.look(if at < 0.5 { at + little } else { at - little })
    }

    /// The functions with all rates, those that the system does not know by differences.
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

/// True if only rounding tells these values of a function apart.
fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * f64::EPSILON * a.abs().max(b.abs())
}

impl Side {
    fn new(crossing: Option<Crossing>) -> Self {
        Self { sign: 0, waits: false, happened: 0, residue: -1.0, crossing }
    }

    fn is_guard(&self) -> bool {
        self.crossing.is_none()
    }

    /// True if the function has reached zero or passed it, of a guard whether it has passed it: a stop that carries no
    /// load holds. A guard that began within rounding of zero or below has, where it goes on falling.
    fn passed(&self, seen: &Seen) -> bool {
        match self.sign {
            0 => self.is_guard() && seen.value < 0.0 && seen.rate < 0.0,
            1 if self.is_guard() => seen.value < 0.0,
            own => sign(seen.value) != own,
        }
    }

    /// Whether a passage is an event.
    fn counts(&self) -> bool {
        match self.crossing {
            Some(Crossing::Rising) => self.sign < 0,
            Some(Crossing::Falling) => self.sign > 0,
            Some(Crossing::Either) => true,
            None => self.sign >= 0,
        }
    }

    /// A number that is positive before the passage, and then zero or less.
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

    /// True if the function has a rate away from zero or towards it: 1 or -1, as it was seen.
    fn way(&self, seen: &Seen) -> f64 {
        if self.sign < 0 { -seen.rate } else { seen.rate }
    }

    /// True if the function comes nearer to zero and turns between two places. At one of them it may stand: it starts
    /// from rest, or is too flat for a difference to tell.
    fn turns(&self, before: &Seen, here: &Seen) -> bool {
        let (start, end) = (self.way(before), self.way(here));
        self.sign != 0 && !self.passed(here) && start <= 0.0 && end >= 0.0 && start < end
    }

    /// True if the function comes nearer to zero from one place to another.
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

    /// Whether an event has happened that is not delivered yet.
    pub(super) fn waits(&self) -> bool {
        self.each().any(|side| side.waits)
    }

    /// Nothing is to be delivered.
    pub(super) fn forget(&mut self) {
        self.each_mut().for_each(|side| side.waits = false);
    }

    /// Another time of events: none has happened yet.
    pub(super) fn anew(&mut self) {
        self.each_mut().for_each(|side| side.happened = 0);
    }

    /// The next event to be delivered, and whether it has happened too often at this time already.
    pub(super) fn deliver(&mut self) -> (usize, bool) {
        let next = self.each_mut().enumerate().find(|(_, side)| side.waits);
        next.map_or((0, false), |(event, side)| {
            side.waits = false;
            side.happened += 1;
            (event, side.happened > if event < K::COUNT { 1 } else { MOST_TURNS })
        })
    }

    /// The sides at the start of a motion. A function that is zero, or that its event has left within rounding of
    /// zero, is on the side that it leaves for: `after` is a little later. A guard is above zero, whatever rounding
    /// says, for the law begins where it holds; if it does not become so its event happens once more, unless it is
    /// known to grow.
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

    /// Takes over the sides that this look shows.
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

    /// The first events within the step after the part `from`, looked for between `parts` equal parts of the step.
    /// Guards are looked at more often where they bend.
    ///
    /// An event function that comes near zero and turns once between two parts is followed to where it turns. On a cubic,
    /// which has the states and the rates of the ends alone, it is only told whether something may happen
    /// ([`Found::Perhaps`]): a function that turns at most once in the step shows that at the ends.
    pub(super) fn search<S: System<Events = K, Guards = C>>(
        &mut self,
        system: &mut S,
        (step, is_cubic): (&Interpolant<S::Scalar, S::N>, bool),
        (from, parts): (f64, usize),
        roundings: f64,
    ) -> Result<Found<S>, MotionError> {
        let mut course = Course { system, step, roundings };
        let (sides, mut parts) = (*self, parts);
        loop {
            let found =
                if is_cubic { self.glance(&mut course, parts)? } else { self.scan(&mut course, (from, parts))? };
            match found {
                Found::Unclear if parts < MOST_PARTS => {
                    *self = sides;
                    parts *= 2;
                }
                found => return Ok(found),
            }
        }
    }

    /// True if something may happen in the step: something passes zero, or comes nearer and turns.
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
            // Of what the system knows no rate: a value nearer to zero than those around it, at the ends a rate.
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

    /// True if this is so of a function whose rate the system does not know.
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
        // Between which parts of the step something has happened first.
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

    /// Two places around the first event between these.
    fn between<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut Course<'_, S>,
        before: Look<K, C>,
        here: &Look<K, C>,
    ) -> Result<Option<(f64, f64)>, MotionError> {
        let mut before = before;
        // Each function turns once.
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

    /// Where a function that turns between two places is beyond zero, the first such place if there is one.
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
            // Where it stands it is as at the start if it stands there.
            let still = if side.way(start) == 0.0 { f64::MIN_POSITIVE } else { 0.0 };
            // Up to where the value there differs from the least by a rounding error.
            let enough = ComplexField::sqrt(course.roundings);
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

    /// The first events between two parts of the step.
    fn hit<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut Course<'_, S>,
        (start, end): (f64, f64),
    ) -> Result<Hit<S>, MotionError> {
        let ends = [self.least(&course.look(start)?), self.least(&course.look(end)?)];
        let roundings = course.roundings;
        let at = fall((start, end), ends, roundings, |at| Ok(Some(self.least(&course.look(at)?))))?;
        let there = course.look(at)?;
        for (side, seen) in self.each_mut().zip(there.each()) {
            side.waits = side.passed(seen) && side.counts();
            side.residue = if side.waits { seen.value.abs() } else { -1.0 };
        }
        self.follow(&there);
        let step = course.step;
        Ok(Hit { at, t: step.time(at), state: step.at_fraction(real(at)) })
    }

    /// The least of the functions that may have an event, as they are before it: positive, and then zero or less.
    fn least(&self, look: &Look<K, C>) -> f64 {
        self.each()
            .zip(look.each())
            .filter(|(side, _)| (side.sign != 0 || side.is_guard()) && side.counts())
            .fold(f64::INFINITY, |least, (side, seen)| least.min(side.left(seen)))
    }
}

/// Where a function that is positive before has just become zero or less, to within `enough`: by the ITP method
/// (Oliveira and Takahashi, *An Enhancement of the Bisection Method Average Performance Preserving Minmax Optimality*,
/// ACM Trans. Math. Softw. 47 (2020)), which takes at most one evaluation more than bisection. It ends where `value` has
/// none.
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
            // At the start the side counts that the motion leaves for, whatever rounding says.
            middle
        };
        // No nearer to an end than the end may be left.
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
