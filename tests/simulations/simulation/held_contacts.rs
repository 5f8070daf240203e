//! Contacts that are held: they are released once, where their force exceeds its limit.

use linkage::contact::Change;
use linkage::simulation::{Start, simulate};
use linkage::{Mode, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_oracle::close;

linkage! {
    /// A block, and one on top of it, on a belt that moves to and fro.
    mechanism Belt {
        param m = 1, n = 1, g = 9.81, mu = 0.31, nu = 0.2, a = 0.13, w = 7.8, k = 0;
        input d, x, z;
        body block { mass m; center (x, 0); }
        body top { mass n; center (z, 0); }
        scene Stacked {
            inertia;
            drive d = a * sin(w * t);
            spring k on x;
            friction mu, (m + n) * g on x - d;
            friction nu, n * g on z - x;
        }
    }
}

linkage! {
    /// Three blocks in a row between two walls, in relative coordinates.
    mechanism Blocks {
        param m1 = 3, m2 = 3, m3 = 3, slope = 0, push = 0, w = 3, f1 = 5, f2 = 4, f3 = 0, wide = 0.07, length = 2.14, e = 0.5, e2 = 0;
        input x, u, v;
        body first { mass m1; center (x, 0); }
        body second { mass m2; center (x + u, 0); }
        body third { mass m3; center (x + u + v, 0); }
        scene Row {
            inertia;
            gravity (slope, -9.81);
            torque push * sin(w * t) on x;
            friction f1, 1 on x;
            friction f2, 1 on x + u;
            friction f3, 1 on x + u + v;
            stop x in 0..9, restitution e2;
            stop u in wide..9, restitution e;
            stop v in wide..9, restitution e;
            stop x + u + v in 0..length, restitution e2;
        }
    }
}

fn carried(scene: &Stacked<f64>) -> Start<f64, BeltCoordinates<f64>, BeltInputs<f64>> {
    let rate = scene.a * scene.w;
    Start {
        t: 0.0,
        q: BeltCoordinates { d: 0.0, x: 0.0, z: 0.0 },
        input_rates: BeltInputs { d: rate, x: rate, z: rate },
    }
}

/// Without the upper block's slip, slip begins where a w^2 sin(w t) = mu g.
#[test]
fn a_block_slips_where_the_belt_brakes_harder_than_friction() {
    for (mu, a, w) in [(0.31, 0.13, 7.8), (0.0447, 0.0447, 12.504_272), (0.8, 0.1, 20.0)] {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let scene = Stacked { mu, nu: 5.0, a, w, ..Stacked::default() };
            let mut motion = simulate(&scene, carried(&scene), 5.0, tolerance).unwrap();
            let first = motion.by_ref().map(Result::unwrap).find(|state| state.changes().count() > 0).unwrap();
            let exact = (mu * scene.g / (a * w * w)).asin() / w;
            close("time", first.t, exact, 1e-12);
            assert_eq!(first.changes().collect::<Vec<_>>(), [("friction on x - d", Change::Slips)]);
            motion.finish(|_, _| true).unwrap();
        }
    }
}

/// Sticking ends once: no event repeats, in steps as long as without friction.
#[test]
fn stacks_of_two_on_belts_do_not_repeat_events() {
    let mut random = SmallRng::seed_from_u64(5);
    let mut between = |least: f64, most: f64| random.random_range(least.ln()..most.ln()).exp();
    for trial in 0..linkage_trials::count("STACKS", 20, if cfg!(debug_assertions) { 60 } else { 1000 }) {
        let scene = Stacked {
            m: between(0.01, 100.0),
            n: between(0.01, 100.0),
            mu: between(0.05, 0.9),
            nu: between(0.05, 0.9),
            a: between(0.01, 1.0),
            w: between(0.5, 30.0),
            k: between(0.1, 1000.0),
            ..Stacked::default()
        };
        let tolerance = between(1e-12, 1e-4);
        let mut motion = simulate(&scene, carried(&scene), 2.0, tolerance).unwrap().most_steps(20_000);
        if let Err(error) = motion.finish(|_, _| true) {
            let Stacked { m, n, mu, nu, a, w, k, .. } = scene;
            panic!("{trial}: {:?} {tolerance:e}: {error}", [m, n, mu, nu, a, w, k]);
        }
    }
}

/// One block rests on a wall and by friction, another slides alone and stops after 0.2 / (4/3) s: in relative
/// coordinates its force on the first is a difference that is zero within rounding error.
#[test]
fn a_block_at_rest_on_a_wall_and_by_friction() {
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let scene = Row::default();
        let q = BlocksCoordinates { x: 0.0, u: 0.195, v: 0.07 };
        let start = Start { t: 0.3, q, input_rates: BlocksInputs { x: 0.0, u: -0.2, v: 0.2 } };
        let mut motion = simulate(&scene, start, 2.5, tolerance).unwrap();
        let changes: Vec<_> = motion.by_ref().map(Result::unwrap).filter(|state| state.changes().count() > 0).collect();
        let [stop] = changes[..] else { panic!("{changes:?}") };
        close("time", stop.t, 0.45, 1e-12);
        assert_eq!(stop.changes().collect::<Vec<_>>(), [("friction on x + u", Change::Sticks)]);
    }
}

/// Two blocks touch at rest without load, while a third one sticks and is pushed.
#[test]
fn blocks_that_touch_without_load_stay() {
    let scene = Row {
        m1: 0.2,
        m2: 1.5,
        m3: 2.2,
        push: 9.0,
        w: 10.0,
        f1: 2.0,
        f2: 3.0,
        f3: 5.0,
        wide: 0.2,
        length: 1.0,
        e: 1.0,
        e2: 1.0,
        ..Row::default()
    };
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let q = BlocksCoordinates { x: 0.0, u: 0.3875, v: 0.2 };
        let start = Start { t: 1.1, q, input_rates: BlocksInputs { x: 1.7, u: -1.7, v: 0.0 } };
        let motion = simulate(&scene, start, 1.8, tolerance).unwrap();
        let slips: Vec<_> = motion
            .map(Result::unwrap)
            .filter(|state| state.changes().any(|(_, change)| change == Change::Slips))
            .map(|state| state.t)
            .collect();
        // Sticks at 1.263117018 until 1.279046370, computed independently.
        let released = slips.iter().find(|t| **t > 1.27).unwrap();
        close("time", *released, 1.27904637, 1e-7);
    }
}

/// A block without load at its wall, e = 1, stays there while another one slides and sticks after 1.6 / (3 / 1.1) s.
#[test]
fn a_block_that_touches_its_wall_stays() {
    let scene =
        Row { m1: 1.1, m2: 1.1, m3: 1.1, push: -1.0, w: 2.0, f1: 4.0, f2: 4.0, f3: 3.0, wide: 0.09, ..Row::default() };
    let scene = Row { length: 1.68, e: 1.0, e2: 1.0, ..scene };
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let q = BlocksCoordinates { x: 0.0, u: 0.465, v: 0.09 };
        let start = Start { t: 1.6, q, input_rates: BlocksInputs { x: 0.0, u: 0.0, v: 1.6 } };
        let mut motion = simulate(&scene, start, 2.6, tolerance).unwrap();
        let changes: Vec<_> = motion.by_ref().map(Result::unwrap).filter(|state| state.changes().count() > 0).collect();
        let [stop] = changes[..] else { panic!("{changes:?}") };
        close("time", stop.t, 1.6 + 1.6 / (3.0 / 1.1), 1e-12);
    }
}

/// A block strikes a wall and another block in turn, at times that converge to 2.355019094, computed independently; the
/// rates do not decrease as fast as the intervals. Both come to rest at the wall, and the first block strikes them later.
#[test]
fn a_block_rattles_between_a_wall_and_another_block() {
    let scene = Row {
        m1: 1.2028275711743752,
        m2: 2.971840949736214,
        m3: 0.8068673006313254,
        slope: 1.089807312002332,
        f1: 0.0,
        f2: 0.0,
        f3: 3.4637754254078272,
        wide: 0.0618258814230281,
        length: 0.6700006013032754,
        e: 0.056295572423356414,
        e2: 0.5389792264108847,
        ..Row::default()
    };
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let q = BlocksCoordinates { x: 0.12243545335605716, u: 0.20586322737682933, v: 0.19035085850627742 };
        let rates = [1.9885047979789796, 0.0, 1.1666237096981273];
        let input_rates = BlocksInputs { x: rates[0], u: rates[1] - rates[0], v: rates[2] - rates[1] };
        let start = Start { t: 1.9573271132775982, q, input_rates };
        let mut motion = simulate(&scene, start, 3.588997967962249, tolerance).unwrap();
        let mut rest = None;
        motion
            .finish(|state, _| {
                if rest.is_none() && state.changes().any(|(_, change)| change == Change::Rests) {
                    rest = Some(state.t);
                }
                true
            })
            .unwrap();
        close("rest", rest.unwrap(), 2.355019094, 1e-9);
        let state = motion.state();
        assert!([state.rates.x, state.rates.u, state.rates.v].iter().all(|rate| rate.abs() < 1e-14), "{state:?}");
        let places = [state.q.u, state.q.v, state.q.x + state.q.u + state.q.v];
        for (place, exact) in places.into_iter().zip([scene.wide, scene.wide, scene.length]) {
            close("place", place, exact, 10.0 * tolerance);
        }
    }
}

/// A block bounces on another one to rest, pressed by the friction of that one alone: without friction all blocks on
/// the slope have one acceleration.
#[test]
fn bouncing_ends_where_friction_alone_presses() {
    let scene = Row {
        m1: 2.4600941846111373,
        m2: 1.7182615158969967,
        m3: 0.766172208819101,
        slope: -2.5023201134878015,
        f1: 0.7263102445765843,
        f2: 4.2617260196255735,
        f3: 0.0,
        wide: 0.09716801234770353,
        length: 1.4501605209396689,
        e: 0.359664283883547,
        e2: 0.8191452374481039,
        ..Row::default()
    };
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let q = BlocksCoordinates { x: 0.0, u: 0.5267408169332928, v: 0.3936303852945754 };
        let rates = [-0.49110800746367556, -1.0591108461078447, -0.09759883275015557];
        let input_rates = BlocksInputs { x: rates[0], u: rates[1] - rates[0], v: rates[2] - rates[1] };
        let start = Start { t: 1.0766302807710302, q, input_rates };
        let mut motion = simulate(&scene, start, 2.3253427474656205, tolerance).unwrap().most_steps(1000);
        motion.finish(|_, _| true).unwrap();
    }
}

linkage! {
    /// A slider-crank with friction on its slider and a torque on its crank.
    mechanism SliderCrank {
        param r = 0.38, l = 1, j = 0.26, m = 1, turn = 5, f = 4;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, 0);
        body crank { inertia j; angle phi; }
        body slider { mass m; center (s, 0); }
        scene Pushed { inertia; torque turn on phi; friction f, 1 on s; }
    }
}

/// At rest at its dead centre no friction on the slider holds the crank, and the slider moves with s'' = 0 first. It was
/// held there, in steps that shrank to nothing. The energy is the work of the torque less that of friction.
#[test]
fn a_crank_starts_at_its_dead_centre() {
    for turn in [5.0, -5.0] {
        for tolerance in [1e-6, 1e-9, 1e-11] {
            let scene = Pushed { turn, ..Pushed::default() };
            let start = Start { t: 0.0, q: SliderCrankCoordinates { phi: 0.0, psi: 0.0, s: 1.38 }, input_rates: 0.0 };
            let mut motion = simulate(&scene, start, 0.3, tolerance).unwrap();
            assert_eq!(motion.state().contacts[0].mode, Mode::SlipBackward);
            motion.finish(|_, _| true).unwrap();
            let (q, rates) = (motion.state().q, motion.state().rates);
            let kinetic = 0.5 * (scene.j * rates.phi * rates.phi + scene.m * rates.s * rates.s);
            close("energy", kinetic, turn * q.phi - scene.f * (1.38 - q.s), 1e3 * tolerance);
            assert!(q.phi * turn > 0.5, "{q:?}");
        }
    }
}

/// The first of three blocks slips while the others rest without load: their margins are rounding errors relative to
/// the load, push sin(w t) - f1, and have a corner where it passes zero. m x'' = push sin(w t) - f1 throughout.
#[test]
fn blocks_at_rest_without_load_do_not_shorten_steps() {
    let (t, end, w, push) = (0.6_f64, 0.85, 4.0_f64, 13.6);
    let masses: &[f64] = if linkage_trials::is_outer() { &[2.6, 2.7, 2.8] } else { &[2.7] };
    for &m1 in masses {
        for [f1, f2, f3] in [[1.8, 0.3, 0.0], [1.8, 0.0, 0.3], [1.8, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.0]] {
            let scene = Row { m1, m2: 1.4, m3: 1.5, push, w, f1, f2, f3, wide: 0.125, ..Row::default() };
            let q = BlocksCoordinates { x: 0.2, u: 0.35, v: 0.125 };
            let start = Start { t, q, input_rates: BlocksInputs { x: 0.0, u: 0.0, v: 0.0 } };
            let passed = end - t;
            let turned = |part: f64| push / w * ((w * t).cos() * passed + part);
            let exact = 0.2 + (turned(((w * t).sin() - (w * end).sin()) / w) - 0.5 * f1 * passed * passed) / m1;
            for tolerance in [1e-6, 1e-9, 1e-11] {
                let mut motion = simulate(&scene, start, end, tolerance).unwrap().most_steps(60);
                motion.finish(|_, _| true).unwrap_or_else(|error| panic!("{f1} {f2} {f3} at {tolerance:e}: {error}"));
                let state = motion.state();
                close("x", state.q.x, exact, tolerance);
                close("x + u", state.q.x + state.q.u, 0.55, 1e-15);
            }
        }
    }
}
