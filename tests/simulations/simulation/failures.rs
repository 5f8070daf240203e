//! A simulation that fails returns the reason, and keeps the computed states.

use linkage::simulation::{Start, simulate};
use linkage::{InputError, MotionError, PositionError, linkage};

use super::rig::{Fading, Given, Idling, start};

#[test]
fn a_law_that_ends() {
    let scene = Fading::default();
    let mut motion = simulate(&scene, Start { t: 0.0, q: start(), input_rates: 1.0 }, 2.0, 1e-9).unwrap();
    let states: Vec<_> = motion.by_ref().collect();
    let (last, before) = states.split_last().unwrap();
    let error = last.unwrap_err();
    println!("{error:?} {}", motion.t());
    assert!(
        matches!(error, MotionError::Position(PositionError::NotFinite { quantity, .. }) if quantity.contains("torque")),
        "{error:?}"
    );
    // Up to the last moment at which there is a torque.
    assert!(before.len() > 5 && before.iter().all(Result::is_ok));
    assert!(motion.t() > 1.0 - 1e-6 && motion.t() <= 1.0);
    assert!(motion.next().is_none());
    assert_eq!(before.last().unwrap().unwrap(), *motion.state());
    // The simulation by output times.
    let mut motion = simulate(&scene, Start { t: 0.0, q: start(), input_rates: 1.0 }, 2.0, 1e-9).unwrap();
    let states: Vec<_> = motion.at([0.25, 0.5, 1.5, 1.75]).collect();
    assert!(states.len() == 3 && states[1].is_ok() && states[2] == Err(error), "{states:?}");
}

#[test]
fn invalid_starts() {
    let mut scene = Idling::default();
    let error = |scene: &Idling<f64>, tolerance: f64, rate: f64, end: f64| {
        simulate(scene, Start { t: 0.0, q: start(), input_rates: rate }, end, tolerance).err()
    };
    assert!(error(&scene, 1e-9, 1.0, 1.0).is_none());
    assert!(matches!(error(&scene, 0.0, 1.0, 1.0), Some(MotionError::Input(InputError::OutOfRange { .. }))));
    assert!(matches!(error(&scene, 1e-9, 1.0, f64::NAN), Some(MotionError::Input(InputError::OutOfRange { .. }))));
    assert!(error(&scene, 1e-9, f64::NAN, 1.0).is_some());
    scene.m = 0.0;
    assert!(matches!(error(&scene, 1e-9, 1.0, 1.0), Some(MotionError::NoInertia { coordinate: "theta", .. })));
    scene.m = -1.0;
    assert!(matches!(error(&scene, 1e-9, 1.0, 1.0), Some(MotionError::Input(InputError::OutOfRange { .. }))));
    let given = Given::default();
    let rate = simulate(&given, Start { t: 0.0, q: start(), input_rates: 1.0 }, 1.0, 1e-9).err();
    assert!(matches!(rate, Some(MotionError::Input(InputError::Inconsistent { quantity: "rate", .. }))), "{rate:?}");
    let place = simulate(&given, Start { t: 0.5, q: start(), input_rates: 2.0 }, 1.0, 1e-9).err();
    assert!(
        matches!(place, Some(MotionError::Input(InputError::Inconsistent { quantity: "position", .. }))),
        "{place:?}"
    );
}

linkage! {
    /// A drive to positions that do not exist.
    mechanism Reach {
        param r = 0.05, l = 0.18;
        input z;
        unknown phi, psi;
        loop r@phi + l@psi = (z, 0);
        body rod { mass 1; inertia 0.1; center (r/2)@phi; angle phi; }
        scene Pulled { inertia; drive z = 0.2 + 0.1 * t; }
    }
}

/// At 0.3 s crank and rod are in line, and the prescribed motion goes on.
#[test]
fn a_drive_beyond_the_dead_point() {
    let scene = Pulled::default();
    let q = ReachCoordinates { z: 0.2, phi: 0.9, psi: -0.2 };
    let q = scene.mechanism.solve(&q).unwrap().coordinates;
    let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 0.1 }, 1.0, 1e-9).unwrap();
    let error = motion.finish(|_, _| true).unwrap_err();
    println!("{error:?} at {}", motion.t());
    assert!(
        matches!(error, MotionError::Position(PositionError::Singular { mechanism: "Reach", group: "phi, psi", .. })),
        "{error:?}"
    );
    assert!(motion.t() > 0.299 && motion.t() <= 0.3, "{}", motion.t());
    assert!((motion.state().q.z - (0.2 + 0.1 * motion.t())).abs() < 1e-15);
}
