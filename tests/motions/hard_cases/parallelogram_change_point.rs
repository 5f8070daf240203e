//! A parallelogram driven through its change points.
//!
//! Known to fail: Newton's method started at the last position, as assembly solvers without a motion do. Near a change
//! point it falls into the antiparallelogram without an error.

use std::f64::consts::{PI, TAU};

use linkage::continuation::{AtChangePoint, Direction, Event, Options, Path};
use linkage::{Error, Mechanism, PathError, position};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_gallery::coupled_wheels::*;

const DEGREES: [f64; 8] = [25.0, 20.0, 15.0, 10.0, 7.0, 5.0, 3.0, 2.0];
const TURNS: f64 = 5.0;

fn wheels() -> CoupledWheels {
    CoupledWheels::new(1.0, 2.0)
}

fn at(theta: f64) -> CoupledWheelsCoordinates {
    CoupledWheelsCoordinates { theta, rod: 0.0, follower: theta }
}

/// True if a position is one of the parallelogram, in which the follower is parallel to the crank.
fn is_parallel(q: &CoupledWheelsCoordinates) -> bool {
    (q.follower - q.theta).sin().abs() < 1e-6 && (q.follower - q.theta).cos() > 0.0
}

/// True if a follower without prediction stays on the parallelogram.
fn naive(start: f64, step: f64, steps: u32) -> Result<bool, Error> {
    let m = wheels();
    let mut q = at(start);
    for k in 1..=steps {
        q.theta = start + step * f64::from(k);
        let mut last = f64::INFINITY;
        for _ in 0..50 {
            let next = position::newton_step(&m, &q)?;
            let moved = (next.rod - q.rod).abs() + (next.follower - q.follower).abs();
            q = next;
            if moved < 1e-13 || (moved < 1e-9 && moved >= last) {
                break;
            }
            last = moved;
        }
        if !is_parallel(&q) {
            return Ok(false);
        }
    }
    Ok(true)
}

#[test]
fn never_an_antiparallelogram() {
    let m = wheels();
    let mut random = SmallRng::seed_from_u64(320);
    let starts = linkage_trials::count("PARALLELOGRAMS", 10, 40);
    let (mut naive_stays, mut naive_flips, mut naive_fails) = (0, 0, 0);
    for degrees in DEGREES {
        let step = degrees.to_radians();
        let steps = (TURNS * 360.0 / degrees).ceil() as u32;
        for _ in 0..starts {
            let start = random.random_range(0.2..PI - 0.2);
            match naive(start, step, steps) {
                Ok(true) => naive_stays += 1,
                Ok(false) => naive_flips += 1,
                Err(_) => naive_fails += 1,
            }
            let mut path = Path::new(&m, &at(start), Direction::Increasing).unwrap();
            let mut passed = 0;
            for k in 1..=steps {
                let theta = start + step * f64::from(k);
                let reached = path.advance_to(theta).unwrap();
                passed += u32::from(matches!(reached.event, Some(Event::ChangePoint { .. })));
                let q = reached.position;
                assert_eq!(q.theta, theta);
                assert!(q.rod.abs() < 1e-7 && (q.follower - theta).abs() < 1e-7, "{start} {step} {q:?}");
            }
            // Every half turn has a change point.
            let expected = ((start + step * f64::from(steps)) / PI).floor() as u32;
            assert_eq!(passed, expected, "from {start} by {degrees} degrees");
        }
    }
    let all = starts * DEGREES.len();
    println!("without prediction: {naive_flips} of {all} silent changes, {naive_fails} errors, {naive_stays} stay");
    assert!(16 * naive_flips > 15 * all);
}

/// The rates of the parallelogram.
const TOGETHER: CoupledWheelsRates = CoupledWheelsRates { theta: 1.0, rod: 0.0, follower: 1.0 };

/// Steps that end at a change point, from a start at one.
#[test]
fn steps_that_land_on_it() {
    let m = wheels();
    for parts in [1_u32, 2, 3, 7, 36, 180] {
        let mut path = Path::new(&m, &at(0.0), Direction::Along(TOGETHER)).unwrap();
        for k in 1..=10 * parts {
            let theta = PI * f64::from(k) / f64::from(parts);
            let reached = path.advance_to(theta).unwrap();
            assert_eq!(reached.position.theta, theta);
            assert!((reached.position.follower - theta).abs() < 1e-8 && reached.position.rod.abs() < 1e-8);
            assert_eq!(matches!(reached.event, Some(Event::ChangePoint { .. })), k % parts == 0, "{k} of {parts}");
        }
    }
    // Just before it and just after it.
    for hair in [1e-3, 1e-6, 1e-7, 1e-8, 1e-9, 1e-12, 1e-15] {
        let mut path = Path::new(&m, &at(1.0), Direction::Increasing).unwrap();
        for theta in [PI - hair, PI + hair, PI - hair, PI + hair, PI + 2.0 * hair, PI + 1.0] {
            let q = path.advance_to(theta).unwrap().position;
            assert!((q.follower - theta).abs() < 1e-7 && q.rod.abs() < 1e-7, "{hair}: {q:?}");
        }
    }
}

/// At the change point the angle of the other motion's tangent follows from the lengths: with the base line b, the
/// crank a and the rod turning by r for a turn t of the crank, (a t + b r) = a f and 0 = a t^2 + b r^2 - a f^2.
#[test]
fn both_tangents() {
    let m = wheels();
    let mut path = Path::new(&m, &at(2.0), Direction::Increasing).unwrap();
    let event = path.find_map(|step| step.unwrap().event).unwrap();
    let Event::ChangePoint { groups, tangents } = event else { panic!("{event:?}") };
    assert!(groups.iter().eq(["rod, follower (B-C-D)"]));
    assert!(tangents.len() == 2 && tangents.is_complete());
    let [kept, other] = [tangents[0], tangents[1]];
    assert!(kept.rod.abs() < 1e-12 && kept.follower > 0.0 && (kept.follower - kept.theta).abs() < 1e-12);
    // With the crank turned half: -t + 2 r = -f, and r = (t - f)/2 in -t^2 + 2 r^2 + f^2 = 0: f = -3 t... or t.
    let (t, r, f) = (other.theta, other.rod, other.follower);
    assert!((-t + 2.0 * r + f).abs() < 1e-12 && (-t * t + 2.0 * r * r + f * f).abs() < 1e-12, "{other:?}");
    assert!((f - t).abs() > 0.1);
}

#[test]
fn policies() {
    let m = wheels();
    let options = |at_change_point| Options { at_change_point, ..Options::default() };
    let start = |policy| Path::with(&m, &at(2.0), Direction::Increasing, options(policy)).unwrap();
    let anti = |q: &CoupledWheelsCoordinates| !is_parallel(q) && m.residual(&m.pose_at(q)).largest() < 1e-14;
    let mut switched = start(AtChangePoint::Switch);
    assert!(anti(&switched.advance_to(4.0).unwrap().position));
    // Half a turn further, at the next change point, it returns to the parallelogram.
    assert!(is_parallel(&switched.advance_to(7.0).unwrap().position));
    let mut stopped = start(AtChangePoint::Stop);
    let error = PathError::ChangePoint { mechanism: "CoupledWheels", group: "rod, follower (B-C-D)" };
    assert_eq!(stopped.advance_to(4.0), Err(error));
    assert!((stopped.position().theta - PI).abs() < 1e-15);
    assert_eq!(stopped.advance(), Err(error));
    stopped.choose(&TOGETHER).unwrap();
    assert!(is_parallel(&stopped.advance_to(4.0).unwrap().position));
    let mut other = start(AtChangePoint::Stop);
    let Some(Event::ChangePoint { tangents, .. }) = other.by_ref().find_map(|step| step.unwrap().event) else {
        panic!("a change point")
    };
    assert!(other.next().is_none());
    other.choose(&tangents[1]).unwrap();
    let q = other.advance().unwrap().position;
    assert!(anti(&q) || (q.theta - PI).abs() < 1e-6);
    assert!(anti(&other.advance().unwrap().position));
    // At a start on the change point the input does not determine the motion.
    for direction in [Direction::Increasing, Direction::Decreasing] {
        assert_eq!(Path::new(&m, &at(0.0), direction).err(), Some(error));
        assert_eq!(Path::new(&m, &at(TAU), direction).err(), Some(error));
    }
}
