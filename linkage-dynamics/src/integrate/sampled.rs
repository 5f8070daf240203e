//! Samples of the event functions and guards of a system along a step.

use nalgebra::ComplexField;

use super::dense::Interpolant;
use super::system::{ErrorOf, Guard, StateOf, System};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Build, Column, Dim, Name, real};

/// Two values of a function within this many ulps count as equal, so that a constant with rounding errors has no
/// extremum. At 0 each such error costs the evaluations of dense output; at 1e4 extrema of a relative depth of 1e-12
/// are missed.
const EQUAL_ULPS: f64 = 16.0;

/// The value and the rate of a function at one time of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct FunctionSample {
    pub(super) value: f64,
    /// Its rate times the length of the step; zero if unknown.
    pub(super) rate: f64,
    /// True if the system supplies the rate.
    pub(super) is_known: bool,
}

/// The values and rates of all functions at one time of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample<K: Dim, C: Dim> {
    /// The fraction of the step.
    pub(super) at: f64,
    pub(super) events: Column<FunctionSample, K>,
    pub(super) guards: Column<FunctionSample, C>,
}

/// A step, with the system whose functions are sampled along it.
pub(super) struct SampledStep<'a, S: System> {
    pub(super) system: &'a mut S,
    pub(super) step: &'a Interpolant<S::Scalar, S::N>,
    /// The rounding error of the time, as a fraction of the step.
    pub(super) resolution: f64,
    /// The depth of the passages of each guard that may be missed; None where no bound of the guard is known.
    pub(super) tolerated: Column<Option<f64>, S::Guards>,
}

/// A sample of the functions of a system.
pub(super) type SampleOf<S> = Sample<<S as System>::Events, <S as System>::Guards>;

/// Samples the functions at a time and state, which is the fraction `at` of a step of this length.
pub(super) fn sampled<S: System>(
    system: &mut S,
    (at, length): (f64, S::Scalar),
    (t, state): (S::Scalar, &StateOf<S>),
) -> Result<SampleOf<S>, ErrorOf<S>> {
    let unknown = FunctionSample { value: 0.0, rate: 0.0, is_known: false };
    let (of_events, of_guards) = system.counts();
    let (mut events, mut guards) = (of_events.repeat(unknown), of_guards.repeat(unknown));
    if of_events.count() > 0 {
        events = system.events(t, state)?.map(|value| FunctionSample { value: to_f64(value), ..unknown });
    }
    if of_guards.count() > 0 {
        guards = system.guards(t, state)?.map(|Guard { value, rate }| FunctionSample {
            value: to_f64(value),
            rate: rate.map_or(0.0, |rate| to_f64(rate * length)),
            is_known: rate.is_some(),
        });
    }
    let sample = Sample { at, events, guards };
    if sample.each().all(|sample| sample.value.is_finite()) {
        Ok(sample)
    } else {
        Err(MotionError::NotFinite { quantity: Name::from_static("an event function"), t: to_f64(t) })
    }
}

impl<K: Dim, C: Dim> Sample<K, C> {
    /// The values of the guards without a known rate.
    pub(super) fn unknown(&self) -> Column<Option<f64>, C> {
        self.guards.map(|guard| if guard.is_known { None } else { Some(guard.value) })
    }

    pub(super) fn each(&self) -> impl Iterator<Item = &FunctionSample> {
        self.events.iter().chain(&self.guards)
    }

    pub(super) fn each_mut(&mut self) -> impl Iterator<Item = &mut FunctionSample> {
        self.events.iter_mut().chain(&mut self.guards)
    }
}

impl<S: System> SampledStep<'_, S> {
    /// Samples the functions at a fraction of the step, with the rates that the system supplies.
    pub(super) fn sample(&mut self, at: f64) -> Result<SampleOf<S>, ErrorOf<S>> {
        let Self { system, step, .. } = self;
        sampled(*system, (at, step.length()), (step.time(at), &step.at_fraction(real(at))))
    }

    /// Samples the functions slightly nearer to the middle of the step, for a difference quotient.
    pub(super) fn nearby_sample(&mut self, at: f64) -> Result<SampleOf<S>, ErrorOf<S>> {
        let little = ComplexField::sqrt(self.resolution);
        self.sample(if at < 0.5 { at + little } else { at - little })
    }

    /// Samples the functions with all rates; those that the system does not supply by difference quotients.
    pub(super) fn sample_with_rates(&mut self, at: f64) -> Result<SampleOf<S>, ErrorOf<S>> {
        let mut sample = self.sample(at)?;
        if sample.each().any(|sample| !sample.is_known) {
            let nearby = self.nearby_sample(at)?;
            for (here, there) in sample.each_mut().zip(nearby.each()).filter(|(here, _)| !here.is_known) {
                let change = if is_same(here.value, there.value) { 0.0 } else { there.value - here.value };
                here.rate = change / (nearby.at - at);
            }
        }
        Ok(sample)
    }
}

/// Returns true if the values are equal within rounding error.
pub(super) fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= EQUAL_ULPS * f64::EPSILON * a.abs().max(b.abs())
}
