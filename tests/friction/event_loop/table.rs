//! A ball between a shaken table and a ceiling that moves with it.

use crate::event_loop::compare::{Family, Observed, number, restitution, states};
use crate::event_loop::oracle::{Law, Model, Rows, Scales, Start, Vector, row, rows};
use linkage::MotionError;
use linkage::linkage;
use linkage::simulation::{self, simulate};
use rand::Rng;
use rand::rngs::SmallRng;

linkage! {
    /// A ball on a table that is driven up and down.
    #[derive(Debug, Clone)]
    mechanism Table {
        param m = 1, g = 9.81, a = 0.1, w = 10, p = 0, high = 1, e = 0.5;
        input y, z;
        body ball { mass m; center (0, y); }
        scene Shaken {
            inertia;
            gravity (0, -g);
            drive z = a * sin(w * t + p);
            stop y - z in 0..high, restitution e;
        }
    }
}

/// A scene, its start and its end; the oracle's coordinate is the height above the table.
#[derive(Debug)]
pub struct Ball {
    scene: Shaken,
    t: f64,
    height: f64,
    rate: f64,
    end: f64,
}

impl Ball {
    /// The table's height, rate and acceleration.
    fn table(&self, t: f64) -> [f64; 3] {
        let Shaken { a, w, p, .. } = self.scene;
        let (sin, cos) = (w * t + p).sin_cos();
        [a * sin, a * w * cos, -a * w * w * sin]
    }
}

impl Family for Ball {
    const NAME: &'static str = "table";
    type Model = Self;

    fn random(random: &mut SmallRng, round: bool) -> Self {
        let mut number = |low, high| number(random, round, [low, high]);
        let (m, a, w, p, high) =
            (number(0.1, 3.0), number(0.02, 0.3), number(3.0, 20.0), number(0.0, 6.0), number(0.3, 4.0));
        let (t, height, rate, span) = (number(-1.0, 3.0), number(0.0, 0.3), number(-2.0, 2.0), number(0.5, 3.0));
        let e = restitution(random, round);
        let on_table = random.random_bool(0.3);
        let (height, rate) = if on_table { (0.0, [0.0, rate][random.random_range(0..2)]) } else { (height, rate) };
        let scene = Shaken { m, g: 9.81, a, w, p, high, e, ..Shaken::default() };
        Self { scene, t, height, rate, end: t + span }
    }

    fn model(&self) -> Self {
        Self { scene: self.scene.clone(), ..*self }
    }

    fn start(&self) -> Start {
        Start { t: self.t, x: [self.height, 0.0, 0.0, 0.0], v: [self.rate, 0.0, 0.0, 0.0] }
    }

    fn end(&self) -> f64 {
        self.end
    }

    fn angles() -> Vec<bool> {
        vec![false; 2]
    }

    fn simulate(&self, times: &[f64], tolerance: f64) -> Result<Vec<Observed>, MotionError> {
        let [z, rate, _] = self.table(self.t);
        let q = TableCoordinates { y: z + self.height, z };
        let input_rates = TableInputs { y: rate + self.rate, z: rate };
        let start = simulation::Start { t: self.t, q, input_rates };
        states(
            || simulate(&self.scene, start, self.end, tolerance),
            times,
            |state| (vec![state.q.y, state.q.z], vec![state.rates.y, state.rates.z]),
        )
    }
}

impl Model for Ball {
    const COUNT: usize = 1;

    fn mass(&self) -> [Vector; 4] {
        [[self.scene.m, 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4], [0.0; 4]]
    }

    fn forces(&self, t: f64, _: &Vector, _: &Vector) -> Vector {
        [-self.scene.m * (self.scene.g + self.table(t)[2]), 0.0, 0.0, 0.0]
    }

    fn rows(&self, _: f64, x: &Vector, _: &Vector) -> Rows {
        rows(&[row(x[0], &[1.0])])
    }

    fn laws(&self) -> Vec<Law> {
        vec![Law::Stop { lower: 0.0, upper: self.scene.high, restitution: self.scene.e }]
    }

    fn observed(&self, t: f64, x: &Vector, v: &Vector) -> Observed {
        let [z, rate, _] = self.table(t);
        (vec![z + x[0], z], vec![rate + v[0], rate])
    }

    fn scales(&self) -> Scales {
        Scales { length: self.scene.high, time: 0.3, step: 0.3 / self.scene.w }
    }
}
