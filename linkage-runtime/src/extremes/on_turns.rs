//! Angles that go on where their formula jumps: `atan2` goes from pi to -pi.

use core::cmp::Ordering::Equal;
use std::vec::Vec;

use crate::{OutputMotion, Real, real};

/// Values along a motion, each on the turn of those next to it.
pub(super) struct OnTurns<T> {
    /// The jump of each quantity whose formula has one.
    jumps: Vec<Option<T>>,
    /// Inputs in their order, with the values there.
    known: Vec<(T, Vec<T>)>,
}

impl<T: Real> OnTurns<T> {
    pub(super) fn new(jumps: Vec<Option<T>>) -> Self {
        Self { jumps, known: Vec::new() }
    }

    /// The quantities at an input, with the turns of those at the nearest one that is known.
    pub(super) fn turned(&self, input: T, mut all: Vec<OutputMotion<T>>) -> Vec<OutputMotion<T>> {
        if let Some((_, values)) = self.nearest(input) {
            for ((one, near), jump) in all.iter_mut().zip(values).zip(&self.jumps) {
                if let Some(jump) = jump {
                    one.value += ((*near - one.value) / *jump).round() * *jump;
                }
            }
        }
        all
    }

    /// True if a value is so far from the nearest known one that its turn is not sure.
    pub(super) fn is_far(&self, input: T, all: &[OutputMotion<T>]) -> bool {
        self.nearest(input).is_some_and(|(_, values)| {
            let mut each = all.iter().zip(values).zip(&self.jumps);
            each.any(|((one, near), jump)| jump.is_some_and(|jump| (one.value - *near).abs() > jump * real(0.25)))
        })
    }

    /// Keeps quantities at an input beyond all others.
    pub(super) fn keep(&mut self, input: T, all: &[OutputMotion<T>]) {
        if self.jumps.iter().any(Option::is_some) {
            self.known.push((input, all.iter().map(|one| one.value).collect()));
        }
    }

    /// The last input that is known.
    pub(super) fn last(&self) -> Option<T> {
        self.known.last().map(|(input, _)| *input)
    }

    fn nearest(&self, input: T) -> Option<&(T, Vec<T>)> {
        let after = self.known.partition_point(|(at, _)| *at < input);
        let around = self.known.get(after.saturating_sub(1)).into_iter().chain(self.known.get(after));
        around.min_by(|(one, _), (other, _)| (*one - input).abs().partial_cmp(&(*other - input).abs()).unwrap_or(Equal))
    }
}
