//! A slider-crank between stops of its slider, with friction in its guide, pushed by a torque and a spring.

use crate::event_loop::compare::{Family, Observed, number, restitution, states};
use crate::event_loop::oracle::{Law, Model, Row, Rows, Scales, Start, Vector, row, rows};
use linkage::MotionError;
use linkage::linkage;
use linkage::simulation::{self, simulate};
use rand::Rng;
use rand::rngs::SmallRng;

linkage! {
    /// A crank, a rod and a slider.
    #[derive(Debug, Clone)]
    mechanism SliderCrank {
        param r = 0.3, l = 1, j2 = 0.1, m3 = 0.5, j3 = 0.05, at = 0.4, m4 = 1, g = 9.81, k = 0, free = 1;
        param turn = 0, swing = 0, w = 5, f = 0, low = 0.6, high = 2, e = 0.5;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, 0);
        body crank { inertia j2; angle phi; }
        body rod { mass m3; inertia j3; center r@phi + (at * l)@psi; angle psi; }
        body slider { mass m4; center (s, 0); }
        scene Pushed {
            inertia;
            gravity (0, -g);
            spring k, free on s;
            torque turn + swing * sin(w * t) on phi;
            friction f, 1 on s;
            stop s in low..high, restitution e;
        }
    }
}

/// A scene, its start and its end; the oracle's coordinates are the crank pin and the slider, linked by two distances.
#[derive(Debug, Clone)]
pub struct Engine {
    scene: Pushed,
    r: f64,
    l: f64,
    t: f64,
    phi: f64,
    rate: f64,
    end: f64,
}

impl Engine {
    /// psi and s at the start.
    fn position(&self) -> [f64; 2] {
        let psi = (-self.r * self.phi.sin() / self.l).asin();
        [psi, self.r * self.phi.cos() + self.l * psi.cos()]
    }
}

impl Family for Engine {
    const NAME: &'static str = "crank";
    type Model = Self;

    fn random(random: &mut SmallRng, round: bool) -> Self {
        let mut number = |low, high| number(random, round, [low, high]);
        let (r, j2, m3, j3, at, m4) = (
            number(0.15, 0.5),
            number(0.02, 0.3),
            number(0.1, 1.0),
            number(0.01, 0.1),
            number(0.0, 1.0),
            number(0.3, 2.0),
        );
        let (k, free, turn, swing, w) =
            (number(-20.0, 40.0), number(0.7, 1.3), number(-4.0, 4.0), number(-6.0, 6.0), number(1.0, 10.0));
        let (f, phi, rate) = (number(-2.0, 6.0), number(-3.0, 3.0), number(-6.0, 6.0));
        let (t, span, low, high) = (number(-1.0, 3.0), number(0.3, 2.0), number(-0.9, 0.0), number(0.0, 0.9));
        let l = 1.0;
        let e = restitution(random, round);
        let gravity = if random.random_bool(0.5) { 9.81 } else { 0.0 };
        let rate = if random.random_bool(0.2) { 0.0 } else { rate };
        let mut engine = Self { scene: Pushed::default(), r, l, t, phi, rate, end: t + span };
        let [_, s] = engine.position();
        let (low, high) = (l + r * low, l + r * high);
        // The start is between the stops, on one of them in one of five scenes.
        let on_stop = random.random_bool(0.2);
        let low = if on_stop && s < l { s } else { low.min(s - 0.1 * r) };
        let high = if on_stop && s >= l { s } else { high.max(s + 0.1 * r) };
        engine.scene = Pushed {
            mechanism: SliderCrank::new(r, l),
            at,
            j2,
            m3,
            j3,
            m4,
            g: gravity,
            k: k.max(0.0),
            free,
            turn,
            swing,
            w,
            f: f.max(0.0),
            low,
            high,
            e,
        };
        engine
    }

    fn model(&self) -> Self {
        self.clone()
    }

    fn start(&self) -> Start {
        let [psi, s] = self.position();
        let (sin, cos) = self.phi.sin_cos();
        let psi_rate = -self.r * cos * self.rate / (self.l * psi.cos());
        let slide = -self.r * sin * self.rate - self.l * psi.sin() * psi_rate;
        Start {
            t: self.t,
            x: [self.r * cos, self.r * sin, s, 0.0],
            v: [-self.r * sin * self.rate, self.r * cos * self.rate, slide, 0.0],
        }
    }

    fn end(&self) -> f64 {
        self.end
    }

    fn angles() -> Vec<bool> {
        vec![true, true, false]
    }

    fn simulate(&self, times: &[f64], tolerance: f64) -> Result<Vec<Observed>, MotionError> {
        let [psi, s] = self.position();
        let q = SliderCrankCoordinates { phi: self.phi, psi, s };
        let start = simulation::Start { t: self.t, q, input_rates: self.rate };
        states(
            || simulate(&self.scene, start, self.end, tolerance),
            times,
            |state| {
                let (q, v) = (state.q, state.rates);
                (vec![q.phi, q.psi, q.s], vec![v.phi, v.psi, v.s])
            },
        )
    }
}

/// Half the difference of the squared length of (x, y) and `length`^2, with its terms.
fn distance(length: f64, [x, y]: [f64; 2], [u, v]: [f64; 2], gradient: Vector) -> Row {
    Row { value: 0.5 * (x * x + y * y - length * length), gradient, drift: 0.0, bias: u * u + v * v }
}

impl Model for Engine {
    const COUNT: usize = 3;
    const LINKS: usize = 2;

    /// The crank as a point mass in its pin; the rod by the velocities of its ends.
    fn mass(&self) -> [Vector; 4] {
        let Pushed { at, j2, m3, j3, m4, .. } = self.scene;
        let spin = j3 / (self.l * self.l);
        let pin = j2 / (self.r * self.r) + m3 * (1.0 - at) * (1.0 - at) + spin;
        let both = m3 * at * (1.0 - at) - spin;
        [[pin, 0.0, both, 0.0], [0.0, pin, 0.0, 0.0], [both, 0.0, m4 + m3 * at * at + spin, 0.0], [0.0; 4]]
    }

    /// A torque on the crank is a force across it.
    fn forces(&self, t: f64, x: &Vector, _: &Vector) -> Vector {
        let Pushed { at, m3, g, k, free, turn, swing, w, .. } = self.scene;
        let torque = (turn + swing * (w * t).sin()) / (self.r * self.r);
        let weight = m3 * g * (1.0 - at);
        [-torque * x[1], torque * x[0] - weight, -k * (x[2] - free), 0.0]
    }

    fn rows(&self, _: f64, x: &Vector, v: &Vector) -> Rows {
        let crank = distance(self.r, [x[0], x[1]], [v[0], v[1]], [x[0], x[1], 0.0, 0.0]);
        let dx = x[2] - x[0];
        let rod = distance(self.l, [dx, x[1]], [v[2] - v[0], v[1]], [-dx, x[1], dx, 0.0]);
        let slider = row(x[2], &[0.0, 0.0, 1.0]);
        rows(&[crank, rod, slider, slider])
    }

    fn laws(&self) -> Vec<Law> {
        let Pushed { f, low, high, e, .. } = self.scene;
        vec![Law::Friction { limit: f }, Law::Stop { lower: low, upper: high, restitution: e }]
    }

    fn observed(&self, _: f64, x: &Vector, v: &Vector) -> Observed {
        let turn = |[x, y]: [f64; 2], [u, v]: [f64; 2]| (y.atan2(x), (x * v - y * u) / (x * x + y * y));
        let (phi, phi_rate) = turn([x[0], x[1]], [v[0], v[1]]);
        let (psi, psi_rate) = turn([x[2] - x[0], -x[1]], [v[2] - v[0], -v[1]]);
        (vec![phi, psi, x[2]], vec![phi_rate, psi_rate, v[2]])
    }

    fn scales(&self) -> Scales {
        Scales { length: 1.0, time: 0.3, step: 0.03 }
    }
}
