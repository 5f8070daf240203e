//! The forces in joints as a list: names, numbers, and the places of the joints in the drawing.

use linkage::skeleton::Skeleton;
use linkage::{Joint, JointForces, Scene, Slider};

linkage::linkage! {
    pub mechanism Pump {
        param r = 0.05, l = 0.2, h = 0.01, m = 0.8, j = 1e-3, load = 120;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, h);
        point A = r@phi;
        body crank { inertia j; angle phi; }
        body rod { mass m; inertia j; center A + (l / 2)@psi; angle psi; }
        body piston { mass m; center (s, h); }
        scene Pumping { inertia; force (load, 0) at (s, h); reactions; }
        scene Idle { inertia; }
        derive drawing;
    }
}

#[test]
fn every_force_has_its_name_and_its_place() {
    let scene = Pumping::default();
    let q = scene.mechanism.assemble(0.7, PumpBranch { psi_s: Slider::Far }).unwrap().coordinates();
    let forces = scene.reactions(0.0, &q, 30.0).unwrap();
    let pose = scene.mechanism.pose_at(&q);
    let crank_pin = [scene.mechanism.r * q.phi.cos(), scene.mechanism.r * q.phi.sin()];
    let piston_pin = [q.s, scene.mechanism.h];
    let expected: [(&str, &str, [f64; 2], [f64; 2]); 7] = [
        ("a_on_crank", "crank", forces.a_on_crank.into(), crank_pin),
        ("a_on_rod", "rod", forces.a_on_rod.into(), crank_pin),
        ("origin_on_ground", "ground", forces.origin_on_ground.into(), [0.0, 0.0]),
        ("origin_on_crank", "crank", forces.origin_on_crank.into(), [0.0, 0.0]),
        ("rod_piston_on_rod", "rod", forces.rod_piston_on_rod.into(), piston_pin),
        ("rod_piston_on_piston", "piston", forces.rod_piston_on_piston.into(), piston_pin),
        ("s", "piston", [forces.s_normal, forces.s_moment], piston_pin),
    ];
    let listed: Vec<_> = PumpingReactions::<f64>::JOINTS.iter().zip(forces.each()).collect();
    assert_eq!(listed.len(), expected.len(), "{listed:?}");
    for (joint, force) in listed {
        let (Joint::Pin { name, on, place, .. } | Joint::Guide { name, on, place, .. }) = *joint;
        let (_, of, wanted, at) = *expected.iter().find(|(other, ..)| *other == name).expect(name);
        assert_eq!((on, force), (of, wanted), "{name}");
        let [x, y, along_x, along_y] = scene.mechanism.force_place(&pose, place).expect(name);
        // The guide of the piston lies along x.
        assert_eq!([along_x, along_y], if name == "s" { [0.0, 1.0] } else { [1.0, 0.0] }, "{name}");
        let gap = (x - at[0]).hypot(y - at[1]);
        assert!(gap < 4.0 * f64::EPSILON * (scene.mechanism.r + scene.mechanism.l), "{name}: {gap:e}");
    }
    let at: Vec<&str> = PumpingReactions::<f64>::JOINTS
        .iter()
        .filter_map(|joint| match joint {
            Joint::Pin { at, .. } => Some(*at),
            Joint::Guide { .. } => None,
        })
        .collect();
    assert!(at.contains(&"A") && at.contains(&"the origin") && at.contains(&"the joint of rod and piston"), "{at:?}");
}

/// A scene that shows no force has an empty list.
#[test]
fn a_scene_without_reactions() {
    assert!(<<Idle as Scene>::Reactions as JointForces<f64>>::JOINTS.is_empty());
}
