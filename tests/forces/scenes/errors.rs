//! Errors of scenes, with the names of their causes.

use linkage::{InputError, MotionError, PositionError, Scene};

use super::machines::*;

/// Checks the name in the error message.
#[test]
fn errors_name_the_body_or_the_effect() {
    let q = four_bar_at([0.4]).unwrap();
    let inputs = LoadedFourBarInputs { theta2: 2.0 };
    let mut scene = Loaded { m3: -0.1, ..Loaded::default() };
    let error = scene.start(0.0, &q, &inputs).unwrap_err();
    let (quantity, most) = ("the mass of coupler", f64::MAX);
    let expected = InputError::OutOfRange { of: Some("Loaded"), quantity, value: -0.1, least: 0.0, most };
    assert_eq!(error, expected.into());
    let said = "the mass of coupler of Loaded is -0.1: it must be at least 0.0";
    assert_eq!(error.to_string(), said);
    scene.m3 = f64::NAN;
    let named = |quantity| Err(PositionError::NotFinite { mechanism: "Loaded", quantity }.into());
    assert_eq!(scene.check(), named("the mass of coupler"));

    let broken = |change: fn(&mut Loaded)| {
        let mut scene = Loaded::default();
        change(&mut scene);
        scene.forces(0.0, &q, inputs).map(|_| ())
    };
    assert_eq!(broken(|scene| scene.t0 = f64::NAN), named("torque on theta2"));
    assert_eq!(broken(|scene| scene.kt = f64::INFINITY), named("spring on theta4"));
    assert_eq!(broken(|scene| scene.c = f64::NAN), named("damper between C and P"));
    assert_eq!(broken(|scene| scene.m4 = f64::NAN), named("body rocker"));
    assert_eq!(broken(|_| ()), Ok(()));
    let laws = Loaded::default().acceleration(f64::NAN, &q, inputs);
    assert_eq!(laws.map(|_| ()), named("torque on theta2"));

    // Without masses no input has inertia; without one of two, that input has none.
    let mut light = Idle::default();
    (light.m2, light.j2, light.m3, light.j3, light.m4, light.j4) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let error = light.acceleration(0.0, &q, inputs).unwrap_err();
    assert_eq!(error, MotionError::NoInertia { scene: "Idle", coordinate: "theta2", share: 0.0 });

    // A motion that does not begin where its drive does.
    let driven = Driven::default();
    let start = |theta2: f64, rate: f64| {
        driven.start(0.0, &four_bar_at([theta2]).unwrap(), &LoadedFourBarInputs { theta2: rate })
    };
    assert!(start(0.0, 15.0).is_ok());
    let wrong =
        |quantity, gap| Err(InputError::Inconsistent { scene: "Driven", coordinate: "theta2", quantity, gap }.into());
    assert_eq!(start(0.25, 15.0), wrong("position", 0.25));
    assert_eq!(start(0.0, 16.0), wrong("rate", 1.0));
    let without_rate = start(0.0, f64::NAN);
    assert!(matches!(without_rate, Err(MotionError::Input(InputError::Inconsistent { quantity: "rate", .. }))));
    // A start whose loops are open.
    let open = LoadedFourBarCoordinates { theta2: 0.4, theta3: f64::NAN, theta4: 0.0 };
    let torn = Idle::default().start(0.0, &open, &inputs);
    assert!(matches!(torn, Err(MotionError::Position(PositionError::NotFinite { .. }))));
}

/// A dead point: the coupler and the rocker in line.
#[test]
fn a_dead_point_is_an_error() {
    let mut idle = Idle::default();
    (idle.mechanism.l1, idle.mechanism.l2) = (1.0, 0.5);
    // -0.5 + 0.8 + 0.7 = 1, all on one line.
    idle.mechanism.l3 = 0.8;
    let q = LoadedFourBarCoordinates { theta2: std::f64::consts::PI, theta3: 0.0, theta4: 0.0 };
    let error = idle.rates(0.0, &q, 1.0).unwrap_err();
    assert!(
        matches!(
            error,
            MotionError::Position(PositionError::Singular { mechanism: "Idle", group: "theta3, theta4", .. })
        ),
        "{error}"
    );
}
