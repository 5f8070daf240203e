//! Four-bars: Grashof's theorem says how many circuits there are, and which links turn.

use std::f64::consts::{PI, TAU};

use linkage::circuits::{CircuitError, CircuitOptions, Circuits, CurveEnd};
use linkage::continuation::{AtChangePoint, Options};
use linkage::{Elbow, PathError, linkage};

use linkage_gallery::coupled_wheels::*;
use linkage_gallery::norton_four_bar::*;

use crate::circuits::{circuits, counts, dead_inputs};

linkage! {
    /// A four-bar whose links are compared with the theorems.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Bars {
        param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
    }
}

fn bars(ground: f64, crank: f64, coupler: f64, rocker: f64) -> Bars {
    Bars { ground, crank, coupler, rocker }
}

/// The crank angle at which the distance of its pin from the other ground pivot is this:
/// crank^2 + ground^2 - 2 crank ground cos theta = distance^2.
fn limit(m: &Bars, distance: f64) -> f64 {
    ((m.crank.powi(2) + m.ground.powi(2) - distance.powi(2)) / (2.0 * m.crank * m.ground)).acos()
}

#[test]
fn crank_rocker_and_drag_link_have_two_circuits_that_turn_fully() {
    for input in [-2.0, 0.3, 7.0] {
        let found = circuits(&NortonFourBar::default(), input);
        assert_eq!(counts(&found), [2, 2, 2]);
        assert_eq!(found.modes[0].branch, NortonFourBarBranch::new(Elbow::Left));
        let drag_link = circuits(&bars(1.0, 3.0, 2.5, 2.0), input);
        assert_eq!(counts(&drag_link), [2, 2, 2]);
        for (number, motion) in drag_link.motions.iter().enumerate() {
            assert_eq!(motion.end, CurveEnd::Closed { turns: 1 });
            assert_eq!(motion.modes().collect::<Vec<_>>(), [number]);
            let [least, largest] = motion.range().unwrap();
            assert!((least - input).abs() < 1e-12 && (largest - input - TAU).abs() < 1e-12);
            // The follower turns with the crank.
            let [first, last] = [motion.points.first(), motion.points.last()].map(|at| at.unwrap().position.psi);
            assert!((last - first - TAU).abs() < 1e-12);
        }
    }
}

#[test]
fn four_bar_that_violates_grashof_has_one_circuit_with_two_dead_points() {
    for (ground, crank, coupler, rocker) in [(4.0, 3.0, 2.0, 2.5), (5.0, 4.0, 3.5, 3.0), (40.0, 35.0, 25.0, 25.0)] {
        let m = bars(ground, crank, coupler, rocker);
        let most = limit(&m, coupler + rocker);
        let found = circuits(&m, 0.1);
        assert_eq!(counts(&found), [2, 1, 0]);
        let motion = &found.motions[0];
        assert_eq!(motion.end, CurveEnd::Closed { turns: 0 });
        assert_eq!(motion.modes().collect::<Vec<_>>(), [0, 1]);
        let inputs = dead_inputs(motion);
        assert_eq!(inputs.len(), 2);
        for (found, exact) in inputs.iter().zip([-most, most]) {
            assert!((found - exact).abs() < 1e-13, "{found} {exact}");
        }
        let meetings: Vec<_> = motion.dead_points().map(|at| at.modes).collect();
        assert_eq!(meetings, [[Some(0), Some(1)], [Some(1), Some(0)]]);
    }
}

/// The coupler is shortest: the crank swings above the line of the pivots or below it. One start input has the modes of
/// one circuit, two have both.
#[test]
fn double_rocker_has_one_circuit_on_either_side() {
    let m = bars(4.0, 3.0, 1.0, 3.5);
    let [least, most] = [limit(&m, 2.5), limit(&m, 4.5)];
    let above = f64::midpoint(least, most);
    let found = circuits(&m, above);
    assert_eq!(counts(&found), [2, 1, 0]);
    for (found, exact) in dead_inputs(&found.motions[0]).iter().zip([least, most]) {
        assert!((found - exact).abs() < 1e-13, "{found} {exact}");
    }
    // The last input is one of the first circuit again.
    let both = Circuits::over(&m, [above, -above, above + 0.2], CircuitOptions::default()).unwrap();
    assert_eq!(counts(&both), [6, 2, 0]);
    let motions: Vec<usize> = both.modes.iter().map(|mode| mode.motion).collect();
    assert_eq!(motions, [0, 0, 1, 1, 0, 0]);
    assert!(
        dead_inputs(&both.motions[1]).iter().zip([-most, -least]).all(|(found, exact)| (found - exact).abs() < 1e-13)
    );
    // Whole turns later the positions are the same.
    let again = Circuits::over(&m, [above, above + TAU, above - 3.0 * TAU], CircuitOptions::default()).unwrap();
    assert_eq!(counts(&again), [2, 1, 0]);
    // No position at all.
    assert_eq!(counts(&circuits(&m, 0.0)), [0, 0, 0]);
}

/// The parallelogram and the antiparallelogram cross at both change points: two motions, one circuit.
#[test]
fn motions_that_cross_at_change_points_are_one_circuit() {
    let m = CoupledWheels::default();
    let found = circuits(&m, 0.6);
    assert_eq!((counts(&found), found.motions.len()), ([2, 1, 2], 2));
    for motion in &found.motions {
        let inputs: Vec<f64> = motion.change_points().map(|at| at.point.input).collect();
        assert!(inputs.iter().zip([PI, TAU]).all(|(found, exact)| (found - exact).abs() < 1e-7), "{inputs:?}");
        assert_eq!((inputs.len(), motion.dead_points().count()), (2, 0));
    }
    // If motions are switched at each change point, a motion is half a parallelogram and half an antiparallelogram.
    let at = |at_change_point| CircuitOptions {
        path: Options { at_change_point, ..Options::default() },
        ..CircuitOptions::default()
    };
    let switched = Circuits::of(&m, 0.6, at(AtChangePoint::Switch)).unwrap();
    assert_eq!((counts(&switched), switched.motions.len()), ([2, 1, 2], 2));
    let is_level = |position: &CoupledWheelsCoordinates| position.rod.sin().abs() < 1e-9;
    let level = |motion: usize| switched.motions[motion].points.iter().filter(|at| is_level(&at.position)).count();
    assert!(
        [0, 1].iter().all(|&motion| level(motion) > 3 && level(motion) + 3 < switched.motions[motion].points.len())
    );
    assert!(matches!(
        Circuits::of(&m, 0.6, at(AtChangePoint::Stop)),
        Err(CircuitError::Path { mode: 0, error: PathError::ChangePoint { .. } })
    ));
}

/// At a dead point two modes are one, and the motion has no direction of increasing input.
#[test]
fn start_at_a_dead_point_is_an_error_with_the_mode() {
    let m = bars(4.0, 3.0, 2.0, 2.5);
    let found = Circuits::of(&m, limit(&m, 4.5), CircuitOptions::default());
    assert!(
        matches!(found, Err(CircuitError::Path { mode: 0, error: PathError::NoDirection { .. } })),
        "{:?}",
        found.map(|found| found.modes)
    );
    for input in [f64::NAN, f64::INFINITY] {
        assert!(matches!(Circuits::of(&m, input, CircuitOptions::default()), Err(CircuitError::Position(_))));
    }
    let bounded = CircuitOptions { path: Options { most_steps: 5, ..Options::default() }, ..CircuitOptions::default() };
    assert!(matches!(
        Circuits::of(&m, 0.1, bounded),
        Err(CircuitError::Path { mode: 0, error: PathError::TooManySteps { steps: 5, .. } })
    ));
}

/// With limits of the input a motion goes from one to the other, or from a limit round a dead point to it again.
#[test]
fn limits_of_the_input_end_a_motion() {
    let within = |low: f64, high: f64| CircuitOptions {
        path: Options { range: Some([low, high]), ..Options::default() },
        ..CircuitOptions::default()
    };
    let found = Circuits::of(&NortonFourBar::default(), 0.5, within(0.0, 1.0)).unwrap();
    assert_eq!(counts(&found), [2, 2, 0]);
    for motion in &found.motions {
        assert_eq!((motion.end, motion.range()), (CurveEnd::Limits, Some([0.0, 1.0])));
        assert!(motion.points.windows(2).all(|pair| pair[0].input < pair[1].input));
    }
    let m = bars(4.0, 3.0, 2.0, 2.5);
    let found = Circuits::of(&m, 0.5, within(0.0, 3.0)).unwrap();
    assert_eq!(counts(&found), [2, 1, 0]);
    let motion = &found.motions[0];
    assert_eq!(motion.end, CurveEnd::Limits);
    assert_eq!([motion.points[0], motion.points[motion.points.len() - 1]].map(|at| at.input), [0.0, 0.0]);
    assert_eq!(motion.dead_points().map(|at| at.modes).collect::<Vec<_>>(), [[Some(0), Some(1)]]);
}

/// Ever nearer to a dead point there are two modes and one circuit, until the modes are too near: then an error.
#[test]
fn start_near_a_dead_point_is_found_or_an_error() {
    let m = bars(4.0, 3.0, 2.0, 2.5);
    let mut errors = 0;
    for digits in 1..=17 {
        match Circuits::of(&m, limit(&m, 4.5) - 10.0_f64.powi(-digits), CircuitOptions::default()) {
            Ok(found) => assert_eq!((errors, counts(&found)), (0, [2, 1, 0]), "{digits}"),
            Err(CircuitError::Path { error: PathError::NoDirection { .. }, .. }) => errors += 1,
            Err(error) => panic!("{digits}: {error}"),
        }
    }
    assert!((1..=5).contains(&errors), "{errors}");
}

/// Another unit of length changes no bit of an input; invalid lengths are errors or have circuits.
#[test]
fn lengths_of_any_magnitude() {
    let scaled = |scale: f64| bars(4.0 * scale, 3.0 * scale, 2.0 * scale, 2.5 * scale);
    let inputs = |m: &Bars| dead_inputs(&circuits(m, 0.5).motions[0]);
    let exact = inputs(&scaled(1.0));
    for power in [-200, -30, 30, 200] {
        assert_eq!(inputs(&scaled(2.0_f64.powi(power))), exact, "{power}");
    }
    // Squares of these lengths are near the ends of the range of numbers.
    for power in [-490, 490] {
        if let Ok(found) = Circuits::of(&scaled(2.0_f64.powi(power)), 0.5, CircuitOptions::default()) {
            assert_eq!(dead_inputs(&found.motions[0]), exact, "{power}");
        }
    }
    for invalid in [f64::NAN, f64::INFINITY, f64::MAX] {
        let m = Bars { coupler: invalid, ..scaled(1.0) };
        let found = Circuits::of(&m, 0.5, CircuitOptions::default());
        assert!(found.as_ref().map_or(true, |found| found.modes.is_empty()), "{invalid}");
    }
    // A crank of length zero turns.
    assert_eq!(counts(&circuits(&bars(4.0, 0.0, 3.0, 2.5), 0.5)), [2, 2, 2]);
    // Each ends, as circuits or as an error.
    for (ground, crank, coupler, rocker) in [(4.0, 3.0, 0.0, 2.5), (0.0, 3.0, 2.0, 2.5), (0.0, 0.0, 0.0, 0.0)] {
        if let Ok(found) = Circuits::of(&bars(ground, crank, coupler, rocker), 0.5, CircuitOptions::default()) {
            assert!(found.modes.len() <= 2 && found.circuits.len() <= found.modes.len(), "{:?}", counts(&found));
        }
    }
}
