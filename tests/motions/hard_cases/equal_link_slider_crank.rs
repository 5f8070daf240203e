//! The compressor of the lecture notes ("Analisi cinematica di velocità per meccanismi articolati piani", section
//! 1.2) with rod and crank of one length: at phi2 = +-pi/2 its Jacobian is singular, two motions meet, and the
//! velocity ratio -z1 cos(phi1) / (z2 cos(phi2)) is a quotient of rounding errors that looks like a result.

use std::f64::consts::FRAC_PI_2;

use linkage::{Mechanism, PositionError, Slider, singularity};

use linkage_oracle::precise::{Scalar, big};

use linkage_gallery::slider_crank::*;

const SLIDERS: [Slider; 2] = [Slider::Far, Slider::Near];

#[test]
fn velocity_at_the_singularity() {
    let m = Compressor { z1: 1.5, z2: 1.5 };
    for phi1 in [FRAC_PI_2, -FRAC_PI_2] {
        // The formula has a result, and a different one for the same angle plus full turns.
        let ratio = |phi2: f64| -m.z1 * phi1.cos() / (m.z2 * phi2.cos());
        let answers = [ratio(-phi1), ratio(-phi1 + 4.0 * std::f64::consts::PI)];
        println!("phi1 = {phi1}: quotients {answers:?}");
        assert!(answers.iter().all(|answer| answer.is_finite()) && (answers[0] - answers[1]).abs() > 0.1);
        for slider in SLIDERS {
            let pose = m.assemble(phi1, CompressorBranch { z3_phi2: slider }).unwrap();
            assert!(m.residual(&pose).largest() <= 1e-15 && pose.phi2.re.abs() <= 1e-15, "{pose:?}");
            assert!(matches!(m.velocity_ratios(&pose), Err(PositionError::Singular { group: "phi2", .. })));
            assert!(singularity::report(&m, &pose).unwrap().is_singular());
        }
    }
}

/// Near it, z3 = 2 z1 cos(phi1) on one branch and 0 on the other, within the error that sigma min predicts.
#[test]
fn positions_near_it() {
    let m = Compressor { z1: 1.5, z2: 1.5 };
    let mut worst = 0.0_f64;
    for digits in 1..8 {
        let phi1 = FRAC_PI_2 - 10_f64.powi(-digits);
        let cosine = big(phi1).sin_cos().1;
        for slider in SLIDERS {
            let pose = m.assemble(phi1, CompressorBranch { z3_phi2: slider }).unwrap();
            let expected = if slider == Slider::Far { big(2.0 * m.z1) * &cosine } else { big(0.0) };
            let attainable = singularity::accuracy(&m, &pose).unwrap().unknowns();
            let error = (big(pose.z3) - expected).double().abs();
            worst = worst.max(error / attainable.largest());
            // Far from it no digit is lost; near it the unavoidable ones.
            assert!(error <= f64::EPSILON * 10_f64.powi(digits) * 8.0, "{error:e}");
        }
    }
    println!("errors up to {worst:.2} of eps / sigma min");
    assert!(worst <= 4.0, "{worst}");
}
