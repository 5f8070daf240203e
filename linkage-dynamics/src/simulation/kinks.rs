//! Kinks of laws: the steps of a simulation end there.
//!
//! A scene has an expression for each kink of its laws, such as t - 1 for `abs(t - 1)`, which changes its sign there. At
//! its zero the derivatives of the law may be undefined, so that no law is evaluated there:
//! - an expression of time alone is searched before each step: the step ends at the last time before the change of sign,
//!   and the motion continues from the first time after it;
//! - for one of the state, a step that passes its zero is repeated with a shorter length, until it ends where the expression is
//!   its rounding error, by those of the state, and not zero yet. One step goes over the zero, to where it is that error again with
//!   the other sign. Since the law has changed by no more than that error, or for no longer, such a step is exact to rounding
//!   errors of the state, which may take much longer than those of the time.
//!
//! An expression that touches zero without a change of sign is no kink.

use super::corners::{Corner, CornerOf};
use super::frame::Change;
use super::motion::{Motion, Polynomial};
use crate::scene::{Kink, beside, one_sided, sign, sign_at};
use crate::{Coordinates, MotionErrorOf, NameOf, Prescribed, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::jacobian::first_not_positive;
use linkage_runtime::{Column, Dim, Mechanism, real};

/// The number of equal parts of a step at whose ends expressions of time are sampled: two kinks within one part are
/// missed. A drive is checked against its integral too, which shows them.
const PARTS_OF_TIME: usize = 16;

/// The number of equal parts of a step at whose ends expressions of the state are sampled.
const PARTS_OF_STATE: usize = 8;

/// A kink of the state is located to this many ulps of the time at least: half of it is more than ten ulps, the shortest step.
const AT_KINK_ULPS: f64 = 24.0;

/// The error of an expression of the state, in ulps of the coordinates and rates: below it a change of sign is none, as
/// of the rate of a body at rest.
const NOISE_ULPS: f64 = 16.0;

/// A step begins at a kink if its expression is at most this many times its error until it passes zero: where a step was to end
/// at once that error.
const AT_KINK_NOISES: f64 = 2.0;

/// The first kink of the state in a step.
struct FirstKink<N> {
    /// The fractions of the step between which the expression is zero up to its error.
    within: [f64; 2],
    /// True if the step begins there.
    is_here: bool,
    place: usize,
    effect: N,
    /// The sign of its expression before it.
    sign: i8,
}

/// True if a kink of the scene depends on time alone.
fn has_timed<S: Scene>(scene: &S) -> bool {
    scene.kinks().any(|kink| kink.is_timed)
}

/// True if a kink of the scene depends on the state.
fn has_moving<S: Scene>(scene: &S) -> bool {
    scene.kinks().any(|kink| !kink.is_timed)
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// True if the laws at t are those after a kink there: at the start of the step, else they are those before it.
    fn is_after(&self, t: S::Scalar) -> bool {
        (t == self.corners.from) == self.corners.is_forward
    }

    /// Returns t, or at a kink of time a time next to it within the step.
    pub(super) fn beside(&self, t: S::Scalar) -> S::Scalar {
        if has_timed(&*self.scene) { beside(&*self.scene, t, self.is_after(t)) } else { t }
    }

    /// The prescribed motion of each input.
    pub(super) fn prescribed(&self, t: S::Scalar) -> Column<Option<Prescribed<S::Scalar>>, S::V> {
        if has_timed(&*self.scene) { one_sided(&*self.scene, t, self.is_after(t)) } else { self.scene.prescribed(t) }
    }

    /// Returns y a little later if an expression of the state is zero there and moves away from it: the law is then that
    /// after its kink.
    pub(super) fn off_kinks(&self, t: S::Scalar, y: &StateColumn<S>) -> Option<StateColumn<S>> {
        let is_smooth = |y: &StateColumn<S>| {
            let mut kinks = self.scene.kinks().enumerate();
            kinks.all(|(place, kink)| {
                kink.is_timed || self.kink_value(place, t, y).is_some_and(|value| !value.is_zero())
            })
        };
        if !has_moving(&*self.scene) || is_smooth(y) {
            return None;
        }
        let ((q, rates), velocity) = (self.unpack(y), self.velocity(y).ok()?);
        // From four ulps of the scales of the coordinates.
        let mut little = S::Scalar::default_epsilon() * real(4.0) / self.scaled_norm(&velocity);
        if !self.corners.is_forward {
            little = -little;
        }
        for _ in 0..8 {
            let near = self.pack(&Self::moved(&q, &(velocity * little)), &rates);
            if is_smooth(&near) {
                return Some(near);
            }
            little *= real(2.0);
        }
        None
    }

    /// Begins a step here.
    pub(super) fn begin_step(&mut self, t: S::Scalar) {
        self.corners.from = t;
        self.corners.ahead = None;
        self.corners.passed = None;
        self.corners.crossing = None;
        self.corners.towards = self.corners.approached.take();
    }

    /// Counts a step of this length: a long one ends a row of kinks.
    pub(super) fn note_step(&mut self, from: S::Scalar, to: S::Scalar) {
        if (to - from).abs() > self.resolution_of_time(from, to).max(self.corners.over) * real(2.0) {
            self.corners.in_a_row = 0;
        }
    }

    /// The rounding error of the time, within which no kink of the state is located.
    fn resolution_of_time(&self, from: S::Scalar, to: S::Scalar) -> S::Scalar {
        from.abs().max(to.abs()) * S::Scalar::default_epsilon() * real(AT_KINK_ULPS)
    }

    /// The end of a step from `t` that would go to `end`, before the next kink of time.
    pub(super) fn end_before_kink(&mut self, t: S::Scalar, end: S::Scalar) -> S::Scalar {
        self.corners.ahead = self.next_corner(t, end);
        match self.corners.ahead {
            Some(corner) => corner.before,
            None => end,
        }
    }

    /// The change of a law at the time t itself: the motion continues after it.
    pub(super) fn corner_at(&self, t: S::Scalar) -> Option<CornerOf<S>> {
        self.next_corner(t, t).filter(|corner| corner.before == t)
    }

    /// The first change of a law of time between two times, or just after the second.
    fn next_corner(&self, t: S::Scalar, end: S::Scalar) -> Option<CornerOf<S>> {
        let is_forward = self.corners.is_forward;
        let is_ahead = |a: S::Scalar, b: S::Scalar| if is_forward { a <= b } else { a >= b };
        let found = self.corners.found;
        let mut first = found.filter(|corner| is_ahead(t, corner.before) && is_ahead(corner.before, end));
        if !has_timed(&*self.scene) {
            return first;
        }
        let timed = self.scene.kinks().enumerate().filter(|(_, kink)| kink.is_timed);
        for (place, Kink { effect, .. }) in timed {
            // A zero at the end shows its change of sign a little later; not at the end of the simulation.
            let little = self.resolution_of_time(t, end);
            let beyond = if is_forward { end + little } else { end - little };
            let most = if is_ahead(beyond, self.corners.end) { beyond } else { self.corners.end };
            let sign = |t: S::Scalar| sign_at(&*self.scene, place, t);
            let (mut last, mut own) = (t, sign(t));
            if own == 0 {
                own = sign(beside(&*self.scene, t, is_forward));
            }
            for part in 1..=PARTS_OF_TIME + 1 {
                let fraction: S::Scalar = real(part as f64 / PARTS_OF_TIME as f64);
                let here = if part > PARTS_OF_TIME { most } else { t + (end - t) * fraction };
                let now = sign(here);
                if own == 0 {
                    own = now;
                }
                if now == own {
                    last = here;
                } else if now != 0 {
                    let before = self.boundary(last, here, |t| sign(t) == own);
                    let after = self.boundary(here, last, |t| sign(t) == now);
                    if first.is_none_or(|first| !is_ahead(first.before, before)) {
                        first = Some(Corner { before, after, effect });
                    }
                    break;
                }
            }
        }
        first
    }

    /// The last time after `from`, where `holds` is true, at which it is still true, towards `to`, where it is false.
    pub(super) fn boundary(&self, from: S::Scalar, to: S::Scalar, holds: impl Fn(S::Scalar) -> bool) -> S::Scalar {
        let (mut inside, mut outside) = (from, to);
        let tiny = (self.corners.end - self.corners.from).abs() * real(f64::EPSILON * f64::EPSILON);
        loop {
            let middle = inside + (outside - inside) * real(0.5);
            if middle == inside || middle == outside || (outside - inside).abs() <= tiny {
                return inside;
            }
            if holds(middle) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
    }

    /// The value of an expression of the state; None if it cannot be computed.
    fn kink_value(&self, place: usize, t: S::Scalar, y: &StateColumn<S>) -> Option<S::Scalar> {
        let (q, _) = self.unpack(y);
        let velocity = self.velocity(y).ok()?;
        let value = self.scene.kink(place, t, &q, &S::Mechanism::rates(velocity.unknowns, velocity.inputs));
        value.is_finite().then_some(value)
    }

    /// The rounding error of an expression of the state: the sum of its changes by the errors of each coordinate and of
    /// each rate, in a few ulps of their scales and of the speed of the motion.
    fn kink_noise(&self, place: usize, t: S::Scalar, y: &StateColumn<S>) -> Option<f64> {
        let (q, _) = self.unpack(y);
        let velocity = self.velocity(y).ok()?;
        let speed = self.scaled_norm(&velocity);
        let scales = &self.scales.coordinates;
        let value = |q: &Coordinates<S>, rates: &Change<S>| {
            self.scene.kink(place, t, q, &S::Mechanism::rates(rates.unknowns, rates.inputs))
        };
        let here = value(&q, &velocity);
        let ulps = S::Scalar::default_epsilon() * real(NOISE_ULPS);
        let mut sum = S::Scalar::zero();
        let (u, v) = self.dims();
        for column in 0..u.count() + v.count() {
            let mut error = Change::<S>::zero((u, v));
            let of = |error: &mut Change<S>, size: S::Scalar| {
                if column < u.count() {
                    error.unknowns[column] = size * ulps;
                } else {
                    error.inputs[column - u.count()] = size * ulps;
                }
            };
            let scale = scales.get(column);
            of(&mut error, Self::column(&q).get(column).abs().max(scale));
            sum += (value(&Self::moved(&q, &error), &velocity) - here).abs();
            of(&mut error, velocity.get(column).abs().max(scale * speed));
            sum += (value(&q, &(velocity + error)) - here).abs();
        }
        let noise = to_f64(sum);
        noise.is_finite().then_some(noise)
    }

    /// The first kink of the state in a step, of which this part is the rounding error of the time.
    fn first_kink(&self, step: &Polynomial<S>, at_kink: f64) -> Result<Option<FirstKink<NameOf<S>>>, MotionErrorOf<S>> {
        let (from, to) = step.interval();
        let mut first: Option<FirstKink<NameOf<S>>> = None;
        let moving = self.scene.kinks().enumerate().filter(|(_, kink)| !kink.is_timed);
        for (place, Kink { effect, .. }) in moving {
            let value = |part: f64| {
                let value = self.kink_value(place, from + (to - from) * real(part), &step.at_fraction(real(part)));
                value.map_or(0.0, to_f64)
            };
            let part_at = |part: usize| part as f64 / PARTS_OF_STATE as f64;
            let mut values = [0.0; PARTS_OF_STATE + 1];
            for (part, entry) in values.iter_mut().enumerate() {
                *entry = value(part_at(part));
            }
            let has_both = values.iter().any(|&value| value > 0.0) && values.iter().any(|&value| value < 0.0);
            let of_place =
                |known: Option<(usize, i8)>| known.filter(|(other, _)| *other == place).map_or(0, |(_, sign)| sign);
            let towards = of_place(self.corners.approached.or(self.corners.towards));
            if !has_both && towards == 0 {
                continue;
            }
            let noise = self.kink_noise(place, from, &step.at_fraction(S::Scalar::zero())).unwrap_or(0.0);
            // A value within its rounding error has no sign: the run keeps the side on which it came there.
            let sign_beyond = |value: f64| if value.abs() > noise { sign(value) } else { 0 };
            let here = match (towards, sign_beyond(values[0])) {
                (0, 0) => of_place(self.corners.side),
                (0, sign) | (sign, _) => sign,
            };
            let (mut own, mut last) = (here, 0);
            for part in 1..=PARTS_OF_STATE {
                let now = sign_beyond(values[part]);
                if now == 0 || now == own {
                    last = if now == own { part } else { last };
                    continue;
                }
                if own == 0 {
                    // At the start the value is a rounding error; it may have to pass zero yet.
                    own = if sign(values[0]) == -now { -now } else { now };
                    if own == now {
                        last = part;
                        continue;
                    }
                }
                let along = |value: f64| value * f64::from(own);
                // Where the value has fallen to this.
                let fallen = |to: f64| -> Result<f64, MotionErrorOf<S>> {
                    let ends = [along(values[last]) - to, along(values[part]) - to];
                    if ends[0] <= 0.0 {
                        return Ok(part_at(last));
                    }
                    let parts = [part_at(last), part_at(part)];
                    first_not_positive(parts, ends, 0.25 * at_kink, |at| Ok(Some(along(value(at)) - to)))
                };
                let within = [fallen(noise)?, fallen(-noise)?];
                // After a kink the expression begins within its error too, and grows before it passes zero again.
                let stays = |at: f64| along(value(at)) <= AT_KINK_NOISES * noise;
                let is_here = within[0] <= at_kink || (stays(0.0) && stays(0.5 * within[0]));
                if first.as_ref().is_none_or(|first| within[0] < first.within[0]) {
                    first = Some(FirstKink { within, is_here, place, effect, sign: own });
                }
                break;
            }
        }
        Ok(first)
    }

    /// Keeps the side of the last kink after a step without one, in which it has changed where the rates jumped before it.
    fn keep_side(&mut self, step: &Polynomial<S>) {
        let Some((place, side)) = self.corners.side else { return };
        let (_, to) = step.interval();
        let y = step.at_fraction(S::Scalar::one());
        let value = self.kink_value(place, to, &y).map_or(0.0, to_f64);
        if sign(value) == -side && self.kink_noise(place, to, &y).is_some_and(|noise| value.abs() > noise) {
            self.corners.side = Some((place, -side));
        }
    }

    /// The fraction of a step at which it must end because a kink of the state is within it.
    ///
    /// # Errors
    /// [`MotionError::KinksWithoutEnd`](crate::MotionError::KinksWithoutEnd).
    pub(super) fn kink_within(&mut self, step: &Polynomial<S>) -> Result<Option<f64>, MotionErrorOf<S>> {
        if !has_moving(&*self.scene) {
            return Ok(None);
        }
        let (from, to) = step.interval();
        let length = to_f64(to - from).abs();
        let at_kink = to_f64(self.resolution_of_time(from, to)) / length;
        if let Some((effect, side)) = self.corners.crossing.take() {
            (self.corners.passed, self.corners.side) = (Some(effect), Some(side));
            self.corners.over = (to - from).abs();
            return Ok(None);
        }
        // Too short for an error.
        if at_kink >= 0.5 {
            return Ok(None);
        }
        let Some(FirstKink { within: [last, first], is_here, place, effect, sign }) = self.first_kink(step, at_kink)?
        else {
            self.keep_side(step);
            return Ok(None);
        };
        if !is_here {
            self.corners.approached = Some((place, sign));
            return Ok(Some(last - 0.5 * at_kink));
        }
        self.corners.note(self.scene.name(), effect, from)?;
        self.corners.approached = None;
        self.corners.crossing = Some((effect, (place, -sign)));
        // A little beyond.
        Ok(Some((first + 0.25 * (first - last) + 0.5 * at_kink).min(1.0)))
    }
}
