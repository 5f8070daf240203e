//! The laws of each link, of each pin, and of virtual work.

use linkage::nalgebra::{Point2, Vector2, vector};

use super::*;
use crate::reactions::members::{Member, frame, obey, state};

#[test]
fn laws_of_all_links() {
    let random = Random::new(15);
    for number in 0..crate::reactions::OFTEN {
        let (scene, q) = at_random!(random, Free);
        let rates = inputs(rates_of(&random));
        let found = scene.reactions(0.0, &q, rates).unwrap();
        let state = state!(scene, q, rates, inputs(rates_of(&random)));
        let (m, pose, rates, _, virtual_rates) = &state;
        let (at, of) = (m.points(pose).unwrap(), m.point_velocities(pose, virtual_rates).unwrap());
        let stretch = at.c - at.a;
        let pull = scene.k * (stretch.norm() - scene.s0) * stretch.normalize();
        let damper = -scene.ct * (rates.theta2 - rates.theta3);
        let members = [
            Member::new(
                "left",
                (frame!(state, a, theta1), [-m.a / 2.0, 0.0]),
                [scene.m1, scene.j1],
                &[(Point2::origin(), found.origin_on_left), (at.a, found.a_on_left)],
            )
            .turned(scene.torque),
            Member::new(
                "arm",
                (frame!(state, a, theta2), [scene.a2, scene.b2]),
                [scene.m2, scene.j2],
                &[(at.a, found.a_on_arm), (at.p, found.p_on_arm)],
            )
            .turned(damper),
            Member::new(
                "forearm",
                (frame!(state, c, theta3), [m.c / 2.0, 0.0]),
                [scene.m3, scene.j3],
                &[(at.c, found.c_on_forearm), (at.p, found.p_on_forearm)],
            )
            .turned(-damper),
            Member::new(
                "right",
                (frame!(state, d, theta4), [0.0; 2]),
                [0.0; 2],
                &[(at.d, found.d_on_theta4), (at.c, found.c_on_theta4)],
            )
            .turned(-scene.torque / 2.0),
        ];
        // The mass of the tool is on its pin.
        let tool = scene.m5 * (frame!(state, p).acceleration + vector![0.0, scene.g]);
        let load = vector![scene.f, -2.0 * scene.f] - tool;
        let pins = [
            (vec![found.origin_on_ground, found.origin_on_left], Vector2::zeros(), Vector2::zeros()),
            (vec![found.a_on_left, found.a_on_arm], pull, of.a),
            (vec![found.c_on_forearm, found.c_on_theta4], -pull, of.c),
            (vec![found.p_on_arm, found.p_on_forearm], load, of.p),
            (vec![found.d_on_ground, found.d_on_theta4], Vector2::zeros(), Vector2::zeros()),
        ];
        obey(&format!("state {number}"), (scene.g, m.a), &members, &pins);
    }
}
