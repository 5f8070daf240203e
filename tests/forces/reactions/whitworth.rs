//! Whitworth's shaper: a die block slides on a turning arm, a ram on the ground.

use linkage::linkage;
use linkage_oracle::newton_euler::{Along, GROUND, Guide, Inertia, Law, Link, Machine, Pin, Solution};

use crate::reactions::at_rest::{Contact, Mode, settled};
use crate::reactions::{Compared, Random, STATES, compare, guide};

linkage! {
    #[derive(Debug, Clone)]
    mechanism Whitworth {
        param crank = 0.05, offset = 0.03, arm = 0.06, rod = 0.2;
        param m1 = 2, j1 = 4e-3, a1 = 0.01, b1 = 0.002, m2 = 0.2, j2 = 1e-5, m3 = 0.9, j3 = 1e-3, a3 = -0.01, b3 = 0.005;
        param m4 = 0.5, j4 = 1.7e-3, m5 = 6, xr = 0.08, yr = 0.03;
        param g = 9.81, torque = 12, cut = 500, c = 40, kt = 2, mu = 0.2, normal = 300, load = 150, upper = 9, back = 0.3;
        input theta;
        unknown psi, s, phi, x;
        let pivot = (0, -offset);
        loop crank@theta = pivot + s@psi;
        loop pivot + arm@(psi + 180deg) + rod@phi = (x, -offset);
        point C = pivot;
        point Pin = crank@theta;
        point E = C + arm@(psi + 180deg);
        point Ram = (x, -offset);
        body wheel { mass m1; inertia j1; center (a1, b1)@theta; angle theta; }
        body die { mass m2; inertia j2; center Pin; angle psi; }
        body lever { mass m3; inertia j3; center C + (a3, b3)@psi; angle psi; }
        body link { mass m4; inertia j4; center E + (rod/2)@phi; angle phi; }
        body ram { mass m5; center Ram + (xr, yr); }

        scene Cutting {
            inertia;
            gravity (0, -g);
            torque torque on theta;
            force (-cut, -cut / 4) at Ram;
            damper c on s;
            spring kt, 0.2 on phi - psi;
            reactions;
        }
        scene Rubbing {
            inertia;
            gravity (0, -g);
            torque torque on theta;
            friction mu, normal on s;
            friction mu, load on x;
            reactions;
        }
        scene Stopped {
            inertia;
            gravity (0, -g);
            torque torque on theta;
            stop x in -1..upper, restitution back;
            reactions;
        }
        scene Driven {
            inertia;
            gravity (0, -g);
            drive theta = 8 * t;
            friction mu, normal on s;
            reactions;
        }
    }
}

masses!($; m1, j1, a1, b1, m2, j2, m3, j3, a3, b3, m4, j4, m5, xr, yr, g);

/// The machine by its links and joints.
struct ByHand {
    machine: Machine,
    wheel: Link,
    lever: Link,
    link: Link,
    /// At the origin, Pin, C, E, Ram.
    pins: [Pin; 5],
    guides: [Guide; 2],
    /// s and x.
    strokes: [Along; 2],
    length: f64,
}

impl ByHand {
    fn new(m: &Whitworth, w: &Masses, q: &WhitworthCoordinates, rate: f64) -> Self {
        let mut machine = Machine::new([0.0, -w.g]);
        let inertia = |mass, moment, center| Inertia { mass, moment, center };
        let wheel = machine.link(inertia(w.m1, w.j1, [w.a1, w.b1]), [0.0; 2], q.theta);
        let [o, on_wheel] = [0.0, m.crank].map(|x| machine.point(wheel, [x, 0.0]));
        let die = machine.link(inertia(w.m2, w.j2, [0.0; 2]), machine.place(&on_wheel), q.psi);
        let lever = machine.link(inertia(w.m3, w.j3, [w.a3, w.b3]), [0.0, -m.offset], q.psi);
        let [c, e] = [0.0, -m.arm].map(|x| machine.point(lever, [x, 0.0]));
        let link = machine.link(inertia(w.m4, w.j4, [m.rod / 2.0, 0.0]), machine.place(&e), q.phi);
        let [start, end] = [0.0, m.rod].map(|x| machine.point(link, [x, 0.0]));
        let ram = machine.link(inertia(w.m5, 0.0, [w.xr, w.yr]), [q.x, -m.offset], 0.0);
        let [on_die, end_of_ram] = [die, ram].map(|link| machine.point(link, [0.0; 2]));
        let [origin, base] = [[0.0, 0.0], [0.0, -m.offset]].map(|at| machine.point(GROUND, at));
        let pins = [
            machine.pin(&[origin, o]),
            machine.pin(&[on_wheel, on_die.clone()]),
            machine.pin(&[base, c]),
            machine.pin(&[e, start]),
            machine.pin(&[end, end_of_ram.clone()]),
        ];
        let lines = [machine.line(lever, [0.0; 2], 0.0), machine.line(GROUND, [0.0, -m.offset], 0.0)];
        let guides = [machine.guide(&lines[0], &on_die, 0.0), machine.guide(&lines[1], &end_of_ram, 0.0)];
        machine.input(Along::Turn([wheel, GROUND]), q.theta, rate);
        let [line, ground] = lines;
        let strokes = [Along::Slide(line, on_die), Along::Slide(ground, end_of_ram)];
        Self { machine, wheel, lever, link, pins, guides, strokes, length: m.crank }
    }

    fn torque(&mut self, torque: f64) {
        self.machine.load(Along::Turn([self.wheel, GROUND]), Law::Force(torque));
    }

    /// The forces in pins and guides.
    fn forces(&self, solution: &Solution) -> [[f64; 2]; 12] {
        std::array::from_fn(|place| match place {
            0..10 => solution.pin(&self.pins[place / 2], place % 2),
            _ => guide(solution.guide(self.guides[place - 10]), self.length),
        })
    }
}

/// The fields of the forces of a scene against those by hand.
macro_rules! compared {
    ($by_hand:ident, $found:ident, $solution:expr) => {{
        let names = [
            "O on ground",
            "O on wheel",
            "Pin on wheel",
            "Pin on die",
            "C on ground",
            "C on lever",
            "E on lever",
            "E on link",
            "Ram on link",
            "Ram on ram",
            "guide of s",
            "guide of x",
        ];
        let guides = [[$found.s_normal, $found.s_moment], [$found.x_normal, $found.x_moment]];
        let [s, x] = guides.map(|parts| guide(parts, $by_hand.length));
        let found = [
            $found.origin_on_ground.into(),
            $found.origin_on_wheel.into(),
            $found.pin_on_wheel.into(),
            $found.pin_on_die.into(),
            $found.c_on_ground.into(),
            $found.c_on_lever.into(),
            $found.e_on_lever.into(),
            $found.e_on_link.into(),
            $found.ram_on_link.into(),
            $found.ram_on_ram.into(),
            s,
            x,
        ];
        let compared = names.into_iter().zip(found).zip($by_hand.forces(&$solution));
        compared.map(|((name, found), expected)| (name, found, expected)).collect::<Vec<Compared>>()
    }};
}

/// A scene with random parameters, and a random position.
macro_rules! at_random {
    ($random:ident, $Scene:ident) => {{
        let scene = $Scene::default().map(|parameter| parameter * $random.factor());
        let q = position(&scene.mechanism, &$random);
        (scene, q)
    }};
}

mod laws;

fn position(m: &Whitworth, random: &Random) -> WhitworthCoordinates {
    let theta = random.either(3.0);
    let (x, y) = (m.crank * theta.cos(), m.crank * theta.sin() + m.offset);
    let psi = y.atan2(x);
    let guess = WhitworthCoordinates { theta, psi, s: x.hypot(y), phi: 0.0, x: m.rod - m.arm * psi.cos() };
    m.solve(&guess).unwrap().coordinates
}

#[test]
fn with_forces_springs_and_dampers() {
    let random = Random::new(21);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Cutting);
        let rate = random.either(20.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rate);
        by_hand.torque(scene.torque);
        let ram = by_hand.machine.at(&by_hand.pins[4]);
        by_hand.machine.force(&ram, [-scene.cut, -scene.cut / 4.0]);
        by_hand.machine.load(by_hand.strokes[0].clone(), Law::Damper(scene.c));
        let spring = Law::Spring { stiffness: scene.kt, free: 0.2 };
        by_hand.machine.load(Along::Turn([by_hand.link, by_hand.lever]), spring);
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

/// The die slips on the driven arm.
#[test]
fn driven_with_friction() {
    let random = Random::new(22);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Driven);
        let found = scene.reactions(0.0, &q, 8.0).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, 8.0);
        by_hand.machine.hold(Along::Turn([by_hand.wheel, GROUND]), 0.0);
        let speed = scene.mechanism.motion(&q, 8.0, 0.0).unwrap().rates.s;
        let friction = Law::Force(-speed.signum() * scene.mu * scene.normal);
        by_hand.machine.load(by_hand.strokes[0].clone(), friction);
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

/// Both frictions slip.
#[test]
fn with_two_frictions() {
    let random = Random::new(23);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Rubbing);
        let rate = random.either(20.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rate);
        by_hand.torque(scene.torque);
        let rates = scene.mechanism.motion(&q, rate, 0.0).unwrap().rates;
        let limits = [scene.mu * scene.normal, scene.mu * scene.load];
        for ((stroke, rate), limit) in by_hand.strokes.clone().into_iter().zip([rates.s, rates.x]).zip(limits) {
            by_hand.machine.load(stroke, Law::Force(-rate.signum() * limit));
        }
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

/// The ram rests on its stop, or leaves it.
#[test]
fn with_a_stop() {
    let random = Random::new(24);
    let mut resting = 0;
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Stopped);
        let scene = Stopped { upper: q.x, torque: random.either(20.0), ..scene };
        let found = scene.reactions(0.0, &q, 0.0).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, 0.0);
        by_hand.torque(scene.torque);
        let (solution, modes) = settled(&by_hand.machine, &[(by_hand.strokes[1].clone(), Contact::Upper)]);
        resting += usize::from(modes == [Mode::Held]);
        compare(&format!("state {state}: {modes:?}"), &compared!(by_hand, found, solution));
    }
    assert!((STATES / 5..STATES * 4 / 5).contains(&resting), "{resting}");
}
