//! Motions by other parameters than the only input: one input of several, a line between two inputs, a function, and the arc
//! length.

use std::f64::consts::{PI, TAU};

use linkage::continuation::{Along, AlongCoordinates, Direction, Line, OneInput, Options, Path};
use linkage::drawing::Animation;
use linkage::range_of_motion::{MotionByLength, MotionEnd, RangeOfMotion, RangeOptions};
use linkage::{Elbow, InputError, Mechanism, PathError, PositionError, Table, linkage};

linkage! {
    #[derive(Debug, Clone, Copy)]
    mechanism FiveBar {
        param a = 3, b = 4, d = 5;
        input left, right;
        unknown phi, psi;
        loop a@left + b@phi = d@0 + a@right + b@psi;
        point P = a@left + b@phi;
        output turn = phi - psi;
        derive drawing;
    }
}

linkage! {
    /// A slide on two axes: its inputs are lengths.
    #[derive(Debug, Clone, Copy)]
    mechanism Slide {
        param l = 5;
        input x, y;
        unknown s, phi;
        loop s@0 + l@phi = (x, y);
    }
}

const BRANCH: FiveBarBranch = FiveBarBranch::new(Elbow::Left);

fn start<F>(m: &Along<FiveBar, F>, [left, right]: [f64; 2], parameter: f64) -> AlongCoordinates<FiveBarCoordinates> {
    let pose = m.mechanism.assemble(FiveBarInputs { left, right }, BRANCH).unwrap();
    AlongCoordinates { q: pose.coordinates(), parameter }
}

/// The left crank turns, the right one is held: the rods are in line where its pin is 2 b from that of the right one.
#[test]
fn one_of_two_inputs() {
    let held = FiveBarInputs { left: 0.0, right: 1.2 };
    let m = Along { mechanism: FiveBar::default(), inputs: OneInput::<_, 0> { held } };
    let range = RangeOfMotion::of(&m, &start(&m, [2.0, 1.2], 2.0), RangeOptions::default()).unwrap();
    let FiveBar { a, b, d } = m.mechanism;
    let (pin_x, pin_y) = (d + a * 1.2_f64.cos(), a * 1.2_f64.sin());
    let (far, direction) = (pin_x.hypot(pin_y), pin_y.atan2(pin_x));
    let half = ((a * a + far * far - 4.0 * b * b) / (2.0 * a * far)).acos();
    // The pins are nearer than 2 b between the two ends, about the direction of the right one.
    for (end, (found, expected)) in
        range.ends().iter().zip(range.inputs().into_iter().zip([direction - half, direction + half]))
    {
        assert!(matches!(end, MotionEnd::DeadPoint { group: "phi, psi" }), "{end:?}");
        assert!((found - expected).abs() < 4e-15, "{found} {expected}");
    }
    // The same bits as on the branch with both inputs.
    for step in 1..20 {
        let left = direction - half + 2.0 * half * f64::from(step) / 20.0;
        let found = range.motion(left, 0.7, 0.3).unwrap();
        let inputs = FiveBarInputs { left, right: 1.2 };
        let (rates, accelerations) = (FiveBarInputs { left: 0.7, right: 0.0 }, FiveBarInputs { left: 0.3, right: 0.0 });
        let on_branch = m.mechanism.full_kinematics(inputs, BRANCH, rates, accelerations).unwrap();
        assert_eq!((found.rates, found.points), (on_branch.rates, on_branch.points));
        // Angles count turns along the motion.
        let [found, on_branch] = [found.outputs.turn, on_branch.outputs.turn];
        assert_eq!((found.rate, found.acceleration), (on_branch.rate, on_branch.acceleration));
        let turns = (found.value - on_branch.value) / TAU;
        assert!((turns - turns.round()).abs() < 1e-15, "{turns}");
    }
    let (beyond, gap) = (direction + half + 0.5, 0.5);
    match range.at(beyond).unwrap_err() {
        PathError::DeadPoint { gap: found, .. } => assert!((found - gap).abs() < 1e-14),
        error => panic!("{error}"),
    }
}

/// Inputs that are lengths keep their unit: the ends are where the rod is upright, or at the ends of its range.
#[test]
fn one_length_of_two() {
    for unit in [1.0, 1e-3_f64.exp2(), 1024.0] {
        let held = SlideInputs { x: 7.0 * unit, y: 0.0 };
        let m = Along { mechanism: Slide { l: 5.0 * unit }, inputs: OneInput::<_, 1> { held } };
        let q = SlideCoordinates { x: 7.0 * unit, y: 3.0 * unit, s: 3.0 * unit, phi: 0.6_f64.asin() };
        let start = AlongCoordinates { q, parameter: 3.0 * unit };
        let range = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
        assert!(range.ends().iter().all(|end| matches!(end, MotionEnd::DeadPoint { .. })), "{:?}", range.ends());
        let [least, most] = range.inputs();
        assert!((least + 5.0 * unit).abs() < 4e-15 * unit && (most - 5.0 * unit).abs() < 4e-15 * unit);
        assert!((range.at(-4.0 * unit).unwrap().s - 4.0 * unit).abs() < 1e-14 * unit);
    }
}

/// A table along a line: the rows at both ends are those of its inputs, and the rates are those of the line.
#[test]
fn a_line_between_two_inputs() {
    let (from, to) = (FiveBarInputs { left: 2.0, right: 1.2 }, FiveBarInputs { left: 1.1, right: 0.1 });
    let m = Along { mechanism: FiveBar::default(), inputs: Line { from, to } };
    let range = RangeOfMotion::on_branch(&m, BRANCH, [0.0], RangeOptions::default()).unwrap();
    assert_eq!((range.ends(), range.inputs()), ([MotionEnd::Range; 2], [0.0, 1.0]));
    let ends = [0.0, 1.0].map(|part| FiveBar::inputs(&range.at(part).unwrap()));
    assert_eq!(ends.map(|inputs| [inputs[0], inputs[1]]), [[2.0, 1.2], [1.1, 0.1]]);
    let table = Table::over(&range, (0..=8).map(|step| f64::from(step) / 8.0), 0.5);
    assert_eq!(&table.names()[..5], ["the part of the way", "time", "left", "left_rate", "left_acceleration"]);
    let columns = ["left", "left_rate", "right_rate", "right_acceleration", "P_x", "P_velocity_x", "turn", "turn_rate"];
    let [left, left_rate, right_rate, right_acceleration, x, x_rate, turn, turn_rate] =
        columns.map(|name| table.column(name).unwrap());
    for step in 0..=8 {
        let part = f64::from(u8::try_from(step).unwrap()) / 8.0;
        let inputs = FiveBarInputs { left: 2.0 * (1.0 - part) + 1.1 * part, right: 1.2 * (1.0 - part) + 0.1 * part };
        let rates = FiveBarInputs { left: (1.1 - 2.0) * 0.5, right: (0.1 - 1.2) * 0.5 };
        let expected =
            m.mechanism.full_kinematics(inputs, BRANCH, rates, FiveBarInputs { left: 0.0, right: 0.0 }).unwrap();
        let found = [left, left_rate, right_rate, right_acceleration, x, x_rate, turn, turn_rate].map(|c| c[step]);
        let (p, o) = (expected.points.p, expected.outputs.turn);
        let known = [inputs.left, rates.left, rates.right, 0.0, p.position.x, p.velocity.x, o.value, o.rate];
        assert_eq!(found, known);
    }
    assert!(matches!(range.at(1.5), Err(PathError::Input(InputError::OutOfRange { .. }))));
    let film = Animation::over(&range).unwrap().to_svg().unwrap();
    assert!(film.contains("<animate"));
}

/// Both cranks go round a circle of inputs: the motion closes after one turn of the parameter. The accelerations are the
/// slopes of the rates, by central differences.
#[test]
fn a_function_of_the_parameter() {
    let inputs = |s: f64| {
        let (sine, cosine) = s.sin_cos();
        [[1.5 + 0.3 * cosine, 1.2 + 0.2 * sine], [-0.3 * sine, 0.2 * cosine], [-0.3 * cosine, -0.2 * sine]]
    };
    let m = Along { mechanism: FiveBar::default(), inputs };
    let range = RangeOfMotion::on_branch(&m, BRANCH, [0.4], RangeOptions::default()).unwrap();
    assert_eq!(range.ends(), [MotionEnd::Closed { turns: 1 }; 2]);
    for step in 0..12 {
        let s = f64::from(step);
        let rate = |s: f64| range.motion(s, 1.0, 0.0).unwrap();
        let (little, here) = (1e-5, rate(s));
        let [after, before] = [little, -little].map(|off| rate(s + off));
        let slopes = [
            (after.outputs.turn.value - before.outputs.turn.value, here.outputs.turn.rate),
            (after.outputs.turn.rate - before.outputs.turn.rate, here.outputs.turn.acceleration),
            (after.points.p.velocity.y - before.points.p.velocity.y, here.points.p.acceleration.y),
        ];
        for (difference, derivative) in slopes {
            assert!((difference / (2.0 * little) - derivative).abs() < 1e-9, "{difference} {derivative}");
        }
    }
}

/// A function that returns NaN, two that jump by more than a 64th of a step, one whose derivatives are not its own, and a line without length.
#[test]
fn bad_functions() {
    let of = |value: fn(f64) -> f64| move |s: f64| [[2.0 + 0.1 * value(s), 1.2], [0.1, 0.0], [0.0, 0.0]];
    let error = |value: fn(f64) -> f64| {
        let m = Along { mechanism: FiveBar::default(), inputs: of(value) };
        RangeOfMotion::on_branch(&m, BRANCH, [0.0], RangeOptions::default()).err().unwrap()
    };
    let not_a_number = error(|s| if s > 0.5 { f64::NAN } else { s });
    assert!(matches!(not_a_number, PathError::Position(PositionError::NotFinite { .. })), "{not_a_number}");
    for jump in [|s: f64| if s > 0.5 { s + 1.0 } else { s }, |s: f64| if s > 0.5 { s + 0.3 } else { s }] {
        let error = error(jump);
        assert!(matches!(error, PathError::Lost { .. }), "{error}");
    }
    let other_slope = error(|s| 3.0 * s);
    assert!(matches!(other_slope, PathError::Lost { .. } | PathError::TooManySteps { .. }), "{other_slope}");

    let here = FiveBarInputs { left: 2.0, right: 1.2 };
    let m = Along { mechanism: FiveBar::default(), inputs: Line { from: here, to: here } };
    let error = RangeOfMotion::on_branch(&m, BRANCH, [0.0], RangeOptions::default()).err().unwrap();
    assert!(error.to_string().contains("the way between the inputs"), "{error}");
}

linkage! {
    /// No link turns fully: the input goes to and fro.
    #[derive(Debug, Clone, Copy)]
    mechanism Rocker {
        param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        derive drawing;
    }
}

/// A motion by its arc length goes on where the input reverses, and closes.
#[test]
fn an_arc_length_through_dead_points() {
    let m = Rocker::default();
    let start = m.assemble(0.5, RockerBranch::new(Elbow::Left)).unwrap().coordinates();
    let motion = MotionByLength::of(&m, &start, RangeOptions::default()).unwrap();
    let limit: f64 = ((9.0 + 16.0 - 4.5_f64.powi(2)) / 24.0).acos();
    let dead: Vec<_> = motion.dead_points().map(|point| (point.group, point.position.theta)).collect();
    assert!(
        matches!(dead.as_slice(), [("phi, psi", one), ("phi, psi", other)]
        if (one - limit).abs() < 1e-14 && (other + limit).abs() < 1e-14),
        "{dead:?}"
    );
    let frames = 240;
    let length = motion.length();
    let at = |frame: u32| motion.at(length * f64::from(frame) / f64::from(frames)).unwrap();
    let chord = |one: &RockerCoordinates, other: &RockerCoordinates| {
        (one.theta - other.theta).hypot(one.phi - other.phi).hypot(one.psi - other.psi)
    };
    for frame in 0..frames {
        let (here, next) = (at(frame), at(frame + 1));
        let (residual, scale) = (m.residual(&m.pose_at(&here)), 10.0 * f64::EPSILON);
        assert!(residual.iter().all(|part| part.abs() < scale), "{frame}: {residual:?}");
        // A step of 1/4 that turns by 1/4 is longer than its chord by a 384th.
        let off = chord(&here, &next) - length / f64::from(frames);
        assert!(off.abs() < 0.25 / 384.0, "{frame}: {off}");
    }
    // After a whole round it is at the start again; the first position is that of the start.
    let [first, last, round] = [at(0), at(frames), motion.at(-length).unwrap()];
    assert!(chord(&first, &start) == 0.0 && chord(&round, &start) == 0.0);
    let turns = |angle: f64| (angle / TAU).round() * TAU;
    let off = [last.theta - first.theta, last.phi - first.phi, last.psi - first.psi];
    assert!(off.iter().all(|off| (off - turns(*off)).abs() < 1e-13), "{off:?}");
    assert!(matches!(motion.at(f64::NAN), Err(PathError::Position(PositionError::NotFinite { .. }))));

    // Within a range it ends at both ends, and goes round one dead point.
    let path = Options { range: Some([-1.0, 1.0]), ..Options::default() };
    let motion = MotionByLength::of(&m, &start, RangeOptions { path, ..RangeOptions::default() }).unwrap();
    assert_eq!((motion.ends(), motion.dead_points().count()), ([MotionEnd::Range; 2], 0));
    assert!((motion.at(0.0).unwrap().theta, motion.at(motion.length()).unwrap().theta) == (-1.0, 1.0));
    assert!(matches!(motion.at(-0.1), Err(PathError::Input(InputError::OutOfRange { .. }))));
    assert!(Animation::along(&motion).unwrap().to_svg().unwrap().contains("<animate"));
}

/// `advance_by` takes its length in one call as in many.
#[test]
fn a_path_by_its_length() {
    let m = Rocker::default();
    let start = m.assemble(0.5, RockerBranch::new(Elbow::Left)).unwrap().coordinates();
    let mut path = Path::new(&m, &start, Direction::Increasing).unwrap();
    let mut length = 0.0;
    for _ in 0..40 {
        length = path.advance_by(0.1).unwrap().length;
    }
    let once = Path::new(&m, &start, Direction::Increasing).unwrap().advance_by(4.0).unwrap();
    assert!((length - 4.0).abs() < 1e-2 && (once.length - 4.0).abs() < 1e-2, "{length} {}", once.length);
    assert!(Path::new(&m, &start, Direction::Increasing).unwrap().advance_by(f64::INFINITY).is_err());
    assert!(once.position.theta.abs() < PI);
}
