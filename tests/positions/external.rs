//! User functions: one call for all derivatives at one argument, an error where they have no value, and equations that
//! are solved for their argument.

use std::cell::Cell;

use linkage::{Mechanism, PositionError, Real, linkage};

thread_local! {
    static CALLS: Cell<usize> = const { Cell::new(0) };
}

/// (x + a)^3 with its derivatives, for x up to 10; counts its calls.
fn cubic<T: Real>(x: T, a: T) -> (T, T, T, T) {
    CALLS.set(CALLS.get() + 1);
    let number = |value: f64| linkage::nalgebra::convert::<f64, T>(value);
    let base = if x > number(10.0) { number(f64::NAN) } else { x + a };
    (base * base * base, number(3.0) * base * base, number(6.0) * base, number(6.0))
}

linkage! {
    /// A slider moved by a cam, and the same where the slider drives.
    #[derive(Debug, Clone)]
    mechanism Wedge {
        param a = 0.5, k = 2;
        coordinate x, y, z;
        extern fn cubic(x, a) -> (c, dc, ddc, dddc);
        equation y = k * c(x, a);
        equation z = dc(x, a) + c(y / 100, a) * dc(y / 100, a);
        output slope = dc(x, a);
        drive Cam by x;
        drive Slider by y;
    }
}

fn calls<R>(run: impl FnOnce() -> R) -> (R, usize) {
    CALLS.set(0);
    let result = run();
    (result, CALLS.get())
}

/// y = 2 (x + 1/2)^3 at x = 1, and z.
fn at_one() -> WedgeCoordinates {
    let other: f64 = 0.0675 + 0.5;
    WedgeCoordinates { x: 1.0, y: 6.75, z: 3.0 * 2.25 + 3.0 * other.powi(5) }
}

#[test]
fn one_call_for_each_argument() {
    let cam = Cam::default();
    let q = at_one();
    let (pose, count) = calls(|| cam.pose_at(&q));
    assert_eq!(count, 2);
    let (_, count) = calls(|| {
        assert!(cam.residual(&pose).largest() < 1e-14);
        assert_eq!(cam.jacobian(&pose)[(0, 0)], -13.5);
        let velocity = cam.velocity(&pose, 1.0).unwrap();
        let accelerations = cam.acceleration(&pose, &velocity, 1.0).unwrap();
        cam.output_accelerations(&pose, &velocity, &accelerations).unwrap();
        cam.output_ratios(&pose).unwrap();
    });
    assert_eq!(count, 0);
    assert_eq!(calls(|| cam.motion(&q, 1.0, 0.0).unwrap()).1, 2);
    assert_eq!(calls(|| cam.assemble(1.0, CamBranch {}).unwrap()).1, 2);
}

#[test]
fn arguments_of_functions_are_found_by_newton() {
    let slider = Slider::default();
    let guess = WedgeCoordinates { x: 0.3, z: 0.0, ..at_one() };
    let q = slider.solve(&guess).unwrap().coordinates;
    assert!((q.x - 1.0).abs() < 1e-15 && (q.z - at_one().z).abs() < 1e-14, "{q:?}");
    // dx/dy = 1 / (k c') = 1 / 13.5
    let motion = slider.motion(&q, 13.5, 0.0).unwrap();
    assert!((motion.rates.x - 1.0).abs() < 1e-15);
    // y'' = k (c'' x'^2 + c' x'') = 0
    assert!((motion.accelerations.x + 9.0 / 6.75).abs() < 1e-14);
    let group = Slider::DERIVATION.groups[0].kind;
    assert_eq!(group, "one unknown");
    // Where the cam is flat the slider cannot drive it.
    let flat = WedgeCoordinates { x: -0.5, y: 0.0, z: 0.0 };
    let error = slider.velocity_ratios(&slider.pose_at(&flat)).unwrap_err();
    assert!(matches!(error, PositionError::Singular { group: "x", .. }), "{error:?}");
}

#[test]
fn no_value_is_an_error() {
    let cam = Cam::default();
    let q = WedgeCoordinates { x: 11.0, ..at_one() };
    let pose = cam.pose_at(&q);
    let not_finite = |error: PositionError| assert!(matches!(error, PositionError::NotFinite { .. }), "{error:?}");
    let rates = WedgeRates { x: 1.0, y: 13.5, z: 7.0 };
    let accelerations = WedgeAccelerations { x: 1.0, y: 13.5, z: 7.0 };
    not_finite(cam.solve(&q).unwrap_err());
    not_finite(cam.velocity_ratios(&pose).unwrap_err());
    not_finite(cam.velocity(&pose, 1.0).unwrap_err());
    not_finite(cam.acceleration(&pose, &rates, 1.0).unwrap_err());
    not_finite(cam.motion(&q, 1.0, 0.0).unwrap_err());
    not_finite(cam.assemble(11.0, CamBranch {}).unwrap_err());
    not_finite(cam.outputs(&pose).unwrap_err());
    not_finite(cam.output_rates(&pose, &rates).unwrap_err());
    not_finite(cam.output_accelerations(&pose, &rates, &accelerations).unwrap_err());
    not_finite(cam.output_ratios(&pose).unwrap_err());
    // J has the derivative of an unknown's function off the diagonal.
    let q = WedgeCoordinates { y: 2000.0, ..at_one() };
    not_finite(cam.solve_jacobian(&cam.pose_at(&q), &[1.0, 1.0].into()).unwrap_err());
    // J is the function itself.
    let slider = Slider::default();
    let q = WedgeCoordinates { x: 11.0, ..at_one() };
    not_finite(slider.velocity_ratios(&slider.pose_at(&q)).unwrap_err());
    not_finite(slider.solve(&q).unwrap_err());
}

/// s^4 / 4 and its derivative only.
fn quartic<T: Real>(s: T) -> (T, T) {
    let cube = s * s * s;
    (cube * s * linkage::nalgebra::convert::<f64, T>(0.25), cube)
}

linkage! {
    /// A ball on a nonlinear spring to the origin.
    #[derive(Debug, Clone)]
    mechanism Tied {
        param m = 1;
        input x, y;
        extern fn quartic(s) -> (energy, force);
        body ball { mass m; center (x, y); }
        scene Pulled { inertia; potential energy(norm((x, y))); }
    }
}

/// A force needs the first derivative of its potential only, also along a length that is zero.
#[test]
fn a_potential_of_a_length() {
    let pulled = Pulled::default();
    let rates = TiedInputs { x: 0.0, y: 0.0 };
    for ([x, y], expected) in [([0.3, 0.4], [-0.075, -0.1]), ([0.0, 0.0], [0.0, 0.0])] {
        let forces = pulled.forces(0.0, &TiedCoordinates { x, y }, rates).unwrap();
        assert!((forces[0] - expected[0]).abs() < 1e-16 && (forces[1] - expected[1]).abs() < 1e-16, "{forces:?}");
    }
}
