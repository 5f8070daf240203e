//! Dry friction and stops in simulations, against exact motions.

use linkage::contact::Change;
use linkage::integrate::Crossing;
use linkage::simulation::{Start, State, Then, simulate};
use linkage::{InputError, Mode, MotionError};
use linkage_oracle::close;

use linkage_gallery::belt::*;
use linkage_gallery::block::*;

fn block(x: f64) -> BlockCoordinates {
    BlockCoordinates { x, y: x }
}

/// It stops after v0 / (mu g) at v0^2 / (2 mu g), and stays.
#[test]
fn a_sliding_block_stops() {
    let scene = Sliding::default();
    let (speed, brake) = (1.7, 0.3 * 9.81);
    let mut motion = simulate(&scene, Start { t: 0.0, q: block(0.25), input_rates: speed }, 5.0, 1e-13).unwrap();
    assert_eq!(motion.state().mode("friction on x"), Some(Mode::SlipForward));
    let events: Vec<_> = motion.by_ref().map(Result::unwrap).filter(|state| state.changes().count() > 0).collect();
    let [stop] = events[..] else { panic!("{events:?}") };
    close("time", stop.t, speed / brake, 1e-14);
    assert_eq!(stop.changes().collect::<Vec<_>>(), [("friction on x", Change::Sticks)]);
    assert_eq!(stop.mode("friction on x"), Some(Mode::Stick));
    let end = motion.state();
    close("place", end.q.x, 0.25 + speed * speed / (2.0 * brake), 1e-14);
    assert_eq!((end.t, end.q.y, end.rates), (5.0, end.q.x, BlockRates { x: 0.0, y: 0.0 }));
}

/// A spring against dry friction: in each half cycle the amplitude decreases by 2 F / k, until friction holds the
/// block.
#[test]
fn an_oscillator_comes_to_rest() {
    let scene = Sprung::default();
    let less = 2.0 * 0.3 * 2.0 * 9.81 / 50.0;
    let turns = [less - 1.0, 1.0 - 2.0 * less, 3.0 * less - 1.0, 1.0 - 4.0 * less];
    let mut motion = simulate(&scene, Start { t: 0.0, q: block(1.0), input_rates: 0.0 }, 6.0, 1e-13).unwrap();
    let events: Vec<_> = motion.by_ref().map(Result::unwrap).filter(|state| state.changes().count() > 0).collect();
    assert_eq!(events.len(), 4, "{events:?}");
    for (half, (state, turn)) in events.iter().zip(turns).enumerate() {
        close("time", state.t, (half + 1) as f64 * std::f64::consts::PI / 5.0, 1e-11);
        close("turn", state.q.x, turn, 1e-11);
        let what = if half == 3 { Change::Sticks } else { Change::Slips };
        assert_eq!(state.changes().collect::<Vec<_>>(), [("friction on x", what)]);
    }
    close("rest", motion.state().q.x, turns[3], 1e-11);
    assert_eq!(motion.state().rates.x, 0.0);
}

/// A ball on a stop: the times of the impacts are a geometric series, after which it rests.
#[test]
fn a_ball_bounces_and_rests() {
    let scene = Bouncing::default();
    let fall = (2.0 * 0.75 / 9.81_f64).sqrt();
    let mut motion = simulate(&scene, Start { t: 0.0, q: block(0.25), input_rates: 0.0 }, 3.0, 1e-13).unwrap();
    let events: Vec<_> = motion.by_ref().map(Result::unwrap).filter(|state| state.changes().count() > 0).collect();
    assert_eq!(events.len(), 20, "{events:?}");
    let mut time = fall;
    for (bounce, state) in events.iter().enumerate() {
        let rate = 9.81 * fall * 0.4_f64.powi(i32::try_from(bounce).unwrap());
        close("time", state.t, time, 1e-12 + 1e-15 / rate);
        close("place", state.q.x, -0.5, 1e-15);
        close("rate before", state.rates.x, -rate, 1e-12 + 1e-15 / rate);
        let what = if bounce == 19 { Change::Rests } else { Change::Impact };
        assert_eq!(state.changes().collect::<Vec<_>>(), [("stop on height", what)]);
        time += 2.0 * fall * 0.4_f64.powi(i32::try_from(bounce).unwrap() + 1);
    }
    close("rest", events[19].t, 7.0 / 3.0 * fall, 1e-7);
    close("place", motion.state().q.x, -0.5, 1e-15);
    assert_eq!((motion.state().rates.x, motion.state().mode("stop on height")), (0.0, Some(Mode::AtLower)));
}

/// It is dragged until it has the speed of the belt, rides until the spring is stronger, and slips back.
#[test]
fn a_block_on_a_belt() {
    let scene = Carried::default();
    let (reach, omega) = (0.3 * 2.0 * 9.81 / 50.0_f64, 5.0);
    let q = BeltCoordinates { slip: 0.0, x: 0.0, z: 0.0 };
    let stuck = (0.5 / (reach * omega)).asin() / omega;
    let place = reach * (1.0 - (omega * stuck).cos());
    let free = stuck + (reach - place) / 0.5;
    let mut motion =
        simulate(&scene, Start { t: 0.0, q, input_rates: BeltInputs { x: 0.0, z: 0.5 } }, free + 0.4, 1e-13).unwrap();
    let mut events = Vec::new();
    motion
        .finish(|state, _| {
            events.extend((state.changes().count() > 0).then_some(*state));
            true
        })
        .unwrap();
    let [sticks, slips] = events[..] else { panic!("{events:?}") };
    close("stuck", sticks.t, stuck, 1e-12);
    close("there", sticks.q.x, place, 1e-12);
    close("free", slips.t, free, 1e-11);
    assert_eq!((sticks.contacts[0].mode, slips.contacts[0].mode), (Mode::Stick, Mode::SlipBackward));
    close("end", motion.state().q.x, reach + 0.5 / omega * (omega * 0.4).sin(), 1e-11);
    close("belt", motion.state().q.z, 0.5 * (free + 0.4), 1e-15);
    // The drive of the belt acts against the friction, while it slips forth, rides, and slips back.
    let mut motion =
        simulate(&scene, Start { t: 0.0, q, input_rates: BeltInputs { x: 0.0, z: 0.5 } }, free + 0.4, 1e-13).unwrap();
    while let Some(state) = motion.advance().unwrap() {
        let loads = motion.loads().unwrap();
        let limit = 0.3 * 2.0 * 9.81;
        let force = if state.contacts[0].mode == Mode::Stick { 50.0 * state.q.x } else { limit };
        close("friction", loads.contacts[0], force, 1e-10);
        close("drive", loads.drives.z, force, 1e-10);
        close("power", loads.drive_power, 0.5 * force, 1e-10);
        assert_eq!(loads.drives.x, 0.0);
    }
    // While it rides its rate is that of the belt, also between the ends of steps.
    let mut motion =
        simulate(&scene, Start { t: 0.0, q, input_rates: BeltInputs { x: 0.0, z: 0.5 } }, free + 0.4, 1e-13).unwrap();
    let times = (1..200).map(|i| stuck + (free - stuck) * f64::from(i) / 200.0);
    for state in motion.at(times) {
        let State { rates, contacts, .. } = state.unwrap();
        assert_eq!((rates.slip, rates.x, contacts[0].mode), (0.0, 0.5, Mode::Stick));
    }
}

#[test]
fn starts_and_motions_that_fail() {
    let beyond = InputError::BeyondStop { scene: "Bouncing", stop: "stop on height", gap: 0.5 };
    assert_eq!(
        simulate(&Bouncing::default(), Start { t: 0.0, q: block(0.75), input_rates: 0.0 }, 1.0, 1e-9).err(),
        Some(beyond.into())
    );
    // A drive through a stop.
    let driven = Driven::default();
    let q = BeltCoordinates { slip: 0.0, x: 0.0, z: 0.0 };
    let mut motion =
        simulate(&driven, Start { t: 0.0, q, input_rates: BeltInputs { x: 0.0, z: 0.5 } }, 9.0, 1e-10).unwrap();
    let named = MotionError::NoContactForces { scene: "Driven", contact: "stop on z" };
    let states: Vec<_> = motion.by_ref().collect();
    let (last, before) = states.split_last().unwrap();
    assert_eq!(*last, Err(named));
    assert!(before.iter().all(Result::is_ok) && motion.next().is_none());
    close("there", motion.t(), 2.0, 1e-12);
}

/// While nothing moves, the motion does not limit the steps; the load is still evaluated often enough.
#[test]
fn a_load_that_swings_frees_the_block_in_time() {
    for (beyond, slowest) in [(1.0001, 3.0), (1.02, 1.0), (1.3, 30.0)] {
        let limit = 0.3 * 2.0 * 9.81;
        for frequency in (0..60).map(|i| slowest * 1.11_f64.powi(i)) {
            let scene = Rocked { push: beyond * limit, omega: frequency, ..Rocked::default() };
            let mut motion = simulate(&scene, Start { t: 0.0, q: block(0.0), input_rates: 0.0 }, 10.0, 1e-10).unwrap();
            let first = motion.by_ref().map(Result::unwrap).find(|state| state.changes().count() > 0).unwrap();
            close("free", first.t * frequency, (1.0_f64 / beyond).asin(), 1e-9);
            assert_eq!(first.contacts[0].mode, Mode::SlipForward);
        }
    }
    let scene = Rocked { push: 0.9999 * 0.3 * 2.0 * 9.81, ..Rocked::default() };
    let mut motion = simulate(&scene, Start { t: 0.0, q: block(0.0), input_rates: 0.0 }, 10.0, 1e-10).unwrap();
    motion.finish(|_, _| true).unwrap();
    println!("{:?}", motion.counts());
    assert_eq!((motion.state().q.x, motion.state().mode("friction on x")), (0.0, Some(Mode::Stick)));
}

/// A block that has stopped is struck and slides back; a resting ball is struck upward, a falling one downward.
#[test]
fn impulses_from_outside() {
    let scene = Sliding::default();
    let brake = 0.3 * 9.81;
    let motion = simulate(&scene, Start { t: 0.0, q: block(0.0), input_rates: 1.7 }, 5.0, 1e-13).unwrap();
    let mut motion = motion
        .events([Crossing::Rising], |state| Ok([state.t - 2.0]), |_, _| Ok(Then::Restart((-1.2).into())))
        .unwrap();
    let events: Vec<_> = motion.by_ref().map(Result::unwrap).filter(|state| state.changes().count() > 0).collect();
    let [stops, struck, again] = events[..] else { panic!("{events:?}") };
    assert_eq!((stops.event, struck.event, again.event), (None, Some(0), None));
    assert_eq!((struck.rates.x, struck.contacts[0].mode), (0.0, Mode::SlipBackward));
    close("time", again.t, 2.0 + 1.2 / brake, 1e-13);
    close("place", motion.state().q.x, 0.5 * (1.7 * 1.7 - 1.2 * 1.2) / brake, 1e-13);
    assert_eq!((motion.state().rates.x, again.contacts[0].change), (0.0, Some(Change::Sticks)));

    let scene = Bouncing { e: 0.0, ..Bouncing::default() };
    for (time, rate, change) in [(1.0, 2.0, Some(Change::LetsGo)), (1.0, -2.0, None), (0.25, -2.0, None)] {
        let motion = simulate(&scene, Start { t: 0.0, q: block(0.25), input_rates: 0.0 }, 3.0, 1e-13).unwrap();
        let mut motion = motion
            .events([Crossing::Rising], |state| Ok([state.t - time]), |_, _| Ok(Then::Restart(rate.into())))
            .unwrap();
        let events: Vec<_> = motion
            .by_ref()
            .map(Result::unwrap)
            .filter(|state| state.event.is_some() || state.changes().count() > 0)
            .collect();
        let struck = events.iter().find(|state| state.event.is_some()).unwrap();
        assert_eq!(struck.contacts[0].change, change, "{events:?}");
        let last = events.last().unwrap();
        let lands = if time < 0.5 {
            let height = 0.75 - 0.5 * 9.81 * time * time;
            time + (rate + (rate * rate + 2.0 * 9.81 * height).sqrt()) / 9.81
        } else if rate > 0.0 {
            time + 2.0 * rate / 9.81
        } else {
            time
        };
        close("lands", last.t, lands, 1e-12);
        assert_eq!((motion.state().rates.x, motion.state().contacts[0].mode), (0.0, Mode::AtLower));
        close("place", motion.state().q.x, -0.5, 1e-15);
    }
}

/// A ball that is let go late, when the time itself has a rounding error: it bounces while a flight is longer than some
/// of these, and then rests.
#[test]
fn a_ball_let_go_late_bounces_and_rests() {
    let scene = Bouncing::default();
    let fall = (2.0 * 0.75 / 9.81_f64).sqrt();
    for start in [0.0, 1.0, 1e3, 1e6, 1e8, 1e10, -1e10] {
        let mut motion = simulate(&scene, Start { t: start, q: block(0.25), input_rates: 0.0 }, start + 4.0, 1e-13)
            .unwrap()
            .most_steps(3000);
        let mut impacts = 0;
        while let Some(state) = motion.advance().unwrap_or_else(|error| panic!("{start:e}: {error}")) {
            impacts += i32::from(state.changes().any(|(_, change)| change == Change::Impact));
        }
        assert_eq!((motion.state().rates.x, motion.state().mode("stop on height")), (0.0, Some(Mode::AtLower)));
        // The last flight lasts 64 rounding errors of the time, or 0.4^20 of the fall.
        let flights = |shortest: f64| (shortest / (2.0 * fall)).ln() / 0.4_f64.ln();
        let expected = flights(64.0 * f64::EPSILON * start.abs()).min(20.0) as i32;
        println!("{start:e}: {impacts} of {expected}");
        assert!((impacts - expected).abs() <= 1, "{start:e}: {impacts} of {expected}");
    }
}
