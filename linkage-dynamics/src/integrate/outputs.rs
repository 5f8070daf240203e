//! The states of an integration at given times.

use super::control::within;
use super::integration::Integration;
use super::system::{ErrorOf, StateOf, System};
use super::tableau::Method;
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;

/// An iterator over the states at given times, by dense output, which does not change the steps. Made by
/// [`Integration::at`].
///
/// It ends after the last time, where an event stops the integration, or with an error; earlier states remain valid. A
/// time outside the interval that remains is an [`InputError::OutOfRange`](linkage_runtime::InputError::OutOfRange).
#[derive(Debug)]
pub struct Outputs<'a, S: System, M, I> {
    integration: &'a mut Integration<S, M>,
    times: I,
    failed: bool,
}

impl<'a, S: System, M, I> Outputs<'a, S, M, I> {
    pub(super) fn new(integration: &'a mut Integration<S, M>, times: I) -> Self {
        Self { integration, times, failed: false }
    }
}

impl<S: System, M: Method, I> Outputs<'_, S, M, I> {
    fn state_at(&mut self, t: S::Scalar) -> Result<Option<StateOf<S>>, ErrorOf<S>> {
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

impl<S: System, M: Method, I: Iterator<Item = S::Scalar>> Iterator for Outputs<'_, S, M, I> {
    type Item = Result<(S::Scalar, StateOf<S>), ErrorOf<S>>;

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
