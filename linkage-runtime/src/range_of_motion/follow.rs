//! The motion from its start to both ends.

use core::cmp::Ordering;
use std::vec::Vec;

use super::driven::{Driven, same_inputs};
use super::options::within_parameter_range;
use super::{MotionEnd, RangeOptions};
use crate::continuation::{AtChangePoint, Direction, Event, Groups, Path};
use crate::jacobian::Blocks;
use crate::jacobian::ulp::nearly_zero;
use crate::same_position::{SamePosition, has_counted};
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::{BorrowedName, Mechanism, PathError, PathErrorOf, real};

/// A position at which a step ended.
pub(super) struct Step<M: Mechanism> {
    pub(super) position: M::Coordinates,
    /// The derivatives of the coordinates by arc length.
    pub(super) rates: M::Rates,
    /// The arc length from the start, negative before it.
    pub(super) length: M::Scalar,
    pub(super) passed: Option<Passed<M::Name>>,
    /// The smallest pivot of [J A] divided by the largest.
    pub(super) regularity: M::Scalar,
}

/// A singular position on the way.
#[derive(Clone, Copy)]
pub(super) enum Passed<N: BorrowedName> {
    DeadPoint(N),
    ChangePoint(Groups<N>),
}

/// The end of a motion of a mechanism.
type EndOf<M> = MotionEnd<<M as Mechanism>::Name>;

/// The steps of a motion, and its end or ends.
type Travelled<M, E> = (Vec<Step<M>>, E);

/// A motion that was followed.
pub(super) struct Followed<M: Driven> {
    /// With the range of the parameter.
    pub(super) options: RangeOptions<M::Scalar>,
    pub(super) same: SamePosition<M>,
    /// In the order of travel.
    pub(super) steps: Vec<Step<M>>,
    pub(super) ends: [MotionEnd<M::Name>; 2],
}

/// The policy of a motion at a dead point.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum AtDeadPoint {
    End,
    GoOn,
}

/// A motion that is followed from a position.
struct Follower<'a, M: Mechanism> {
    mechanism: &'a M,
    same: &'a SamePosition<M>,
    options: &'a RangeOptions<M::Scalar>,
    at_dead_point: AtDeadPoint,
}

/// Follows the motion through a position to both ends, within the range of the parameter.
pub(super) fn followed<M: Driven>(
    mechanism: &M,
    start: &M::Coordinates,
    options: RangeOptions<M::Scalar>,
    at_dead_point: AtDeadPoint,
) -> Result<Followed<M>, PathErrorOf<M>> {
    let options = within_parameter_range(mechanism, options)?;
    let same = SamePosition::at(mechanism, start);
    let follower = Follower { mechanism, same: &same, options: &options, at_dead_point };
    let (steps, ends) = follower.both_ways(start)?;
    Ok(Followed { options, same, steps, ends })
}

impl<M: Driven> Followed<M> {
    /// The least and the largest input of a motion that ends at dead points.
    pub(super) fn inputs(&self) -> [M::Scalar; 2] {
        [self.steps.first(), self.steps.last()].map(|step| step.map_or_else(M::Scalar::zero, Step::input))
    }
}

impl<M: Driven> Follower<'_, M> {
    /// Follows the motion both ways; first that in which the parameter increases.
    fn both_ways(&self, start: &M::Coordinates) -> Result<Travelled<M, [EndOf<M>; 2]>, PathErrorOf<M>> {
        let (mut steps, upper) = self.one_way(start, Direction::Increasing)?;
        if matches!(upper, MotionEnd::Closed { .. }) {
            return Ok((steps, [upper; 2]));
        }
        let (other_side, lower) = self.one_way(start, Direction::Decreasing)?;
        // The start is in both.
        steps.splice(..1, other_side.into_iter().rev().map(Step::turned_back));
        Ok((steps, [lower, upper]))
    }

    /// The steps from a position in a direction, until the motion closes or ends.
    fn one_way(
        &self,
        start: &M::Coordinates,
        direction: Direction<M::Rates>,
    ) -> Result<Travelled<M, EndOf<M>>, PathErrorOf<M>> {
        let Self { mechanism, same, options, at_dead_point } = *self;
        let mut path = Path::with(mechanism, start, direction, options.path)?;
        let goes_on = at_dead_point == AtDeadPoint::GoOn;
        let start = path.position();
        let at = |q: &M::Coordinates| M::inputs(q)[0];
        let may_close = goes_on || self.mechanism.input_angles()[0] && options.path.range.is_none();
        let most = M::Scalar::two_pi() * real(f64::from(options.most_turns));
        let (rates, regularity) = (path.rates(), path.regularity());
        let mut steps =
            Vec::from([Step { position: start, rates, length: M::Scalar::zero(), passed: None, regularity }]);
        for _ in 0..options.path.most_steps {
            let step = match may_close {
                true => path.advance_watching(|q, _| same.side(at(q), at(&start)))?,
                false => path.advance()?,
            };
            let (position, rates, length) = (step.position, step.rates, step.length);
            let passed = match step.event {
                Some(Event::DeadPoint { group }) => Some(Passed::DeadPoint(group)),
                Some(Event::ChangePoint { groups, .. }) => Some(Passed::ChangePoint(groups)),
                Some(Event::Limit | Event::JointRange { .. } | Event::Zero) | None => None,
            };
            // At an end of its range the path takes a step of no length.
            if steps.last().is_none_or(|last| last.position != position) {
                steps.push(Step { position, rates, length, passed, regularity: path.regularity() });
            }
            let is_at_start = || {
                same.are_equal(mechanism, &position, &start)
                    && same_inputs(mechanism, &position, &start)
                    && !has_counted(mechanism, &position, &start)
            };
            let [heading, first] = [&rates, &steps[0].rates].map(|rates| M::rate_parts(rates).1[0]);
            let heading = same.input_in_units(heading * first.signum());
            let reverses = || heading <= M::Scalar::zero();
            let has_reversed = || heading < -nearly_zero::<M::Scalar>();
            let stops = options.path.at_change_point == AtChangePoint::Stop;
            let end = match step.event {
                Some(Event::Zero) if is_at_start() => {
                    let turns = to_f64(((at(&position) - at(&start)) / M::Scalar::two_pi()).round());
                    // At most `most_turns`.
                    MotionEnd::Closed { turns: if self.mechanism.input_angles()[0] { turns.abs() as u32 } else { 0 } }
                }
                Some(Event::DeadPoint { group }) if !goes_on => MotionEnd::DeadPoint { group },
                Some(Event::ChangePoint { groups, .. }) if stops || !goes_on && reverses() => {
                    MotionEnd::ChangePoint { groups }
                }
                Some(Event::Limit) => MotionEnd::Range,
                Some(Event::JointRange { of, end }) => MotionEnd::JointRange { of, end },
                // At links that differ by few ulps of the others the sign of a determinant is not resolved.
                _ if !goes_on && has_reversed() => {
                    let (_, group) = Blocks::of(mechanism, &mechanism.pose_at(&position)).least_regular();
                    let farthest = (0..steps.len()).rev().max_by(|&one, &other| {
                        let [one, other] = [one, other].map(|place| (at(&steps[place].position) - at(&start)).abs());
                        one.partial_cmp(&other).unwrap_or(Ordering::Equal)
                    });
                    steps.truncate(farthest.unwrap_or_default() + 1);
                    MotionEnd::DeadPoint { group }
                }
                _ if same.way(&position, &start) > most => MotionEnd::Open,
                _ => continue,
            };
            return Ok((steps, end));
        }
        Err(PathError::TooManySteps { mechanism: self.mechanism.name(), steps: options.path.most_steps })
    }
}

impl<M: Driven> Step<M> {
    pub(super) fn input(&self) -> M::Scalar {
        M::inputs(&self.position)[0]
    }

    /// The step of the motion in the other direction.
    fn turned_back(self) -> Self {
        Self { rates: backwards::<M>(&self.rates), length: -self.length, ..self }
    }
}

/// The rates in the other direction.
pub(super) fn backwards<M: Mechanism>(rates: &M::Rates) -> M::Rates {
    let (unknowns, inputs) = M::rate_parts(rates);
    M::rates(-unknowns, -inputs)
}
