//! A mechanism that moves under forces: a user's right-hand side solves for the position.

use linkage::integrate::{Action, Counts, Crossing, Tolerance, dop853, watched};
use linkage::nalgebra::vector;
use linkage::{Column, D, Elbow, MotionError};

linkage::linkage! {
    /// Four-bar linkage, a crank-rocker.
    #[derive(Debug, Clone)]
    mechanism FourBar {
        param l1 = 0.8, l2 = 0.2, l3 = 0.5, l4 = 0.7;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point C = l2@theta2 + l3@theta3;
    }
}

const GRAVITY: f64 = 9.81;
/// Inertia of the crank about its joint, kg m^2.
const INERTIA: f64 = 0.05;
/// Mass in C, kg.
const MASS: f64 = 2.0;

type Position = FourBarCoordinates<f64>;

/// Crank angle and speed.
type State = Column<f64, D<2>>;

/// (I + m C'^2) theta2'' = -m C' . (C'' - g), C' for unit speed and C'' without acceleration of the crank.
fn rate(four_bar: &FourBar<f64>, position: &Position, y: &State) -> Result<State, MotionError> {
    let unit = four_bar.motion(position, 1.0, 0.0)?.points.c.velocity;
    let drift = four_bar.motion(position, y[1], 0.0)?.points.c.acceleration;
    let force = -MASS * unit.dot(&(drift + vector![0.0, GRAVITY]));
    Ok([y[1], force / (INERTIA + MASS * unit.norm_squared())].into())
}

fn energy(four_bar: &FourBar<f64>, position: &Position, y: &State) -> f64 {
    let c = four_bar.motion(position, y[1], 0.0).unwrap().points.c;
    0.5 * (INERTIA * y[1] * y[1] + MASS * c.velocity.norm_squared()) + MASS * GRAVITY * c.position.y
}

fn assembled(four_bar: &FourBar<f64>, theta2: f64) -> Result<Position, MotionError> {
    Ok(four_bar.assemble(theta2, FourBarBranch::new(Elbow::Left))?.coordinates())
}

const START: (f64, [f64; 2]) = (0.0, [0.35, 6.0]);
const END: f64 = 5.0;

/// The end, by Newton's method from the last position.
fn from_the_last_position(relative: f64) -> (State, Counts) {
    let four_bar = FourBar::default();
    let mut last = assembled(&four_bar, START.1[0]).unwrap();
    let rate = |_: f64, y: &State| {
        last = four_bar.solve(&Position { theta2: y[0], ..last })?.coordinates;
        rate(&four_bar, &last, y)
    };
    let mut motion = dop853(rate, START, END, Tolerance::new(relative, [1.0, 10.0]).unwrap()).unwrap();
    motion.finish(|_, _| true).unwrap();
    (*motion.state(), motion.counts())
}

#[test]
fn energy_stays_and_both_ways_to_the_position_agree() {
    let four_bar = FourBar::default();
    let closed = |_: f64, y: &State| rate(&four_bar, &assembled(&four_bar, y[0])?, y);
    let of = |y: &State| energy(&four_bar, &assembled(&four_bar, y[0]).unwrap(), y);
    for (relative, bound) in [(1e-6, 2e-5), (1e-9, 2e-8), (1e-12, 5e-11)] {
        let mut motion = dop853(closed, START, END, Tolerance::new(relative, [1.0, 10.0]).unwrap()).unwrap();
        let times = (0..=500).map(|i| END * f64::from(i) / 500.0);
        let drift =
            motion.at(times).map(|state| (of(&state.unwrap().1) / of(&START.1.into()) - 1.0).abs()).fold(0.0, f64::max);
        println!("{relative:e}: energy to {drift:.1e}, {:?}", motion.counts());
        assert!(drift < bound, "{relative:e}: {drift:e}");
        // Newton's method may fail where a step is tried that is too long; it is then tried shorter.
        let apart = (from_the_last_position(relative).0 - *motion.state()).largest();
        assert!(apart < 200.0 * relative, "{relative:e}: {apart:e}");
    }
    assert!(START.1[0] + 10.0 < from_the_last_position(1e-9).0[0], "it turns");
}

#[test]
fn a_rate_that_remembers_its_position_gives_the_same_bits_again() {
    let [first, second] = [(); 2].map(|()| from_the_last_position(1e-9));
    assert_eq!(first, second);
}

#[test]
fn a_lug_stops_the_rocker() {
    // theta4 at theta2 = 1.2, which it may reach before.
    let four_bar = FourBar::default();
    let theta4 = |theta2: f64| assembled(&four_bar, theta2).unwrap().theta4;
    let lug = theta4(1.2);
    let system = watched(
        |_, y: &State| rate(&four_bar, &assembled(&four_bar, y[0])?, y),
        [Crossing::Either],
        |_, y: &State| Ok([assembled(&four_bar, y[0])?.theta4 - lug]),
        |_, _, _: &State| Ok(Action::Stop),
    );
    let mut motion = dop853(system, START, END, Tolerance::new(1e-12, [1.0, 10.0]).unwrap()).unwrap();
    motion.finish(|_, _| true).unwrap();
    let stopped = motion.state()[0];
    assert!((theta4(stopped) - lug).abs() < 1e-14, "{stopped}: {:e}", theta4(stopped) - lug);
    let before = (0..1000).map(|i| START.1[0] + (stopped - START.1[0]) * f64::from(i) / 1000.0);
    assert!(before.into_iter().all(|theta2| (theta4(theta2) < lug) == (theta4(START.1[0]) < lug)));
    assert!(motion.is_over() && motion.t() < 0.5);
}
