//! Parts of a motion between its change points.

use std::vec::Vec;

use super::STEPS;
use crate::jacobian::Sample;
use crate::range_of_motion::{Driven, RangeOfMotion};
use crate::scalar::arithmetic::*;
use crate::scalar::{larger, to_f64};
use crate::{OutputMotion, Real, real};

/// The most turns that are searched with 360 steps each; a longer range has longer steps.
const MOST_TURNS: f64 = 64.0;

/// The inputs next to one, by some ulps of the largest.
pub(super) fn next_to<M: Driven>(range: &RangeOfMotion<'_, M>, input: M::Scalar) -> [M::Scalar; 2] {
    let size = range.inputs().into_iter().fold(input.abs(), |size, end| larger(size, end.abs()));
    let some = size * M::Scalar::default_epsilon() * real(4.0);
    [input - some, input + some]
}

/// A part of a motion without change points between its ends.
pub(super) struct Piece<T> {
    pub(super) low: T,
    pub(super) high: T,
    pub(super) steps: u32,
}

impl<T: Real> Piece<T> {
    pub(super) fn all<M: Driven<Scalar = T>>(range: &RangeOfMotion<'_, M>) -> Vec<Self> {
        let [first, last] = range.inputs();
        let mut bounds = Vec::from([first]);
        let crossings = range.crossings().map(|crossing| crossing.input);
        bounds.extend(crossings.filter(|&input| input > first && input < last));
        bounds.push(last);
        let pairs = bounds.windows(2).map(|pair| (pair[0], pair[1]));
        let piece = |(low, high): (T, T)| {
            let turns = if range.mechanism().input_angles()[0] { to_f64((high - low) / T::two_pi()) } else { 1.0 };
            // At most 64 times 360.
            Self { low, high, steps: (f64::from(STEPS) * turns.clamp(1.0, MOST_TURNS)) as u32 }
        };
        pairs.map(piece).collect()
    }

    /// The middles of equal steps of s.
    pub(super) fn places(&self) -> impl Iterator<Item = T> {
        let steps = f64::from(self.steps);
        (0..self.steps).map(move |step| real((f64::from(step) + 0.5) / steps))
    }

    /// low + (high - low) sin^2(pi s / 2), from the nearer end.
    pub(super) fn input(&self, s: T) -> T {
        let (sine, cosine) = (T::frac_pi_2() * s).sine_cosine();
        let length = self.high - self.low;
        if sine < cosine { self.low + length * sine * sine } else { self.high - length * cosine * cosine }
    }

    /// The place s of an input.
    pub(super) fn place(&self, input: T) -> T {
        let [below, above] = [input - self.low, self.high - input].map(|part| part.max(T::zero()).sqrt());
        below.arctangent2(above) / T::frac_pi_2()
    }

    /// The derivative by s of a quantity with its own: its rate and acceleration are by the input.
    pub(super) fn slope_at(&self, s: T, motion: &OutputMotion<T>) -> Sample<T> {
        let (sine, cosine) = (T::pi() * s).sine_cosine();
        let half = (self.high - self.low) * real(0.5);
        let (first, second) = (half * T::pi() * sine, half * T::pi() * T::pi() * cosine);
        let slope = motion.acceleration * first * first + motion.rate * second;
        Sample { at: s, value: motion.rate * first, slope }
    }
}
