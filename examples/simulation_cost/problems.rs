//! Mechanisms of the literature, with initial and final states.

use std::f64::consts::FRAC_PI_2;

use super::problem::Problem;

use linkage_gallery::andrews_motion::{END, START};
pub use linkage_gallery::andrews_scene::*;
pub use linkage_gallery::two_windows::*;

/// Andrews' squeezing mechanism.
pub fn squeezer() -> Problem<Squeezing> {
    Problem::new(Squeezing::default(), (START, 0.0), (0.03, END))
}

/// The N-four-bar of the benchmark library of IFToMM (problem A02, lim.ii.udc.es/mbsbenchmark) with two windows, to 10
/// s: all bars are in line ten times. The final state is computed by elliptic integrals with 34 digits.
pub fn windows() -> Problem<TwoFalling> {
    let at = |phi: f64| TwoWindowsCoordinates { phi0: phi, psi1: 0.0, phi1: phi, psi2: 0.0, phi2: phi };
    let end = at(FRAC_PI_2 - 31.750_597_186_986_1);
    Problem::new(TwoFalling::default(), (at(FRAC_PI_2), -1.0), (10.0, end))
}
