//! Events: zeros of functions of the state, and what happens there.

use nalgebra::SVector;

use super::System;
use super::dense::Interpolant;
use crate::scalar::to_f64;
use crate::{Error, Real, real};

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

/// On which side of zero the functions are, as far as the integration has gone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides<const K: usize> {
    /// 1 or -1; 0 where a function has been zero since the start.
    signs: [i8; K],
    /// Happened at the time reached, not delivered yet.
    pub(super) waiting: [bool; K],
    /// How far from zero rounding has left the functions that have just had their events; of the others -1.
    residues: [f64; K],
    crossings: [Crossing; K],
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

pub(super) fn values<S: System<T, N, K>, T: Real, const N: usize, const K: usize>(
    system: &mut S,
    t: T,
    state: &SVector<T, N>,
) -> Result<[f64; K], Error> {
    let values = system.events(t, state)?.map(to_f64);
    if values.iter().all(|value| value.is_finite()) {
        Ok(values)
    } else {
        Err(Error::NotFiniteAt { quantity: "an event function", t: to_f64(t) })
    }
}

impl<const K: usize> Sides<K> {
    pub(super) fn new(crossings: [Crossing; K]) -> Self {
        Self { signs: [0; K], waiting: [false; K], residues: [-1.0; K], crossings }
    }

    /// The sides at the start of a motion. A function that is zero, or that its event has left within rounding of
    /// zero, is on the side that it leaves for: `after` is a little later.
    pub(super) fn begin<T: Real, S: System<T, N, K>, const N: usize>(
        &mut self,
        system: &mut S,
        (t, state): (T, &SVector<T, N>),
        (later, after): (T, &SVector<T, N>),
    ) -> Result<(), Error> {
        let now = values(system, t, state)?;
        let next = values(system, later, after)?;
        for i in 0..K {
            let on_zero = now[i] == 0.0 || now[i].abs() <= self.residues[i];
            self.signs[i] = if on_zero { sign(next[i] - now[i]) } else { sign(now[i]) };
        }
        Ok(())
    }

    /// Whether function i has reached zero or passed it.
    fn passed(&self, i: usize, value: f64) -> bool {
        self.signs[i] != 0 && sign(value) != self.signs[i]
    }

    /// Whether a passage of function i is an event.
    fn counts(&self, i: usize) -> bool {
        match self.crossings[i] {
            Crossing::Rising => self.signs[i] < 0,
            Crossing::Falling => self.signs[i] > 0,
            Crossing::Either => true,
        }
    }

    fn any(&self, values: &[f64; K]) -> bool {
        (0..K).any(|i| self.passed(i, values[i]) && self.counts(i))
    }

    /// Takes over the sides that these values show.
    fn follow(&mut self, values: &[f64; K]) {
        for (i, &value) in values.iter().enumerate() {
            if self.passed(i, value) {
                self.signs[i] = -self.signs[i];
            } else if self.signs[i] == 0 {
                self.signs[i] = sign(value);
            }
        }
    }

    /// The first events within the step after the part `from`, looked for at `parts` equal parts of the step: a
    /// function that goes through zero twice between two of them is not seen.
    pub(super) fn search<T: Real, S: System<T, N, K>, const N: usize>(
        &mut self,
        system: &mut S,
        step: &Interpolant<T, N>,
        (from, parts): (f64, usize),
        roundings: f64,
    ) -> Result<Option<Hit<T, N>>, Error> {
        let mut before = from;
        for part in 1..=parts {
            let s = part as f64 / parts as f64;
            if s <= from {
                continue;
            }
            let found = values(system, step.time(s), &step.at_fraction(real(s)))?;
            if self.any(&found) {
                let at = self.locate(system, step, (before, s), roundings)?;
                let (t, state) = (step.time(at), step.at_fraction(real(at)));
                let there = values(system, t, &state)?;
                for (i, &value) in there.iter().enumerate() {
                    self.waiting[i] = self.passed(i, value) && self.counts(i);
                    self.residues[i] = if self.waiting[i] { value.abs() } else { -1.0 };
                }
                self.follow(&there);
                return Ok(Some(Hit { at, t, state }));
            }
            self.follow(&found);
            before = s;
        }
        Ok(None)
    }

    /// The least of the functions that may have an event, as they are before it: positive, and then zero or less.
    fn least(&self, values: &[f64; K]) -> f64 {
        (0..K)
            .filter(|&i| self.signs[i] != 0 && self.counts(i))
            .fold(f64::INFINITY, |least, i| least.min(f64::from(self.signs[i]) * values[i]))
    }

    /// Where the first event has just happened, to within `roundings` of the step: by the ITP method (Oliveira and
    /// Takahashi, *An Enhancement of the Bisection Method Average Performance Preserving Minmax Optimality*, ACM
    /// Trans. Math. Softw. 47 (2020)), which takes at most one evaluation more than bisection.
    fn locate<T: Real, S: System<T, N, K>, const N: usize>(
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
