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

/// Values that differ by no more than this many times what rounding errors change in them are the same.
pub(super) const SAME: f64 = 16.0;

/// The strokes of a course, in the order of the input; of a closed motion the last one ends where the first begins. A
/// quantity that moves in one direction all the time has none in a closed motion.
pub(super) fn strokes(course: &Course, is_closed: bool) -> Vec<Stroke> {
    let [first, last] = course.ends;
    let length = last.input - first.input;
    if course.is_constant {
        return Vec::new();
    }
    let begin = (!is_closed).then_some(first);
    let end = (!is_closed).then_some(last);
    let mut places: Vec<Extreme> = begin.into_iter().chain(course.turning_points.iter().copied()).chain(end).collect();
    // Where it hardly moves, as at an extreme of higher order, a rounding error may turn it twice.
    let is_same = |one: &Extreme, other: &Extreme| {
        let resolution = course.resolution_at(one.input) + course.resolution_at(other.input);
        (one.value - other.value).abs() <= SAME * resolution
    };
    while let Some(at) = places.windows(2).position(|pair| is_same(&pair[0], &pair[1])) {
        match (is_closed, at == 0, at + 2 == places.len()) {
            // There is one stroke at least.
            (false, true, true) => break,
            (false, true, false) => _ = places.remove(1),
            (false, false, true) => _ = places.remove(at),
            _ => _ = places.drain(at..at + 2),
        }
    }
    if is_closed {
        // An angle that turns is farther by its turns at the end.
        let again =
            |begin: Extreme| Extreme { input: begin.input + length, value: begin.value + (last.value - first.value) };
        let turned = |place: &Extreme| Extreme { value: again(*place).value, ..*place };
        if let [first, .., last] = places.as_slice()
            && is_same(last, &turned(first))
        {
            places.pop();
            places.remove(0);
        }
        let Some(&begin) = places.first() else { return Vec::new() };
        places.push(again(begin));
    }
    let strokes = places.windows(2).map(|pair| {
        // From the end of a rest to the begin of the next.
        let [[_, from], [to, _]] = [pair[0], pair[1]].map(|place| rest(course, is_closed, place));
        Stroke { from, to, share: (to.input - from.input) / length }
    });
    strokes.filter(|stroke| stroke.share > 0.0).collect()
}

/// The begin and the end of the rest at a place; twice the place where there is none.
fn rest(course: &Course, is_closed: bool, place: Extreme) -> [Extreme; 2] {
    let [first, last] = course.ends;
    let later = |at: Extreme, turns: f64| Extreme {
        input: at.input + turns * (last.input - first.input),
        value: at.value + turns * (last.value - first.value),
    };
    let mut rests = course.rests.clone();
    // The two parts of a rest about the input at which a closed motion begins.
    if let [[begin, to], .., [from, end]] = rests[..]
        && is_closed
        && begin.input == first.input
        && end.input == last.input
    {
        rests.remove(0);
        rests.pop();
        rests.push([from, later(to, 1.0)]);
    }
    let cycles: &[f64] = if is_closed { &[0.0, -1.0, 1.0] } else { &[0.0] };
    let all = cycles.iter().flat_map(|turns| rests.iter().map(|rest| rest.map(|end| later(end, *turns))));
    let mut around = all.filter(|[from, to]| from.input <= place.input && place.input <= to.input);
    around.next().unwrap_or([place; 2])
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
