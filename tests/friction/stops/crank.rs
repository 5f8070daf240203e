//! A crank that knocks in the dead centre of its piston.

use linkage::contact::Change;
use linkage::linkage;
use linkage::simulation::{Start, simulate};

use linkage_oracle::close;

use super::POSITION_ERROR;

linkage! {
    /// An engine that its piston drives, but not in its dead centres.
    #[derive(Debug, Clone)]
    mechanism Engine {
        param r = 0.05, l = 0.18, m2 = 0.8, m3 = 0.6, m4 = 0.9, g = 9.81, k = 0.3, e = 0.5;
        coordinate phi, psi, z;
        loop r@phi + l@psi = (z, 0);
        drive Piston by z;
        output swing = phi - psi;
        body crank { mass m2; center (r/4)@phi; inertia m2 * r^2; angle phi; }
        body rod { mass m3; inertia m3 * l^2 / 12; center r@phi + (l/3)@psi; angle psi; }
        body piston { mass m4; center (z, 0); }
        scene Turned of Piston { inertia; gravity (0, -g); spring k, -1 on phi; stop phi in 0..2, restitution e; }
        scene TurnedBack of Piston { inertia; gravity (0, -g); spring k, 1 on phi; stop phi in -2..0, restitution e; }
        scene Swung of Piston { inertia; gravity (0, -g); spring k, -1 on phi; stop swing in 0..4, restitution e; }
        scene SwungBack of Piston { inertia; gravity (0, -g); spring k, 1 on phi; stop swing in -4..0, restitution e; }
    }
}

/// In the dead centre, half of this times the square of the rate of the crank is the kinetic energy.
fn inertia(engine: &Piston<f64>, [m2, m3]: [f64; 2]) -> f64 {
    let r = engine.r;
    m2 * r * r * (1.0 + 1.0 / 16.0) + m3 * r * r * (4.0 / 9.0 + 1.0 / 12.0)
}

/// The rates of the crank at the impacts: in one position the potential energy is one number, so that the kinetic
/// energy is that of the fall and then each time e^2 of it.
macro_rules! knocks {
    ($scene:ident, $sign:expr, $size:expr, $e:expr) => {{
        let mut scene = $scene::<f64> { e: $e, k: 0.3 * $size * $size, g: 9.81 * $size, ..$scene::default() };
        (scene.mechanism.r, scene.mechanism.l) = (0.05 * $size, 0.18 * $size);
        let (r, l, sign): (f64, f64, f64) = (scene.mechanism.r, scene.mechanism.l, $sign);
        let phi = sign * 0.6_f64;
        let psi = -(r * phi.sin() / l).asin();
        let start = EngineCoordinates { phi, psi, z: r * phi.cos() + l * psi.cos() };
        let potential = |phi: f64, psi: f64| {
            let heights = scene.m2 * r / 4.0 * phi.sin() + scene.m3 * (r * phi.sin() + l / 3.0 * psi.sin());
            scene.g * heights + scene.k / 2.0 * (phi + sign).powi(2)
        };
        let fallen = potential(phi, psi) - potential(0.0, 0.0);
        let first = (2.0 * fallen / inertia(&scene.mechanism, [scene.m2, scene.m3])).sqrt();
        let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: 0.0 }, 2.0, 1e-13).unwrap();
        let (mut impacts, mut last, mut rest) = (0, 0.0, None);
        while let Some(state) = motion.advance().unwrap() {
            let times = (1..4).map(|part| last + (state.t - last) * f64::from(part) / 4.0);
            for between in motion.at(times).map(Result::unwrap) {
                assert!(sign * between.q.phi > -POSITION_ERROR, "{between:?}");
            }
            last = state.t;
            for (_, change) in state.changes() {
                let expected = first * f64::powi($e, impacts);
                close("rate", -sign * state.rates.phi, expected, 1e-10 * first + 1e-13 * first * first / expected);
                impacts += 1;
                rest = (change == Change::Rests).then_some($e * expected / first);
                assert!(matches!(change, Change::Impact | Change::Rests), "{change:?}");
            }
        }
        assert!(rest.is_some_and(|rest| rest < 1e-6) && (impacts == 1) == ($e == 0.0), "{impacts} {rest:?}");
        assert!(motion.state().rates.phi == 0.0 && motion.state().q.phi.abs() < POSITION_ERROR, "{:?}", motion.state());
    }};
}

#[test]
fn a_crank_knocks_in_its_dead_centre() {
    for size in [1e-3, 1.0, 1e3] {
        for e in [0.0, 0.2, 0.5] {
            knocks!(Turned, 1.0, size, e);
            knocks!(TurnedBack, -1.0, size, e);
            knocks!(Swung, 1.0, size, e);
            knocks!(SwungBack, -1.0, size, e);
        }
    }
}
