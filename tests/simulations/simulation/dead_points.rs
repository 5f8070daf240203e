//! Dead points of the input, passed in other coordinates.

use linkage::linkage;
use linkage::simulation::{Start, simulate};

linkage! {
    /// An engine with crank or piston as input.
    #[derive(Debug, Clone)]
    mechanism Engine {
        param r = 0.05, l = 0.18, m2 = 0.8, j2 = 1.2e-3, m3 = 0.6, j3 = 2e-3, m4 = 0.9, g = 9.81, k = 900, z0 = 0.15;
        coordinate phi, psi, z;
        loop r@phi + l@psi = (z, 0);
        drive Crank by phi;
        drive Piston by z;
        body crank { mass m2; center (r/4)@phi; inertia j2; angle phi; }
        body rod { mass m3; inertia j3; center r@phi + (l/3)@psi; angle psi; }
        body piston { mass m4; center (z, 0); }
        scene ByCrank of Crank { inertia; gravity (0, -g); spring k, z0 on z; energy; }
        scene ByPiston of Piston { inertia; gravity (0, -g); spring k, z0 on z; energy; }
    }
}

#[test]
fn an_engine_by_its_piston_as_by_its_crank() {
    let (by_crank, by_piston) = (ByCrank::default(), ByPiston::default());
    let q = by_crank.mechanism.solve(&EngineCoordinates { phi: 1.2, psi: -0.25, z: 0.19 }).unwrap().coordinates;
    let times: Vec<f64> = (1..=40).map(|i| 0.05 * f64::from(i)).collect();
    for (speed, turns) in [(30.0, 8.0), (-30.0, 8.0), (8.0, 0.0)] {
        let mut reference = simulate(&by_crank, Start { t: 0.0, q, input_rates: speed }, 2.0, 1e-13).unwrap();
        let z_rate = reference.state().rates.z;
        let mut motion = simulate(&by_piston, Start { t: 0.0, q, input_rates: z_rate }, 2.0, 1e-13).unwrap();
        let expected: Vec<_> = reference.at(times.iter().copied()).map(Result::unwrap).collect();
        let found: Vec<_> = motion.at(times.iter().copied()).map(Result::unwrap).collect();
        assert_eq!(found.len(), expected.len());
        let mut worst = 0.0_f64;
        for (found, expected) in found.iter().zip(&expected) {
            for (found, expected, size) in [
                (found.q.phi, expected.q.phi, 1.0),
                (found.q.psi, expected.q.psi, 1.0),
                (found.q.z, expected.q.z, 0.05),
                (found.rates.phi, expected.rates.phi, 30.0),
                (found.rates.z, expected.rates.z, 1.5),
            ] {
                worst = worst.max((found - expected).abs() / size);
            }
        }
        println!("{speed}: {worst:e} {:?} {:?} {}", motion.counts(), motion.passages(), found[39].q.phi);
        assert!(worst < 1e-9, "{worst:e}");
        assert_eq!(motion.passages().change_points, 0);
        // It turns over both dead points, or swings over one and back.
        assert!((found[39].q.phi - q.phi).abs() >= turns * std::f64::consts::TAU);
        assert!(motion.passages().exchanges > 8);
        assert_eq!(reference.passages().exchanges, 0);
    }
}

linkage! {
    /// A five-bar of two inputs.
    #[derive(Debug, Clone)]
    mechanism Arms {
        param a = 1, b = 1.6, c = 1.5, d = 0.8, e = 1.7, g = 9.81, k = 3;
        coordinate theta1, theta2, theta3, theta4;
        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;
        drive Cranks by theta1, theta4;
        drive Chain by theta1, theta2;
        body left { mass 1; inertia 0.2; center (a/2)@theta1; angle theta1; }
        body arm { mass 2; inertia 0.9; center a@theta1 + (b/2, 0.1)@theta2; angle theta2; }
        body forearm { mass 1.7; inertia 0.7; center e@0 + d@theta4 + (c/2)@theta3; angle theta3; }
        body right { mass 0.9; inertia 0.1; center e@0 + (d/2)@theta4; angle theta4; }
        scene OnCranks of Cranks { inertia; gravity (0, -g); spring k, 0.4 on theta1; energy; }
        scene OnChain of Chain { inertia; gravity (0, -g); spring k, 0.4 on theta1; energy; }
    }
}

/// The two arms come in line, where the cranks do not drive them; with one crank and its arm as inputs, other poses are
/// singular.
#[test]
fn two_inputs_by_either_choice() {
    let (cranks, chain) = (OnCranks::default(), OnChain::default());
    let q = ArmsCoordinates { theta1: 1.3, theta2: 0.3, theta3: 2.0, theta4: 0.9 };
    let q = cranks.mechanism.solve(&q).unwrap().coordinates;
    let mut one =
        simulate(&cranks, Start { t: 0.0, q, input_rates: CranksInputs { theta1: 1.0, theta4: -2.0 } }, 3.0, 1e-13)
            .unwrap();
    let rate = one.state().rates;
    let rates = ChainInputs { theta1: rate.theta1, theta2: rate.theta2 };
    let mut other = simulate(&chain, Start { t: 0.0, q, input_rates: rates }, 3.0, 1e-13).unwrap();
    let start = cranks.energy(&q, CranksInputs { theta1: 1.0, theta4: -2.0 }).unwrap();
    one.finish(|_, _| true).unwrap();
    other.finish(|_, _| true).unwrap();
    println!("{:?} {:?} {:?}", one.state(), one.counts(), one.passages());
    println!("{:?} {:?} {:?}", other.state(), other.counts(), other.passages());
    let (a, b) = (one.state().q, other.state().q);
    for (a, b) in [(a.theta1, b.theta1), (a.theta2, b.theta2), (a.theta3, b.theta3), (a.theta4, b.theta4)] {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    let end =
        cranks.energy(&a, CranksInputs { theta1: one.state().rates.theta1, theta4: one.state().rates.theta4 }).unwrap();
    let drift = (end.kinetic + end.potential - start.kinetic - start.potential).abs();
    assert!(drift < 1e-9, "{drift:e}");
    assert!(one.passages().exchanges >= 2 && other.passages().exchanges + one.passages().exchanges >= 4);
}
