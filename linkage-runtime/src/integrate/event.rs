//! Events: zeros of functions of the state, and what happens there.

use nalgebra::SVector;

use super::System;
use super::dense::Interpolant;
use super::samples::Samples;
use crate::scalar::to_f64;
use crate::{Error, Real, real};

/// How often a guard may be zero at one time: where several are within rounding, each may move the others.
const MOST_TURNS: u32 = 8;

/// The most parts of a step at which guards are looked at.
const MOST_PARTS: usize = 64;

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

/// What happens at an event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action<T, const N: usize> {
    /// The event is recorded and the motion goes on.
    Record,
    /// The integration ends here.
    Stop,
    /// The motion starts anew from this state: after an impact, or where from here on another law holds. The length
    /// of the steps is kept.
    Restart(SVector<T, N>),
}

/// On which side of zero the functions are, as far as the integration has gone: the user's, then the guards.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides<const K: usize, const C: usize> {
    events: [Side; K],
    guards: [Side; C],
}

#[derive(Debug, Clone, Copy)]
struct Side {
    /// 1 or -1; 0 where the function has been zero since the start.
    sign: i8,
    /// Its event has happened at the time reached, and is not delivered yet.
    waits: bool,
    /// How often it has had an event at the last time of events.
    happened: u32,
    /// How far from zero rounding has left a function that has just had its event; of the others -1.
    residue: f64,
    crossing: Crossing,
}

/// Of the events and of the guards.
type Values<const K: usize, const C: usize> = ([f64; K], [f64; C]);

/// What is found in a step.
pub(super) enum Found<T: Real, const N: usize> {
    /// No event.
    Nothing,
    /// The first events.
    Hit(Hit<T, N>),
    /// The guards change too much in it to be followed.
    Unclear,
}

/// The first events in the step after some part of it.
pub(super) struct Hit<T: Real, const N: usize> {
    /// Part of the step.
    pub(super) at: f64,
    pub(super) t: T,
    pub(super) state: SVector<T, N>,
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

fn values<S: System<T, N, K, C>, T: Real, const N: usize, const K: usize, const C: usize>(
    system: &mut S,
    t: T,
    state: &SVector<T, N>,
) -> Result<Values<K, C>, Error> {
    let events = if K > 0 { system.events(t, state)?.map(to_f64) } else { [0.0; K] };
    let guards = if C > 0 { system.guards(t, state)?.map(to_f64) } else { [0.0; C] };
    if events.iter().chain(&guards).all(|value| value.is_finite()) {
        Ok((events, guards))
    } else {
        Err(Error::NotFiniteAt { quantity: "an event function", t: to_f64(t) })
    }
}

impl Side {
    fn new(crossing: Crossing) -> Self {
        Self { sign: 0, waits: false, happened: 0, residue: -1.0, crossing }
    }

    /// Whether the function has reached zero or passed it.
    fn passed(&self, value: f64) -> bool {
        self.sign != 0 && sign(value) != self.sign
    }

    /// Whether a passage is an event.
    fn counts(&self) -> bool {
        match self.crossing {
            Crossing::Rising => self.sign < 0,
            Crossing::Falling => self.sign > 0,
            Crossing::Either => true,
        }
    }
}

impl<const K: usize, const C: usize> Sides<K, C> {
    pub(super) fn new(crossings: [Crossing; K]) -> Self {
        Self { events: crossings.map(Side::new), guards: [Side::new(Crossing::Falling); C] }
    }

    fn each(&self) -> impl Iterator<Item = &Side> {
        self.events.iter().chain(&self.guards)
    }

    fn each_mut(&mut self) -> impl Iterator<Item = &mut Side> {
        self.events.iter_mut().chain(&mut self.guards)
    }

    fn with<'a>(&'a self, values: &'a Values<K, C>) -> impl Iterator<Item = (&'a Side, f64)> {
        self.each().zip(values.0.iter().chain(&values.1).copied())
    }

    fn with_mut<'a>(&'a mut self, values: &'a Values<K, C>) -> impl Iterator<Item = (&'a mut Side, f64)> {
        self.each_mut().zip(values.0.iter().chain(&values.1).copied())
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
            (event, side.happened > if event < K { 1 } else { MOST_TURNS })
        })
    }

    /// The sides at the start of a motion. A function that is zero, or that its event has left within rounding of
    /// zero, is on the side that it leaves for: `after` is a little later. A guard that has had its event is positive
    /// again, whatever rounding says: if it does not become so its event happens once more.
    pub(super) fn begin<T: Real, S: System<T, N, K, C>, const N: usize>(
        &mut self,
        system: &mut S,
        (t, state): (T, &SVector<T, N>),
        (later, after): (T, &SVector<T, N>),
    ) -> Result<(), Error> {
        let now = values(system, t, state)?;
        let next = values(system, later, after)?;
        for (place, ((side, now), next)) in self.with_mut(&now).zip(next.0.iter().chain(&next.1)).enumerate() {
            let on_zero = now == 0.0 || now.abs() <= side.residue;
            let is_mended = place >= K && side.happened > 0;
            side.sign = if is_mended { 1 } else { sign(if on_zero { next - now } else { now }) };
        }
        Ok(())
    }

    fn any(&self, values: &Values<K, C>) -> bool {
        self.with(values).any(|(side, value)| side.passed(value) && side.counts())
    }

    /// Takes over the sides that these values show.
    fn follow(&mut self, values: &Values<K, C>) {
        for (side, value) in self.with_mut(values) {
            if side.passed(value) {
                side.sign = -side.sign;
            } else if side.sign == 0 {
                side.sign = sign(value);
            }
        }
    }

    /// The first events within the step after the part `from`, looked for at `parts` equal parts of the step: an event
    /// function that goes through zero twice between two of them is not seen. Guards are looked at more often where
    /// they bend, and where they come near zero and turn.
    pub(super) fn search<T: Real, S: System<T, N, K, C>, const N: usize>(
        &mut self,
        system: &mut S,
        step: &Interpolant<T, N>,
        (from, parts): (f64, usize),
        roundings: f64,
    ) -> Result<Found<T, N>, Error> {
        let (sides, mut parts) = (*self, parts);
        loop {
            match self.scan(system, step, (from, parts), roundings)? {
                Found::Unclear if parts < MOST_PARTS => {
                    *self = sides;
                    parts *= 2;
                }
                found => return Ok(found),
            }
        }
    }

    fn scan<T: Real, S: System<T, N, K, C>, const N: usize>(
        &mut self,
        system: &mut S,
        step: &Interpolant<T, N>,
        (from, parts): (f64, usize),
        roundings: f64,
    ) -> Result<Found<T, N>, Error> {
        let width = (parts as f64).recip();
        let mut samples = Samples::new();
        if C > 0 && from == 0.0 {
            samples.push(values(system, step.time(from), &step.at_fraction(real(from)))?.1);
        }
        // Between which parts of the step something has happened first.
        let mut happened = None;
        for part in 1..=parts {
            let s = part as f64 / parts as f64;
            if s <= from {
                continue;
            }
            let found = values(system, step.time(s), &step.at_fraction(real(s)))?;
            samples.push(found.1);
            if samples.are_unclear() {
                return Ok(Found::Unclear);
            }
            let before = s - width;
            if happened.is_none() {
                if self.any(&found) {
                    happened = Some((before.max(from), s));
                } else {
                    self.follow(&found);
                }
            }
            // In what lies behind, if that was seen well.
            let until = happened.map_or(s, |(start, _)| start);
            for turn in samples.turns().map(|turn| before + width * turn).filter(|turn| *turn < until) {
                if self.any(&values(system, step.time(turn), &step.at_fraction(real(turn)))?) {
                    happened = Some(((before - width).max(from), turn));
                }
            }
            if happened.is_some() && (C == 0 || samples.are_enough()) {
                break;
            }
        }
        happened.map_or(Ok(Found::Nothing), |between| self.hit(system, step, between, roundings).map(Found::Hit))
    }

    /// The first events between two parts of the step.
    fn hit<T: Real, S: System<T, N, K, C>, const N: usize>(
        &mut self,
        system: &mut S,
        step: &Interpolant<T, N>,
        between: (f64, f64),
        roundings: f64,
    ) -> Result<Hit<T, N>, Error> {
        let at = self.locate(system, step, between, roundings)?;
        let (t, state) = (step.time(at), step.at_fraction(real(at)));
        let there = values(system, t, &state)?;
        for (side, value) in self.with_mut(&there) {
            side.waits = side.passed(value) && side.counts();
            side.residue = if side.waits { value.abs() } else { -1.0 };
        }
        self.follow(&there);
        Ok(Hit { at, t, state })
    }

    /// The least of the functions that may have an event, as they are before it: positive, and then zero or less.
    fn least(&self, values: &Values<K, C>) -> f64 {
        self.with(values)
            .filter(|(side, _)| side.sign != 0 && side.counts())
            .fold(f64::INFINITY, |least, (side, value)| least.min(f64::from(side.sign) * value))
    }

    /// Where the first event has just happened, to within `roundings` of the step: by the ITP method (Oliveira and
    /// Takahashi, *An Enhancement of the Bisection Method Average Performance Preserving Minmax Optimality*, ACM
    /// Trans. Math. Softw. 47 (2020)), which takes at most one evaluation more than bisection.
    fn locate<T: Real, S: System<T, N, K, C>, const N: usize>(
        &self,
        system: &mut S,
        step: &Interpolant<T, N>,
        (mut a, mut b): (f64, f64),
        roundings: f64,
    ) -> Result<f64, Error> {
        let mut value = |s: f64| Ok::<_, Error>(self.least(&values(system, step.time(s), &step.at_fraction(real(s)))?));
        let (mut above, mut below) = (value(a)?, value(b)?);
        let (width, half) = (b - a, 0.5 * roundings);
        // half 2^(iterations allowed)
        let mut radius = half;
        while radius < width {
            radius *= 2.0;
        }
        while b - a > roundings {
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
            let found = value(s)?;
            if found > 0.0 {
                (a, above) = (s, found);
            } else {
                (b, below) = (s, found);
            }
            radius *= 0.5;
        }
        Ok(b)
    }
}
