//! A five-bar with two inputs: a mass at its tool's pin, a link without mass, a centre between two pins that is written
//! across the loop.

use linkage::linkage;
use linkage_oracle::newton_euler::{Along, GROUND, Inertia, Law, Link, Machine, Pin, Solution};

use crate::reactions::at_rest::{Contact, Mode, settled};
use crate::reactions::{Compared, Random, STATES, compare};

linkage! {
    #[derive(Debug, Clone)]
    mechanism FiveBar {
        param a = 0.3, b = 0.5, c = 0.45, d = 0.25, e = 0.4;
        param m1 = 1, j1 = 0.02, m2 = 1.4, j2 = 0.05, a2 = 0.2, b2 = 0.03, m3 = 1.1, j3 = 0.03, m5 = 2;
        param g = 9.81, k = 300, s0 = 0.2, ct = 0.4, torque = 9, f = 25, mu = 0.15, radius = 0.02, load = 400;
        param lower = -9, back = 0.2;
        input theta1, theta4;
        unknown theta2, theta3;
        loop a@theta1 + b@theta2 = (e, 0) + d@theta4 + c@theta3;
        point A = a@theta1;
        point D = (e, 0);
        point C = D + d@theta4;
        point P = A + b@theta2;
        output opening = theta2 - theta3;
        body left { mass m1; inertia j1; center (a/2)@theta1; angle theta1; }
        body arm { mass m2; inertia j2; center A + (a2, b2)@theta2; angle theta2; }
        body forearm { mass m3; inertia j3; center 0.5 * (C + P); angle theta3; }
        body tool { mass m5; center P; }

        scene Free {
            inertia;
            gravity (0, -g);
            spring k, s0 between A and C;
            damper ct on opening;
            torque torque on theta1;
            torque -torque / 2 on theta4;
            force (f, -2 * f) at P;
            reactions;
        }
        scene Half {
            inertia;
            gravity (0, -g);
            drive theta4 = 3 * t + t^2;
            torque torque on theta1;
            friction mu, radius, load on opening;
            reactions;
        }
        scene Rubbing {
            inertia;
            gravity (0, -g);
            torque torque on theta1;
            friction mu, radius, load on opening;
            friction mu, radius, load on theta4 - theta3;
            reactions;
        }
        scene Stopped {
            inertia;
            gravity (0, -g);
            torque torque on theta1;
            stop opening in lower..9rad, restitution back;
            reactions;
        }
    }
}

fn inputs([theta1, theta4]: [f64; 2]) -> FiveBarInputs {
    FiveBarInputs { theta1, theta4 }
}

masses!($; m1, j1, m2, j2, a2, b2, m3, j3, m5, g);

/// The machine by its links and joints.
struct ByHand {
    machine: Machine,
    /// Left crank, arm, forearm, right crank.
    links: [Link; 4],
    /// At the origin, A, P, C, D.
    pins: [Pin; 5],
}

impl ByHand {
    fn new(m: &FiveBar, w: &Masses, q: &FiveBarCoordinates, rates: [f64; 2]) -> Self {
        let mut machine = Machine::new([0.0, -w.g]);
        let inertia = |mass, moment, center| Inertia { mass, moment, center };
        let left = machine.link(inertia(w.m1, w.j1, [m.a / 2.0, 0.0]), [0.0; 2], q.theta1);
        let [o, a] = [0.0, m.a].map(|x| machine.point(left, [x, 0.0]));
        let arm = machine.link(inertia(w.m2, w.j2, [w.a2, w.b2]), machine.place(&a), q.theta2);
        let right = machine.link(Inertia::default(), [m.e, 0.0], q.theta4);
        let [d, c] = [0.0, m.d].map(|x| machine.point(right, [x, 0.0]));
        let forearm = machine.link(inertia(w.m3, w.j3, [m.c / 2.0, 0.0]), machine.place(&c), q.theta3);
        let [start_of_arm, end_of_arm] = [0.0, m.b].map(|x| machine.point(arm, [x, 0.0]));
        let [start_of_forearm, end_of_forearm] = [0.0, m.c].map(|x| machine.point(forearm, [x, 0.0]));
        let [origin, base] = [0.0, m.e].map(|x| machine.point(GROUND, [x, 0.0]));
        let pins = [
            machine.pin(&[origin, o]),
            machine.pin(&[a, start_of_arm]),
            machine.pin_with_mass(w.m5, &[end_of_arm, end_of_forearm]),
            machine.pin(&[start_of_forearm, c]),
            machine.pin(&[base, d]),
        ];
        machine.input(Along::Turn([left, GROUND]), q.theta1, rates[0]);
        machine.input(Along::Turn([right, GROUND]), q.theta4, rates[1]);
        Self { machine, links: [left, arm, forearm, right], pins }
    }

    fn torque(&mut self, link: usize, torque: f64) {
        self.machine.load(Along::Turn([self.links[link], GROUND]), Law::Force(torque));
    }

    /// The angle of the arm relative to the forearm.
    fn opening(&self) -> Along {
        Along::Turn([self.links[1], self.links[2]])
    }

    /// The forces in the pins.
    fn forces(&self, solution: &Solution) -> [[f64; 2]; 10] {
        std::array::from_fn(|place| solution.pin(&self.pins[place / 2], place % 2))
    }
}

/// The fields of the forces of a scene against those by hand.
macro_rules! compared {
    ($found:ident, $expected:expr) => {{
        let names = [
            "O on ground",
            "O on left",
            "A on left",
            "A on arm",
            "P on arm",
            "P on forearm",
            "C on forearm",
            "C on right",
            "D on ground",
            "D on right",
        ];
        let found = [
            $found.origin_on_ground,
            $found.origin_on_left,
            $found.a_on_left,
            $found.a_on_arm,
            $found.p_on_arm,
            $found.p_on_forearm,
            $found.c_on_forearm,
            $found.c_on_theta4,
            $found.d_on_ground,
            $found.d_on_theta4,
        ];
        let compared = names.into_iter().zip(found).zip($expected);
        compared.map(|((name, found), expected)| (name, found.into(), expected)).collect::<Vec<Compared>>()
    }};
}

/// A scene with random parameters, and a random position.
macro_rules! at_random {
    ($random:ident, $Scene:ident) => {
        loop {
            let scene = $Scene::default().map(|parameter| parameter * $random.factor());
            let [theta1, theta4] = [2.0, 1.0].map(|middle| middle + $random.either(0.7));
            let guess = FiveBarCoordinates { theta1, theta4, theta2: 0.2, theta3: 2.0 };
            if let Ok(found) = scene.mechanism.solve(&guess) {
                break (scene, found.coordinates);
            }
        }
    };
}

fn rates_of(random: &Random) -> [f64; 2] {
    [(); 2].map(|()| random.either(5.0))
}

mod laws;

#[test]
fn with_forces_springs_and_dampers() {
    let random = Random::new(11);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Free);
        let rates = rates_of(&random);
        let found = scene.reactions(0.0, &q, inputs(rates)).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rates);
        by_hand.torque(0, scene.torque);
        by_hand.torque(3, -scene.torque / 2.0);
        let ends = [1, 3].map(|pin: usize| by_hand.machine.at(&by_hand.pins[pin]));
        let (opening, tool) = (by_hand.opening(), by_hand.machine.at(&by_hand.pins[2]));
        by_hand.machine.load(Along::Distance(ends), Law::Spring { stiffness: scene.k, free: scene.s0 });
        by_hand.machine.load(opening, Law::Damper(scene.ct));
        by_hand.machine.force(&tool, [scene.f, -2.0 * scene.f]);
        let expected = by_hand.forces(&by_hand.machine.solve());
        let mut forces = compared!(found, expected);
        // The forces on all that the pin joins add up to the load at it.
        let on_tool = [0, 1].map(|axis| [scene.f, -2.0 * scene.f][axis] - expected[4][axis] - expected[5][axis]);
        forces.push(("P on tool", found.p_on_tool.into(), on_tool));
        compare(&format!("state {state}"), &forces);
    }
}

/// One crank is driven; the friction in the tool's pin slips.
#[test]
fn half_driven_with_friction() {
    let random = Random::new(12);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Half);
        let t = random.either(1.0).abs();
        let rates = [random.either(5.0), 3.0 + 2.0 * t];
        let found = scene.reactions(t, &q, inputs(rates)).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rates);
        by_hand.torque(0, scene.torque);
        by_hand.machine.hold(Along::Turn([by_hand.links[3], GROUND]), 2.0);
        let moving = scene.mechanism.motion(&q, inputs(rates), inputs([0.0; 2])).unwrap().rates;
        let limit = scene.mu * scene.radius * scene.load;
        let opening = by_hand.opening();
        by_hand.machine.load(opening, Law::Force(-limit * (moving.theta2 - moving.theta3).signum()));
        compare(&format!("state {state}"), &compared!(found, by_hand.forces(&by_hand.machine.solve())));
    }
}

/// Two frictions at rest: each sticks or slips.
#[test]
fn with_two_frictions_at_rest() {
    let random = Random::new(13);
    let mut counts = [0; 3];
    for state in 0..2 * STATES {
        let (scene, q) = at_random!(random, Rubbing);
        let scene = Rubbing { mu: [0.1, 5.0, 50.0][state % 3] * scene.mu, ..scene };
        let found = scene.reactions(0.0, &q, inputs([0.0; 2])).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, [0.0; 2]);
        by_hand.torque(0, scene.torque);
        let limit = Contact::Friction(scene.mu * scene.radius * scene.load);
        let frictions = [by_hand.opening(), Along::Turn([by_hand.links[3], by_hand.links[2]])];
        let (solution, modes) = settled(&by_hand.machine, &frictions.map(|along| (along, limit)));
        counts[modes.iter().filter(|mode| **mode == Mode::Held).count()] += 1;
        compare(&format!("state {state}: {modes:?}"), &compared!(found, by_hand.forces(&solution)));
    }
    assert!(counts.iter().all(|&count| count > 3), "{counts:?}");
}

/// The opening rests on its lower limit, or leaves it.
#[test]
fn with_a_stop() {
    let random = Random::new(14);
    let mut resting = 0;
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Stopped);
        let scene = Stopped { lower: q.theta2 - q.theta3, torque: random.either(150.0), ..scene };
        let found = scene.reactions(0.0, &q, inputs([0.0; 2])).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, [0.0; 2]);
        by_hand.torque(0, scene.torque);
        let (solution, modes) = settled(&by_hand.machine, &[(by_hand.opening(), Contact::Lower)]);
        resting += usize::from(modes == [Mode::Held]);
        compare(&format!("state {state}: {modes:?}"), &compared!(found, by_hand.forces(&solution)));
    }
    assert!((STATES / 5..STATES * 4 / 5).contains(&resting), "{resting}");
}
