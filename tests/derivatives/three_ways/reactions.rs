use linkage::linkage;

linkage! {
    mechanism Angles {
        param a = 20, b = 55, c = 45, d = 60, m = 1.5, j = 400, g = 9810;
        input theta;
        unknown beta, gamma;
        loop a@theta + b@beta = d@0 + c@gamma;
        body coupler { mass m; inertia j; center a@theta + (b/2, 4)@beta; angle beta; }
        scene OfAngles { inertia; gravity (0, -g); reactions; }
    }

    mechanism Joints {
        param a = 20, b = 55, c = 45, d = 60, m = 1.5, j = 400, g = 9810;
        input theta;
        unknown x, y, beta, gamma;
        loop a@theta + b@beta = (x, y);
        loop (x, y) = d@0 + c@gamma;
        body coupler { mass m; inertia j; center a@theta + (b/2, 4)@beta; angle beta; }
        scene OfJoints { inertia; gravity (0, -g); reactions; }
    }

    mechanism Mixed {
        param a = 20, b = 55, c = 45, d = 60, m = 1.5, j = 400, g = 9810;
        input theta;
        unknown x, y, beta;
        loop a@theta + b@beta = (x, y);
        equation norm((x, y) - (d, 0)) = c;
        body coupler { mass m; inertia j; center a@theta + (b/2, 4)@beta; angle beta; }
        scene OfMixed { inertia; gravity (0, -g); reactions; }
    }
}

/// The force of a loop is that of its equation as written, although the coordinates of the joint are eliminated.
#[test]
fn forces_in_a_joint() {
    let (angles, joints, mixed) = (Angles::default(), Joints::default(), Mixed::default());
    for degrees in (0..360).step_by(5) {
        let theta = f64::from(degrees).to_radians();
        let branch = linkage::Elbow::Left;
        let (q, r, s) = (
            angles.assemble(theta, AnglesBranch::new(branch)).unwrap().coordinates(),
            joints.assemble(theta, JointsBranch::new(branch)).unwrap().coordinates(),
            mixed.assemble(theta, MixedBranch::new(branch)).unwrap().coordinates(),
        );
        let expected = OfAngles::default().reactions(0.0, &q, 3.0).unwrap().multipliers;
        let found = OfJoints::default().reactions(0.0, &r, 3.0).unwrap().multipliers;
        let other = OfMixed::default().reactions(0.0, &s, 3.0).unwrap().multipliers;
        for axis in [0, 1] {
            for found in [found[axis], found[2 + axis], other[axis]] {
                assert!((found - expected[axis]).abs() <= 1e-10 * expected.norm(), "{expected:?} {found}");
            }
        }
        // The massless rocker pulls with the multiplier of its distance.
        assert!((other[2].abs() - expected.norm()).abs() <= 1e-10 * expected.norm());
    }
}
