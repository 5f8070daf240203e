//! A motion with a closed form, and the first time that a gap falls below zero on it, in 31 digits.

use linkage_double::DoubleDouble;
use nalgebra::ComplexField;
use rand::Rng;
use rand::rngs::SmallRng;

use super::Expression;

/// Samples of a gap in a radian of its fastest angle.
const SAMPLES: f64 = 10.0;

/// x'' = force - stiffness x and phi'' = torque, without one of the first two, for one second.
#[derive(Debug)]
pub struct Motion {
    pub start: [f64; 2],
    pub rates: [f64; 2],
    pub stiffness: f64,
    pub force: f64,
    pub torque: f64,
}

impl Motion {
    pub fn random(random: &mut SmallRng) -> Self {
        let is_spring = random.random_range(0..3) == 0;
        Self {
            start: [0.0; 2].map(|_| random.random_range(-1.0..1.0)),
            rates: [0.0; 2].map(|_| random.random_range(-2.0..2.0)),
            stiffness: if is_spring { random.random_range(1.0..400.0) } else { 0.0 },
            force: if is_spring { 0.0 } else { random.random_range(-2.0..2.0) },
            torque: random.random_range(-2.0..2.0),
        }
    }

    /// x and phi at a time.
    fn at<T: ComplexField + From<f64>>(&self, t: &T) -> [T; 2] {
        let free = |start: f64, rate: f64, acceleration: f64| {
            T::from(start) + t.clone() * (T::from(rate) + T::from(0.5 * acceleration) * t.clone())
        };
        let phi = free(self.start[1], self.rates[1], self.torque);
        if self.stiffness == 0.0 {
            return [free(self.start[0], self.rates[0], self.force), phi];
        }
        let frequency = T::from(self.stiffness).sqrt();
        let angle = frequency.clone() * t.clone();
        [T::from(self.start[0]) * angle.clone().cos() + T::from(self.rates[0]) / frequency * angle.sin(), phi]
    }

    /// The largest rate of x or phi.
    fn fastest(&self) -> f64 {
        let swing = self.stiffness.sqrt() * self.start[0].abs();
        self.rates[0].abs().hypot(swing).max(self.rates[1].abs()) + self.force.abs().max(self.torque.abs())
    }
}

/// A gap along a motion: an expression, on the other side of a wall.
pub struct Gap<'a> {
    expression: &'a Expression,
    motion: &'a Motion,
    /// Times from 0 to 1, so close that no angle moves far between them, with the values of the expression.
    values: Vec<(f64, f64)>,
}

impl<'a> Gap<'a> {
    /// A gap whose angles move by so many radians, at most, while x and phi move by 1.
    pub fn new(expression: &'a Expression, motion: &'a Motion, fastest: f64) -> Self {
        // Angles are sums of two, and the square of x in one moves twice as fast at x = 2.
        let parts = (SAMPLES * 3.0 * fastest * motion.fastest()).ceil().max(200.0) as usize;
        let times = (0..=parts).map(|part| part as f64 / parts as f64);
        let values = times.map(|t| (t, expression.at(&motion.at(&t)))).collect();
        Self { expression, motion, values }
    }

    /// The largest change along the motion for a change of x and phi by 1 together, or zero of a motion by polynomials, which a
    /// simulation follows without error.
    pub fn sensitivity(&self) -> f64 {
        if self.motion.stiffness == 0.0 {
            return 0.0;
        }
        let change = |pair: &[(f64, f64)]| {
            let [before, after] = [pair[0].0, pair[1].0].map(|t| self.motion.at(&t));
            (pair[1].1 - pair[0].1).abs() / ((after[0] - before[0]).abs() + (after[1] - before[1]).abs())
        };
        self.values.windows(2).map(change).fold(0.0, f64::max)
    }

    /// The distance to the wall, in 31 digits.
    pub fn distance(&self, wall: f64, t: f64) -> f64 {
        let value: DoubleDouble = self.expression.at(&self.motion.at(&DoubleDouble::from(t)));
        (DoubleDouble::from(wall) - value).high()
    }

    /// The largest value from 0 to 1, and the value at 0.
    pub fn largest(&self) -> [f64; 2] {
        [self.values.iter().fold(f64::NEG_INFINITY, |most, (_, value)| most.max(*value)), self.values[0].1]
    }

    /// The first time at which the expression is above the wall by a depth.
    pub fn first_beyond(&self, wall: f64, depth: f64) -> Option<f64> {
        let size = self.values.iter().fold(wall.abs(), |most, (_, value)| most.max(value.abs()));
        let is_deep = |t: f64| self.distance(wall, t) < -depth;
        let last = self.values.len() - 1;
        self.values.iter().enumerate().find_map(|(place, &(t, value))| {
            if wall - value > 0.1 * size {
                return None;
            }
            let neighbours = [place.saturating_sub(1), (place + 1).min(last)].map(|place| self.values[place]);
            let is_extreme = neighbours.iter().all(|neighbour| neighbour.1 <= value);
            let deepest = if is_extreme { self.deepest(wall, neighbours.map(|of| of.0)) } else { t };
            let deep = [t, deepest].into_iter().find(|&t| is_deep(t))?;
            let mut between = [neighbours[0].0, deep];
            for _ in 0..60 {
                let middle = 0.5 * (between[0] + between[1]);
                between[usize::from(is_deep(middle))] = middle;
            }
            Some(between[1])
        })
    }

    /// The time of the least distance between two times, by golden sections.
    fn deepest(&self, wall: f64, [mut start, mut end]: [f64; 2]) -> f64 {
        const PART: f64 = 0.381_966_011_250_105_1;
        while end - start > 1e-9 {
            let [left, right] = [start + PART * (end - start), end - PART * (end - start)];
            if self.distance(wall, left) < self.distance(wall, right) {
                end = right;
            } else {
                start = left;
            }
        }
        0.5 * (start + end)
    }
}
