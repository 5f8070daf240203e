//! Motions between the ends of declared ranges: of slots, strokes, stops and outputs.

use std::f64::consts::TAU;

use linkage::circuits::{Circuits, CurveEnd, CurveEvent};
use linkage::continuation::{Direction, Event, Options, Path};
use linkage::limits::Limit;
use linkage::range_of_motion::{MotionEnd, RangeOfMotion, RangeOptions};
use linkage::{Branches, Elbow, InputError, Mechanism, PathError, PositionError, RangeEnd, Slider, linkage};
use linkage_gallery::gate::*;
use linkage_gallery::slotted_lever::*;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

const FAR: SlottedLeverBranch = SlottedLeverBranch { phi_s: Slider::Far };

/// s^2 = crank^2 + frame^2 - 2 crank frame cos theta at an end of the slot: half the angle from its sine and its cosine, which
/// loses no digits near 0 and pi.
fn at_length(m: &SlottedLever<f64>, s: f64) -> f64 {
    let (sum, difference) = (m.crank + m.frame, (m.crank - m.frame).abs());
    let (sine, cosine) = ((s - difference) * (s + difference), (sum - s) * (sum + s));
    2.0 * sine.sqrt().atan2(cosine.sqrt())
}

fn lever_at(m: &SlottedLever<f64>, theta: f64) -> SlottedLeverCoordinates<f64> {
    m.assemble(theta, FAR).unwrap().coordinates()
}

/// An angle within a rounding error of its length times the condition number, and one of its own.
fn is_at(found: f64, expected: f64, m: &SlottedLever<f64>, s: f64) -> bool {
    let slope = s / (m.crank * m.frame * expected.sin().abs());
    (found - expected).abs() <= f64::EPSILON * (2.0 * expected.abs() + 2.0 * s * slope)
}

/// The pin is at both ends of a slot 3 long where cos theta is 43/48 and -29/48.
#[test]
fn the_pin_stops_at_the_ends_of_its_slot() {
    let m = SlottedLever::default();
    let [inner, outer] = [43.0_f64 / 48.0, -29.0 / 48.0].map(f64::acos);
    let motion = RangeOfMotion::of(&m, &lever_at(&m, 1.2), RangeOptions::default()).unwrap();
    let ends = [RangeEnd::Least, RangeEnd::Most].map(|end| MotionEnd::JointRange { of: "s", end });
    assert_eq!(motion.ends(), ends);
    for (found, expected) in motion.inputs().into_iter().zip([inner, outer]) {
        assert!((found - expected).abs() < 1e-15, "{found:?} {expected:?}");
    }
    assert!((motion.at(inner).unwrap().s - 1.5).abs() < 1e-15);
    match motion.at(outer + 0.25).unwrap_err() {
        PathError::JointRange { of: "s", end: RangeEnd::Most, gap, .. } => assert!((gap - 0.25).abs() < 1e-14),
        error => panic!("{error}"),
    }
    // On the other side of the frame the other way round, and a turn later.
    for turn in [0.0, TAU] {
        let motion = RangeOfMotion::of(&m, &lever_at(&m, turn - 1.2), RangeOptions::default()).unwrap();
        assert_eq!(motion.ends(), [ends[1], ends[0]]);
        for (found, expected) in motion.inputs().into_iter().zip([turn - outer, turn - inner]) {
            assert!((found - expected).abs() < 4e-15, "{found:?} {expected:?}");
        }
    }
    // A slot that the pin leaves at its outer end only, and where it returns.
    let long = SlottedLever { inner: 0.5, slot: 4.0, ..m };
    let motion = RangeOfMotion::of(&long, &lever_at(&long, 0.3), RangeOptions::default()).unwrap();
    assert_eq!(motion.ends(), [ends[1]; 2]);
    for (found, expected) in motion.inputs().into_iter().zip([-outer, outer]) {
        assert!((found - expected).abs() < 1e-15, "{found:?} {expected:?}");
    }
    // One that it never leaves.
    let longer = SlottedLever { inner: 0.5, slot: 5.0, ..long };
    let motion = RangeOfMotion::of(&longer, &lever_at(&longer, 0.3), RangeOptions::default()).unwrap();
    assert_eq!(motion.ends(), [MotionEnd::Closed { turns: 1 }; 2]);
}

/// The limits of the input are those of the motion.
#[test]
fn limits_are_ends_of_ranges() {
    let m = SlottedLever::default();
    let [inner, outer] = [43.0_f64 / 48.0, -29.0 / 48.0].map(f64::acos);
    let limits = m.limits(1.2, FAR).unwrap();
    let pairs = [(limits.lower, inner, RangeEnd::Least), (limits.upper, outer, RangeEnd::Most)];
    for (limit, expected, side) in pairs {
        let Limit::JointRange { input, of: "s", end } = limit else { panic!("{limit:?}") };
        assert!(end == side && (input - expected).abs() < 1e-15, "{limit:?} {expected:?}");
        // The last input in the range: the next number is beyond.
        assert!(m.is_within_ranges(&lever_at(&m, input)).unwrap());
    }
    let longer = SlottedLever { inner: 0.5, slot: 5.0, ..m.clone() };
    assert_eq!(longer.limits(1.2, FAR).unwrap().upper, Limit::Unlimited);
}

linkage! {
    /// A four-bar whose crank has limits of its own.
    #[derive(Debug, Clone)]
    mechanism Limited {
        param ground = 50, crank = 40, coupler = 45, rocker = 35, from, to;
        input theta;
        unknown phi, psi in from..to;
        loop crank@theta + coupler@phi + rocker@psi = ground@0;
        derive limits;
    }
}

/// The nearer of a limit of a group and an end of a range is returned.
#[test]
fn the_nearer_of_a_limit_and_an_end() {
    let branch = LimitedBranch::new(Elbow::Left);
    let with = |from, to| Limited { ground: 50.0, crank: 40.0, coupler: 45.0, rocker: 35.0, from, to };
    let at = |theta: f64| with(-3.0, 3.0).assemble(theta, branch).unwrap().coordinates().psi;
    let middle = at(0.3);
    let wide = with(-100.0, 100.0).limits(0.3, branch).unwrap();
    let exact = [wide.lower, wide.upper].map(|limit| match limit {
        Limit::Exact { input, .. } => input,
        limit => panic!("{limit:?}"),
    });
    let mut ends = 0;
    for [below, above] in [[0.1, 3.0], [3.0, 0.1], [0.2, 0.2], [0.01, 0.5], [0.7, 0.02]] {
        let m = with(middle - below, middle + above);
        let found = m.limits(0.3, branch).unwrap();
        for ((limit, exact), sign) in [found.lower, found.upper].into_iter().zip(exact).zip([-1.0, 1.0]) {
            let is_outside =
                |theta: f64| !m.is_within_ranges(&m.assemble(theta, branch).unwrap().coordinates()).unwrap();
            let inputs = (1..1000).map(|step| 0.3 + (exact - 0.3) * f64::from(step) / 1000.0);
            let first = inputs.into_iter().find(|theta| is_outside(*theta));
            match (limit, first) {
                (Limit::Exact { input, .. }, None) => assert_eq!(input, exact),
                (Limit::JointRange { input, of: "psi", end }, first) => {
                    let psi = m.assemble(input, branch).unwrap().coordinates().psi;
                    let expected = if end == RangeEnd::Least { m.from } else { m.to };
                    assert!(((psi - expected) / 2.0).sin().abs() < 1e-15, "{psi} {expected}");
                    let beyond = first.unwrap_or(exact);
                    let step = (exact - 0.3).abs() / 999.0;
                    assert!((input - beyond) * sign <= 0.0 && (input - beyond).abs() < step, "{input} {first:?}");
                    ends += 1;
                }
                other => panic!("{m:?} {other:?}"),
            }
        }
    }
    assert!((4..10).contains(&ends), "{ends}");
}

#[test]
fn random_slots() {
    let mut random = SmallRng::seed_from_u64(48);
    let mut met = 0;
    for _ in 0..300 {
        let [crank, frame] = [random.random_range(0.5..4.0), random.random_range(0.5..4.0)];
        let (inner, slot) = (random.random_range(0.1..3.0), random.random_range(0.2..4.0));
        let m = SlottedLever { crank, frame, inner, slot };
        let theta = random.random_range(0.1..3.0);
        let start = lever_at(&m, theta);
        let motion = RangeOfMotion::of(&m, &start, RangeOptions::default());
        let limits = m.limits(theta, FAR);
        if !(inner..=inner + slot).contains(&start.s) {
            assert!(matches!(motion.err(), Some(PathError::Input(InputError::OutOfRange { quantity: "s", .. }))));
            assert!(matches!(limits, Err(PositionError::Input(InputError::OutOfRange { quantity: "s", .. }))));
            continue;
        }
        let (motion, limits) = (motion.unwrap(), limits.unwrap());
        for (side, limit) in [limits.lower, limits.upper].into_iter().enumerate() {
            let (at, input) = (motion.inputs()[side], limit.input());
            let MotionEnd::JointRange { of: "s", end } = motion.ends()[side] else {
                // The other end is that of the mirrored motion.
                assert!(limit == Limit::Unlimited, "{m:?} {:?} {limit:?}", motion.ends());
                continue;
            };
            met += 1;
            let s = if end == RangeEnd::Least { inner } else { inner + slot };
            let expected = at_length(&m, s);
            // On either side of the frame, or of the line beyond it.
            let all = [-TAU - expected, expected - TAU, -expected, expected, TAU - expected, TAU + expected];
            let expected = all.into_iter().min_by(|a, b| (a - at).abs().total_cmp(&(b - at).abs())).unwrap();
            assert!(is_at(at, expected, &m, s), "{m:?} {at:?} {expected:?}");
            let input = input.unwrap();
            assert!(is_at(input, expected, &m, s), "{m:?} {input:?} {expected:?}");
        }
    }
    assert!(met > 100, "{met}");
}

/// A path stops at an end, goes no farther, and turns back to the other end.
#[test]
fn a_path_stops_and_turns_back() {
    let m = SlottedLever::default();
    let mut path = Path::new(&m, &lever_at(&m, 1.2), Direction::Increasing).unwrap();
    let last = path.by_ref().last().unwrap().unwrap();
    let most = Some(Event::JointRange { of: "s", end: RangeEnd::Most });
    assert_eq!((last.event, last.position.s), (most, 4.5));
    let again = path.advance().unwrap();
    assert_eq!((again.event, again.length), (most, last.length));
    path.turn_back();
    let first = path.by_ref().last().unwrap().unwrap();
    let least = Some(Event::JointRange { of: "s", end: RangeEnd::Least });
    assert_eq!((first.event, first.position.s), (least, 1.5));
    assert!((first.position.theta - (43.0_f64 / 48.0).acos()).abs() < 1e-15);
    // From an end back into the range.
    let inside = path.advance_to(1.0).unwrap();
    assert_eq!(inside.position.theta, 1.0);
    assert!(matches!(path.advance_to(2.5), Err(PathError::JointRange { of: "s", end: RangeEnd::Most, .. })));
    // A path that starts at an end.
    let end = lever_at(&m, (-29.0_f64 / 48.0).acos());
    let mut path = Path::new(&m, &end, Direction::Increasing).unwrap();
    assert_eq!(path.advance().unwrap().event, most);
    let mut path = Path::new(&m, &end, Direction::Decreasing).unwrap();
    assert_eq!(path.advance().unwrap().event, None);
    // Unless ranges do not matter.
    let free = Options { joint_ranges: false, ..Options::default() };
    let mut path = Path::with(&m, &lever_at(&m, 1.2), Direction::Increasing, free).unwrap();
    assert_eq!(path.advance_to(3.5).unwrap().event, None);
}

/// A start outside, and ranges without room or with ends that are not numbers.
#[test]
fn bad_ranges_are_errors() {
    let m = SlottedLever::default();
    let start = lever_at(&m, 0.0);
    let expected =
        InputError::OutOfRange { of: Some("SlottedLever"), quantity: "s", value: 1.0, least: 1.5, most: 4.5 };
    assert_eq!(Path::new(&m, &start, Direction::Increasing).err(), Some(PathError::Input(expected)));
    assert_eq!(RangeOfMotion::of(&m, &start, RangeOptions::default()).err(), Some(PathError::Input(expected)));
    assert_eq!(m.limits(0.0, FAR).err(), Some(PositionError::Input(expected)));
    assert_eq!(m.is_within_ranges(&start), Ok(false));
    for slot in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let m = SlottedLever { slot, ..m.clone() };
        let start = lever_at(&m, 1.2);
        let is_empty = |error: InputError| matches!(error, InputError::EmptyJointRange { of: "s", .. });
        assert!(m.is_within_ranges(&start).is_err_and(is_empty), "{slot}");
        let error = Path::new(&m, &start, Direction::Increasing).err();
        assert!(matches!(error, Some(PathError::Input(error)) if is_empty(error)), "{slot}");
        let error = m.limits(1.2, FAR).err();
        assert!(matches!(error, Some(PositionError::Input(error)) if is_empty(error)), "{slot}");
    }
    assert_eq!(m.ranged(1, &start), None);
}

/// Modes outside of a range are none, and the motion of the one inside says what it meets at both ends.
#[test]
fn circuits_end_at_ranges() {
    let m = SlottedLever::default();
    let found = Circuits::of(&m, 1.2, Default::default()).unwrap();
    assert_eq!((found.modes.len(), found.motions.len(), found.full_turns()), (1, 1, 0));
    let motion = &found.motions[0];
    assert_eq!(motion.end, CurveEnd::Limits);
    let ends = [motion.points.first(), motion.points.last()].map(|point| point.unwrap().event);
    let expected = [RangeEnd::Least, RangeEnd::Most].map(|end| Some(CurveEvent::JointRange { of: "s", end }));
    assert_eq!((ends, motion.joint_ranges().count()), (expected, 2));
    assert_eq!(Circuits::of(&m, 0.0, Default::default()).unwrap().modes.len(), 0);
    // Both slides are listed; one is in the range.
    let within: Vec<bool> =
        m.all_positions(1.2.into()).unwrap().map(|(_, position)| m.is_within_ranges(&position).unwrap()).collect();
    assert_eq!(within, [true, false]);
}

/// l^2 = arm^2 + away^2 + behind^2 - 2 arm (away cos theta - behind sin theta)
fn at_stroke(m: &Gate<f64>) -> f64 {
    let (l, base) = (m.shut + m.stroke, m.away.hypot(m.behind));
    ((m.arm * m.arm + base * base - l * l) / (2.0 * m.arm * base)).acos() - m.behind.atan2(m.away)
}

fn gate_at(m: &Gate<f64>, theta: f64) -> GateCoordinates<f64> {
    m.assemble(theta, GateBranch { psi_l: Slider::Far }).unwrap().coordinates()
}

/// Three ranges, of the input, of a length and of an output: the first that is met ends the motion.
#[test]
fn the_first_of_several_ranges() {
    let m = Gate::default();
    let motion = RangeOfMotion::of(&m, &gate_at(&m, 0.3), RangeOptions::default()).unwrap();
    let [reach, stroke] = [("reach", RangeEnd::Least), ("l", RangeEnd::Most)];
    assert_eq!(motion.ends(), [reach, stroke].map(|(of, end)| MotionEnd::JointRange { of, end }));
    let [from, to] = motion.inputs();
    assert!((to - at_stroke(&m)).abs() < 1e-15, "{to:?} {:?}", at_stroke(&m));
    let reach_at = |theta| m.outputs(&m.pose_at(&gate_at(&m, theta))).unwrap().reach;
    assert!((reach_at(from) - 0.16).abs() < 1e-16, "{:?}", reach_at(from));
    let limits = m.limits(0.3, GateBranch { psi_l: Slider::Far }).unwrap();
    let input = limits.lower.input().unwrap();
    assert!((input - from).abs() < 1e-15 && reach_at(input) >= 0.16 && reach_at(input - 1e-15) < 0.16, "{limits:?}");
    // Without them the stops of the gate itself.
    let m = Gate { stroke: 2.0, least: -1.0, ..m };
    let stops = [-10.0_f64, 100.0].map(f64::to_radians);
    let motion = RangeOfMotion::of(&m, &gate_at(&m, 0.3), RangeOptions::default()).unwrap();
    let ends = RangeEnd::BOTH.map(|end| MotionEnd::JointRange { of: "theta", end });
    assert_eq!(motion.ends(), ends);
    let limits = m.limits(0.3, GateBranch { psi_l: Slider::Far }).unwrap();
    for (side, limit) in [limits.lower, limits.upper].into_iter().enumerate() {
        let expected = Limit::JointRange { input: motion.inputs()[side], of: "theta", end: RangeEnd::BOTH[side] };
        assert_eq!(limit, expected);
        assert!((motion.inputs()[side] - stops[side]).abs() <= f64::EPSILON);
    }
    // The same gate a turn later.
    let later = m.limits(0.3 + TAU, GateBranch { psi_l: Slider::Far }).unwrap();
    assert!((later.upper.input().unwrap() - stops[1] - TAU).abs() < 1e-15);
}

/// Random gates against a fine scan of their positions.
#[test]
fn random_gates() {
    let mut random = SmallRng::seed_from_u64(5);
    let mut met = std::collections::BTreeMap::new();
    for _ in 0..100 {
        let mut about = |value: f64| value * random.random_range(0.8..1.25);
        let default = Gate::default();
        let m = Gate {
            arm: about(default.arm),
            away: about(default.away),
            behind: about(default.behind),
            shut: default.shut,
            stroke: about(default.stroke),
            least: about(default.least),
        };
        let start = gate_at(&m, 0.3);
        if !m.is_within_ranges(&start).unwrap() {
            continue;
        }
        let motion = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
        const STEP: f64 = 1e-3;
        for (side, sign) in [(0, -1.0), (1, 1.0)] {
            let at = motion.inputs()[side];
            let first = (1..).map(|step| 0.3 + sign * STEP * f64::from(step));
            let beyond = first.clone().find(|theta| !m.is_within_ranges(&gate_at(&m, *theta)).unwrap()).unwrap();
            assert!((at - beyond) * sign <= 0.0 && (at - beyond).abs() <= STEP, "{m:?} {at} {beyond}");
            let MotionEnd::JointRange { of, end } = motion.ends()[side] else { panic!("{:?}", motion.ends()) };
            *met.entry((of, side)).or_insert(0) += 1;
            let place = Gate::<f64>::RANGES.iter().position(|name| *name == of).unwrap();
            let room = m.ranged(place, &gate_at(&m, at)).unwrap().room_at(end).unwrap();
            assert!(room.abs() < 1e-15, "{m:?} {of} {room:e}");
        }
    }
    assert!(met.len() >= 4 && met.values().all(|count| *count > 2), "{met:?}");
}

linkage! {
    /// Directions alone: whole turns of all three angles change nothing.
    #[derive(Debug, Clone)]
    mechanism Rocker {
        param a = 2, b = 5, c = 4, d = 4.5, from = 150deg, to = 250deg;
        input theta;
        unknown phi, psi in from..to;
        loop a@theta + b@phi = d@0 + c@psi;
    }
    /// A crank that may turn once, from stop to stop.
    #[derive(Debug, Clone)]
    mechanism Once {
        param a = 1, b = 3;
        input theta in 0deg..360deg;
        unknown phi, x;
        loop a@theta + b@phi = (x, 0);
    }
    #[derive(Debug, Clone)]
    mechanism Arm {
        param a = 1, b = 3;
        input theta in -540deg..540deg;
        unknown phi, x;
        loop a@theta + b@phi = (x, 0);
    }
    #[derive(Debug, Clone)]
    mechanism OneEnd {
        param a = 1;
        input theta in 0.1..;
        unknown x;
        equation x = a * sin(theta);
    }
    /// A winch: its angle counts.
    #[derive(Debug, Clone)]
    mechanism Winch {
        param r = 0.5, turns = 3;
        input theta in 0..2 * pi * turns;
        unknown load;
        equation load = r * theta;
        point Hook = r@theta;
    }
}

/// The angle is the one nearest to the middle of its range, however its turns are counted, also across pi.
#[test]
fn an_angle_without_turns_is_taken_modulo_turns() {
    let m = Rocker::default();
    let mut starts = Vec::new();
    for (_, q) in m.all_positions(1.0.into()).unwrap() {
        for turns in [-1.0, 0.0, 1.0] {
            starts.push(RockerCoordinates { psi: q.psi + turns * TAU, ..q });
        }
    }
    let within: Vec<_> = starts.iter().filter(|q| m.is_within_ranges(q).unwrap()).collect();
    assert!(within.len().is_multiple_of(3) && !within.is_empty(), "{starts:?}");
    let motions: Vec<_> = within.iter().map(|q| RangeOfMotion::of(&m, q, RangeOptions::default()).unwrap()).collect();
    for motion in &motions {
        assert_eq!(motion.ends(), motions[0].ends());
        let apart = |side: usize| (motion.inputs()[side] - motions[0].inputs()[side]).abs();
        assert!(apart(0) < 1e-14 && apart(1) < 1e-14);
        let MotionEnd::JointRange { of: "psi", end } = motion.ends()[0] else { panic!("{:?}", motion.ends()) };
        let psi = motion.at(motion.inputs()[0]).unwrap().psi;
        let expected = if end == RangeEnd::Least { m.from } else { m.to };
        assert!(((psi - expected) / 2.0).sin().abs() < 1e-15, "{psi}");
    }
}

#[test]
fn a_range_of_one_turn_has_two_ends() {
    let m = Once::default();
    for theta in [0.5, 0.5 + TAU, 0.5 - 3.0 * TAU] {
        let start = OnceCoordinates { theta, phi: -0.16, x: 3.8 };
        let motion = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
        assert_eq!(motion.ends(), RangeEnd::BOTH.map(|end| MotionEnd::JointRange { of: "theta", end }));
        let turn = ((theta - 0.5) / TAU).round() * TAU;
        let [from, to] = motion.inputs();
        assert!((from - turn).abs() < 4e-15 && (to - turn - TAU).abs() < 4e-15, "{from} {to}");
    }
}

/// An arm on a cable: its range of three half turns to either side counts turns, though none of its formulas does.
#[test]
fn a_range_of_more_than_a_turn_counts_turns() {
    let m = Arm::default();
    let start = |theta: f64| ArmCoordinates { theta, phi: -0.2 * theta.sin(), x: 3.8 };
    let motion = RangeOfMotion::of(&m, &start(0.5), RangeOptions::default()).unwrap();
    assert_eq!(motion.ends(), RangeEnd::BOTH.map(|end| MotionEnd::JointRange { of: "theta", end }));
    let [from, to] = motion.inputs();
    assert!((from + 1.5 * TAU).abs() < 4e-15 && (to - 1.5 * TAU).abs() < 4e-15, "{from} {to}");
    assert!(motion.at(4.0).is_ok());
    assert!(matches!(motion.at(4.0 + TAU), Err(PathError::JointRange { of: "theta", end: RangeEnd::Most, .. })));
    assert!(Path::new(&m, &start(0.5 + 2.0 * TAU), Direction::Increasing).is_err());
    // With one end only, a motion has no other.
    let m = OneEnd::default();
    let mut path = Path::new(&m, &OneEndCoordinates { theta: 7.0, x: 0.7 }, Direction::Decreasing).unwrap();
    let last = path.by_ref().last().unwrap().unwrap();
    assert_eq!(last.event, Some(Event::JointRange { of: "theta", end: RangeEnd::Least }));
    assert!((last.position.theta - 0.1).abs() < 1e-15);
}

#[test]
fn a_counted_angle_is_taken_as_it_is() {
    let m = Winch::default();
    let start = WinchCoordinates { theta: 7.0, load: 3.5 };
    let motion = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
    let [from, to] = motion.inputs();
    assert!(from.abs() < 1e-15 && (to - 3.0 * TAU).abs() < 4e-15, "{from:?} {to:?}");
    let outside = WinchCoordinates { theta: -1.0, load: -0.5 };
    assert_eq!(m.is_within_ranges(&outside), Ok(false));
}
