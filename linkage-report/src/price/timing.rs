//! Times of several computations, measured in turn.

use std::time::Instant;

/// The time of one evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Time {
    /// The median of the rounds, in seconds.
    pub median: f64,
    /// The quartiles of the rounds, in seconds.
    pub quartiles: [f64; 2],
    /// The median of the ratios to the time of the first method in the same round.
    pub ratio: f64,
}

/// A computation that is timed.
pub(super) struct Timed<'a> {
    /// Computes everything once and drops the results.
    pub(super) pass: &'a dyn Fn(),
    /// The number of evaluations in a pass.
    pub(super) evaluations: usize,
    /// The place of the one to which its ratio is.
    pub(super) base: usize,
}

/// The least time of a pass: a clock may not see a shorter one.
const LEAST: f64 = 1e-9;

/// Passes longer than this, in seconds, are timed in fewer rounds.
const LONG: f64 = 0.02;
const ROUNDS_OF_LONG: usize = 9;

/// The times of all computations, in turn, round after round: each fills `span` seconds in a round. The order changes from
/// round to round, so that none always follows the same other one.
pub(super) fn in_turn(all: &[Timed<'_>], rounds: usize, span: f64) -> Vec<Option<Time>> {
    // The first pass fills the caches.
    let first: Vec<f64> = all.iter().map(|timed| seconds(timed.pass, 1).min(seconds(timed.pass, 1))).collect();
    let passes: Vec<usize> = first.iter().map(|first| (span / first).ceil().clamp(1.0, 1e6) as usize).collect();
    let mut times = vec![Vec::with_capacity(rounds); all.len()];
    for round in 0..rounds {
        for place in (0..all.len()).map(|place| (place + round) % all.len()) {
            if first[place] < LONG || round < ROUNDS_OF_LONG {
                times[place].push(seconds(all[place].pass, passes[place]));
            }
        }
    }
    for (times, timed) in times.iter_mut().zip(all) {
        times.iter_mut().for_each(|time| *time /= timed.evaluations.max(1) as f64);
    }
    let times_of = &times;
    let each = times.iter().zip(all).map(|(times, timed)| {
        if timed.evaluations == 0 || times.is_empty() {
            return None;
        }
        let ratios = times.iter().zip(&times_of[timed.base]).map(|(time, base)| time / base);
        let ratio = quantile(ratios.collect(), 0.5);
        let [low, median, high] = [0.25, 0.5, 0.75].map(|share| quantile(times.clone(), share));
        Some(Time { median, quartiles: [low, high], ratio })
    });
    each.collect()
}

/// The value below which a share of the values lies.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * share).round() as usize]
}

/// The seconds of one pass.
fn seconds(pass: &dyn Fn(), passes: usize) -> f64 {
    let start = Instant::now();
    (0..passes).for_each(|_| pass());
    (start.elapsed().as_secs_f64() / passes as f64).max(LEAST)
}
