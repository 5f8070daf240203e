//! The laws of each link, of each pin, and of virtual work.

use linkage::nalgebra::{Point2, Vector2, vector};

use super::*;
use crate::reactions::members::{Member, frame, obey, state};

#[test]
fn laws_of_all_links() {
    let random = Random::new(36);
    for number in 0..crate::reactions::OFTEN {
        let (scene, q) = at_random!(random, Digging);
        let rates = [0.4, 0.5, 0.5].map(|size| random.either(size));
        let found = scene.reactions(0.0, &q, inputs(rates)).unwrap();
        let virtual_rates = [(); 3].map(|()| random.either(1.0));
        let state = state!(scene, q, inputs(rates), inputs(virtual_rates));
        let (m, pose, _, _, virtual_rates) = &state;
        let (at, of) = (m.points(pose).unwrap(), m.point_velocities(pose, virtual_rates).unwrap());
        let stretch = at.tooth - at.joint;
        let pull = scene.k * (stretch.norm() - scene.s0) * stretch.normalize();
        let directions = [q.psi1, q.psi2].map(|psi| vector![psi.cos(), psi.sin()]);
        let [normal1, normal2] = [0, 1].map(|place: usize| {
            let along = directions[place];
            vector![-along.y, along.x] * [found.s1_normal, found.s2_normal][place]
        });
        let [thrust1, thrust2] = [scene.f1 - scene.c * rates[1], scene.f2];
        let [thrust1, thrust2] = [directions[0] * thrust1, directions[1] * thrust2];
        let of_beam = [
            (Point2::origin(), found.origin_on_beam),
            (at.foot1, found.foot1_on_beam),
            (at.joint, found.joint_on_beam),
        ];
        let of_dipper = [
            (at.joint, found.joint_on_dipper),
            (at.lever, found.lever_on_dipper),
            (at.foot2, found.foot2_on_dipper),
            (at.pivot, found.pivot_on_dipper),
            (at.hinge, found.hinge_on_dipper),
        ];
        let of_rocker = [(at.pivot, found.pivot_on_rocker), (at.knee, found.knee_on_rocker)];
        let of_link = [(at.knee, found.knee_on_kappa), (at.ear, found.ear_on_kappa)];
        let of_shovel = [(at.hinge, found.hinge_on_shovel), (at.ear, found.ear_on_shovel)];
        let (barrel, piston) = ([scene.mb, scene.jb], [scene.mr, scene.jr]);
        let members = [
            Member::new("beam", (frame!(state, joint, boom), [-m.lb / 2.0, 0.6]), [scene.m1, scene.j1], &of_beam)
                .turned(scene.torque),
            Member::new("dipper", (frame!(state, joint, stick), [m.ls / 3.0, 0.2]), [scene.m2, scene.j2], &of_dipper),
            Member::new("rocker", (frame!(state, pivot, rho), [m.lr / 2.0, 0.0]), [scene.m4, scene.j4], &of_rocker),
            Member::new("link", (frame!(state, knee, kappa), [0.0; 2]), [0.0; 2], &of_link),
            Member::new("shovel", (frame!(state, hinge, bucket), [0.25, -0.65]), [scene.m3, scene.j3], &of_shovel)
                .loaded(at.tooth, vector![-scene.dig, scene.dig / 2.0] - pull),
            Member::new(
                "barrel 1",
                (frame!(state, foot1, psi1), [0.8, 0.0]),
                barrel,
                &[(at.foot1, found.foot1_on_barrel1)],
            )
            .guided(at.lever, -normal1, -found.s1_moment)
            .loaded(at.foot1, -thrust1),
            Member::new(
                "piston 1",
                (frame!(state, lever, psi1), [-0.7, 0.0]),
                piston,
                &[(at.lever, found.lever_on_piston1)],
            )
            .guided(at.lever, normal1, found.s1_moment)
            .loaded(at.lever, thrust1),
            Member::new(
                "barrel 2",
                (frame!(state, foot2, psi2), [0.7, 0.0]),
                barrel,
                &[(at.foot2, found.foot2_on_barrel2)],
            )
            .guided(at.knee, -normal2, -found.s2_moment)
            .loaded(at.foot2, -thrust2),
            Member::new(
                "piston 2",
                (frame!(state, knee, psi2), [-0.6, 0.0]),
                piston,
                &[(at.knee, found.knee_on_piston2)],
            )
            .guided(at.knee, normal2, found.s2_moment)
            .loaded(at.knee, thrust2),
        ];
        let zero = Vector2::zeros();
        let pins = [
            (vec![found.origin_on_ground, found.origin_on_beam], zero, zero),
            (vec![found.foot1_on_beam, found.foot1_on_barrel1], zero, of.foot1),
            (vec![found.lever_on_piston1, found.lever_on_dipper], zero, of.lever),
            (vec![found.joint_on_beam, found.joint_on_dipper], pull, of.joint),
            (vec![found.foot2_on_dipper, found.foot2_on_barrel2], zero, of.foot2),
            (vec![found.pivot_on_dipper, found.pivot_on_rocker], zero, of.pivot),
            (vec![found.knee_on_piston2, found.knee_on_rocker, found.knee_on_kappa], zero, of.knee),
            (vec![found.hinge_on_dipper, found.hinge_on_shovel], zero, of.hinge),
            (vec![found.ear_on_kappa, found.ear_on_shovel], zero, of.ear),
        ];
        obey(&format!("state {number}"), (scene.g, m.ls), &members, &pins);
    }
}
