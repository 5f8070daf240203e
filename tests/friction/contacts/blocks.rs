//! Blocks that slide, stop, swing, bounce and ride, against exact motions.

use linkage::{Mode, Scene};

use super::machines::*;
use linkage_oracle::close;

use super::moving::run;

/// It stops after v0 / (mu g) at v0^2 / (2 mu g), and stays.
#[test]
fn a_sliding_block_stops() {
    let scene = Sliding::default();
    let (speed, brake) = (1.7, 0.3 * 9.81);
    let start = scene.start(0.0, &block(0.25), &speed.into()).unwrap();
    let power = scene.power(0.0, &block(0.25), -speed).unwrap();
    close("power", power.dissipated, 0.3 * 2.0 * 9.81 * speed, 1e-14);
    assert_eq!(scene.power(0.0, &block(0.25), 0.0).unwrap().dissipated, 0.0);
    let end = run(&scene, start, 5.0);
    assert_eq!(end.events.len(), 1, "{:?}", end.events);
    let (t, _, before, after) = end.events[0];
    close("time", t, speed / brake, 1e-14);
    assert_eq!([before, after], [[Mode::SlipForward], [Mode::Stick]]);
    close("place", end.y[1], 0.25 + speed * speed / (2.0 * brake), 1e-14);
    close("y", end.y[0], end.y[1], 1e-15);
    assert_eq!(end.y[2], 0.0);
    let lost = scene.energy(&block(0.25), speed).unwrap().kinetic;
    close("work of friction", lost, 0.3 * 2.0 * 9.81 * (end.y[1] - 0.25), 1e-13);
}

/// A spring against dry friction: in each half cycle the amplitude decreases by 2 F / k, until friction holds the
/// block.
#[test]
fn an_oscillator_comes_to_rest() {
    let scene = Sprung::default();
    let less = 2.0 * 0.3 * 2.0 * 9.81 / 50.0;
    let end = run(&scene, scene.start(0.0, &block(1.0), &0.0.into()).unwrap(), 6.0);
    let turns = [less - 1.0, 1.0 - 2.0 * less, 3.0 * less - 1.0, 1.0 - 4.0 * less];
    assert_eq!(end.events.len(), 4, "{:?}", end.events);
    for (half, ((t, y, before, after), turn)) in end.events.iter().zip(turns).enumerate() {
        close("time", *t, (half + 1) as f64 * std::f64::consts::PI / 5.0, 1e-11);
        close("turn", y[1], turn, 1e-11);
        let [back, forth] = [Mode::SlipBackward, Mode::SlipForward];
        let (was, next) = if half % 2 == 0 { (back, forth) } else { (forth, back) };
        assert_eq!((before[0], after[0]), (was, if half == 3 { Mode::Stick } else { next }));
    }
    close("rest", end.y[1], turns[3], 1e-11);
    assert_eq!(end.y[2], 0.0);
}

/// Pushed as hard as its friction holds, a block stays, without an event; pushed harder it moves.
#[test]
fn pushed_at_the_limit() {
    let limit = 0.3 * 2.0 * 9.81;
    for (push, moves) in
        [(1.0, false), (1.0 + 2e-16, false), (1.0 - 2e-16, false), (-1.0, false), (1.0 + 1e-9, true), (-1.5, true)]
    {
        let scene = Pushed { push: push * limit, ..Pushed::default() };
        let end = run(&scene, scene.start(0.0, &block(0.0), &0.0.into()).unwrap(), 3.0);
        assert_eq!(end.events, []);
        let expected = if moves { 0.5 * limit * (push.abs() - 1.0) / 2.0 * 9.0 * push.signum() } else { 0.0 };
        close("place", end.y[1], expected, 1e-13 * expected.abs() + if moves { 1e-14 } else { 0.0 });
        assert_eq!(end.y[2] == 0.0, !moves);
    }
}

/// A force that grows with time frees the block when it is as large as its friction.
#[test]
fn a_growing_force_frees_the_block() {
    let scene = Swelling { push: -2.0, ..Swelling::default() };
    let end = run(&scene, scene.start(0.0, &block(0.0), &0.0.into()).unwrap(), 5.0);
    let free = 0.3 * 2.0 * 9.81 / 2.0;
    assert_eq!(end.events.len(), 1);
    close("time", end.events[0].0, free, 2e-12);
    assert_eq!(end.events[0].3, [Mode::SlipBackward]);
    close("place", end.y[1], -2.0 * (5.0_f64 - free).powi(3) / 12.0, 1e-11);
}

/// A ball on a stop: the times of the impacts are a geometric series, after which it rests.
#[test]
fn a_ball_bounces_and_rests() {
    let scene = Bouncing::default();
    let fall = (2.0 * 0.75 / 9.81_f64).sqrt();
    let end = run(&scene, scene.start(0.0, &block(0.25), &0.0.into()).unwrap(), 3.0);
    // 0.4^20 is the first power below 2^-26, the square root of epsilon.
    assert_eq!(end.events.len(), 20, "{:?}", end.events);
    let mut time = fall;
    for (bounce, (t, y, _, after)) in end.events.iter().enumerate() {
        // The rounding error of the coordinate, passed at this rate.
        let rate = 9.81 * fall * 0.4_f64.powi(i32::try_from(bounce).unwrap());
        close("time", *t, time, 1e-12 + 1e-15 / rate);
        close("place", y[1], -0.5, 1e-12);
        assert_eq!(*after, [if bounce == 19 { Mode::AtLower } else { Mode::Open }]);
        time += 2.0 * fall * 0.4_f64.powi(i32::try_from(bounce).unwrap() + 1);
    }
    close("rest", end.events[19].0, 7.0 / 3.0 * fall, 1e-7);
    close("place", end.y[1], -0.5, 1e-12);
    assert_eq!(end.y[2], 0.0);
    // Without restitution it rests at once; with restitution 1 it bounces for ever.
    let dull = Bouncing { e: 0.0, ..Bouncing::default() };
    let end = run(&dull, dull.start(0.0, &block(0.25), &0.0.into()).unwrap(), 3.0);
    assert_eq!((end.events.len(), end.modes[0], end.y[2]), (1, Mode::AtLower, 0.0));
    let elastic = Bouncing { e: 1.0, ..Bouncing::default() };
    let end = run(&elastic, elastic.start(0.0, &block(0.25), &0.0.into()).unwrap(), 9.0 * fall);
    assert_eq!(end.events.len(), 5);
    close("fifth", end.events[4].0, 9.0 * fall, 1e-11);
}

/// It is dragged until it has the speed of the belt, rides until the spring is stronger, and slips back.
#[test]
fn a_block_on_a_belt() {
    let scene = Carried::default();
    let (reach, omega) = (0.3 * 2.0 * 9.81 / 50.0_f64, 5.0);
    let q = BeltCoordinates { slip: 0.0, x: 0.0, z: 0.0 };
    let start = scene.start(0.0, &q, &BeltInputs { x: 0.0, z: 0.5 }).unwrap();
    let stuck = (0.5 / (reach * omega)).asin() / omega;
    let place = reach * (1.0 - (omega * stuck).cos());
    let free = stuck + (reach - place) / 0.5;
    let end = run(&scene, start, free + 0.4);
    assert_eq!(end.events.len(), 2, "{:?}", end.events);
    close("stuck", end.events[0].0, stuck, 1e-12);
    close("there", end.events[0].1[1], place, 1e-12);
    close("free", end.events[1].0, free, 1e-11);
    assert_eq!([end.events[0].3, end.events[1].3], [[Mode::Stick], [Mode::SlipBackward]]);
    close("end", end.y[1], reach + 0.5 / omega * (omega * 0.4).sin(), 1e-11);
    close("belt", end.y[2], 0.5 * (free + 0.4), 1e-12);
}
