//! Errors of contacts, with the names of friction and stop.

use linkage::integrate::{Tolerance, dop853};
use linkage::{InputError, MotionError, PositionError, Scene};

use super::machines::*;
use linkage_oracle::close;

use super::moving::Moving;

fn outside(of: &'static str, quantity: &'static str, value: f64, most: f64) -> MotionError {
    InputError::OutOfRange { of: Some(of), quantity, value, least: 0.0, most }.into()
}

/// Errors name the friction or the stop.
#[test]
fn errors_name_the_friction_or_the_stop() {
    let negative = Sliding { mu: -0.1, ..Sliding::default() };
    let named = outside("Sliding", "friction on x", -0.1, f64::MAX);
    assert_eq!(negative.check(), Err(named));
    assert_eq!(negative.start(0.0, &block(0.0), &1.0.into()), Err(named));
    let bouncing = |lower: f64, upper: f64, e: f64| Bouncing { lower, upper, e, ..Bouncing::default() };
    assert_eq!(bouncing(-1.0, 1.0, 1.5).check(), Err(outside("stop on height", "the restitution", 1.5, 1.0)));
    let none = InputError::EmptyRange { scene: "Bouncing", stop: "stop on height", lower: 1.0, upper: 1.0 };
    assert_eq!(bouncing(1.0, 1.0, 0.5).check(), Err(none.into()));
    let nan = PositionError::NotFinite { mechanism: "Bouncing", quantity: "stop on height" };
    assert_eq!(bouncing(f64::NAN, 1.0, 0.5).check(), Err(nan.into()));
    let beyond = InputError::BeyondStop { scene: "Bouncing", stop: "stop on height", gap: 0.5 };
    let scene = bouncing(-1.0, 1.0, 0.5);
    assert_eq!(scene.start(0.0, &block(0.75), &0.0.into()), Err(beyond.into()));
    assert_eq!(beyond.to_string(), "Bouncing starts 5.0e-1 beyond the stop on height");
    // A rounding error of the start is accepted.
    assert!(scene.start(0.0, &block(0.5 + 1e-16), &0.0.into()).is_ok());
    let broken = Jointed { r2: f64::INFINITY, ..Jointed::default() };
    let guess = MachineCoordinates { phi: 0.8, psi: 2.9, z: 0.4 };
    let rates = MachineRates { phi: 0.8, psi: 2.9, z: 0.4 };
    let named = PositionError::NotFinite { mechanism: "Jointed", quantity: "friction on joint" };
    assert_eq!(broken.contacts(0.0, &guess, &rates).map(|_| ()), Err(named.into()));
    // A friction law with a negative value.
    let curved = Curved { brake1: -1.0, ..Curved::default() };
    let rates = PairRates { theta1: 0.0, theta2: 0.4, theta3: 1.9, theta4: 0.0 };
    let found = curved.contacts(0.0, &pair(1.0, 1.0), &rates);
    assert!(matches!(found, Err(MotionError::Input(InputError::OutOfRange { value, .. })) if value < 0.0), "{found:?}");
    // A drive through a stop.
    let driven = Driven::default();
    let q = BeltCoordinates { slip: 0.0, x: 0.0, z: 0.0 };
    let start = driven.start(0.0, &q, &BeltInputs { x: 0.0, z: 0.5 }).unwrap();
    let (moving, y) = Moving::start(&driven, 0.0, &start).unwrap();
    let tolerance = Tolerance::new(1e-10, [1.0; 5]).unwrap();
    let mut motion = dop853(moving, (0.0, y), 9.0, tolerance).unwrap();
    let named = MotionError::NoContactForces { scene: "Driven", contact: "stop on z" };
    assert_eq!(motion.finish(|_, _| true), Err(named));
    close("there", motion.t(), 2.0, 1e-12);
    let text = "no contact forces satisfy the motion of Driven, stop on z included: a prescribed motion drives through a stop, \
                or stops contradict each other";
    assert_eq!(named.to_string(), text);
}
