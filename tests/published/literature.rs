//! The lecture notes (chapter 1, "Analisi cinematica di velocità per meccanismi articolati piani"): each
//! formula in the book's letters, written by hand, against the emitted code, at random poses.

use linkage::{D, Matrix, Mechanism};
use linkage_oracle::all_close;
use nalgebra::{Matrix2, SMatrix, Vector2, matrix, vector};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_gallery::five_bar::*;
use linkage_gallery::introductory::*;
use linkage_gallery::rpr::*;
use linkage_gallery::rrr::*;
use linkage_gallery::six_bar::*;
use linkage_gallery::slider_crank::*;

/// Rounding error of a handful of operations, relative to the largest entry.
const TOLERANCE: f64 = 1e-13;

const POSES: usize = 200;

fn random() -> SmallRng {
    SmallRng::seed_from_u64(1)
}

fn angle(random: &mut SmallRng) -> f64 {
    random.random_range(-3.0..3.0)
}

fn length(random: &mut SmallRng) -> f64 {
    random.random_range(0.4..3.0)
}

/// Equation 1.1:
/// J = [-z2 sin(phi2) - z3 sin(phi2 - delta), cos(phi2); z2 cos(phi2) + z3 cos(phi2 - delta), sin(phi2)],
/// A = {-z1 sin(phi1); z1 cos(phi1)}.
#[test]
fn equation_1_1() {
    let mut random = random();
    for _ in 0..POSES {
        let [z1, z3, z4, z2] = [(); 4].map(|()| length(&mut random));
        let [delta, phi1, phi2] = [(); 3].map(|()| angle(&mut random));
        let m = Introductory::new(z1, z3, z4, delta);
        let pose = m.pose_at(&IntroductoryCoordinates { phi2, z2, phi1 });
        let j = matrix![
            -z2 * phi2.sin() - z3 * (phi2 - delta).sin(), phi2.cos();
            z2 * phi2.cos() + z3 * (phi2 - delta).cos(), phi2.sin()
        ];
        let a = vector![-z1 * phi1.sin(), z1 * phi1.cos()];
        all_close("", SMatrix::from(m.jacobian_unknowns(&pose)).as_slice(), j.as_slice(), 0.0, TOLERANCE);
        all_close("", SMatrix::from(m.jacobian_inputs(&pose)).as_slice(), a.as_slice(), 0.0, TOLERANCE);
        all_close("", &[m.determinant(&pose)], &[-z2 - z3 * delta.cos()], z2 + z3, TOLERANCE);
        // {phi2'; z2'} = -J^-1 A phi1'.
        let w = m.velocity_ratios(&pose).unwrap();
        all_close("", (j * w).as_slice(), (-a).as_slice(), (j.norm() * w.norm()).max(z1), TOLERANCE);
    }
}

/// Equation 1.3: P' = sum of [cos(phi), -z sin(phi); sin(phi), z cos(phi)] {z'; phi'}, here with z1' = 0.
#[test]
fn equation_1_3() {
    let block = |z: f64, phi: f64| matrix![phi.cos(), -z * phi.sin(); phi.sin(), z * phi.cos()];
    let mut random = random();
    for _ in 0..POSES {
        let [z1, z3, z4, z2] = [(); 4].map(|()| length(&mut random));
        let [delta, phi1, phi2] = [(); 3].map(|()| angle(&mut random));
        let m = Introductory::new(z1, z3, z4, delta);
        let pose = m.pose_at(&IntroductoryCoordinates { phi2, z2, phi1 });
        let rate =
            m.velocity(&pose, length(&mut random)).unwrap_or(IntroductoryRates { phi1: 1.0, phi2: 2.0, z2: 3.0 });
        let expected = block(z1, phi1) * vector![0.0, rate.phi1] + block(z2, phi2) * vector![rate.z2, rate.phi2];
        let found = m.point_velocities(&pose, &rate).unwrap().p;
        all_close(
            "",
            found.as_slice(),
            expected.as_slice(),
            z1 * rate.phi1.abs() + z2 * rate.phi2.abs() + rate.z2.abs(),
            TOLERANCE,
        );
    }
}

/// Section 1.2, driven by the slider:
/// J = [-z1 sin(phi1), -z2 sin(phi2); z1 cos(phi1), z2 cos(phi2)], det J = z1 z2 sin(phi2 - phi1);
/// driven by the crank: J = [-1, -z2 sin(phi2); 0, z2 cos(phi2)], det J = -z2 cos(phi2).
#[test]
fn both_drivers_of_the_slider_crank() {
    let mut random = random();
    for _ in 0..POSES {
        let [z1, z2, z3] = [(); 3].map(|()| length(&mut random));
        let [phi1, phi2] = [(); 2].map(|()| angle(&mut random));
        let slider_crank = SliderCrank::new(z1, z2);
        let engine = Engine::from(slider_crank.clone());
        let compressor = Compressor::from(slider_crank);
        // One configuration serves both drivers.
        let q = SliderCrankCoordinates { z3, phi1, phi2 };
        let pose = engine.pose_at(&q);
        let j = matrix![-z1 * phi1.sin(), -z2 * phi2.sin(); z1 * phi1.cos(), z2 * phi2.cos()];
        all_close("", SMatrix::from(engine.jacobian_unknowns(&pose)).as_slice(), j.as_slice(), 0.0, TOLERANCE);
        all_close("", &[engine.determinant(&pose)], &[z1 * z2 * (phi2 - phi1).sin()], 0.0, TOLERANCE);
        let pose = compressor.pose_at(&q);
        let j = matrix![-1.0, -z2 * phi2.sin(); 0.0, z2 * phi2.cos()];
        all_close("", SMatrix::from(compressor.jacobian_unknowns(&pose)).as_slice(), j.as_slice(), 0.0, TOLERANCE);
        all_close("", &[compressor.determinant(&pose)], &[-z2 * phi2.cos()], 0.0, TOLERANCE);
    }
}

/// Section 1.2: the engine is singular where z1 and z2 are in line, the compressor where equal crank and
/// rod stand at phi2 = pi/2; near there the regularity is the sine itself.
#[test]
fn singular_configurations() {
    let engine = Engine::new(1.0, 3.0);
    let dead = SliderCrankCoordinates { z3: 4.0, phi1: 0.0, phi2: 0.0 };
    match engine.velocity_ratios(&engine.pose_at(&dead)) {
        Err(linkage::PositionError::Singular { mechanism: "Engine", group: "phi1, phi2", regularity }) => {
            assert!(regularity == 0.0)
        }
        other => panic!("{other:?}"),
    }
    let compressor = Compressor::new(1.0, 1.0);
    let upright =
        SliderCrankCoordinates { z3: 0.0, phi1: -std::f64::consts::FRAC_PI_2, phi2: std::f64::consts::FRAC_PI_2 };
    match compressor.velocity_ratios(&compressor.pose_at(&upright)) {
        Err(linkage::PositionError::Singular { mechanism: "Compressor", group: "phi2", regularity }) => {
            assert!(regularity < 1e-16, "{regularity}");
        }
        other => panic!("{other:?}"),
    }
    // The same configurations are harmless for the other driver.
    let compressor = Compressor::new(1.0, 3.0);
    assert!(compressor.velocity_ratios(&compressor.pose_at(&dead)).is_ok());
}

/// Section 1.3, RRR: {phi1'; phi2'} = 1/(z1 z2 sin(phi1 - phi2))
/// [-z2 cos(phi2), -z2 sin(phi2); -z1 cos(phi1), -z1 sin(phi1)] {xA' - xB'; yA' - yB'}.
#[test]
fn dyad_rrr() {
    let mut random = random();
    for _ in 0..POSES {
        let [z1, z2] = [(); 2].map(|()| length(&mut random));
        let [phi1, phi2, xa, ya, xb, yb] = [(); 6].map(|()| angle(&mut random));
        let m = Rrr::new(z1, z2);
        let pose = m.pose_at(&RrrCoordinates { phi1, phi2, xa, ya, xb, yb });
        let [a, b]: [Vector2<f64>; 2] = [(); 2].map(|()| vector![angle(&mut random), angle(&mut random)]);
        let inverse = matrix![-z2 * phi2.cos(), -z2 * phi2.sin(); -z1 * phi1.cos(), -z1 * phi1.sin()]
            / (z1 * z2 * (phi1 - phi2).sin());
        let expected = inverse * (a - b);
        let rate = RrrInputs { xa: a.x, ya: a.y, xb: b.x, yb: b.y };
        let velocity = m.velocity(&pose, rate).unwrap();
        all_close(
            "",
            &[velocity.phi1, velocity.phi2],
            expected.as_slice(),
            inverse.norm() * (a.norm() + b.norm()),
            TOLERANCE,
        );
    }
}

/// Section 1.3, RPR: [-z1 sin(phi1) + z2 sin(phi2) + z3 sin(phi3), -cos(phi2);
/// z1 cos(phi1) - z2 cos(phi2) - z3 cos(phi3), -sin(phi2)] {phi1'; z2'} = {xB' - xA'; yB' - yA'},
/// with phi2 = phi1 + alpha and phi3 = phi1 + beta.
#[test]
fn dyad_rpr() {
    let mut random = random();
    for _ in 0..POSES {
        let [z1, z2, z3] = [(); 3].map(|()| length(&mut random));
        let [alpha, beta, phi1, xa, ya, xb, yb] = [(); 7].map(|()| angle(&mut random));
        let (phi2, phi3) = (phi1 + alpha, phi1 + beta);
        let m = Rpr::new(z1, z3, alpha, beta);
        let pose = m.pose_at(&RprCoordinates { phi1, z2, xa, ya, xb, yb });
        let j: Matrix2<f64> = matrix![
            -z1 * phi1.sin() + z2 * phi2.sin() + z3 * phi3.sin(), -phi2.cos();
            z1 * phi1.cos() - z2 * phi2.cos() - z3 * phi3.cos(), -phi2.sin()
        ];
        all_close("", SMatrix::from(m.jacobian_unknowns(&pose)).as_slice(), j.as_slice(), z1 + z2 + z3, TOLERANCE);
        let [a, b]: [Vector2<f64>; 2] = [(); 2].map(|()| vector![angle(&mut random), angle(&mut random)]);
        let velocity = m.velocity(&pose, RprInputs { xa: a.x, ya: a.y, xb: b.x, yb: b.y }).unwrap();
        let x = vector![velocity.phi1, velocity.z2];
        all_close("", (j * x).as_slice(), (b - a).as_slice(), j.norm() * x.norm(), TOLERANCE);
    }
}

/// Property 1 of W: w_ij is the rate of unknown i when input j moves at unit rate and the others stand.
#[test]
fn columns_of_the_velocity_ratios() {
    let m = FiveBar::default();
    let guess = FiveBarCoordinates { theta1: 1.9, theta2: 0.3, theta3: 2.2, theta4: 1.1 };
    let pose = m.pose_at(&m.solve(&guess).unwrap().coordinates);
    let w = m.velocity_ratios(&pose).unwrap();
    assert_eq!(w.shape(), (2, 2));
    for (column, rate) in
        [FiveBarInputs { theta1: 1.0, theta4: 0.0 }, FiveBarInputs { theta1: 0.0, theta4: 1.0 }].into_iter().enumerate()
    {
        let velocity = m.velocity(&pose, rate).unwrap();
        all_close("", &[velocity.theta2, velocity.theta3], w.column(column).as_slice(), 0.0, TOLERANCE);
    }
    // Property 2: W is the derivative of the position by the inputs, here by central differences.
    let step = 1e-5;
    for column in 0..2 {
        let at = |sign: f64| {
            let mut q = m.solve(&guess).unwrap().coordinates;
            if column == 0 {
                q.theta1 += sign * step
            } else {
                q.theta4 += sign * step
            }
            let q = m.solve(&q).unwrap().coordinates;
            vector![q.theta2, q.theta3]
        };
        let difference = (at(1.0) - at(-1.0)) / (2.0 * step);
        assert!((difference - w.column(column)).amax() < 1e-8, "{difference} {w}");
    }
}

/// Section 1.1.2: two loops give a Jacobian of order 4 and A with one column; solved as a whole it agrees
/// with the two dyads solved in cascade (section 1.3).
#[test]
fn two_loops_agree_with_the_cascade_of_dyads() {
    let m = SixBar::default();
    let guess = SixBarCoordinates { theta1: 1.0, theta2: 0.6, theta3: 1.4, theta4: 0.2, theta5: 2.0 };
    let q = m.solve(&guess).unwrap().coordinates;
    let SixBar { a, b, c, e, f, g, delta, .. } = m;
    let pose = m.pose_at(&q);
    let _: Matrix<f64, D<4>, D<4>> = m.jacobian_unknowns(&pose);
    let _: Matrix<f64, D<4>, D<1>> = m.jacobian_inputs(&pose);
    let w = m.velocity_ratios(&pose).unwrap();
    // First dyad: b@theta2 - c@theta3 = d - a@theta1.
    let column = |l: f64, theta: f64| vector![-l * theta.sin(), l * theta.cos()];
    let solve = |x: Vector2<f64>, y: Vector2<f64>, r: Vector2<f64>| {
        let determinant = x.perp(&y);
        vector![r.perp(&y) / determinant, x.perp(&r) / determinant]
    };
    let first = solve(column(b, q.theta2), -column(c, q.theta3), -column(a, q.theta1));
    // Second dyad: f@theta4 - g@theta5 = h - d - e@(theta3 - delta).
    let second = solve(column(f, q.theta4), -column(g, q.theta5), -column(e, q.theta3 - delta) * first[1]);
    all_close("", w.as_slice(), &[first[0], first[1], second[0], second[1]], 0.0, TOLERANCE);
    let determinant = column(b, q.theta2).perp(&-column(c, q.theta3)) * column(f, q.theta4).perp(&-column(g, q.theta5));
    all_close("", &[m.determinant(&pose)], &[determinant], 0.0, TOLERANCE);
}
