//! Algorithms on mechanisms whose numbers of coordinates and names are known at run time: the bits of those of emitted code.

mod certificates;
mod compared;
mod pictures;
mod wrapped;

use std::f64::consts::TAU;
use std::fmt::Debug;

use linkage::circuits::{CircuitOptions, Circuits};
use linkage::continuation::{AtChangePoint, Direction, Options, Path};
use linkage::position::newton;
use linkage::range_of_motion::{MotionByLength, RangeOfMotion, RangeOptions};
use linkage::{Assembly, Branches, D, Mechanism, extremes, singularity};
use linkage_gallery::Fixture;
use linkage_gallery::double_butterfly::DoubleButterfly;
use linkage_gallery::four_bar::FourBar;
use linkage_gallery::geneva::Geneva;
use linkage_gallery::jansen::Jansen;
use linkage_gallery::offset_slider_crank::OffsetSliderCrank;
use linkage_gallery::stephenson_iii::StephensonIII;
use linkage_gallery::tilted_parallelogram::TiltedParallelogram;
use linkage_gallery::watt_ii::WattII;
use linkage_gallery::wiper::Wiper;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use wrapped::{AtRunTime, Texts};

/// The result as text, without the marks of names at run time.
fn unmarked(found: &impl Debug) -> String {
    format!("{found:?}").replace(" at run time", "")
}

/// All numbers of the coordinates.
fn bits<M: Mechanism<Scalar = f64>>(q: &M::Coordinates) -> Vec<u64> {
    let (unknowns, inputs) = M::parts(q);
    unknowns.iter().chain(&inputs).map(|number| number.to_bits()).collect()
}

/// The steps of paths from random positions, in both directions: positions, lengths and events, and the error at the end.
fn steps<M: Mechanism<Scalar = f64, V = D<1>>>(m: &M, starts: &[M::Coordinates]) -> Vec<String> {
    let mut found = Vec::new();
    for start in starts {
        for (at_change_point, direction) in
            [(AtChangePoint::Keep, Direction::Increasing), (AtChangePoint::Stop, Direction::Decreasing)]
        {
            let mut path = match Path::with(m, start, direction, Options { at_change_point, ..Options::default() }) {
                Ok(path) => path,
                Err(error) => {
                    found.push(format!("{error}"));
                    continue;
                }
            };
            for _ in 0..40 {
                match path.advance() {
                    Ok(step) => {
                        let event = step.event.map(|event| match event {
                            linkage::continuation::Event::ChangePoint { groups, .. } => format!("{groups:?}"),
                            linkage::continuation::Event::DeadPoint { group } => format!("{group}"),
                            linkage::continuation::Event::JointRange { of, end } => format!("{of} {end:?}"),
                            _ => "another".to_owned(),
                        });
                        found.push(format!("{:?} {:x} {event:?}", bits::<M>(&step.position), step.length.to_bits()));
                    }
                    Err(error) => {
                        found.push(format!("{error}"));
                        break;
                    }
                }
            }
            found.push(path.advance_to(1e3).map_or_else(|error| error.to_string(), |_| "there".to_owned()));
        }
    }
    found
}

/// Positions by Newton's method from far guesses, and their distance from singular ones.
fn positions<M: Mechanism<Scalar = f64, V = D<1>>>(m: &M, guesses: &[M::Coordinates]) -> Vec<String> {
    let found = guesses.iter().map(|guess| match newton(m, guess) {
        Ok(found) => {
            let report = singularity::report(m, &m.pose_at(&found.coordinates));
            format!("{:?} {}", bits::<M>(&found.coordinates), report.unwrap())
        }
        Err(error) => error.to_string(),
    });
    found.collect()
}

/// The motion through each position: its ends, its change points, its dead points by length, and extremes of its quantities.
fn motions<M: linkage::Kinematic<Scalar = f64, V = D<1>>>(m: &M, starts: &[M::Coordinates]) -> Vec<String> {
    let mut all = Vec::new();
    for start in starts.iter().take(2) {
        match RangeOfMotion::of(m, start, RangeOptions::through_change_points()) {
            Ok(range) => {
                let [first, last] = range.inputs();
                all.push(format!("{first:x?} {last:x?} {:?} {}", range.ends(), range.crossings().len()));
                for part in [0.1, 0.5, 0.77] {
                    let at = range.at(first + (last - first) * part);
                    all.push(at.map_or_else(|error| error.to_string(), |q| format!("{:?}", bits::<M>(&q))));
                }
                let turning = extremes::courses(&range, |motion: &linkage::kinematic::MotionOf<M>| {
                    let points = M::each_point(motion.points);
                    points
                        .iter()
                        .map(|point| linkage::OutputMotion {
                            value: point.position.x,
                            rate: point.velocity.x,
                            acceleration: point.acceleration.x,
                        })
                        .collect::<Vec<_>>()
                });
                all.push(turning.map_or_else(|error| error.to_string(), |all| format!("{all:?}")));
            }
            Err(error) => all.push(error.to_string()),
        }
        match MotionByLength::of(m, start, RangeOptions::default()) {
            Ok(motion) => {
                let dead = motion.dead_points().map(|at| format!("{:x} {}", at.length.to_bits(), at.group));
                all.extend(dead);
                all.push(format!("{:x}", motion.length().to_bits()));
            }
            Err(error) => all.push(error.to_string()),
        }
    }
    all
}

/// The circuits at one input.
fn circuits<M: Branches<Scalar = f64, V = D<1>>>(m: &M, input: f64) -> Vec<String> {
    match Circuits::of(m, input, CircuitOptions::default()) {
        Ok(found) => {
            let modes = found.modes.iter().map(|mode| format!("{:?} {}", bits::<M>(&mode.position), mode.motion));
            let points = found.motions.iter().flat_map(|motion| motion.points.iter());
            let points = points.map(|point| format!("{:?} {:?}", bits::<M>(&point.position), point.event));
            modes.chain(points).chain([format!("{:?}", found.circuits)]).collect()
        }
        Err(error) => vec![error.to_string()],
    }
}

/// Compares a mechanism with itself at run time.
fn compare<M>() -> (M, Vec<M::Coordinates>)
where
    M: Fixture<Scalar = f64, V = D<1>>,
{
    let m = M::with_parameters(&M::defaults());
    let mut random = SmallRng::seed_from_u64(52);
    let guess = |random: &mut SmallRng| -> M::Coordinates {
        let numbers: Vec<f64> = (0..M::UNKNOWNS.len()).map(|_| random.random_range(-3.0..3.0)).collect();
        let unknowns = linkage::Column::from_slice(&numbers).unwrap();
        M::coordinates(unknowns, [random.random_range(0.0..TAU)].into())
    };
    let guesses: Vec<M::Coordinates> = (0..40).map(|_| guess(&mut random)).collect();
    // On its branches, or near the guesses.
    let branches = M::branches();
    let near = |(place, guess): (usize, &M::Coordinates)| match branches.len() {
        0 => Some(newton(&m, guess).ok()?.coordinates),
        count => Some(M::coordinates_of(&m.assembled(guess, branches[place % count]).ok()?)),
    };
    let starts: Vec<M::Coordinates> = guesses.iter().enumerate().filter_map(near).take(4).collect();
    assert!(starts.len() > 2, "{}", M::NAME);

    let texts = Texts::of::<M>();
    let (inputs, groups) = (texts.inputs(), texts.groups::<M>());
    let wrapped = AtRunTime { of: m.clone(), texts: &texts, inputs: &inputs, groups: &groups };
    let split = |all: &[M::Coordinates]| all.iter().map(AtRunTime::<M>::split).collect::<Vec<_>>();
    let same = |emitted: Vec<String>, at_run_time: Vec<String>| {
        let at_run_time: Vec<String> = at_run_time.iter().map(|text| text.replace(" at run time", "")).collect();
        assert_eq!(emitted, at_run_time, "{}", M::NAME);
    };
    same(positions(&m, &guesses), positions(&wrapped, &split(&guesses)));
    same(steps(&m, &starts), steps(&wrapped, &split(&starts)));
    same(motions(&m, &starts), motions(&wrapped, &split(&starts)));
    // The names are those of the value.
    assert!(format!("{}", wrapped.named(&split(&starts)[0])).contains(" at run time = "));
    (m, starts)
}

/// Compares the circuits as well, and positions on branches.
fn compare_all<M>()
where
    M: Fixture<Scalar = f64, V = D<1>> + Branches + Assembly,
{
    let (m, starts) = compare::<M>();
    let texts = Texts::of::<M>();
    let (inputs, groups) = (texts.inputs(), texts.groups::<M>());
    let wrapped = AtRunTime { of: m.clone(), texts: &texts, inputs: &inputs, groups: &groups };
    let at_run_time = circuits(&wrapped, 0.7);
    let at_run_time: Vec<String> = at_run_time.iter().map(|text| text.replace(" at run time", "")).collect();
    assert_eq!(circuits(&m, 0.7), at_run_time, "{}", M::NAME);
    let branch = m.branch_of(&m.pose_at(&starts[0]));
    for input in [0.1, 1.0, 4.0, f64::NAN] {
        let emitted = m
            .assemble(linkage::PerInput::<M>::from([input]).into(), branch)
            .map(|pose| bits::<M>(&M::coordinates_of(&pose)));
        let at_run_time = wrapped.assemble([input].into(), branch);
        let at_run_time = at_run_time.map(|pose| bits::<M>(&M::coordinates_of(&pose)));
        assert_eq!(unmarked(&emitted), unmarked(&at_run_time));
    }
}

#[test]
fn one_loop() {
    compare_all::<FourBar>();
    compare_all::<OffsetSliderCrank>();
    compare_all::<TiltedParallelogram>();
}

#[test]
fn several_groups() {
    compare_all::<Jansen>();
    compare_all::<WattII>();
    compare_all::<Wiper>();
}

#[test]
fn groups_without_a_closed_form() {
    compare::<StephensonIII>();
    compare::<DoubleButterfly>();
}

/// A pin in a slot: ranges of motion that count turns.
#[test]
fn intermittent() {
    compare_all::<Geneva>();
}
