//! Paths with their events, ranges of motion, motions by length, extremes and circuits.

use std::f64::consts::TAU;

use linkage::circuits::{CircuitOptions, Circuits};
use linkage::continuation::{Along, AlongCoordinates, AtChangePoint, Direction, Event, Line, Options, Path};
use linkage::kinematic::MotionOf;
use linkage::range_of_motion::{Driven, MotionByLength, RangeOfMotion, RangeOptions};
use linkage::{Branches, Column, D, Kinematic, Mechanism, OutputMotion, PerInput, extremes};
use linkage_gallery::Fixture;
use linkage_gallery::double_butterfly::DoubleButterfly;
use linkage_gallery::gate::Gate;
use linkage_gallery::geared_five_bar::GearedFiveBar;
use linkage_gallery::offset_slider_crank::OffsetSliderCrank;
use linkage_gallery::tilted_parallelogram::TiltedParallelogram;
use linkage_gallery::watt_i::WattI;
use linkage_interpreter::AtRunTime;

use super::{Numbers, Positions, at_run_time, bit, coordinates, position, same};

/// The steps of paths in both directions: positions, lengths and events, and the error at the end.
fn steps<M: Mechanism<Scalar = f64, V = D<1>>>(m: &M, starts: &[M::Coordinates], count: usize) -> Vec<String> {
    let mut found = Vec::new();
    for start in starts {
        for (at_change_point, direction) in
            [(AtChangePoint::Keep, Direction::Increasing), (AtChangePoint::Stop, Direction::Decreasing)]
        {
            let options = Options { at_change_point, ..Options::default() };
            let mut path = match Path::with(m, start, direction, options) {
                Ok(path) => path,
                Err(error) => {
                    found.push(error.to_string());
                    continue;
                }
            };
            for _ in 0..count {
                match path.advance() {
                    Ok(step) => {
                        let event = step.event.map(|event| match event {
                            Event::ChangePoint { groups, .. } => format!("{groups:?}"),
                            Event::DeadPoint { group } => group.to_string(),
                            Event::JointRange { of, end } => format!("{of} {end:?}"),
                            _ => "another".to_owned(),
                        });
                        found.push(format!("{} {} {event:?}", position::<M>(&step.position), bit(step.length)));
                    }
                    Err(error) => {
                        found.push(error.to_string());
                        break;
                    }
                }
            }
        }
    }
    found
}

/// The motion through a position: its ends, its change points, its dead points by length, and extremes of its points.
fn motions<M: Driven<Scalar = f64>>(m: &M, start: &M::Coordinates) -> Vec<String> {
    let mut all = Vec::new();
    match RangeOfMotion::of(m, start, RangeOptions::through_change_points()) {
        Ok(range) => {
            let [first, last] = range.inputs();
            all.push(format!("{} {} {:?} {}", bit(first), bit(last), range.ends(), range.crossings().len()));
            for part in [0.1, 0.77] {
                let at = range.at(first + (last - first) * part);
                all.push(at.map_or_else(|error| error.to_string(), |q| position::<M::Of>(&q)));
            }
            let turning = extremes::courses(&range, |motion: &MotionOf<M::Of>| {
                let points = M::Of::each_point(motion.points);
                let height = |point: &linkage::PointMotion<f64>| OutputMotion {
                    value: point.position.y,
                    rate: point.velocity.y,
                    acceleration: point.acceleration.y,
                };
                points.iter().map(height).collect::<Vec<_>>()
            });
            all.push(turning.map_or_else(|error| error.to_string(), |all| format!("{all:?}")));
        }
        Err(error) => all.push(error.to_string()),
    }
    match MotionByLength::of(m, start, RangeOptions::default()) {
        Ok(motion) => {
            all.extend(motion.dead_points().map(|at| format!("{} {}", bit(at.length), at.group)));
            all.push(bit(motion.length()));
        }
        Err(error) => all.push(error.to_string()),
    }
    all
}

/// The circuits at one input.
pub fn circuits<M: Branches<Scalar = f64, V = D<1>>>(m: &M, input: f64) -> Vec<String> {
    match Circuits::of(m, input, CircuitOptions::default()) {
        Ok(found) => {
            let modes = found.modes.iter().map(|mode| format!("{} {}", position::<M>(&mode.position), mode.motion));
            let points = found.motions.iter().flat_map(|motion| motion.points.iter());
            let points = points.map(|point| format!("{} {:?}", position::<M>(&point.position), point.event));
            modes.chain(points).chain([format!("{:?}", found.circuits)]).collect()
        }
        Err(error) => vec![error.to_string()],
    }
}

pub fn compare<M: Fixture<Scalar = f64, V = D<1>>>() {
    let Positions { mechanism, starts, .. } = Positions::<M>::drawn(20);
    assert!(starts.len() > 1, "{}", M::NAME);
    at_run_time::<1, M, _>(|own| {
        let (emitted, own_starts) = (at::<M>(&starts[..2]), at::<AtRunTime<'_, D<1>>>(&starts[..2]));
        same::<M>(&steps(&mechanism, &emitted, 25), &steps(own, &own_starts, 25));
        same::<M>(&motions(&mechanism, &emitted[0]), &motions(own, &own_starts[0]));
    });
}

fn at<M: Mechanism<Scalar = f64>>(all: &[Numbers]) -> Vec<M::Coordinates> {
    all.iter().map(coordinates::<M>).collect()
}

/// The motion from a position while all inputs move along a line.
fn along_a_line<M: Kinematic<Scalar = f64> + Clone>(m: &M, start: &Numbers) -> Vec<String> {
    let line = line(m, start);
    let start = AlongCoordinates { q: coordinates::<M>(start), parameter: 0.0 };
    [steps(&line, &[start], 6), motions(&line, &start)].concat()
}

/// Inputs that grow, each with another rate.
pub fn line<M: Mechanism<Scalar = f64> + Clone>(m: &M, [_, inputs]: &Numbers) -> Along<M, Line<M::Inputs>> {
    let column = |numbers: &[f64]| -> PerInput<M> { Column::from_slice(numbers).expect("as many inputs") };
    let to: Vec<f64> = inputs.iter().zip(1..).map(|(input, place)| input + 0.25 * f64::from(place)).collect();
    Along { mechanism: m.clone(), inputs: Line { from: column(inputs).into(), to: column(&to).into() } }
}

pub fn compare_along<const V: usize, M: Fixture<Scalar = f64, V = D<V>>>() {
    let Positions { mechanism, starts, .. } = Positions::<M>::drawn(80);
    let start = starts.first().expect("a position");
    at_run_time::<V, M, _>(|own| same::<M>(&along_a_line(&mechanism, start), &along_a_line(own, start)));
}

pub fn compare_circuits<M: Fixture<Scalar = f64, V = D<1>> + Branches>() {
    let mechanism = M::with_parameters(&M::defaults());
    at_run_time::<1, M, _>(|own| same::<M>(&circuits(&mechanism, 0.1 * TAU), &circuits(own, 0.1 * TAU)));
}

#[test]
fn motions_along_a_line() {
    eight!(compare_along);
}

#[test]
fn motions_of_one_loop() {
    compare::<OffsetSliderCrank>();
    // Change points, ranges, and motions that count turns.
    compare::<TiltedParallelogram>();
    compare::<Gate>();
    compare::<GearedFiveBar>();
}

#[test]
fn motions_of_several_groups() {
    compare::<WattI>();
}

#[test]
fn motions_without_a_closed_form() {
    compare::<DoubleButterfly>();
}

#[test]
fn circuits_are_those_of_emitted_code() {
    compare_circuits::<OffsetSliderCrank>();
    compare_circuits::<TiltedParallelogram>();
    compare_circuits::<WattI>();
}
