//! Strokes of a quantity, and the time ratio of working and return stroke.

use linkage_runtime::extremes::{Course, Extreme};

/// A part of a motion in which a quantity moves in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stroke {
    /// Its begin: the input and the value.
    pub from: Extreme,
    /// Its end. In a closed motion the input may be beyond the end of the cycle.
    pub to: Extreme,
    /// Its share of the motion, by the input: at a constant input rate, of the time.
    pub share: f64,
}

/// Strokes shorter than this are rounding errors, divided by the distance between the extremes.
const NOISE: f64 = 1e-12;

/// The strokes of a course, in the order of the input; of a closed motion the last one ends where the first begins. A
/// quantity that moves in one direction all the time has none in a closed motion.
pub(super) fn strokes(course: &Course, is_closed: bool) -> Vec<Stroke> {
    let [first, last] = course.ends;
    let length = last.input - first.input;
    if course.is_constant {
        return Vec::new();
    }
    let travel = course.extremes.largest.value - course.extremes.least.value;
    let mut places = course.turning_points.clone();
    // Where it hardly moves, a rounding error may turn it twice.
    while let Some(at) = places.windows(2).position(|pair| (pair[1].value - pair[0].value).abs() <= NOISE * travel) {
        places.drain(at..at + 2);
    }
    if is_closed {
        let Some(&begin) = places.first() else { return Vec::new() };
        places.push(Extreme { input: begin.input + length, value: begin.value });
    } else {
        places.insert(0, first);
        places.push(last);
    }
    let strokes = places.windows(2).map(|pair| {
        let [from, to] = [pair[0], pair[1]];
        Stroke { from, to, share: (to.input - from.input) / length }
    });
    strokes.filter(|stroke| stroke.share > 0.0).collect()
}

/// The duration of the longer stroke divided by that of the shorter one, of a quantity that moves forth and back once in a
/// closed motion: of a crank-rocker (180 deg + alpha) / (180 deg - alpha), where alpha is the angle between the coupler
/// at both ends of the swing (VDI 2130).
pub(super) fn time_ratio(strokes: &[Stroke], is_closed: bool) -> Option<f64> {
    match strokes {
        [one, other] if is_closed => Some(one.share.max(other.share) / one.share.min(other.share)),
        _ => None,
    }
}
