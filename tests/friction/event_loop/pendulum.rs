//! A double pendulum over a floor that its elbow and its tip strike, with friction in its elbow.

use crate::event_loop::compare::{Family, Observed, number, restitution, states};
use crate::event_loop::oracle::{Law, Model, Row, Rows, Scales, Start, Vector, row, rows};
use linkage::MotionError;
use linkage::linkage;
use linkage::simulation::{self, simulate};
use rand::Rng;
use rand::rngs::SmallRng;

linkage! {
    /// Two rods, the first on a fixed pin.
    #[derive(Debug, Clone)]
    mechanism Pendulum {
        param l1 = 1, l2 = 0.8, c1 = 0.5, c2 = 0.5, m1 = 1, j1 = 0.1, m2 = 1, j2 = 0.05, g = 9.81;
        param floor = -1.2, f = 0, e1 = 0.5, e2 = 0.5;
        input theta1, theta2;
        point A = l1@theta1;
        point B = A + l2@theta2;
        body upper { mass m1; inertia j1; center (c1 * l1)@theta1; angle theta1; }
        body lower { mass m2; inertia j2; center A + (c2 * l2)@theta2; angle theta2; }
        scene Falling {
            inertia;
            gravity (0, -g);
            friction f, 1 on theta2 - theta1;
            stop y(A) in floor..9, restitution e1;
            stop y(B) in floor..9, restitution e2;
        }
    }
}

/// A scene, its start and its end; the oracle's coordinates are those of elbow and tip, linked by two distances.
#[derive(Debug, Clone)]
pub struct Rods {
    scene: Falling,
    angles: [f64; 2],
    rates: [f64; 2],
    end: f64,
}

impl Family for Rods {
    const NAME: &'static str = "pendulum";
    type Model = Self;

    fn random(random: &mut SmallRng, round: bool) -> Self {
        let mut number = |low, high| number(random, round, [low, high]);
        let (l1, l2, c1, c2) = (number(0.5, 1.5), number(0.5, 1.5), number(0.2, 1.0), number(0.2, 1.0));
        let (m1, j1, m2, j2) = (number(0.3, 2.0), number(0.02, 0.3), number(0.3, 2.0), number(0.02, 0.3));
        let (f, angles, rates) =
            (number(-2.0, 3.0), [number(-1.5, 3.0), number(-2.0, 3.0)], [number(-4.0, 4.0), number(-4.0, 4.0)]);
        let (end, deep) = (number(0.3, 1.5), number(0.1, 1.0));
        let (e1, e2) = (restitution(random, round), restitution(random, round));
        let at_rest = random.random_bool(0.3);
        let elbow = l1 * angles[0].sin();
        let lowest = elbow.min(elbow + l2 * angles[1].sin());
        // One of five starts on the floor.
        let floor = if random.random_bool(0.2) { lowest } else { lowest - deep };
        let mechanism = Pendulum::new(l1, l2);
        let scene = Falling { mechanism, c1, c2, m1, j1, m2, j2, g: 9.81, floor, f: f.max(0.0), e1, e2 };
        Self { scene, angles, rates: if at_rest { [0.0; 2] } else { rates }, end }
    }

    fn model(&self) -> Self {
        self.clone()
    }

    fn start(&self) -> Start {
        let Pendulum { l1, l2, .. } = self.scene.mechanism;
        let ([a, b], [u, v]) = (self.angles, self.rates);
        let (x, y) = (l1 * a.cos(), l1 * a.sin());
        let (dx, dy) = (l2 * b.cos(), l2 * b.sin());
        Start { t: 0.0, x: [x, y, x + dx, y + dy], v: [-y * u, x * u, -y * u - dy * v, x * u + dx * v] }
    }

    fn end(&self) -> f64 {
        self.end
    }

    fn angles() -> Vec<bool> {
        vec![true; 2]
    }

    fn simulate(&self, times: &[f64], tolerance: f64) -> Result<Vec<Observed>, MotionError> {
        let q = PendulumCoordinates { theta1: self.angles[0], theta2: self.angles[1] };
        let input_rates = PendulumInputs { theta1: self.rates[0], theta2: self.rates[1] };
        let start = simulation::Start { t: 0.0, q, input_rates };
        states(
            || simulate(&self.scene, start, self.end, tolerance),
            times,
            |state| {
                let (q, v) = (state.q, state.rates);
                (vec![q.theta1, q.theta2], vec![v.theta1, v.theta2])
            },
        )
    }
}

/// The angle of a rod and its rate; the gradient of the angle over the components of the rod is (-y, x)/(x^2 + y^2).
struct Turn {
    angle: f64,
    rate: f64,
    /// -y/l^2, x/l^2.
    slope: [f64; 2],
    /// The angle's second derivative where the components have none.
    bias: f64,
}

fn turn([x, y]: [f64; 2], [u, v]: [f64; 2]) -> Turn {
    let square = x * x + y * y;
    let rate = (x * v - y * u) / square;
    let bias = -2.0 * rate * (x * u + y * v) / square;
    Turn { angle: y.atan2(x), rate, slope: [-y / square, x / square], bias }
}

fn distance(length: f64, [x, y]: [f64; 2], [u, v]: [f64; 2], gradient: Vector) -> Row {
    Row { value: 0.5 * (x * x + y * y - length * length), gradient, drift: 0.0, bias: u * u + v * v }
}

impl Rods {
    fn turns(x: &Vector, v: &Vector) -> [Turn; 2] {
        [turn([x[0], x[1]], [v[0], v[1]]), turn([x[2] - x[0], x[3] - x[1]], [v[2] - v[0], v[3] - v[1]])]
    }
}

impl Model for Rods {
    const COUNT: usize = 4;
    const LINKS: usize = 2;

    fn mass(&self) -> [Vector; 4] {
        let Pendulum { l1, l2, .. } = self.scene.mechanism;
        let Falling { c1, c2, m1, j1, m2, j2, .. } = self.scene;
        let spin = j2 / (l2 * l2);
        let elbow = m1 * c1 * c1 + j1 / (l1 * l1) + m2 * (1.0 - c2) * (1.0 - c2) + spin;
        let (both, tip) = (m2 * c2 * (1.0 - c2) - spin, m2 * c2 * c2 + spin);
        [[elbow, 0.0, both, 0.0], [0.0, elbow, 0.0, both], [both, 0.0, tip, 0.0], [0.0, both, 0.0, tip]]
    }

    fn forces(&self, _: f64, _: &Vector, _: &Vector) -> Vector {
        let Falling { c1, c2, m1, m2, g, .. } = self.scene;
        [0.0, -g * (m1 * c1 + m2 * (1.0 - c2)), 0.0, -g * m2 * c2]
    }

    fn rows(&self, _: f64, x: &Vector, v: &Vector) -> Rows {
        let Pendulum { l1, l2, .. } = self.scene.mechanism;
        let (dx, dy, du, dv) = (x[2] - x[0], x[3] - x[1], v[2] - v[0], v[3] - v[1]);
        let upper = distance(l1, [x[0], x[1]], [v[0], v[1]], [x[0], x[1], 0.0, 0.0]);
        let lower = distance(l2, [dx, dy], [du, dv], [-dx, -dy, dx, dy]);
        let [one, two] = Self::turns(x, v);
        let elbow = Row {
            value: two.angle - one.angle,
            gradient: [-two.slope[0] - one.slope[0], -two.slope[1] - one.slope[1], two.slope[0], two.slope[1]],
            drift: 0.0,
            bias: two.bias - one.bias,
        };
        rows(&[upper, lower, elbow, row(x[1], &[0.0, 1.0]), row(x[3], &[0.0, 0.0, 0.0, 1.0])])
    }

    fn laws(&self) -> Vec<Law> {
        let Falling { f, floor, e1, e2, .. } = self.scene;
        let stop = |restitution| Law::Stop { lower: floor, upper: 9.0, restitution };
        vec![Law::Friction { limit: f }, stop(e1), stop(e2)]
    }

    fn observed(&self, _: f64, x: &Vector, v: &Vector) -> Observed {
        let [one, two] = Self::turns(x, v);
        (vec![one.angle, two.angle], vec![one.rate, two.rate])
    }

    fn scales(&self) -> Scales {
        Scales { length: 1.0, time: 0.3, step: 0.02 }
    }
}
