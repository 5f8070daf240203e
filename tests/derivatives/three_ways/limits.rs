use linkage::limits::Limit;
use linkage::{Elbow, linkage};

linkage! {
    mechanism Angles {
        param a = 50, b = 30, c = 35, d = 60;
        input theta;
        unknown beta, gamma;
        derive limits;
        loop a@theta + b@beta = d@0 + c@gamma;
    }

    mechanism Mirrored {
        param a = 50, b = 30, c = 35, d = 60;
        input theta;
        unknown beta, gamma;
        derive limits;
        loop a@theta + b@(-beta) = d@0 + c@(pi - gamma);
    }

    mechanism Joints {
        param a = 50, b = 30, c = 35, d = 60;
        input theta;
        unknown x, y, beta, gamma;
        derive limits;
        loop a@theta + b@beta = (x, y);
        loop (x, y) = d@0 + c@gamma;
    }

    mechanism Distances {
        param a = 50, b = 30, c = 35, d = 60;
        input theta;
        unknown x, y;
        derive limits;
        equation norm((x, y) - a@theta) = b;
        equation (x - d)^2 + y^2 = c^2;
    }

    mechanism Mixed {
        param a = 50, b = 30, c = 35, d = 60;
        input theta;
        unknown x, y, beta;
        derive limits;
        loop a@theta + b@beta = (x, y);
        equation norm((x, y) - (d, 0)) = c;
    }

    /// A cylinder, whose stroke is a distance.
    mechanism Cylinder {
        param boom = 40, d = 60, h = 10;
        input stroke;
        unknown x, y;
        derive limits;
        equation norm((x, y)) = stroke;
        equation norm((x, y) - (d, h)) = boom;
    }
}

/// The ends of the interval about an input.
macro_rules! ends {
    ($Mechanism:ident, $branch:ident, $input:expr) => {{
        let limits = $Mechanism::default().limits($input, $branch::new(Elbow::Left)).unwrap();
        [limits.lower, limits.upper].map(|limit| match limit {
            Limit::Exact { input, .. } => input,
            other => panic!("{}: {other:?}", stringify!($Mechanism)),
        })
    }};
}

#[test]
fn limits_of_a_crank() {
    let expected = ends!(Angles, AnglesBranch, 0.5);
    let others = [
        ends!(Mirrored, MirroredBranch, 0.5),
        ends!(Joints, JointsBranch, 0.5),
        ends!(Distances, DistancesBranch, 0.5),
        ends!(Mixed, MixedBranch, 0.5),
    ];
    for found in others {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() <= 4.0 * f64::EPSILON, "{found} is not {expected}");
        }
    }
}

#[test]
fn limits_of_a_stroke() {
    let distance = 60_f64.hypot(10.0);
    let found = ends!(Cylinder, CylinderBranch, 50.0);
    for (found, expected) in found.into_iter().zip([distance - 40.0, distance + 40.0]) {
        assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected, "{found} is not {expected}");
    }
}
