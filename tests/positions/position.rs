//! Newton's method returns an error with the residual where there is no position, and never NaN.

use linkage::{Mechanism, PositionError};

use linkage_gallery::four_bar::*;
use linkage_gallery::six_bar::*;
use linkage_gallery::slider_crank::*;

fn guess() -> FourBarCoordinates {
    FourBarCoordinates { theta2: 0.35, theta3: 1.2, theta4: -0.9 }
}

#[test]
fn unassemblable_lengths() {
    // The crank's end is 60 to 100 from D, and 10 + 20 do not reach.
    for theta2 in [0.0, 0.35, 1.0, 3.0] {
        let result = FourBar::new(80.0, 20.0, 10.0, 20.0).solve(&FourBarCoordinates { theta2, ..guess() });
        let Err(PositionError::NotConverged { mechanism, iterations, residual, regularity, .. }) = result else {
            panic!("{result:?}");
        };
        assert_eq!(mechanism, "FourBar");
        assert!(iterations > 0 && residual > 0.1 && residual < 1.0 && (0.0..=1.0).contains(&regularity), "{result:?}");
    }
    let far = SixBar { h: 100.0, ..SixBar::default() };
    let guess = SixBarCoordinates { theta1: 1.0, theta2: 0.6, theta3: 1.4, theta4: 0.2, theta5: 2.0 };
    assert!(matches!(far.solve(&guess), Err(PositionError::NotConverged { residual, .. }) if residual.is_finite()));
}

#[test]
fn infinite_and_nan_numbers() {
    for bad in [f64::NAN, f64::INFINITY] {
        let broken = FourBar::new(80.0, bad, 50.0, 70.0);
        assert!(matches!(broken.solve(&guess()), Err(PositionError::NotFinite { mechanism: "FourBar", .. })));
        let q = FourBarCoordinates { theta3: bad, ..guess() };
        let four_bar = FourBar::default();
        assert!(matches!(four_bar.solve(&q), Err(PositionError::NotFinite { .. })));
        assert!(four_bar.velocity_ratios(&four_bar.pose_at(&q)).is_err());
        assert!(four_bar.motion(&q, 1.0, 0.0).is_err());
        assert!(four_bar.points(&four_bar.pose_at(&q)).is_err());
        let q = four_bar.solve(&guess()).unwrap().coordinates;
        assert!(four_bar.velocity(&four_bar.pose_at(&q), bad).is_err());
    }
}

#[test]
fn zero_lengths() {
    let nothing = FourBar::new(0.0, 0.0, 0.0, 0.0);
    let pose = nothing.pose_at(&guess());
    assert!(matches!(nothing.velocity_ratios(&pose), Err(PositionError::Singular { regularity: 0.0, .. })));
    let none = SixBar::from([0.0; 9]);
    let q = SixBarCoordinates { theta1: 1.0, theta2: 0.6, theta3: 1.4, theta4: 0.2, theta5: 2.0 };
    assert!(matches!(none.velocity_ratios(&none.pose_at(&q)), Err(PositionError::Singular { regularity: 0.0, .. })));
}

#[test]
fn every_guess_converges_or_says_why() {
    let four_bar = FourBar::default();
    let (mut found, mut other_branch) = (0, 0);
    for i in 0..60 {
        for j in 0..60 {
            let angle = |k: i32| f64::from(k) / 60.0 * std::f64::consts::TAU - std::f64::consts::PI;
            let guess = FourBarCoordinates { theta2: 0.35, theta3: angle(i), theta4: angle(j) };
            match four_bar.solve(&guess) {
                Ok(solution) => {
                    // The error of an angle of several turns is at least its own rounding error.
                    let largest = solution.coordinates.theta3.abs().max(solution.coordinates.theta4.abs());
                    assert!(solution.residual <= 1e-15 || largest > 5.0 && solution.residual <= 1e-16 * largest);
                    let pose = four_bar.pose_at(&solution.coordinates);
                    let before = four_bar.determinant(&four_bar.pose_at(&guess));
                    assert_eq!(before >= 0.0, four_bar.determinant(&pose) >= 0.0);
                    found += 1;
                }
                Err(PositionError::OtherBranch { group, .. }) => {
                    let solution = four_bar.solve_any_branch(&guess).unwrap();
                    assert!(!solution.same_branch && group == "theta3, theta4");
                    other_branch += 1;
                }
                Err(PositionError::NotConverged { residual, regularity, .. }) => {
                    assert!(residual.is_finite() && regularity.is_finite());
                }
                Err(other) => panic!("{other}"),
            }
        }
    }
    println!("of 3600 guesses {found} lead to a position, {other_branch} to one on the other branch");
    assert!(found + other_branch > 3000 && other_branch > 1000, "{found} {other_branch}");
}

/// Crank and rod in line, 1 + 3 = 4: there is no residual to reduce.
#[test]
fn a_guess_without_residual_takes_no_step() {
    let guess = SliderCrankCoordinates { z3: 4.0, phi1: 0.0, phi2: 0.0 };
    let solution = Compressor::default().solve(&guess).unwrap();
    assert_eq!((solution.coordinates, solution.iterations, solution.residual), (guess, 0, 0.0));
}

/// Scaling all lengths by a power of two changes exponents only.
#[test]
fn scale_free() {
    let four_bar = FourBar::default();
    let q = four_bar.solve(&guess()).unwrap();
    let six_bar = SixBar::default();
    let start = SixBarCoordinates { theta1: 1.0, theta2: 0.6, theta3: 1.4, theta4: 0.2, theta5: 2.0 };
    let s = six_bar.solve(&start).unwrap();
    for k in [-300, -40, 13, 300] {
        let scale = 2_f64.powi(k);
        let lengths: [f64; 4] = four_bar.clone().into();
        let scaled = FourBar::from(lengths.map(|length| length * scale));
        assert_eq!(scaled.solve(&guess()).unwrap(), q);
        let (pose, other) = (four_bar.pose_at(&q.coordinates), scaled.pose_at(&q.coordinates));
        assert_eq!(four_bar.velocity_ratios(&pose), scaled.velocity_ratios(&other));
        let SixBar { delta, .. } = six_bar;
        let lengths: [f64; 9] = six_bar.clone().into();
        let mut scaled = SixBar::from(lengths.map(|length| length * scale));
        scaled.delta = delta;
        assert_eq!(scaled.solve(&start).unwrap(), s);
        let (pose, other) = (six_bar.pose_at(&s.coordinates), scaled.pose_at(&s.coordinates));
        assert_eq!(six_bar.velocity_ratios(&pose), scaled.velocity_ratios(&other));
    }
}

/// A slider held by three bars, found together. What depends on the crank alone is computed before the iteration.
mod hoisted {
    linkage::linkage! {
        #[derive(Debug, Clone)]
        pub mechanism Hoisted {
            param r, s, u, a, d, e;
            input theta;
            unknown phi, z, psi, chi;
            let x = r * cos(theta) - s;
            equation z = u * x - s;
            loop a@phi + x@psi = d@0 + e@chi;
            equation sin(chi) + sin(phi - psi) = z;
        }
    }
}

/// z is computed with the opposite sign of what it is named for; the formulas of the iteration number their values anew
/// and keep their own signs.
#[test]
fn an_iteration_keeps_the_signs_of_its_values() {
    use hoisted::{Hoisted, HoistedBranch, HoistedCoordinates};
    let (theta, phi, psi, chi) = (1.0_f64, 0.6_f64, -2.4_f64, 0.7_f64);
    let (r, s, a) = (0.5, 4.0, 1.0);
    let x = r * theta.cos() - s;
    let z = chi.sin() + (phi - psi).sin();
    let e = (a * phi.sin() + x * psi.sin()) / chi.sin();
    let d = a * phi.cos() + x * psi.cos() - e * chi.cos();
    let m = Hoisted { r, s, u: (z + s) / x, a, d, e };
    let guess = HoistedCoordinates { theta, phi: phi + 0.01, z, psi: psi - 0.01, chi: chi + 0.01 };
    let q = m.assemble_near(&guess, HoistedBranch {}).unwrap().coordinates();
    for (found, expected) in [(q.phi, phi), (q.z, z), (q.psi, psi), (q.chi, chi)] {
        assert!((found - expected).abs() < 1e-13, "{q:?}");
    }
}

/// A pose gives its coordinates back.
#[test]
fn angles_on_request() {
    let six_bar = SixBar::default();
    let q = SixBarCoordinates::<f64> { theta1: 1.0, theta2: 0.6, theta3: 7.4, theta4: 0.2, theta5: -2.0 };
    let back = six_bar.pose_at(&q).coordinates();
    // An output uses this angle, so the pose keeps its number of turns.
    assert_eq!(back.theta3, q.theta3);
    for (found, expected) in [(back.theta1, q.theta1), (back.theta2, q.theta2), (back.theta4, q.theta4)] {
        assert!((found - expected).abs() < 1e-15);
    }
}

/// The emitted code in single precision.
#[test]
fn single_precision() {
    let four_bar = FourBar::default().map(|length| length as f32);
    let guess = FourBarCoordinates { theta2: 0.349_065_85_f32, theta3: 1.2, theta4: -0.9 };
    let q = four_bar.solve(&guess).unwrap().coordinates;
    assert!((q.theta3 - 1.231_343_1).abs() < 1e-6);
    let ratios = four_bar.velocity_ratios(&four_bar.pose_at(&q)).unwrap();
    assert!((ratios[0] + 0.439_871_26).abs() < 1e-6);
}
