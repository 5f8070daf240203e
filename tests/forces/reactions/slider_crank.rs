//! A slider-crank with an offset, whose links have their centres off the lines of their joints.

use linkage::linkage;
use linkage_oracle::newton_euler::{Along, GROUND, Guide, Inertia, Law, Link, Machine, Pin, Point};

use crate::reactions::at_rest::{Contact, Mode, settled};
use crate::reactions::{Compared, Random, STATES, compare, guide};

linkage! {
    #[derive(Debug, Clone)]
    mechanism SliderCrank {
        param r = 0.05, l = 0.18, e = 0.01;
        param m2 = 0.8, j2 = 1.2e-3, a2 = 0.02, b2 = 0.004, m3 = 0.6, j3 = 2e-3, a3 = 0.06, b3 = -0.007, m4 = 0.9;
        param g = 9.81, p = 300, torque = 8, k = 700, s0 = 0.1, c = 30, mu = 0.2, normal = 40, upper = 0.25, back = 0.3, radius = 0.008;
        input phi;
        unknown psi, z;
        loop r@phi + l@psi = (z, e);
        point A = r@phi;
        point B = (z, e);
        point G3 = A + (a3, b3)@psi;
        body crank { mass m2; inertia j2; center (a2, b2)@phi; angle phi; }
        body rod { mass m3; inertia j3; center G3; angle psi; }
        body piston { mass m4; center B; }

        scene Turning {
            inertia;
            gravity (0, -g);
            force (-p, 2 * p) at B;
            force (p / 3, -p) at G3;
            torque torque on phi;
            spring k, s0 between A and (0.02, -0.1);
            damper c on z;
            reactions;
        }
        scene Rubbing {
            inertia;
            gravity (0, -g);
            force (-p, 0) at B;
            torque torque on phi;
            friction mu, normal on z;
            reactions;
        }
        scene Worn {
            inertia;
            gravity (0, -g);
            force (-p, 0) at B;
            torque torque on phi;
            friction mu, reaction on z;
            friction mu, radius, reaction on psi - phi;
            reactions;
        }
        scene Resting {
            inertia;
            gravity (0, -g);
            torque torque on phi;
            stop z in 0.001..upper, restitution back;
            reactions;
        }
        scene Driven {
            inertia;
            gravity (0, -g);
            drive phi = 30 * t + 40 * t^2;
            reactions;
        }
    }
}

masses!($; m2, j2, a2, b2, m3, j3, m4, g);

/// The machine by its links and joints.
struct ByHand {
    machine: Machine,
    crank: Link,
    rod: Link,
    stroke: Along,
    center_of_rod: Point,
    pins: [Pin; 3],
    slide: Guide,
    length: f64,
}

impl ByHand {
    fn new(m: &SliderCrank, w: &Masses, q: &SliderCrankCoordinates, rate: f64) -> Self {
        let mut machine = Machine::new([0.0, -w.g]);
        let crank = Inertia { mass: w.m2, moment: w.j2, center: [w.a2, w.b2] };
        let crank = machine.link(crank, [0.0; 2], q.phi);
        let a = machine.point(crank, [m.r, 0.0]);
        let rod = Inertia { mass: w.m3, moment: w.j3, center: [m.a3, m.b3] };
        let rod = machine.link(rod, machine.place(&a), q.psi);
        let piston = machine.link(Inertia { mass: w.m4, ..Inertia::default() }, [q.z, m.e], 0.0);
        let [ground, o, on_rod, b, end] = [
            machine.point(GROUND, [0.0; 2]),
            machine.point(crank, [0.0; 2]),
            machine.point(rod, [0.0; 2]),
            machine.point(rod, [m.l, 0.0]),
            machine.point(piston, [0.0; 2]),
        ];
        let pins = [machine.pin(&[ground, o]), machine.pin(&[a, on_rod]), machine.pin(&[b, end.clone()])];
        let line = machine.line(GROUND, [0.0, m.e], 0.0);
        let slide = machine.guide(&line, &end, 0.0);
        machine.input(Along::Turn([crank, GROUND]), q.phi, rate);
        let center_of_rod = machine.point(rod, [m.a3, m.b3]);
        Self { machine, crank, rod, stroke: Along::Slide(line, end), center_of_rod, pins, slide, length: m.r }
    }

    fn rubbing(scene: &Rubbing, q: &SliderCrankCoordinates, rate: f64) -> Self {
        let mut by_hand = Self::new(&scene.mechanism, &masses_of!(scene), q, rate);
        let end = by_hand.machine.at(&by_hand.pins[2]);
        by_hand.machine.force(&end, [-scene.p, 0.0]);
        by_hand.machine.load(by_hand.turn(), Law::Force(scene.torque));
        by_hand
    }

    fn turn(&self) -> Along {
        Along::Turn([self.crank, GROUND])
    }
}

/// The fields of the forces of a scene against those by hand.
macro_rules! compared {
    ($by_hand:ident, $found:ident, $solution:expr) => {{
        let (ByHand { pins: [o, a, b], slide, length, .. }, solution) = (&$by_hand, &$solution);
        let forces: Vec<Compared> = vec![
            ("O on ground", $found.origin_on_ground.into(), solution.pin(o, 0)),
            ("O on crank", $found.origin_on_crank.into(), solution.pin(o, 1)),
            ("A on crank", $found.a_on_crank.into(), solution.pin(a, 0)),
            ("A on rod", $found.a_on_rod.into(), solution.pin(a, 1)),
            ("B on rod", $found.b_on_rod.into(), solution.pin(b, 0)),
            ("B on piston", $found.b_on_piston.into(), solution.pin(b, 1)),
            ("guide", guide([$found.z_normal, $found.z_moment], *length), guide(solution.guide(*slide), *length)),
        ];
        forces
    }};
}

/// A position with random parameters.
macro_rules! at_random {
    ($random:ident, $Scene:ident) => {{
        let scene = $Scene::default().map(|parameter| parameter * $random.factor());
        let branch = SliderCrankBranch { psi_z: linkage::Slider::Far };
        let q = scene.mechanism.assemble($random.either(3.0), branch).unwrap().coordinates();
        (scene, q)
    }};
}

mod laws;
mod simulation;

#[test]
fn with_forces_springs_and_dampers() {
    let random = Random::new(1);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Turning);
        let rate = random.either(60.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rate);
        let [a, b] = [1, 2].map(|pin: usize| by_hand.machine.at(&by_hand.pins[pin]));
        let anchor = by_hand.machine.point(GROUND, [0.02, -0.1]);
        by_hand.machine.force(&b, [-scene.p, 2.0 * scene.p]);
        by_hand.machine.force(&by_hand.center_of_rod, [scene.p / 3.0, -scene.p]);
        let (turn, stroke) = (by_hand.turn(), by_hand.stroke.clone());
        let machine = &mut by_hand.machine;
        machine.load(turn, Law::Force(scene.torque));
        machine.load(Along::Distance([a, anchor]), Law::Spring { stiffness: scene.k, free: scene.s0 });
        machine.load(stroke, Law::Damper(scene.c));
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

#[test]
fn with_a_driven_crank() {
    let random = Random::new(2);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Driven);
        let t: f64 = 1.0 + random.either(1.0);
        let rate = 30.0 + 80.0 * t;
        let found = scene.reactions(t, &q, rate).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rate);
        let drive = by_hand.machine.hold(by_hand.turn(), 80.0);
        let solution = by_hand.machine.solve();
        let mut forces = compared!(by_hand, found, solution);
        let torque = scene.drive_forces(t, &q, rate).unwrap().phi;
        let length = by_hand.length;
        forces.push(("drive", [torque / length, 0.0], [solution.held(drive) / length, 0.0]));
        compare(&format!("state {state}"), &forces);
    }
}

/// A friction slips against the motion.
#[test]
fn with_friction() {
    let random = Random::new(3);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Rubbing);
        let rate = random.either(60.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let mut by_hand = ByHand::rubbing(&scene, &q, rate);
        let speed = scene.mechanism.motion(&q, rate, 0.0).unwrap().rates.z;
        let stroke = by_hand.stroke.clone();
        by_hand.machine.load(stroke, Law::Force(-speed.signum() * scene.mu * scene.normal));
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

/// A friction sticks with the force that holds it, or begins to slip.
#[test]
fn with_friction_at_rest() {
    let random = Random::new(4);
    let mut sticking = 0;
    for state in 0..2 * STATES {
        let (scene, q) = at_random!(random, Rubbing);
        let scene = Rubbing { mu: [1.0, 50.0][state % 2] * scene.mu, ..scene };
        let found = scene.reactions(0.0, &q, 0.0).unwrap();
        let by_hand = ByHand::rubbing(&scene, &q, 0.0);
        let friction = Contact::Friction(scene.mu * scene.normal);
        let (solution, modes) = settled(&by_hand.machine, &[(by_hand.stroke.clone(), friction)]);
        sticking += usize::from(modes == [Mode::Held]);
        compare(&format!("state {state}: {modes:?}"), &compared!(by_hand, found, solution));
    }
    assert!((STATES / 4..2 * STATES - STATES / 4).contains(&sticking), "{sticking}");
}

/// The piston rests on its stop, or leaves it.
#[test]
fn with_a_stop() {
    let random = Random::new(5);
    let mut resting = 0;
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Resting);
        let scene = Resting { upper: q.z, torque: random.either(30.0), ..scene };
        let found = scene.reactions(0.0, &q, 0.0).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, 0.0);
        by_hand.machine.load(by_hand.turn(), Law::Force(scene.torque));
        let (solution, modes) = settled(&by_hand.machine, &[(by_hand.stroke.clone(), Contact::Upper)]);
        resting += usize::from(modes == [Mode::Held]);
        compare(&format!("state {state}: {modes:?}"), &compared!(by_hand, found, solution));
    }
    assert!((STATES / 5..STATES * 4 / 5).contains(&resting), "{resting}");
}
