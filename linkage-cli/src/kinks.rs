//! Change points between two positions of a motion: there it can go on in two ways, and positions by the branch have a corner.
//!
//! Over a step h of the input, a smooth unknown q obeys
//!
//! ```text
//! |q_b - q_a - h (q'_a + q'_b)/2|  <=  h (|q'_a| + |q'_b|)
//! |q'_b - q'_a - h (q''_a + q''_b)/2|  <=  h (|q''_a| + |q''_b|)
//! ```
//!
//! once h is small. The left sides fall as h^3, the right sides as h; where q is as x^n, a zero of the rate, the left side is less
//! than half of the right one at each h. At a jump of q or q' one part of each step keeps the left side, and the right side falls
//! with h. So a step whose left sides are no small share of the right ones is divided, until they are, or until it is a millionth
//! of the first: if it breaks the law then, it holds a change point.

use std::f64::consts::TAU;

use crate::machine::{Machine, Motion};
use crate::motion::Path;

/// The share of the right side below which a step is smooth.
const SMOOTH: f64 = 1.0 / 16.0;

/// The smallest part of a step, and the largest error of numbers near a change point as a share of their scale.
const SMALLEST: f64 = 1.0 / (1 << 20) as f64;

/// The larger part of a step that is divided: in the middle may be the change point itself, which has no rates.
const LARGER: f64 = 0.618;

/// The part of a step around a change point that may have no rates.
const NEXT: f64 = 1.0 / (1 << 12) as f64;

/// The most positions that are computed for one step.
const MOST: usize = 400;

/// The most places that are named.
const NAMED: usize = 5;

/// Says on standard error where the motion through these values of the moving input has a corner.
pub fn warn(machine: &Machine, path: &Path, values: impl IntoIterator<Item = f64>) {
    let found = find(machine, path, values);
    let input = &machine.about.inputs[path.moving];
    let name = &input.name.text;
    let end = if input.is_angle { "deg" } else { "" };
    for of in found.iter().take(NAMED) {
        let [low, high] = of.between.map(|value| if input.is_angle { value.to_degrees() } else { value });
        let error = if input.is_angle { of.error.to_degrees() } else { of.error };
        let at = |value: f64| rounded(value, error);
        let unit = if input.is_angle { "°" } else { "" };
        match of.is_gap {
            false => {
                let at = at(f64::midpoint(low, high));
                anstream::eprintln!(
                    "at {name} = {at}{unit} the motion can go on in two ways (a change point): the positions keep the branch, \
                     and the motion has a corner there; for the smooth motion end with `--to {at}{end}`, and go on from there \
                     with another `--branch`"
                );
            }
            true => anstream::eprintln!(
                "between {name} = {}{unit} and {}{unit} there is no position: the motion does not get across; end with \
                 `--to {}{end}`",
                at(low),
                at(high),
                at(low)
            ),
        }
    }
    if found.len() > NAMED {
        anstream::eprintln!("there are {} more such places", found.len() - NAMED);
    }
}

/// A number with the digits that an error leaves.
fn rounded(value: f64, error: f64) -> String {
    let digits = (-error.log10() - 1.0).floor().clamp(0.0, 12.0) as usize;
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A place that a smooth motion does not have.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Kink {
    between: [f64; 2],
    /// True if there is no position between these values.
    is_gap: bool,
    /// The largest error of both values.
    error: f64,
    /// The width of the step in which it was found.
    step: f64,
}

/// A position with its derivatives by the moving input.
struct Place {
    value: f64,
    motion: Motion,
}

/// The change points between positions at these values.
fn find(machine: &Machine, path: &Path, values: impl IntoIterator<Item = f64>) -> Vec<Kink> {
    let search = Search { machine, path };
    let mut found: Vec<Kink> = Vec::new();
    let mut last: Option<Place> = None;
    let mut is_next = true;
    for value in values {
        let Some(place) = search.place(value) else {
            is_next = false;
            continue;
        };
        if let Some(from) = &last {
            let mut step =
                Step { search: &search, width: (place.value - from.value).abs(), left: MOST, found: Vec::new() };
            step.divide(from, &place);
            // Rows without a position say so themselves.
            let is_new = |kink: &Kink| !kink.is_gap || is_next;
            step.found.into_iter().filter(is_new).for_each(|kink| join(&mut found, kink));
        }
        (last, is_next) = (Some(place), true);
    }
    found
}

/// Adds a place, or makes one that is next to it larger: near a change point, the errors of rates break the law as well, at its
/// place both steps do, and a film that goes back meets it again.
fn join(found: &mut Vec<Kink>, kink: Kink) {
    let ends = |of: &Kink| [of.between[0].min(of.between[1]), of.between[0].max(of.between[1])];
    let [low, high] = ends(&kink);
    let known = found.iter_mut().find(|other| {
        let ([of_low, of_high], near) = (ends(other), NEXT * kink.step.max(other.step));
        other.is_gap == kink.is_gap && low <= of_high + near && of_low <= high + near
    });
    match known {
        Some(known) if !kink.is_gap => {
            let [of_low, of_high] = ends(known);
            known.between = [low.min(of_low), high.max(of_high)];
            known.error = known.between[1] - known.between[0];
        }
        Some(_) => {}
        None => found.push(kink),
    }
}

struct Search<'m> {
    machine: &'m Machine,
    path: &'m Path,
}

impl Search<'_> {
    /// The position at a value, if it has one with rates.
    fn place(&self, value: f64) -> Option<Place> {
        let mut rates = vec![0.0; self.machine.about.inputs.len()];
        rates[self.path.moving] = 1.0;
        let motion = self.machine.motion(&self.path.at(value), &rates).ok()?;
        Some(Place { value, motion })
    }

    /// The largest left side of the law, less the errors of numbers, as a share of its right side.
    fn share(&self, from: &Place, to: &Place) -> f64 {
        let step = to.value - from.value;
        let range = (self.path.ends[1] - self.path.ends[0]).abs();
        let length = |of: &Place| self.machine.solver.largest_length(&of.motion.inputs, &of.motion.unknowns);
        let length = length(from).max(length(to));
        let unknowns = self.machine.about.unknowns.iter().enumerate().map(|(index, unknown)| {
            let pair = |of: fn(&Place) -> &Vec<f64>| [of(from)[index], of(to)[index]];
            let values = pair(|of| &of.motion.unknowns);
            let [rates, accelerations] = [pair(|of| &of.motion.rates), pair(|of| &of.motion.accelerations)];
            let scale = if unknown.is_angle { 1.0 } else { length };
            let turn = from.motion.are_directions[index].then_some(TAU);
            let of_rates = rates[0].abs() + rates[1].abs() + scale / range;
            share(values, rates, step, scale, turn).max(share(rates, accelerations, step, of_rates, None))
        });
        unknowns.fold(0.0, f64::max)
    }
}

/// The left side of the law as a share of its right side, for values with these rates; values that have turns differ by less than
/// half of one from what their rates say.
fn share(values: [f64; 2], rates: [f64; 2], step: f64, scale: f64, turn: Option<f64>) -> f64 {
    let error = values[1] - values[0] - step * f64::midpoint(rates[0], rates[1]);
    let error = turn.map_or(error, |turn| error - (error / turn).round() * turn);
    let left = (error.abs() - SMALLEST * scale).max(0.0);
    if left == 0.0 { 0.0 } else { left / (step.abs() * (rates[0].abs() + rates[1].abs())) }
}

/// A step that is divided.
struct Step<'s> {
    search: &'s Search<'s>,
    width: f64,
    /// The number of positions that may still be computed.
    left: usize,
    found: Vec<Kink>,
}

impl Step<'_> {
    fn divide(&mut self, from: &Place, to: &Place) {
        let share = self.search.share(from, to);
        if share <= SMOOTH {
            return;
        }
        let width = (to.value - from.value).abs();
        let corner = Kink { between: [from.value, to.value], is_gap: false, error: width, step: self.width };
        if width <= SMALLEST * self.width {
            self.found.extend((share > 1.0).then_some(corner));
            return;
        }
        if self.left == 0 {
            return;
        }
        self.left -= 1;
        let within = [LARGER, 1.0 - LARGER].map(|part| from.value + part * (to.value - from.value));
        match within.iter().find_map(|value| self.search.place(*value)) {
            Some(place) => {
                self.divide(from, &place);
                self.divide(&place, to);
            }
            // Next to a change point there are no rates.
            None if width <= NEXT * self.width => self.found.extend((share > 1.0).then_some(corner)),
            None => {
                let between = [self.end(from.value, within[1]), self.end(to.value, within[0])];
                self.found.push(Kink { between, is_gap: true, error: SMALLEST * self.width, step: self.width });
            }
        }
    }

    /// The end of the motion between a value that has a position and one that has none.
    fn end(&self, mut inside: f64, mut outside: f64) -> f64 {
        while (outside - inside).abs() > SMALLEST * self.width {
            let middle = f64::midpoint(inside, outside);
            *if self.search.place(middle).is_some() { &mut inside } else { &mut outside } = middle;
        }
        inside
    }
}
