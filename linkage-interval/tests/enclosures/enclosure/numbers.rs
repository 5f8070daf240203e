//! Random doubles: ordinary, of every magnitude, and about the zeros and extrema of the sine.

use std::f64::consts::FRAC_PI_2;

use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

pub struct Numbers(SmallRng);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(SmallRng::seed_from_u64(linkage_trials::seed(seed)))
    }

    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        self.0.random_range(least..=most)
    }

    /// A double of any magnitude, subnormal numbers and zero among them.
    pub fn any(&mut self) -> f64 {
        loop {
            let value = match self.0.random_range(0..20) {
                0 => 0.0,
                1 => f64::from_bits(self.0.random_range(0..1 << 52)),
                2 => f64::from(self.0.random_range(-4..=4)),
                _ => f64::from_bits(self.0.random()),
            };
            if value.is_finite() {
                return if self.0.random() { value } else { -value };
            }
        }
    }

    /// An ordinary number or any.
    pub fn mixed(&mut self) -> f64 {
        if self.0.random() { self.between(-10.0, 10.0) } else { self.any() }
    }

    /// An angle up to 1e5, or within a few doubles of a multiple of pi/2.
    pub fn angle(&mut self) -> f64 {
        match self.0.random_range(0..4) {
            0 => self.between(-7.0, 7.0),
            1 => self.between(-1e5, 1e5),
            2 => self.any().clamp(-1e5, 1e5),
            _ => {
                let multiple = f64::from(self.0.random_range(-63661..=63661)) * FRAC_PI_2;
                (0..self.0.random_range(0..4)).fold(multiple, |x, _| x.next_up())
            }
        }
    }

    /// A number from -1 to 1, often next to the ends.
    pub fn sine(&mut self) -> f64 {
        match self.0.random_range(0..3) {
            0 => self.between(-1.0, 1.0),
            1 => self.any().clamp(-1.0, 1.0),
            _ => {
                let depth = self.between(0.0, 53.0);
                (1.0 - (-depth).exp2()) * if self.0.random() { 1.0 } else { -1.0 }
            }
        }
    }

    /// Two numbers in ascending order: far apart or close together.
    pub fn pair(&mut self, mut number: impl FnMut(&mut Self) -> f64) -> [f64; 2] {
        let one = number(self);
        let other = match self.0.random_range(0..3) {
            0 => one,
            1 => one + one * (-self.between(0.0, 50.0)).exp2(),
            _ => number(self),
        };
        if other.is_finite() { [one.min(other), one.max(other)] } else { [one; 2] }
    }

    /// The ends of an interval and a few numbers between them.
    pub fn inside(&mut self, [least, most]: [f64; 2]) -> [f64; 4] {
        let mut part = || {
            let t = self.between(0.0, 1.0);
            (least * (1.0 - t) + most * t).clamp(least, most)
        };
        [least, most, part(), part()]
    }
}
