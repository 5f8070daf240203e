//! The laws of each link, of each pin, and of virtual work.

use linkage::nalgebra::{Point2, Vector2, vector};

use super::*;
use crate::reactions::members::{Member, frame, obey, state};

#[test]
fn laws_of_all_links() {
    let random = Random::new(7);
    for number in 0..crate::reactions::OFTEN {
        let (scene, q) = at_random!(random, Turning);
        let rate = random.either(60.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let state = state!(scene, q, rate, random.either(1.0));
        let (m, pose, rates, _, virtual_rates) = &state;
        let (at, of) = (m.points(pose).unwrap(), m.point_velocities(pose, virtual_rates).unwrap());
        let push = vector![-scene.p, 2.0 * scene.p];
        let stretch = Point2::new(0.02, -0.1) - at.a;
        let pull = scene.k * (stretch.norm() - scene.s0) * stretch.normalize();
        let on_crank = [(Point2::origin(), found.origin_on_crank), (at.a, found.a_on_crank)];
        let members = [
            Member::new("crank", (frame!(state, a, phi), [scene.a2 - m.r, scene.b2]), [scene.m2, scene.j2], &on_crank)
                .turned(scene.torque),
            Member::new(
                "rod",
                (frame!(state, a, psi), [m.a3, m.b3]),
                [scene.m3, scene.j3],
                &[(at.a, found.a_on_rod), (at.b, found.b_on_rod)],
            )
            .loaded(at.g3, vector![scene.p / 3.0, -scene.p]),
            Member::new("piston", (frame!(state, b), [0.0; 2]), [scene.m4, 0.0], &[(at.b, found.b_on_piston)])
                .guided(at.b, vector![0.0, found.z_normal], found.z_moment)
                .loaded(at.b, vector![-scene.c * rates.z, 0.0]),
        ];
        let pins = [
            (vec![found.origin_on_ground, found.origin_on_crank], Vector2::zeros(), Vector2::zeros()),
            (vec![found.a_on_crank, found.a_on_rod], pull, of.a),
            (vec![found.b_on_rod, found.b_on_piston], push, of.b),
        ];
        obey(&format!("state {number}"), (scene.g, m.l), &members, &pins);
    }
}
