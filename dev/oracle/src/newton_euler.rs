//! The laws of Newton and Euler for each link of a machine, in 48 digits: the forces in all joints.
//!
//! Every link has coordinates of its own, x and y of its centre and its angle, and so has every pin, x and y. The
//! unknowns are all accelerations, the forces and moments of joints, and the forces of what is held:
//!
//! ```text
//! M q'' - J' lambda = F,   J q'' = s'' - gamma
//! ```
//!
//! with a row of J for each scalar that a joint keeps or that is held. The links and joints are written by hand, apart
//! from any loop.

pub use super::along::{Along, GROUND, Line, Link, Point};

use super::along::Frame;
use super::jet::Jet;
use super::precise::{Big, Scalar, big, direction};

/// The mass of a link, its moment of inertia about the centre, and the centre in the frame of the link.
#[derive(Debug, Clone, Copy, Default)]
pub struct Inertia {
    pub mass: f64,
    pub moment: f64,
    pub center: [f64; 2],
}

/// The force along a scalar s.
#[derive(Debug, Clone, Copy)]
pub enum Law {
    Force(f64),
    /// -k (s - s0).
    Spring {
        stiffness: f64,
        free: f64,
    },
    /// -c s'.
    Damper(f64),
}

/// The rows of the forces of a pin on its links, in their order.
#[derive(Debug, Clone)]
pub struct Pin(Vec<usize>);

/// The rows of the normal force and the moment of a guide.
#[derive(Debug, Clone, Copy)]
pub struct Guide(usize);

/// The row of the force of what is held.
#[derive(Debug, Clone, Copy)]
pub struct Held(usize);

#[derive(Debug, Clone)]
struct Body {
    inertia: Inertia,
    first: usize,
    /// False for a pin.
    turns: bool,
}

/// A machine at a position near a guess, with its inputs, loads, and what is held.
#[derive(Debug, Clone)]
pub struct Machine {
    bodies: Vec<Body>,
    near: Vec<f64>,
    /// The scalars that joints keep, with their values.
    joints: Vec<(Along, f64)>,
    /// s, s' of what the position is found from.
    inputs: Vec<(Along, [f64; 2])>,
    loads: Vec<(Along, Law)>,
    held: Vec<(Along, f64)>,
    gravity: [f64; 2],
}

/// The motion of a machine and the forces in it.
#[derive(Debug, Clone)]
pub struct Solution {
    frames: Vec<Frame>,
    forces: Vec<Big>,
    joints: usize,
}

impl Machine {
    /// A machine without links in a field of gravity.
    #[must_use]
    pub fn new(gravity: [f64; 2]) -> Self {
        let ground = Body { inertia: Inertia::default(), first: 0, turns: false };
        let (joints, inputs, loads, held) = Default::default();
        Self { bodies: vec![ground], near: Vec::new(), joints, inputs, loads, held, gravity }
    }

    /// Adds a link whose frame is near a position and an angle.
    pub fn link(&mut self, inertia: Inertia, origin: [f64; 2], angle: f64) -> Link {
        let ([x, y], [u, v], (sine, cosine)) = (origin, inertia.center, angle.sin_cos());
        let near = [x + cosine * u - sine * v, y + sine * u + cosine * v, angle];
        self.add(Body { inertia, first: self.near.len(), turns: true }, &near)
    }

    fn add(&mut self, body: Body, near: &[f64]) -> Link {
        self.bodies.push(body);
        self.near.extend(near);
        Link(self.bodies.len() - 1)
    }

    /// A point by its position in the frame of a link.
    #[must_use]
    pub fn point(&self, link: Link, local: [f64; 2]) -> Point {
        let center = self.bodies[link.0].inertia.center;
        Point { link, local: [0, 1].map(|axis| big(local[axis]) - big(center[axis])) }
    }

    /// A line from a point at an angle to the x axis of its link.
    #[must_use]
    pub fn line(&self, link: Link, from: [f64; 2], angle: f64) -> Line {
        let (cosine, sine) = direction(&big(angle));
        Line { from: self.point(link, from), direction: [cosine, sine] }
    }

    /// The position of a point at the guess.
    #[must_use]
    pub fn place(&self, point: &Point) -> [f64; 2] {
        let near: Vec<Big> = self.near.iter().map(|&value| big(value)).collect();
        let zero = vec![big(0.0); near.len()];
        let frames = self.frames([&near, &zero, &zero]);
        point.of(&frames).map(|part| part.value.double())
    }

    /// Joins points of links by a pin.
    pub fn pin(&mut self, points: &[Point]) -> Pin {
        self.pin_with_mass(0.0, points)
    }

    /// Joins points of links by a pin with a mass.
    pub fn pin_with_mass(&mut self, mass: f64, points: &[Point]) -> Pin {
        let near = self.place(&points[0]);
        let inertia = Inertia { mass, ..Inertia::default() };
        let pin = self.add(Body { inertia, first: self.near.len(), turns: false }, &near);
        let center = self.point(pin, [0.0; 2]);
        let rows = points.iter().map(|point| {
            let row = self.joints.len();
            self.joints.extend([0, 1].map(|axis| (Along::Axis(axis, [point.clone(), center.clone()]), 0.0)));
            row
        });
        Pin(rows.collect())
    }

    /// The point of a pin itself, at which a load may act.
    #[must_use]
    pub fn at(&self, pin: &Pin) -> Point {
        match &self.joints[pin.0[0]].0 {
            Along::Axis(_, [_, pin]) => pin.clone(),
            _ => unreachable!("the rows of a pin"),
        }
    }

    /// Lets a point of a link slide along a line of another, at an angle between the two.
    pub fn guide(&mut self, line: &Line, end: &Point, angle: f64) -> Guide {
        self.joints.push((Along::Left(line.clone(), end.clone()), 0.0));
        self.joints.push((Along::Turn([end.link, line.from.link]), angle));
        Guide(self.joints.len() - 2)
    }

    /// Gives the value and the rate of an input.
    pub fn input(&mut self, along: Along, value: f64, rate: f64) {
        self.inputs.push((along, [value, rate]));
    }

    pub fn load(&mut self, along: Along, law: Law) {
        self.loads.push((along, law));
    }

    /// A force at a point, by its components.
    pub fn force(&mut self, at: &Point, force: [f64; 2]) {
        for axis in [0, 1] {
            let origin = self.point(GROUND, [0.0; 2]);
            self.load(Along::Axis(axis, [at.clone(), origin]), Law::Force(force[axis]));
        }
    }

    /// Holds a scalar at an acceleration, by an unknown force: a drive, a friction at rest, a stop.
    pub fn hold(&mut self, along: Along, acceleration: f64) -> Held {
        self.held.push((along, acceleration));
        Held(self.held.len() - 1)
    }

    fn frames(&self, [q, rates, accelerations]: [&[Big]; 3]) -> Vec<Frame> {
        let frame = |(index, body): (usize, &Body)| {
            if index == GROUND.0 {
                return Frame::resting();
            }
            let [value, rate, second] = [q, rates, accelerations].map(|values| |at: usize| values[at].clone());
            let jet = |at: usize| Jet { value: value(at), rate: rate(at), second: second(at) };
            let angle = if body.turns { jet(body.first + 2) } else { Jet::constant(big(0.0)) };
            Frame { center: [0, 1].map(|axis| jet(body.first + axis)), axis: angle.direction(), angle }
        };
        self.bodies.iter().enumerate().map(frame).collect()
    }

    /// The derivatives of a scalar by all coordinates.
    fn gradient(&self, along: &Along, frames: &[Frame]) -> Vec<Big> {
        let mut gradient = vec![big(0.0); self.near.len()];
        let mut still = frames.to_vec();
        for link in along.links() {
            still[link.0] = frames[link.0].still();
        }
        for Link(link) in along.links().into_iter().filter(|&link| link != GROUND) {
            let body = &self.bodies[link];
            for part in 0..if body.turns { 3 } else { 2 } {
                let at_rest = std::mem::replace(&mut still[link], frames[link].moving(part));
                gradient[body.first + part] = along.value(&still).rate;
                still[link] = at_rest;
            }
        }
        gradient
    }

    /// The position by Newton's method, and its rates.
    fn closed(&self) -> [Vec<Big>; 2] {
        let mut q: Vec<Big> = self.near.iter().map(|&value| big(value)).collect();
        let zero = vec![big(0.0); q.len()];
        let kept = self.joints.iter().map(|(along, value)| (along, [*value, 0.0]));
        let rows: Vec<(&Along, [f64; 2])> =
            kept.chain(self.inputs.iter().map(|(along, values)| (along, *values))).collect();
        for _ in 0..20 {
            let frames = self.frames([&q, &zero, &zero]);
            let matrix: Vec<Vec<Big>> = rows.iter().map(|(along, _)| self.gradient(along, &frames)).collect();
            let right = rows.iter().map(|(along, [value, _])| big(*value) - along.value(&frames).value).collect();
            let step = solved(matrix.clone(), right);
            q.iter_mut().zip(&step).for_each(|(q, step)| *q = &*q + step);
            if step.iter().all(|step| step.double().abs() < 1e-30) {
                let rates = solved(matrix, rows.iter().map(|(_, [_, rate])| big(*rate)).collect());
                return [q, rates];
            }
        }
        panic!("the position does not converge");
    }

    /// Solves for all accelerations and forces.
    ///
    /// # Panics
    /// If no position is near the guess, or if the forces are not determined.
    #[must_use]
    pub fn solve(&self) -> Solution {
        let [q, rates] = self.closed();
        let (n, zero) = (q.len(), vec![big(0.0); q.len()]);
        let frames = self.frames([&q, &rates, &zero]);
        let kept = self.joints.iter().map(|(along, _)| (along, 0.0));
        let rows: Vec<(&Along, f64)> = kept.chain(self.held.iter().map(|(along, to)| (along, *to))).collect();
        let size = n + rows.len();
        let mut matrix = vec![vec![big(0.0); size]; size];
        let mut right = vec![big(0.0); size];
        for body in &self.bodies[1..] {
            for (part, axis) in [0, 1].map(|axis| (body.first + axis, axis)) {
                matrix[part][part] = big(body.inertia.mass);
                right[part] = big(body.inertia.mass) * big(self.gravity[axis]);
            }
            if body.turns {
                matrix[body.first + 2][body.first + 2] = big(body.inertia.moment);
            }
        }
        for (along, law) in &self.loads {
            let s = along.value(&frames);
            let force = match *law {
                Law::Force(force) => big(force),
                Law::Spring { stiffness, free } => big(-stiffness) * (s.value - big(free)),
                Law::Damper(constant) => big(-constant) * s.rate,
            };
            for (right, slope) in right.iter_mut().zip(self.gradient(along, &frames)) {
                *right = &*right + &force * slope;
            }
        }
        for (row, (along, to)) in rows.iter().enumerate() {
            for (column, slope) in self.gradient(along, &frames).into_iter().enumerate() {
                matrix[column][n + row] = -slope.clone();
                matrix[n + row][column] = slope;
            }
            right[n + row] = big(*to) - along.value(&frames).second;
        }
        let mut accelerations = solved(matrix, right);
        let forces = accelerations.split_off(n);
        Solution { frames: self.frames([&q, &rates, &accelerations]), forces, joints: self.joints.len() }
    }
}

impl Solution {
    /// The force of a pin on one of its links.
    #[must_use]
    pub fn pin(&self, pin: &Pin, link: usize) -> [f64; 2] {
        [0, 1].map(|axis| self.forces[pin.0[link] + axis].double())
    }

    /// The normal force of a guide on what slides, and its moment about the sliding point.
    #[must_use]
    pub fn guide(&self, guide: Guide) -> [f64; 2] {
        [0, 1].map(|part| self.forces[guide.0 + part].double())
    }

    /// The value of a scalar, its rate and its acceleration.
    #[must_use]
    pub fn motion(&self, along: &Along) -> [f64; 3] {
        let Jet { value, rate, second } = along.value(&self.frames);
        [value, rate, second].map(|value| value.double())
    }

    /// The force along what is held.
    #[must_use]
    pub fn held(&self, held: Held) -> f64 {
        self.forces[self.joints + held.0].double()
    }
}

/// Gaussian elimination with the largest pivot of each column.
fn solved(mut matrix: Vec<Vec<Big>>, mut right: Vec<Big>) -> Vec<Big> {
    let (n, zero) = (right.len(), big(0.0));
    for column in 0..n {
        let size = |row: usize| matrix[row][column].double().abs();
        let pivot = (column..n).max_by(|&a, &b| size(a).total_cmp(&size(b))).expect("a row");
        assert!(size(pivot) > 1e-25, "the forces are not determined");
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        let (upper, lower) = matrix.split_at_mut(column + 1);
        let pivot = &upper[column];
        let known = right[column].clone();
        for (row, right) in lower.iter_mut().zip(&mut right[column + 1..]).filter(|(row, _)| row[column] != zero) {
            let factor = &row[column] / &pivot[column];
            for (entry, above) in row.iter_mut().zip(pivot).skip(column).filter(|(_, above)| **above != zero) {
                *entry = &*entry - &factor * above;
            }
            *right = &*right - &factor * &known;
        }
    }
    for row in (0..n).rev() {
        let known = (row + 1..n).filter(|&column| matrix[row][column] != zero);
        let sum = known.fold(right[row].clone(), |sum, column| sum - &matrix[row][column] * &right[column]);
        right[row] = sum / &matrix[row][row];
    }
    right
}
