//! Positions, pictures and documents of open chains, and the algorithms for any mechanism.

use std::f64::consts::TAU;

use linkage::continuation::{Direction, Path};
use linkage::drawing::{Animation, Drawing};
use linkage::extremes::over_turn;
use linkage::nalgebra::vector;
use linkage::position::newton;
use linkage::sheet::Sheet;
use linkage::skeleton::{Part, Skeleton};
use linkage::{Assembly, Dim, Document, PositionError, singularity};
use linkage_oracle::close;

use linkage_gallery::cart_pendulum::*;
use linkage_gallery::double_pendulum::*;
use linkage_gallery::pendulum::*;
use linkage_gallery::three_link_arm::*;

/// Nothing is unknown: the functions of equations have no rows, and J is regular everywhere.
#[test]
fn the_traits_meet_no_unknowns() {
    fn check<M: Assembly<Scalar = f64>>(m: &M, q: &M::Coordinates) {
        let pose = m.pose_at(q);
        assert_eq!((M::U::CAPACITY, M::G::CAPACITY, M::GROUPS.len(), M::UNKNOWNS.len()), (0, 0, 0, 0));
        assert_eq!((m.residual(&pose).iter().count(), m.jacobian_inputs(&pose).iter().count()), (0, 0));
        assert_eq!(m.determinant(&pose), 1.0);
        let report = singularity::report(m, &pose).unwrap();
        assert!(!report.is_singular() && report.rank_with_inputs() == 0 && report.drivers().count() == 0);
        assert_eq!(report.admissible().count(), M::V::CAPACITY);
        assert_eq!(singularity::sigma_min(m, &pose), Ok(1.0));
        assert_eq!(singularity::accuracy(m, &pose).unwrap().residual, 0.0);
        let found = newton(m, q).unwrap();
        assert_eq!((found.coordinates, found.iterations, found.residual), (*q, 0, 0.0));
        let again = m.assemble(M::inputs(q).into(), m.branch_of(&pose)).unwrap();
        assert!(m.same_branch(&pose, &again) && M::is_finite(&again));
    }
    check(&Pendulum::default(), &PendulumCoordinates { theta: 20.0 });
    check(&DoublePendulum::default(), &DoublePendulumCoordinates { theta1: 0.3, theta2: -1.0 });
    check(&ThreeLinkArm::default(), &ThreeLinkArmCoordinates { phi1: 0.3, phi2: -1.0, phi3: 2.0 });
    check(&CartPendulum::default(), &CartPendulumCoordinates { x: 0.3, phi: -1.0 });
    assert_eq!(DoublePendulumBranch::all().count(), 1);
    let report =
        singularity::report(&Pendulum::default(), &Pendulum::default().pose_at(&PendulumCoordinates { theta: 0.0 }));
    assert_eq!(report.unwrap().to_string(), "Pendulum is regular: det J = 1.000e0, rank 0 of 0, sigma min 1.0e0\n");
}

#[test]
fn inputs_are_the_position() {
    let arm = ThreeLinkArm::default();
    let branch = ThreeLinkArmBranch::new();
    // Angles keep their turns.
    let inputs = ThreeLinkArmInputs { phi1: 7.0, phi2: -0.4, phi3: 30.0 };
    let pose = arm.assemble(inputs, branch).unwrap();
    assert_eq!(ThreeLinkArmInputs::from(&pose.coordinates()), inputs);
    let tool = arm.points(&pose).unwrap().tool;
    let direction = |angle: f64| vector![angle.cos(), angle.sin()];
    let expected = arm.a * direction(7.0) + arm.b * direction(6.6) + arm.c * direction(36.6);
    close("tool", (tool.coords - expected).norm(), 0.0, 1e-15);

    let rates = ThreeLinkArmInputs { phi1: 1.0, phi2: 2.0, phi3: -0.5 };
    let all = arm.full_kinematics(inputs, branch, rates, rates).unwrap();
    assert_eq!(ThreeLinkArmInputs::from(&all.rates), rates);
    assert_eq!(ThreeLinkArmInputs::from(&all.accelerations), rates);
    let ratios = arm.point_ratios(&pose).unwrap().tool;
    let velocity = ratios * vector![1.0, 2.0, -0.5];
    close("velocity", (velocity - all.points.tool.velocity).norm(), 0.0, 1e-15);
    assert_eq!(arm.velocity(&pose, rates).unwrap(), all.rates);

    let bad = ThreeLinkArmInputs { phi1: f64::NAN, ..inputs };
    assert!(matches!(arm.assemble(bad, branch), Err(PositionError::NotFinite { .. })));
    assert!(matches!(arm.kinematics(inputs, branch, rates, bad), Err(PositionError::NotFinite { .. })));
}

/// A path of one input goes wherever it is sent.
#[test]
fn paths_and_extremes() {
    let pendulum = Pendulum::default();
    let mut path = Path::new(&pendulum, &PendulumCoordinates { theta: 0.0 }, Direction::Increasing).unwrap();
    for target in [3.0, 40.0, -7.5] {
        let step = path.advance_to(target).unwrap();
        assert_eq!((step.position.theta, step.event), (target, None));
        close("rate", step.rates.theta.abs(), 1.0, 0.0);
    }
    let branch = PendulumBranch::new();
    let height = over_turn(|v| Ok(pendulum.full_kinematics(v, branch, 1.0, 0.0)?.outputs.height)).unwrap();
    close("lowest", height.least.value, -0.5, 1e-15);
    close("highest", height.largest.value, 0.5, 1e-15);
}

#[test]
fn the_links_are_drawn() {
    let parts = |parts: &[Part], names: &[&str]| -> Vec<String> {
        let name = |joint: &usize| names[*joint];
        let text = |part: &Part| match part {
            Part::Ground(joint) => format!("ground {}", name(joint)),
            Part::Slider(joint) => format!("slider {}", name(joint)),
            Part::Trace(joint) => format!("trace {}", name(joint)),
            Part::Bar { joints, is_driven } => {
                let joints: Vec<&str> = joints.iter().map(name).collect();
                format!("{} {}", if *is_driven { "crank" } else { "bar" }, joints.join("-"))
            }
            part => panic!("{part:?}"),
        };
        parts.iter().map(text).collect()
    };
    assert_eq!(parts(Pendulum::<f64>::PARTS, Pendulum::<f64>::JOINTS), ["ground O", "crank O-G", "trace G"]);
    assert_eq!(
        parts(CartPendulum::<f64>::PARTS, CartPendulum::<f64>::JOINTS),
        ["bar Cart-Bob", "slider Cart", "trace Bob"]
    );
    assert_eq!(
        parts(ThreeLinkArm::<f64>::PARTS, ThreeLinkArm::<f64>::JOINTS),
        ["ground O", "crank O-Elbow", "bar Elbow-Wrist", "bar Wrist-Tool", "trace Tool"]
    );

    let pendulum = Pendulum::default();
    let turn = Animation::turn(&pendulum, PendulumBranch::new()).unwrap().to_svg().unwrap();
    assert!(turn.starts_with("<svg"));
    // Several inputs: the poses are given.
    let double = DoublePendulum::default();
    let poses: Vec<_> = (0..=24_u32)
        .map(|step| f64::from(step) * TAU / 24.0)
        .map(|angle| double.pose_at(&DoublePendulumCoordinates { theta1: angle.sin(), theta2: angle }))
        .collect();
    assert!(Animation::of(&double, &poses, 3.0).to_svg().unwrap().contains("<svg"));
    let cart = CartPendulum::default();
    let pose = cart.pose_at(&CartPendulumCoordinates { x: 0.2, phi: -1.0 });
    assert!(Drawing::of(&cart, &pose).to_svg().unwrap().contains("<svg"));
}

/// A document of an open chain has no sections about equations.
#[test]
fn documents_say_that_there_are_no_equations() {
    let sentence = "The driven coordinates determine the position, and no equation is solved.";
    let sheet = Sheet::new(DoublePendulum::DERIVATION).to_html();
    for text in [DoublePendulum::DERIVATION.to_text(), DoublePendulum::DERIVATION.to_latex(), sheet] {
        assert_eq!(text.matches(sentence).count(), 1, "{text}");
        for word in ["Constraint", "Jacobian", "Order of solution", "Unknown", "Jerk"] {
            assert!(!text.contains(word), "{word} in\n{text}");
        }
    }
    insta::with_settings!({ omit_expression => true }, {
        insta::assert_snapshot!("pendulum", Pendulum::DERIVATION.to_text());
    });
}
