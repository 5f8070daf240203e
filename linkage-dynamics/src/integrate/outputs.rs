//! The states of an integration at given times.

use nalgebra::SVector;

use super::System;
use super::control::within;
use super::run::Integration;
use super::tableau::Method;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Error, Real};

/// The states at given times, by dense output: the steps are those that the integration takes without them. Made by
/// [`Integration::at`].
///
/// It ends after the last time, where an event stops the integration, or with an error; what came before stands. A
/// time that is not in the part of the interval that lies ahead is an [`Error::OutOfRange`].
#[derive(Debug)]
pub struct Outputs<'a, M, S, T: Real, I, const N: usize, const K: usize, const C: usize = 0> {
    integration: &'a mut Integration<M, S, T, N, K, C>,
    times: I,
    failed: bool,
}

impl<'a, M, S, T: Real, I, const N: usize, const K: usize, const C: usize> Outputs<'a, M, S, T, I, N, K, C> {
    pub(super) fn new(integration: &'a mut Integration<M, S, T, N, K, C>, times: I) -> Self {
        Self { integration, times, failed: false }
    }
}

impl<M, S, T, I, const N: usize, const K: usize, const C: usize> Outputs<'_, M, S, T, I, N, K, C>
where
    M: Method,
    S: System<T, N, K, C>,
    T: Real,
    I: Iterator<Item = T>,
{
    fn state_at(&mut self, t: T) -> Result<Option<SVector<T, N>>, Error> {
        let ([earliest, latest], end) = (self.integration.reached(), self.integration.end());
        let forward = end >= earliest;
        within("the output time", to_f64(t), to_f64(earliest.min(end)), to_f64(earliest.max(end)))?;
        let mut reached = latest;
        while if forward { t > reached } else { t < reached } {
            if self.integration.advance()?.is_none() {
                return Ok(None);
            }
            reached = self.integration.t();
        }
        self.integration.state_within(t).map(Some)
    }
}

impl<M, S, T, I, const N: usize, const K: usize, const C: usize> Iterator for Outputs<'_, M, S, T, I, N, K, C>
where
    M: Method,
    S: System<T, N, K, C>,
    T: Real,
    I: Iterator<Item = T>,
{
    type Item = Result<(T, SVector<T, N>), Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let t = self.times.next()?;
        let state = self.state_at(t);
        self.failed = !matches!(state, Ok(Some(_)));
        state.transpose().map(|state| state.map(|state| (t, state)))
    }
}
