//! Lengths, masses, times, tolerances and intervals of any size.

use linkage::simulation::{Simulation, Start, simulate};
use linkage::{MotionError, linkage};

linkage! {
    /// A crank that swings under gravity and draws a slider against a spring.
    #[derive(Debug, Clone)]
    mechanism Swing {
        param r = 1, l = 3, m = 2, k = 1, g = 1, low = 2.5, e = 1;
        input theta;
        unknown phi, z;
        loop r@theta + l@phi = (z, 0);
        body crank { mass m; center (r/2)@theta; }
        body slider { mass m; center (z, 0); }
        scene Swinging { inertia; gravity (0, -g); spring k on z; }
        scene Stopped { inertia; gravity (0, -g); spring k on z; stop z in low..9*low, restitution e; }
    }
}

linkage! {
    /// A block without forces.
    mechanism Loose {
        param m = 1, g = 0, omega = 1, k = 0;
        input x;
        unknown y;
        equation y = x;
        body block { mass m; center (x, 0); }
        scene Drifting { inertia; torque m * g on x; }
        scene Shaken { inertia; torque m * g * sin(omega * t) on x; }
        scene Tied { inertia; spring k on x; torque m * g on x; }
    }
}

fn swing(scale: f64) -> SwingCoordinates {
    SwingCoordinates { theta: 0.5, phi: -0.16, z: 3.8 * scale }
}

fn loose(x: f64) -> LooseCoordinates {
    LooseCoordinates { x, y: x }
}

/// A motion of 8 s in units of its own: of each step the time, the angle, the coordinate of the slider.
fn shown<S>(motion: Simulation<'_, S>, [length, time]: [f64; 2]) -> Vec<[f64; 3]>
where
    S: linkage::Scene<Scalar = f64, Mechanism = Swing<f64>>,
{
    motion.map(Result::unwrap).map(|state| [state.t / time, state.q.theta, state.q.z / length]).collect()
}

/// Units that are powers of two change no bit.
#[test]
fn units_change_no_bit() {
    let run = |[length, mass, time]: [f64; 3], e: Option<f64>| {
        let (g, k) = (length / time / time, mass / time / time);
        let mechanism = Swing { r: length, l: 3.0 * length };
        let start = Start { t: 0.0, q: swing(length), input_rates: 0.25 / time };
        let Some(e) = e else {
            let scene = Swinging { mechanism, m: 2.0 * mass, g, k };
            return shown(simulate(&scene, start, 8.0 * time, 1e-9).unwrap(), [length, time]);
        };
        let scene = Stopped { mechanism, m: 2.0 * mass, g, k, low: 2.5 * length, e };
        shown(simulate(&scene, start, 8.0 * time, 1e-9).unwrap(), [length, time])
    };
    for e in [None, Some(0.5), Some(0.0)] {
        let expected = run([1.0; 3], e);
        assert!(expected.len() > 5, "{expected:?}");
        for [length, mass, time] in [
            [0, 0, 500],
            [0, 0, -250],
            [400, -800, 0],
            [-400, 800, 0],
            [0, 900, 0],
            [0, -900, 0],
            [200, 100, 300],
            [-200, 300, 200],
            [300, -400, -100],
        ] {
            let found = run([length, mass, time].map(|power| 2.0_f64.powi(power)), e);
            assert_eq!(found, expected, "{length} {mass} {time} {e:?}");
        }
    }
}

/// Intervals in which hardly anything changes, and ones far too long for the number of steps.
#[test]
fn intervals_of_any_length() {
    for g in [1e-300, 1e-200, 1e-160, 1e-100, 1e-30, 0.0] {
        for end in [1e-300, 1.0, 1e100] {
            let scene = Drifting { g, ..Drifting::default() };
            let mut motion = simulate(&scene, Start { t: 0.0, q: loose(1.0), input_rates: 0.0 }, end, 1e-9).unwrap();
            motion.finish(|_, _| true).unwrap_or_else(|error| panic!("{g:e} {end:e} {error}"));
            let exact = 1.0 + 0.5 * g * end * end;
            assert!((motion.state().q.x - exact).abs() <= 1e-12 * exact, "{g:e} {end:e}");
        }
    }
    for end in [1e10, 1e30, 1e150, 1e300] {
        // The first steps are short relative to the interval, for any start time.
        for (x, rate) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let drifting = Drifting::default();
            let mut motion = simulate(&drifting, Start { t: 0.0, q: loose(x), input_rates: rate }, end, 1e-9).unwrap();
            motion.finish(|_, _| true).unwrap();
            assert!((motion.state().q.x - (x + rate * end)).abs() <= 1e-12 * end * rate, "{end:e}");
            let ends = |result: Result<(), MotionError>, t: f64| {
                let Err(MotionError::TooManySteps { .. }) = result else { panic!("{end:e} {x} {rate}: {result:?}") };
                assert!(t > 10.0 && t < 1e6, "{end:e} {x} {rate}: {t:e}");
            };
            let shaken = Shaken { g: 1.0, ..Shaken::default() };
            let mut motion = simulate(&shaken, Start { t: 0.0, q: loose(x), input_rates: rate }, end, 1e-9)
                .unwrap()
                .most_steps(1500);
            let result = motion.finish(|_, _| true);
            ends(result, motion.t());
            let bound = Tied { k: 1.0, g: 0.5, ..Tied::default() };
            let mut motion =
                simulate(&bound, Start { t: 0.0, q: loose(x), input_rates: rate }, end, 1e-9).unwrap().most_steps(1500);
            let result = motion.finish(|_, _| true);
            ends(result, motion.t());
            let swinging = Swinging::default();
            let mut motion = simulate(&swinging, Start { t: 0.0, q: swing(1.0), input_rates: rate }, end, 1e-9)
                .unwrap()
                .most_steps(1500);
            let result = motion.finish(|_, _| true);
            ends(result, motion.t());
        }
    }
}

/// Every tolerance that is allowed gives a state or an error, and never NaN.
#[test]
fn tolerances_of_any_size() {
    for tolerance in [1.0, 0.1, 1e-3, 1e-6, 1e-12, 2.3e-15] {
        for [length, mass, time] in [[1.0, 1.0, 1.0], [1e-60, 1e80, 1e-50], [1e70, 1e-100, 1e100]] {
            let (g, k) = (length / time / time, mass / time / time);
            let scene = Swinging { mechanism: Swing { r: length, l: 3.0 * length }, m: 2.0 * mass, g, k };
            let mut motion =
                simulate(&scene, Start { t: 0.0, q: swing(length), input_rates: 0.0 }, time, tolerance).unwrap();
            motion.finish(|_, _| true).unwrap_or_else(|error| panic!("{tolerance:e} {length:e}: {error}"));
        }
    }
}
