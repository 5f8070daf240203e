//! Change points and near ones: the motion goes straight on where two motions cross, and round the bend where two only
//! come near each other.

use linkage::Scene;
use linkage::integrate::{Tolerance, dop853};
use linkage::linkage;
use linkage::simulation::{Start, simulate};

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

#[test]
fn parallel_stays_parallel_also_when_driven() {
    let (rolling, driven) = (Rolling::default(), Driven::default());
    let q = FrameCoordinates { theta: 0.3, phi: 0.0, psi: 0.3 };
    let mut motion = simulate(&rolling, Start { t: 0.0, q, input_rates: 6.0 }, 10.0, 1e-12).unwrap();
    // In an even motion no error estimate keeps a step from passing two change points: it needs a largest step.
    let given = simulate(&driven, Start { t: 0.0, q, input_rates: 3.0 }, 10.0, 1e-12).unwrap();
    let mut given = given.largest_step(0.5).unwrap();
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
