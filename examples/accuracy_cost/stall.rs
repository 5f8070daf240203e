//! A mechanism's methods, evaluated and timed.

use linkage::PositionError;

use crate::dominance::dominated;
use crate::oracle::Poses;
use crate::price::frontier::{Price, Prices, frontier};

/// What is asked for, by its order.
pub const QUANTITIES: [&str; 3] = ["position", "velocity", "acceleration"];

/// A kind of pose and a quantity there.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    pub pose: String,
    pub angles_given: bool,
    pub order: usize,
}

/// One method at one point.
pub struct Work {
    pub method: &'static str,
    pub point: Point,
    /// The largest error of its cases, or why there is none.
    pub error: Result<f64, PositionError>,
    /// Evaluations per pass.
    pub cases: usize,
    /// All cases once, results thrown away.
    pub pass: Box<dyn Fn()>,
}

/// The prices of a mechanism: of each method, at each point.
pub struct Stall {
    pub mechanism: &'static str,
    pub points: Vec<Point>,
    pub prices: Vec<Prices>,
    /// Why there is no price, where a method was tried.
    pub refusals: Vec<(usize, usize, PositionError)>,
    /// For each method the one that makes it superfluous on all stalls, if there is one.
    pub dominated: Vec<Option<usize>>,
}

/// The largest of some errors; a result that is not a number, given without a word, is none.
pub fn largest(errors: impl Iterator<Item = Result<f64, PositionError>>) -> Result<f64, PositionError> {
    let largest = errors.collect::<Result<Vec<f64>, PositionError>>()?.into_iter().fold(0.0, f64::max);
    let silent = PositionError::NotFinite { mechanism: "the mechanism", quantity: "without a word: a result" };
    if largest.is_finite() { Ok(largest) } else { Err(silent) }
}

pub fn points(poses: &Poses) -> impl Iterator<Item = Point> {
    let first = usize::from(poses.angles_given);
    (first..3).map(|order| Point { pose: poses.pose.clone(), angles_given: poses.angles_given, order })
}

impl Stall {
    /// Times every work in turns, `rounds` times; the medians count.
    pub fn open(mechanism: &'static str, methods: &[&'static str], works: Vec<Work>, rounds: usize, span: f64) -> Self {
        let mut points: Vec<Point> = Vec::new();
        for work in &works {
            if !points.contains(&work.point) {
                points.push(work.point.clone());
            }
        }
        let mut times = vec![Vec::with_capacity(rounds); works.len()];
        // As many passes as fill the span of time, found once.
        let passes: Vec<usize> =
            works.iter().map(|work| (span / seconds(&*work.pass, 2)).ceil().max(1.0) as usize).collect();
        for _ in 0..rounds {
            for ((work, times), &passes) in works.iter().zip(&mut times).zip(&passes) {
                if work.error.is_ok() {
                    times.push(1e9 * seconds(&*work.pass, passes) / work.cases as f64);
                }
            }
        }
        let mut prices = vec![vec![None; points.len()]; methods.len()];
        let mut refusals = Vec::new();
        for (work, mut times) in works.into_iter().zip(times) {
            let method = methods.iter().position(|name| *name == work.method).expect("a method of the list");
            let point = points.iter().position(|point| *point == work.point).expect("a point of the list");
            times.sort_by(f64::total_cmp);
            match work.error {
                Ok(error) => prices[method][point] = Some(Price { error, time: times[times.len() / 2] }),
                Err(error) => refusals.push((method, point, error)),
            }
        }
        Self { mechanism, points, prices, refusals, dominated: vec![None; methods.len()] }
    }

    /// What each method costs at one point.
    pub fn at(&self, point: usize) -> Prices {
        self.prices.iter().map(|prices| prices[point]).collect()
    }

    /// The same of those that are offered.
    pub fn offered(&self, point: usize) -> Prices {
        let prices = self.prices.iter().zip(&self.dominated);
        prices.map(|(prices, by)| prices[point].filter(|_| by.is_none())).collect()
    }

    /// The methods that are worth their price at one point.
    pub fn front(&self, point: usize) -> Vec<usize> {
        frontier(&self.offered(point))
    }
}

/// Marks what is dominated at every point of all stalls together.
pub fn compare(stalls: &mut [Stall]) {
    let methods = stalls.first().map_or(0, |stall| stall.prices.len());
    let everywhere = (0..methods).map(|method| stalls.iter().flat_map(|stall| stall.prices[method].clone()).collect());
    let dominated = dominated(&everywhere.collect::<Vec<Prices>>());
    stalls.iter_mut().for_each(|stall| stall.dominated.clone_from(&dominated));
}

/// Seconds for one pass.
fn seconds(pass: &dyn Fn(), passes: usize) -> f64 {
    let start = std::time::Instant::now();
    (0..passes).for_each(|_| pass());
    (start.elapsed().as_secs_f64() / passes as f64).max(1e-9)
}
