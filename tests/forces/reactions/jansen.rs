//! A leg of Jansen's walking machine, its triangles as rigid bodies and as three bars.

use linkage::linkage;
use linkage_oracle::newton_euler::{Along, GROUND, Inertia, Law, Link, Machine, Pin, Point, Solution};

use crate::reactions::at_rest::{Contact, Mode, settled};
use crate::reactions::{Compared, Random, STATES, compare, is_regular, pins};

linkage! {
    #[derive(Debug, Clone)]
    mechanism Jansen {
        param a = 0.38, b = 0.415, c = 0.393, d = 0.401, e = 0.558, f = 0.394, g = 0.367, h = 0.657, i = 0.49, j = 0.5,
            k = 0.619, l = 0.078, m = 0.15;
        param m1 = 3, j1 = 0.02, m2 = 2, j2 = 0.04, m3 = 2.5, j3 = 0.06, mj = 0.6, jj = 0.012, mk = 0.7, jk = 0.02;
        param gr = 9.81, torque = 30, fx = 20, fy = 150, ks = 200, ct = 3, mu = 0.3, radius = 0.01, load = 900;
        param upper = 9, back = 0.2;
        input crank;
        unknown upper_leg, push, lower_leg, link_c, link_f, link_k;

        /// The triangles b, d, e and g, i, h.
        let beta = acos((b^2 + d^2 - e^2) / (2 * b * d));
        let gamma = acos((g^2 + i^2 - h^2) / (2 * g * i));
        let pivot = (-a, -l);
        loop m@crank + j@push = pivot + b@upper_leg;
        loop m@crank + k@link_k = pivot + c@link_c;
        loop pivot + d@(upper_leg + beta) + f@link_f = pivot + c@link_c + g@lower_leg;

        point Pivot = pivot;
        point Pin = m@crank;
        point Upper = Pivot + b@upper_leg;
        point Back = Pivot + d@(upper_leg + beta);
        point Knee = Pivot + c@link_c;
        point Ankle = Knee + g@lower_leg;
        point Foot = Knee + i@(lower_leg + gamma);
        output bend = lower_leg - link_c;

        body wheel { mass m1; inertia j1; center (0.01, 0.002)@crank; angle crank; }
        body thigh { mass m2; inertia j2; center (Pivot + Upper + Back) / 3; angle upper_leg; }
        body shank { mass m3; inertia j3; center (Knee + Ankle + Foot) / 3; angle lower_leg; }
        body rod_j { mass mj; inertia jj; center (Pin + Upper) / 2; angle push; }
        body rod_k { mass mk; inertia jk; center 0.5 * (Pin + Knee); angle link_k; }

        scene Walking {
            inertia;
            gravity (0, -gr);
            torque torque on crank;
            force (fx, fy) at Foot;
            spring ks, 0.3 between Back and Knee;
            damper ct on bend;
            reactions;
        }
        scene Rubbing {
            inertia;
            gravity (0, -gr);
            torque torque on crank;
            force (fx, fy) at Foot;
            friction mu, radius, load on bend;
            reactions;
        }
        scene Stopped {
            inertia;
            gravity (0, -gr);
            torque torque on crank;
            stop bend in -9rad..upper, restitution back;
            reactions;
        }
    }
}

masses!($; m1, j1, m2, j2, m3, j3, mj, jj, mk, jk, gr);

/// The machine by its links and joints.
struct ByHand {
    machine: Machine,
    wheel: Link,
    /// The angle of the shank relative to link c.
    bend: Along,
    /// At the origin, Pivot, Pin, Upper, Back, Knee, Ankle.
    pins: [Pin; 7],
    foot: Point,
}

impl ByHand {
    fn new(m: &Jansen, w: &Masses, q: &JansenCoordinates, rate: f64) -> Self {
        let mut machine = Machine::new([0.0, -w.gr]);
        let corner = |one: f64, other: f64, opposite: f64| {
            let angle = ((one * one + other * other - opposite * opposite) / (2.0 * one * other)).acos();
            [other * angle.cos(), other * angle.sin()]
        };
        let ([xb, yb], [xf, yf]) = (corner(m.b, m.d, m.e), corner(m.g, m.i, m.h));
        let pivot = [-m.a, -m.l];
        let wheel = Inertia { mass: w.m1, moment: w.j1, center: [0.01, 0.002] };
        let wheel = machine.link(wheel, [0.0; 2], q.crank);
        let thigh = Inertia { mass: w.m2, moment: w.j2, center: [(m.b + xb) / 3.0, yb / 3.0] };
        let thigh = machine.link(thigh, pivot, q.upper_leg);
        let link_c = machine.link(Inertia::default(), pivot, q.link_c);
        let [o, pin] = [0.0, m.m].map(|x| machine.point(wheel, [x, 0.0]));
        let [hip, upper, back] = [[0.0, 0.0], [m.b, 0.0], [xb, yb]].map(|at| machine.point(thigh, at));
        let [start_c, knee] = [0.0, m.c].map(|x| machine.point(link_c, [x, 0.0]));
        let rod_j = Inertia { mass: w.mj, moment: w.jj, center: [m.j / 2.0, 0.0] };
        let rod_j = machine.link(rod_j, machine.place(&pin), q.push);
        let rod_k = Inertia { mass: w.mk, moment: w.jk, center: [m.k / 2.0, 0.0] };
        let rod_k = machine.link(rod_k, machine.place(&pin), q.link_k);
        let link_f = machine.link(Inertia::default(), machine.place(&back), q.link_f);
        let shank = Inertia { mass: w.m3, moment: w.j3, center: [(m.g + xf) / 3.0, yf / 3.0] };
        let shank = machine.link(shank, machine.place(&knee), q.lower_leg);
        let ends = |link: Link, length: f64| [0.0, length].map(|x| machine.point(link, [x, 0.0]));
        let ([pin_j, end_j], [pin_k, end_k], [start_f, end_f]) =
            (ends(rod_j, m.j), ends(rod_k, m.k), ends(link_f, m.f));
        let [on_knee, ankle, foot] = [[0.0, 0.0], [m.g, 0.0], [xf, yf]].map(|at| machine.point(shank, at));
        let [origin, base] = [[0.0; 2], pivot].map(|at| machine.point(GROUND, at));
        let pins = [
            machine.pin(&[origin, o]),
            machine.pin(&[base, hip, start_c]),
            machine.pin(&[pin, pin_j, pin_k]),
            machine.pin(&[end_j, upper]),
            machine.pin(&[back, start_f]),
            machine.pin(&[end_k, knee, on_knee]),
            machine.pin(&[end_f, ankle]),
        ];
        machine.input(Along::Turn([wheel, GROUND]), q.crank, rate);
        Self { machine, wheel, bend: Along::Turn([shank, link_c]), pins, foot }
    }

    fn driven(mut self, torque: f64, foot: [f64; 2]) -> Self {
        self.machine.load(Along::Turn([self.wheel, GROUND]), Law::Force(torque));
        self.machine.force(&self.foot, foot);
        self
    }

    fn forces(&self, solution: &Solution) -> Vec<[f64; 2]> {
        let pins = self.pins.iter().zip([2, 3, 3, 2, 2, 3, 2]);
        let sites = pins.flat_map(|(pin, count)| (0..count).map(move |link| (pin, link)));
        sites.map(|(pin, link)| solution.pin(pin, link)).collect()
    }
}

/// The fields of the forces of a scene against those by hand.
macro_rules! compared {
    ($by_hand:ident, $found:ident, $solution:expr) => {{
        let found = pins!($found; origin_on_ground, origin_on_wheel, pivot_on_ground, pivot_on_thigh, pivot_on_link_c,
            pin_on_wheel, pin_on_rod_j, pin_on_rod_k, upper_on_rod_j, upper_on_thigh, back_on_thigh, back_on_link_f,
            knee_on_rod_k, knee_on_link_c, knee_on_shank, ankle_on_link_f, ankle_on_shank);
        let compared = found.into_iter().zip($by_hand.forces(&$solution));
        compared.map(|((name, found), expected)| (name, found, expected)).collect::<Vec<Compared>>()
    }};
}

/// A scene with random parameters, and a random position.
macro_rules! at_random {
    ($random:ident, $Scene:ident) => {
        loop {
            let scene = $Scene::default().map(|parameter| parameter * (0.8 + 0.2 * $random.factor()));
            if let Some(q) = position(&scene.mechanism, &$random) {
                break (scene, q);
            }
        }
    };
}

mod laws;

/// A position that is well-conditioned.
fn position(m: &Jansen, random: &Random) -> Option<JansenCoordinates> {
    let guess = JansenCoordinates {
        crank: random.either(3.0),
        upper_leg: 1.2,
        push: 2.5,
        link_c: -1.3,
        link_k: -2.3,
        lower_leg: 2.65,
        link_f: -1.2,
    };
    let q = m.solve(&guess).ok()?.coordinates;
    is_regular(m, &m.pose_at(&q)).then_some(q)
}

#[test]
fn with_forces_springs_and_dampers() {
    let random = Random::new(41);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Walking);
        let rate = random.either(8.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rate);
        let mut by_hand = by_hand.driven(scene.torque, [scene.fx, scene.fy]);
        let ends = [4, 5].map(|pin: usize| by_hand.machine.at(&by_hand.pins[pin]));
        by_hand.machine.load(Along::Distance(ends), Law::Spring { stiffness: scene.ks, free: 0.3 });
        by_hand.machine.load(by_hand.bend.clone(), Law::Damper(scene.ct));
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

/// The friction of the knee slips.
#[test]
fn with_friction() {
    let random = Random::new(42);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Rubbing);
        let rate = random.either(8.0);
        let found = scene.reactions(0.0, &q, rate).unwrap();
        let by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rate);
        let mut by_hand = by_hand.driven(scene.torque, [scene.fx, scene.fy]);
        let rates = scene.mechanism.motion(&q, rate, 0.0).unwrap().rates;
        let limit = scene.mu * scene.radius * scene.load;
        let friction = Law::Force(-limit * (rates.lower_leg - rates.link_c).signum());
        by_hand.machine.load(by_hand.bend.clone(), friction);
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

/// The friction of the knee sticks or slips.
#[test]
fn with_friction_at_rest() {
    let random = Random::new(43);
    let mut sticking = 0;
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Rubbing);
        let scene = Rubbing { mu: [1.0, 60.0][state % 2] * scene.mu, ..scene };
        let found = scene.reactions(0.0, &q, 0.0).unwrap();
        let by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, 0.0);
        let by_hand = by_hand.driven(scene.torque, [scene.fx, scene.fy]);
        let friction = Contact::Friction(scene.mu * scene.radius * scene.load);
        let (solution, modes) = settled(&by_hand.machine, &[(by_hand.bend.clone(), friction)]);
        sticking += usize::from(modes == [Mode::Held]);
        compare(&format!("state {state}: {modes:?}"), &compared!(by_hand, found, solution));
    }
    assert!((STATES / 6..STATES * 5 / 6).contains(&sticking), "{sticking}");
}

/// The knee rests on its stop, or leaves it.
#[test]
fn with_a_stop() {
    let random = Random::new(44);
    let mut resting = 0;
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Stopped);
        let scene = Stopped { upper: q.lower_leg - q.link_c, torque: random.either(60.0), ..scene };
        let found = scene.reactions(0.0, &q, 0.0).unwrap();
        let by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, 0.0);
        let by_hand = by_hand.driven(scene.torque, [0.0; 2]);
        let (solution, modes) = settled(&by_hand.machine, &[(by_hand.bend.clone(), Contact::Upper)]);
        resting += usize::from(modes == [Mode::Held]);
        compare(&format!("state {state}: {modes:?}"), &compared!(by_hand, found, solution));
    }
    assert!((STATES / 6..STATES * 5 / 6).contains(&resting), "{resting}");
}
