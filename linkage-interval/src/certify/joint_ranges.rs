//! Declared ranges of coordinates and outputs over a certified motion: kept or left, as a proof.
//!
//! The distance from each end is enclosed over the tubes, which are divided until it has a sign. Angles modulo turns are in
//! the turn that is nearest to the middle of the range at the start, and continuous from there.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use linkage_runtime::{Certifiable, Number, RangeEnd, Ranged};

use super::certificate::Certificate;
use super::curve::Curve;
use super::system::{Dimensions, System};
use super::tube::Tube;
use crate::Interval;

/// The most parts of tubes that are tested for an end.
const MOST_PARTS: usize = 3000;

/// A declared range, and whether a motion keeps it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CertifiedRange<N = &'static str> {
    /// The coordinate or the output.
    pub of: N,
    /// The proof.
    pub proof: RangeProof,
}

/// A proof about a declared range over a whole motion; with tolerances, for each mechanism whose parameters are within them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RangeProof {
    /// The value is in its range at every position.
    Within,
    /// The value is beyond this end at some position.
    Beyond(RangeEnd),
    /// Neither is proved: the value is nearer to an end than rounding errors and tolerances.
    Undecided,
}

impl<M: Certifiable> Certificate<M> {
    /// Says of each declared range whether the motion keeps it.
    #[must_use]
    pub fn joint_ranges(&self) -> Vec<CertifiedRange<M::Name>> {
        all(&self.system, &self.tubes)
    }
}

impl<M: Certifiable> Curve<M> {
    /// Says of each declared range whether the motion keeps it.
    #[must_use]
    pub fn joint_ranges(&self) -> Vec<CertifiedRange<M::Name>> {
        all(&self.system, &self.tubes)
    }
}

fn all<M: Certifiable>(system: &System<M>, tubes: &[Tube]) -> Vec<CertifiedRange<M::Name>> {
    let names = system.mechanism.range_names().enumerate();
    names.map(|(place, of)| CertifiedRange { of, proof: proof(system, tubes, place) }).collect()
}

/// The proof of one range.
fn proof<M: Certifiable>(system: &System<M>, tubes: &[Tube], place: usize) -> RangeProof {
    let turns = tubes.first().and_then(|tube| turns_at(&ranged(system, tube, place, tube.start().into())?));
    let two_pi = Interval::pi() + Interval::pi();
    let by = two_pi * Interval::from(turns.unwrap_or_default());
    let mut result = RangeProof::Within;
    for end in RangeEnd::BOTH {
        let room = |tube: &Tube, c: Interval| -> Option<Interval> {
            let Ranged { value, least, most, .. } = ranged(system, tube, place, c)?;
            Some(match end {
                RangeEnd::Least => value + by - least?,
                RangeEnd::Most => most? - (value + by),
            })
        };
        let is_given = tubes.first().is_some_and(|tube| {
            let found = ranged(system, tube, place, tube.range);
            found.is_some_and(|found| if end == RangeEnd::Least { found.least } else { found.most }.is_some())
        });
        if !is_given {
            continue;
        }
        // The widest first: parts next to the end have no sign however narrow they are.
        let mut open: VecDeque<(&Tube, Interval)> = tubes.iter().map(|tube| (tube, tube.range)).collect();
        let mut tests = 0;
        while let Some((tube, c)) = open.pop_front() {
            tests += 1;
            let room = room(tube, c);
            if room.is_some_and(|room| room.most() < 0.0) {
                return RangeProof::Beyond(end);
            }
            if room.is_some_and(|room| room.least() >= 0.0) {
                continue;
            }
            let middle = c.middle();
            let is_divisible = middle > c.least() && middle < c.most() && tests < MOST_PARTS;
            match [Interval::new(c.least(), middle), Interval::new(middle, c.most())] {
                [Some(first), Some(second)] if is_divisible => open.extend([(tube, first), (tube, second)]),
                // Another part may prove that the range is left.
                _ => result = RangeProof::Undecided,
            }
        }
    }
    result
}

/// The value and the ends over a part of a tube.
fn ranged<M: Certifiable>(system: &System<M>, tube: &Tube, place: usize, c: Interval) -> Option<Ranged<Interval>> {
    let part = tube.part(system, Dimensions::All, c);
    system.ranged(place, &part.map_or_else(|| tube.over(c), |part| part.q))
}

/// The whole turns that bring an angle modulo turns nearest to the middle of its range.
fn turns_at(ranged: &Ranged<Interval>) -> Option<f64> {
    let [least, most] = [ranged.least?, ranged.most?].map(Interval::middle);
    let off = f64::midpoint(least, most) - ranged.value.middle();
    // Up to a few ulps a turn is one.
    let is_of_one_turn = most - least <= TAU * (1.0 + 4.0 * f64::EPSILON);
    (ranged.is_direction && is_of_one_turn && off.abs() > PI).then(|| (off / TAU).round())
}
