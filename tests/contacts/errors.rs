//! What is refused, by name.

use linkage::integrate::{Tolerance, dop853};
use linkage::{Error, Scene};

use super::machines::*;
use super::moving::{Moving, Wrapped, close};

/// Errors name the friction or the stop.
#[test]
fn errors_name_the_friction_or_the_stop() {
    let negative = Sliding { mu: -0.1, ..Sliding::default() };
    let named = Error::Negative { scene: "Sliding", quantity: "friction on x", value: -0.1 };
    assert_eq!(negative.check(), Err(named));
    assert_eq!(negative.start(0.0, &block(0.0), &1.0.into()), Err(named));
    let bouncing = |lower: f64, upper: f64, e: f64| Bouncing { lower, upper, e, ..Bouncing::default() };
    assert_eq!(
        bouncing(-1.0, 1.0, 1.5).check(),
        Err(Error::Restitution { scene: "Bouncing", stop: "stop on height", value: 1.5 })
    );
    let none = Error::NoRange { scene: "Bouncing", stop: "stop on height", lower: 1.0, upper: 1.0 };
    assert_eq!(bouncing(1.0, 1.0, 0.5).check(), Err(none));
    let nan = Error::NotFinite { mechanism: "Bouncing", quantity: "stop on height" };
    assert_eq!(bouncing(f64::NAN, 1.0, 0.5).check(), Err(nan));
    let beyond = Error::BeyondStop { scene: "Bouncing", stop: "stop on height", gap: 0.5 };
    let scene = bouncing(-1.0, 1.0, 0.5);
    assert_eq!(scene.start(0.0, &block(0.75), &0.0.into()), Err(beyond));
    assert_eq!(beyond.to_string(), "Bouncing begins beyond the stop on height: by 5.0e-1");
    // Rounding is no reason to refuse.
    assert!(scene.start(0.0, &block(0.5 + 1e-16), &0.0.into()).is_ok());
    let broken = Jointed { r2: f64::INFINITY, ..Jointed::default() };
    let guess = MachineCoordinates { phi: 0.8, psi: 2.9, z: 0.4 };
    let named = Error::NotFinite { mechanism: "Jointed", quantity: "friction on joint" };
    assert_eq!(broken.contacts(0.0, &guess, &guess).map(|_| ()), Err(named));
    // A law that turns negative on the way.
    let curved = Curved { brake1: -1.0, ..Curved::default() };
    assert!(
        matches!(curved.contacts(0.0, &pair(1.0, 1.0), &pair(0.0, 0.0)), Err(Error::Negative { value, .. }) if value < 0.0)
    );
    // A drive through a stop.
    let driven = Driven::default();
    let q = BeltCoordinates { slip: 0.0, x: 0.0, z: 0.0 };
    let start = driven.start(0.0, &q, &BeltInputs { x: 0.0, z: 0.5 }).unwrap();
    let (moving, y) = Moving::start(&driven, 0.0, &start).unwrap();
    let tolerance = Tolerance::new(1e-10, [1.0; 5]).unwrap();
    let mut motion = dop853(Wrapped(moving), (0.0, y), 9.0, tolerance).unwrap();
    let named = Error::NoContactForces { scene: "Driven", contact: "stop on z" };
    assert_eq!(motion.finish(|_, _| true), Err(named));
    close("there", motion.t(), 2.0, 1e-12);
    assert_eq!(named.to_string(), "no forces of frictions and stops agree with the motion of Driven: stop on z");
}
