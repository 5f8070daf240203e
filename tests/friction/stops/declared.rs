//! A stop without a range takes the one that is declared.

use linkage::contact::Change;
use linkage::linkage;
use linkage::simulation::{Start, simulate};

linkage! {
    /// A slider that a crank throws against both ends of its way.
    #[derive(Debug, Clone)]
    mechanism Thrown {
        param r = 0.1, l = 0.35, j = 0.02, m = 0.8, far = 0.42, pull = 0.9, e = 0.4;
        input phi;
        unknown psi, z in 0.3..far;
        loop r@phi - l@psi = (z, 0);
        output tip in 0.01..0.095 = r * sin(phi);
        body crank { inertia j; angle phi; }
        body ram { mass m; center (z, 0); }
        scene Declared { inertia; torque -pull on phi; stop z, restitution e; stop tip, restitution e; }
        scene Written { inertia; torque -pull on phi; stop z in 0.3..far, restitution e; stop tip in 0.01..0.095, restitution e; }
    }
}

#[test]
fn a_stop_takes_the_declared_range() {
    let start = Start { t: 0.0, q: ThrownCoordinates { phi: 1.0, psi: 2.9, z: 0.4 }, input_rates: 0.0 };
    let (declared, written) = (Declared::default(), Written::default());
    let mut motion = simulate(&declared, start, 2.0, 1e-9).unwrap();
    let mut other = simulate(&written, start, 2.0, 1e-9).unwrap();
    let mut impacts = 0;
    for (state, other) in motion.by_ref().zip(other.by_ref()) {
        let (state, other) = (state.unwrap(), other.unwrap());
        assert_eq!((state.t, state.q, state.rates), (other.t, other.q, other.rates));
        assert!(state.q.z < 0.42 + 1e-9 && state.q.tip_of(&declared.mechanism) > 0.01 - 1e-9, "{:?}", state.q);
        impacts += state.changes().filter(|(_, change)| *change == Change::Impact).count();
    }
    assert!(impacts > 3, "{impacts}");
}

impl ThrownCoordinates<f64> {
    fn tip_of(&self, m: &Thrown<f64>) -> f64 {
        m.r * self.phi.sin()
    }
}
