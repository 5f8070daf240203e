//! One motion over a range: its ends, what it passes, and each of its positions against a path in small steps.

use std::f64::consts::{PI, TAU};

use linkage::continuation::{Along, AlongCoordinates, AtChangePoint, Direction, Event, Options, Path};
use linkage::range_of_motion::{MotionEnd, RangeOfMotion, RangeOptions};
use linkage::{Elbow, InputError, PathError, PositionError, Table, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    /// A four-bar whose frame is tilted.
    #[derive(Debug, Clone, Copy)]
    mechanism Tilted {
        param a = 2, b = 5, c = 5, d = 2, tilt = 5deg;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = c@tilt + d@psi;
        point Pin = a@theta;
        derive drawing;
    }
}

fn through() -> RangeOptions {
    RangeOptions::through_change_points()
}

fn branch() -> TiltedBranch {
    TiltedBranch::new(Elbow::Left)
}

/// The cranks of a parallelogram stay parallel in every row, also at both change points and after them.
#[test]
fn a_parallelogram_stays_one() {
    let m = Tilted::default();
    let inputs: Vec<f64> = (1..=72).map(|step| f64::from(5 * step).to_radians() + m.tilt).collect();
    let table = Table::at(&m, branch(), &inputs, 1.0).unwrap();
    let [theta, psi, rate] = ["theta", "psi", "psi_rate"].map(|name| table.column(name).unwrap());
    assert_eq!((theta.len(), table.missing().len()), (72, 0), "{:?}", table.missing());
    for ((theta, psi), rate) in theta.iter().zip(psi).zip(rate) {
        // At a change point itself the rate is extrapolated.
        let error = if (theta - m.tilt).sin().abs() < 1e-3 { 1e-9 } else { 1e-13 };
        assert!((psi - theta).abs() < 1e-14 && (rate - 1.0).abs() < error, "{theta} {psi} {rate}");
    }
}

/// A turn from the other motion of this branch: no row is a mirrored position.
#[test]
fn an_antiparallelogram_stays_one() {
    let m = Tilted::default();
    let table = Table::turn(&m, branch(), 72, 1.0).unwrap();
    let [theta, psi] = ["theta", "psi"].map(|name| table.column(name).unwrap());
    assert_eq!((theta.len(), table.missing().len()), (73, 0));
    for (theta, psi) in theta.iter().zip(psi) {
        // The position at a change point is that of both motions.
        let is_crossing = (theta - m.tilt).sin().abs() < 1e-3;
        assert!(is_crossing || (psi - theta).sin().abs() > 1e-3, "{theta} {psi}");
    }
}

/// Without consent the motion ends at the change point.
#[test]
fn a_motion_ends_where_others_cross() {
    let m = Tilted::default();
    let start = TiltedCoordinates { theta: 0.5, phi: m.tilt, psi: 0.5 };
    let range = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
    assert!(range.ends().iter().all(|end| matches!(end, MotionEnd::ChangePoint { .. })));
    let [least, most] = range.inputs();
    assert!((least - m.tilt).abs() < 1e-14 && (most - m.tilt - PI).abs() < 1e-14);
    let outside = range.at(4.0).unwrap_err();
    assert!(matches!(outside, PathError::ChangePoint { .. }), "{outside}");
}

/// The position of a parallelogram with crossed cranks: see [`rates_where_motions_cross`].
fn crossed(m: &Tilted, theta: f64) -> TiltedCoordinates {
    let k = (m.b + m.a) / (m.b - m.a);
    let psi = m.tilt - 2.0 * (k * ((theta - m.tilt) / 2.0).tan()).atan();
    let [across, up] = [f64::cos, f64::sin].map(|f| m.b * f(m.tilt) + m.a * (f(psi) - f(theta)));
    TiltedCoordinates { theta, phi: up.atan2(across), psi }
}

/// The other motion through the change points of a parallelogram: with x = tan((theta - tilt) / 2) and y that of psi,
/// y = -k x, k = (b + a) / (b - a). So psi' = -k at the first change point and -1 / k at the second, psi'' is 0 at both.
#[test]
fn rates_where_motions_cross() {
    let m = Tilted::default();
    let k = (m.b + m.a) / (m.b - m.a);
    let range = RangeOfMotion::of(&m, &crossed(&m, 1.0), through()).unwrap();
    assert_eq!(range.crossings().len(), 2);
    for crossing in range.crossings() {
        let expected = if (crossing.input - m.tilt).cos() > 0.0 { -k } else { -1.0 / k };
        for (rate, acceleration) in [(1.0, 0.0), (3.0, 5.0)] {
            let motion = range.motion(crossing.input, rate, acceleration).unwrap();
            assert!((motion.rates.psi - expected * rate).abs() < 4e-12 * rate, "{motion:?}");
            assert!((motion.accelerations.psi - expected * acceleration).abs() < 2e-10 * rate * rate, "{motion:?}");
            // The point is on the first crank: p'' = i a theta'' e^(i theta) - a theta'^2 e^(i theta).
            let (sine, cosine) = crossing.input.sin_cos();
            let across = -sine * acceleration - cosine * rate * rate;
            let up = cosine * acceleration - sine * rate * rate;
            let found = motion.points.pin.acceleration;
            assert!((found.x - m.a * across).hypot(found.y - m.a * up) < 1e-14 * rate * rate);
        }
    }
    // On the way through the parallelogram both cranks turn alike.
    let start = TiltedCoordinates { theta: 0.5, phi: m.tilt, psi: 0.5 };
    let range = RangeOfMotion::of(&m, &start, through()).unwrap();
    let table = Table::over(&range, (0..72).map(|step| f64::from(5 * step).to_radians()), 10.0);
    assert_eq!((table.missing().len(), table.column("theta").unwrap().len()), (0, 72));
    assert!(table.column("psi_rate").unwrap().iter().all(|rate| (rate - 10.0).abs() < 1e-9));
    assert!(table.column("psi_acceleration").unwrap().iter().all(|rate| rate.abs() < 1e-7));
    // At an end there is one side only.
    let range = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
    let at_end = range.motion(range.inputs()[0], 1.0, 0.0).unwrap_err();
    assert!(matches!(at_end, PathError::Position(PositionError::Singular { .. })), "{at_end}");
}

/// psi' = -k at the change point again, with theta = tilt + s + s^2: psi'' = -2 k.
#[test]
fn rates_by_a_function_where_motions_cross() {
    let m = Tilted::default();
    let function = |s: f64| [m.tilt + s + s * s, 1.0 + 2.0 * s, 2.0].map(|theta| TiltedInputs { theta });
    let k = (m.b + m.a) / (m.b - m.a);
    let TiltedInputs { theta } = function(0.1)[0];
    let TiltedCoordinates { phi, psi, .. } = crossed(&m, theta);
    let along = Along { mechanism: m, inputs: function };
    let start = AlongCoordinates { q: TiltedCoordinates { theta, phi, psi }, parameter: 0.1 };
    let options = through();
    let options = RangeOptions { path: Options { range: Some([-0.4, 0.4]), ..options.path }, ..options };
    let range = RangeOfMotion::of(&along, &start, options).unwrap();
    let crossing = range.crossings().next().unwrap();
    assert!(crossing.input.abs() < 1e-14);
    let motion = range.motion(crossing.input, 1.0, 0.0).unwrap();
    assert!((motion.rates.psi + k).abs() < 4e-12 && (motion.accelerations.psi + 2.0 * k).abs() < 2e-10, "{motion:?}");
}

/// The ends of a rocker that drives are where the other two links are in line, and say how far an input is beyond.
#[test]
fn a_motion_ends_at_its_dead_points() {
    let m = Tilted { a: 3.0, b: 2.0, c: 4.0, d: 2.5, tilt: 0.0 };
    let start = m.assemble(0.5, branch()).unwrap().coordinates();
    let range = RangeOfMotion::of(m, &start, RangeOptions::default()).unwrap();
    let limit: f64 = ((9.0 + 16.0 - 4.5_f64.powi(2)) / 24.0).acos();
    for (end, input) in range.ends().into_iter().zip::<[f64; 2]>(range.inputs()) {
        assert_eq!(end, MotionEnd::DeadPoint { group: "phi, psi" });
        assert!((input.abs() - limit).abs() < 1e-14, "{input}");
    }
    match range.at(limit + 0.25).unwrap_err() {
        PathError::DeadPoint { group: "phi, psi", gap, .. } => assert!((gap - 0.25).abs() < 1e-14),
        error => panic!("{error}"),
    }
}

/// A range ends where it was asked to, and begins within.
#[test]
fn a_range_that_was_asked_for() {
    let m = Tilted::default();
    let start = TiltedCoordinates { theta: 0.5, phi: m.tilt, psi: 0.5 };
    let within = |range| {
        let options = through();
        RangeOfMotion::of(&m, &start, RangeOptions { path: Options { range: Some(range), ..options.path }, ..options })
    };
    let range = within([0.25, 9.0]).unwrap();
    assert_eq!((range.ends(), range.inputs()), ([MotionEnd::Range; 2], [0.25, 9.0]));
    assert!(matches!(range.at(9.5), Err(PathError::Input(InputError::OutOfRange { .. }))));
    for invalid in [[0.6, 2.0], [2.0, 0.25], [0.5, 0.5], [f64::NAN, 2.0]] {
        assert!(matches!(within(invalid), Err(PathError::Input(_))), "{invalid:?}");
    }
}

/// Links of equal length, a tilt, and one length off by 1e-13 to 1e-2 of the longest.
fn linkage_near_a_crossing(random: &mut SmallRng) -> Tilted {
    let [one, other] = [0; 2].map(|_| 10_f64.powf(random.random_range(-0.7..0.7)));
    let mut lengths = match random.random_range(0..4) {
        0 => [one, other, other, one],
        1 => [one, one, other, other],
        2 => [one, other, one, other],
        _ => [one; 4],
    };
    if random.random_range(0..4) > 0 {
        let off = 10_f64.powf(random.random_range(-13.0..-2.0));
        let sign = if random.random() { 1.0 } else { -1.0 };
        lengths[random.random_range(0..4)] += sign * off * one.max(other);
    }
    let [a, b, c, d] = lengths;
    Tilted { a, b, c, d, tilt: random.random_range(0.0..TAU) }
}

/// The position that a path reaches at an input in small steps, passing change points smoothly; none if it turns back.
fn small_steps(m: &Tilted, start: &TiltedCoordinates, input: f64) -> Result<Option<TiltedCoordinates>, PathError> {
    let options = Options { longest_step: 1.0 / 64.0, largest_turn: 1.0 / 32.0, ..Options::default() };
    let direction = if input > start.theta { Direction::Increasing } else { Direction::Decreasing };
    let mut path = Path::with(m, start, direction, options)?;
    loop {
        let step = path.advance_watching(|q, _| q.theta - input)?;
        match step.event {
            Some(Event::Zero) => return Ok(Some(step.position)),
            Some(Event::DeadPoint { .. }) => return Ok(None),
            Some(Event::ChangePoint { .. }) if (input - start.theta) * step.rates.theta <= 0.0 => return Ok(None),
            // The sign of the determinant is not resolved.
            _ if (input - start.theta).signum() * step.rates.theta < -1e-6 => return Ok(None),
            _ => {}
        }
    }
}

/// `MOTIONS=10000` for ten thousand linkages.
#[test]
fn positions_are_those_of_small_steps() {
    let count: u32 = linkage_trials::count("MOTIONS", 60, 300);
    let mut random = SmallRng::seed_from_u64(48);
    let (mut rows, mut closed, mut ended, mut failures) = (0, 0, 0, Vec::new());
    for number in 0..count {
        let m = linkage_near_a_crossing(&mut random);
        let start = (0..1000).find_map(|_| m.assemble(random.random_range(0.0..TAU), branch()).ok());
        let Some(start) = start.map(|pose| pose.coordinates()) else { continue };
        let range = match RangeOfMotion::of(&m, &start, through()) {
            Ok(range) => range,
            Err(error) => {
                failures.push(format!("{number}: {m:?} from {start:?}: {error}"));
                continue;
            }
        };
        if range.is_closed() {
            closed += 1
        } else {
            ended += 1
        }
        for _ in 0..4 {
            let input = start.theta + random.random_range(-TAU..TAU);
            // After whole turns the input may be one that this motion reaches.
            let [least, most] = range.inputs();
            let is_within = |input: &f64| range.is_closed() || (least..=most).contains(input);
            let reached = [0.0, TAU, -TAU].map(|turn| input + turn).into_iter().find(is_within).unwrap_or(input);
            let (found, expected) = (range.at(input), small_steps(&m, &start, reached));
            rows += 1;
            let is_right = match (&found, &expected) {
                (Ok(one), Ok(Some(other))) => (one.phi - other.phi).abs().max((one.psi - other.psi).abs()) < 1e-6,
                (Err(_), Ok(None)) => true,
                _ => false,
            };
            if !is_right {
                failures.push(format!("{number}: {m:?} from {start:?} at {input}: {found:?}, not {expected:?}"));
            }
        }
    }
    println!("{rows} positions; {closed} motions close, {ended} end");
    assert!(failures.is_empty(), "{} of {count}:\n{}", failures.len(), failures[..failures.len().min(20)].join("\n"));
}

/// A policy is that of the path.
#[test]
fn the_other_motion_where_asked() {
    let m = Tilted::default();
    let start = TiltedCoordinates { theta: 0.5, phi: m.tilt, psi: 0.5 };
    let path = Options { at_change_point: AtChangePoint::Switch, ..Options::default() };
    let range = RangeOfMotion::of(&m, &start, RangeOptions { path, ..RangeOptions::default() }).unwrap();
    // An antiparallelogram between the two change points.
    let q = range.at(m.tilt - 1.0).unwrap();
    assert!((q.psi - q.theta).sin().abs() > 0.1 && (m.residual_size(&q)) < 1e-14);
    assert_eq!(range.crossings().count(), 2);
}

impl Tilted {
    fn residual_size(&self, q: &TiltedCoordinates) -> f64 {
        let x = self.a * q.theta.cos() + self.b * q.phi.cos() - self.c * self.tilt.cos() - self.d * q.psi.cos();
        let y = self.a * q.theta.sin() + self.b * q.phi.sin() - self.c * self.tilt.sin() - self.d * q.psi.sin();
        x.hypot(y)
    }
}
