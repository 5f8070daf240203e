//! A block on a belt whose speed swings, held by a spring and a damper, between two walls.

use crate::event_loop::compare::{Family, Observed, number, restitution, states};
use crate::event_loop::oracle::{Law, Model, Rows, Scales, Start, Vector, row, rows};
use linkage::MotionError;
use linkage::linkage;
use linkage::simulation::{self, simulate};
use rand::Rng;
use rand::rngs::SmallRng;

linkage! {
    /// A block with friction on a belt.
    #[derive(Debug, Clone)]
    mechanism Belt {
        param m = 1, k = 50, c = 0, hold = 3, speed = 0.5, sway = 0, w = 5, left = -1, right = 1, e = 0.5;
        input x, z;
        body block { mass m; center (x, 0); }
        scene Carried {
            inertia;
            spring k on x;
            damper c on x;
            drive z = speed * t + sway * sin(w * t);
            friction hold, 1 on x - z;
            stop x in left..right, restitution e;
        }
    }
}

/// A scene, its start and its end; the oracle's coordinate is the place on the belt.
#[derive(Debug, Clone)]
pub struct Block {
    scene: Carried,
    t: f64,
    x: f64,
    slip: f64,
    end: f64,
}

impl Block {
    /// The belt's place, rate and acceleration.
    fn belt(&self, t: f64) -> [f64; 3] {
        let Carried { speed, sway, w, .. } = self.scene;
        let (sin, cos) = (w * t).sin_cos();
        [speed * t + sway * sin, speed + sway * w * cos, -sway * w * w * sin]
    }
}

impl Family for Block {
    const NAME: &'static str = "belt";
    type Model = Self;

    fn random(random: &mut SmallRng, round: bool) -> Self {
        let mut number = |low, high| number(random, round, [low, high]);
        let (m, k, c, hold) = (number(0.2, 3.0), number(5.0, 200.0), number(-1.0, 2.0), number(0.1, 10.0));
        let (speed, sway, w) = (number(-1.0, 1.0), number(-0.1, 0.1), number(1.0, 15.0));
        let (left, right, x) = (number(-0.5, -0.1), number(0.1, 0.5), number(-0.5, 0.5));
        let (t, slip, span) = (number(-1.0, 3.0), number(-2.0, 2.0), number(0.5, 4.0));
        let e = restitution(random, round);
        let sticks = random.random_bool(0.3);
        let sway = if random.random_bool(0.4) { 0.0 } else { sway };
        let scene = Carried { m, k, c: c.max(0.0), hold, speed, sway, w, left, right, e, ..Carried::default() };
        Self { scene, t, x: x.clamp(left, right), slip: if sticks { 0.0 } else { slip }, end: t + span }
    }

    fn model(&self) -> Self {
        self.clone()
    }

    fn start(&self) -> Start {
        let [z, ..] = self.belt(self.t);
        Start { t: self.t, x: [self.x - z, 0.0, 0.0, 0.0], v: [self.slip, 0.0, 0.0, 0.0] }
    }

    fn end(&self) -> f64 {
        self.end
    }

    fn angles() -> Vec<bool> {
        vec![false; 2]
    }

    fn simulate(&self, times: &[f64], tolerance: f64) -> Result<Vec<Observed>, MotionError> {
        let [z, rate, _] = self.belt(self.t);
        let q = BeltCoordinates { x: self.x, z };
        let input_rates = BeltInputs { x: rate + self.slip, z: rate };
        let start = simulation::Start { t: self.t, q, input_rates };
        states(
            || simulate(&self.scene, start, self.end, tolerance),
            times,
            |state| (vec![state.q.x, state.q.z], vec![state.rates.x, state.rates.z]),
        )
    }
}

impl Model for Block {
    const COUNT: usize = 1;

    fn mass(&self) -> [Vector; 4] {
        [[self.scene.m, 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4], [0.0; 4]]
    }

    fn forces(&self, t: f64, x: &Vector, v: &Vector) -> Vector {
        let [z, rate, acceleration] = self.belt(t);
        let Carried { m, k, c, .. } = self.scene;
        [-k * (x[0] + z) - c * (v[0] + rate) - m * acceleration, 0.0, 0.0, 0.0]
    }

    fn rows(&self, t: f64, x: &Vector, _: &Vector) -> Rows {
        let [z, rate, acceleration] = self.belt(t);
        let mut place = row(x[0] + z, &[1.0]);
        (place.drift, place.bias) = (rate, acceleration);
        rows(&[row(x[0], &[1.0]), place])
    }

    fn laws(&self) -> Vec<Law> {
        let Carried { hold, left, right, e, .. } = self.scene;
        vec![Law::Friction { limit: hold }, Law::Stop { lower: left, upper: right, restitution: e }]
    }

    fn observed(&self, t: f64, x: &Vector, v: &Vector) -> Observed {
        let [z, rate, _] = self.belt(t);
        (vec![z + x[0], z], vec![rate + v[0], rate])
    }

    fn scales(&self) -> Scales {
        let Carried { m, k, w, .. } = self.scene;
        Scales { length: 0.5, time: 0.3, step: 0.3 / w.max((k / m).sqrt()) }
    }
}
