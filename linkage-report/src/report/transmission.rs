//! Transmission angles of dyads along a motion.
//!
//! The transmission angle of two links with turning joints is the acute angle between coupler and output link (H. Alt, "Der
//! Übertragungswinkel und seine Bedeutung für das Konstruieren periodischer Getriebe", Werkstattstechnik 26, 1932): its
//! complement is the pressure angle, between the force on the output link and the velocity of its joint. Of a slider on a
//! guide that is the angle between the link and the normal of the guide, of a slotted arm that between the slot and the
//! normal of the line from its pivot to the pin. The sine of each is the regularity of the group: 0 at a dead point.

use std::f64::consts::PI;

use linkage_runtime::extremes::{Course, Extreme, Extremes};

use super::dyad::{Dyad, DyadKind};
use super::local::Local;

/// The transmission angle of a dyad along a motion, in radians.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Transmission {
    /// The unknowns of the dyad.
    pub group: String,
    /// Its kind.
    pub kind: DyadKind,
    /// The extremes of the angle between both links, from 0 to pi, at their common joint; none for other dyads than two
    /// links with angles.
    pub between: Option<Extremes>,
    /// The smallest acute angle, which is the transmission angle where it is worst.
    pub least: Extreme,
    /// The largest acute angle at the ends and at the turning points, pi/2 if the angle passes it.
    pub largest: Extreme,
}

/// A group without a transmission angle.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NoTransmission {
    /// The unknowns of the group.
    pub group: String,
    /// Its kind in words.
    pub kind: String,
}

/// The acute angle of each dyad at a position, with the unknowns of the dyad.
pub(super) fn at(local: &Local<'_, '_>) -> Vec<(String, f64)> {
    let rest = vec![0.0; local.derivation.unknowns.len() + local.derivation.inputs.len()];
    let name = |group: &usize| {
        let unknowns = local.unknowns(*group).iter().filter_map(|&unknown| local.derivation.unknowns.get(unknown));
        unknowns.map(|unknown| unknown.name).collect::<Vec<_>>().join(", ")
    };
    let of = |(groups, dyad): &(Vec<usize>, Dyad)| {
        let angle = dyad.angle(local, &rest).value;
        (groups.iter().map(name).collect::<Vec<_>>().join(", "), angle.min(PI - angle))
    };
    Dyad::all(local).iter().map(of).collect()
}

impl Transmission {
    /// `singular` are the inputs at which the dyad is singular: there both directions are in line.
    pub(super) fn of(group: &str, dyad: &Dyad, course: &Course, singular: &[f64]) -> Self {
        let Extremes { mut least, mut largest } = course.extremes;
        for &input in singular {
            // Next to it the angle has the square root of a rounding error.
            let nearest = course
                .samples
                .iter()
                .min_by(|(one, _), (other, _)| (one - input).abs().total_cmp(&(other - input).abs()));
            match nearest {
                Some((_, motion)) if motion.value < PI / 2.0 => least = Extreme { input, value: 0.0 },
                Some(_) => largest = Extreme { input, value: PI },
                None => {}
            }
        }
        let extremes = Extremes { least, largest };
        let acute = |at: Extreme| Extreme { value: at.value.min(PI - at.value), ..at };
        let (one, other) = (acute(least), acute(largest));
        let (worst, best) = if other.value < one.value { (other, one) } else { (one, other) };
        let passes = least.value < PI / 2.0 && PI / 2.0 < largest.value;
        let steepest = || {
            let nearest = course.samples.iter().map(|(input, motion)| (*input, (motion.value - PI / 2.0).abs()));
            nearest.min_by(|(_, one), (_, other)| one.total_cmp(other)).map(|(input, _)| input)
        };
        let crossing = if passes { steepest() } else { None };
        Self {
            group: group.to_owned(),
            kind: dyad.kind,
            between: dyad.has_sides().then_some(extremes),
            least: worst,
            largest: crossing.map_or(best, |input| Extreme { input, value: PI / 2.0 }),
        }
    }
}
