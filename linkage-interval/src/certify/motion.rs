//! Tubes one after another along a motion.

use linkage_runtime::{Build, Certifiable, Column, Number};

use super::error::{CertifyError, CertifyErrorOf};
use super::expansion::Expansion;
use super::reason::reason;
use super::system::{Dimensions, System};
use super::tube::Tube;
use crate::Interval;

/// The first step, relative to the scale of the parameter. A hundred times as long or short costs a few trials.
const FIRST_STEP: f64 = 0.1;

/// The longest step relative to the scale of the parameter: beyond a radian no tube of a turning link was certified.
const LONGEST_STEP: f64 = 1.0;

/// The shortest step relative to the scale of the parameter. At half the distance to a dead point steps are half as
/// long; a few thousand rounding errors before it, the certificate needs more digits than doubles have.
const SHORTEST_STEP: f64 = 1.0 / (1_u64 << 34) as f64;

/// Factors of the step after a certified tube and after a failed test.
const LONGER: f64 = 1.35;
const SHORTER: f64 = 0.6;

/// The floors of the radii of a tube relative to the widths of the box that it must contain.
const OF_WIDTH: f64 = 0.75;

/// Tubes that meet: the box of each joint is inside both of its tubes, and so is its one position.
pub(super) struct Motion<'a, M: Certifiable> {
    pub(super) system: &'a System<M>,
    pub(super) tubes: Vec<Tube>,
    /// The box of the position at the end of the last tube.
    pub(super) joint: Vec<Interval>,
    /// The parameter of the last tube, and its direction.
    heading: Option<(usize, f64)>,
    /// The step relative to the scale of the parameter.
    step: f64,
    /// The number of tests so far, and the most.
    pub(super) tests: usize,
    most_tests: usize,
}

impl<'a, M: Certifiable> Motion<'a, M> {
    /// A motion from a certified box.
    pub(super) fn new(system: &'a System<M>, joint: Vec<Interval>, most_tests: usize) -> Self {
        Self { system, tubes: Vec::new(), joint, heading: None, step: FIRST_STEP, tests: 0, most_tests }
    }

    /// The number of tests that may follow.
    pub(super) fn tests_left(&self) -> usize {
        self.most_tests.saturating_sub(self.tests)
    }

    /// The value of a coordinate at the end of the last tube.
    fn at(&self, coordinate: usize) -> Interval {
        self.joint.get(coordinate).copied().unwrap_or(Interval::ENTIRE)
    }

    /// The input at the end of the last tube.
    pub(super) fn input(&self) -> Interval {
        self.at(self.system.count())
    }

    /// The expansion about the end of the last tube by a coordinate.
    pub(super) fn expansion(&self, parameter: usize) -> Option<Expansion> {
        let middle: Vec<f64> = self.joint.iter().map(|x| x.middle()).collect();
        Expansion::near(self.system, parameter, &middle)
    }

    /// Adds a tube from the joint in this direction (1 or -1) of the parameter, at most up to `end`, with longer or
    /// shorter steps as the test allows. The tube goes on beyond its next joint by `overlap` of its length.
    pub(super) fn advance(
        &mut self,
        parameter: usize,
        direction: f64,
        end: Option<f64>,
        overlap: f64,
    ) -> Result<(), CertifyErrorOf<M>> {
        let expansion = self.expansion(parameter).ok_or_else(|| self.stopped(&self.joint))?;
        let scale = self.system.scales.get(parameter).copied().unwrap_or(1.0);
        let from = self.at(parameter);
        // At the end of a tube by another coordinate the parameter has a width, over which the center moves.
        let width = |(x, rate): (&Interval, &f64)| OF_WIDTH * (x.width() + rate.abs() * from.width());
        let floor: Vec<f64> = self.joint.iter().zip(&expansion.w).map(width).collect();
        loop {
            if self.tests == self.most_tests {
                return Err(self.exhausted());
            }
            self.tests += 1;
            let start = if direction > 0.0 { from.most() } else { from.least() };
            let to = next_joint(start, direction * self.step * scale, end);
            let beyond = to + overlap * (to - start);
            let range = Interval::from(beyond).hull(from);
            let guess = expansion.float_at(range.middle());
            let tube = Tube::certify(self.system, parameter, &guess, range, &floor);
            if let Some(mut tube) = tube.filter(|tube| tube.contains(&self.joint) && self.goes_on(tube, direction))
                && let Some(part) = tube.part(self.system, Dimensions::All, to.into())
            {
                self.joint = part.q;
                tube.is_backward = direction < 0.0;
                tube.joint = to.into();
                self.tubes.push(tube);
                self.heading = Some((parameter, direction));
                self.step = (self.step * LONGER).min(LONGEST_STEP);
                return Ok(());
            }
            self.step *= SHORTER;
            if self.step < SHORTEST_STEP {
                return Err(self.stopped(&expansion.over(range)));
            }
        }
    }

    /// True if a tube leads away from the tubes before: in it the parameter of the last tube goes on in its direction at
    /// the joint. Otherwise the motion would return on itself, and seem to be closed.
    fn goes_on(&self, tube: &Tube, direction: f64) -> bool {
        let parameter = tube.expansion.parameter;
        match self.heading {
            None => true,
            Some((last, before)) if last == parameter => before == direction,
            Some((last, before)) => {
                let part = tube.part(self.system, Dimensions::All, self.at(parameter));
                let rates = part.and_then(|part| part.expansion.rates(self.system, &part.linear));
                let rate = rates.and_then(|rates| rates.get(last).copied());
                rate.is_some_and(|rate| !rate.contains(0.0) && rate.middle().signum() == before * direction)
            }
        }
    }

    /// The error of a motion that has no tests left.
    pub(super) fn exhausted(&self) -> CertifyErrorOf<M> {
        CertifyError::Exhausted {
            mechanism: self.system.mechanism.name(),
            boxes: self.tubes.len(),
            input: self.input().middle(),
        }
    }

    /// The error of a motion that cannot go on from its joint into a box.
    pub(super) fn stopped(&self, within: &[Interval]) -> CertifyErrorOf<M> {
        let middle: Vec<f64> = self.joint.iter().map(|x| x.middle()).collect();
        reason(self.system, &middle, within)
    }
}

/// The end of a step, where the remaining way to `end` is divided into equal steps.
fn next_joint(start: f64, step: f64, end: Option<f64>) -> f64 {
    let Some(end) = end else { return start + step };
    let count = ((end - start) / step).ceil();
    if count > 1.0 { start + (end - start) / count } else { end }
}

/// The box of the one position near a guess at its value of the parameter.
pub(super) fn certified_position<M: Certifiable>(
    system: &System<M>,
    parameter: usize,
    guess: &[f64],
) -> Option<Vec<Interval>> {
    let c = Interval::from(*guess.get(parameter)?);
    let floor = vec![0.0; guess.len()];
    let tube = Tube::certify(system, parameter, guess, c, &floor)?;
    Some(tube.part(system, Dimensions::All, c)?.q)
}

/// The unknowns of a box.
pub(super) fn unknowns_of<M: Certifiable>(system: &System<M>, q: &[Interval]) -> Column<Interval, M::U> {
    system.mechanism.dims().0.column(|place| q.get(place).copied().unwrap_or(Interval::unknown()))
}
