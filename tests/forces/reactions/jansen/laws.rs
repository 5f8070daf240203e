//! The laws of each link, of each pin, and of virtual work.

use linkage::nalgebra::{Point2, Vector2, vector};

use super::*;
use crate::reactions::members::{Member, frame, obey, state};

#[test]
fn laws_of_all_links() {
    let random = Random::new(45);
    for number in 0..crate::reactions::OFTEN {
        let (scene, q) = at_random!(random, Walking);
        let rate = random.either(8.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let state = state!(scene, q, rate, random.either(1.0));
        let (m, pose, rates, _, virtual_rates) = &state;
        let (at, of) = (m.points(pose).unwrap(), m.point_velocities(pose, virtual_rates).unwrap());
        let stretch = at.knee - at.back;
        let pull = scene.ks * (stretch.norm() - 0.3) * stretch.normalize();
        let damper = -scene.ct * (rates.lower_leg - rates.link_c);
        let of_wheel = [(Point2::origin(), found.origin_on_wheel), (at.pin, found.pin_on_wheel)];
        let of_thigh =
            [(at.pivot, found.pivot_on_thigh), (at.upper, found.upper_on_thigh), (at.back, found.back_on_thigh)];
        let of_shank = [(at.knee, found.knee_on_shank), (at.ankle, found.ankle_on_shank)];
        let of_rod_j = [(at.pin, found.pin_on_rod_j), (at.upper, found.upper_on_rod_j)];
        let of_rod_k = [(at.pin, found.pin_on_rod_k), (at.knee, found.knee_on_rod_k)];
        let of_link_c = [(at.pivot, found.pivot_on_link_c), (at.knee, found.knee_on_link_c)];
        let of_link_f = [(at.back, found.back_on_link_f), (at.ankle, found.ankle_on_link_f)];
        // The centre of a triangle in the axes of its first side, from their common corner.
        let centroid = |one: f64, other: f64, opposite: f64| {
            let cosine = (one * one + other * other - opposite * opposite) / (2.0 * one * other);
            [(one + other * cosine) / 3.0, other * (1.0 - cosine * cosine).sqrt() / 3.0]
        };
        let members = [
            Member::new("wheel", (frame!(state, pin, crank), [0.01 - m.m, 0.002]), [scene.m1, scene.j1], &of_wheel)
                .turned(scene.torque),
            Member::new(
                "thigh",
                (frame!(state, pivot, upper_leg), centroid(m.b, m.d, m.e)),
                [scene.m2, scene.j2],
                &of_thigh,
            ),
            Member::new(
                "shank",
                (frame!(state, knee, lower_leg), centroid(m.g, m.i, m.h)),
                [scene.m3, scene.j3],
                &of_shank,
            )
            .turned(damper)
            .loaded(at.foot, vector![scene.fx, scene.fy]),
            Member::new("rod j", (frame!(state, pin, push), [m.j / 2.0, 0.0]), [scene.mj, scene.jj], &of_rod_j),
            Member::new("rod k", (frame!(state, pin, link_k), [m.k / 2.0, 0.0]), [scene.mk, scene.jk], &of_rod_k),
            Member::new("link c", (frame!(state, pivot, link_c), [0.0; 2]), [0.0; 2], &of_link_c).turned(-damper),
            Member::new("link f", (frame!(state, back, link_f), [0.0; 2]), [0.0; 2], &of_link_f),
        ];
        let zero = Vector2::zeros();
        let pins = [
            (vec![found.origin_on_ground, found.origin_on_wheel], zero, zero),
            (vec![found.pivot_on_ground, found.pivot_on_thigh, found.pivot_on_link_c], zero, zero),
            (vec![found.pin_on_wheel, found.pin_on_rod_j, found.pin_on_rod_k], zero, of.pin),
            (vec![found.upper_on_rod_j, found.upper_on_thigh], zero, of.upper),
            (vec![found.back_on_thigh, found.back_on_link_f], pull, of.back),
            (vec![found.knee_on_rod_k, found.knee_on_link_c, found.knee_on_shank], -pull, of.knee),
            (vec![found.ankle_on_link_f, found.ankle_on_shank], zero, of.ankle),
        ];
        obey(&format!("state {number}"), (scene.gr, m.k), &members, &pins);
    }
}
