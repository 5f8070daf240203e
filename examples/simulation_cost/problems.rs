//! The mechanisms of the literature, where they start and where they end.

use std::f64::consts::FRAC_PI_2;

use linkage::linkage;

use super::problem::Problem;

include!("../../tests/mechanisms/andrews_scene.rs");
include!("../../tests/mechanisms/two_windows.rs");

/// Andrews' squeezing mechanism: F. Mazzia and C. Magherini, "Test Set for Initial Value Problem Solvers", release 2.4
/// (2008), problem "andrews". Its end by extrapolation of order 24 with 42 digits.
pub fn squeezer() -> Problem<Squeezing, 6, 1, 8> {
    let start = SqueezerCoordinates {
        beta: -0.061_713_890_014_276_45,
        theta: 0.0,
        gamma: 0.455_279_819_163_070_4,
        phi: 0.222_668_390_165_885_87,
        delta: 0.487_364_979_543_842_55,
        omega: -0.222_668_390_165_885_87,
        epsilon: 1.230_547_444_549_821_2,
    };
    let end = SqueezerCoordinates {
        beta: 15.810_771_195_153_708,
        theta: -15.756_371_058_411_84,
        gamma: 0.040_822_240_119_645_85,
        phi: -0.534_730_116_342_079_6,
        delta: 0.524_409_965_879_954_1,
        omega: 0.534_730_116_342_079_6,
        epsilon: 1.048_080_741_041_937_8,
    };
    Problem::new(Squeezing::default(), (start, [0.0]), (0.03, end))
}

/// The N-four-bar of the benchmark library of IFToMM (problem A02, lim.ii.udc.es/mbsbenchmark) with two windows, to
/// 10 s: ten times all bars are in line. Its end by elliptic integrals with 34 digits.
pub fn windows() -> Problem<TwoFalling, 4, 1, 6> {
    let at = |phi: f64| TwoWindowsCoordinates { phi0: phi, psi1: 0.0, phi1: phi, psi2: 0.0, phi2: phi };
    let end = at(FRAC_PI_2 - 31.750_597_186_986_1);
    Problem::new(TwoFalling::default(), (at(FRAC_PI_2), [-1.0]), (10.0, end))
}
