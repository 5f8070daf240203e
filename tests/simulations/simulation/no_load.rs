//! Stops and frictions that carry no load: a part that hits its stop or rests on it keeps its position.

use linkage::contact::Change;
use linkage::simulation::{Start, State, simulate};
use linkage::{Mode, linkage};

use linkage_oracle::close;

linkage! {
    /// A block on a frictionless table.
    mechanism Slider {
        param m = 1, f = 0, omega = 1, lower = -1, upper = 1, e = 0, mu = 0;
        input x;
        unknown y;
        equation y = x;
        output double = 2 * x;
        body block { mass m; center (x, 0); }
        scene Loaded { inertia; torque f on x; stop x in lower..upper, restitution e; }
        scene Twice {
            inertia;
            torque f on x;
            stop x in lower..upper, restitution e;
            stop double in 2*lower..2*upper, restitution e;
        }
        scene Pulled { inertia; torque f * cos(omega * t) on x; stop x in lower..upper, restitution e; }
        scene Eased { inertia; torque -f * (1 - cos(omega * t)) on x; stop x in lower..upper, restitution e; }
        scene Rubbed { inertia; torque f on x; friction mu, m on x; stop double in 2*lower..2*upper, restitution e; }
    }
}

linkage! {
    /// Two blocks that meet, and the stop between them.
    mechanism Pair {
        param m1 = 1, m2 = 3, far = 100, e = 0, g = 0;
        input a, b;
        unknown gap;
        equation gap = b - a;
        body first { mass m1; center (a, 0); }
        body second { mass m2; center (b, 0); }
        scene Colliding { inertia; torque m1 * g on a; torque m2 * g on b; stop gap in 0..far, restitution e; }
    }
}

linkage! {
    /// Three blocks in a row.
    mechanism Row {
        param m1 = 1, m2 = 2, m3 = 3, far = 100, e = 0;
        input a, b, c;
        unknown left, right;
        equation left = b - a;
        equation right = c - b;
        body first { mass m1; center (a, 0); }
        body second { mass m2; center (b, 0); }
        body third { mass m3; center (c, 0); }
        scene Meeting { inertia; stop left in 0..far, restitution e; stop right in 0..far, restitution e; }
    }
}

fn at(x: f64) -> SliderCoordinates {
    SliderCoordinates { x, y: x }
}

#[test]
fn a_part_that_hits_a_stop_without_load_rests_there() {
    for scale in [1.0, 2.0_f64.powi(-60), 2.0_f64.powi(60)] {
        for tolerance in [1e-4, 1e-9, 1e-13] {
            let scene = Loaded { lower: -scale, upper: scale, ..Loaded::default() };
            let mut motion = simulate(&scene, Start { t: 0.0, q: at(0.0), input_rates: scale }, 10.0, tolerance)
                .unwrap()
                .most_steps(200);
            let events: Vec<_> = motion.by_ref().map(Result::unwrap).filter(|s| s.changes().count() > 0).collect();
            let [hit] = events[..] else { panic!("{events:?}") };
            assert_eq!(hit.changes().collect::<Vec<_>>(), [("stop on x", Change::Rests)]);
            close("time", hit.t, 1.0, 1e-14);
            let State { t, q, rates, .. } = *motion.state();
            assert_eq!((t, q.x, rates.x), (10.0, hit.q.x, 0.0));
            close("place", q.x / scale, 1.0, 1e-15);
            assert_eq!(motion.state().mode("stop on x"), Some(Mode::AtUpper));
            assert!(motion.counts().accepted < 100, "{:?}", motion.counts());
        }
    }
}

/// After a plastic collision the two move together, at the rate of their momentum.
#[test]
fn two_free_blocks_stay_together() {
    for (scale, g) in [(1.0, 0.0), (1.0, 9.81), (2.0_f64.powi(40), 0.0), (2.0_f64.powi(-40), 1e-14)] {
        for (e, [first, second]) in [(0.0, [0.25, 0.25]), (0.5, [-0.125, 0.375])] {
            let scene = Colliding { e, g, far: 100.0 * scale, ..Colliding::default() };
            let q = PairCoordinates { gap: scale, a: 0.0, b: scale };
            let start = Start { t: 0.0, q, input_rates: PairInputs { a: scale, b: 0.0 } };
            let mut motion = simulate(&scene, start, 10.0, 1e-10).unwrap().most_steps(400);
            let events: Vec<_> = motion.by_ref().map(Result::unwrap).filter(|s| s.changes().count() > 0).collect();
            let [hit] = events[..] else { panic!("{events:?}") };
            let what = if e > 0.0 { Change::Impact } else { Change::Rests };
            assert_eq!(hit.changes().collect::<Vec<_>>(), [("stop on gap", what)]);
            close("time", hit.t, 1.0, 1e-13);
            let State { q, rates, .. } = *motion.state();
            let fallen = 0.5 * g * 100.0 / scale;
            close("first", q.a / scale, 1.0 + 9.0 * first + fallen, 1e-13 * (1.0 + fallen));
            close("second", q.b / scale, 1.0 + 9.0 * second + fallen, 1e-13 * (1.0 + fallen));
            if e == 0.0 {
                assert_eq!((rates.gap, motion.state().mode("stop on gap")), (0.0, Some(Mode::AtLower)));
            }
        }
    }
}

/// Both gaps close at once, or one after the other.
#[test]
fn three_free_blocks_stay_together() {
    for (places, rates) in [([-1.0, 0.0, 1.0], [1.0, 0.0, -1.0]), ([-1.0, 0.0, 1.0], [1.0, 0.0, -0.25])] {
        let scene = Meeting::default();
        let [a, b, c] = places;
        let q = RowCoordinates { left: b - a, right: c - b, a, b, c };
        let momentum = rates[0] + 2.0 * rates[1] + 3.0 * rates[2];
        let input_rates = RowInputs { a: rates[0], b: rates[1], c: rates[2] };
        let start = Start { t: 0.0, q, input_rates };
        let mut motion = simulate(&scene, start, 10.0, 1e-10).unwrap().most_steps(400);
        motion.finish(|_, _| true).unwrap();
        let State { rates, .. } = *motion.state();
        close("a", rates.a, momentum / 6.0, 1e-14);
        close("b", rates.b, momentum / 6.0, 1e-14);
        close("c", rates.c, momentum / 6.0, 1e-14);
        assert_eq!(motion.state().contacts.map(|touch| touch.mode), [Mode::AtLower; 2]);
    }
}

/// A stop declared twice, and a friction whose normal load is zero.
#[test]
fn redundant_stops_and_frictions_without_load_hold() {
    let scene = Twice::default();
    let mut motion =
        simulate(&scene, Start { t: 0.0, q: at(0.0), input_rates: 1.0 }, 10.0, 1e-9).unwrap().most_steps(200);
    motion.finish(|_, _| true).unwrap();
    close("place", motion.state().q.x, 1.0, 1e-15);
    assert_eq!(motion.state().rates.x, 0.0);
    assert_eq!(motion.state().contacts.map(|t| t.mode), [Mode::AtUpper; 2]);
    for (rate, stays) in [(1.0, false), (0.0, true)] {
        let scene = Rubbed::default();
        let mut motion =
            simulate(&scene, Start { t: 0.0, q: at(0.0), input_rates: rate }, 10.0, 1e-9).unwrap().most_steps(200);
        motion.finish(|_, _| true).unwrap();
        close("place", motion.state().q.x, if stays { 0.0 } else { 1.0 }, 1e-15);
        assert_eq!((motion.state().rates.x, motion.state().mode("friction on x")), (0.0, Some(Mode::Stick)));
    }
}

/// A load of any size and either sign, on a part that has hit its stop and on one that rests there.
#[test]
fn tiny_loads_hold_or_free() {
    for size in [5e-324, 1e-300, 1e-100, 1e-40, 1e-20, 1e-16, 1e-12, 1e-8] {
        for (f, start) in [(size, 0.0), (-size, 0.0), (size, 1.0), (-size, 1.0)] {
            let scene = Loaded { f, ..Loaded::default() };
            let rate = 1.0 - start;
            let mut motion = simulate(&scene, Start { t: 0.0, q: at(start), input_rates: rate }, 10.0, 1e-9)
                .unwrap()
                .most_steps(400);
            motion.finish(|_, _| true).unwrap_or_else(|error| panic!("{f:e} from {start}: {error}"));
            let State { q, .. } = *motion.state();
            // From t = 1, or 0, at rest.
            let time = 10.0 - rate;
            let fallen = if f < 0.0 { 0.5 * f * time * time } else { 0.0 };
            close("place", q.x, 1.0 + fallen, 1e-15 + 1e-7 * fallen.abs());
            if f > 0.0 {
                assert_eq!(motion.state().mode("stop on x"), Some(Mode::AtUpper), "{f:e} from {start}");
            }
        }
    }
}

/// x'' = cos t: it is held until pi/2, then x = 1 - cos t - (t - pi/2); on the other side it is held until 3 pi/2.
#[test]
fn a_load_that_passes_zero_frees_and_comes_back() {
    use std::f64::consts::{FRAC_PI_2, PI};
    for e in [0.0, 0.0625] {
        let scene = Pulled { f: 1.0, e, ..Pulled::default() };
        let mut motion =
            simulate(&scene, Start { t: 0.0, q: at(1.0), input_rates: 0.0 }, 5.0, 1e-12).unwrap().most_steps(2000);
        let mut freed = Vec::new();
        while let Some(state) = motion.advance().unwrap() {
            freed.extend(state.changes().filter(|change| change.1 == Change::LetsGo).map(|_| state.t));
        }
        close("freed", freed[0], FRAC_PI_2, 1e-11);
        if e == 0.0 {
            let [_, back] = freed[..] else { panic!("{freed:?}") };
            close("back", back, 3.0 * FRAC_PI_2, 1e-11);
            let end = -1.0 - 5.0_f64.cos() + (5.0 - 3.0 * FRAC_PI_2);
            close("place", motion.state().q.x, end, 1e-11);
        }
    }
    // A load that touches zero: the part stays.
    for omega in [1.0, PI, 20.0] {
        let scene = Eased { f: 1.0, omega, ..Eased::default() };
        for (place, rate) in [(-1.0, 0.0), (0.0, -0.5)] {
            let mut motion = simulate(&scene, Start { t: 0.0, q: at(place), input_rates: rate }, 20.0, 1e-9)
                .unwrap()
                .most_steps(20_000);
            motion.finish(|_, _| true).unwrap();
            close("place", motion.state().q.x, -1.0, 1e-13);
        }
    }
}
