//! Coupler and rocker nearly parallel: the determinant of J from rounded sines, cos a sin b - sin a cos b, loses digits
//! as the angle between the links decreases, and so does every velocity. This is the fault of a factorisation of J by a
//! library, of the products that symbolic tools emit, and of W. Kahan's difference of products, as the sines are
//! rounded before. The emitted code has sin(a - b), of the stored angles.
//!
//! In doubles no formula of stored sines and cosines keeps every velocity within 4e-16. Measured at the poses below, at
//! sin(theta3 - theta4) = 1e-3, the worst of the emitted form is 5.9e-16. With every sine rounded correctly and the
//! exact determinant it is 5.3e-16; with a division each and l4 cancelled, three more rounding errors than the
//! numerator's, 5.0e-16; with the numerator as W. Kahan's difference of products also 5.0e-16. Only a numerator from
//! sines of more than 53 bits comes to 3.7e-16: sin(theta2 - theta4) as s2 c4 - c2 s4 has the rounding errors of four
//! stored numbers, enlarged by (|s2 c4| + |c2 s4|) / |sin(theta2 - theta4)|, up to two here; the sine of the rounded
//! difference has that of the difference and comes to 6.5e-16. The accelerations have the squares of the velocities, so
//! that correctly rounded velocities alone leave 5.9e-16. In double-double arithmetic the same code has only the last
//! rounding error.

use linkage::Mechanism;
use linkage_double::DoubleDouble;
use nalgebra::{SMatrix, SVector, vector};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use super::relative;
use linkage_oracle::precise::{Big, big};

use linkage_gallery::four_bar::*;

/// theta3' and theta4', theta3'' and theta4'' at angles that are doubles.
fn exact(m: &FourBar, q: &FourBarCoordinates, rate: f64, acceleration: f64) -> [[Big; 2]; 2] {
    let [(s2, c2), (s3, c3), (s4, c4)] = [q.theta2, q.theta3, q.theta4].map(|angle| big(angle).sin_cos());
    let [l2, l3, l4] = [m.l2, m.l3, m.l4].map(big);
    let solve = |x: Big, y: Big| {
        // l3 (-s3, c3) a + l4 (-s4, c4) b = (x, y)
        let determinant = &c3 * &s4 - &s3 * &c4;
        let a = (&x * &c4 + &y * &s4) / (&l3 * &determinant);
        let b = -(&x * &c3 + &y * &s3) / (&l4 * &determinant);
        [a, b]
    };
    let (w, e) = (big(rate), big(acceleration));
    let [w3, w4] = solve(&l2 * &s2 * &w, -(&l2 * &c2 * &w));
    let squares = [(&l2, &w), (&l3, &w3), (&l4, &w4)].map(|(length, rate)| length * rate * rate);
    let x = &squares[0] * &c2 + &squares[1] * &c3 + &squares[2] * &c4 + &l2 * &s2 * &e;
    let y = &squares[0] * &s2 + &squares[1] * &s3 + &squares[2] * &s4 - &l2 * &c2 * &e;
    let accelerations = solve(x, y);
    [[w3, w4], accelerations]
}

/// The rates by the emitted code in double-double arithmetic, rounded to doubles.
fn in_double_double(m: &FourBar, q: &FourBarCoordinates, rate: f64, acceleration: f64) -> [[f64; 2]; 2] {
    let [l1, l2, l3, l4] = [m.l1, m.l2, m.l3, m.l4].map(DoubleDouble::from);
    let m = FourBar { l1, l2, l3, l4 };
    let [theta2, theta3, theta4] = [q.theta2, q.theta3, q.theta4].map(DoubleDouble::from);
    let pose = m.pose_at(&FourBarCoordinates { theta2, theta3, theta4 });
    let velocity = m.velocity(&pose, DoubleDouble::from(rate)).unwrap();
    let acceleration = m.acceleration(&pose, &velocity, DoubleDouble::from(acceleration)).unwrap();
    [[velocity.theta3, velocity.theta4], [acceleration.theta3, acceleration.theta4]]
        .map(|pair| pair.map(DoubleDouble::high))
}

fn short(errors: &[f64]) -> String {
    errors.iter().map(|error| format!("{error:.1e} ")).collect()
}

#[track_caller]
fn within(found: [f64; 3], bounds: [f64; 3]) {
    assert!(found.iter().zip(bounds).all(|(&found, bound)| found <= bound), "{found:?} exceeds {bounds:?}");
}

#[test]
fn velocities_and_accelerations() {
    let m = FourBar::default();
    let mut random = SmallRng::seed_from_u64(20_091_121);
    for digits in [3, 6, 9] {
        let (mut ours, mut double, mut naive) = ([Vec::new(), Vec::new()], [0.0_f64; 2], [0.0_f64; 2]);
        for _ in 0..1000 {
            let theta4 = random.random_range(-3.0..3.0);
            let theta3 = theta4 + 10_f64.powi(-digits).asin();
            // The crank across the links: all loss is in the determinant.
            let theta2 = theta4 + random.random_range(0.5..2.5);
            let q = FourBarCoordinates { theta2, theta3, theta4 };
            let exact = exact(&m, &q, 1.5, -0.7);
            let pose = m.pose_at(&q);
            let velocity = m.velocity(&pose, 1.5).unwrap();
            let acceleration = m.acceleration(&pose, &velocity, -0.7).unwrap();
            let found = [[velocity.theta3, velocity.theta4], [acceleration.theta3, acceleration.theta4]];
            let in_double_double = in_double_double(&m, &q, 1.5, -0.7);
            // J from the same sines, factorised by a library.
            let (j, a) = (SMatrix::from(m.jacobian_unknowns(&pose)).lu(), SMatrix::from(m.jacobian_inputs(&pose)));
            let by_library = j.solve(&-(a * vector![1.5])).unwrap();
            let rate = FourBarRates { theta3: by_library[0], theta4: by_library[1], theta2: 1.5 };
            let right = -(a * vector![-0.7] + SVector::from(m.gamma(&pose, &rate)));
            let library = [by_library, j.solve(&right).unwrap()];
            for order in 0..2 {
                for unknown in 0..2 {
                    let expected = &exact[order][unknown];
                    ours[order].push(relative(found[order][unknown], expected));
                    double[order] = double[order].max(relative(in_double_double[order][unknown], expected));
                    naive[order] = naive[order].max(relative(library[order][unknown], expected));
                }
            }
        }
        let [velocity, acceleration] = ours.map(|mut errors| {
            errors.sort_by(f64::total_cmp);
            [errors.len() / 2, errors.len() * 99 / 100, errors.len() - 1].map(|place| errors[place])
        });
        println!("1e-{digits}, velocity, acceleration: library at worst {}", short(&naive));
        println!("    emitted, median, 99 %, worst {}, {}", short(&velocity), short(&acceleration));
        println!("    double-double at worst {}", short(&double));
        within(velocity, [1.3e-16, 4.6e-16, 6e-16]);
        within(acceleration, [2.8e-16, 1.2e-15, 1.4e-15]);
        // Half an ulp of the double that is returned.
        assert!(double.iter().all(|&error| error <= 1.12e-16), "{double:?}");
        let lost = 1e-17 * 10_f64.powi(digits);
        assert!(naive[0] > lost && naive[1] > lost, "{naive:?}");
    }
}
