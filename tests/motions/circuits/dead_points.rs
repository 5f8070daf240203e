//! Inputs that are lengths: a motion goes from dead point to dead point.

use linkage::circuits::{CircuitOptions, Circuits, CurveEnd};
use linkage::linkage;

use linkage_gallery::slider_crank::*;

use crate::circuits::{circuits, counts, dead_inputs};

linkage! {
    /// Two arms of different reach hold one slider: the shorter one limits it.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TwoArms {
        param a = 2, b = 1.5, c = 2.5, d = 2.2;
        input s;
        unknown p, q, u, v;
        loop a@p + b@q = s@0;
        loop c@u + d@v = s@0;
    }
    /// A rack, a wheel, and a follower of the wheel.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Rack {
        param r = 0.5, crank = 1, rod = 3;
        input x;
        unknown phi, rod_angle, s;
        equation x = r * phi;
        loop crank@phi + rod@rod_angle = s@0;
    }
}

#[test]
fn slider_crank_by_its_crank_and_by_its_slider() {
    assert_eq!(counts(&circuits(&Compressor::default(), 0.4)), [2, 2, 2]);
    let engine = circuits(&Engine::default(), 3.0);
    assert_eq!(counts(&engine), [2, 1, 0]);
    assert_eq!(engine.motions[0].end, CurveEnd::Closed { turns: 0 });
    for (found, exact) in dead_inputs(&engine.motions[0]).iter().zip([2.0, 4.0]) {
        assert!((found - exact).abs() < 1e-14, "{found} {exact}");
    }
    // The other side of the crank's pivot is another circuit.
    let both = Circuits::over(&Engine::default(), [3.0, -3.0, 2.5, 1.0], CircuitOptions::default()).unwrap();
    assert_eq!(counts(&both), [6, 2, 0]);
    assert_eq!(both.modes.iter().map(|mode| mode.motion).collect::<Vec<_>>(), [0, 0, 1, 1, 0, 0]);
}

/// At each dead point of the first arm the second one keeps its side: four modes, two circuits.
#[test]
fn dead_points_of_one_group_join_modes_that_differ_in_it() {
    let found = circuits(&TwoArms::default(), 2.0);
    assert_eq!(counts(&found), [4, 2, 0]);
    for motion in &found.motions {
        assert!(dead_inputs(motion).iter().zip([0.5, 3.5]).all(|(found, exact)| (found - exact).abs() < 1e-14));
        for meeting in motion.dead_points() {
            let branches = meeting.modes.map(|mode| found.modes[mode.unwrap()].branch);
            assert!(branches[0].p_q != branches[1].p_q && branches[0].u_v == branches[1].u_v, "{branches:?}");
        }
    }
}

/// The rack goes on turn by turn, in both directions from the start.
#[test]
fn motion_without_end_is_open() {
    let options = CircuitOptions { most_turns: 5, ..CircuitOptions::default() };
    let found = Circuits::of(&Rack::default(), 0.3, options).unwrap();
    assert_eq!(counts(&found), [2, 2, 0]);
    for motion in &found.motions {
        assert_eq!(motion.end, CurveEnd::Open);
        let turned = motion.points[motion.points.len() - 1].position.phi - motion.points[0].position.phi;
        assert!((10.0..10.2).contains(&(turned / std::f64::consts::TAU)), "{turned}");
    }
}
