//! Smallest and largest values over a whole motion, by branch and bound.
//!
//! The box with the largest upper bound is divided first, and the search ends when that bound is as near to the values
//! found at points as asked for. Bounds are mean-value forms; where the derivative is not zero, the largest value is at
//! an end; where the second derivative is not zero, Newton's method with intervals encloses the one stationary point.
//! Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, "Introduction to Interval Analysis", 2009, chapters 6 and 11.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::fmt;

use linkage_runtime::{Build, Certifiable, Column, Dim};

use super::certificate::Certificate;
use super::jet::{Jet, Measure};
use super::system::System;
use super::tube::Tube;
use super::unwound::{Segment, unwound, whole};
use crate::Interval;

/// The width of the result relative to the largest magnitude of the quantity over the motion.
const RELATIVE_WIDTH: f64 = 1e-9;

/// With tolerances the result has the width of their effect; the search may add this part of it.
const OF_TOLERANCES: f64 = 0.01;

/// The most boxes of one search. Smooth quantities take about a hundred.
const MOST_BOXES: usize = 3000;

/// The smallest and the largest value of a quantity over a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Enclosure {
    /// It contains the smallest value; with tolerances, that of each mechanism.
    pub least: Interval,
    /// It contains the largest value; with tolerances, that of each mechanism.
    pub largest: Interval,
    /// True if both are as narrow as asked for: 1e-9 of the largest magnitude of the quantity over the motion, beyond
    /// the effect of the tolerances. If not, they are enclosures all the same, as narrow as the bounded work made them; also
    /// next to a jump, as of an angle by `atan2` at pi, whose values on both sides they contain. Such an angle goes on by
    /// [`Certificate::quantity_on_turns`].
    pub is_sharp: bool,
    /// The number of boxes and points at which the quantity was evaluated.
    pub evaluations: usize,
}

/// Both enclosures in one line.
impl fmt::Display for Enclosure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { least, largest, is_sharp, .. } = self;
        write!(f, "least in {least}, largest in {largest}{}", if *is_sharp { "" } else { ", not sharp" })
    }
}

impl Enclosure {
    /// All values between the smallest and the largest.
    #[must_use]
    pub fn values(&self) -> Interval {
        self.least.hull(self.largest)
    }
}

/// A part of a tube with an upper bound of the values in it, and the jet if it has bounds.
struct Open {
    bound: f64,
    part: Segment,
    jet: Option<Jet>,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Open {}
impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound).then(other.part.tube.cmp(&self.part.tube))
    }
}

/// The search for the largest value of a measure or of its negative.
struct Search<'a, M: Certifiable> {
    system: &'a System<M>,
    tubes: &'a [Tube],
    measure: Measure,
    /// True for the smallest value: the largest of the negative.
    is_least: bool,
    open: BinaryHeap<Open>,
    /// The largest lower and upper bound of the values at points.
    attained: Option<Interval>,
    magnitude: f64,
    evaluations: usize,
}

impl<M: Certifiable> Search<'_, M> {
    /// The jet over a part of a tube; the value in its middle counts as found.
    fn evaluate(&mut self, Segment { tube, c, within }: Segment) -> Option<Jet> {
        self.evaluations += 1;
        let jet = self.measure.jet(self.system, self.tubes.get(tube)?, c, within)?;
        let signed = |x: Interval| if self.is_least { -x } else { x };
        let Jet { value, first, second, middle, slope } = jet;
        let [value, first, second, middle, slope] = [value, first, second, middle, slope].map(signed);
        self.magnitude = self.magnitude.max(middle.magnitude());
        self.attained = Some(self.attained.map_or(middle, |known| {
            let (least, most) = (known.least().max(middle.least()), known.most().max(middle.most()));
            Interval::new(least, most).unwrap_or(known)
        }));
        Some(Jet { value, first, second, middle, slope })
    }

    fn push(&mut self, part: Segment) {
        let jet = self.evaluate(part);
        let most = if self.is_least { -part.within.least() } else { part.within.most() };
        let bound = jet.map_or(most, |jet| jet.value.most());
        // Not over a pole, where a function may rise everywhere and jump.
        let is_monotone = |jet: &Jet| !jet.first.contains(0.0) && jet.value.magnitude().is_finite();
        if let Some(jet) = jet.filter(is_monotone) {
            // Monotone: the largest value is at an end.
            let end = if jet.first.least() > 0.0 { part.c.most() } else { part.c.least() };
            if !self.is_worth(bound) || self.evaluate(part.over(end.into())).is_some() {
                return;
            }
        }
        self.open.push(Open { bound, part, jet });
    }

    /// True if a bound is larger than all values found.
    fn is_worth(&self, bound: f64) -> bool {
        self.attained.is_none_or(|attained| bound > attained.most())
    }

    fn accuracy(&self) -> f64 {
        let spread = self.attained.map_or(0.0, Interval::width);
        RELATIVE_WIDTH * self.magnitude + OF_TOLERANCES * spread
    }

    /// Divides a part of a tube in the middle, or reduces it to its stationary point and its ends; false if it is too
    /// narrow.
    fn divide(&mut self, &Open { part, jet, .. }: &Open) -> bool {
        let Segment { tube, c, .. } = part;
        let middle = c.middle();
        if let Some(jet) = jet.filter(|jet| !jet.second.contains(0.0)) {
            // Newton's method: f' = 0 in m - f'(m) / f''(C) only.
            let narrow = c.intersection(Interval::from(middle) - jet.slope / jet.second);
            if narrow.is_none_or(|narrow| narrow.width() < 0.5 * c.width())
                && [c.least(), c.most()].into_iter().all(|end| self.evaluate(part.over(end.into())).is_some())
            {
                narrow.into_iter().for_each(|narrow| self.push(part.over(narrow)));
                return true;
            }
        }
        // A narrower interval gives no better bounds: positions are known to a few ulp only.
        let parameter = self.tubes.get(tube).map_or(0, |tube| tube.expansion.parameter);
        let rounding = f64::EPSILON * self.system.scales.get(parameter).copied().unwrap_or(1.0);
        if middle <= c.least() || middle >= c.most() || c.width() <= rounding {
            return false;
        }
        let halves = [Interval::new(c.least(), middle), Interval::new(middle, c.most())];
        halves.into_iter().flatten().for_each(|half| self.push(part.over(half)));
        true
    }

    /// Runs the search: an interval that contains the largest value, and whether it is as narrow as asked for.
    fn run(mut self, parts: &[Segment]) -> (Interval, bool, usize, f64) {
        parts.iter().for_each(|part| self.push(*part));
        let (mut bound, mut is_known) = (f64::NEG_INFINITY, true);
        while let Some(next) = self.open.pop() {
            let most = self.attained.map_or(f64::NEG_INFINITY, Interval::most);
            if next.bound <= most + self.accuracy() || self.evaluations >= MOST_BOXES || !self.divide(&next) {
                bound = next.bound;
                is_known = next.jet.is_some_and(|jet| jet.first.magnitude().is_finite());
                break;
            }
        }
        let attained = self.attained.unwrap_or(Interval::ENTIRE);
        let largest = Interval::new(attained.least(), attained.most().max(bound)).unwrap_or(Interval::ENTIRE);
        let is_sharp = is_known
            && largest.width() <= (1.0 + OF_TOLERANCES) * attained.width() + 2.0 * RELATIVE_WIDTH * self.magnitude;
        (largest, is_sharp, self.evaluations, self.magnitude)
    }
}

/// The extremes of a measure over tubes.
pub(super) fn enclosure<M: Certifiable>(system: &System<M>, tubes: &[Tube], measure: Measure) -> Enclosure {
    of_parts(system, tubes, measure, &whole(tubes))
}

/// The extremes of a quantity that goes on where its formula jumps; `None` if it cannot be followed.
pub(super) fn enclosure_on_turns<M: Certifiable>(
    system: &System<M>,
    tubes: &[Tube],
    place: usize,
) -> Option<Enclosure> {
    let (measure, parts) = unwound(system, tubes, place)?;
    Some(of_parts(system, tubes, measure, &parts))
}

fn of_parts<M: Certifiable>(system: &System<M>, tubes: &[Tube], measure: Measure, parts: &[Segment]) -> Enclosure {
    let [least, largest] = [true, false].map(|is_least| {
        let (open, attained) = (BinaryHeap::new(), None);
        Search { system, tubes, measure, is_least, open, attained, magnitude: 0.0, evaluations: 0 }.run(parts)
    });
    Enclosure { least: -least.0, largest: largest.0, is_sharp: least.1 && largest.1, evaluations: least.2 + largest.2 }
}

impl<M: Certifiable> Certificate<M> {
    /// Encloses the smallest and the largest value of each coordinate of a point and each output over the motion.
    #[must_use]
    pub fn quantities(&self) -> Column<Enclosure, <M as Certifiable>::Q> {
        self.system
            .mechanism
            .quantity_count()
            .column(|place| enclosure(&self.system, &self.tubes, Measure::Quantity(place)))
    }

    /// Encloses the smallest and the largest value of one quantity, by its index; `None` if there is none of this index.
    #[must_use]
    pub fn quantity(&self, index: usize) -> Option<Enclosure> {
        let measure = Measure::Quantity(index);
        (index < self.system.mechanism.quantity_count().count()).then(|| enclosure(&self.system, &self.tubes, measure))
    }

    /// Encloses the smallest and the largest value of one quantity that goes on where its formula jumps, as an angle by `atan2`
    /// does at pi: one that turns counts its turns. It begins with the value of the formula at the start, for the parameters
    /// in the middle of their tolerances; on a jump, with that on one of both sides. Sums of such angles times numbers go on
    /// too; a quantity that does not jump is [`quantity`](Self::quantity).
    ///
    /// `None` if there is no quantity of this index, and if it is not proved how it goes on: if it is the direction of a point
    /// that comes to the origin or, for bounded work, too near, and if it is another function of an angle that jumps.
    #[must_use]
    pub fn quantity_on_turns(&self, index: usize) -> Option<Enclosure> {
        enclosure_on_turns(&self.system, &self.tubes, index)
    }

    /// Encloses the smallest and the largest derivative of each unknown by the input over the motion: the velocity
    /// ratios W.
    #[must_use]
    pub fn velocity_ratios(&self) -> Column<Enclosure, M::U> {
        self.system.mechanism.dims().0.column(|place| enclosure(&self.system, &self.tubes, Measure::Rate(place)))
    }

    /// Encloses the smallest and the largest derivative of each quantity by the input over the motion. An angle by `atan2` has one
    /// at pi too, where only its value jumps.
    #[must_use]
    pub fn quantity_ratios(&self) -> Column<Enclosure, <M as Certifiable>::Q> {
        self.system
            .mechanism
            .quantity_count()
            .column(|place| enclosure(&self.system, &self.tubes, Measure::QuantityRate(place)))
    }
}
