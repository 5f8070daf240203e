//! Searches and integrations with numbers that overflow or are NaN: every position of such a number gives an error.

use linkage_dynamics::__rt::{equilibrium, reduced};
use linkage_dynamics::integrate::{FixedStep, Tolerance, dop853, dopri5};
use linkage_dynamics::{Balance, MotionError};
use linkage_runtime::__rt::{newton_group, regular};
use linkage_runtime::PositionError;
use linkage_runtime::nalgebra::SVector;

const IDENTITY: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];

/// The largest of several residuals is NaN if any of them is.
#[test]
fn a_residual_that_is_not_a_number_is_not_lost() {
    for row in 0..2 {
        let found = newton_group("mechanism", "a, b", [1.0, 2.0], |_| {
            let mut residual = [0.0; 2];
            residual[row] = f64::NAN;
            (residual, [1.0; 2], IDENTITY)
        });
        assert!(matches!(found, Err(PositionError::NotFinite { .. })), "row {row}: {found:?}");
    }
}

/// Relative to an infinite scale every residual would be zero, and the start accepted as a position.
#[test]
fn a_size_that_is_not_finite_closes_nothing() {
    for size in [f64::INFINITY, f64::NAN] {
        for row in 0..2 {
            let found = newton_group("mechanism", "a, b", [1.0, 2.0], |unknowns| {
                let mut sizes = [1.0; 2];
                sizes[row] = size;
                (unknowns, sizes, IDENTITY)
            });
            assert!(matches!(found, Err(PositionError::NotFinite { .. })), "row {row}, size {size}: {found:?}");
        }
    }
}

/// A residual may tend to zero at infinity; a step there must be rejected.
#[test]
fn no_unknown_is_infinite() {
    let found = newton_group("mechanism", "a", [0.0], |[a]: [f64; 1]| {
        ([if a.is_finite() { 1e5 } else { 0.0 }], [1.0], [[2_f64.powi(-1020)]])
    });
    assert!(matches!(found, Err(PositionError::NotConverged { .. })), "{found:?}");
}

/// An infinite determinant and an infinite pivot are errors: a quotient by infinity is zero, which looks like a result.
#[test]
fn nothing_is_divided_by_infinity() {
    for number in [f64::INFINITY, -f64::INFINITY, f64::NAN] {
        let found = regular("mechanism", "a, b", number, 1.0);
        assert!(matches!(found, Err(PositionError::NotFinite { .. })), "determinant {number}: {found:?}");
    }
    assert_eq!(regular("mechanism", "a, b", f64::MAX, f64::MAX), Ok(()));
    for number in [f64::INFINITY, f64::NAN] {
        for place in 0..2 {
            let mut mass = IDENTITY;
            mass[place][place] = number;
            let found = reduced("scene", ["a", "b"], mass, [1.0; 2]);
            let is_refused = matches!(found, Err(MotionError::Position(PositionError::NotFinite { .. })));
            assert!(is_refused, "mass {number} at {place}: {found:?}");
        }
    }
    assert_eq!(reduced("scene", ["a"], [[f64::MAX]], [f64::MAX]), Ok([1.0]));
}

/// An infinite scale, relative to which every force would be zero.
#[test]
fn an_equilibrium_of_infinite_forces_is_none() {
    for (scales, slopes) in [([f64::INFINITY], [[1.0]]), ([1.0], [[1e308]])] {
        let found = equilibrium("scene", [10.0], |[x]| Ok((x, Balance { forces: [x], scales, slopes })));
        assert!(matches!(found, Err(MotionError::Position(PositionError::NotFinite { .. }))), "{found:?}");
    }
}

#[test]
fn an_integration_begins_and_ends_at_finite_states() {
    let rate = |_: f64, _: &SVector<f64, 1>| Ok(SVector::from([1e308]));
    for y in [f64::NAN, f64::INFINITY] {
        assert!(matches!(FixedStep::new(rate, (0.0, SVector::from([y])), 1.0), Err(MotionError::NotFinite { .. })));
    }
    let tolerance = Tolerance::new(1e-6, [1.0]).unwrap();
    let mut steps = FixedStep::new(rate, (0.0, SVector::from([0.0])), 1.0).unwrap();
    assert!((0..3).any(|_| matches!(steps.step(), Err(MotionError::NotFinite { .. }))));
    // Relative to an infinite state every error would be zero.
    for states in [
        dopri5(rate, (0.0, SVector::from([0.0])), 1e3, tolerance)
            .unwrap()
            .map(|step| step.map(|s| s.state[0]))
            .collect(),
        dop853(rate, (0.0, SVector::from([0.0])), 1e3, tolerance)
            .unwrap()
            .map(|step| step.map(|s| s.state[0]))
            .collect(),
    ] as [Vec<Result<f64, MotionError>>; 2]
    {
        assert!(states.iter().flatten().all(|state| state.is_finite()), "{states:?}");
        assert!(matches!(states.last(), Some(Err(_))), "{states:?}");
    }
}

/// The time may overflow too.
#[test]
fn a_fixed_step_ends_at_a_finite_time() {
    let rate = |_: f64, _: &SVector<f64, 1>| Ok(SVector::from([0.0]));
    let mut steps = FixedStep::new(rate, (f64::MAX, SVector::from([0.0])), f64::MAX).unwrap();
    assert!(matches!(steps.step(), Err(MotionError::NotFinite { .. })));
    assert!(steps.t().is_finite());
}
