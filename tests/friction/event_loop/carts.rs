//! Three carts between springs, with frictions and buffers; the first is pushed to and fro.

use crate::event_loop::compare::{Family, Observed, number, restitution, states};
use crate::event_loop::oracle::{Law, Model, Rows, Scales, Start, Vector, row, rows};
use linkage::MotionError;
use linkage::linkage;
use linkage::simulation::{self, simulate};
use rand::Rng;
use rand::rngs::SmallRng;

linkage! {
    /// Carts on a line.
    #[derive(Debug, Clone)]
    mechanism Carts {
        param m1 = 1, m2 = 1, m3 = 1, k1 = 20, k2 = 20, k3 = 20, free = 0.3, c = 0, push = 0, w = 5;
        param f1 = 0, f2 = 0, f3 = 0, near = 0.1, far = 0.6, left = -0.5, e1 = 0.5, e2 = 0.5, e3 = 0.5;
        input x1, x2, x3;
        body first { mass m1; center (x1, 0); }
        body second { mass m2; center (x2, 0); }
        body third { mass m3; center (x3, 0); }
        scene Coupled {
            inertia;
            spring k1 on x1;
            spring k2, free on x2 - x1;
            spring k3, free on x3 - x2;
            damper c on x3 - x2;
            torque push * sin(w * t) on x1;
            friction f1, 1 on x1;
            friction f2, 1 on x2 - x1;
            friction f3, 1 on x3;
            stop x1 in left..9, restitution e1;
            stop x2 - x1 in near..far, restitution e2;
            stop x3 - x2 in near..far, restitution e3;
        }
    }
}

/// A scene, its start and its end; the oracle's coordinates are the first place and the gaps.
#[derive(Debug, Clone)]
pub struct Train {
    scene: Coupled,
    t: f64,
    x: [f64; 3],
    v: [f64; 3],
    end: f64,
}

impl Family for Train {
    const NAME: &'static str = "carts";
    type Model = Self;

    fn random(random: &mut SmallRng, round: bool) -> Self {
        let mut number = |low, high| number(random, round, [low, high]);
        let m = [(); 3].map(|()| number(0.2, 3.0));
        let k = [(); 3].map(|()| number(0.0, 100.0));
        let f = [(); 3].map(|()| number(-1.0, 5.0).max(0.0));
        let (c, push, w) = (number(-1.0, 1.0).max(0.0), number(-20.0, 20.0), number(1.0, 12.0));
        let (free, near, far, left) = (number(0.2, 0.5), number(0.0, 0.2), number(0.4, 0.8), number(-0.5, -0.05));
        let (t, span) = (number(-1.0, 3.0), number(0.5, 3.0));
        let start = [number(-0.3, 0.3).max(left), number(0.0, 0.8), number(0.0, 0.8)];
        let rates = [(); 3].map(|()| number(-1.5, 1.5));
        let equal = round && random.random_bool(0.5);
        let [m1, m2, m3] = if equal { [m[0]; 3] } else { m };
        let [e1, e2, e3] = [(); 3].map(|()| restitution(random, round));
        let [e1, e2, e3] = if equal { [e1; 3] } else { [e1, e2, e3] };
        let v = rates.map(|rate| if random.random_bool(0.4) { 0.0 } else { rate });
        let push = if random.random_bool(0.3) { 0.0 } else { push };
        let ([k1, k2, k3], [f1, f2, f3]) = (k, f);
        let scene = Coupled {
            m1,
            m2,
            m3,
            k1,
            k2,
            k3,
            free,
            c,
            push,
            w,
            f1,
            f2,
            f3,
            near,
            far,
            left,
            e1,
            e2,
            e3,
            ..Coupled::default()
        };
        let x2 = start[0] + start[1].clamp(near, far);
        let mut x3 = x2 + start[2].clamp(near, far);
        // Rounding must not put it beyond its stop.
        if x3 - x2 < near || x3 - x2 > far {
            x3 = x2 + 0.5 * (near + far);
        }
        let x2_is_within = (near..=far).contains(&(x2 - start[0]));
        let shift = if x2_is_within { 0.0 } else { start[0] + 0.5 * (near + far) - x2 };
        Self { scene, t, x: [start[0], x2 + shift, x3 + shift], v, end: t + span }
    }

    fn model(&self) -> Self {
        self.clone()
    }

    fn start(&self) -> Start {
        let ([x1, x2, x3], [v1, v2, v3]) = (self.x, self.v);
        Start { t: self.t, x: [x1, x2 - x1, x3 - x2, 0.0], v: [v1, v2 - v1, v3 - v2, 0.0] }
    }

    fn end(&self) -> f64 {
        self.end
    }

    fn angles() -> Vec<bool> {
        vec![false; 3]
    }

    fn simulate(&self, times: &[f64], tolerance: f64) -> Result<Vec<Observed>, MotionError> {
        let ([x1, x2, x3], v) = (self.x, self.v);
        let input_rates = CartsInputs { x1: v[0], x2: v[1], x3: v[2] };
        let start = simulation::Start { t: self.t, q: CartsCoordinates { x1, x2, x3 }, input_rates };
        states(
            || simulate(&self.scene, start, self.end, tolerance),
            times,
            |state| {
                let (q, v) = (state.q, state.rates);
                (vec![q.x1, q.x2, q.x3], vec![v.x1, v.x2, v.x3])
            },
        )
    }
}

impl Model for Train {
    const COUNT: usize = 3;

    fn mass(&self) -> [Vector; 4] {
        let Coupled { m1, m2, m3, .. } = self.scene;
        let (all, two) = (m1 + m2 + m3, m2 + m3);
        [[all, two, m3, 0.0], [two, two, m3, 0.0], [m3, m3, m3, 0.0], [0.0; 4]]
    }

    fn forces(&self, t: f64, x: &Vector, v: &Vector) -> Vector {
        let Coupled { k1, k2, k3, free, c, push, w, .. } = self.scene;
        [push * (w * t).sin() - k1 * x[0], -k2 * (x[1] - free), -k3 * (x[2] - free) - c * v[2], 0.0]
    }

    fn rows(&self, _: f64, x: &Vector, _: &Vector) -> Rows {
        let (first, gap, next) = (row(x[0], &[1.0]), row(x[1], &[0.0, 1.0]), row(x[2], &[0.0, 0.0, 1.0]));
        rows(&[first, gap, row(x[0] + x[1] + x[2], &[1.0, 1.0, 1.0]), first, gap, next])
    }

    fn laws(&self) -> Vec<Law> {
        let Coupled { f1, f2, f3, near, far, left, e1, e2, e3, .. } = self.scene;
        let friction = |limit| Law::Friction { limit };
        let buffer = |restitution| Law::Stop { lower: near, upper: far, restitution };
        let wall = Law::Stop { lower: left, upper: 9.0, restitution: e1 };
        vec![friction(f1), friction(f2), friction(f3), wall, buffer(e2), buffer(e3)]
    }

    fn observed(&self, _: f64, x: &Vector, v: &Vector) -> Observed {
        let sums = |x: &Vector| vec![x[0], x[0] + x[1], x[0] + x[1] + x[2]];
        (sums(x), sums(v))
    }

    fn scales(&self) -> Scales {
        let Coupled { m1, m2, m3, k1, k2, k3, w, .. } = self.scene;
        let stiff = 4.0 * k1.max(k2).max(k3) / m1.min(m2).min(m3);
        Scales { length: 1.0, time: 0.5, step: 0.4 / w.max(stiff.sqrt()) }
    }
}
