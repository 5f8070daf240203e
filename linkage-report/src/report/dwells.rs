//! Dwells of a quantity: parts of the motion in which it hardly moves.

use std::convert::Infallible;

use linkage_runtime::extremes::Course;
use linkage_runtime::jacobian::root;

use super::options::DwellOptions;

/// A part of the motion in which a quantity hardly moves, as [`DwellOptions`] define it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Dwell {
    /// The input at its begin.
    pub from: f64,
    /// The input at its end. In a closed motion it may be beyond the end of the cycle.
    pub to: f64,
    /// Its share of the motion, by the input: at a constant input rate, of the time.
    pub share: f64,
    /// The least and the largest value in it.
    pub values: [f64; 2],
}

/// The dwells of a course. `rate_at` is the derivative by the input; none where it does not exist, as at a dead point.
pub(super) fn dwells(
    course: &Course,
    is_closed: bool,
    options: DwellOptions,
    rate_at: impl Fn(f64) -> Option<f64>,
) -> Vec<Dwell> {
    let [first, last] = course.ends.map(|end| end.input);
    let length = last - first;
    let travel = course.extremes.largest.value - course.extremes.least.value;
    // The largest derivative.
    let most = options.slowest * travel / length;
    if course.is_constant {
        return Vec::new();
    }
    let speed_left = |rate: f64| most - rate.abs();
    let mut parts: Vec<[f64; 2]> = Vec::new();
    let mut begin = None;
    let mut before: Option<(f64, f64)> = None;
    // It rests where it turns, however short that is; not at a kink.
    let turned: Vec<(f64, f64)> =
        course.turning_points.iter().map(|place| (place.input, rate_at(place.input).unwrap_or(0.0))).collect();
    let mut rates: Vec<(f64, f64)> =
        course.samples.iter().map(|(input, motion)| (*input, motion.rate)).chain(turned).collect();
    rates.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    for (input, rate) in &rates {
        let here = speed_left(*rate);
        let is_slow = here >= 0.0;
        let edge = match before {
            Some((at, left)) if (left >= 0.0) != is_slow => {
                let enough = at.abs().max(input.abs()) * f64::EPSILON;
                // What does not exist is not small.
                let left_at = |at| Ok(Some(rate_at(at).map_or(f64::MIN, speed_left)));
                let Ok(edge) = root::<f64, Infallible>([at, *input], [left, here], enough, left_at);
                edge
            }
            _ => None,
        };
        match (is_slow, begin) {
            // Samples begin next to an end of the motion.
            (true, None) => begin = Some(edge.unwrap_or(first)),
            (false, Some(from)) => {
                parts.push([from, edge.unwrap_or(*input)]);
                begin = None;
            }
            _ => {}
        }
        before = Some((*input, here));
    }
    parts.extend(begin.map(|from| [from, last]));
    if let [[from, to], .., [later, end]] = parts[..]
        && is_closed
        && from == first
        && end == last
    {
        parts.remove(0);
        if let Some(part) = parts.last_mut() {
            *part = [later, to + length];
        }
    }
    let long = parts.into_iter().filter(|[from, to]| to - from >= options.shortest * length);
    long.map(|part| dwell(course, part, length)).collect()
}

fn dwell(course: &Course, [from, to]: [f64; 2], length: f64) -> Dwell {
    let sampled = course.samples.iter().map(|(input, motion)| (*input, motion.value));
    let turned = course.turning_points.iter().chain(&course.ends).map(|place| (place.input, place.value));
    // An angle that turns is farther by its turns a cycle later.
    let [first, last] = course.ends.map(|end| end.value);
    let both = |(input, value): (f64, f64)| [(input, value), (input + length, value + (last - first))];
    let inside = sampled.chain(turned).flat_map(both).filter(|(input, _)| from <= *input && *input <= to);
    let values = inside
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], (_, value)| [least.min(value), most.max(value)]);
    Dwell { from, to, share: (to - from) / length, values }
}
