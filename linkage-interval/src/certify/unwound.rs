//! Quantities that go on where their formula jumps.
//!
//! A motion is divided so that a quantity moves by less than half a jump in each part, by the bounds of its derivative, which does
//! not jump. Then of all values that differ by jumps only one lies in the part.

use linkage_runtime::Certifiable;

use super::jet::Measure;
use super::on_turns::Jump;
use super::system::{Dimensions, System};
use super::tube::Tube;
use crate::Interval;
use crate::series::Series;

/// The most parts of a motion.
const MOST_PARTS: usize = 3000;

/// A part of a tube.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    /// The number of the tube.
    pub(super) tube: usize,
    /// Its values of the parameter.
    pub(super) c: Interval,
    /// All values of the quantity are known to be in it.
    pub(super) within: Interval,
}

impl Segment {
    /// A part of it.
    pub(super) fn over(self, c: Interval) -> Self {
        Self { c, ..self }
    }
}

/// The tubes, of whose values nothing is known.
pub(super) fn whole(tubes: &[Tube]) -> Vec<Segment> {
    let of = |(tube, of): (usize, &Tube)| Segment { tube, c: of.range, within: Interval::ENTIRE };
    tubes.iter().enumerate().map(of).collect()
}

/// A quantity without its jumps, and the parts of a motion with bounds of it that are narrower than half a jump. Of a quantity
/// that does not jump, the tubes as they are. `None` if there is no such quantity, or if it is not known how it goes on.
pub(super) fn unwound<M: Certifiable>(
    system: &System<M>,
    tubes: &[Tube],
    place: usize,
) -> Option<(Measure, Vec<Segment>)> {
    let first = tubes.first()?;
    let start = Interval::from(first.start());
    let q = first.part(system, Dimensions::Nominal, start)?.q.into_iter().map(Series::constant);
    let quantity = *system.quantities(Dimensions::Nominal, &q.collect::<Vec<_>>()).get(place)?;
    let Jump::By(jump) = quantity.jump()? else { return Some((Measure::Quantity(place), whole(tubes))) };
    let measure = Measure::OnTurns { place, jump };
    let value = measure.over(system, first, Dimensions::All, start)?.series.value;
    let value = measure.turned(value, quantity.own.value).unwrap_or(value);
    let mut followed = Followed { system, measure, half: 0.5 * jump.least(), parts: Vec::new(), tests: 0 };
    let (mut entry, mut value) = (start, value);
    for (number, tube) in tubes.iter().enumerate() {
        value = followed.through(number, tube, entry, value)?;
        if let Some(next) = tubes.get(number + 1) {
            let joint = tube.part(system, Dimensions::All, tube.joint)?.q;
            entry = joint.get(next.expansion.parameter)?.intersection(next.range)?;
        }
    }
    Some((measure, followed.parts))
}

struct Followed<'a, M: Certifiable> {
    system: &'a System<M>,
    measure: Measure,
    /// Half of the jump.
    half: f64,
    parts: Vec<Segment>,
    tests: usize,
}

impl<M: Certifiable> Followed<'_, M> {
    /// Follows the quantity through a tube, from its value where the motion enters to that at the joint.
    fn through(&mut self, number: usize, tube: &Tube, entry: Interval, value: Interval) -> Option<Interval> {
        let (mut from, mut value) = (entry, value);
        let mut open = vec![entry.hull(tube.joint)];
        while let Some(c) = open.pop() {
            self.tests += 1;
            if self.tests > MOST_PARTS {
                return None;
            }
            let end = if tube.is_backward { c.least() } else { c.most() };
            if let Some((within, at_end)) = self.step(tube, from, value, c, end) {
                self.parts.push(Segment { tube: number, c, within });
                (from, value) = (end.into(), at_end);
                continue;
            }
            let middle = c.middle();
            let [low, high] = [Interval::new(c.least(), middle)?, Interval::new(middle, c.most())?];
            let [near, far] = if tube.is_backward { [high, low] } else { [low, high] };
            if near == c || far == c || !from.is_within(near) {
                return None;
            }
            open.extend([far, near]);
        }
        Some(value)
    }

    /// The values over a part by the mean-value theorem, if they are narrower than half a jump, and those at its end.
    fn step(
        &self,
        tube: &Tube,
        from: Interval,
        value: Interval,
        c: Interval,
        end: f64,
    ) -> Option<(Interval, Interval)> {
        let slope = self.measure.over(self.system, tube, Dimensions::All, c)?.series.first;
        let within = value + slope * (c - from);
        if within.width() > self.half {
            return None;
        }
        let [_, at_end] = self.measure.in_middle(self.system, tube, end, within)?;
        Some((within, at_end.value.intersection(within)?))
    }
}
