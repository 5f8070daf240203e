//! Contact events: impacts, the end of bouncing, and the modes after them.

use super::enumeration::{Laws, Mode, Modes, Struck};
use super::event_loop::{LATE, TOUCH, gap};
use super::model::{Law, Model, R, Vector, dot};

/// Impacts at gaps that differ by less than this part of the length are at one time.
const TOGETHER: f64 = 5e-15;
/// Impacts that follow each other within this many ulps of the time are one crowd,
const CROWDED_ULPS: f64 = 64.0;
/// and where there are more than this many, the series has reached its limit, in which all rates are zero.
const MOST_CROWDED: usize = 12;
/// The most impacts in turn at one time.
const MOST_IN_TURN: usize = 100_000;
/// Three impacts of two stops within this part of the time scale collapse.
const COLLAPSE: f64 = 1e-8;

/// The modes, with the memory that the end of bouncing needs.
pub struct Settling<'a, M> {
    laws: &'a Laws<'a, M>,
    pub modes: Modes,
    hardest: [f64; R],
    /// The time of the last impact, and the number of impacts around it.
    last: (f64, usize),
    /// The last impacts: time and stop.
    impacts: [(f64, usize); 3],
    /// The first time at which a body rattles between two others until the flights are shorter than the rounding error of the
    /// time: infinitely many impacts in a finite time, of which the last are decided by rounding errors.
    pub collapse: Option<f64>,
    time: f64,
    length: f64,
    speed: f64,
}

impl<'a, M: Model> Settling<'a, M> {
    pub fn new(laws: &'a Laws<'a, M>) -> Self {
        let scales = laws.model.scales();
        let speed = scales.length / scales.time;
        Self {
            laws,
            modes: [Mode::Open; R],
            hardest: [0.0; R],
            last: (f64::NEG_INFINITY, 0),
            impacts: [(f64::NEG_INFINITY, R); 3],
            collapse: None,
            time: scales.time,
            length: scales.length,
            speed,
        }
    }

    /// Finds the modes at the start; returns the rates after an impact there.
    pub fn start(&mut self, t: f64, x: &Vector, v: &Vector) -> Result<Vector, String> {
        let rows = self.laws.model.rows(t, x, v);
        for (place, law) in self.laws.laws.iter().enumerate() {
            let rate = rows[M::LINKS + place].rate(v);
            if matches!(law, Law::Friction { .. }) {
                self.modes[place] = self.slip_or_stick(rate);
            }
        }
        self.event(t, x, v, R)
    }

    fn slip_or_stick(&self, rate: f64) -> Mode {
        if rate.abs() <= TOUCH * self.speed {
            Mode::Stick
        } else if rate > 0.0 {
            Mode::Forward
        } else {
            Mode::Backward
        }
    }

    /// Settles the contacts where the event function of `contact` has passed zero; returns the rates after it.
    pub fn event(&mut self, t: f64, x: &Vector, v: &Vector, contact: usize) -> Result<Vector, String> {
        let rows = self.laws.model.rows(t, x, v);
        let mut v = *v;
        let mut at_rest = [None; R];
        for (place, law) in self.laws.laws.iter().enumerate() {
            let row = &rows[M::LINKS + place];
            let is_still = row.rate(&v).abs() <= TOUCH * self.speed;
            let (side, gap) = gap(law, row.value);
            at_rest[place] = match self.modes[place] {
                Mode::Stick | Mode::Lower | Mode::Upper => Some(self.modes[place]),
                Mode::Forward | Mode::Backward => (is_still || place == contact).then_some(Mode::Stick),
                Mode::Open => (is_still && gap <= TOUCH * self.length).then_some(side),
            };
        }
        // Stops that were closed before the event take part in each of its impacts. Those that one of them closes have their own turn.
        let mut closed = at_rest.map(|side| side.is_some());
        // At the start nothing says which of two impacts is first.
        let near = if contact == R { TOUCH } else { TOGETHER - LATE };
        for round in 0.. {
            if round > MOST_IN_TURN {
                return Err(format!("impacts without end at {t}"));
            }
            let mut struck: [Option<Struck>; R] = [None; R];
            let (mut hits, mut rebounds) = (false, false);
            for (place, law) in self.laws.laws.iter().enumerate() {
                let Law::Stop { restitution, .. } = *law else { continue };
                let row = &rows[M::LINKS + place];
                let (side, gap) = gap(law, row.value);
                if let Some(side) = at_rest[place] {
                    struck[place] = Some(Struck { inward: side.inward(), restitution: 0.0 });
                } else if gap <= near * self.length && row.rate(&v) * side.inward() < 0.0 {
                    struck[place] = Some(Struck { inward: side.inward(), restitution });
                    hits = true;
                    rebounds |= restitution > 0.0;
                }
            }
            if !hits {
                break;
            }
            for place in (0..R).filter(|&place| rebounds && at_rest[place].is_some() && !closed[place]) {
                struck[place] = None;
            }
            v = self.strike((t, x, &v), struck, (&mut at_rest, round))?;
            for (closed, side) in closed.iter_mut().zip(&at_rest) {
                *closed &= side.is_some();
            }
        }
        self.modes = self.laws.choose((t, x, &v), &self.modes, &at_rest).map_err(|what| format!("{what} at {t}"))?;
        for (hardest, _) in self.hardest.iter_mut().zip(&at_rest).filter(|(_, side)| side.is_some()) {
            *hardest = 0.0;
        }
        Ok(self.still(t, x, &v))
    }

    /// The rates with s' = 0 of the links and the held contacts.
    pub fn still(&self, t: f64, x: &Vector, v: &Vector) -> Vector {
        let rows = self.laws.model.rows(t, x, v);
        let (held, count) = self.laws.held(&self.modes);
        let mut wanted = [0.0; R];
        for (wanted, &row) in wanted.iter_mut().zip(&held[..count]) {
            *wanted = -rows[row].rate(v);
        }
        let change = self.laws.change(&rows, &held[..count], &wanted).expect("the held contacts are independent");
        let mut still = *v;
        for (still, change) in still.iter_mut().zip(change) {
            *still += change;
        }
        still
    }

    fn strike(
        &mut self,
        (t, x, v): (f64, &Vector, &Vector),
        mut struck: [Option<Struck>; R],
        (at_rest, round): (&mut [Option<Mode>; R], usize),
    ) -> Result<Vector, String> {
        let count = self.laws.laws.len();
        let rows = self.laws.model.rows(t, x, v);
        if round == 0 {
            let is_crowded = t - self.last.0 <= CROWDED_ULPS * f64::EPSILON * t.abs();
            self.last = (t, if is_crowded { self.last.1 + 1 } else { 0 });
        }
        for place in (0..count).filter(|&place| at_rest[place].is_none()) {
            let Some(of) = &mut struck[place] else { continue };
            if round == 0 {
                self.impacts = [self.impacts[1], self.impacts[2], (t, place)];
            }
            let [first, second, last] = self.impacts;
            if (second.1 != last.1 || first.1 != last.1) && t - first.0 <= COLLAPSE * self.time {
                self.collapse = self.collapse.or(Some(first.0));
            }
            let rate = rows[M::LINKS + place].rate(v).abs();
            self.hardest[place] = self.hardest[place].max(rate);
            if of.restitution * rate <= f64::EPSILON.sqrt() * self.hardest[place] || self.last.1 > MOST_CROWDED {
                of.restitution = 0.0;
            }
        }
        let at = |what: &str| format!("{what} at {t}");
        let (mut after, mut impulses) = self.laws.impact(&rows, v, &struck).map_err(at)?;
        // The end of bouncing: a flight shorter than the rounding error of the time, or lower than that of the gap.
        let rows_after = self.laws.model.rows(t, x, &after);
        let mut slipping = [Mode::Open; R];
        for (place, law) in self.laws.laws.iter().enumerate() {
            let mode = self.slip_or_stick(rows_after[M::LINKS + place].rate(&after));
            if matches!(law, Law::Friction { .. }) && mode != Mode::Stick {
                slipping[place] = mode;
            }
        }
        let free = self.laws.motion((t, x, &after), &rows_after, &slipping).expect("links are independent");
        let mut has_ended = false;
        for (place, of) in struck.iter_mut().enumerate().take(count) {
            let Some(Struck { inward, restitution }) = of else { continue };
            let row = &rows_after[M::LINKS + place];
            let back = -(dot(&row.gradient, &free.acceleration) + row.bias) * *inward;
            let rate = row.rate(&after) * *inward;
            let is_short = 2.0 * rate <= 64.0 * f64::EPSILON * t.abs() * back;
            let is_low = rate * rate <= 2.0 * f64::EPSILON * self.length * back;
            if *restitution != 0.0 && back > 0.0 && (is_short || is_low) {
                *restitution = 0.0;
                has_ended = true;
            }
        }
        if has_ended {
            (after, impulses) = self.laws.impact(&rows, v, &struck).map_err(at)?;
        }
        for (place, law) in self.laws.laws.iter().enumerate() {
            let rate = rows[M::LINKS + place].rate(&after);
            if matches!(law, Law::Friction { .. }) {
                self.modes[place] = self.slip_or_stick(rate);
                at_rest[place] = (self.modes[place] == Mode::Stick).then_some(Mode::Stick);
            } else if let Some(of) = struck[place] {
                let is_still = rate.abs() <= TOUCH * self.speed;
                let rests = of.restitution == 0.0 && (is_still || impulses[place] > 0.0);
                let side = if of.inward > 0.0 { Mode::Lower } else { Mode::Upper };
                at_rest[place] = rests.then_some(side);
                self.modes[place] = if rests { side } else { Mode::Open };
            } else {
                // It was closed by an impact before this one.
                let (side, gap) = gap(law, rows[M::LINKS + place].value);
                let is_still = rate.abs() <= TOUCH * self.speed && gap <= TOUCH * self.length;
                at_rest[place] = is_still.then_some(side);
                self.modes[place] = Mode::Open;
            }
        }
        Ok(after)
    }
}
