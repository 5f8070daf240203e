//! Motions over many periods.

use linkage::linkage;
use linkage::simulation::{Start, simulate};

linkage! {
    /// Problem A01 of the benchmark library of IFToMM (lim.ii.udc.es/mbsbenchmark): 1 kg on a massless rod of 1 m.
    mechanism Pendulum {
        param l = 1, m = 1, g = 9.81;
        input phi;
        unknown x, y;
        loop l@phi = (x, y);
        body bob { mass m; center (x, y); }
        scene Swinging { inertia; gravity (0, -g); energy; }
    }
}

/// x and y, let go at rest at the horizontal: Jacobi's elliptic functions, computed with 20 digits.
const EXACT: [(f64, f64, f64); 6] = [
    (0.5, 0.391_048_791_550_546_4, -0.920_369_948_785_192_2),
    (1.0, -0.986_291_751_131_875_3, -0.165_010_853_125_541_17),
    (10.0, 0.275_087_462_576_116_9, -0.961_419_205_099_125_1),
    (100.0, 0.181_513_351_427_031_38, -0.983_388_480_334_057_5),
    (1000.0, -0.683_230_188_552_314_9, -0.730_203_060_422_762_3),
    (2000.0, -0.814_603_068_589_032_2, -0.580_018_827_836_935_5),
];

#[test]
fn a_pendulum_for_100_seconds() {
    is_exact_for_long(&EXACT[..4]);
}

/// 845 periods.
#[test]
fn a_pendulum_for_2000_seconds() {
    is_exact_for_long(&EXACT);
}

fn is_exact_for_long(rows: &[(f64, f64, f64)]) {
    let scene = Swinging::default();
    let start = PendulumCoordinates { phi: 0.0, x: 1.0, y: 0.0 };
    let (end, _, _) = rows[rows.len() - 1];
    let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: 0.0 }, end, 1e-13).unwrap();
    let states: Vec<_> = motion.at(rows.iter().map(|row| row.0)).map(Result::unwrap).collect();
    assert_eq!(states.len(), rows.len());
    for (state, &(t, x, y)) in states.iter().zip(rows) {
        let error = (state.q.x - x).hypot(state.q.y - y);
        println!("{t}: {error:e}");
        // An error of the energy turns into one of the phase that grows with time.
        assert!(error < 1e-13 + 4e-12 * t, "{t}: {error:e}");
        assert!((state.q.x.hypot(state.q.y) - 1.0).abs() < 4e-16);
    }
    println!("{:?}", motion.counts());
}

linkage! {
    /// Four uniform bars of 1 kg.
    mechanism Bars {
        param a = 0.3, b = 0.9, c = 0.6, d = 1, m = 1, g = 9.81;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = d@0 + c@psi;
        body crank { mass m; inertia m * a^2 / 12; center (a/2)@theta; angle theta; }
        body coupler { mass m; inertia m * b^2 / 12; center a@theta + (b/2)@phi; angle phi; }
        body rocker { mass m; inertia m * c^2 / 12; center d@0 + (c/2)@psi; angle psi; }
        scene Turning { inertia; gravity (0, -g); energy; }
    }
}

#[test]
fn a_four_bar_for_44_turns() {
    let scene = Turning::default();
    let q = scene.mechanism.solve(&BarsCoordinates { theta: 1.0, phi: 0.4, psi: 1.6 }).unwrap().coordinates;
    let energy = |q: &BarsCoordinates<f64>, speed: f64| {
        let energy = scene.energy(q, speed).unwrap();
        energy.kinetic + energy.potential
    };
    let start = energy(&q, 12.0);
    let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 12.0 }, 20.0, 1e-13).unwrap();
    motion
        .finish(|state, _| {
            assert!((energy(&state.q, state.rates.theta) / start - 1.0).abs() < 1e-10);
            true
        })
        .unwrap();
    let error = motion.state().q.theta - REFERENCE;
    println!("{error:e} {:?}", motion.counts());
    assert!(error.abs() < 1e-8, "{error:e}");
}

/// theta after 20 s, by another program in double precision. Integrators of order four with steps of 1 ms are off by 5e-6 with
/// the loop equations solved at each step, by 4e-5 with Baumgarte's stabilisation, and by 4e-4 with accelerations alone.
const REFERENCE: f64 = 274.967_493_169_763_77;
