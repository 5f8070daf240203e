//! Other scenes than those of `interpreted`.

use linkage_gallery::{cart_pendulum, double_pendulum, four_bar_effects, slider_crank_contacts};

use crate::algorithms::scenes::{
    BentCoordinates, BentInputs, Bouncing, CranksCoordinates, Gathering, Leaping, Named, Rubbed, same,
    same_loads_of_turns, says,
};

#[test]
fn smooth_scenes() {
    use four_bar_effects::{Driven, FourBar, FourBarCoordinates, Loaded, Smooth};
    let of = |scene| Named::of("four_bar_effects", "FourBar", scene);
    let q = FourBarCoordinates { theta2: 0.3, theta3: 1.2, theta4: -1.0 };
    let found = same(of("Smooth"), &Smooth::default(), &[], q, 12.0, [0.0, 1.0]);
    assert!(found[0] == "Smooth" && found.len() > 40, "{}", found.len());
    assert!(says(&same(of("Loaded"), &Loaded::default(), &[], q, 12.0, [0.0, 0.5]), "at: \"C\""));
    same(of("Driven"), &Driven::default(), &[], q, 15.0, [0.0, 0.5]);
    // The drive begins with another rate.
    let other = FourBarCoordinates { theta2: 0.0, ..q };
    assert!(says(&same(of("Driven"), &Driven::default(), &[], other, 12.0, [0.0, 0.5]), "theta2"));
    // Links that do not meet.
    let torn = Loaded { mechanism: FourBar { l1: 5.0, ..FourBar::default() }, ..Loaded::default() };
    assert!(says(&same(of("Loaded"), &torn, &[("l1", 5.0)], q, 12.0, [0.0, 0.5]), "FourBar"));
}

#[test]
fn open_chains() {
    use cart_pendulum::{CartPendulumCoordinates, CartPendulumInputs, Rubbing};
    let q = CartPendulumCoordinates { x: 0.0, phi: 0.5 };
    let rates = CartPendulumInputs { x: 0.9, phi: -1.0 };
    same(Named::of("cart_pendulum", "CartPendulum", "Rubbing"), &Rubbing::default(), &[], q, rates, [0.0, 1.5]);
    use double_pendulum::{DoublePendulumCoordinates, DoublePendulumInputs, Swinging};
    let q = DoublePendulumCoordinates { theta1: 0.4, theta2: 1.9 };
    let rates = DoublePendulumInputs { theta1: 1.0, theta2: -2.0 };
    same(Named::of("double_pendulum", "DoublePendulum", "Swinging"), &Swinging::default(), &[], q, rates, [0.0, 1.0]);
}

#[test]
fn frictions_in_joints() {
    use slider_crank_contacts::{Jointed, MachineCoordinates};
    let of = Named::of("slider_crank_contacts", "Machine", "Jointed");
    let q = MachineCoordinates { phi: 0.8, psi: 2.9, z: 0.4 };
    same(of, &Jointed::default(), &[], q, 2.0, [0.0, 1.0]);
}

#[test]
fn loads_of_turns() {
    same_loads_of_turns("Jointed", |mechanism| slider_crank_contacts::Jointed { mechanism, ..Default::default() });
}

#[test]
fn kinks_of_laws() {
    let of = |scene| Named::of("", "Bent", scene);
    let (q, rates) = (BentCoordinates { x: 0.0, y: 0.1 }, BentInputs { x: 1.0, y: 0.0 });
    let found = same(of("Leaping"), &Leaping::default(), &[], q, rates, [0.0, 4.0]);
    assert!(says(&found, "the drive of x in Leaping jumps"), "{found:?}");
    let q = BentCoordinates { x: 0.5, y: 0.1 };
    let found = same(of("Bouncing"), &Bouncing::default(), &[], q, rates, [0.0, 3.0]);
    assert!(says(&found, "Some(\"potential "), "{found:?}");
    let x = 0.25 * f64::sin(2.0).abs();
    let rate = |t: f64| 2.0 * t * f64::sin(1.0 / t) - f64::cos(1.0 / t);
    let (start, rates) = (BentCoordinates { x, y: 0.0 }, BentInputs { x: rate(0.5), y: 0.0 });
    let found = same(of("Gathering"), &Gathering::default(), &[], start, rates, [0.5, -0.5]);
    assert!(says(&found, "has kinks without end"), "{found:?}");
}

#[test]
fn change_points() {
    let of = Named::of("", "Cranks", "Rubbed");
    let q = CranksCoordinates { th: 0.3, ph: 0.0, ps: 0.3 };
    let found = same(of, &Rubbed::default(), &[], q, 2.0, [0.0, 2.0]);
    assert!(says(&found, "forces in joints of Rubbed are infinite or undetermined"), "{found:?}");
}
