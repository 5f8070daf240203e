//! Three blocks in a row between two walls: they slide with friction and strike each other.

use crate::event_loop::compare::{Family, Observed, number, restitution, states};
use crate::event_loop::oracle::{Law, Model, Rows, Scales, Start, Vector, row, rows};
use linkage::MotionError;
use linkage::linkage;
use linkage::simulation::{self, simulate};
use rand::Rng;
use rand::rngs::SmallRng;

linkage! {
    /// Blocks on an inclined plane.
    #[derive(Debug, Clone)]
    mechanism Blocks {
        param m1 = 1, m2 = 1, m3 = 1, slope = 0, push = 0, w = 5, f1 = 0, f2 = 0, f3 = 0, wide = 0.1, length = 2;
        param e = 0.5, e2 = 0.5;
        input x, u, v;
        body first { mass m1; center (x, 0); }
        body second { mass m2; center (x + u, 0); }
        body third { mass m3; center (x + u + v, 0); }
        scene Row {
            inertia;
            gravity (slope, -9.81);
            torque push * sin(w * t) on x;
            friction f1, 1 on x;
            friction f2, 1 on x + u;
            friction f3, 1 on x + u + v;
            stop x in 0..9, restitution e2;
            stop u in wide..9, restitution e;
            stop v in wide..9, restitution e;
            stop x + u + v in 0..length, restitution e2;
        }
    }
}

/// A scene, its start and its end; the oracle's coordinates are the places of the blocks.
#[derive(Debug, Clone)]
pub struct Sliders {
    scene: Row,
    t: f64,
    gaps: [f64; 3],
    v: [f64; 3],
    end: f64,
}

impl Family for Sliders {
    const NAME: &'static str = "sliders";
    type Model = Self;

    fn random(random: &mut SmallRng, round: bool) -> Self {
        let mut number = |low, high| number(random, round, [low, high]);
        let m = [(); 3].map(|()| number(0.2, 3.0));
        let f = [(); 3].map(|()| number(-1.0, 6.0).max(0.0));
        let (slope, push, w) = (number(-3.0, 3.0), number(-20.0, 20.0), number(1.0, 10.0));
        let (wide, room) = (number(0.05, 0.2), number(0.5, 2.0));
        let (t, span) = (number(-1.0, 3.0), number(0.5, 2.5));
        let places = [(); 4].map(|()| number(0.0, 1.0));
        let rates = [(); 3].map(|()| number(-2.0, 2.0));
        let equal = round && random.random_bool(0.6);
        let [m1, m2, m3] = if equal { [m[0]; 3] } else { m };
        let (e, e2) = (restitution(random, round), restitution(random, round));
        let share = places.iter().sum::<f64>().max(0.1);
        // Some neighbours touch.
        let gaps = [0, 1, 2].map(|i| if random.random_bool(0.25) { 0.0 } else { places[i] / share * room });
        let gaps = if round { gaps.map(|gap| (gap * 16.0).floor() / 16.0) } else { gaps };
        let v = rates.map(|rate| if random.random_bool(0.4) { 0.0 } else { rate });
        let [slope, push] = [slope, push].map(|load| if random.random_bool(0.4) { 0.0 } else { load });
        let [f1, f2, f3] = f;
        let length = room + 2.0 * wide;
        let scene = Row { m1, m2, m3, slope, push, w, f1, f2, f3, wide, length, e, e2, ..Row::default() };
        Self { scene, t, gaps: [gaps[0], wide + gaps[1], wide + gaps[2]], v, end: t + span }
    }

    fn model(&self) -> Self {
        self.clone()
    }

    fn start(&self) -> Start {
        let ([x, u, v], [a, b, c]) = (self.gaps, self.v);
        Start { t: self.t, x: [x, x + u, x + u + v, 0.0], v: [a, b, c, 0.0] }
    }

    fn end(&self) -> f64 {
        self.end
    }

    fn angles() -> Vec<bool> {
        vec![false; 3]
    }

    fn simulate(&self, times: &[f64], tolerance: f64) -> Result<Vec<Observed>, MotionError> {
        let ([x, u, v], rates) = (self.gaps, self.v);
        let input_rates = BlocksInputs { x: rates[0], u: rates[1] - rates[0], v: rates[2] - rates[1] };
        let start = simulation::Start { t: self.t, q: BlocksCoordinates { x, u, v }, input_rates };
        states(
            || simulate(&self.scene, start, self.end, tolerance),
            times,
            |state| {
                let (q, r) = (state.q, state.rates);
                (vec![q.x, q.u, q.v], vec![r.x, r.u, r.v])
            },
        )
    }
}

impl Model for Sliders {
    const COUNT: usize = 3;

    fn mass(&self) -> [Vector; 4] {
        let Row { m1, m2, m3, .. } = self.scene;
        [[m1, 0.0, 0.0, 0.0], [0.0, m2, 0.0, 0.0], [0.0, 0.0, m3, 0.0], [0.0; 4]]
    }

    fn forces(&self, t: f64, _: &Vector, _: &Vector) -> Vector {
        let Row { m1, m2, m3, slope, push, w, .. } = self.scene;
        [m1 * slope + push * (w * t).sin(), m2 * slope, m3 * slope, 0.0]
    }

    fn rows(&self, _: f64, x: &Vector, _: &Vector) -> Rows {
        let places = [row(x[0], &[1.0]), row(x[1], &[0.0, 1.0]), row(x[2], &[0.0, 0.0, 1.0])];
        let gaps = [row(x[1] - x[0], &[-1.0, 1.0]), row(x[2] - x[1], &[0.0, -1.0, 1.0])];
        rows(&[places[0], places[1], places[2], places[0], gaps[0], gaps[1], places[2]])
    }

    fn laws(&self) -> Vec<Law> {
        let Row { f1, f2, f3, wide, length, e, e2, .. } = self.scene;
        let friction = |limit| Law::Friction { limit };
        let stop = |lower, upper, restitution| Law::Stop { lower, upper, restitution };
        vec![
            friction(f1),
            friction(f2),
            friction(f3),
            stop(0.0, 9.0, e2),
            stop(wide, 9.0, e),
            stop(wide, 9.0, e),
            stop(0.0, length, e2),
        ]
    }

    fn observed(&self, _: f64, x: &Vector, v: &Vector) -> Observed {
        let gaps = |x: &Vector| vec![x[0], x[1] - x[0], x[2] - x[1]];
        (gaps(x), gaps(v))
    }

    fn scales(&self) -> Scales {
        Scales { length: 1.0, time: 0.5, step: 0.4 / self.scene.w }
    }
}
