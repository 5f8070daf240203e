//! Motions as curves in all coordinates, through dead points of the input.
//!
//! The parameter of each tube is the coordinate that changes most, relative to its scale. At a dead point of the input it
//! is another coordinate, and the dead point a position like any other (W. C. Rheinboldt, J. V. Burkardt, "A locally
//! parameterized continuation process", 1983).

use std::fmt;

use linkage_runtime::{Build, Certifiable, Column, Dim};

use super::Certify;
use super::certificate::Moved;
use super::dead_point::{DeadPoint, dead_points};
use super::error::{CertifyError, CertifyErrorOf};
use super::extremes::{Enclosure, enclosure, enclosure_on_turns};
use super::jet::Measure;
use super::motion::{Motion, certified_position, unknowns_of};
use super::reason::no_position;
use super::system::{Dimensions, System};
use super::tube::Tube;
use crate::Interval;

/// A tube goes on beyond its end by this part of its length, so that a dead point or the start at a joint is inside one
/// of the two tubes.
const OVERLAP: f64 = 0.02;

/// The most tubes from where the input cannot go on to its dead point: the last step of the input was so short that five
/// were enough in all cases run.
const TUBES_TO_DEAD_POINT: usize = 40;

/// The number of tubes from the last one of the input back to the start of the search for its dead point: it is then
/// about a hundred times as far away.
const TUBES_BACK: usize = 12;

/// A proof that a motion is one smooth curve, through dead points of the input, that is at its start again.
///
/// Along it the rank of [J A] is full: no other motion crosses it. With tolerances this holds for each mechanism whose
/// parameters are within them.
pub struct Curve<M: Certifiable> {
    pub(super) system: System<M>,
    pub(super) tubes: Vec<Tube>,
    dead_points: Vec<DeadPoint<M>>,
    turns: Vec<i64>,
    input_turns: i64,
    tests: usize,
}

/// The statement that is proved, in one line, with angles in degrees: `FourBar: one closed curve, on which theta turns back at
/// 78.58484°, -78.58484°`.
impl<M: Certifiable> fmt::Display for Curve<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { system, dead_points, .. } = self;
        let name = system.input_name();
        write!(f, "{}: one closed curve, on which {name} ", system.mechanism.name())?;
        for (place, point) in dead_points.iter().enumerate() {
            f.write_str(if place == 0 { "turns back at " } else { ", " })?;
            f.write_str(&system.shown_place(point.input))?;
        }
        f.write_str(if dead_points.is_empty() { "never turns back" } else { "" })?;
        f.write_str(system.shown_tolerances())
    }
}

impl<M: Certifiable> Curve<M> {
    /// The dead points of the input in the order of the curve; none if the input turns without limit.
    #[must_use]
    pub fn dead_points(&self) -> &[DeadPoint<M>] {
        &self.dead_points
    }

    /// The full turns of each unknown along the curve.
    #[must_use]
    pub fn turns(&self) -> &[i64] {
        &self.turns
    }

    /// The full turns of the input along the curve.
    #[must_use]
    pub fn input_turns(&self) -> i64 {
        self.input_turns
    }

    /// The number of tubes.
    #[must_use]
    pub fn boxes(&self) -> usize {
        self.tubes.len()
    }

    /// The number of tests for them, those that failed included.
    #[must_use]
    pub fn tests(&self) -> usize {
        self.tests
    }

    /// The tubes in the order of the curve: a box that contains the inputs of each, and one of its unknowns.
    pub fn tubes(&self) -> impl Iterator<Item = (Interval, Column<Interval, M::U>)> + '_ {
        self.tubes.iter().map(|tube| {
            let q = tube.over(tube.range);
            (q.last().copied().unwrap_or(Interval::ENTIRE), unknowns_of(&self.system, &q))
        })
    }

    /// True if a position is on the curve: if the box of the one position near it lies in a tube, up to full turns.
    #[must_use]
    pub fn passes(&self, position: &M::Coordinates) -> bool {
        let guess = self.system.position(position);
        let q = guess.and_then(|guess| certified_position(&self.system, self.system.count(), &guess));
        q.is_some_and(|q| self.tubes.iter().any(|tube| Moved::into_tube(&self.system, tube, &q).is_some()))
    }

    /// The scale of the input.
    pub(super) fn input_scale(&self) -> f64 {
        self.system.scales.last().copied().unwrap_or(1.0)
    }

    /// Encloses the smallest and the largest value of each coordinate of a point and each output over the curve.
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

    /// [`quantity`](Self::quantity) of an angle that goes on where its formula jumps, as
    /// [`Certificate::quantity_on_turns`](super::Certificate::quantity_on_turns) says, once around from the start.
    #[must_use]
    pub fn quantity_on_turns(&self, index: usize) -> Option<Enclosure> {
        enclosure_on_turns(&self.system, &self.tubes, index)
    }
}

/// The direction of a motion: the coordinate that changes most, and the rates.
struct Heading {
    parameter: usize,
    direction: f64,
    rates: Vec<f64>,
}

impl Heading {
    /// The heading at the end of a motion that goes on in the direction of these rates.
    fn of<M: Certifiable>(motion: &Motion<'_, M>, along: &[f64]) -> Option<Self> {
        let scales = &motion.system.scales;
        // The input last: at a dead point it cannot be the parameter.
        let w = (0..scales.len()).rev().find_map(|parameter| motion.expansion(parameter))?.w;
        let relative: Vec<f64> = w.iter().zip(scales).map(|(w, scale)| w / scale).collect();
        let largest = |one: &usize, other: &usize| relative[*one].abs().total_cmp(&relative[*other].abs());
        let parameter = (0..scales.len()).max_by(largest)?;
        let forward: f64 = relative.iter().zip(along).zip(scales).map(|((w, along), scale)| w * along / scale).sum();
        let sign = if forward < 0.0 { -1.0 } else { 1.0 };
        let rates = w.iter().map(|w| sign * w).collect();
        Some(Self { parameter, direction: sign * relative[parameter].signum(), rates })
    }
}

/// Adds a tube in a direction, and returns the rates at its end.
fn advance<M: Certifiable>(motion: &mut Motion<'_, M>, along: &[f64]) -> Result<Vec<f64>, CertifyErrorOf<M>> {
    let heading = Heading::of(motion, along).ok_or_else(|| motion.stopped(&motion.joint))?;
    motion.advance(heading.parameter, heading.direction, None, OVERLAP)?;
    Ok(Heading::of(motion, &heading.rates).ok_or_else(|| motion.stopped(&motion.joint))?.rates)
}

/// True if a tube reaches the start, moved by full turns, behind the joint at which it begins: before it, the start would
/// be that of the motion itself.
fn is_beyond(tube: &Tube, start: &Moved, joint: &[Interval]) -> bool {
    let places = start.q.get(tube.expansion.parameter).zip(joint.get(tube.expansion.parameter));
    places.is_some_and(|(&start, &joint)| start.intersection(joint).is_none())
}

impl<M: Certifiable> Certify<'_, M> {
    /// Certifies the motion through a position as a curve, through all dead points of the input, until it is at its
    /// start again. It begins with a growing input, or at a dead point with the unknown that changes most.
    ///
    /// # Errors
    /// Those of [`CertifyError`] but `DeadPoint`; [`CertifyError::Exhausted`] also for a curve that never closes.
    pub fn curve(&self, start: &M::Coordinates) -> Result<Curve<M>, CertifyErrorOf<M>> {
        let system = self.system(start)?;
        let guess = system.position(start).ok_or_else(|| self.invalid("the start"))?;
        self.check_emitted(&system, &guess)?;
        let at = |parameter| certified_position(&system, parameter, &guess);
        let first = (0..guess.len()).rev().find_map(at).ok_or_else(|| no_position(&system, &guess))?;
        let mut motion = Motion::new(&system, first.clone(), self.most_tests);
        let mut along = vec![0.0; guess.len()];
        if let Some(input) = along.last_mut() {
            *input = 1.0;
        }
        let (turns, input_turns) = loop {
            let before = motion.joint.clone();
            along = advance(&mut motion, &along)?;
            self.check_emitted_at(&motion)?;
            if let [_, .., last] = motion.tubes.as_mut_slice()
                && let Some(moved) = Moved::into_tube(&system, last, &first)
                && is_beyond(last, &moved, &before)
            {
                last.joint = moved.q.get(last.expansion.parameter).copied().unwrap_or(last.range);
                break (moved.turns, moved.input_turns);
            }
        };
        let (tubes, tests) = (motion.tubes, motion.tests);
        let dead_points = dead_points(&system, &tubes)?;
        // A largest and a smallest input take turns: with wide tolerances, one may be in the overlap of two tubes and in none of
        // them for sure.
        let next = dead_points.iter().cycle().skip(1);
        if dead_points.iter().zip(next).any(|(one, next)| one.is_largest == next.is_largest) {
            let input = dead_points.iter().map(|point| point.input).reduce(Interval::hull).unwrap_or(Interval::ENTIRE);
            return Err(CertifyError::Undecided { mechanism: system.mechanism.name(), input });
        }
        Ok(Curve { system, tubes, dead_points, turns, input_turns, tests })
    }
}

/// The error of a motion of which the input cannot go on: a dead point ahead, or tests spent before one is found.
pub(super) fn dead_point_ahead<M: Certifiable>(motion: &Motion<'_, M>, direction: f64) -> Option<CertifyErrorOf<M>> {
    // Where the motion stopped, the sign of the rate of the input is uncertain.
    let before = motion.tubes.iter().rev().nth(TUBES_BACK).or(motion.tubes.first());
    let begin = |tube: &Tube| Some(tube.part(motion.system, Dimensions::All, tube.range.middle().into())?.q);
    let joint = before.and_then(begin).unwrap_or_else(|| motion.joint.clone());
    let mut ahead = Motion::new(motion.system, joint, motion.tests_left());
    let mut along = vec![0.0; motion.joint.len()];
    *along.last_mut()? = direction;
    for _ in 0..TUBES_TO_DEAD_POINT {
        along = match advance(&mut ahead, &along) {
            Ok(along) => along,
            // The motion itself may go on.
            Err(CertifyError::Exhausted { .. }) => return Some(motion.exhausted()),
            Err(_) => return None,
        };
        if let Some(DeadPoint { group, input, is_largest, .. }) = dead_points(motion.system, &ahead.tubes).ok()?.first()
        {
            let is_first = *is_largest == (direction > 0.0);
            return is_first.then_some(CertifyError::DeadPoint {
                mechanism: motion.system.mechanism.name(),
                group: *group,
                limit: *input,
            });
        }
        // Only the last tube is searched again.
        ahead.tubes.clear();
    }
    None
}
