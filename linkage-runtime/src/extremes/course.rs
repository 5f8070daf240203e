//! A quantity along a motion.

use std::vec::Vec;

use super::{Extreme, Extremes};
use crate::{OutputMotion, Real};

/// A quantity along a motion.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Course<T = f64> {
    /// The least and the largest value, ends included; of a constant quantity twice the same.
    pub extremes: Extremes<T>,
    /// The places at which it turns: its derivative changes its sign, or a rest begins after which it
    /// goes back. They are in the order of the input, with that at
    /// which a closed motion begins, without other ends.
    pub turning_points: Vec<Extreme<T>>,
    /// The parts in which it rests: its values are equal up to rounding errors. No part is shorter than a step of the search. Of a
    /// rest about the input at which a closed motion begins there are two parts.
    pub rests: Vec<[Extreme<T>; 2]>,
    /// True if it does not move: its values are no farther apart than rounding errors are.
    pub is_constant: bool,
    /// The values at both ends.
    pub ends: [Extreme<T>; 2],
    /// The values between them, in the order of the input, with derivatives by the input.
    pub samples: Vec<(T, OutputMotion<T>)>,
    /// The change of a value by an ulp of the input and by rounding errors: between the ends, and at the ends and the change
    /// points that the motion passes, each with its input.
    pub resolution: (T, Vec<(T, T)>),
}

impl<T: Real> Course<T> {
    pub(super) fn only(at: Extreme<T>) -> Self {
        let extremes = Extremes::only(at.input, at.value);
        Self {
            extremes,
            turning_points: Vec::new(),
            rests: Vec::new(),
            is_constant: true,
            ends: [at; 2],
            samples: Vec::new(),
            resolution: (T::zero(), Vec::new()),
        }
    }

    /// The change of the value at an input of the motion by an ulp of the input and by rounding errors.
    #[must_use]
    pub fn resolution_at(&self, input: T) -> T {
        let (between, singular) = &self.resolution;
        let there = singular.iter().find(|(at, _)| *at == input).map(|(_, change)| *change);
        there.unwrap_or_else(T::zero).max(*between)
    }

    /// The extremes of all values; of a constant one of them, from a place where errors are small.
    pub(super) fn find_extremes(&mut self) {
        let sampled = self.samples.iter().map(|&(input, motion)| Extreme { input, value: motion.value });
        let all = self.ends.iter().chain(&self.turning_points).copied().chain(sampled);
        self.extremes = all.fold(self.extremes, |mut extremes, here| {
            extremes.include(here.input, here.value);
            extremes
        });
        if self.is_constant {
            let Extremes { least, largest } = self.extremes;
            self.resolution.0 = self.resolution.0.max(largest.value - least.value);
            if let Some((input, motion)) = self.samples.get(self.samples.len() / 3) {
                self.extremes = Extremes::only(*input, motion.value);
            }
        }
    }
}
