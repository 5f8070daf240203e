//! Reactions, statics, equilibria and stiffness.

use linkage::{Mechanism, Real};
use num_dual::Dual64;

use super::machines::*;
use super::virtual_work::{Placed, Positions, agrees, at_random, constant, virtual_work};

/// The reaction where the rocker meets the ground, and then each body by Newton's and Euler's laws: forces from joint
/// to joint, moments about each centre; the remaining moment at the crank is the torque of the drive.
#[test]
fn reactions_hold_every_body() {
    use linkage::nalgebra::{Point2, Vector2};
    let scene = Driven::default();
    let four_bar = &scene.mechanism;
    at_random(|v: [f64; 1], rate: [f64; 1], t| {
        let pose = four_bar.assemble(v[0], FOUR_BAR).unwrap();
        let q = pose.coordinates();
        let linkage::StateRates { rates: velocity, input_accelerations } = scene.rates(t, &q, rate[0]).unwrap();
        let motion = four_bar.motion(&q, rate[0], input_accelerations).unwrap();
        let (points, turning) = (motion.points, motion.accelerations);
        let lambda: Vector2<f64> = scene.reactions(t, &q, rate[0]).unwrap().multipliers;
        let weight = Vector2::new(0.0, -scene.g);
        let end = points.c.position + Vector2::new(q.theta4.cos(), q.theta4.sin()) * four_bar.l4;
        // The force that holds a body at the joint `from`, and the remaining moment about its centre.
        let held =
            |m: f64, center: linkage::PointMotion<f64>, from: Point2<f64>, to: Point2<f64>, load: Vector2<f64>| {
                let force = (center.acceleration - weight) * m - load;
                let moment = (from - center.position).perp(&force) + (to - center.position).perp(&load);
                (force, moment)
            };
        let (at_c, rocker) = held(scene.m4, points.g4, points.c.position, end, -lambda);
        let (at_b, coupler) = held(scene.m3, points.g3, points.b.position, points.c.position, -at_c);
        let (at_a, crank) = held(scene.m2, points.g2, Point2::origin(), points.b.position, -at_b);
        let size = lambda.norm() + at_c.norm() + at_b.norm() + at_a.norm();
        agrees("rocker", rocker - scene.ct * velocity.theta4, scene.j4 * turning.theta4, size);
        agrees("coupler", coupler, scene.j3 * turning.theta3, size);
        let torque = scene.drive_forces(t, &q, rate[0]).unwrap().theta2;
        agrees("crank", crank + torque, scene.j2 * turning.theta2, size);
    });
}

/// Without inertia: the weight of two bodies and a spring, held by the crank's torque.
#[test]
fn statics_by_virtual_work() {
    struct Heavy;
    impl Positions<1> for Heavy {
        fn bodies<T: Real>(&self, v: [T; 1]) -> Vec<Placed<T>> {
            FourBarPositions.bodies(v).split_off(1)
        }

        fn scalars<T: Real>(&self, v: [T; 1]) -> Vec<T> {
            FourBarPositions.scalars(v)
        }
    }
    let scene = Balanced::default();
    at_random(|v: [f64; 1], _, t| {
        let q = four_bar_at(v).unwrap();
        let mut expected = virtual_work(&Heavy, v, [0.0], [0.0, -scene.g]);
        expected.add(1, |angle, _| -scene.kt * (angle - scene.phi0));
        agrees("Q", scene.forces(t, &q, 3.0).unwrap()[0], expected.forces[0], expected.sizes[0]);
    });
}

/// Equilibria; the stiffness in the search is exact, or it would take more than a few steps.
#[test]
fn equilibria() {
    let scene = Balanced::default();
    let guess = four_bar_at([0.4]).unwrap();
    let q = scene.equilibrium(0.0, &guess).unwrap();
    let scale = scene.m3 * scene.g;
    let left = scene.forces(0.0, &q, 0.0).unwrap()[0];
    assert!(left.abs() < 1e-12 * scale && (q.theta2 - guess.theta2).abs() > 0.01, "{left:e} {q:?}");
    let four_bar = &scene.mechanism;
    assert!(four_bar.residual(&four_bar.pose_at(&q)).largest() < 1e-15);
    // A spring without weight is at rest where it is not stretched.
    let spring = Balanced { g: 0.0, phi0: four_bar_at([0.5]).unwrap().theta4, ..Balanced::default() };
    assert!((spring.equilibrium(0.0, &guess).unwrap().theta2 - 0.5).abs() < 1e-13);

    let free = Free::default();
    let pose = free.mechanism.assemble(PairInputs { theta1: -1.8, theta4: -1.3 }, PAIR).unwrap();
    let q = free.equilibrium(0.5, &pose.coordinates()).unwrap();
    let left = free.forces(0.5, &q, PairInputs { theta1: 0.0, theta4: 0.0 }).unwrap();
    assert!(left.amax() < 1e-12 * free.m2 * free.g, "{left} {q:?}");
    // One input is driven, and stays at its value.
    let half = Half::default();
    let q = half.equilibrium(0.5, &pose.coordinates()).unwrap();
    assert_eq!(q.theta4, 0.7 * 0.5 + 0.125);
    let left = half.forces(0.5, &q, PairInputs { theta1: 0.0, theta4: 0.0 }).unwrap();
    assert!(left[0].abs() < 1e-12 * half.m2 * half.g, "{left} {q:?}");
    // Without forces every position is an equilibrium.
    let mut empty = Balanced::default();
    (empty.m3, empty.m4, empty.kt) = (0.0, 0.0, 0.0);
    assert_eq!(empty.equilibrium(0.0, &guess).unwrap().theta2, 0.4);
}

/// dQ/dv at rest against the forces at dual positions.
#[test]
fn stiffness_by_dual_numbers() {
    let (scene, free) = (Balanced::default(), Free::default());
    at_random(|v: [f64; 2], _, t| {
        let q = four_bar_at([v[0]]).unwrap();
        let moved = four_bar_at([Dual64::new(v[0], 1.0)]).unwrap();
        let force = scene.clone().map(constant::<Dual64>).forces(constant(t), &moved, Dual64::from(0.0)).unwrap()[0];
        let balance = scene.balance(t, &q).unwrap();
        agrees("Q", balance.forces[0], force.re, balance.scales[0]);
        agrees("dQ/dv", balance.slopes[0][0], force.eps, balance.scales[0]);

        let pair = Pair::default().map(constant::<Dual64>);
        let Ok(pose) = free.mechanism.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR) else { return };
        let balance = free.balance(t, &pose.coordinates()).unwrap();
        for (column, slopes) in balance.slopes.into_iter().enumerate() {
            let [theta1, theta4] = [0, 1].map(|at| Dual64::new(v[at], f64::from(u8::from(at == column))));
            let q = pair.assemble(PairInputs { theta1, theta4 }, PAIR).unwrap().coordinates();
            let rest = PairInputs { theta1: Dual64::from(0.0), theta4: Dual64::from(0.0) };
            let forces = free.clone().map(constant::<Dual64>).forces(constant(t), &q, rest).unwrap();
            for (row, slope) in slopes.into_iter().enumerate() {
                let scale = balance.scales[row] + slopes[0].abs() + slopes[1].abs();
                agrees("Q", balance.forces[row], forces[row].re, balance.scales[row]);
                agrees("dQ/dv", slope, forces[row].eps, scale);
            }
        }
    });
}
