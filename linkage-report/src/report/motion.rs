//! The part of a report about one motion from end to end.

use std::f64::consts::TAU;

use linkage_runtime::derivation::{Derivation, Formula, FormulaView, notation::Name};
use linkage_runtime::extremes::{Course, Extremes, courses};
use linkage_runtime::kinematic::MotionOf;
use linkage_runtime::range_of_motion::{MotionEnd, RangeOfMotion};
use linkage_runtime::{BorrowedName, D, Dim, Kinematic, Mechanism, OutputMotion, PathError, PathErrorOf};

use super::dwells::{Dwell, dwells};
use super::dyad::Dyad;
use super::four_bar::{self, FourBarLoop};
use super::local::{Local, listed};
use super::modes::SingularInput;
use super::options::ReportOptions;
use super::strokes::{Stroke, strokes, time_ratio};
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
}

impl QuantityReport {
    /// The whole turns from the least input to the largest; none of a length.
    pub(super) fn turns(&self) -> Option<f64> {
        let ([_, from], [_, to]) = (self.curve.first()?, self.curve.last()?);
        self.is_angle.then(|| ((to - from) / TAU).round())
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
        let all = courses(range, quantities)?;
        let (named, of_dyads) = all.split_at(all.len() - dyads.len());
        let mut reports = Vec::new();
        let outputs = named.len() - m.dims().0.count();
        for (place, course) in named.iter().enumerate() {
            reports.push(quantity(range, derivation, (place, outputs), course, options)?);
        }
        let name = |place: usize| m.group(place).map(|group| group.name.to_string()).unwrap_or_default();
        let transmission = dyads.iter().zip(of_dyads);
        let is_dyad = |group: &usize| dyads.iter().any(|(groups, _)| groups.contains(group));
        let kind = |group: usize| derivation.groups.get(group).map(|group| group.kind).unwrap_or_default();
        let without = (0..m.groups().count())
            .filter(|group| !is_dyad(group))
            .map(|group| NoTransmission { group: name(group), kind: kind(group).to_owned() });
        let singular = range.crossings().map(|crossing| SingularInput {
            input: crossing.input,
            groups: crossing.groups.iter().map(|group| group.to_string()).collect(),
        });
        let ends = range.inputs();
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
                    Transmission::of(&names.join(", "), dyad, course)
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
) -> Result<QuantityReport, PathErrorOf<M>>
where
    M: Kinematic<Scalar = f64, V = D<1>>,
{
    let m = range.mechanism();
    let (name, is_angle) = match place.checked_sub(outputs) {
        None => (m.output_name(place), derivation.outputs.get(place).is_some_and(|output| is_angle(m, output.value))),
        Some(unknown) => (m.unknown_name(unknown), m.unknown_angles().get(unknown) == Some(&true)),
    };
    let is_closed = range.is_closed();
    let rate = |input| {
        let all = quantities::<M>(&range.motion(input, 1.0, 0.0)?);
        Ok::<_, PathErrorOf<M>>(all.get(place).map_or(f64::NAN, |quantity| quantity.rate))
    };
    let dwells = dwells(course, is_closed, options.dwell, rate)?;
    let strokes = strokes(course, is_closed);
    let sampled = course.samples.iter().map(|(input, motion)| [*input, motion.value]);
    let turned = course.turning_points.iter().chain(&course.ends).map(|at| [at.input, at.value]);
    let mut curve: Vec<[f64; 2]> = sampled.chain(turned).collect();
    curve.sort_by(|one, other| one[0].total_cmp(&other[0]));
    Ok(QuantityReport {
        name: name.to_string(),
        is_output: place < outputs,
        is_angle,
        is_constant: course.is_constant,
        extremes: course.extremes,
        time_ratio: time_ratio(&strokes, is_closed),
        strokes,
        dwells,
        curve,
    })
}

/// True if a formula is an angle of the mechanism, or a sum with one.
fn is_angle<M: Mechanism>(mechanism: &M, value: &[linkage_runtime::derivation::Equation<'_>]) -> bool {
    let is_coordinate = |formula: Formula<'_>| match formula.view() {
        FormulaView::Name(Name::Plain(name)) => {
            let mut are_angles = mechanism.unknown_angles().iter().chain(mechanism.input_angles()).enumerate();
            are_angles.any(|(column, is_angle)| *is_angle && mechanism.coordinate_name(column).to_string() == name)
        }
        _ => false,
    };
    value.iter().all(|equation| match equation.right.view() {
        FormulaView::Sum(terms) => terms.iter().any(|(_, term)| is_coordinate(term)),
        _ => is_coordinate(equation.right),
    })
}
