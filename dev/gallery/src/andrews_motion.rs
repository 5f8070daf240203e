//! A motion of Andrews' squeezing mechanism with published figures.

use crate::andrews_scene::SqueezerCoordinates;

/// Andrews' squeezing mechanism where it starts, at rest: F. Mazzia and C. Magherini, "Test Set for Initial Value Problem
/// Solvers", release 2.4 (2008), problem "andrews".
pub const START: SqueezerCoordinates = SqueezerCoordinates {
    beta: -0.061_713_890_014_276_45,
    theta: 0.0,
    gamma: 0.455_279_819_163_070_4,
    phi: 0.222_668_390_165_885_87,
    delta: 0.487_364_979_543_842_55,
    omega: -0.222_668_390_165_885_87,
    epsilon: 1.230_547_444_549_821_2,
};

/// The angles at t = 0.03 s, by extrapolation (Gragg, Bulirsch and Stoer) of order 24 with 42 digits; the test set's own
/// figures, of about 10 digits, agree.
pub const END: SqueezerCoordinates = SqueezerCoordinates {
    beta: 15.810_771_195_153_708,
    theta: -15.756_371_058_411_84,
    gamma: 0.040_822_240_119_645_85,
    phi: -0.534_730_116_342_079_6,
    delta: 0.524_409_965_879_954_1,
    omega: 0.534_730_116_342_079_6,
    epsilon: 1.048_080_741_041_937_8,
};
