//! Contacts that are shorter than a step.

use linkage::integrate::{Crossing, Dopri5};
use linkage::linkage;
use linkage::simulation::{Start, Then, simulate};

use linkage_oracle::close;

linkage! {
    /// An oscillator and its walls.
    mechanism Oscillator {
        param m = 1, k = 100, upper = 0.0999, e = 1, c = 0;
        input x;
        unknown y;
        equation y = x;
        output half = x / 2;
        body block { mass m; center (x, 0); }
        scene Free { inertia; spring k on x; }
        scene Walled { inertia; spring k on x; stop x in -9..upper, restitution e; }
        scene ByOutput { inertia; spring k on x; stop half in (-upper/2)..(upper/2), restitution e; }
        scene Rough { inertia; spring k on x; friction c on x; stop x in -9..upper, restitution e; }
    }
}

fn at(x: f64) -> OscillatorCoordinates {
    OscillatorCoordinates { x, y: x }
}

/// x = a sin(10 t) with a = 0.1 meets a wall at a (1 - depth), by any tolerance and method, and then both walls or
/// again.
#[test]
fn a_wall_within_the_last_part_of_the_amplitude() {
    let free = Free::default();
    for tolerance in [1e-3, 1e-4, 1e-6, 1e-9, 1e-12] {
        for depth in [0.1_f64, 1e-2, 1e-3, 1e-5, 1e-8] {
            // The error of the motion alone, at this tolerance.
            if depth < 100.0 * tolerance {
                continue;
            }
            let upper = 0.1 * (1.0 - depth);
            let phase = (1.0 - depth).asin();
            let again = [phase, 2.0 * std::f64::consts::PI + 3.0 * phase - std::f64::consts::PI];
            let walls = [phase, 3.0 * phase];
            let bound = tolerance / depth.sqrt() * 100.0;
            let check = |what: &str, found: [f64; 2], exact: [f64; 2]| {
                for (found, exact) in found.into_iter().zip(exact) {
                    close(format_args!("{what} {tolerance:e} {depth:e}"), 10.0 * found, exact, bound);
                }
            };
            let walled = Walled { upper, ..Walled::default() };
            let start = Start { t: 0.0, q: at(0.0), input_rates: 1.0 };
            let motion = simulate(&walled, start, 2.0, tolerance).unwrap();
            let mut hits = motion.map(Result::unwrap).filter(|state| state.changes().count() > 0).map(|state| state.t);
            check("stop", [hits.next().unwrap(), hits.next().unwrap()], again);
            let motion = simulate(&walled, start, 2.0, tolerance).unwrap().method::<Dopri5>().unwrap();
            let mut hits = motion.map(Result::unwrap).filter(|state| state.changes().count() > 0).map(|state| state.t);
            check("order 5", [hits.next().unwrap(), hits.next().unwrap()], again);
            let output = ByOutput { upper, ..ByOutput::default() };
            let motion = simulate(&output, start, 2.0, tolerance).unwrap();
            let mut hits = motion.map(Result::unwrap).filter(|state| state.changes().count() > 0).map(|state| state.t);
            check("output", [hits.next().unwrap(), hits.next().unwrap()], walls);
            // With a friction coefficient of zero: margins next to the gap have no known rates.
            let rough = Rough { upper, ..Rough::default() };
            let motion = simulate(&rough, start, 2.0, tolerance).unwrap();
            let mut hits = motion
                .map(Result::unwrap)
                .filter(|state| state.changes().any(|(name, _)| name == "stop on x"))
                .map(|state| state.t);
            check("rough", [hits.next().unwrap(), hits.next().unwrap()], again);
            // A user event at the same place: in and out.
            let motion = simulate(&free, start, 2.0, tolerance).unwrap();
            let motion =
                motion.events([Crossing::Either], |state| Ok([state.q.x - upper]), |_, _| Ok(Then::GoOn)).unwrap();
            let mut hits = motion.map(Result::unwrap).filter(|state| state.event.is_some()).map(|state| state.t);
            check("event", [hits.next().unwrap(), hits.next().unwrap()], [phase, std::f64::consts::PI - phase]);
        }
    }
}

/// If the amplitude is just less than the distance of the wall, nothing happens.
#[test]
fn a_wall_beyond_the_amplitude_is_not_met() {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let walled = Walled { upper: 0.1 * (1.0 + 1000.0 * tolerance), ..Walled::default() };
        let motion = simulate(&walled, Start { t: 0.0, q: at(0.0), input_rates: 1.0 }, 5.0, tolerance).unwrap();
        assert!(motion.map(Result::unwrap).all(|state| state.changes().count() == 0));
    }
}
