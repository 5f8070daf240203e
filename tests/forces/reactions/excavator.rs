//! The arm of an excavator of about 20 tonnes: boom, stick and bucket, with the cylinders of stick and bucket and the
//! four-bar that turns the bucket. The dimensions are invented, of the size of such machines; metres, kilograms.

use linkage::linkage;
use linkage_oracle::newton_euler::{Along, GROUND, Guide, Inertia, Law, Link, Machine, Pin, Point, Solution};

use crate::reactions::at_rest::{Contact, Mode, settled};
use crate::reactions::{Compared, Random, STATES, compare, guide, is_regular, pins};

linkage! {
    #[derive(Debug, Clone)]
    mechanism Excavator {
        /// Boom: its length, and the foot of the cylinder of the stick.
        param lb = 5.7, xf = 2.6, yf = 1.1;
        /// Stick: its length from the boom's end, the lever of its cylinder, the foot of the cylinder of the bucket and
        /// the pivot of the rocker.
        param ls = 2.9, xl = -0.8, yl = 0.3, xc = 0.2, yc = 0.75, xr = 2.5, yr = 0.05;
        /// Rocker and link of the bucket, its arm, its tooth.
        param lr = 0.6, lk = 0.6, lh = 0.45, xt = 0.3, yt = -1.4;
        param m1 = 1_700, j1 = 5_200, m2 = 900, j2 = 800, m3 = 850, j3 = 330, mb = 120, jb = 22, mr = 70, jr = 13, m4 = 60, j4 = 2.5;
        param g = 9.81, f1 = -250_000, f2 = 220_000, dig = 60_000, torque = 300_000, c = 20_000, k = 90_000, s0 = 2.5;
        param mu = 0.1, seal = 30_000, lower = 0.5, back = 0.1;
        input boom, s1, s2;
        unknown psi1, stick, psi2, rho, kappa, bucket;

        let foot1 = (xf, yf)@boom;
        let joint = lb@boom;
        let foot2 = joint + (xc, yc)@stick;
        let pivot = joint + (xr, yr)@stick;
        loop foot1 + s1@psi1 = joint + (xl, yl)@stick;
        loop foot2 + s2@psi2 = pivot + lr@rho;
        loop pivot + lr@rho + lk@kappa = joint + ls@stick + lh@bucket;

        point Foot1 = foot1;
        point Joint = joint;
        point Lever = Joint + (xl, yl)@stick;
        point Foot2 = foot2;
        point Pivot = pivot;
        point Knee = Pivot + lr@rho;
        point Hinge = Joint + ls@stick;
        point Ear = Hinge + lh@bucket;
        point Tooth = Hinge + (xt, yt)@bucket;

        body beam { mass m1; inertia j1; center (lb/2, 0.6)@boom; angle boom; }
        body barrel1 { mass mb; inertia jb; center Foot1 + 0.8@psi1; angle psi1; }
        body piston1 { mass mr; inertia jr; center Lever - 0.7@psi1; angle psi1; }
        body dipper { mass m2; inertia j2; center Joint + (ls/3, 0.2)@stick; angle stick; }
        body barrel2 { mass mb; inertia jb; center Foot2 + 0.7@psi2; angle psi2; }
        body piston2 { mass mr; inertia jr; center Knee - 0.6@psi2; angle psi2; }
        body rocker { mass m4; inertia j4; center (Pivot + Knee) / 2; angle rho; }
        body shovel { mass m3; inertia j3; center Hinge + (0.25, -0.65)@bucket; angle bucket; }

        scene Digging {
            inertia;
            gravity (0, -g);
            torque torque on boom;
            torque f1 on s1;
            torque f2 on s2;
            damper c on s1;
            spring k, s0 between Joint and Tooth;
            force (-dig, dig / 2) at Tooth;
            reactions;
        }
        scene Rubbing {
            inertia;
            gravity (0, -g);
            torque torque on boom;
            torque f1 on s1;
            torque f2 on s2;
            friction mu, seal on s1;
            friction mu, seal on s2;
            reactions;
        }
        scene Stopped {
            inertia;
            gravity (0, -g);
            torque torque on boom;
            torque f1 on s1;
            torque f2 on s2;
            friction mu, seal on s1;
            stop s2 in lower..5, restitution back;
            reactions;
        }
        scene Driven {
            inertia;
            gravity (0, -g);
            drive boom = 0.2 * t;
            drive s1 = 0.3 * t^2;
            drive s2 = -0.2 * t;
            force (-dig, dig / 2) at Tooth;
            reactions;
        }
    }
}

fn inputs([boom, s1, s2]: [f64; 3]) -> ExcavatorInputs {
    ExcavatorInputs { boom, s1, s2 }
}

masses!($; m1, j1, m2, j2, m3, j3, mb, jb, mr, jr, m4, j4, g);

/// The machine by its links and joints.
struct ByHand {
    machine: Machine,
    boom: Link,
    /// At the foot of the boom, Foot1, Lever, Joint, Foot2, Pivot, Knee, Hinge, Ear.
    pins: [Pin; 9],
    guides: [Guide; 2],
    /// s1 and s2.
    strokes: [Along; 2],
    tooth: Point,
}

/// A cylinder: its barrel from a foot, its piston to an eye.
struct Cylinder {
    foot: Point,
    eye: Point,
    guide: Guide,
    stroke: Along,
}

impl Cylinder {
    fn new(
        machine: &mut Machine,
        w: &Masses,
        foot: [f64; 2],
        [s, psi]: [f64; 2],
        [of_barrel, of_piston]: [f64; 2],
    ) -> Self {
        let barrel = Inertia { mass: w.mb, moment: w.jb, center: [of_barrel, 0.0] };
        let piston = Inertia { mass: w.mr, moment: w.jr, center: [-of_piston, 0.0] };
        let end = [foot[0] + s * psi.cos(), foot[1] + s * psi.sin()];
        let (barrel, piston) = (machine.link(barrel, foot, psi), machine.link(piston, end, psi));
        let [foot, eye] = [barrel, piston].map(|link| machine.point(link, [0.0; 2]));
        let line = machine.line(barrel, [0.0; 2], 0.0);
        let guide = machine.guide(&line, &eye, 0.0);
        Self { foot, eye: eye.clone(), guide, stroke: Along::Slide(line, eye) }
    }
}

impl ByHand {
    fn new(m: &Excavator, w: &Masses, q: &ExcavatorCoordinates, rates: [f64; 3]) -> Self {
        let mut machine = Machine::new([0.0, -w.g]);
        let inertia = |mass, moment, center| Inertia { mass, moment, center };
        let boom = machine.link(inertia(w.m1, w.j1, [m.lb / 2.0, 0.6]), [0.0; 2], q.boom);
        let [o, on_foot1, on_joint] = [[0.0, 0.0], [m.xf, m.yf], [m.lb, 0.0]].map(|at| machine.point(boom, at));
        let stick = machine.link(inertia(w.m2, w.j2, [m.ls / 3.0, 0.2]), machine.place(&on_joint), q.stick);
        let [joint, lever, on_foot2, on_pivot, on_hinge] =
            [[0.0, 0.0], [m.xl, m.yl], [m.xc, m.yc], [m.xr, m.yr], [m.ls, 0.0]].map(|at| machine.point(stick, at));
        let rocker = machine.link(inertia(w.m4, w.j4, [m.lr / 2.0, 0.0]), machine.place(&on_pivot), q.rho);
        let [pivot, knee] = [0.0, m.lr].map(|x| machine.point(rocker, [x, 0.0]));
        let link = machine.link(Inertia::default(), machine.place(&knee), q.kappa);
        let [start, end] = [0.0, m.lk].map(|x| machine.point(link, [x, 0.0]));
        let shovel = machine.link(inertia(w.m3, w.j3, [0.25, -0.65]), machine.place(&on_hinge), q.bucket);
        let [hinge, ear, tooth] = [[0.0, 0.0], [m.lh, 0.0], [m.xt, m.yt]].map(|at| machine.point(shovel, at));
        let feet = [&on_foot1, &on_foot2].map(|foot| machine.place(foot));
        let first = Cylinder::new(&mut machine, w, feet[0], [q.s1, q.psi1], [0.8, 0.7]);
        let second = Cylinder::new(&mut machine, w, feet[1], [q.s2, q.psi2], [0.7, 0.6]);
        let origin = machine.point(GROUND, [0.0; 2]);
        let pins = [
            machine.pin(&[origin, o]),
            machine.pin(&[on_foot1, first.foot]),
            machine.pin(&[first.eye, lever]),
            machine.pin(&[on_joint, joint]),
            machine.pin(&[on_foot2, second.foot]),
            machine.pin(&[on_pivot, pivot]),
            machine.pin(&[second.eye, knee, start]),
            machine.pin(&[on_hinge, hinge]),
            machine.pin(&[end, ear]),
        ];
        machine.input(Along::Turn([boom, GROUND]), q.boom, rates[0]);
        machine.input(first.stroke.clone(), q.s1, rates[1]);
        machine.input(second.stroke.clone(), q.s2, rates[2]);
        let (guides, strokes) = ([first.guide, second.guide], [first.stroke, second.stroke]);
        Self { machine, boom, pins, guides, strokes, tooth }
    }

    /// Adds the torque on the boom and the forces of the cylinders.
    fn driven(mut self, torque: f64, forces: [f64; 2]) -> Self {
        self.machine.load(Along::Turn([self.boom, GROUND]), Law::Force(torque));
        for (stroke, force) in self.strokes.clone().into_iter().zip(forces) {
            self.machine.load(stroke, Law::Force(force));
        }
        self
    }

    /// The forces in pins and guides; the lengths of moments are a metre.
    fn forces(&self, solution: &Solution) -> Vec<[f64; 2]> {
        let counts = [2, 2, 2, 2, 2, 2, 3, 2, 2];
        let pins = self.pins.iter().zip(counts).flat_map(|(pin, count)| (0..count).map(move |link| (pin, link)));
        let pins = pins.map(|(pin, link)| solution.pin(pin, link));
        pins.chain(self.guides.iter().map(|&slide| guide(solution.guide(slide), 1.0))).collect()
    }
}

/// The fields of the forces of a scene against those by hand.
macro_rules! compared {
    ($by_hand:ident, $found:ident, $solution:expr) => {{
        let pins = pins!($found; origin_on_ground, origin_on_beam, foot1_on_beam, foot1_on_barrel1, lever_on_piston1,
            lever_on_dipper, joint_on_beam, joint_on_dipper, foot2_on_dipper, foot2_on_barrel2, pivot_on_dipper,
            pivot_on_rocker, knee_on_piston2, knee_on_rocker, knee_on_kappa, hinge_on_dipper, hinge_on_shovel,
            ear_on_kappa, ear_on_shovel);
        let guides = [("s1", [$found.s1_normal, $found.s1_moment]), ("s2", [$found.s2_normal, $found.s2_moment])];
        let found = pins.into_iter().chain(guides);
        let compared = found.zip($by_hand.forces(&$solution));
        compared.map(|((name, found), expected)| (name, found, expected)).collect::<Vec<Compared>>()
    }};
}

/// A scene with random parameters, and a random position.
macro_rules! at_random {
    ($random:ident, $Scene:ident) => {
        loop {
            let scene = $Scene::default().map(|parameter| parameter * (0.75 + 0.25 * $random.factor()));
            if let Some(q) = position(&scene.mechanism, &$random) {
                break (scene, q);
            }
        }
    };
}

mod laws;
mod simulation;

/// A position in the range of work.
fn position(m: &Excavator, random: &Random) -> Option<ExcavatorCoordinates> {
    let [boom, s1, s2] = [(0.5, 0.4), (3.3, 0.3), (2.35, 0.2)].map(|(middle, range)| middle + random.either(range));
    let stick = boom - 1.6;
    let guess = ExcavatorCoordinates {
        boom,
        s1,
        s2,
        psi1: boom - 0.1,
        stick,
        psi2: stick,
        rho: stick + 1.4,
        kappa: stick - 0.45,
        bucket: stick + 1.0,
    };
    let q = m.solve(&guess).ok()?.coordinates;
    is_regular(m, &m.pose_at(&q)).then_some(q)
}

#[test]
fn digging() {
    let random = Random::new(31);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Digging);
        let rates = [0.4, 0.5, 0.5].map(|size| random.either(size));
        let found = scene.reactions(0.0, &q, inputs(rates)).unwrap();
        let by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rates);
        let mut by_hand = by_hand.driven(scene.torque, [scene.f1, scene.f2]);
        let joint = by_hand.machine.at(&by_hand.pins[3]);
        by_hand.machine.load(by_hand.strokes[0].clone(), Law::Damper(scene.c));
        let spring = Law::Spring { stiffness: scene.k, free: scene.s0 };
        by_hand.machine.load(Along::Distance([joint, by_hand.tooth.clone()]), spring);
        by_hand.machine.force(&by_hand.tooth, [-scene.dig, scene.dig / 2.0]);
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

#[test]
fn driven() {
    let random = Random::new(32);
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Driven);
        let t = random.either(1.0).abs();
        let rates = [0.2, 0.6 * t, -0.2];
        let found = scene.reactions(t, &q, inputs(rates)).unwrap();
        let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, rates);
        by_hand.machine.hold(Along::Turn([by_hand.boom, GROUND]), 0.0);
        by_hand.machine.hold(by_hand.strokes[0].clone(), 0.6);
        by_hand.machine.hold(by_hand.strokes[1].clone(), 0.0);
        by_hand.machine.force(&by_hand.tooth, [-scene.dig, scene.dig / 2.0]);
        compare(&format!("state {state}"), &compared!(by_hand, found, by_hand.machine.solve()));
    }
}

/// The seals of the cylinders stick or slip.
#[test]
fn with_frictions_at_rest() {
    let random = Random::new(33);
    let mut counts = [0; 3];
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Rubbing);
        let f2 = random.either(2.0 * scene.f2);
        let scene = Rubbing { mu: [1.0, 60.0, 200.0][state % 3] * scene.mu, f2, ..scene };
        let found = scene.reactions(0.0, &q, inputs([0.0; 3])).unwrap();
        let by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, [0.0; 3]);
        let by_hand = by_hand.driven(scene.torque, [scene.f1, scene.f2]);
        let friction = Contact::Friction(scene.mu * scene.seal);
        let (solution, modes) = settled(&by_hand.machine, &by_hand.strokes.clone().map(|stroke| (stroke, friction)));
        counts[modes.iter().filter(|mode| **mode == Mode::Held).count()] += 1;
        compare(&format!("state {state}: {modes:?}"), &compared!(by_hand, found, solution));
    }
    assert!(counts.iter().all(|&count| count > 3), "{counts:?}");
}

/// The cylinder of the bucket rests on its end or leaves it.
#[test]
fn with_a_stop() {
    let random = Random::new(34);
    let mut resting = 0;
    for state in 0..STATES {
        let (scene, q) = at_random!(random, Stopped);
        let f2 = random.either(2.0 * scene.f2);
        let scene = Stopped { lower: q.s2, f2, ..scene };
        let found = scene.reactions(0.0, &q, inputs([0.0; 3])).unwrap();
        let by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &q, [0.0; 3]);
        let by_hand = by_hand.driven(scene.torque, [scene.f1, scene.f2]);
        let [first, second] = by_hand.strokes.clone();
        let contacts = [(first, Contact::Friction(scene.mu * scene.seal)), (second, Contact::Lower)];
        let (solution, modes) = settled(&by_hand.machine, &contacts);
        resting += usize::from(modes[1] == Mode::Held);
        compare(&format!("state {state}: {modes:?}"), &compared!(by_hand, found, solution));
    }
    assert!((STATES / 5..STATES * 4 / 5).contains(&resting), "{resting}");
}
