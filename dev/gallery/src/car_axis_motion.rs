//! A motion of the car axis with published figures.

use crate::car_axis::{CarAxisCoordinates, CarAxisInputs};

/// The car axis where it starts: F. Mazzia and C. Magherini, "Test Set for Initial Value Problem Solvers", release 2.4 (2008),
/// problem "car axis".
pub const START: CarAxisCoordinates = CarAxisCoordinates { beta: 0.0, s: 0.5, phi: 0.0 };

/// The rates there: the first bump turns the axis.
pub const START_RATES: CarAxisInputs = CarAxisInputs { beta: 1.0, s: 0.0, phi: 0.0 };

/// The end of the motion in the unit of time.
pub const END_TIME: f64 = 3.0;

/// x and y of the left and of the right end of the chassis then, as the test set prints them.
pub const PUBLISHED_END: [f64; 4] =
    [0.049_345_578_427_556_29, 0.496_989_460_230_332_4, 1.041_742_524_885_4, 0.373_911_027_265_221_4];

/// Their velocities, as the test set prints them.
pub const PUBLISHED_VELOCITIES: [f64; 4] =
    [-0.077_058_368_403_214_85, 0.007_446_866_596_327_776, 0.017_556_815_749_428_99, 0.770_341_043_779_403];

/// The positions of [`PUBLISHED_END`] by extrapolation (Gragg, Bulirsch and Stoer) of order 32 with 40 digits, in the four
/// coordinates with two multipliers of the test set: the published figures agree to 6.5e-13.
pub const END: [f64; 4] =
    [0.049_345_578_427_524_094, 0.496_989_460_230_008_1, 1.041_742_524_885_426_2, 0.373_911_027_265_365_8];

/// The velocities by that computation: the published figures agree to 5.8e-10.
pub const END_VELOCITIES: [f64; 4] =
    [-0.077_058_368_403_592_08, 0.007_446_866_592_068_417, 0.017_556_815_753_541_736, 0.770_341_043_779_601_1];
