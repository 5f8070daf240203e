//! Blocks, wedges, toggles, ladders, drawers and rods of textbooks.

use super::{Equations, bearing, equations, guide, reaction, solved};
use linkage_dynamics::contact::{Contacts, ReducedBearing, ReducedContact, ReducedReaction};
use linkage_dynamics::{ContactLaw, Mode, MotionError};
use linkage_runtime::{Column, D};

/// One part in 1e12 is about four times the 1024 ulps of a held force.
const NEXT: f64 = 1e-12;

/// A block of mass 2 on a slope.
fn block(slope: f64, friction: f64) -> Equations<1, 1> {
    let (sine, cosine) = slope.sin_cos();
    let normal = guide(reaction(2.0 * 9.81 * cosine, [0.0], [0.0]));
    equations([[2.0]], [-2.0 * 9.81 * sine], [(bearing("friction", friction, [1.0], 0.0), normal)])
}

/// A wedge of mass 1 under a load of mass 3 that moves vertically, with friction on its slope: the normal force is
/// N = (W + m y'' - f sin phi) / cos phi.
fn wedge(slope: f64, friction: f64) -> Equations<1, 1> {
    let (mass, load, weight) = (1.0, 3.0, 3.0 * 9.81);
    let (sine, cosine) = slope.sin_cos();
    let tangent = slope.tan();
    let normal = guide(reaction(weight / cosine, [load * tangent / cosine], [-sine / cosine]));
    let contact = bearing("friction", friction, [1.0 / cosine], 0.0);
    equations([[mass + load * tangent * tangent]], [-weight * tangent], [(contact, normal)])
}

/// A toggle: a link at this angle to the normal of a guide presses a slider of mass 1 to it, under a load of mass 3 that
/// moves along the normal. The pins have no friction. x = l sin phi, y = l cos phi.
fn toggle(angle: f64, friction: f64) -> Equations<1, 1> {
    let (mass, load, force) = (1.0, 3.0, 50.0);
    let tangent = angle.tan();
    // y'' = -tan phi x'' at rest; N = P + m y''.
    let normal = guide(reaction(force, [-load * tangent], [0.0]));
    let contact = bearing("friction", friction, [1.0], 0.0);
    equations([[mass + load * tangent * tangent]], [force * tangent], [(contact, normal)])
}

#[test]
fn blocks_wedges_and_toggles_lock_exactly_at_the_angle_of_friction() {
    for of in [block, wedge, toggle] {
        for angle in [0.05, 0.1, 0.3, 0.5, 0.7] {
            let limit = f64::tan(angle);
            for (friction, locks) in [(limit * (1.0 + NEXT), true), (limit, true), (limit * (1.0 - NEXT), false)] {
                let equations = of(angle, friction);
                let (contacts, motion) = solved(&equations).unwrap();
                assert_eq!(contacts.modes[0] == Mode::Stick, locks, "{angle} {friction}");
                assert!(motion.are_unique);
                assert_eq!(motion.acceleration[0] == 0.0, locks, "{angle} {friction}: {motion:?}");
                // The event function tells on which side of the limit a stuck contact is.
                assert!(!locks || contacts.review(&equations).unwrap().modes_hold);
            }
        }
    }
}

/// A stuck wedge is released where its angle grows beyond the limit.
#[test]
fn the_margin_of_a_stuck_wedge_falls_through_zero_at_its_limit() {
    let (contacts, _) = solved(&wedge(0.3, 0.4)).unwrap();
    let limit = 0.3_f64.tan();
    for (friction, holds) in [(limit * (1.0 + NEXT), true), (limit, true), (limit * (1.0 - NEXT), false)] {
        let margin = contacts.events(&wedge(0.3, friction)).unwrap()[0];
        assert_eq!(margin >= 0.0, holds, "{friction}: {margin:e}");
    }
}

/// A sliding wedge: x'' by Newton's law of wedge and load, with f = -mu N.
#[test]
fn a_sliding_wedge_accelerates_by_newtons_law() {
    for (slope, friction, rate) in [(0.3, 0.1, 1.0), (0.3, 0.1, -1.0), (0.6, 0.4, -1.0), (0.6, 0.4, 1.0)] {
        let mut equations = wedge(slope, friction);
        equations.contacts[0].drift = rate;
        let (contacts, motion) = solved(&equations).unwrap();
        let (sine, cosine) = f64::sin_cos(slope);
        // M x'' = -N sin + f cos and m x'' tan = -W + N cos + f sin with f = k N.
        let k = -friction * rate;
        let (mass, load, weight, tangent) = (1.0, 3.0, 3.0 * 9.81, f64::tan(slope));
        let normal = weight / (cosine + k * sine - load * tangent / mass * (k * cosine - sine));
        let expected = normal * (k * cosine - sine) / mass;
        assert!((motion.acceleration[0] - expected).abs() < 1e-14 * expected.abs(), "{motion:?} {expected}");
        assert!((motion.forces[0] - k * normal).abs() < 1e-13 * normal, "{motion:?}");
        assert_ne!(contacts.modes[0], Mode::Stick);
    }
}

/// A homogeneous ladder at this angle to the floor: friction on floor and wall, one coordinate. N_1 = W + m y'' - f_2,
/// N_2 = m x'' - f_1.
fn ladder(tangent: f64, [floor, wall]: [f64; 2]) -> Equations<1, 2> {
    let (mass, weight, length) = (2.0, 2.0 * 9.81, 3.0);
    let cosine = (1.0 + tangent * tangent).sqrt().recip();
    let sine = tangent * cosine;
    let (foot, top) = (-length * sine, length * cosine);
    // The centre is at half of both.
    let normals = [
        guide(reaction(weight, [mass * top / 2.0], [0.0, -1.0])),
        guide(reaction(0.0, [mass * foot / 2.0], [-1.0, 0.0])),
    ];
    let contacts =
        [bearing("friction on the floor", floor, [foot], 0.0), bearing("friction on the wall", wall, [top], 0.0)];
    let inertia = mass * length * length / 3.0;
    equations([[inertia]], [-weight * top / 2.0], [(contacts[0], normals[0]), (contacts[1], normals[1])])
}

/// It slides below tan = (1 - mu_1 mu_2) / (2 mu_1).
#[test]
fn a_ladder_jams_at_the_textbook_angle() {
    for frictions in [[0.3, 0.2], [0.5, 0.5], [0.2, 0.4], [0.4, 0.0]] {
        let limit = (1.0 - frictions[0] * frictions[1]) / (2.0 * frictions[0]);
        for (tangent, locks) in [(limit * (1.0 + NEXT), true), (limit, true), (limit * (1.0 - 4.0 * NEXT), false)] {
            let (contacts, motion) = solved(&ladder(tangent, frictions)).unwrap();
            let expected = if locks { Mode::Stick } else { Mode::SlipForward };
            assert_eq!(contacts.modes[0], expected, "{frictions:?} {tangent}: {motion:?}");
            assert_eq!(motion.acceleration[0] == 0.0, locks, "{frictions:?} {tangent}");
            // Both contacts hold one coordinate.
            assert_eq!(motion.are_unique, !locks);
        }
    }
}

/// A drawer of width 2 h in guides of length l, pulled with 10 at the distance e from its middle. The friction forces on
/// both sides and the pull press it into the guides: N l = F e + h (f_1 - f_2).
fn drawer(length: f64, eccentricity: f64, friction: f64) -> Equations<1, 2> {
    let (pull, half) = (10.0, 0.3);
    let normal = |sign: f64| {
        guide(reaction(sign * pull * eccentricity / length, [0.0], [sign * half / length, -sign * half / length]))
    };
    let left = (bearing("left friction", friction, [1.0], 0.0), normal(1.0));
    let right = (bearing("right friction", friction, [1.0], 0.0), normal(-1.0));
    equations([[4.0]], [pull], [left, right])
}

/// It jams where l <= 2 mu e.
#[test]
fn a_drawer_jams_at_the_textbook_ratio() {
    for (eccentricity, friction) in [(0.5, 0.3), (1.0, 0.2), (2.0, 0.25), (0.7, 0.7)] {
        let limit = 2.0 * friction * eccentricity;
        for (length, locks) in [(limit * (1.0 - NEXT), true), (limit, true), (limit * (1.0 + 4.0 * NEXT), false)] {
            let (contacts, motion) = solved(&drawer(length, eccentricity, friction)).unwrap();
            assert_eq!(contacts.modes[0] == Mode::Stick, locks, "{eccentricity} {friction} {length}: {motion:?}");
            assert_eq!(motion.acceleration[0] == 0.0, locks, "{motion:?}");
            assert_eq!(motion.are_unique, !locks);
        }
    }
}

/// A slider-crank with journals at both ends of the crank and friction of its slider, under a torque: three contacts of
/// one motion, each reaction depends on all frictions.
fn slider_crank(torque: f64) -> Equations<1, 3> {
    let pin = |load: [f64; 2], by: [f64; 3]| {
        let components = [reaction(load[0], [0.2], by), reaction(load[1], [-0.1], [by[1], -by[2], by[0]])];
        Some(ReducedBearing { components })
    };
    let contacts = [
        (bearing("friction at O", 0.002, [1.0], 0.0), pin([30.0, 12.0], [4.0, 3.0, 0.6])),
        (bearing("friction at A", 0.002, [1.25], 0.0), pin([25.0, -8.0], [9.0, -6.0, 1.0])),
        (bearing("friction on s", 0.1, [-0.08], 0.0), guide(reaction(6.0, [0.05], [2.0, -2.5, 0.25]))),
    ];
    equations([[0.02]], [torque], contacts)
}

/// It holds up to a torque either way and slips beyond; no torque is undecided.
#[test]
fn a_slider_crank_with_friction_in_its_joints_holds_or_slips() {
    let mode = |torque: f64| {
        let equations = slider_crank(torque);
        let (contacts, motion) = solved(&equations).unwrap();
        assert_eq!(motion.acceleration[0] == 0.0, contacts.modes[0] == Mode::Stick, "{torque}");
        assert_eq!(motion.are_unique, contacts.modes[0] != Mode::Stick, "{torque}");
        assert!(contacts.review(&equations).unwrap().modes_hold, "{torque}");
        // The margin of all frictions that stick is negative where they slip.
        let stuck = Contacts::in_modes(Column::repeat(Mode::Stick));
        let margins = stuck.events(&equations).unwrap();
        assert_eq!(margins[0] >= 0.0, contacts.modes[0] == Mode::Stick, "{torque} {margins:?}");
        contacts.modes[0]
    };
    for (direction, slips) in [(1.0, Mode::SlipForward), (-1.0, Mode::SlipBackward)] {
        let [mut holds, mut moves] = [0.0, 1.0];
        for _ in 0..52 {
            let middle = 0.5 * (holds + moves);
            match mode(direction * middle) {
                Mode::Stick => holds = middle,
                found => {
                    assert_eq!(found, slips);
                    moves = middle;
                }
            }
        }
        // At the limit slip begins with s'' = 0.
        let (_, motion) = solved(&slider_crank(direction * moves)).unwrap();
        assert!(motion.acceleration[0].abs() * 0.02 <= 1e-12 * moves, "{motion:?}");
        for k in 0..100 {
            let share = f64::from(k) / 100.0;
            assert_eq!(mode(direction * share * holds), Mode::Stick);
            assert_eq!(mode(direction * moves * (1.0 + 3.0 * share)), slips);
        }
    }
}

/// Painleve's rod: its tip slides on a line, coordinates x of the tip and theta. N = W + m l (cos theta theta'' - sin
/// theta theta'^2).
fn rod(angle: f64, friction: f64, rate: f64) -> Equations<2, 1> {
    let (mass, half, weight) = (1.5, 0.8, 1.5 * 9.81);
    let inertia = mass * half * half / 3.0;
    let (sine, cosine) = angle.sin_cos();
    let coupling = -mass * half * sine;
    let columns = [[mass, coupling], [coupling, inertia + mass * half * half]];
    let normal = guide(reaction(weight, [0.0, mass * half * cosine], [0.0]));
    equations(columns, [0.0, -weight * half * cosine], [(bearing("friction", friction, [1.0, 0.0], rate), normal)])
}

/// At tan theta = 2 the paradox begins at mu = 4/3: sliding one way no acceleration is possible, the other way two are.
#[test]
fn painleves_rod_has_no_acceleration_or_two() {
    let angle = f64::atan(2.0);
    for rate in [1.0, -1.0] {
        let (_, motion) = solved(&rod(angle, 4.0 / 3.0 - 1e-9, rate)).unwrap();
        assert!(motion.acceleration.is_finite());
    }
    for friction in [4.0 / 3.0 + 1e-9, 1.5, 2.0, 10.0] {
        let none = solved(&rod(angle, friction, -1.0)).unwrap_err();
        assert_eq!(none, MotionError::NoMotion { scene: "Scene", contact: "friction", t: None });
        let several = solved(&rod(angle, friction, 1.0)).unwrap_err();
        assert_eq!(several, MotionError::SeveralMotions { scene: "Scene", contact: "friction", t: None });
    }
    // Away from this angle it begins later: 3 mu sin cos = 1 + 3 cos^2.
    for angle in [0.4_f64, 0.8, 1.3] {
        let (sine, cosine) = angle.sin_cos();
        let limit = (1.0 + 3.0 * cosine * cosine) / (3.0 * sine * cosine);
        assert!(solved(&rod(angle, limit * (1.0 - 1e-9), -1.0)).is_ok());
        assert!(solved(&rod(angle, limit * (1.0 + 1e-9), -1.0)).is_err());
    }
}

/// A pin that carries nothing slips freely.
#[test]
fn a_pin_without_load_slips_with_force_zero() {
    let unloaded = |gain: f64| {
        let components = [reaction(0.0, [0.0], [gain]), ReducedReaction::zero((D, D))];
        Some(ReducedBearing { components })
    };
    for gain in [0.0, 0.5, 3.0] {
        for (rate, force) in [(1.0, 5.0), (-1.0, 5.0), (0.0, 5.0), (0.0, 0.0)] {
            let state = equations([[2.0]], [force], [(bearing("friction", 0.5, [1.0], rate), unloaded(gain))]);
            let motion = match solved(&state) {
                Ok((_, motion)) => motion,
                // With c |P| > 1 the friction itself may load the pin enough to hold.
                Err(error) => {
                    let found = MotionError::SeveralMotions { scene: "Scene", contact: "friction", t: None };
                    assert_eq!((error, gain, rate), (found, 3.0, 0.0));
                    continue;
                }
            };
            assert_eq!((motion.forces[0].abs(), motion.acceleration[0]), (0.0, force / 2.0), "{gain} {rate}");
        }
    }
}

/// A pin that only its own friction loads, with a friction of exactly the force that loads it so: any friction satisfies
/// the law, and none is chosen.
#[test]
fn a_pin_that_any_friction_loads_enough_is_undecided() {
    let components = [reaction(0.0, [0.0], [2.0]), ReducedReaction::zero((D, D))];
    for rate in [1.0, -1.0] {
        let pin = (bearing("friction", 0.5, [1.0], rate), Some(ReducedBearing { components }));
        let found = solved(&equations([[2.0]], [5.0], [pin])).unwrap_err();
        assert_eq!(found, MotionError::UndecidedMotion { scene: "Scene", contact: "friction", t: None });
    }
}

/// In another unit of force, 2^k times as large, the same slider-crank holds with the same digits.
#[test]
fn a_slider_crank_holds_in_every_unit() {
    for torque in [0.0, 0.01, -0.02, 0.05, -0.1, 0.2] {
        let (contacts, motion) = solved(&slider_crank(torque)).unwrap();
        for unit in [-60, -20, 20, 60].map(|k| 2.0_f64.powi(k)) {
            let mut scaled = slider_crank(torque * unit);
            scaled.mass = scaled.mass * unit;
            for component in scaled.bearings.iter_mut().flatten().flat_map(|bearing| &mut bearing.components) {
                component.constant *= unit;
                component.accelerations *= unit;
            }
            let (same, other) = solved(&scaled).unwrap();
            assert_eq!(same.modes, contacts.modes, "{torque} {unit:e}");
            assert_eq!(other.acceleration, motion.acceleration, "{torque} {unit:e}");
            assert_eq!(other.forces, motion.forces * unit, "{torque} {unit:e}");
        }
    }
}

/// A slide that two given frictions hold: how they share its load is not known. A pad that is driven along it is pressed
/// to it by one of these frictions, so that its friction is not known either.
fn slide_with_pad(pad: [f64; 2]) -> (Equations<2, 3>, Contacts<f64, D<3>>) {
    let held = |name| {
        let law = ContactLaw::Friction { limit: 2.0 };
        ReducedContact { law, ..bearing(name, 0.0, [1.0, 0.0], 0.0) }
    };
    let pressed = guide(reaction(4.0, [0.0, 0.0], [1.0, 0.0, 0.0]));
    let contacts =
        [(held("front friction"), None), (held("rear friction"), None), (bearing("pad", 0.25, pad, 1.0), pressed)];
    let modes = [Mode::Stick, Mode::Stick, Mode::SlipForward];
    (equations([[1.0, 0.0], [0.0, 2.0]], [1.0, 0.0], contacts), Contacts::in_modes(modes.into()))
}

/// The slide stays if the pad moves no other body, and forces that fit are returned.
#[test]
fn forces_that_are_not_known_hold_what_they_do_not_move() {
    let (equations, contacts) = slide_with_pad([0.0, 0.0]);
    let motion = contacts.motion(&equations).unwrap();
    assert_eq!(motion.acceleration, Column::zeros());
    assert!(!motion.are_unique);
    let [front, rear, pad] = <[f64; 3]>::from(motion.forces);
    assert!((front + rear + 1.0).abs() <= 1e-15 && front.abs() <= 2.0 && rear.abs() <= 2.0, "{motion:?}");
    assert!((pad + 0.25 * (4.0 + front)).abs() <= 1e-15, "{motion:?}");
    assert!(contacts.review(&equations).unwrap().modes_hold);
    assert_eq!(solved(&equations).unwrap().1.acceleration, Column::zeros());
}

/// If the friction of the pad moves a body, the motion of that is not known.
#[test]
fn forces_that_are_not_known_decide_no_motion() {
    let (equations, contacts) = slide_with_pad([0.0, 1.0]);
    let undecided = MotionError::UndecidedMotion { scene: "Scene", contact: "pad", t: None };
    assert_eq!(contacts.motion(&equations).unwrap_err(), undecided);
}
