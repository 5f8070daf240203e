//! The parts of a motion in which a quantity rests, as a follower on a round part of its cam.
//!
//! Its values are equal there up to rounding errors. Its derivative is zero, or as small as these errors make it, with any sign.
//! If it goes back after a rest, it turns where the rest begins.

use std::vec::Vec;

use super::at_input::Search;
use super::piece::next_to;
use super::{Course, Extreme};
use crate::kinematic::MotionOf;
use crate::range_of_motion::{Driven, RangeOfMotion};
use crate::scalar::arithmetic::*;
use crate::{OutputMotion, PathErrorOf, Real, real};

/// The factor for rounding errors: two values are equal if they differ by no more than this many times their resolution. A place
/// belongs to a rest if its derivative is no more than this many times the largest one at the samples of the rest.
const SAME: f64 = 16.0;

/// The most steps of a bisection: a double has no more places between two samples.
const STEPS: u32 = 64;

/// The first and the last of the samples of each rest: two at least, with the same value, and with derivatives that do not change
/// it from one to the next. Those on both sides of an extreme may have the same value too.
pub(super) fn runs<T: Real>(samples: &[(T, OutputMotion<T>)], resolution: T) -> Vec<[usize; 2]> {
    let mut runs = Vec::new();
    let mut first = 0;
    while let Some((_, of_first)) = samples.get(first) {
        let rests = |pair: &&[(T, OutputMotion<T>)]| {
            let [(from, one), (to, other)] = [pair[0], pair[1]];
            let changes = [other.value - of_first.value, one.rate * (to - from), other.rate * (to - from)];
            changes.into_iter().all(|change| change.abs() <= resolution * real(SAME))
        };
        let last = first + samples[first..].windows(2).take_while(rests).count();
        runs.extend((last > first).then_some([first, last]));
        first = last + 1;
    }
    runs
}

/// Adds the rests of a quantity to its course, and the turning points that they are.
pub(super) fn add<M, F, Q>(
    range: &RangeOfMotion<'_, M>,
    search: &mut Search<'_, '_, M, F>,
    place: usize,
    course: &mut Course<M::Scalar>,
) -> Result<(), PathErrorOf<M>>
where
    M: Driven,
    F: FnMut(&MotionOf<M::Of>) -> Q,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    let runs = runs(&course.samples, course.resolution.0);
    let end = course.samples.len().saturating_sub(1);
    // A rest about the input at which a closed motion begins.
    let goes_on = range.is_closed() && runs.iter().any(|run| run[0] == 0) && runs.iter().any(|run| run[1] == end);
    for &[first, last] in &runs {
        let samples = &course.samples;
        let slow =
            samples[first..=last].iter().fold(M::Scalar::zero(), |slow, (_, motion)| slow.max(motion.rate.abs()));
        let slow = slow * real(SAME);
        let from = match first.checked_sub(1) {
            Some(moving) => edge(search, place, [samples[moving].0, samples[first].0], slow)?,
            None => course.ends[0].input,
        };
        let to = match samples.get(last + 1) {
            Some(&(moving, _)) => edge(search, place, [moving, samples[last].0], slow)?,
            None => course.ends[1].input,
        };
        let rest = [(from, first), (to, last)].map(|(input, at)| Extreme { input, value: samples[at].1.value });
        let [least, most] = [next_to(range, from)[0], next_to(range, to)[1]];
        let turns = course.turns_within([first, last], [least, most], &runs, range.is_closed());
        course.turning_points.retain(|at| at.input < least || at.input > most);
        // It turns where the first part of a rest begins.
        course.turning_points.extend((turns && !(goes_on && first == 0)).then_some(rest[0]));
        course.rests.push(rest);
    }
    Ok(())
}

/// The place at which a rest begins or ends, between an input at which the quantity moves and one at which it rests: there no
/// derivative is larger than `slow`.
fn edge<M, F, Q>(
    search: &mut Search<'_, '_, M, F>,
    place: usize,
    [mut moving, mut resting]: [M::Scalar; 2],
    slow: M::Scalar,
) -> Result<M::Scalar, PathErrorOf<M>>
where
    M: Driven,
    F: FnMut(&MotionOf<M::Of>) -> Q,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    for _ in 0..STEPS {
        let middle = (moving + resting) * real(0.5);
        if middle == moving || middle == resting {
            break;
        }
        *(if search.by_input(middle)?[place].rate.abs() <= slow { &mut resting } else { &mut moving }) = middle;
    }
    Ok(resting)
}

impl<T: Real> Course<T> {
    /// True if the quantity turns at a rest from one sample to another, between two inputs.
    fn turns_within(
        &self,
        [first, last]: [usize; 2],
        [least, most]: [T; 2],
        runs: &[[usize; 2]],
        is_closed: bool,
    ) -> bool {
        let count = self.samples.len();
        let rests = |at: &usize| runs.iter().any(|[first, last]| first <= at && at <= last);
        let mut before = (0..first).rev().chain((last + 1..count).rev().filter(|_| is_closed));
        let mut after = (last + 1..count).chain((0..first).filter(|_| is_closed));
        let Some((before, after)) = before.find(|at| !rests(at)).zip(after.find(|at| !rests(at))) else { return false };
        let [before, after] = [before, after].map(|at| self.samples[at]);
        // It may turn between the rest and the samples next to it.
        let is_between = |at: T| (before.0 < at && at < least) || (most < at && at < after.0);
        let others = self.turning_points.iter().filter(|at| is_between(at.input)).count();
        (before.1.rate * after.1.rate < T::zero()) != (others % 2 == 1)
    }
}
