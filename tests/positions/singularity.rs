//! The singularity report against the worked examples of the lecture notes ("Analisi cinematica di velocità per
//! meccanismi articolati piani", section 1.2 on singular configurations, 1.3 on Assur groups), and against nalgebra's
//! singular value decomposition of the plain Jacobian.

use approx::assert_abs_diff_eq;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};

use linkage::{Assembled, Dim, Mechanism, PositionError, Slider, singularity};
use nalgebra::{DMatrix, vector};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_gallery::double_butterfly::*;
use linkage_gallery::five_bar::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::rpr::*;
use linkage_gallery::rrr::*;
use linkage_gallery::six_bar::*;
use linkage_gallery::slider_crank::*;

const ROUNDING_ERROR: f64 = 4.0 * f64::EPSILON;

/// Equal up to rounding errors.
#[track_caller]
fn is_rounded(found: f64, expected: f64) {
    assert_abs_diff_eq!(found, expected, epsilon = 4.0 * ROUNDING_ERROR * (1.0 + expected.abs()));
}

fn names<M: Mechanism>(report: &singularity::Singularity<M>) -> Vec<(M::Name, M::Name)> {
    report.drivers().map(|exchange| (exchange.unknown, exchange.input)).collect()
}

/// 1.2, the engine: J = [-z1 sin phi1, -z2 sin phi2; z1 cos phi1, z2 cos phi2], singular where phi2 = phi1 or
/// phi2 = phi1 + pi. There z3' = 0 and z1 phi1' + z2 phi2' = 0 up to the signs of the alignment.
#[test]
fn slider_crank_driven_by_its_slider() {
    let m = Engine::default();
    for (phi1, phi2, sign) in [(0.0, 0.0, 1.0), (0.0, PI, -1.0), (PI, PI, 1.0), (PI, 0.0, -1.0)] {
        let z3 = m.z1 * f64::cos(phi1) + m.z2 * f64::cos(phi2);
        let pose = m.pose_at(&SliderCrankCoordinates { z3, phi1, phi2 });
        let found = singularity::report(&m, &pose).unwrap();
        assert!(found.is_singular() && found.rank() == 1 && found.sigma_min() <= ROUNDING_ERROR, "{found}");
        assert_eq!(found.rank_with_inputs(), 2);
        assert_eq!(found.admissible().count(), 0);
        let [free] = found.free().collect::<Vec<_>>()[..] else { panic!("{found}") };
        is_rounded(m.z1 * free[0] + sign * m.z2 * free[1], 0.0);
        is_rounded(free[0].abs().max(free[1].abs()), free.largest());
        assert_eq!(names(&found), [("phi1", "z3"), ("phi2", "z3")]);
        assert!(m.velocity_ratios(&pose).is_err());
        let text = found.to_string();
        for line in ["Engine is singular", "rank 1 of 2", "no input can move", "phi1 could drive in place of z3"] {
            assert!(text.contains(line), "{text}");
        }
        let rates = format!("\nfree: phi1' = {:.4} phi2' = {:.4}\n", free[0], free[1]);
        assert!(text.contains(&rates), "{text}");
    }
    // |sin(phi2 - phi1)| everywhere: the notes' det J = z1 z2 sin(phi2 - phi1).
    for (phi1, phi2) in [(0.3, 1.1), (2.0, -0.4), (1.0, 1.0 + 1e-9)] {
        let pose = m.pose_at(&SliderCrankCoordinates { z3: 1.0, phi1, phi2 });
        let found = singularity::report(&m, &pose).unwrap();
        assert!(!found.is_singular());
        let [group] = found.groups().copied().collect::<Vec<_>>()[..] else { panic!("{found}") };
        let sine = f64::sin(phi2 - phi1).abs();
        assert!((group.regularity - sine).abs() <= ROUNDING_ERROR * sine, "{group:?}");
        assert!((found.determinant() - m.z1 * m.z2 * f64::sin(phi2 - phi1)).abs() <= 4.0 * ROUNDING_ERROR * sine);
    }
}

/// 1.2, the compressor: J = [-1, -z2 sin phi2; 0, z2 cos phi2], singular where phi2 = +-pi/2. "This can happen only
/// where rod and crank are of one length and aligned."
#[test]
fn slider_crank_driven_by_its_crank() {
    for side in [1.0, -1.0] {
        let equal = Compressor { z1: 1.5, z2: 1.5 };
        let q = SliderCrankCoordinates { phi1: side * FRAC_PI_2, phi2: -side * FRAC_PI_2, z3: 0.0 };
        let pose = equal.pose_at(&q);
        assert!(equal.residual(&pose).largest() <= 1e-15);
        let found = singularity::report(&equal, &pose).unwrap();
        assert!(found.is_singular() && found.rank() == 1, "{found}");
        let regular: Vec<bool> = found.groups().map(|group| group.is_regular).collect();
        assert_eq!(regular.iter().filter(|is_regular| !**is_regular).count(), 1);
        let free = found.free().next().unwrap();
        is_rounded(
            equal.jacobian_unknowns(&pose).column(0)[0] * free[0]
                + equal.jacobian_unknowns(&pose).column(1)[0] * free[1],
            0.0,
        );
        // A = (-z1 sin phi1, z1 cos phi1) has no part outside the range of J: the crank may move as well.
        assert_eq!(found.admissible().count(), 1);
        assert_eq!(found.rank_with_inputs(), 1);
        assert_eq!(names(&found), []);
    }
    let m = Compressor::default();
    for degrees in 0..360 {
        for slider in [Slider::Far, Slider::Near] {
            let pose = m.assemble(f64::from(degrees).to_radians(), CompressorBranch { z3_phi2: slider }).unwrap();
            assert!(!singularity::report(&m, &pose).unwrap().is_singular());
        }
    }
}

/// 1.3, the dyad RRR: singular where sin(phi1 - phi2) = 0. Both joints may not come nearer along the line.
#[test]
fn dyad_of_two_links() {
    let m = Rrr::default();
    let angle = FRAC_PI_3;
    let q = RrrCoordinates { phi1: angle, phi2: angle, xa: 0.0, ya: 0.0, xb: -0.25, yb: -0.25 * 3.0_f64.sqrt() };
    let pose = m.pose_at(&q);
    assert!(m.residual(&pose).largest() <= 1e-15);
    let found = singularity::report(&m, &pose).unwrap();
    assert_eq!((found.rank(), found.rank_with_inputs()), (1, 2));
    let free = found.free().next().unwrap();
    is_rounded(m.z1 * free[0] - m.z2 * free[1], 0.0);
    let along = vector![angle.cos(), angle.sin()];
    let admissible: Vec<_> = found.admissible().collect();
    assert_eq!(admissible.len(), 3);
    for rates in &admissible {
        is_rounded(along.dot(&vector![rates[2] - rates[0], rates[3] - rates[1]]), 0.0);
    }
    // Any of the four can be let go; in its place either angle can drive.
    assert_eq!(names(&found).len(), 8);
}

/// 1.3, the dyad RPR: singular where the arm of both offsets stands along the guide.
#[test]
fn dyad_with_a_slider() {
    let m = Rpr::default();
    let mut random = SmallRng::seed_from_u64(3);
    for _ in 0..100 {
        let [phi1, z2, xa, ya] = [0; 4].map(|_| random.random_range(-2.0..2.0));
        let pose = m.pose_at(&RprCoordinates { phi1, z2, xa, ya, xb: 0.0, yb: 0.0 });
        let found = singularity::report(&m, &pose).unwrap();
        // det J in the notes' letters: what z1 - z2 - z3 moves across the guide.
        let across = z2 - m.z1 * m.alpha.cos() + m.z3 * (m.beta - m.alpha).cos();
        assert!((found.determinant().abs() - across.abs()).abs() <= 4.0 * ROUNDING_ERROR * 2.0, "{found} {across}");
    }
    let z2 = m.z1 * m.alpha.cos() - m.z3 * (m.beta - m.alpha).cos();
    let pose = m.pose_at(&RprCoordinates { phi1: 0.7, z2, xa: 0.1, ya: 0.2, xb: 0.3, yb: 0.4 });
    let found = singularity::report(&m, &pose).unwrap();
    assert_eq!((found.rank(), found.admissible().count()), (1, 3));
}

/// The second dyad of a six-bar is stretched while the first is regular: its angles are free, those of the first are
/// not, and the crank cannot move.
#[test]
fn six_bar_with_its_second_dyad_stretched() {
    let m = SixBar::default();
    let pose = m.branches(0.4).unwrap().next().unwrap().pose.coordinates();
    let p = vector![m.d + m.e * (pose.theta3 - m.delta).cos(), m.e * (pose.theta3 - m.delta).sin()];
    let along = vector![m.h, 0.0] - p;
    let angle = along.y.atan2(along.x);
    let m = SixBar { f: along.norm() - m.g, ..m };
    let q = SixBarCoordinates { theta4: angle, theta5: angle + PI, ..pose };
    let pose = m.pose_at(&q);
    assert!(m.residual(&pose).largest() <= 1e-14);
    let found = singularity::report(&m, &pose).unwrap();
    assert_eq!((found.rank(), found.rank_with_inputs(), found.admissible().count()), (3, 4, 0));
    let free = found.free().next().unwrap();
    is_rounded(free[0].abs() + free[1].abs(), 0.0);
    is_rounded(m.f * free[2] - -m.g * free[3], 0.0);
    let groups: Vec<_> = found.groups().copied().collect();
    assert_eq!([groups[0].name, groups[1].name], ["theta2, theta3", "theta4, theta5"]);
    assert!(
        groups[0].is_regular && !groups[1].is_regular && groups[1].regularity <= 2.0 * ROUNDING_ERROR,
        "{groups:?}"
    );
    assert!((groups[0].regularity - (q.theta2 - q.theta3).sin().abs()).abs() <= ROUNDING_ERROR);
    assert_eq!(names(&found), [("theta4", "theta1"), ("theta5", "theta1")]);
}

/// A flat parallelogram is singular for every driver: every rank is that of the plain Jacobian by nalgebra.
#[test]
fn flat_parallelogram() {
    let m = FourBar { l1: 2.0, l2: 1.0, l3: 2.0, l4: 1.0 };
    let pose = m.pose_at(&FourBarCoordinates { theta2: 0.0, theta3: 0.0, theta4: PI });
    let found = singularity::report(&m, &pose).unwrap();
    assert_eq!((found.rank(), found.rank_with_inputs(), found.admissible().count()), (1, 1, 1));
    assert_eq!(names(&found), []);
    assert_eq!(numerical_rank(&DMatrix::from_iterator(2, 3, m.jacobian(&pose).iter().copied())), 1);
}

fn numerical_rank(matrix: &DMatrix<f64>) -> usize {
    matrix.clone().svd(false, false).rank(1e-13 * matrix.amax())
}

/// Against brute force at random positions, none of them consistent, and at positions made singular: rank and null
/// vectors of J, the inputs that A leaves admissible, and the exchanges.
fn brute_force<M: Mechanism<Scalar = f64>>(m: &M, pose: &M::Pose) -> bool {
    let found = singularity::report(m, pose).unwrap();
    let (u, v) = (M::U::CAPACITY, M::V::CAPACITY);
    let (j, a) = (m.jacobian_unknowns(pose), m.jacobian_inputs(pose));
    let dynamic = DMatrix::from_iterator(u, u, j.iter().copied());
    let by_inputs = DMatrix::from_iterator(u, v, a.iter().copied());
    let rank = numerical_rank(&dynamic);
    assert_eq!(found.rank(), rank, "{found}");
    assert_eq!(found.free().count(), u - rank);
    for free in found.free() {
        assert!((j * free).largest() <= 1e-13 * dynamic.amax() * free.largest(), "{found}");
    }
    let mut all = dynamic.clone().insert_columns(u, v, 0.0);
    all.columns_mut(u, v).copy_from(&by_inputs);
    assert_eq!(found.rank_with_inputs(), numerical_rank(&all));
    assert_eq!(found.admissible().count(), v - (numerical_rank(&all) - rank));
    for rates in found.admissible() {
        let mut extended = dynamic.clone().insert_column(u, 0.0);
        extended.column_mut(u).copy_from_slice((a * rates).as_slice());
        assert_eq!(numerical_rank(&extended), rank, "an admissible rate leaves the range of J");
    }
    let mut exchanges = Vec::new();
    for input in 0..v {
        for unknown in 0..u {
            let mut exchanged = dynamic.clone();
            exchanged.column_mut(unknown).copy_from(&by_inputs.column(input));
            if numerical_rank(&exchanged) == u {
                exchanges.push((m.unknown_name(unknown), m.input_name(input)));
            }
        }
    }
    assert_eq!(names(&found), exchanges);
    // The whole is singular if and only if a group is.
    assert_eq!(found.groups().all(|group| group.is_regular), !found.is_singular());
    let product: f64 = found.groups().map(|group| group.determinant).product();
    assert!((product.abs() - found.determinant().abs()).abs() <= 1e-13 * product.abs());
    found.is_singular()
}

#[test]
fn against_brute_force() {
    let mut random = SmallRng::seed_from_u64(20_091_121);
    let mut singular = 0;
    for round in 0..300 {
        // Every third position has right angles only, where determinants vanish.
        let mut angle = || match round % 3 {
            0 => f64::from(random.random_range(0..4_u8)) * FRAC_PI_2,
            _ => random.random_range(-3.0..3.0),
        };
        let four_bar = FourBar::default();
        let q = FourBarCoordinates { theta2: angle(), theta3: angle(), theta4: angle() };
        singular += i32::from(brute_force(&four_bar, &four_bar.pose_at(&q)));
        let six_bar = SixBar::default();
        let (theta1, theta2, theta3, theta4, theta5) = (angle(), angle(), angle(), angle(), angle());
        let q = SixBarCoordinates { theta1, theta2, theta3, theta4, theta5 };
        singular += i32::from(brute_force(&six_bar, &six_bar.pose_at(&q)));
        let m = FiveBar::default();
        let mut q =
            m.pose_at(&FiveBarCoordinates::from(nalgebra::SVector::<f64, 4>::from_fn(|_, _| angle()))).coordinates();
        singular += i32::from(brute_force(&m, &m.pose_at(&q)));
        q.theta2 = q.theta3;
        singular += i32::from(brute_force(&m, &m.pose_at(&q)));
        let m = DoubleButterfly::default();
        let q = DoubleButterflyCoordinates::from(nalgebra::SVector::<f64, 7>::from_fn(|_, _| angle()));
        singular += i32::from(brute_force(&m, &m.pose_at(&q)));
    }
    assert!(singular > 300, "{singular} singular positions of 1500");
}

/// In another unit of length, only numbers with a unit change.
#[test]
fn scale_free() {
    let m = SixBar::default();
    let q = m.branches(1.0).unwrap().next().unwrap().pose.coordinates();
    let found = singularity::report(&m, &m.pose_at(&q)).unwrap();
    let attainable = singularity::accuracy(&m, &m.pose_at(&q)).unwrap();
    for k in [-200, -3, 1, 200] {
        let scale = 2_f64.powi(k);
        let lengths: [f64; 9] = m.clone().into();
        let scaled = SixBar { delta: m.delta, ..SixBar::from(lengths.map(|length| length * scale)) };
        let pose = scaled.pose_at(&q);
        let other = singularity::report(&scaled, &pose).unwrap();
        assert_eq!(other.sigma_min(), found.sigma_min());
        assert!(other.drivers().eq(found.drivers()));
        for (group, other) in found.groups().zip(other.groups()) {
            assert_eq!((group.regularity, group.sigma_min), (other.regularity, other.sigma_min));
        }
        assert_eq!(singularity::accuracy(&scaled, &pose).unwrap(), attainable);
    }
}

/// eps / sigma min explains the distance of Newton's positions from those of the closed form, up to where it
/// announces that half the digits are lost; without it the same differences could be anything.
#[test]
fn attainable_accuracy() {
    let m = FourBar { l1: 60.0, l2: 20.0, l3: 50.0, l4: 30.0 - 1e-9 };
    let mut worst = (0.0_f64, 0.0_f64, 0.0_f64);
    for step in 0..2000 {
        let theta2 = PI - f64::from(step) * 1e-3;
        for Assembled { pose, .. } in m.branches(theta2).unwrap() {
            let here = singularity::accuracy(&m, &pose).unwrap();
            assert!(here.residual <= ROUNDING_ERROR, "{here:?}");
            let q = pose.coordinates();
            let Ok(solution) = m.solve(&q) else { continue };
            let other = solution.coordinates;
            let error = (other.theta3 - q.theta3).abs().max((other.theta4 - q.theta4).abs());
            if here.attainable() < 1e-9 {
                worst.0 = worst.0.max(error / here.unknowns().largest());
            }
            worst.1 = worst.1.max(here.attainable());
            worst.2 = worst.2.max(error);
        }
    }
    println!(
        "differences up to {:.2} of eps / sigma min, which goes up to {:.1e}; {:.1e} at most",
        worst.0, worst.1, worst.2
    );
    assert!(worst.0 <= 2.0 && worst.1 > 1e-13, "{worst:?}");
    // A constant bound of a few ulp would have been exceeded.
    assert!(worst.2 > 100.0 * f64::EPSILON, "{worst:?}");
}

/// Links in one line are singular at every angle of the line, although an angle and that plus pi are rounded
/// separately.
#[test]
fn links_in_line_are_singular_at_every_angle() {
    let m = FourBar::default();
    for step in -600..600 {
        let theta3 = 0.01 * f64::from(step);
        for theta4 in [theta3, theta3 + PI, theta3 - PI] {
            let pose = m.pose_at(&FourBarCoordinates { theta2: 0.3, theta3, theta4 });
            let found = singularity::report(&m, &pose).unwrap();
            assert!(found.is_singular() && found.rank() == 1, "{theta3}, {theta4}: {found}");
            assert!(found.groups().all(|group| !group.is_regular), "{theta3}, {theta4}: {found}");
            assert_eq!(found.free().count(), 1);
        }
        // A thousandth of a millionth of a degree is more than a rounding error.
        let pose = m.pose_at(&FourBarCoordinates { theta2: 0.3, theta3, theta4: theta3 + 1e-11 });
        assert!(!singularity::report(&m, &pose).unwrap().is_singular(), "{theta3}");
    }
}

/// NaN and infinity give errors, nothing hangs, and with lengths of zero a pose is singular instead of NaN.
#[test]
fn bad_input() {
    let q = FourBarCoordinates { theta2: 0.3, theta3: 1.2, theta4: -0.9 };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let m = FourBar { l3: bad, ..FourBar::default() };
        assert!(matches!(
            singularity::report(&m, &m.pose_at(&q)),
            Err(PositionError::NotFinite { mechanism: "FourBar", .. })
        ));
        assert!(matches!(singularity::accuracy(&m, &m.pose_at(&q)), Err(PositionError::NotFinite { .. })));
        assert!(matches!(singularity::sigma_min(&m, &m.pose_at(&q)), Err(PositionError::NotFinite { .. })));
        let m = FourBar::default();
        let pose = m.pose_at(&FourBarCoordinates { theta4: bad, ..q });
        assert!(matches!(singularity::report(&m, &pose), Err(PositionError::NotFinite { .. })));
    }
    let m = FourBar::new(0.0, 0.0, 0.0, 0.0);
    let found = singularity::report(&m, &m.pose_at(&q)).unwrap();
    assert_eq!((found.rank(), found.sigma_min(), found.determinant()), (0, 0.0, 0.0));
    assert!(found.groups().all(|group| group.regularity == 0.0 && !group.is_regular));
    assert_eq!(singularity::accuracy(&m, &m.pose_at(&q)).unwrap().attainable(), f64::INFINITY);
}
