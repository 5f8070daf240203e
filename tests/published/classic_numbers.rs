//! Numbers that others published for classic mechanisms, to every digit they give.

use linkage_gallery::andrews::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::norton_four_bar::*;
use linkage_gallery::offset_slider_crank::*;

/// Agrees to the last of the digits given, whose unit is 10^-`decimals`.
#[track_caller]
fn printed(found: f64, expected: f64, decimals: i32) {
    let error = (found - expected).abs();
    // Half a unit, and a little for the rounding error of `found` itself.
    let allowed = 0.5 * 10.0_f64.powi(-decimals) + 4.0 * f64::EPSILON * expected.abs();
    assert!(error <= allowed, "{found:?} is not {expected:?}: off by {error:e}, {allowed:e} is allowed");
}

/// Agrees to this part of the number.
#[track_caller]
fn relative(found: f64, expected: f64, part: f64) {
    let error = ((found - expected) / expected).abs();
    assert!(error <= part, "{found:?} is not {expected:?}: off by {error:e} of it");
}

/// The four-bar of R. L. Norton, "Design of Machinery", chapters 4, 6 and 7: a 40, b 120, c 80, d 100 at
/// theta2 = 40 deg, 25 rad/s, 15 rad/s^2, open; to more digits in 40-digit arithmetic. His rocker points from
/// D to C, ours from C to D.
#[test]
fn four_bar_of_norton() {
    let m = FourBar::new(100.0, 40.0, 120.0, 80.0);
    let guess = FourBarCoordinates { theta2: 40_f64.to_radians(), theta3: 0.35, theta4: 1.0 - std::f64::consts::PI };
    let solution = m.solve(&guess).unwrap();
    let motion = m.motion(&solution.coordinates, 25.0, 15.0).unwrap();
    printed(motion.position.theta3.to_degrees(), 20.297_882_788_196_5, 13);
    printed(motion.position.theta4.to_degrees() + 180.0, 57.324_880_070_360_8, 13);
    printed(motion.rates.theta3, -4.120_914_415_347_70, 14);
    printed(motion.rates.theta4, 6.997_985_242_176_77, 14);
    printed(motion.accelerations.theta3, 296.089_193_174_310, 12);
    printed(motion.accelerations.theta4, 470.133_530_261_023, 12);
}

/// The four-bar in Norton's own layout, with its jerk at constant acceleration of the crank.
#[test]
fn jerk_of_the_four_bar_of_norton() {
    let m = NortonFourBar::default();
    let guess = NortonFourBarCoordinates { theta2: 40_f64.to_radians(), theta3: 0.35, theta4: 1.0 };
    let solution = m.solve(&guess).unwrap();
    let pose = m.pose_at(&solution.coordinates);
    let velocity = m.velocity(&pose, 25.0).unwrap();
    let acceleration = m.acceleration(&pose, &velocity, 15.0).unwrap();
    let jerk = m.jerk(&pose, &velocity, &acceleration, 0.0).unwrap();
    printed(solution.coordinates.theta3.to_degrees(), 20.297_882_788_196_5, 13);
    printed(solution.coordinates.theta4.to_degrees(), 57.324_880_070_360_8, 13);
    // Sums of terms ten times their size.
    printed(jerk.theta3, -12_679.510_094_600_2, 9);
    printed(jerk.theta4, -25_354.568_765_286_5, 9);
    let jerk_of_mu = m.output_jerks(&pose, &velocity, &acceleration, &jerk).unwrap().mu;
    printed(jerk_of_mu, -12_675.058_670_686_3, 9);
}

/// The offset slider-crank of the same book: a 40, b 120, c -20 at theta2 = 60 deg, -30 rad/s, open.
#[test]
fn slider_crank_of_norton() {
    let m = OffsetSliderCrank::default();
    let guess = OffsetSliderCrankCoordinates { theta2: 60_f64.to_radians(), theta3: 2.7, d: 125.0 };
    let solution = m.solve(&guess).unwrap();
    let motion = m.motion(&solution.coordinates, -30.0, 0.0).unwrap();
    printed(motion.position.theta3.to_degrees(), 152.913_071_522, 9);
    printed(motion.position.d, 126.838_005_195, 9);
    printed(motion.rates.theta3, 5.615_979_060_14, 11);
    printed(motion.rates.d, 1_346.093_287_07, 8);
    printed(motion.accelerations.theta3, 275.684_475_85, 8);
    printed(motion.accelerations.d, -6_305.907_538_49, 8);
}

/// A teaching four-bar of the verification set of PMKS (Planar Mechanism Kinematic Simulator): A (0, 0),
/// B (1.52, 0), C (4.23, 3.029), D (4.572, 0), 10.31 rpm. Compared are the certain ones of its seventeen digits.
#[test]
fn four_bar_of_pmks() {
    let (x, y, d) = (4.23_f64, 3.029_f64, 4.572_f64);
    let m = FourBar::new(d, 1.52, (x - 1.52).hypot(y), (d - x).hypot(y));
    let guess = FourBarCoordinates { theta2: 0.0, theta3: 0.8, theta4: -1.4 };
    let solution = m.solve(&guess).unwrap();
    let motion = m.motion(&solution.coordinates, 10.31 * std::f64::consts::TAU / 60.0, 0.0).unwrap();
    printed(motion.points.c.position.x, x, 15);
    printed(motion.points.c.position.y, y, 15);
    // The published doubles and ours are each off by a few units in the last place.
    printed(motion.rates.theta4, -0.537_707_806_825_430, 15);
    printed(motion.accelerations.theta4, 0.778_081_940_185_146, 15);
    let c = motion.points.c;
    printed(c.velocity.x, 1.628_716_946_874_227, 15);
    // A difference of terms ten times its size.
    printed(c.velocity.y, 0.183_896_069_934_297, 14);
    printed(c.acceleration.x, -2.257_927_844_372_62, 14);
    printed(c.acceleration.y, -1.141_877_840_986_47, 14);
}

/// Near the change point, ground 3, crank 1, coupler 3, rocker 1 + eps with the crank turned by 180 deg, the
/// transmission ratio is 1/4, the mean of the 1 and the -1/2 of the two motions that meet there, and its
/// derivative goes as -0.459 / sqrt(eps). 40-digit arithmetic.
#[test]
fn near_the_change_point() {
    for (eps, derivative, decimals) in [(1e-2_f64, -4.578, 3), (1e-4, -45.93, 2), (1e-8, -4_592.8, 1)] {
        let m = FourBar::new(3.0, 1.0, 3.0, 1.0 + eps);
        let guess =
            FourBarCoordinates { theta2: std::f64::consts::PI, theta3: eps.sqrt() / 2.0, theta4: -2.0 * eps.sqrt() };
        let solution = m.solve(&guess).unwrap();
        let motion = m.motion(&solution.coordinates, 1.0, 0.0).unwrap();
        relative(motion.rates.theta4, 0.25, 1e-15 / eps.sqrt());
        printed(motion.accelerations.theta4, derivative, decimals);
        printed(motion.accelerations.theta4 * eps.sqrt(), -0.459, 2);
    }
}

/// Andrews' mechanism after 0.03 s, as published in the Test Set for IVP Solvers: by PSIDE in double precision,
/// whose angles close the loops to 7.4e-17 m though each is right to ten digits only.
#[test]
fn andrews_closes_at_the_published_solution() {
    let m = Andrews::default();
    let published = AndrewsCoordinates {
        beta: 15.810_771_196_299_04,
        theta: -15.756_371_059_842_98,
        gamma: 0.040_822_240_130_731_01,
        phi: -0.534_730_116_322_694_8,
        delta: 0.524_409_965_880_530_4,
        omega: 0.534_730_116_322_694_8,
        epsilon: 1.048_080_741_042_263,
    };
    let guess =
        AndrewsCoordinates { theta: -15.7, gamma: 0.0, phi: -0.5, delta: 0.5, omega: 0.5, epsilon: 1.0, ..published };
    let solution = m.solve(&guess).unwrap();
    let q = solution.coordinates;
    for (found, expected) in [
        (q.theta, published.theta),
        (q.gamma, published.gamma),
        (q.phi, published.phi),
        (q.delta, published.delta),
        (q.omega, published.omega),
        (q.epsilon, published.epsilon),
    ] {
        printed(found, expected, 14);
    }
}

/// Andrews' mechanism to more digits: the equations of motion reduced to `beta`, integrated in 42-digit arithmetic.
#[test]
fn andrews_in_motion() {
    let m = Andrews::default();
    let guess = AndrewsCoordinates {
        beta: 15.810_771_195_153_707,
        theta: -15.7,
        gamma: 0.0,
        phi: -0.5,
        delta: 0.5,
        omega: 0.5,
        epsilon: 1.0,
    };
    let q = m.solve(&guess).unwrap().coordinates;
    let motion = m.motion(&q, 1_139.920_302_259_106_1, -24_631.763_122_874_634).unwrap();
    // beta has an error of 2e-15, and the rates of delta and epsilon are differences of some thirty times larger ones.
    const PART: f64 = 1e-12;
    relative(q.theta, -15.756_371_058_411_839, PART);
    relative(q.gamma, 0.040_822_240_119_645_8, PART);
    relative(q.phi, -0.534_730_116_342_079_6, PART);
    relative(q.delta, 0.524_409_965_879_954, PART);
    relative(q.omega, 0.534_730_116_342_079_6, PART);
    relative(q.epsilon, 1.048_080_741_041_938, PART);
    relative(motion.rates.theta, -1_424.379_295_177_540_1, PART);
    relative(motion.rates.gamma, 11.032_911_910_618_594, PART);
    relative(motion.rates.phi, 19.293_374_105_032_04, PART);
    relative(motion.rates.delta, 0.573_569_914_829_502_5, PART);
    relative(motion.rates.omega, -19.293_374_105_032_04, PART);
    relative(motion.rates.epsilon, 0.323_179_149_249_130_9, PART);
    relative(motion.accelerations.theta, 51_850.319_636_464_23, PART);
    relative(motion.accelerations.gamma, 324_102.600_707_578_6, PART);
    relative(motion.accelerations.phi, 566_749.422_000_995_3, PART);
    relative(motion.accelerations.delta, 16_743.635_418_345_445, PART);
    relative(motion.accelerations.omega, -566_749.422_000_995_3, PART);
    relative(motion.accelerations.epsilon, 9_826.507_801_544_163, PART);
}

/// The initial values of the Test Set, which are given to 30 digits.
#[test]
fn andrews_at_the_start() {
    let m = Andrews::default();
    let guess = AndrewsCoordinates {
        beta: -0.061_713_890_014_276_45,
        theta: 0.1,
        gamma: 0.4,
        phi: 0.2,
        delta: 0.5,
        omega: -0.2,
        epsilon: 1.2,
    };
    let q = m.solve(&guess).unwrap().coordinates;
    printed(q.theta, 0.0, 15);
    printed(q.gamma, 0.455_279_819_163_070_4, 15);
    printed(q.phi, 0.222_668_390_165_885_88, 15);
    printed(q.delta, 0.487_364_979_543_842_55, 15);
    printed(q.omega, -0.222_668_390_165_885_88, 15);
    printed(q.epsilon, 1.230_547_444_549_821_2, 15);
}
