//! Lengths of 2^-300 to 2^300, and joints 1e6 lengths from the origin. A tolerance of 1e-9, as Newton's method has it
//! in most programs (`scipy.optimize.fsolve` and others compare residuals with absolute numbers), accepts anything for
//! tiny lengths and nothing for huge ones; circles written with their constant terms, x^2 + y^2 + e x + f y + g = 0,
//! lose the square of the offset.

use linkage::nalgebra::{SMatrix, SVector};
use linkage::{Elbow, Mechanism, linkage};

use linkage_oracle::precise::{Scalar, big};

use linkage_gallery::four_bar::*;

const BRANCH: FourBarBranch = FourBarBranch::new(Elbow::Left);

/// Newton's method with an absolute tolerance.
fn naive(m: &FourBar, theta2: f64) -> Option<FourBarCoordinates> {
    let mut q = FourBarCoordinates { theta2, theta3: 1.0, theta4: -1.0 };
    for _ in 0..50 {
        let pose = m.pose_at(&q);
        if m.residual(&pose).largest() < 1e-9 {
            return Some(q);
        }
        let j = SMatrix::from(m.jacobian_unknowns(&pose));
        let step = j.lu().solve(&SVector::from(m.residual(&pose)))?;
        (q.theta3, q.theta4) = (q.theta3 - step[0], q.theta4 - step[1]);
    }
    None
}

#[test]
fn scales() {
    let m = FourBar::default();
    let theta2 = 0.35;
    let plain = m.assemble(theta2, BRANCH).unwrap();
    let good = plain.coordinates();
    let solved = m.solve(&FourBarCoordinates { theta2, theta3: 1.0, theta4: -1.0 }).unwrap();
    assert!((naive(&m, theta2).unwrap().theta3 - good.theta3).abs() < 1e-12);
    let mut wrong = 0;
    for k in -300..=300 {
        let scaled = m.clone().map(|length| length * 2_f64.powi(k));
        assert_eq!(scaled.assemble(theta2, BRANCH).unwrap().coordinates(), good);
        assert_eq!(scaled.solve(&FourBarCoordinates { theta2, theta3: 1.0, theta4: -1.0 }).unwrap(), solved);
        let found = naive(&scaled, theta2);
        wrong += i32::from(found.is_none_or(|found| (found.theta3 - good.theta3).abs() > 1e-6));
    }
    println!("a tolerance of 1e-9 fails at {wrong} of 601 scales");
    assert!(wrong > 400, "{wrong}");
}

linkage! {
    /// A four-bar between two joints anywhere.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FarFourBar {
        param ax = 0, ay = 0, dx = 80, dy = 0, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;

        loop (ax, ay) + l2@theta2 + l3@theta3 = (dx, dy) + l4@theta4;

        point C = (ax, ay) + l2@theta2 + l3@theta3;
    }
}

/// The intersection of the circles of two links by the radical line of their equations: the joint left of the line.
fn by_radical_line([x1, y1]: [f64; 2], r1: f64, [x2, y2]: [f64; 2], r2: f64) -> [f64; 2] {
    let g = |x: f64, y: f64, r: f64| x * x + y * y - r * r;
    let (a, b, c) = (2.0 * (x2 - x1), 2.0 * (y2 - y1), g(x2, y2, r2) - g(x1, y1, r1));
    // The foot of the first centre on a x + b y = c.
    let over = (c - a * x1 - b * y1) / (a * a + b * b);
    let half = (r1 * r1 - over * over * (a * a + b * b)).sqrt() / a.hypot(b);
    [x1 + a * over - b * half, y1 + b * over + a * half]
}

#[test]
fn offsets() {
    let near = FarFourBar::default();
    let offset = 1_048_576.0;
    let far = FarFourBar { ax: offset, ay: -offset, dx: 80.0 + offset, dy: -offset, ..near.clone() };
    let (mut ours, mut naive) = (0.0_f64, 0.0_f64);
    for step in 0..360 {
        let theta2 = f64::from(step).to_radians();
        let (sine, cosine) = big(theta2).sin_cos();
        let joint = [big(far.ax) + big(far.l2) * cosine, big(far.ay) + big(far.l2) * sine];
        let d = [big(far.dx) - &joint[0], big(far.dy) - &joint[1]];
        // The joint C from two circles.
        let square = &d[0] * &d[0] + &d[1] * &d[1];
        let [p2, q2] = [far.l3, far.l4].map(|length| big(length) * big(length));
        let along = (&square + &p2 - &q2) / (big(2.0) * &square);
        let half = (&p2 / &square - &along * &along).sqrt();
        let expected = [&joint[0] + &d[0] * &along - &d[1] * &half, &joint[1] + &d[1] * &along + &d[0] * &half];
        let branch = FarFourBarBranch { theta3_theta4: Elbow::Left };
        let pose = far.assemble(theta2, branch).unwrap();
        let c = far.points(&pose).unwrap().c;
        let b = [far.ax + far.l2 * theta2.cos(), far.ay + far.l2 * theta2.sin()];
        let other = by_radical_line(b, far.l3, [far.dx, far.dy], far.l4);
        for axis in 0..2 {
            ours = ours.max((big(c[axis]) - &expected[axis]).double().abs());
            naive = naive.max((big(other[axis]) - &expected[axis]).double().abs());
        }
    }
    let ulp = offset * f64::EPSILON;
    println!("1e6 lengths away: radical line {:.1e} ulp, emitted {:.1} ulp of the offset", naive / ulp, ours / ulp);
    assert!(ours <= 4.0 * ulp && naive >= 1e3 * ulp, "{ours:e} {naive:e}");
}
