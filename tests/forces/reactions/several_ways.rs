//! One linkage written in several ways: the forces in its joints are those of the first.

use linkage::linkage;

use crate::reactions::{Random, compare};

linkage! {
    /// Each loop from the origin.
    #[derive(Debug, Clone)]
    mechanism FromOrigin {
        param a = 0.2, b = 0.55, c = 0.45, d = 0.6, e = 0.5, f = 0.5, p = 0.35, q = 0.1, m = 1.5, j = 0.04, g = 9.81, t0 = 5;
        input theta;
        unknown beta, gamma, delta, epsilon;
        let pivot = a@theta + (p, q)@beta;
        loop a@theta + b@beta = (d, 0) + c@gamma;
        loop pivot + f@delta = (0, -0.3) + e@epsilon;
        point A = a@theta;
        point B = A + b@beta;
        point C = pivot;
        point D = (d, 0);
        point E = (0, -0.3);
        point F = E + e@epsilon;
        body coupler { mass m; inertia j; center A + (b/2, q)@beta; angle beta; }
        body rocker { mass 2 * m; inertia j; center (D + B) / 2; angle gamma; }
        body rod { mass m / 2; inertia j / 2; center C + (f/2)@delta; angle delta; }
        scene OfOrigin { inertia; gravity (0, -g); torque t0 on theta; damper 1 on delta - beta; reactions; }
    }

    /// A loop from the other end, angles against the sense of rotation, centres across the loop.
    #[derive(Debug, Clone)]
    mechanism Turned {
        param a = 0.2, b = 0.55, c = 0.45, d = 0.6, e = 0.5, f = 0.5, p = 0.35, q = 0.1, m = 1.5, j = 0.04, g = 9.81, t0 = 5;
        input theta;
        unknown beta, gamma, delta, epsilon;
        loop (d, 0) - c@(pi - gamma) - b@beta - a@theta = 0;
        loop (0, -0.3) - e@(epsilon + 180deg) - f@delta = a@theta + (p, q)@beta;
        point D = (d, 0);
        point B = D - c@(pi - gamma);
        point A = a@theta;
        point C = A + (p, q)@beta;
        point E = (0, -0.3);
        point F = E + e@epsilon;
        body coupler { mass m; inertia j; center 0.5 * (A + B) + (0, q)@beta; angle beta; }
        body rocker { mass 2 * m; inertia j; center D - (c/2)@(pi - gamma); angle pi - gamma; }
        body rod { mass m / 2; inertia j / 2; center (C + F) / 2; angle delta; }
        scene OfTurned { inertia; gravity (0, -g); torque t0 on theta; damper 1 on delta - beta; reactions; }
    }

    /// The coordinates of B are unknowns.
    #[derive(Debug, Clone)]
    mechanism Joints {
        param a = 0.2, b = 0.55, c = 0.45, d = 0.6, e = 0.5, f = 0.5, p = 0.35, q = 0.1, m = 1.5, j = 0.04, g = 9.81, t0 = 5;
        input theta;
        unknown x, y, beta, gamma, delta, epsilon;
        loop a@theta + b@beta = (x, y);
        loop (x, y) = (d, 0) + c@gamma;
        loop a@theta + (p, q)@beta + f@delta = (0, -0.3) + e@epsilon;
        point A = a@theta;
        point B = (x, y);
        point C = A + (p, q)@beta;
        point D = (d, 0);
        point E = (0, -0.3);
        point F = E + e@epsilon;
        body coupler { mass m; inertia j; center A + (b/2, q)@beta; angle beta; }
        body rocker { mass 2 * m; inertia j; center (D + B) / 2; angle gamma; }
        body rod { mass m / 2; inertia j / 2; center C + (f/2)@delta; angle delta; }
        scene OfJoints { inertia; gravity (0, -g); torque t0 on theta; damper 1 on delta - beta; reactions; }
    }
}

/// The forces of a scene in the state of the first mechanism, with the parameters of a seed.
macro_rules! forces {
    ($Scene:ident, $seed:expr, $guess:expr, $rate:expr) => {{
        let random = Random::new($seed);
        let scene = $Scene::default().map(|parameter| parameter * (0.9 + 0.1 * random.factor()));
        let q = scene.mechanism.solve(&$guess).unwrap().coordinates;
        let found = scene.reactions(0.0, &q, $rate).unwrap();
        (q, crate::reactions::pins!(found; origin_on_ground, origin_on_theta, a_on_theta, a_on_coupler, b_on_coupler, b_on_rocker,
            c_on_coupler, c_on_rod, d_on_ground, d_on_rocker, e_on_ground, e_on_epsilon, f_on_rod, f_on_epsilon))
    }};
}

#[test]
fn forces_do_not_depend_on_how_it_is_written() {
    let random = Random::new(51);
    for state in 0..200 {
        let (theta, rate) = (random.either(0.6) + 1.2, random.either(9.0));
        let guess = FromOriginCoordinates { theta, beta: 0.5, gamma: 1.7, delta: -1.3, epsilon: 0.6 };
        let (q, first) = forces!(OfOrigin, state, guess, rate);
        let FromOriginCoordinates { beta, gamma, delta, epsilon, .. } = q;
        let guess = TurnedCoordinates { theta, beta, gamma: -gamma, delta, epsilon };
        let (_, turned) = forces!(OfTurned, state, guess, rate);
        let m = FromOrigin::default();
        let (x, y) = (m.d + m.c * gamma.cos(), m.c * gamma.sin());
        let guess = JointsCoordinates { theta, x, y, beta, gamma, delta, epsilon };
        let (_, joints) = forces!(OfJoints, state, guess, rate);
        for other in [turned, joints] {
            let both = other.into_iter().zip(first);
            compare(
                &format!("state {state}"),
                &both.map(|((name, found), (_, first))| (name, found, first)).collect::<Vec<_>>(),
            );
        }
    }
}
