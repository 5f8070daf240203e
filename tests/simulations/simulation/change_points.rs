//! Change points and near ones: the motion goes straight on where two motions cross, and round the bend where two only
//! come near each other.

use linkage::contact::Change;
use linkage::integrate::{Crossing, Tolerance, dop853};
use linkage::linkage;
use linkage::simulation::{AtSingularity, Start, Then, simulate};
use linkage::{Mechanism, MotionError, PositionError, Scene};

linkage! {
    /// A four-bar with a heavy crank, a parallelogram by default.
    #[derive(Debug, Clone)]
    mechanism Frame {
        param a = 1, b = 2, c = 1, d = 2, m = 1, j = 5, g = 9.81;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = d@0 + c@psi;
        body crank { mass m; inertia j; center (a/2)@theta; angle theta; }
        body coupler { mass m; inertia m * b^2 / 12; center a@theta + (b/2)@phi; angle phi; }
        body rocker { mass m; inertia m * c^2 / 12; center d@0 + (c/2)@psi; angle psi; }
        scene Rolling { inertia; gravity (0, -g); energy; }
        scene Driven { inertia; gravity (0, -g); drive theta = 3 * t + 0.3; }
    }
}

/// Crossed, the cranks turn against each other by tan(psi/2) = -(b + a)/(b - a) tan(theta/2), through all change
/// points.
#[test]
fn crossed_stays_crossed() {
    let scene = Rolling::default();
    let q = FrameCoordinates { theta: 0.9, phi: -1.03, psi: -1.93 };
    let q = scene.mechanism.solve(&q).unwrap().coordinates;
    let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 6.0 }, 10.0, 1e-12).unwrap();
    let mut states = 0;
    motion
        .finish(|state, _| {
            states += 1;
            let (sine, cosine) = (state.q.theta / 2.0).sin_cos();
            let (other_sine, other_cosine) = (state.q.psi / 2.0).sin_cos();
            let gap = other_sine * cosine + 3.0 * sine * other_cosine;
            assert!(gap.abs() < 1e-8, "{}: {gap:e}", state.t);
            true
        })
        .unwrap();
    println!("{states} {:?} {:?} {:?}", motion.counts(), motion.passages(), motion.state());
    assert!(motion.passages().change_points > 10);
    assert!(motion.state().q.theta > 40.0 && motion.state().q.psi < -40.0);
}

/// The estimated error of interpolated positions, about 1e-13, is part of the error of each step.
#[test]
fn at_the_finest_tolerance_steps_over_change_points_are_short() {
    let scene = Rolling::default();
    let q = FrameCoordinates { theta: 0.9, phi: -1.03, psi: -1.93 };
    let q = scene.mechanism.solve(&q).unwrap().coordinates;
    let [coarse, fine] = [1e-13, 3e-15].map(|tolerance| {
        let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 6.0 }, 1.5, tolerance).unwrap();
        motion.finish(|_, _| true).unwrap();
        assert_eq!(motion.passages().change_points, 3);
        motion.counts().accepted
    });
    println!("{coarse} {fine}");
    // By the errors of the steps alone (1 / 0.03)^(1/8) = 1.5 times as many.
    assert!(fine > 3 * coarse, "{coarse} {fine}");
}

#[test]
fn parallel_stays_parallel_also_when_driven() {
    let (rolling, driven) = (Rolling::default(), Driven::default());
    let q = FrameCoordinates { theta: 0.3, phi: 0.0, psi: 0.3 };
    let mut motion = simulate(&rolling, Start { t: 0.0, q, input_rates: 6.0 }, 10.0, 1e-12).unwrap();
    let mut given = simulate(&driven, Start { t: 0.0, q, input_rates: 3.0 }, 10.0, 1e-12).unwrap();
    motion
        .finish(|state, _| {
            assert!((state.q.psi - state.q.theta).abs() < 1e-9 && state.q.phi.abs() < 1e-9, "{state:?}");
            true
        })
        .unwrap();
    given
        .finish(|state, _| {
            let law = 3.0 * state.t + 0.3;
            assert!((state.q.theta - law).abs() < 1e-14 * law && (state.rates.theta - 3.0).abs() < 1e-14);
            assert!((state.q.psi - law).abs() < 1e-9 && (state.rates.psi - 3.0).abs() < 1e-8, "{state:?}");
            true
        })
        .unwrap();
    println!("{:?} {:?}", motion.passages(), given.passages());
    assert!(motion.passages().change_points > 10);
    assert_eq!(given.passages().change_points, 9);
}

/// A driven parallelogram has no error of its steps, which become as long as the interval, over two change points.
#[test]
fn a_long_step_ends_at_the_first_change_point() {
    let driven = Driven::default();
    let q = FrameCoordinates { theta: 0.3, phi: 0.0, psi: 0.3 };
    for end in [1.5, 2.0, 2.2, 4.1] {
        let start = Start { t: 0.0, q, input_rates: 3.0 };
        let mut motion = simulate(&driven, start, end, 1e-4).unwrap().at_singularity(AtSingularity::Stop);
        let error = motion.finish(|_, _| true).unwrap_err();
        let MotionError::Position(PositionError::Singular { regularity, .. }) = error else { panic!("{error}") };
        assert!(regularity < 1e-10, "{error}");
        assert!(motion.state().q.theta < 3.15);
        let mut motion = simulate(&driven, start, end, 1e-4).unwrap();
        motion.finish(|_, _| true).unwrap();
        assert_eq!(motion.passages().change_points, ((3.0 * end + 0.3) / std::f64::consts::PI) as usize);
    }
}

/// The crank is a little too short to take the rocker along: it swings, the more suddenly the nearer the frame is to a
/// parallelogram. The reference are the equations in the input alone, which has no dead point.
#[test]
fn a_near_change_point_is_none() {
    for short in [1e-3, 1e-6, 1e-9] {
        let mut scene = Rolling::default();
        scene.mechanism.a -= short;
        let q = FrameCoordinates { theta: 0.3, phi: 0.0, psi: 0.3 };
        let q = scene.mechanism.solve(&q).unwrap().coordinates;
        let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 6.0 }, 2.0, 1e-12).unwrap();
        let sign = |q: &FrameCoordinates<f64>| scene.mechanism.determinant(&scene.mechanism.pose_at(q)) > 0.0;
        let result = motion.finish(|state, _| {
            assert_eq!(sign(&state.q), sign(&q), "{short:e} {state:?}");
            true
        });
        println!("{short:e} {:?} {:?}", motion.counts(), motion.passages());
        let y = scene.start(0.0, &q, &6.0.into()).unwrap();
        let tolerance = Tolerance::new(1e-13, [1.0, 1.0, 1.0, 6.0]).unwrap();
        let mut plain = dop853(|t, y: &_| scene.derivative(t, y), (0.0, y), 2.0, tolerance).unwrap();
        plain.finish(|_, _| true).unwrap();
        let expected = Rolling::parts(plain.state()).q;
        result.unwrap();
        let found = motion.state().q;
        assert_eq!(motion.passages().change_points, 0);
        let error = (found.theta - expected.theta).abs().max((found.psi - expected.psi).abs());
        println!("{error:e}");
        // Rounding errors count for more the sharper the bend is.
        assert!(error < 1e-9 + 1e-13 / short, "{short:e}: {error:e}");
    }
}

linkage! {
    /// A parallelogram of two cranks and a bar, with a torque that swings and a stop.
    #[derive(Debug, Clone)]
    mechanism Cranks {
        param a = 0.1, b = 0.3, j = 0.01, m = 1, t0 = 0.1, w = 3, p = 0, lo = -100, hi = 3.3, e = 0.5, mu = 0.1, radius = 0.005;
        input th;
        unknown ph, ps;
        loop a@th + b@ph = (b, 0) + a@ps;
        body left { inertia j; angle th; }
        body right { inertia j; angle ps; }
        body bar { mass m; inertia 0.01; center a@th + (b/2)@ph; angle ph; }
        scene Smooth { inertia; torque t0 * sin(w*t + p) on th; }
        scene Stopped { inertia; torque t0 * sin(w*t + p) on th; stop th in lo..hi, restitution e; }
        scene Loaded { inertia; torque t0 * sin(w*t + p) on th; reactions; }
        scene Rubbed { inertia; friction mu, radius, reaction on th; }
    }
}

/// One rotor, M = 2 j + m a^2. A step through the change point at 3 pi had no error estimate, and went to 56.8 rad.
#[test]
fn steps_over_change_points_keep_the_tolerance() {
    let (th, v, p) = (5.459_199_999_999_999, 0.072_000_000_000_000_06, 5.649_599_999_999_999);
    let scene = Smooth { p, ..Smooth::default() };
    let (inertia, w, t0, t) = (0.03, 3.0, 0.1, 10.0_f64);
    let right =
        th + (v + t0 * f64::cos(p) / (inertia * w)) * t - t0 / (inertia * w * w) * (f64::sin(w * t + p) - f64::sin(p));
    for tolerance in [1e-4, 1e-6, 1e-9, 1e-12] {
        let start = Start { t: 0.0, q: CranksCoordinates { th, ph: 0.0, ps: th }, input_rates: v };
        let mut motion = simulate(&scene, start, t, tolerance).unwrap();
        motion.finish(|_, _| true).unwrap();
        let error = (motion.state().q.th - right).abs();
        assert!(error < 100.0 * tolerance, "{tolerance:e}: {error:e}");
        assert_eq!(motion.passages().change_points, 3);
    }
}

/// Computed independently with an event loop for one rotor: 16 impacts and a rest lie within 0.2 rad of the change
/// point. Each impact has half of the rate of the one before. At the last ones the stop is left by less than a rounding error of
/// the angle, so that their number depends on the tolerance, here by one.
#[test]
fn stops_next_to_a_change_point_act() {
    let scene = Stopped { p: 5.592_030_199_999_999, ..Stopped::default() };
    for (tolerance, all_impacts) in [(1e-6, 23), (1e-9, 24), (1e-12, 24)] {
        let start = Start { t: 0.0, q: CranksCoordinates { th: 3.256, ph: 0.0, ps: 3.256 }, input_rates: 0.516 };
        let mut motion = simulate(&scene, start, 10.0, tolerance).unwrap();
        let mut changes = Vec::new();
        motion
            .finish(|state, _| {
                changes.extend(state.changes().map(|(_, change)| (change, state.rates.th)));
                true
            })
            .unwrap();
        let (impacts, others): (Vec<_>, Vec<_>) = changes.iter().partition(|(change, _)| *change == Change::Impact);
        let others: Vec<Change> = others.iter().map(|(change, _)| *change).collect();
        assert_eq!(others, [Change::Rests, Change::LetsGo], "{tolerance:e}");
        // The 20th has the rate 1.92e-6, the next one half of it.
        let count = impacts.iter().filter(|(_, rate)| *rate > 1.4e-6).count();
        assert_eq!((count, impacts.len()), (20, all_impacts), "{tolerance:e}: {impacts:?}");
        assert!((motion.state().q.th + 6.0732).abs() < 1e-5, "{tolerance:e}: {:?}", motion.state().q);
    }
}

/// At a loose tolerance a step over one change point would end at the next one, half a turn away, where its polynomial
/// is too far from the constraints for the stop to be known there.
#[test]
fn a_step_over_a_change_point_ends_before_the_next_one() {
    for (hi, th, v, p, e) in [
        (3.6834421248532228, 1.5420752709789811, 0.546829611687, 5.742587479077122, 0.8),
        (3.319510712788595, 1.2163902087114136, 0.45392872867747236, 0.036409654568733726, 1.0),
    ] {
        let scene = Stopped { hi, p, e, ..Stopped::default() };
        let [loose, exact] = [1e-4, 1e-12].map(|tolerance| {
            let start = Start { t: 0.0, q: CranksCoordinates { th, ph: 0.0, ps: th }, input_rates: v };
            let mut motion = simulate(&scene, start, 6.0, tolerance).unwrap();
            motion.finish(|_, _| true).unwrap();
            motion.state().q.th
        });
        println!("{:e}", loose - exact);
        assert!((loose - exact).abs() < 0.01, "{loose} {exact}");
    }
}

/// The largest step and events hold over a change point as everywhere.
#[test]
fn the_largest_step_and_events_hold_over_a_change_point() {
    let scene = Smooth { t0: 0.0, ..Smooth::default() };
    let start = Start { t: 0.0, q: CranksCoordinates { th: 2.5, ph: 0.0, ps: 2.5 }, input_rates: 1.0 };
    let motion = simulate(&scene, start, 2.0, 1e-9).unwrap().largest_step(0.01).unwrap();
    let mut motion = motion
        .events([Crossing::Rising], |state| Ok([state.q.ps - std::f64::consts::PI]), |_, _| Ok(Then::GoOn))
        .unwrap();
    let (mut last, mut events) = (0.0, Vec::new());
    motion
        .finish(|state, _| {
            assert!(state.t - last < 0.010_000_001, "{last} {}", state.t);
            last = state.t;
            events.extend(state.event.map(|_| state.t));
            true
        })
        .unwrap();
    let [t] = events[..] else { panic!("{events:?}") };
    assert!((t - (std::f64::consts::PI - 2.5)).abs() < 1e-12, "{t}");
}

/// At rest or moving: which motion follows is not told by a rate of the input.
#[test]
fn a_start_on_a_change_point_names_the_motions() {
    let scene = Smooth::default();
    for rate in [0.0, 1.0] {
        let q = CranksCoordinates { th: std::f64::consts::PI, ph: 0.0, ps: std::f64::consts::PI };
        let error = simulate(&scene, Start { t: 0.0, q, input_rates: rate }, 1.0, 1e-9).err().unwrap();
        assert!(matches!(error, MotionError::ChangePoint { crossing: Some(_), .. }), "{error:?}");
        assert_eq!(
            error.to_string(),
            "motions of Smooth cross here, where group ph, ps is singular (ps' : th' = -0.500 : 1.000 or 1.000 : \
             1.000): start next to it, on one of them"
        );
    }
}

/// In line the bar carries any force along the links: the pins' forces are not determined.
#[test]
fn forces_in_joints_are_an_error_at_a_change_point() {
    let scene = Loaded::default();
    for (beyond, is_determined) in
        [(-0.1, true), (-0.01, true), (-1e-5, false), (0.0, false), (1e-5, false), (0.01, true)]
    {
        let start = Start { t: 0.0, q: CranksCoordinates { th: 2.5, ph: 0.0, ps: 2.5 }, input_rates: 1.0 };
        let motion = simulate(&scene, start, 2.0, 1e-10).unwrap();
        let mut motion = motion
            .events([Crossing::Rising], |state| Ok([state.q.th - std::f64::consts::PI - beyond]), |_, _| Ok(Then::Stop))
            .unwrap();
        motion.finish(|_, _| true).unwrap();
        let loads = motion.loads();
        if is_determined {
            let loads = loads.unwrap();
            assert!(loads.joints.multipliers.iter().all(|force| force.is_finite()), "{beyond}");
        } else {
            let error = loads.unwrap_err();
            assert!(matches!(error, MotionError::UndeterminedReactions { group: "ph, ps", .. }), "{beyond} {error}");
        }
    }
}

/// A friction by such a force: the simulation ends before the change point and says why. The force grows as one by the
/// distance, its friction with it, until no acceleration satisfies its law; on a thin pin that is next to the change
/// point.
#[test]
fn frictions_by_forces_in_joints_end_at_a_change_point() {
    for (radius, least, most) in [(0.005, 0.0024, 0.0026), (1e-9, 0.0, 1e-3)] {
        for tolerance in [1e-4, 1e-6, 1e-9, 1e-12] {
            let scene = Rubbed { radius, ..Rubbed::default() };
            let start = Start { t: 0.0, q: CranksCoordinates { th: 2.5, ph: 0.0, ps: 2.5 }, input_rates: 5.0 };
            let mut motion = simulate(&scene, start, 2.0, tolerance).unwrap();
            let error = motion.finish(|_, _| true).unwrap_err();
            let is_true = matches!(error, MotionError::UndeterminedReactions { .. } | MotionError::NoMotion { .. });
            assert!(is_true, "{radius} {tolerance:e}: {error}");
            let left = std::f64::consts::PI - motion.state().q.th;
            assert!(left > least && left < most, "{radius} {tolerance:e}: {left:e}");
        }
    }
}
