//! A parallelogram with a third crank: the forces in its joints are not determined. Those shown are the forces without
//! the `implied` loop, and the docs of their fields say so.

use linkage::linkage;

use crate::reactions::{Random, compare};

macro_rules! parallelogram {
    ($Mechanism:ident, $Scene:ident, $($third:tt)*) => {
        linkage! {
            #[derive(Debug, Clone)]
            mechanism $Mechanism {
                param a = 0.3, b = 0.8, middle = 0.5, m = 2, j = 0.2, g = 9.81, torque = 4;
                input theta;
                unknown phi, psi;
                loop a@theta + b@phi = (b, 0) + a@psi;
                $($third)*
                point A = a@theta;
                point B = A + b@phi;
                point Middle = (middle, 0);
                body coupler { mass m; inertia j; center A + (b/3)@phi; angle phi; }
                scene $Scene { inertia; gravity (0, -g); torque torque on theta; reactions; }
            }
        }
    };
}

parallelogram!(TwoCranks, OnTwo,);
parallelogram!(ThreeCranks, OnThree, implied loop a@theta + middle@phi = (middle, 0) + a@psi;);

/// The forces of a scene that does not look at the third crank.
macro_rules! forces {
    ($Scene:ident, $Coordinates:ident, $theta:expr, $rate:expr) => {{
        let found =
            $Scene::default().reactions(0.0, &$Coordinates { theta: $theta, phi: 0.0, psi: $theta }, $rate).unwrap();
        crate::reactions::pins!(found; origin_on_ground, origin_on_theta, a_on_theta, a_on_coupler, b_on_coupler, b_on_psi)
    }};
}

#[test]
fn forces_are_those_without_the_third_crank() {
    let random = Random::new(61);
    for state in 0..50 {
        let (theta, rate) = (1.5 + random.either(0.8), random.either(5.0));
        let two = forces!(OnTwo, TwoCranksCoordinates, theta, rate);
        let three = forces!(OnThree, ThreeCranksCoordinates, theta, rate);
        let both = two.into_iter().zip(three).map(|((name, two), (_, three))| (name, three, two));
        compare(&format!("state {state}"), &both.collect::<Vec<_>>());
    }
}

/// The docs of the fields of a scene of two linkages in a row: a force in the parallelogram is not determined, one in the
/// four-bar before it is.
#[test]
fn docs_say_what_is_not_determined() {
    let tokens = r"mechanism Train {
        param a, b, c, d, e, m, j;
        input theta;
        unknown beta, gamma, phi, psi;
        loop a@theta + b@beta = (d, 0) + c@gamma;
        loop (d, 0) + a@gamma + e@phi = (d + e, 0) + a@psi;
        implied loop (d, 0) + a@gamma + c@phi = (d + c, 0) + a@psi;
        point A = a@theta;
        point P = (d, 0) + a@gamma;
        body rod { mass m; inertia j; center A + (b/2)@beta; angle beta; }
        scene Driven { inertia; reaction at A; reaction at P; }
    }";
    let emitted = linkage_compiler::expand(tokens.parse().unwrap(), &"::linkage".parse().unwrap()).to_string();
    let doc_of = |field: &str| emitted.split(&format!("pub {field} :")).next().unwrap().rsplit("doc").next().unwrap();
    for (field, is_determined) in [("a_on_theta", true), ("a_on_rod", true), ("p_on_gamma", false), ("p_on_phi", false)]
    {
        assert_eq!(doc_of(field).contains("It is not determined"), !is_determined, "{field}: {}", doc_of(field));
    }
}
