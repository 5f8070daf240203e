//! The part of a report about one motion from end to end.

use std::f64::consts::TAU;

use linkage_runtime::derivation::Derivation;
use linkage_runtime::extremes::{Course, Extreme, Extremes, courses_on_turns};
use linkage_runtime::kinematic::MotionOf;
use linkage_runtime::range_of_motion::{MotionEnd, RangeOfMotion};
use linkage_runtime::{BorrowedName, D, Dim, Kinematic, OutputMotion, PathError, PositionError};

use super::dwells::{Dwell, dwells};
use super::dyad::Dyad;
use super::four_bar::{self, FourBarLoop};
use super::local::{Local, listed};
use super::modes::SingularInput;
use super::options::ReportOptions;
use super::output_angles::of_output;
use super::strokes::{SAME, Stroke, strokes, time_ratio};
use super::transmission::{NoTransmission, Transmission};

/// One motion from end to end.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotionReport<N: BorrowedName = &'static str> {
    /// The input at which it was found.
    pub start: f64,
    /// The least and the largest input; a closed motion goes on beyond.
    pub range: [f64; 2],
    /// The reasons why it ends there; of a closed motion twice the same.
    pub ends: [MotionEnd<N>; 2],
    /// The change points that it passes, where others cross it.
    pub change_points: Vec<SingularInput>,
    /// The places at which it passes nearest to others that it does not meet.
    pub near_misses: Vec<NearMissInput>,
    /// The outputs, then the unknowns.
    pub quantities: Vec<QuantityReport>,
    /// The transmission angles of the dyads, in the order in which they are solved.
    pub transmission: Vec<Transmission>,
    /// The groups without a transmission angle.
    pub without_transmission: Vec<NoTransmission>,
    /// The loops of four turning joints.
    pub four_bars: Vec<FourBarLoop>,
}

/// A place at which the motion passes near another.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NearMissInput {
    /// The input.
    pub input: f64,
    /// The regularity of the Jacobian, which is about the distance from the other motion, in radians and divided by the
    /// lengths of loops.
    pub regularity: f64,
}

/// An output or an unknown along the motion.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct QuantityReport {
    /// Its name.
    pub name: String,
    /// True for an output.
    pub is_output: bool,
    /// True for an angle in radians: an unknown that is an angle, or an output that is a sum of such.
    pub is_angle: bool,
    /// True if it does not move.
    pub is_constant: bool,
    /// Its least and its largest value along the motion.
    pub extremes: Extremes,
    /// The parts of the motion in which it moves in one direction.
    pub strokes: Vec<Stroke>,
    /// The duration of the longer stroke divided by that of the shorter one at a constant input rate; none unless it moves
    /// forth and back once in a closed motion.
    pub time_ratio: Option<f64>,
    /// The parts of the motion in which it hardly moves.
    pub dwells: Vec<Dwell>,
    /// Inputs and values along the motion, for a curve.
    pub curve: Vec<[f64; 2]>,
    /// The values at both ends.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) ends: [Extreme; 2],
    /// The resolution of its course.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) resolution: (f64, Vec<(f64, f64)>),
}

impl QuantityReport {
    /// The angle by which it turns each time a motion closes, if it is an angle that moves in one direction, or by whole turns.
    pub(super) fn turned(&self) -> Option<f64> {
        let [from, to] = self.ends;
        let turned = to.value - from.value;
        let error = SAME * (self.resolution_at(from.input) + self.resolution_at(to.input));
        let is_whole = (turned - (turned / TAU).round() * TAU).abs() <= error;
        (self.is_angle && turned.abs() > error && (is_whole || self.strokes.is_empty())).then_some(turned)
    }

    /// The change of its value at an input by rounding errors.
    pub(super) fn resolution_at(&self, input: f64) -> f64 {
        let (between, singular) = &self.resolution;
        singular.iter().find(|(at, _)| *at == input).map_or(*between, |(_, change)| change.max(*between))
    }
}

impl<N: BorrowedName> MotionReport<N> {
    pub(super) fn of<M>(
        range: &RangeOfMotion<'_, M>,
        derivation: &Derivation<'_>,
        start: f64,
        options: &ReportOptions,
    ) -> Result<Self, PathError<N>>
    where
        M: Kinematic<Scalar = f64, Name = N, V = D<1>>,
    {
        let (m, q) = (range.mechanism(), range.at(start)?);
        let local = Local::of(m, derivation, &q);
        let dyads = Dyad::all(&local);
        let quantities = |motion: &MotionOf<M>| -> Vec<OutputMotion> {
            let mut all = quantities::<M>(motion);
            let (local, rates) = (Local::of(m, derivation, &motion.position), listed::<M>(&motion.rates));
            all.extend(dyads.iter().map(|(_, dyad)| dyad.angle(&local, &rates)));
            all
        };
        let jumps = derivation.outputs.iter().map(|output| of_output(m, output.value)?.jump);
        let all = courses_on_turns(range, jumps, quantities)?;
        let (named, of_dyads) = all.split_at(all.len() - dyads.len());
        let mut reports = Vec::new();
        let outputs = named.len() - m.dims().0.count();
        for (place, course) in named.iter().enumerate() {
            reports.push(quantity(range, derivation, (place, outputs), course, options));
        }
        let name = |place: usize| m.group(place).map(|group| group.name.to_string()).unwrap_or_default();
        let transmission = dyads.iter().zip(of_dyads);
        let is_dyad = |group: &usize| dyads.iter().any(|(groups, _)| groups.contains(group));
        let kind = |group: usize| match Dyad::is_cylinder(&local, group) {
            true => CYLINDER.to_owned(),
            false => derivation.groups.get(group).map(|group| group.kind.to_owned()).unwrap_or_default(),
        };
        let without = (0..m.groups().count())
            .filter(|group| !is_dyad(group))
            .map(|group| NoTransmission { group: name(group), kind: kind(group) });
        let singular = range.crossings().map(|crossing| SingularInput {
            input: crossing.input,
            groups: crossing.groups.iter().map(|group| group.to_string()).collect(),
        });
        let ends = range.inputs();
        let dead =
            |groups: &[usize]| singular_inputs(range, &groups.iter().map(|&group| name(group)).collect::<Vec<_>>());
        Ok(Self {
            start,
            range: ends,
            ends: range.ends(),
            change_points: singular.filter(|at| range.is_closed() || !ends.contains(&at.input)).collect(),
            near_misses: range
                .near_misses()
                .map(|miss| NearMissInput { input: miss.input, regularity: miss.regularity })
                .collect(),
            quantities: reports,
            transmission: transmission
                .map(|((groups, dyad), course)| {
                    let names = groups.iter().map(|&group| name(group)).collect::<Vec<_>>();
                    Transmission::of(&names.join(", "), dyad, course, &dead(groups))
                })
                .collect(),
            without_transmission: without.collect(),
            four_bars: dyads.iter().filter_map(|(_, dyad)| four_bar::of_dyad(&local, dyad)).collect(),
        })
    }

    /// True if the motion has positions at all inputs and repeats them.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        matches!(self.ends[1], MotionEnd::Closed { .. })
    }
}

/// The reason why a cylinder has no transmission angle.
const CYLINDER: &str = "it is a cylinder, or a slot through its own pivot, and nothing follows from its angle";

/// The inputs at which one of these groups is singular.
fn singular_inputs<M>(range: &RangeOfMotion<'_, M>, groups: &[String]) -> Vec<f64>
where
    M: Kinematic<Scalar = f64, V = D<1>>,
{
    let is_one = |name: M::Name| groups.contains(&name.to_string());
    let ends = range.ends().into_iter().zip(range.inputs()).filter(|(end, _)| match end {
        MotionEnd::DeadPoint { group } => is_one(*group),
        MotionEnd::ChangePoint { groups } => groups.iter().any(is_one),
        _ => false,
    });
    let crossings = range.crossings().filter(|crossing| crossing.groups.iter().any(is_one));
    ends.map(|(_, input)| input).chain(crossings.map(|crossing| crossing.input)).collect()
}

/// The outputs, then the unknowns, with their derivatives.
fn quantities<M: Kinematic<Scalar = f64>>(motion: &MotionOf<M>) -> Vec<OutputMotion> {
    let unknowns = M::unknowns(&motion.position);
    let rates = M::rate_parts(&motion.rates).0;
    let accelerations = M::acceleration_parts(&motion.accelerations).0;
    let derivatives = rates.iter().zip(&accelerations);
    let unknowns = unknowns.iter().zip(derivatives).map(|(&value, (&rate, &acceleration))| OutputMotion {
        value,
        rate,
        acceleration,
    });
    M::each_output(motion.outputs).iter().copied().chain(unknowns).collect()
}

/// The report of the output or unknown at a place among [`quantities`], of which so many are outputs.
fn quantity<M>(
    range: &RangeOfMotion<'_, M>,
    derivation: &Derivation<'_>,
    (place, outputs): (usize, usize),
    course: &Course,
    options: &ReportOptions,
) -> QuantityReport
where
    M: Kinematic<Scalar = f64, V = D<1>>,
{
    let m = range.mechanism();
    let (name, is_angle) = match place.checked_sub(outputs) {
        None => {
            (m.output_name(place), derivation.outputs.get(place).is_some_and(|of| of_output(m, of.value).is_some()))
        }
        Some(unknown) => (m.unknown_name(unknown), m.unknown_angles().get(unknown) == Some(&true)),
    };
    let is_closed = range.is_closed();
    let motion = |input| range.motion(input, 1.0, 0.0);
    let rate = |input: f64| {
        let found = match motion(input) {
            // At a kink that after it.
            Err(PathError::Position(PositionError::NotFinite { .. })) => motion(
                input
                    + 4.0
                        * f64::EPSILON
                        * range.inputs().into_iter().fold(input.abs(), |size, end| size.max(end.abs())),
            ),
            found => found,
        };
        Some(quantities::<M>(&found.ok()?).get(place)?.rate)
    };
    let dwells = dwells(course, is_closed, options.dwell, rate);
    let strokes = strokes(course, is_closed);
    let sampled = course.samples.iter().map(|(input, motion)| [*input, motion.value]);
    let turned = course.turning_points.iter().chain(&course.ends).map(|at| [at.input, at.value]);
    let mut curve: Vec<[f64; 2]> = sampled.chain(turned).collect();
    curve.sort_by(|one, other| one[0].total_cmp(&other[0]));
    QuantityReport {
        name: name.to_string(),
        is_output: place < outputs,
        is_angle,
        is_constant: course.is_constant,
        extremes: course.extremes,
        time_ratio: time_ratio(&strokes, is_closed),
        strokes,
        dwells,
        curve,
        ends: course.ends,
        resolution: course.resolution.clone(),
    }
}
