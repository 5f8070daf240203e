//! The laws of each link, of each pin, and of virtual work.

use linkage::nalgebra::{Point2, Vector2, vector};

use super::*;
use crate::reactions::members::{Member, frame, obey, state};

#[test]
fn laws_of_all_links() {
    let random = Random::new(25);
    for number in 0..crate::reactions::OFTEN {
        let (scene, q) = at_random!(random, Cutting);
        let rate = random.either(20.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let state = state!(scene, q, rate, random.either(1.0));
        let (m, pose, rates, _, virtual_rates) = &state;
        let (at, of) = (m.points(pose).unwrap(), m.point_velocities(pose, virtual_rates).unwrap());
        let along = vector![q.psi.cos(), q.psi.sin()];
        let normal = vector![-along.y, along.x] * found.s_normal;
        let damper = -scene.c * rates.s * along;
        let spring = -scene.kt * (q.phi - q.psi - 0.2);
        let members = [
            Member::new(
                "wheel",
                (frame!(state, pin, theta), [scene.a1 - m.crank, scene.b1]),
                [scene.m1, scene.j1],
                &[(Point2::origin(), found.origin_on_wheel), (at.pin, found.pin_on_wheel)],
            )
            .turned(scene.torque),
            Member::new(
                "die",
                (frame!(state, pin, psi), [0.0; 2]),
                [scene.m2, scene.j2],
                &[(at.pin, found.pin_on_die)],
            )
            .guided(at.pin, normal, found.s_moment)
            .loaded(at.pin, damper),
            Member::new(
                "lever",
                (frame!(state, c, psi), [scene.a3, scene.b3]),
                [scene.m3, scene.j3],
                &[(at.c, found.c_on_lever), (at.e, found.e_on_lever)],
            )
            .guided(at.pin, -normal, -found.s_moment)
            .loaded(at.pin, -damper)
            .turned(-spring),
            Member::new(
                "link",
                (frame!(state, e, phi), [m.rod / 2.0, 0.0]),
                [scene.m4, scene.j4],
                &[(at.e, found.e_on_link), (at.ram, found.ram_on_link)],
            )
            .turned(spring),
            Member::new(
                "ram",
                (frame!(state, ram), [scene.xr, scene.yr]),
                [scene.m5, 0.0],
                &[(at.ram, found.ram_on_ram)],
            )
            .guided(at.ram, vector![0.0, found.x_normal], found.x_moment),
        ];
        let pins = [
            (vec![found.origin_on_ground, found.origin_on_wheel], Vector2::zeros(), Vector2::zeros()),
            (vec![found.pin_on_wheel, found.pin_on_die], Vector2::zeros(), of.pin),
            (vec![found.c_on_ground, found.c_on_lever], Vector2::zeros(), Vector2::zeros()),
            (vec![found.e_on_lever, found.e_on_link], Vector2::zeros(), of.e),
            (vec![found.ram_on_link, found.ram_on_ram], vector![-scene.cut, -scene.cut / 4.0], of.ram),
        ];
        obey(&format!("state {number}"), (scene.g, m.rod), &members, &pins);
    }
}
