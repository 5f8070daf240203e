//! Dead points in pairs within one step: a sign at two places says nothing of what lies between them.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use linkage::circuits::{CircuitOptions, Circuits, CurveEnd, CurveMeeting, MotionCurve};
use linkage::continuation::{Direction, Event, Path};
use linkage::{Branches, D, PathError, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::circuits::{circuits, counts, dead_inputs};

linkage! {
    /// x' is infinite where v has its maximum 2 e^3 and its minimum.
    #[derive(Debug, Clone)]
    mechanism Cubic {
        param e = 0.05;
        input v;
        unknown x;
        equation x^3 - 3*e^2*x = v;
    }
}

linkage! {
    /// A four-bar, and a dyad between its coupler and a second crank, the input.
    #[derive(Debug, Clone)]
    mechanism Steph3 {
        param a = 3, b = 1.5, c = 4.5, d = 4, px = -1, py = 3, e = 3, f = 5, x = -3.5, y = 3;
        input v;
        unknown t, p, r, u;
        loop a@t + b@p = d@0 + c@r;
        loop a@t + (px, py)@p + e@u = (x, y) + f@v;
    }
}

linkage! {
    /// A crank-rocker, and a cosine between two limits.
    #[derive(Debug, Clone)]
    mechanism Narrow {
        param a, b, c, d, middle, half;
        input v;
        unknown p, r, w;
        loop a@v + b@p = d@0 + c@r;
        equation w = acos((cos(r) - middle) / half);
    }
}

#[test]
fn both_dead_points_of_a_cubic() {
    for e in [1e-4, 1e-3, 0.005, 0.02, 0.05, 0.08, 0.3] {
        let mechanism = Cubic { e };
        let start = CubicCoordinates { v: -0.729 + 2.7 * e * e, x: -0.9 };
        let path = Path::new(&mechanism, &start, Direction::Increasing).unwrap();
        let steps = path.map(Result::unwrap).take_while(|step| step.position.x < 1.0);
        let found: Vec<f64> = steps.filter(|step| step.event.is_some()).map(|step| step.position.x).collect();
        let [first, second] = found[..] else { panic!("{e}: {found:?}") };
        println!("{e}: {:e} {:e}", first + e, second - e);
        assert!((first + e).abs() < 1e-14 + 1e-16 / e && (second - e).abs() < 1e-14 + 1e-16 / e, "{e}: {found:?}");
    }
}

/// A pair at v = 0.5355963731911816 and 0.5343823626306666, computed independently.
#[test]
fn a_pair_between_other_dead_points() {
    let mechanism = Steph3::default();
    let found = circuits(&mechanism, 1.5566473247917747);
    println!("{:?}", counts(&found));
    for motion in &found.motions {
        println!("{:?}", dead_inputs(motion));
    }
    let inputs: Vec<f64> = found.motions.iter().flat_map(dead_inputs).collect();
    for expected in [0.5355963731911816, 0.5343823626306666] {
        assert!(inputs.iter().any(|input| (input - expected).abs() < 1e-13), "{inputs:?}");
    }
    assert_eq!(circuits(&mechanism, 0.5355).circuits.len(), 1);
}

#[test]
fn a_path_does_not_pass_two_dead_points() {
    let mechanism = Steph3::default();
    let guess = mechanism
        .branches(0.6)
        .unwrap()
        .map(|mode| mode.pose.coordinates())
        .find(|q| (q.t - 1.3479485).abs() < 1e-6)
        .unwrap();
    let mut path = Path::new(&mechanism, &guess, Direction::Decreasing).unwrap();
    let Err(error) = path.advance_to(0.5) else { panic!("it is between two folds") };
    println!("{error}");
    assert!(matches!(error, PathError::DeadPoint { .. }), "{error}");
    assert!((path.position().v - 0.5343823626306666).abs() < 1e-13, "{}", path.position().v);
}

/// The dead point at v = 0.6796845311790034 is 0.0021 before a change point: both are in one step. Its place is that of a
/// continuation in small steps (`by_continuation`).
#[test]
fn a_dead_point_just_before_a_change_point() {
    let m = Steph3 { a: 2.5, b: 3.0, c: 4.0, d: 1.5, px: -2.0, py: 2.0, e: 3.0, f: 2.5, x: -3.0, y: 3.0 };
    let found = circuits(&m, 0.12597204876184753);
    let near = |motion: &&MotionCurve<_>| motion.change_points().any(|at| (at.point.input - 0.6775507254).abs() < 1e-9);
    let motion = found.motions.iter().find(near).unwrap();
    let [first, second] = dead_inputs(motion)[..] else { panic!("{:?}", dead_inputs(motion)) };
    assert!((first + 1.7165609705684652).abs() < 1e-12 && (second - 0.6796845311790034).abs() < 1e-12);
}

linkage! {
    /// A Watt six-bar: its second dyad hangs on the coupler and the rocker of a four-bar.
    #[derive(Debug, Clone)]
    mechanism Watt1 {
        param a = 4, b = 2.5, c = 3, d = 2.5, px = 3, py = -0.5, qx = 0.5, qy = 2, e = 4.5, f = 2;
        input v;
        unknown p, r, u, w;
        loop a@v + b@p = d@0 + c@r;
        loop a@v + (px, py)@p + e@u = d@0 + (qx, qy)@r + f@w;
    }
}

/// Two dead points of different groups at one position, 1.9823131728623845, are one reversal: there the first dyad is
/// singular without a change of sign.
#[test]
fn dead_points_that_coincide_are_one() {
    let found = circuits(&Watt1::default(), 1.9);
    assert_eq!(counts(&found), [4, 2, 0]);
    let motion = found.motions.iter().find(|motion| dead_inputs(motion)[1] > 1.97).unwrap();
    let [low, high] = dead_inputs(motion)[..] else { panic!("{:?}", dead_inputs(motion)) };
    assert!((low + 1.9823131728623845).abs() < 1e-15 && (high - 1.9823131728623845).abs() < 1e-15, "{low} {high}");
    assert!(circuits(&Watt1::default(), 2.1).motions.is_empty());
}

linkage! {
    /// A four-bar whose crank turns.
    #[derive(Debug, Clone)]
    mechanism FourBar {
        param a = 1, b = 3, c = 3, d = 3;
        input v;
        unknown p, r;
        loop a@v + b@p = d@0 + c@r;
    }
}

/// The rocker passes an angle a little below its largest twice within a step.
#[test]
fn both_zeros_of_a_watched_function() {
    let m = FourBar::default();
    let path = || {
        let start = m.branches(0.1).unwrap().next().unwrap().pose.coordinates();
        Path::new(&m, &start, Direction::Increasing).unwrap()
    };
    let turn = |mut path: Path<'_, FourBar>, watched: &dyn Fn(&FourBarCoordinates, &FourBarRates) -> f64| {
        let mut found = Vec::new();
        while path.position().v < 0.1 + std::f64::consts::TAU {
            let step = path.advance_watching(watched).unwrap();
            found.extend(matches!(step.event, Some(Event::Zero)).then_some(step.position));
        }
        found
    };
    let reversals = turn(path(), &|_, rates| rates.r);
    let most = reversals.iter().map(|q| q.r).fold(f64::NEG_INFINITY, f64::max);
    assert_eq!(reversals.len(), 2);
    for below in [0.1, 1e-3, 1e-5, 1e-8, 1e-11] {
        let found = turn(path(), &|q, _| q.r - (most - below));
        let [one, other] = found[..] else { panic!("{below:e}: {found:?}") };
        assert!((one.r - other.r).abs() < 1e-14 && one.v < other.v, "{below:e}: {found:?}");
    }
    assert!(turn(path(), &|q, _| q.r - (most + 1e-9)).is_empty());
    // A zero right after another: within a step of the first.
    let found = turn(path(), &|q, _| (q.v - 1.0) * (q.v - 1.0 - 1e-4) * (q.v - 1.0 - 3e-4));
    assert_eq!(found.len(), 3, "{found:?}");
}

linkage! {
    /// A four-bar whose rocker moves a slider.
    #[derive(Debug, Clone)]
    mechanism Watt2S {
        param a = 1.5, b = 2.5, c = 2, d = 1, qx = 1, qy = -1, e = 4, h = -3;
        input v;
        unknown p, r, u, s;
        loop a@v + b@p = d@0 + c@r;
        loop d@0 + (qx, qy)@r + e@u = (s, h);
    }
}

/// At the crossing of motions of the four-bar the slider's link is perpendicular to its guide, so that the rocker reverses: both
/// motions of the whole touch there, at v = 0. They reverse there and where the rocker is at pi / 2: then crank and coupler
/// reach a point at a distance of sqrt 5.
#[test]
fn motions_that_touch_are_one_circuit() {
    let found = circuits(&Watt2S::default(), 1.2392629992);
    assert_eq!(counts(&found), [4, 1, 0]);
    let (middle, half) = (2.0_f64.atan2(1.0), (1.0 / 45.0_f64.sqrt()).acos());
    for (motion, reversal) in found.motions.iter().zip([middle + half, middle - half + TAU]) {
        assert_eq!(motion.end, CurveEnd::Closed { turns: 0 });
        let [dead] = dead_inputs(motion)[..] else { panic!("{:?}", dead_inputs(motion)) };
        assert!((dead - reversal).abs() < 1e-14, "{dead} {reversal}");
        let touches: Vec<_> = motion.change_points().map(|at| at.point.position).collect();
        let [at] = touches[..] else { panic!("{touches:?}") };
        for (found, expected) in [(at.v, 0.0), (at.p.abs(), PI), (at.r.abs(), PI), (at.u, -FRAC_PI_2), (at.s, 0.0)] {
            assert!((found - expected).abs() < 1e-14, "{at:?}");
        }
    }
}

/// The range of the input ends just beyond a touch of two groups, and of links of one group.
#[test]
fn a_touch_before_a_limit_is_found() {
    fn joined<M: Branches<Scalar = f64, V = D<1>>>(m: &M, start: f64, range: [f64; 2]) -> Vec<usize> {
        let mut options = CircuitOptions::default();
        options.path.range = Some(range);
        let found = Circuits::of(m, start, options).unwrap();
        assert!(found.motions.iter().all(|motion| motion.end == CurveEnd::Limits));
        found.circuits.iter().map(Vec::len).filter(|&count| count > 1).collect()
    }
    let (m, v) = in_line([2.5, 1.5, 3.0], [1.0, 1.5], [-1.0, -1.0], 0.5);
    for end in [0.02, 0.004, 0.001] {
        assert_eq!(joined(&Watt2S::default(), 0.05, [-end, 0.1]), [2], "{end}");
        assert_eq!(joined(&m, v - 0.05, [v - 0.1, v + end]), [2], "{end}");
    }
}

/// An equation has a value only where the motion is, and little beyond.
#[test]
fn a_domain_next_to_the_motion() {
    let [a, b, c, d] = [1.0_f64, 3.0, 2.5, 2.2];
    let extreme = |side: f64| (side * side - d * d - c * c) / (2.0 * d * c);
    let (least, most) = (extreme(b - a), extreme(b + a));
    let m = Narrow { a, b, c, d, middle: 0.5 * (least + most), half: 0.5001 * (most - least) };
    let found = circuits(&m, 0.4);
    assert_eq!(counts(&found), [2, 2, 2]);
}

#[test]
fn a_start_where_motions_touch_is_ambiguous() {
    let q = Watt2SCoordinates { v: 0.0, p: PI, r: PI, u: -FRAC_PI_2, s: 0.0 };
    let Err(error) = Path::new(&Watt2S::default(), &q, Direction::Increasing) else {
        panic!("two motions begin there")
    };
    assert!(matches!(error, PathError::ChangePoint { .. }), "{error:?}");
}

/// The reversal is found within a step, or the crossing; both are one change point.
#[test]
fn touches_of_random_sliders_are_found() {
    let random = &mut SmallRng::seed_from_u64(45);
    let mut count = 0;
    for _ in 0..40 {
        // The four-bar is in line at v = 0, where b = d + c - a, and the slider's link perpendicular to its guide.
        let [a, c, d, e] = std::array::from_fn(|_| random.random_range(0.5..4.0));
        let [qx, qy] = std::array::from_fn(|_| random.random_range(-2.0..2.0));
        let b: f64 = d + c - a;
        if b < 0.3 {
            continue;
        }
        let m = Watt2S { a, b, c, d, qx, qy, e, h: qy + e };
        let Some(input) = [0.02, -0.02].into_iter().find(|&input| m.branches(input).unwrap().next().is_some()) else {
            continue;
        };
        let found = circuits(&m, input);
        let mut touches = 0;
        for motion in &found.motions {
            let at = motion.change_points().map(|at| at.point.position).filter(|q| (q.u.sin() - 1.0).abs() < 1e-15);
            let at: Vec<_> = at.collect();
            assert!(at.iter().all(|q| [q.v, q.p, q.r].iter().all(|angle| angle.sin().abs() < 1e-14)), "{m:?} {at:?}");
            // The motion reverses at each touch.
            assert_eq!((motion.dead_points().count() + at.len()) % 2, 0, "{m:?} {at:?}");
            touches += at.len();
        }
        count += usize::from(touches > 0);
    }
    println!("{count} linkages have motions that touch");
    assert!(count > 10);
}

/// A linkage whose four-bar and whose dyad are in line at an input.
fn in_line([a, c, d]: [f64; 3], [px, py]: [f64; 2], [x, y]: [f64; 2], part: f64) -> (Steph3, f64) {
    // From the ground joint of the input crank to the joint of the dyad on the coupler.
    let [east, north] = [a + px - x, py - y];
    let length = east.hypot(north);
    let f = length * part;
    (Steph3 { a, b: d + c - a, c, d, px, py, e: length - f, f, x, y }, north.atan2(east))
}

/// The motions of a four-bar in line cross, and a dyad in line reverses them: all four links are one group.
#[test]
fn touches_within_a_group_are_found() {
    let random = &mut SmallRng::seed_from_u64(46);
    // Two linkages have a motion that moves the dyad by less than 0.08 of its own way: it reverses next to the touch, and
    // has no mode at either input.
    let (mut found, mut hidden) = (0, 0);
    for _ in 0..60 {
        let [a, c, d, part] = std::array::from_fn(|_| random.random_range(0.5..4.0));
        let [px, py, x, y] = std::array::from_fn(|_| random.random_range(-3.0..3.0));
        let (m, v) = in_line([a, c, d], [px, py], [x, y], part / 5.0);
        if m.b < 0.3 || m.e + m.f < 0.5 {
            continue;
        }
        let is_touch = |at: &CurveMeeting<Steph3Coordinates>| {
            let q = at.point.position;
            [q.t, q.p, q.r, q.v - v].iter().all(|angle| (angle / 2.0).sin().abs() < 1e-13)
        };
        let touches = |motion: &MotionCurve<_>| motion.change_points().filter(is_touch).count();
        let is_found = [0.02, 0.005].into_iter().any(|offset| {
            let circuits = circuits(&m, v + offset);
            let touches: Vec<usize> = circuits.motions.iter().map(touches).collect();
            let joined = circuits.circuits.iter().filter(|circuit| circuit.iter().any(|&motion| touches[motion] > 0));
            assert!(joined.count() == 1 && touches.iter().sum::<usize>() <= 2, "{m:?} {touches:?}");
            touches.iter().sum::<usize>() == 2
        });
        *(if is_found { &mut found } else { &mut hidden }) += 1;
    }
    println!("{found} linkages, {hidden} hidden");
    assert!(found > 40 && hidden == 2);
}
