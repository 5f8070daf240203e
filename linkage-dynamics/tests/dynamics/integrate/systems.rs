//! Systems with known motions.

use std::f64::consts::FRAC_PI_2;

use linkage_runtime::nalgebra::vector;

use super::{Rate, State};

pub const GRAVITY: f64 = 9.81;

/// The state of a pendulum of 1 m: the angle from the lowest position, and its rate.
pub fn pendulum(_: f64, y: &State<2>) -> Rate<2> {
    Ok(vector![y[1], -GRAVITY * y[0].sin()])
}

pub const HORIZONTAL: State<2> = State::<2>::new(FRAC_PI_2, 0.0);

/// The position of the bob of a pendulum of 1 m let go at (1, 0), g = 9.81: problem A01, simple pendulum, of the IFToMM
/// library of computational benchmark problems of multibody dynamics. The exact solution: the angle phi from the lowest
/// position with sin(phi/2) = sn(K + sqrt(g) t, 1/2) / sqrt(2), computed to 20 digits.
pub const BOB: [(f64, [f64; 2]); 8] = [
    (0.5, [0.391_048_791_550_546_4, -0.920_369_948_785_192_2]),
    (1.0, [-0.986_291_751_131_875_3, -0.165_010_853_125_541_17]),
    (2.0, [0.793_566_195_343_321_7, -0.608_483_930_443_791_5]),
    (5.0, [0.942_305_435_043_757_3, -0.334_754_338_414_000_6]),
    (10.0, [0.275_087_462_576_116_9, -0.961_419_205_099_125_1]),
    (100.0, [0.181_513_351_427_031_38, -0.983_388_480_334_057_5]),
    (1000.0, [-0.683_230_188_552_314_9, -0.730_203_060_422_762_3]),
    (2000.0, [-0.814_603_068_589_032_2, -0.580_018_827_836_935_5]),
];

/// Its period, 4 K(1/2) / sqrt(g).
pub const PERIOD: f64 = 2.367_841_947_576_237_4;

/// Arenstorf's orbit about earth and moon: Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*,
/// section II.0, (0.1) and (0.2).
pub fn arenstorf(_: f64, y: &State<4>) -> Rate<4> {
    let moon = 0.012_277_471;
    let earth = 1.0 - moon;
    let [d1, d2] = [y[0] + moon, y[0] - earth].map(|x| (x * x + y[1] * y[1]).powf(1.5));
    Ok(vector![
        y[2],
        y[3],
        y[0] + 2.0 * y[3] - earth * (y[0] + moon) / d1 - moon * (y[0] - earth) / d2,
        y[1] - 2.0 * y[2] - earth * y[1] / d1 - moon * y[1] / d2
    ])
}

pub const ORBIT: State<4> = State::<4>::new(0.994, 0.0, 0.0, -2.001_585_106_379_082_5);
pub const ORBIT_PERIOD: f64 = 17.065_216_560_157_963;

/// Kepler's problem: on the unit circle y = (cos t, sin t).
pub fn kepler(_: f64, y: &State<4>) -> Rate<4> {
    let cubed = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
    Ok(vector![y[2], y[3], -y[0] / cubed, -y[1] / cubed])
}

pub fn circle(t: f64) -> State<4> {
    vector![t.cos(), t.sin(), -t.sin(), t.cos()]
}
