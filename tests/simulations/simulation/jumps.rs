//! Jumps of the rates of drives: in user functions, in linkages, with fixed steps, with events at the same time; and
//! positions that jump.

use std::f64::consts::PI;

use linkage::integrate::Crossing;
use linkage::simulation::{RealTime, Start, Then, simulate};
use linkage::{Mode, MotionError, Real, linkage, real};

use super::run;

/// |x - 1|, as a user function.
fn corner<T: Real>(x: T) -> (T, T, T) {
    let side = if x < T::one() { -T::one() } else { T::one() };
    (side * (x - T::one()), side, T::zero())
}

/// 0 before 1, then 1/4.
fn ledge<T: Real>(x: T) -> (T, T, T) {
    (if x < T::one() { T::zero() } else { real(0.25) }, T::zero(), T::zero())
}

linkage! {
    /// Two masses on one line, and user functions.
    mechanism Pair {
        param m = 1;
        input x, y;
        extern fn corner(t) -> (bend, bend_rate, bend_acceleration);
        extern fn ledge(t) -> (level, level_rate, level_acceleration);
        body ball { mass m; center (x + y, 0); }
        scene Bent { inertia; drive x = bend(t); }
        scene Lifted { inertia; drive x = level(t); }
        scene Held { inertia; drive x = t; force (-1, 0) at (y, 0); stop y - level(x) in 0..9, restitution 0; }
        scene Rested { inertia; drive x = sin(t) / 2; force (-9, 0) at (y, 0); stop y - x in 0..9, restitution 0; }
        scene Seen { inertia; drive x = abs(t - 1); }
    }
}

fn pair(t: f64, [x, y]: [f64; 2], [x_rate, y_rate]: [f64; 2]) -> Start<f64, PairCoordinates<f64>, PairInputs<f64>> {
    Start { t, q: PairCoordinates { x, y }, input_rates: PairInputs { x: x_rate, y: y_rate } }
}

/// The law of a user function has no expression for its kink: the motion finds it.
#[test]
fn a_kink_in_a_user_function() {
    let scene = Bent::default();
    for tolerance in [1e-4, 1e-12] {
        let (states, error) = run(simulate(&scene, pair(0.0, [1.0, 0.0], [-1.0, 1.0]), 2.0, tolerance).unwrap());
        assert_eq!(error, None);
        let kinks: Vec<_> = states.iter().filter_map(|state| state.kink).collect();
        assert_eq!(kinks, ["x"]);
        let last = states.last().unwrap();
        let errors = [last.q.x - 1.0, last.q.y, last.rates.x - 1.0, last.rates.y + 1.0];
        assert!(errors.iter().all(|error| error.abs() <= 16.0 * f64::EPSILON), "{errors:?}");
    }
}

/// A jump of the position has no rate: the error names the drive and the time.
#[test]
fn a_user_function_that_jumps() {
    let scene = Lifted::default();
    let (states, error) = run(simulate(&scene, pair(0.0, [0.0, 0.0], [0.0, 1.0]), 2.0, 1e-9).unwrap());
    let t = 1.0;
    assert_eq!(error, Some(MotionError::DriveJumps { scene: "Lifted", coordinate: "x", t }));
    let last = states.last().unwrap();
    assert!((last.t - 1.0).abs() <= f64::EPSILON && (last.q.y - 1.0).abs() < 1e-14);
}

/// y rests on a stop whose position jumps: an error, not a motion inside the stop.
#[test]
fn a_stop_that_jumps() {
    let scene = Held::default();
    let (states, error) = run(simulate(&scene, pair(0.0, [0.0, 0.0], [1.0, 0.0]), 2.0, 1e-9).unwrap());
    println!("{error:?} {}", states.len());
    let Some(MotionError::LeftStop { scene: "Held", stop: "stop on y - level(x)", gap, t }) = error else {
        panic!("{error:?}")
    };
    assert!((gap + 0.25).abs() < 1e-12 && (t - 1.0).abs() < 1e-12);
    assert!(states.iter().all(|state| state.q.x < 1.0 && state.q.y.abs() < 1e-14));
}

/// The error of each step moves y away from the stop on which it rests: it is moved back.
#[test]
fn a_rest_without_drift() {
    let scene = Rested::default();
    let (states, error) = run(simulate(&scene, pair(0.0, [0.0, 0.0], [0.5, 0.5]), 500.0, 1e-4).unwrap());
    assert_eq!(error, None);
    let last = states.last().unwrap();
    assert_eq!(last.contacts[0].mode, Mode::AtLower);
    let gap = states.iter().map(|state| (state.q.y - state.q.x).abs()).fold(0.0, f64::max);
    println!("{gap:e} {}", states.len());
    // 16 ulps of the terms of y - x, up to 1/2 each, and of their scales.
    assert!(gap <= 64.0 * f64::EPSILON, "{gap:e}");
}

/// A user's event at the time of the kink, and one on each side of it.
#[test]
fn events_at_a_kink() {
    let scene = Seen::default();
    let motion = simulate(&scene, pair(0.0, [1.0, 0.0], [-1.0, 1.0]), 2.0, 1e-9).unwrap();
    let mut seen = Vec::new();
    let mut motion = motion
        .events(
            [Crossing::Either; 3],
            |state| Ok([state.t - 1.0, state.q.x - 0.25, state.rates.x]),
            |event, state| {
                seen.push((event, state.t, state.rates.y));
                Ok(Then::GoOn)
            },
        )
        .unwrap();
    motion.finish(|_, _| true).unwrap();
    let last = *motion.state();
    println!("{seen:?}");
    let times: Vec<_> = seen.iter().filter(|(event, ..)| *event == 1).map(|(_, t, rate)| (*t, *rate)).collect();
    assert!((times[0].0 - 0.75).abs() < 1e-15 && (times[1].0 - 1.25).abs() < 1e-15 && times.len() == 2, "{times:?}");
    assert!((times[0].1 - 1.0).abs() < 1e-14 && (times[1].1 + 1.0).abs() < 1e-14);
    assert_eq!(seen.iter().filter(|(event, ..)| *event == 0).count(), 1);
    assert!((last.rates.y + 1.0).abs() < 1e-14 && last.q.y.abs() < 1e-14);
}

/// Fixed steps do not end at the kink, but they transmit the impulse.
#[test]
fn fixed_steps() {
    let scene = Seen::default();
    for length in [0.125, 0.07] {
        let mut motion = RealTime::new(&scene, pair(0.0, [1.0, 0.0], [-1.0, 1.0]), length).unwrap();
        while motion.t() < 2.0 - 0.5 * length {
            motion.step().unwrap();
            let state = motion.state().unwrap();
            // The kink may be anywhere in its step.
            assert!((state.rates.x + state.rates.y).abs() < 1e-13, "{state:?}");
            assert!((state.q.x + state.q.y - 1.0).abs() <= 2.0 * length, "{state:?}");
        }
    }
}

linkage! {
    /// A slider on a crank that swings, with a load that hangs on the slider.
    mechanism Crank {
        param r = 0.1, l = 0.3, m = 2, w = 3;
        input phi, load;
        unknown psi, s;
        loop r@phi + l@psi = (s, 0);
        body slider { mass m; center (s, 0); }
        body trolley { mass m; center (s + load, 0); }
        scene Swinging { inertia; drive phi = 0.3 + abs(sin(w * t)); }
        scene Sawing { inertia; drive phi = abs(t - 1); }
    }
}

/// No force acts along s + load, so that its rate stays when the crank turns round.
#[test]
fn a_crank_that_turns_round() {
    let scene = Swinging::default();
    let q = scene.mechanism.solve(&CrankCoordinates { phi: 0.3 + 0.3f64.sin(), load: 0.0, psi: -0.2, s: 0.4 }).unwrap();
    let q = q.coordinates;
    let rate = 3.0 * 0.3f64.cos();
    let start = Start { t: 0.1, q, input_rates: CrankInputs { phi: rate, load: 0.5 } };
    let mut motion = simulate(&scene, start, 5.0, 1e-11).unwrap();
    let first = *motion.state();
    let momentum = first.rates.s + first.rates.load;
    let mut kinks = 0;
    motion
        .finish(|state, _| {
            kinks += usize::from(state.kink.is_some());
            assert!((state.rates.s + state.rates.load - momentum).abs() < 1e-9, "{state:?}");
            let centre = first.q.s + first.q.load + momentum * (state.t - 0.1);
            assert!((state.q.s + state.q.load - centre).abs() < 1e-9, "{state:?}");
            true
        })
        .unwrap();
    assert_eq!(kinks, (15.0 / PI) as usize);
}

/// The crank turns at the dead point of the piston, phi = 0, where s' = 0 on both sides.
#[test]
fn a_kink_at_a_dead_point() {
    let scene = Sawing::default();
    let q = scene.mechanism.solve(&CrankCoordinates { phi: 1.0, load: 0.0, psi: -0.2, s: 0.4 }).unwrap().coordinates;
    let start = Start { t: 0.0, q, input_rates: CrankInputs { phi: -1.0, load: 0.5 } };
    let mut motion = simulate(&scene, start, 2.0, 1e-11).unwrap();
    let first = *motion.state();
    let momentum = first.rates.s + first.rates.load;
    motion.finish(|_, _| true).unwrap();
    let last = motion.state();
    // By symmetry s and its rate are opposite.
    assert!((last.q.s - first.q.s).abs() < 1e-10 && (last.rates.s + first.rates.s).abs() < 1e-10);
    assert!((last.rates.load - (momentum - last.rates.s)).abs() < 1e-9, "{last:?}");
    assert!((last.q.phi - 1.0).abs() < 1e-15);
}

linkage! {
    /// An engine on a cart that turns round, with the crank or the piston as input.
    mechanism Motor {
        param r = 0.1, l = 0.3, m = 1, j = 0.02;
        coordinate cart, s, phi, psi;
        loop r@phi + l@psi = (s, 0);
        body crank { mass m; inertia j; center (cart, 0) + (r/2)@phi; angle phi; }
        body piston { mass m; center (cart + s, 0); }
        drive ByCrank by cart, phi;
        drive ByPiston by cart, s;
        scene Cranked of ByCrank { inertia; drive cart = abs(t - 1); }
        scene Pushed of ByPiston { inertia; drive cart = abs(t - 1); }
    }
}

/// A jump 0.05 rad before the dead point of the piston is the same with the crank and with the piston as input, where the
/// simulation uses other coordinates.
#[test]
fn a_jump_in_other_coordinates() {
    let crank = Cranked::default();
    // The crank is at -0.05 rad at the time of the jump: found backward from there.
    let guess = MotorCoordinates { cart: 0.5, s: 0.4, phi: -0.05 - 3.0 * 0.5, psi: 0.3 };
    let q = crank.mechanism.solve(&guess).unwrap().coordinates;
    let start = Start { t: 0.5, q, input_rates: ByCrankInputs { cart: -1.0, phi: 3.0 } };
    let mut by_crank = simulate(&crank, start, 1.5, 1e-11).unwrap();
    let s_rate = by_crank.state().rates.s;
    let mut before = None;
    by_crank
        .finish(|state, _| {
            before = before.or(state.kink.map(|_| *state));
            true
        })
        .unwrap();
    let before = before.unwrap();
    println!("{before:?}");
    let piston = Pushed::default();
    // From the start, and from just before the jump.
    let t = before.t - 1e-4;
    let mut early = simulate(&crank, start, t, 1e-11).unwrap();
    early.finish(|_, _| true).unwrap();
    let early = *early.state();
    for (t, q, rates) in [(0.5, q, [-1.0, s_rate]), (t, early.q, [-1.0, early.rates.s])] {
        let input_rates = ByPistonInputs { cart: rates[0], s: rates[1] };
        let mut by_piston = simulate(&piston, Start { t, q, input_rates }, 1.5, 1e-11).unwrap();
        by_piston.finish(|_, _| true).unwrap();
        assert!(by_piston.passages().exchanges > 0);
        let (a, b) = (by_crank.state(), by_piston.state());
        println!("{a:?} {b:?}");
        assert!((a.q.phi - b.q.phi).abs() < 1e-8 && (a.rates.phi - b.rates.phi).abs() < 1e-7);
    }
    // The momentum of phi: j' phi' + cart' dG/dphi, with the masses of crank and piston.
    let momentum = |q: &MotorCoordinates<f64>, cart: f64, phi: f64| {
        let (r, l) = (0.1, 0.3);
        let tan = (r * q.phi.sin() / l).asin().tan();
        let slope = -r * q.phi.sin() - r * q.phi.cos() * tan;
        let inertia = 0.02 + r * r / 4.0 + slope * slope;
        inertia * phi + cart * (slope - r / 2.0 * q.phi.sin())
    };
    let mut after = simulate(&crank, start, 1.0 + 1e-9, 1e-11).unwrap();
    after.finish(|_, _| true).unwrap();
    let after = after.state();
    let [a, b] = [momentum(&before.q, -1.0, before.rates.phi), momentum(&after.q, 1.0, after.rates.phi)];
    assert!((a - b).abs() < 1e-9 && (after.rates.phi - before.rates.phi).abs() > 0.1, "{a} {b} {after:?}");
}
