//! The laws that hold for every body of every machine, at random states of random scenes: the sum of all forces and
//! moments, the work of the forces in joints, the force on the ground.

use linkage::nalgebra::{Point2, Vector2, vector};
use linkage::simulation::{Start, simulate};
use linkage::{Mode, linkage};
use linkage_gallery::{pendulum, slider_crank_scenes, three_link_arm};

use crate::reactions::members::{Frame, Member, cross, frame, obey};
use crate::reactions::{Random, is_regular};

linkage! {
    /// A six-bar with a ternary link.
    #[derive(Debug, Clone)]
    mechanism Six {
        param a = 2, b = 7, c = 6, d = 8, px = 5, py = 4, e = 9, f = 5, fx = 12, fy = 3;
        param m2 = 1, j2 = 1, m3 = 2, j3 = 9, m4 = 1.5, j4 = 4, m5 = 1.2, j5 = 6, m6 = 0.8, j6 = 2;
        param g = 9.81, k = 40, free = 6, damp = 3, push = 25, drag = 7;
        input theta2;
        unknown theta3, theta4, theta5, theta6;
        loop a@theta2 + b@theta3 = d@0 + c@theta4;
        loop a@theta2 + (px, py)@theta3 + e@theta5 = (fx, fy) + f@theta6;
        point A = (0, 0);
        point D = (d, 0);
        point F = (fx, fy);
        point B = a@theta2;
        point C = D + c@theta4;
        point P = B + (px, py)@theta3;
        point Q = P + e@theta5;
        point G2 = (a / 2)@theta2;
        point G3 = B + (b / 2, 1)@theta3;
        point G4 = D + (c / 2)@theta4;
        point G5 = P + (e / 3)@theta5;
        point G6 = F + (f / 2)@theta6;
        point Tip = B + (3, 5)@theta3;
        body b2 { mass m2; inertia j2; center G2; angle theta2; }
        body b3 { mass m3; inertia j3; center G3; angle theta3; }
        body b4 { mass m4; inertia j4; center G4; angle theta4; }
        body b5 { mass m5; inertia j5; center G5; angle theta5; }
        body b6 { mass m6; inertia j6; center G6; angle theta6; }
        scene Loaded {
            inertia;
            gravity (0, -g);
            spring k, free between Tip and G6;
            force (push, -2 * push) at Q;
            damper damp on theta6;
            friction drag on theta4;
            reactions;
        }
    }
}

#[test]
fn a_six_bar_with_loads() {
    let random = Random::new(31);
    let mut states = 0;
    while states < 200 {
        let mut scene = Loaded::default();
        for value in [&mut scene.m2, &mut scene.m3, &mut scene.m5, &mut scene.k, &mut scene.push, &mut scene.drag] {
            *value *= random.factor();
        }
        let m = &scene.mechanism;
        let Some(found) = m.branches(random.either(3.0)).ok().and_then(|mut all| all.nth(states % 3)) else { continue };
        if !is_regular(m, &found.pose) {
            continue;
        }
        let (q, omega) = (found.pose.coordinates(), random.either(4.0));
        let found = scene.reactions(0.0, &q, omega).unwrap();
        // The accelerations follow from the friction, which slips.
        let pose = m.pose_at(&q);
        let rates = m.velocity(&pose, omega).unwrap();
        let drag = -scene.drag * rates.theta4.signum();
        let ratio = rates.theta4 / omega;
        let gain = (scene.forces(0.0, &q, omega).unwrap()[0] + drag * ratio) / scene.mass_matrix(&q).unwrap()[0];
        let accelerations = m.acceleration(&pose, &rates, gain).unwrap();
        let state = (m, pose, rates, accelerations, m.velocity(&pose, random.either(1.0)).unwrap());
        let (at, of) = (m.points(&pose).unwrap(), m.point_velocities(&pose, &state.4).unwrap());
        let stretch = at.g6 - at.tip;
        let pull = scene.k * (stretch.norm() - scene.free) * stretch.normalize();
        let of_b3 = [(at.b, found.b_on_b3), (at.c, found.c_on_b3), (at.p, found.p_on_b3)];
        let of_b5 = [(at.p, found.p_on_b5), (at.q, found.q_on_b5)];
        let members = [
            Member::new(
                "b2",
                (frame!(state, g2, theta2), [0.0; 2]),
                [scene.m2, scene.j2],
                &[(at.a, found.a_on_b2), (at.b, found.b_on_b2)],
            ),
            Member::new("b3", (frame!(state, g3, theta3), [0.0; 2]), [scene.m3, scene.j3], &of_b3).loaded(at.tip, pull),
            Member::new(
                "b4",
                (frame!(state, g4, theta4), [0.0; 2]),
                [scene.m4, scene.j4],
                &[(at.c, found.c_on_b4), (at.d, found.d_on_b4)],
            )
            .turned(drag),
            Member::new("b5", (frame!(state, g5, theta5), [0.0; 2]), [scene.m5, scene.j5], &of_b5),
            Member::new(
                "b6",
                (frame!(state, g6, theta6), [0.0; 2]),
                [scene.m6, scene.j6],
                &[(at.q, found.q_on_b6), (at.f, found.f_on_b6)],
            )
            .loaded(at.g6, -pull)
            .turned(-scene.damp * state.2.theta6),
        ];
        let (zero, load) = (Vector2::zeros(), vector![scene.push, -2.0 * scene.push]);
        let pins = [
            (vec![found.a_on_ground, found.a_on_b2], zero, zero),
            (vec![found.b_on_b2, found.b_on_b3], zero, of.b),
            (vec![found.c_on_b3, found.c_on_b4], zero, of.c),
            (vec![found.p_on_b3, found.p_on_b5], zero, of.p),
            (vec![found.q_on_b5, found.q_on_b6], load, of.q),
            (vec![found.d_on_ground, found.d_on_b4], zero, zero),
            (vec![found.f_on_ground, found.f_on_b6], zero, zero),
        ];
        obey(&format!("state {states}"), (scene.g, 12.0), &members, &pins);
        states += 1;
    }
}

#[test]
fn a_slider_crank_with_friction_by_reactions() {
    use slider_crank_scenes::{CrankBranch, Worn};
    let random = Random::new(32);
    for number in 0..200 {
        let mut scene = Worn::default();
        (scene.mu, scene.m3, scene.m4) = (0.3 * random.factor(), random.factor(), random.factor());
        let m = &scene.mechanism;
        let (phi, omega) = (random.either(3.0), random.either(60.0));
        let pose = m.assemble(phi, CrankBranch { psi_z: linkage::Slider::Far }).unwrap();
        let q = pose.coordinates();
        let found = scene.reactions(0.0, &q, omega).unwrap();
        let rates = m.velocity(&pose, omega).unwrap();
        // The law of each friction, with the reactions as they are found.
        let pin = found.pin_on_rod;
        let journal = -scene.mu * scene.rp * pin.norm() * (rates.psi - rates.phi).signum();
        let guide = -scene.mu * found.z_normal.abs() * rates.z.signum();
        let ratio = |rate: f64| rate / omega;
        let extra = journal * ratio(rates.psi - rates.phi) + guide * ratio(rates.z);
        let gain = (scene.forces(0.0, &q, omega).unwrap()[0] + extra) / scene.mass_matrix(&q).unwrap()[0];
        let accelerations = m.acceleration(&pose, &rates, gain).unwrap();
        let (at, virtual_rates) = (m.points(&pose).unwrap(), m.velocity(&pose, random.either(1.0)).unwrap());
        let of = m.point_velocities(&pose, &virtual_rates).unwrap();
        let piston = Frame {
            at: Point2::new(q.z, 0.0),
            angle: 0.0,
            rate: 0.0,
            acceleration: vector![accelerations.z, 0.0],
            gain: 0.0,
            virtual_motion: (vector![virtual_rates.z, 0.0], 0.0),
        };
        let state = (m, pose, rates, accelerations, virtual_rates);
        let [on_rod, on_piston] = found.piston_pin();
        let of_crank = [(Point2::origin(), found.origin_on_crank), (at.pin, found.pin_on_crank)];
        let members = [
            Member::new("crank", (frame!(state, pin, phi), [-0.75 * m.r, 0.0]), [scene.m2, scene.j2], &of_crank)
                .turned(-journal),
            Member::new(
                "rod",
                (frame!(state, g3, psi), [0.0; 2]),
                [scene.m3, scene.j3],
                &[(at.pin, pin), (piston.at, on_rod)],
            )
            .turned(journal),
            Member::new("piston", (piston, [0.0; 2]), [scene.m4, 0.0], &[(piston.at, on_piston)])
                .guided(piston.at, vector![0.0, found.z_normal], found.z_moment)
                .loaded(piston.at, vector![guide, 0.0]),
        ];
        let zero = Vector2::zeros();
        let pins = [
            (vec![found.origin_on_ground, found.origin_on_crank], zero, zero),
            (vec![found.pin_on_crank, found.pin_on_rod], zero, of.pin),
            (vec![on_rod, on_piston], zero, piston.virtual_motion.0),
        ];
        obey(&format!("state {number}"), (scene.g, m.l), &members, &pins);
    }
}

/// The forces of the piston pin, which has no declared point, on rod and piston.
trait PistonPin {
    fn piston_pin(&self) -> [Vector2<f64>; 2];
}

impl PistonPin for slider_crank_scenes::WornReactions {
    fn piston_pin(&self) -> [Vector2<f64>; 2] {
        [self.rod_piston_on_rod, self.rod_piston_on_piston]
    }
}

#[test]
fn an_arm_that_is_an_open_chain() {
    use three_link_arm::{Pushed, ThreeLinkArmCoordinates, ThreeLinkArmInputs};
    let random = Random::new(33);
    for _ in 0..200 {
        let scene = Pushed::default();
        let m = &scene.mechanism;
        let [phi1, phi2, phi3] = [(); 3].map(|()| random.either(3.0));
        let q = ThreeLinkArmCoordinates { phi1, phi2, phi3 };
        let [phi1, phi2, phi3] = [(); 3].map(|()| random.either(3.0));
        let omega = ThreeLinkArmInputs { phi1, phi2, phi3 };
        let t = random.either(1.0);
        let found = scene.reactions(t, &q, omega).unwrap();
        let friction = -scene.mu * scene.rub * phi3.signum();
        let forces = scene.forces(t, &q, omega).unwrap() + vector![0.0, 0.0, friction];
        let gains = scene.mass_matrix(&q).unwrap().lu().solve(&forces).unwrap();
        let pose = m.pose_at(&q);
        let rates = m.velocity(&pose, omega).unwrap();
        let accelerations = m.acceleration(&pose, &rates, gains).unwrap();
        let at = m.points(&pose).unwrap();
        let of = m.point_accelerations(&pose, &rates, &accelerations).unwrap();
        let (load, weight) = (vector![8.0 * (2.0 * t).cos(), 3.0], vector![0.0, -scene.g]);
        // The centres are in the middle of the links.
        let [upper, lower, hand] = [of.elbow / 2.0, (of.elbow + of.wrist) / 2.0, (of.wrist + of.tool) / 2.0];
        let size = found.origin_on_upper.norm() + found.elbow_on_lower.norm() + found.wrist_on_hand.norm();
        let balances = [
            found.wrist_on_hand + load + scene.m3 * (weight - hand) + scene.load * (weight - of.tool),
            found.wrist_on_lower + found.elbow_on_lower + scene.m2 * (weight - lower),
            found.elbow_on_upper + found.origin_on_upper + scene.m1 * (weight - upper),
            found.origin_on_upper + found.origin_on_ground,
        ];
        for balance in balances {
            assert!(balance.norm() < 1e-12 * size, "{balance} of {size}");
        }
        // The moments on the hand about the wrist.
        let arm = at.tool - at.wrist;
        let spin = accelerations.phi1 + accelerations.phi2 + accelerations.phi3;
        let moments = cross(arm, scene.m3 * (weight - hand)) / 2.0 + cross(arm, load + scene.load * (weight - of.tool));
        let rest = moments + friction - scene.j3 * spin;
        assert!(rest.abs() < 1e-12 * size, "{rest} of {size}");
    }
}

#[test]
fn a_journal_carries_weight_and_swing() {
    use pendulum::{PendulumCoordinates, Worn};
    let random = Random::new(34);
    for _ in 0..200 {
        let scene = Worn { mu: 0.4, r: 0.05, ..Worn::default() };
        let (theta, omega) = (random.either(3.0), random.either(5.0));
        let q = PendulumCoordinates { theta };
        let force = scene.reactions(0.0, &q, omega).unwrap().origin_on_bob;
        // m l'^2 theta'' = -m g l cos theta - mu r |R| sign(theta'), R from the motion of the centre.
        let l = scene.mechanism.l;
        let arm = vector![theta.cos(), theta.sin()] * l;
        let across = vector![-arm.y, arm.x];
        let gain = |friction: f64| (-scene.m * scene.g * arm.x + friction) / (scene.j + scene.m * l * l);
        let friction = -scene.mu * scene.r * force.norm() * omega.signum();
        let expected = scene.m * (across * gain(friction) - arm * omega * omega + vector![0.0, scene.g]);
        assert!((force - expected).norm() < 1e-12 * force.norm(), "{force} {expected}");
    }
    // At rest within the friction circle it stays: the vertical force passes the journal at its radius.
    let scene = Worn { mu: 0.4, r: 0.05, ..Worn::default() };
    let limit = scene.mu * scene.r / scene.mechanism.l;
    for (offset, stays) in [(limit * (1.0 - 1e-12), true), (limit * (1.0 + 1e-12), false)] {
        let q = PendulumCoordinates { theta: -std::f64::consts::FRAC_PI_2 + offset.asin() };
        let motion = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 1.0, 1e-9).unwrap();
        assert_eq!(motion.state().contacts[0].mode == Mode::Stick, stays, "{offset}");
    }
}
