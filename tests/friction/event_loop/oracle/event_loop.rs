//! The event loop: steps, the first event in each, and the modes after it.

use super::enumeration::{FORCE, Laws, Mode};
use super::extrapolation::{State, step};
use super::model::{Law, Model, N, R, Vector, dot};
use super::moved::{Kick, moved, moved_on};
use super::settle::Settling;

/// A gap or a rate within this part of its size is zero.
pub const TOUCH: f64 = 1e-13;
/// An event function passes zero this part of its size late, so that rounding errors are no events.
pub const LATE: f64 = 1e-14;
/// The largest error of a step, relative to the sizes.
const STEP_ERROR: f64 = 1e-14;
/// The most events and steps.
const MOST_EVENTS: usize = 2_000;
const MOST_STEPS: usize = 20_000;

/// A time, coordinates and rates.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    pub t: f64,
    pub x: Vector,
    pub v: Vector,
}

/// The start of a motion.
pub type Start = Point;

/// The points of a motion at the times asked for, and its events.
#[derive(Debug, Clone)]
pub struct Track {
    pub points: Vec<Point>,
    /// The time and the contact of each event.
    pub events: Vec<(f64, usize)>,
    /// The first time at which the impacts of two stops crowd: see [`Settling::collapse`].
    pub collapse: Option<f64>,
}

/// The nearer stop, and the distance to it.
pub fn gap(law: &Law, value: f64) -> (Mode, f64) {
    let Law::Stop { lower, upper, .. } = *law else { return (Mode::Open, f64::INFINITY) };
    if value - lower <= upper - value { (Mode::Lower, value - lower) } else { (Mode::Upper, upper - value) }
}

/// Follows the motion to these rising times, from a start that a kick has moved.
pub fn track<M: Model>(model: &M, start: &Start, times: &[f64], kick: Option<&Kick>) -> Result<Track, String> {
    let laws = Laws::new(model);
    let scales = model.scales();
    let mut run = Run {
        settling: Settling::new(&laws),
        laws: &laws,
        point: *start,
        length: scales.length,
        speed: scales.length / scales.time,
        longest: scales.step,
        next: scales.step / 8.0,
        before: None,
    };
    run.settle_start()?;
    if let Some(kick) = kick {
        run.point = moved(&laws, start, &run.settling.modes, kick, run.speed);
        run.settling = Settling::new(&laws);
        run.settle_start()?;
    }
    run.follow(times, kick)
}

/// The accelerations without contacts.
pub fn free_acceleration<M: Model>(model: &M, start: &Start) -> Vector {
    let Point { t, x, v } = start;
    let rows = model.rows(*t, x, v);
    let motion = Laws::new(model).motion((*t, x, v), &rows, &[Mode::Open; R]);
    motion.expect("links are independent").acceleration
}

struct Run<'a, M> {
    laws: &'a Laws<'a, M>,
    settling: Settling<'a, M>,
    point: Point,
    length: f64,
    speed: f64,
    longest: f64,
    next: f64,
    /// The step before, if no event was between.
    before: Option<(Point, [f64; R])>,
}

impl<M: Model> Run<'_, M> {
    fn settle_start(&mut self) -> Result<(), String> {
        let Point { t, x, v } = self.point;
        self.point.v = self.settling.start(t, &x, &v)?;
        Ok(())
    }

    /// The point after a step from `from`, and the error relative to the allowed.
    fn stepped(&self, from: &Point, h: f64) -> (Point, f64) {
        let rate = |t: f64, y: &State| {
            let (x, v) = split(y);
            let rows = self.laws.model.rows(t, &x, &v);
            let modes = &self.settling.modes;
            let motion = self.laws.motion((t, &x, &v), &rows, modes).expect("the held contacts are independent");
            joined(&v, &motion.acceleration)
        };
        let (y, error) = step(&rate, (from.t, &joined(&from.x, &from.v)), h);
        let (x, v) = split(&y);
        let (by_x, by_v) = split(&error);
        let most = |values: &Vector| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let error = (most(&by_x) / self.length.max(most(&x))).max(most(&by_v) / self.speed.max(most(&v)));
        (Point { t: from.t + h, x, v }, error / STEP_ERROR)
    }

    /// The event functions: negative where a mode has ended.
    fn guards(&self, point: &Point) -> [f64; R] {
        let Point { t, x, v } = point;
        let rows = self.laws.model.rows(*t, x, v);
        let modes = &self.settling.modes;
        let is_held = modes[..self.laws.laws.len()].iter().any(|mode| mode.is_held());
        let motion = is_held.then(|| self.laws.motion((*t, x, v), &rows, modes).expect("they are independent"));
        let mut guards = [f64::INFINITY; R];
        for (place, law) in self.laws.laws.iter().enumerate() {
            let row = M::LINKS + place;
            let held = motion.as_ref().map_or((0.0, 0.0), |motion| (motion.forces[row], motion.force_size[row]));
            guards[place] = match (modes[place], law) {
                (Mode::Forward, _) => rows[row].rate(v) + LATE * self.speed,
                (Mode::Backward, _) => LATE * self.speed - rows[row].rate(v),
                (Mode::Open, Law::Stop { .. }) => {
                    let (side, gap) = gap(law, rows[row].value);
                    // A gap that grows, or has just been let go, is open, whatever the rounding errors.
                    let is_leaving = rows[row].rate(v) * side.inward() > -TOUCH * self.speed;
                    let is_leaving = is_leaving && gap > -TOUCH * self.length;
                    let gap = gap + LATE * self.length;
                    if is_leaving { gap.max(f64::MIN_POSITIVE) } else { gap }
                }
                (Mode::Stick, Law::Friction { limit }) => limit - held.0.abs() + 4.0 * FORCE * held.1,
                (mode, Law::Stop { .. }) => held.0 * mode.inward() + 4.0 * FORCE * held.1,
                _ => f64::INFINITY,
            };
        }
        guards
    }

    fn follow(&mut self, times: &[f64], kick: Option<&Kick>) -> Result<Track, String> {
        let mut track = Track { points: Vec::new(), events: Vec::new(), collapse: None };
        let mut values = self.guards(&self.point);
        let end = *times.last().expect("there are times");
        let mut steps = 0;
        while track.points.len() < times.len() {
            let from = self.point;
            steps += 1;
            if steps > MOST_STEPS {
                return Err(format!("too many steps at {}", from.t));
            }
            let mut h = self.next.min(self.longest).min(self.soon(&from)).min(end - from.t);
            if h <= 0.0 {
                // The end is reached, to rounding error.
                track.points.resize(times.len(), from);
                break;
            }
            let to = loop {
                let (to, error) = self.stepped(&from, h);
                if error <= 1.0 || h < 1e-7 * self.longest {
                    self.next = (h * (0.3 / error.max(1e-9)).powf(1.0 / 11.0).min(2.0)).min(self.longest);
                    break to;
                }
                h *= (0.3 / error).powf(1.0 / 11.0).clamp(0.2, 0.9);
            };
            let to = if end - from.t <= h { Point { t: end, ..to } } else { to };
            let after = self.guards(&to);
            let hit = self.first(&from, &values, &to, &after);
            let reached = hit.map_or(to, |(point, _)| point);
            // An event may be found one step late, at a minimum.
            while !track.points.is_empty() && times[track.points.len() - 1] > reached.t {
                track.points.pop();
            }
            let mut is_asked_for = false;
            while let Some(&time) = times.get(track.points.len()).filter(|&&time| time <= reached.t) {
                track.points.push(if time <= from.t { from } else { self.stepped(&from, time - from.t).0 });
                is_asked_for = true;
            }
            self.point = self.mended(reached);
            if let Some((_, contact)) = hit {
                let Point { t, x, v } = self.point;
                self.point.v = self.settling.event(t, &x, &v, contact)?;
                if let Some(kick) = kick {
                    self.point.v = self.kicked(kick, contact);
                }
                track.events.push((t, contact));
                if track.events.len() > MOST_EVENTS {
                    return Err(format!("too many events at {t}"));
                }
                self.before = None;
                self.next = self.longest / 8.0;
                values = self.guards(&self.point);
            } else if let (true, Some(kick)) = (is_asked_for, kick) {
                self.point = moved_on(self.laws, &self.point, &self.settling.modes, kick, self.speed);
                self.before = None;
                values = self.guards(&self.point);
            } else {
                self.before = Some((from, values));
                values = after;
            }
        }
        track.collapse = self.settling.collapse;
        Ok(track)
    }

    /// The rates after an event, changed by a kick relative to the rate of the contact.
    fn kicked(&self, kick: &Kick, contact: usize) -> Vector {
        let Point { t, x, mut v } = self.point;
        let rate = self.laws.model.rows(t, &x, &v)[M::LINKS + contact].rate(&v);
        for (v, kick_v) in v.iter_mut().zip(&kick.v).take(M::COUNT) {
            *v += kick.size * kick_v * rate.abs();
        }
        self.settling.still(t, &x, &v)
    }

    /// One and a half times the time until an open stop may close: at the end of such a step it is still beyond.
    fn soon(&self, point: &Point) -> f64 {
        let Point { t, x, v } = point;
        let rows = self.laws.model.rows(*t, x, v);
        let motion = self.laws.motion((*t, x, v), &rows, &self.settling.modes).expect("they are independent");
        let mut soon = f64::INFINITY;
        for (place, law) in self.laws.laws.iter().enumerate() {
            if self.settling.modes[place] == Mode::Open {
                let row = &rows[M::LINKS + place];
                let (side, gap) = gap(law, row.value);
                let rate = row.rate(v) * side.inward();
                let back = -(dot(&row.gradient, &motion.acceleration) + row.bias) * side.inward();
                if rate < -TOUCH * self.speed {
                    soon = soon.min((gap.max(0.0) + LATE * self.length) / -rate);
                } else if rate > TOUCH * self.speed && back > 0.0 {
                    soon = soon.min(2.0 * rate / back);
                }
            }
        }
        (1.5 * soon).max(1e-7 * self.longest)
    }

    /// Removes the drift of the links.
    fn mended(&self, point: Point) -> Point {
        let Point { t, mut x, mut v } = point;
        if M::LINKS == 0 {
            return point;
        }
        let links: Vec<usize> = (0..M::LINKS).collect();
        let rows = self.laws.model.rows(t, &x, &v);
        let mut wanted = [0.0; R];
        for (wanted, row) in wanted.iter_mut().zip(&rows).take(M::LINKS) {
            *wanted = -row.value;
        }
        let change = self.laws.change(&rows, &links, &wanted).expect("links are independent");
        for i in 0..N {
            x[i] += change[i];
        }
        let (held, count) = self.laws.held(&self.settling.modes);
        let rows = self.laws.model.rows(t, &x, &v);
        for (wanted, &row) in wanted.iter_mut().zip(&held[..count]) {
            *wanted = -rows[row].rate(&v);
        }
        let change = self.laws.change(&rows, &held[..count], &wanted).expect("they are independent");
        for i in 0..N {
            v[i] += change[i];
        }
        Point { t, x, v }
    }

    /// The first event between two points of a step, or in a minimum around its start.
    fn first(&self, from: &Point, values: &[f64; R], to: &Point, after: &[f64; R]) -> Option<(Point, usize)> {
        let mut first: Option<(Point, usize)> = None;
        for place in 0..self.laws.laws.len() {
            let end = first.as_ref().map_or(*to, |(point, _)| *point);
            let found = if after[place] < 0.0 {
                Some(self.zero(from, (from, values[place].max(0.0)), to, place))
            } else {
                self.minimum(from, values[place], (to, after[place]), place)
            };
            if let Some(found) = found.filter(|found| first.is_none() || found.t < end.t) {
                first = Some((found, place));
            }
        }
        // A gap below zero before a friction turns the motion back, and above zero at the end of a step that does not know of it.
        while let Some((point, of)) = first {
            let there = self.guards(&point);
            let Some(place) = (0..self.laws.laws.len()).find(|&place| place != of && there[place] < 0.0) else { break };
            let earlier = self.zero(from, (from, values[place].max(0.0)), &point, place);
            if earlier.t >= point.t {
                break;
            }
            first = Some((earlier, place));
        }
        first
    }

    /// The zero of an event function between two points, the second with a negative value; on its negative side.
    fn zero(&self, from: &Point, (low, value): (&Point, f64), high: &Point, place: usize) -> Point {
        let (mut low, mut low_value) = (low.t - from.t, value);
        let (mut end, mut high_value) = (*high, self.guards(high)[place]);
        let mut last_side = 0_i32;
        for _ in 0..200 {
            let high = end.t - from.t;
            let width = high - low;
            let is_fine = width <= 2.0 * f64::EPSILON * (end.t.abs() + high);
            if is_fine {
                break;
            }
            // The secant with the Illinois rule, at least a thousandth within the bracket.
            let part = (low_value / (low_value - high_value)).clamp(1e-3, 1.0 - 1e-3);
            let middle = low + width * if low_value == 0.0 || last_side.abs() > 6 { 0.5 } else { part };
            let (point, _) = self.stepped(from, middle);
            let value = self.guards(&point)[place];
            if value < 0.0 {
                (end, high_value) = (point, value);
                low_value *= if last_side > 0 { 0.5 } else { 1.0 };
                last_side = last_side.max(0) + 1;
            } else {
                (low, low_value) = (middle, value);
                high_value *= if last_side < 0 { 0.5 } else { 1.0 };
                last_side = last_side.min(0) - 1;
            }
            if last_side.abs() > 7 {
                last_side = 0;
            }
        }
        end
    }

    /// The event at a minimum below zero between the step before and this one.
    fn minimum(&self, from: &Point, value: f64, (to, after): (&Point, f64), place: usize) -> Option<Point> {
        let (before, earlier) = self.before.as_ref().map(|(point, values)| (point, values[place]))?;
        let is_least = earlier > value && value < after;
        if !is_least || after.is_infinite() || earlier.is_infinite() {
            return None;
        }
        // The parabola through three points; the search is only made where it comes near zero.
        let (h0, h1) = (from.t - before.t, to.t - from.t);
        let (d0, d1) = ((value - earlier) / h0, (after - value) / h1);
        let bend = (d1 - d0) / (h0 + h1);
        let slope = d0 + bend * h0;
        let least = value - slope * slope / (4.0 * bend);
        if least > 0.5 * value {
            return None;
        }
        let at = |tau: f64| {
            let start = if tau <= from.t { before } else { from };
            let (point, _) = self.stepped(start, tau - start.t);
            (point, self.guards(&point)[place])
        };
        let (mut a, mut c) = (before.t, to.t);
        let golden = 0.381_966_011_250_105;
        let (mut b, mut d) = (a + golden * (c - a), c - golden * (c - a));
        let (mut at_b, mut at_d) = (at(b), at(d));
        for _ in 0..60 {
            for found in [&at_b, &at_d] {
                if found.1 < 0.0 {
                    let start = if found.0.t <= from.t { before } else { from };
                    let value = self.guards(start)[place].max(0.0);
                    return Some(self.zero(start, (start, value), &found.0, place));
                }
            }
            if at_b.1 < at_d.1 {
                (c, d, at_d) = (d, b, at_b);
                b = a + golden * (c - a);
                at_b = at(b);
            } else {
                (a, b, at_b) = (b, d, at_d);
                d = c - golden * (c - a);
                at_d = at(d);
            }
            if c - a < 1e-9 * self.longest {
                break;
            }
        }
        None
    }
}

fn joined(x: &Vector, v: &Vector) -> State {
    let mut y = [0.0; 2 * N];
    y[..N].copy_from_slice(x);
    y[N..].copy_from_slice(v);
    y
}

fn split(y: &State) -> (Vector, Vector) {
    let (mut x, mut v) = ([0.0; N], [0.0; N]);
    x.copy_from_slice(&y[..N]);
    v.copy_from_slice(&y[N..]);
    (x, v)
}
