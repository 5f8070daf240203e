//! Kinks of laws: the motion on both sides, the impulse of a drive whose rate jumps, and laws that have no motion.

use linkage::contact::Change;
use linkage::simulation::{Start, simulate};
use linkage::{InputError, Kink, Mode, MotionError, Scene, linkage};

use super::run;

linkage! {
    /// Two masses on one line: x moves the first, and y both.
    mechanism Line {
        param m = 1;
        input x, y;
        body ball { mass m; center (x + y, 0); }
        scene Turned { inertia; drive x = abs(t - 1); }
        scene Rooted { inertia; drive x = sqrt((t - 1)^2); }
        scene Both { inertia; drive x = abs(t - 1); drive y = abs(t - 1) / 2; }
        scene Leaping { inertia; drive x = atan2(sin(t), cos(t)); }
        scene Gathering { inertia; drive x = t^2 * abs(sin(1 / t)); }
    }
}

/// Each kink has its effect and the expression that changes its sign there; smooth laws have none.
#[test]
fn the_kinks_of_a_scene() {
    let kink = |effect, is_timed| Kink { effect, is_timed };
    assert_eq!(<Turned as Scene>::KINKS, [kink("drive x", true)]);
    assert_eq!(<Rooted as Scene>::KINKS, [kink("drive x", true)]);
    // One expression, in both drives.
    assert_eq!(<Both as Scene>::KINKS, [kink("drive x", true)]);
    assert_eq!(<Leaping as Scene>::KINKS, [kink("drive x", true)]);
    assert_eq!(<Bouncing as Scene>::KINKS, [kink("potential k*abs(y)", false)]);
    assert_eq!(<Damped as Scene>::KINKS, [kink("force at a point", false)]);
    assert_eq!(<Taut as Scene>::KINKS.len(), 1);
    assert!(<Smooth as Scene>::KINKS.is_empty());
    let (q, rates) = (BallCoordinates { y: 0.5, z: 0.25 }, BallRates { y: -3.0, z: 7.0 });
    assert_eq!([Bouncing::default().kink(0, 1.0, &q, &rates), Damped::default().kink(0, 1.0, &q, &rates)], [0.5, -3.0]);
}

/// The drive turns round, and no force acts on y: m (x' + y') stays.
#[test]
fn the_rate_of_a_drive_jumps() {
    let scene = Turned::default();
    let q = LineCoordinates { x: 1.0, y: 0.0 };
    let input_rates = LineInputs { x: -1.0, y: 1.0 };
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        let motion = simulate(&scene, Start { t: 0.0, q, input_rates }, 2.0, tolerance).unwrap();
        let (states, error) = run(motion);
        assert_eq!(error, None);
        let kinks: Vec<_> = states.iter().filter(|state| state.kink.is_some()).collect();
        assert_eq!(kinks.len(), 1);
        assert_eq!(kinks[0].kink, Some("drive x"));
        // The rates before it, at the last time before it.
        assert!((kinks[0].t - 1.0).abs() <= f64::EPSILON && kinks[0].rates.x == -1.0, "{:?}", kinks[0]);
        let last = states.last().unwrap();
        println!("{tolerance} {last:?} {}", states.len());
        assert_eq!(last.t, 2.0);
        let errors = [last.q.x - 1.0, last.q.y, last.rates.x - 1.0, last.rates.y + 1.0];
        assert!(errors.iter().all(|error| error.abs() <= 8.0 * f64::EPSILON), "{errors:?}");
    }
}

/// Outputs on both sides of the kink and at it: there the state before it.
#[test]
fn outputs_around_a_kink() {
    let scene = Turned::default();
    let q = LineCoordinates { x: 1.0, y: 0.0 };
    let input_rates = LineInputs { x: -1.0, y: 1.0 };
    let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates }, 2.0, 1e-9).unwrap();
    let little = 4.0 * f64::EPSILON;
    let times = [0.0, 0.5, 1.0 - little, 1.0, 1.0 + little, 1.5, 2.0];
    let states: Vec<_> = motion.at(times).map(Result::unwrap).collect();
    assert_eq!(states.len(), times.len());
    for (state, t) in states.iter().zip(times) {
        let (side, rates) = if t <= 1.0 { (-1.0, [-1.0, 1.0]) } else { (1.0, [1.0, -1.0]) };
        let errors = [
            state.q.x - side * (t - 1.0),
            state.q.y - (1.0 - side * (t - 1.0)),
            state.rates.x - rates[0],
            state.rates.y - rates[1],
        ];
        assert_eq!(state.t, t);
        assert!(errors.iter().all(|error| error.abs() <= 16.0 * f64::EPSILON), "{t}: {errors:?}");
    }
}

/// sqrt(x^2) is |x|; two drives at one time.
#[test]
fn other_ways_to_a_kink() {
    let q = LineCoordinates { x: 1.0, y: 0.0 };
    let input_rates = LineInputs { x: -1.0, y: 1.0 };
    let scene = Rooted::default();
    let (states, error) = run(simulate(&scene, Start { t: 0.0, q, input_rates }, 2.0, 1e-9).unwrap());
    assert_eq!(error, None);
    assert!((states.last().unwrap().rates.y + 1.0).abs() <= 8.0 * f64::EPSILON);
    let scene = Both::default();
    let (q, input_rates) = (LineCoordinates { x: 1.0, y: 0.5 }, LineInputs { x: -1.0, y: -0.5 });
    let (states, error) = run(simulate(&scene, Start { t: 0.0, q, input_rates }, 2.0, 1e-9).unwrap());
    assert_eq!(error, None);
    let last = states.last().unwrap();
    assert!((last.rates.x, last.rates.y, last.q.x, last.q.y) == (1.0, 0.5, 1.0, 0.5), "{last:?}");
}

/// atan2 jumps by 2 pi at pi: an error with the drive and the time, after the states before it.
#[test]
fn a_drive_that_jumps() {
    let scene = Leaping::default();
    let q = LineCoordinates { x: 1.0, y: 0.0 };
    let motion = simulate(&scene, Start { t: 1.0, q, input_rates: LineInputs { x: 1.0, y: 0.0 } }, 5.0, 1e-9).unwrap();
    let (states, error) = run(motion);
    println!("{error:?}");
    let Some(MotionError::DriveJumps { scene: "Leaping", coordinate: "x", t }) = error else { panic!("{error:?}") };
    assert!((t - std::f64::consts::PI).abs() < 1e-14);
    let last = states.last().unwrap();
    assert!((last.t - t).abs() < 1e-14 && (last.q.x - last.t).abs() < 1e-14);
}

/// The kinks of t^2 |sin(1/t)| gather at t = 0.
#[test]
fn kinks_that_gather() {
    let scene = Gathering::default();
    let at = |t: f64| {
        (t * t * (1.0 / t).sin().abs(), 2.0 * t * (1.0 / t).sin().abs() - (1.0 / t).sin().signum() * (1.0 / t).cos())
    };
    let (x, rate) = at(-1.0);
    let q = LineCoordinates { x, y: 0.0 };
    let start = Start { t: -1.0, q, input_rates: LineInputs { x: rate, y: 0.0 } };
    let (states, error) = run(simulate(&scene, start, 1.0, 1e-6).unwrap().most_steps(4000));
    println!("{error:?} {} {:?}", states.len(), states.last().unwrap().t);
    assert!(matches!(error, Some(MotionError::KinksWithoutEnd { scene: "Gathering", effect: "drive x", .. })));
    // 1 / (k pi), the times of the kinks.
    for (k, state) in states.iter().filter(|state| state.kink.is_some()).enumerate() {
        assert!((state.t * std::f64::consts::PI * (k + 1) as f64 + 1.0).abs() < 1e-12, "{k} {}", state.t);
    }
}

linkage! {
    /// A ball above a table that moves, a block on it, and a mass on a spring.
    mechanism Table {
        param m = 1, e = 0, mu = 0.5, g = 9.81, top = 100, k = 1, c = 1, u = 1;
        input b, y;
        body ball { mass m; center (0, y); }
        body table { mass m; center (b, 0); }
        scene Thrown { inertia; gravity (0, -g); drive b = abs(sin(t)); stop y - b in 0..top, restitution e; }
        scene Carried { inertia; drive b = abs(t - 1); friction mu * m * g on y - b; }
        scene Pressed { inertia; drive b = 0; force (0, u * (t - 1) / abs(t - 1)) at (0, y); }
        scene Wedge { inertia; drive b = 0; potential k * abs(y); }
        scene Dry { inertia; drive b = 0; force (0, -c * rate(y) / abs(rate(y))) at (0, y); }
        scene Loaded { inertia; drive b = 0; friction 2 on y; force (0, 1 + 2 * (t - 1) / abs(t - 1)) at (0, y); }
    }
}

fn table(t: f64, [b, y]: [f64; 2], [b_rate, y_rate]: [f64; 2]) -> Start<f64, TableCoordinates<f64>, TableInputs<f64>> {
    Start { t, q: TableCoordinates { b, y }, input_rates: TableInputs { b: b_rate, y: y_rate } }
}

/// The table falls with a rate of -1 at t = pi and then rises with 1: the ball, which rests on it, is thrown at a rate
/// of 1 + e 2.
#[test]
fn a_ball_is_thrown() {
    for e in [0.0, 0.5, 1.0] {
        let scene = Thrown { e, ..Thrown::default() };
        let start = table(1.0, [1f64.sin(); 2], [1f64.cos(); 2]);
        // The table accelerates by -sin(t), less than g: the ball stays on it.
        let (states, error) = run(simulate(&scene, start, 4.0, 1e-11).unwrap());
        assert_eq!(error, None);
        let at = states.iter().find(|state| state.kink.is_some()).unwrap();
        assert_eq!(at.kink, Some("drive b"));
        assert!((at.t - std::f64::consts::PI).abs() < 1e-15 && (at.rates.y + 1.0).abs() < 1e-9);
        let change = at.changes().next();
        let mut motion = simulate(&scene, start, 3.2, 1e-11).unwrap();
        let last = motion.at([3.2]).next().unwrap().unwrap();
        let (dt, rise) = (3.2 - std::f64::consts::PI, 1.0 + 2.0 * e);
        if e == 0.0 {
            assert_eq!(change, None);
            assert!((last.q.y - last.q.b).abs() < 1e-12 && last.contacts[0].mode == Mode::AtLower);
        } else {
            assert_eq!(change, Some(("stop on y - b", Change::LetsGo)));
            assert!((last.q.y - (rise * dt - 0.5 * 9.81 * dt * dt)).abs() < 1e-9, "{e} {last:?}");
            assert!((last.rates.y - (rise - 9.81 * dt)).abs() < 1e-9, "{e} {last:?}");
        }
    }
}

/// The belt turns round: the block, which sticks to it, slips with 2 m/s against it until both have one rate.
#[test]
fn a_block_slips_at_a_jump() {
    let scene = Carried::default();
    let mut motion = simulate(&scene, table(0.0, [1.0, 0.0], [-1.0, -1.0]), 2.0, 1e-10).unwrap();
    let states: Vec<_> = motion.by_ref().map(Result::unwrap).collect();
    let kink = states.iter().find(|state| state.kink.is_some()).unwrap();
    assert_eq!(kink.changes().collect::<Vec<_>>(), [("friction on y - b", Change::Slips)]);
    let stick = states.iter().find(|state| state.changes().any(|(_, change)| change == Change::Sticks)).unwrap();
    let duration = 2.0 / (0.5 * 9.81);
    assert!((stick.t - 1.0 - duration).abs() < 1e-12, "{}", stick.t);
    let last = states.last().unwrap();
    // -1 before, then a mean rate of 0 while it slips.
    assert!((last.rates.y - 1.0).abs() < 1e-12 && (last.q.y - (-1.0 + 1.0 - duration)).abs() < 1e-10, "{last:?}");
}

/// A force that changes its sign: the step ends there, and the motion is exact.
#[test]
fn a_force_that_jumps() {
    let scene = Pressed::default();
    for tolerance in [1e-4, 1e-10] {
        let (states, error) = run(simulate(&scene, table(0.0, [0.0, 0.0], [0.0, 0.0]), 3.0, tolerance).unwrap());
        assert_eq!(error, None);
        let last = states.last().unwrap();
        println!("{tolerance} {last:?} {}", states.len());
        assert_eq!(states.iter().filter_map(|state| state.kink).collect::<Vec<_>>(), ["force at a point"]);
        // -1/2 at t = 1 with the rate -1, then the acceleration 1.
        assert!((last.q.y + 0.5).abs() < 1e-14 && (last.rates.y - 1.0).abs() < 1e-14, "{last:?}");
    }
}

/// y rises and falls in parabolas between the zeros of y: |y''| = k, of period 4 v / k for the two halves.
#[test]
fn a_wedge() {
    let scene = Wedge::default();
    // A step of 36 ulps of the time goes over each kink, with an error of the rate up to twice that; each changes all
    // later half periods.
    let accuracy = 0.5 * 21.0 * 21.0 * 72.0 * f64::EPSILON * 41.0;
    for tolerance in [1e-5, 1e-12] {
        let motion = simulate(&scene, table(0.0, [0.0, 0.5], [0.0, 0.0]), 41.5, tolerance).unwrap();
        let (states, error) = run(motion);
        assert_eq!(error, None);
        let last = states.last().unwrap();
        let kinks: Vec<f64> = states.iter().filter(|state| state.kink.is_some()).map(|state| state.t).collect();
        println!("{tolerance} {last:?} {} {}", states.len(), kinks.len());
        // From 1/2 to 0 in 1, then each half takes 2.
        assert_eq!(kinks.len(), 21);
        for (k, t) in kinks.iter().enumerate() {
            assert!((t - (1.0 + 2.0 * k as f64)).abs() < accuracy, "{k} {t}");
        }
        assert!((last.q.y + 0.375).abs() < accuracy && (last.rates.y + 0.5).abs() < accuracy, "{last:?}");
    }
}

/// A friction written as a force has no motion after the first zero of its rate.
#[test]
fn a_force_with_kinks_without_end() {
    let scene = Dry::default();
    let (states, error) = run(simulate(&scene, table(0.0, [0.0, 0.0], [0.0, 1.0]), 3.0, 1e-9).unwrap());
    println!("{error:?} {}", states.len());
    let Some(MotionError::KinksWithoutEnd { scene: "Dry", effect: "force at a point", t }) = error else {
        panic!("{error:?}")
    };
    assert!((t - 1.0).abs() < 1e-12);
    let last = states.last().unwrap();
    assert!((last.t - 1.0).abs() < 1e-12 && (last.q.y - 0.5).abs() < 1e-12);
}

/// A load that jumps beyond the limit of a friction: it slips from that time on.
#[test]
fn a_load_that_jumps() {
    let scene = Loaded::default();
    let (states, error) = run(simulate(&scene, table(0.0, [0.0, 0.0], [0.0, 0.0]), 3.0, 1e-9).unwrap());
    assert_eq!(error, None);
    let last = states.last().unwrap();
    println!("{last:?}");
    // -1 N is held; 3 N accelerate by 1 m/s2 from t = 1.
    assert!((last.q.y - 2.0).abs() < 1e-12 && (last.rates.y - 2.0).abs() < 1e-12);
    let slip = states.iter().find(|state| state.changes().next().is_some()).unwrap();
    assert!((slip.t - 1.0).abs() < 1e-12, "{slip:?}");
}

/// A kink at the start, at the end, and a start with a rate that is not that after the kink.
#[test]
fn a_kink_at_the_start_or_the_end() {
    let scene = Turned::default();
    let start = |rate: f64| Start {
        t: 1.0,
        q: LineCoordinates { x: 0.0, y: 0.0 },
        input_rates: LineInputs { x: rate, y: 1.0 },
    };
    let (states, error) = run(simulate(&scene, start(1.0), 2.0, 1e-9).unwrap());
    assert_eq!(error, None);
    let last = states.last().unwrap();
    assert!((last.rates.y - 1.0).abs() < 1e-14 && last.q.x == 1.0 && states.iter().all(|state| state.kink.is_none()));
    let error = simulate(&scene, start(-1.0), 2.0, 1e-9).err();
    assert!(matches!(error, Some(MotionError::Input(InputError::Inconsistent { quantity: "rate", .. }))), "{error:?}");
    let q = LineCoordinates { x: 1.0, y: 0.0 };
    let input_rates = LineInputs { x: -1.0, y: 1.0 };
    let (states, error) = run(simulate(&scene, Start { t: 0.0, q, input_rates }, 1.0, 1e-9).unwrap());
    assert_eq!(error, None);
    let last = states.last().unwrap();
    println!("{last:?}");
    assert!(last.t == 1.0 && last.rates.x == -1.0 && (last.rates.y - 1.0).abs() < 1e-15 && last.q.x.abs() < 1e-15);
}

/// Backward in time the same jump of the rate.
#[test]
fn a_kink_backward_in_time() {
    let scene = Turned::default();
    let start = Start { t: 2.0, q: LineCoordinates { x: 1.0, y: 0.0 }, input_rates: LineInputs { x: 1.0, y: -1.0 } };
    let (states, error) = run(simulate(&scene, start, 0.0, 1e-9).unwrap());
    assert_eq!(error, None);
    let last = states.last().unwrap();
    let errors = [last.q.x - 1.0, last.q.y, last.rates.x + 1.0, last.rates.y - 1.0];
    assert!(errors.iter().all(|error| error.abs() <= 8.0 * f64::EPSILON), "{errors:?}");
}

linkage! {
    /// A ball on a line with laws of its state.
    mechanism Ball {
        param m = 1, k = 2, g = 10, e = 0.5, c = 3, mu = 0.3, r = 0.2;
        input y, z;
        body ball { mass m; center (0, y); }
        body other { mass m; center (z, 0); }
        scene Bouncing { inertia; gravity (0, -g); potential k * abs(y); stop y in 0..9, restitution e; }
        scene Damped { inertia; force (0, -c * abs(rate(y)) * rate(y)) at (0, y); potential 0 * z; }
        scene Rubbed { inertia; gravity (0, -g); friction mu * m * g on z; force (-c * abs(rate(y)) * rate(z), 0) at (z, 0);
            stop y in 0..9, restitution e; }
        scene Taut { inertia; spring 8, r between (0, 0) and (0, y); }
        scene Early { inertia; potential k * abs(y); }
        scene Smooth { inertia; gravity (0, -g); drive z = sin(t); spring k, r between (0, 0) and (z, y); }
    }
}

fn ball([y, z]: [f64; 2], [y_rate, z_rate]: [f64; 2]) -> Start<f64, BallCoordinates<f64>, BallInputs<f64>> {
    Start { t: 0.0, q: BallCoordinates { y, z }, input_rates: BallInputs { y: y_rate, z: z_rate } }
}

/// The kink is at the stop: each impact is one too, and the ball comes to rest where the law has none.
#[test]
fn impacts_at_a_kink() {
    let scene = Bouncing::default();
    let (states, error) = run(simulate(&scene, ball([1.5, 0.0], [0.0, 0.0]), 1.6, 1e-10).unwrap());
    println!("{error:?} {:?} {}", states.last(), states.len());
    assert_eq!(error, None);
    // y'' = -12: hits at 1/2 with -6, then at 1/2 + 1/2, + 1/4, ... with half of the rate each.
    let hits: Vec<f64> = states
        .iter()
        .filter(|state| state.changes().any(|(_, change)| change == Change::Impact))
        .map(|s| s.t)
        .collect();
    println!("{hits:?}");
    for (hit, expected) in hits.iter().zip([0.5, 1.0, 1.25, 1.375, 1.4375]) {
        assert!((hit - expected).abs() < 1e-13, "{hit} {expected}");
    }
    let last = states.last().unwrap();
    assert!(last.q.y.abs() < 1e-14 && last.rates.y == 0.0 && last.contacts[0].mode == Mode::AtLower, "{last:?}");
}

/// |y'| y' is smooth enough, and so is a body at rest whose rate is rounding error.
#[test]
fn a_damper_at_rest() {
    let scene = Damped::default();
    let (states, error) = run(simulate(&scene, ball([0.0, 0.0], [2.0, 1.0]), 10.0, 1e-11).unwrap());
    assert_eq!(error, None);
    let last = states.last().unwrap();
    // y' = 1 / (1/2 + 3 t), y = ln(1 + 6 t) / 3.
    assert!((last.rates.y - 1.0 / 30.5).abs() < 1e-10 && (last.q.y - 61f64.ln() / 3.0).abs() < 1e-9, "{last:?}");
    assert!(states.iter().all(|state| state.kink.is_none()));
    let scene = Rubbed::default();
    let (states, error) = run(simulate(&scene, ball([0.3, 0.0], [0.0, 1.0]), 5.0, 1e-9).unwrap());
    println!("{error:?} {} {:?}", states.len(), states.last());
    assert_eq!(error, None);
    let last = states.last().unwrap();
    assert!(last.rates.y == 0.0 && last.rates.z == 0.0);
}

/// A spring on a line whose ends pass each other: its force jumps from -8 (y - r) to -8 (y + r).
#[test]
fn a_spring_whose_ends_pass() {
    let scene = Taut::default();
    let (states, error) = run(simulate(&scene, ball([1.0, 0.0], [0.0, 0.0]), 3.0, 1e-11).unwrap());
    println!("{error:?} {:?}", states.last());
    assert_eq!(error, None);
    let w = 8f64.sqrt();
    // y = r + 0.8 cos(w t) until it is 0, at w t = acos(-1/4); then -r + R cos(w (t - t0) + a), symmetric.
    let first = (-0.25f64).acos() / w;
    let kinks: Vec<f64> = states.iter().filter(|state| state.kink.is_some()).map(|state| state.t).collect();
    for (kink, t) in kinks.iter().zip([first, 3.0 * first]) {
        assert!((kink - t).abs() < 1e-9, "{kinks:?} {first}");
    }
    assert_eq!(kinks.len(), 2);
    let last = states.last().unwrap();
    // After 4 quarters the motion repeats: y(t) = r + 0.8 cos(w (t - 4 t1)).
    let y = 0.2 + 0.8 * (w * (3.0 - 4.0 * first)).cos();
    assert!((last.q.y - y).abs() < 1e-8, "{last:?} {y}");
}

/// A start on the kink of a law of the state, with a rate.
#[test]
fn a_start_on_a_kink_of_the_state() {
    let scene = Early::default();
    for sign in [1.0, -1.0] {
        let (states, error) = run(simulate(&scene, ball([0.0, 0.0], [sign, 0.0]), 0.25, 1e-10).unwrap());
        assert_eq!(error, None);
        let last = states.last().unwrap();
        assert!((last.q.y - sign * (0.25 - 0.0625)).abs() < 1e-14 && (last.rates.y - 0.5 * sign).abs() < 1e-14);
    }
}

/// A kink just before the end, to which the last step would be stretched: the step ends at the kink.
#[test]
fn a_kink_just_before_the_end() {
    let scene = Early::default();
    // y'' = -2: at zero after a second, with the rate -2, then y'' = 2.
    for beyond in [8e-3, 1e-3, 1e-5, 1e-8, 1e-11, 1e-13] {
        let motion = simulate(&scene, ball([1.0, 0.0], [0.0, 0.0]), 1.0 + beyond, 1e-9).unwrap();
        let (states, error) = run(motion.most_steps(100));
        assert_eq!(error, None, "{beyond}");
        let (last, end) = (states.last().unwrap(), states.last().unwrap().t - 1.0);
        assert!(last.t == 1.0 + beyond && states.iter().any(|state| (state.t - 1.0).abs() < 1e-14), "{beyond}");
        let errors = [last.q.y - (-2.0 * end + end * end), last.rates.y - (-2.0 + 2.0 * end)];
        // The step over the kink has 8e-15 s, and y'' differs by 4 there: the positive weights of the method, which have the sum
        // 7, may all be on the wrong side.
        assert!(errors.iter().all(|error| error.abs() < 2e-13), "{beyond} {errors:?}");
    }
}
