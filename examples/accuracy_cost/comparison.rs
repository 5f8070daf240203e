//! The methods for one mechanism, evaluated and timed.

use linkage::PositionError;
use linkage::price::{Cost, frontier};

use crate::motion::Motion;
use linkage_examples::accuracy_cost::dominance::dominated;
use linkage_examples::accuracy_cost::oracle::Poses;

/// The computed quantities, by order of derivative.
pub const QUANTITIES: [&str; 3] = ["position", "velocity", "acceleration"];

/// A kind of pose and a quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    pub pose: String,
    pub angles_given: bool,
    /// The dead points between which the inputs lie.
    pub dead: Vec<f64>,
    pub order: usize,
}

impl Point {
    /// True if the inputs lie along a motion.
    pub fn is_motion(&self) -> bool {
        ["turn", "range"].contains(&&*self.pose)
    }
}

/// One method at one point.
pub struct Work {
    pub method: &'static str,
    pub point: Point,
    /// The error of each case, or the error value of the method.
    pub errors: Vec<Result<f64, PositionError>>,
    /// The input of each case.
    pub inputs: Vec<f64>,
    /// Seconds by the operations of one evaluation.
    pub predicted: Option<f64>,
    /// Evaluates all cases once and drops the results.
    pub pass: Box<dyn Fn()>,
}

/// Error and time of each method at each point, for one mechanism.
pub struct Comparison {
    pub mechanism: &'static str,
    pub points: Vec<Point>,
    pub costs: Vec<Vec<Option<Cost>>>,
    /// The predicted seconds, by method and point.
    pub predicted: Vec<Vec<Option<f64>>>,
    /// The errors along motions.
    pub motions: Vec<Motion>,
    /// The errors of methods that failed: method, point, error.
    pub failures: Vec<(usize, usize, PositionError)>,
    /// For each method, one that dominates it on all mechanisms, or None.
    pub dominated: Vec<Option<usize>>,
}

impl Work {
    /// The largest error, or the first error value; a NaN returned as Ok is turned into an error.
    fn error(&self) -> Result<f64, PositionError> {
        let mut largest = 0.0_f64;
        for error in &self.errors {
            largest = largest.max((*error)?);
        }
        let silent = PositionError::NotFinite { mechanism: "the mechanism", quantity: "a result returned as Ok" };
        if largest.is_finite() { Ok(largest) } else { Err(silent) }
    }
}

pub fn points(poses: &Poses) -> impl Iterator<Item = Point> {
    let first = usize::from(poses.angles_given);
    (first..3).map(|order| Point {
        pose: poses.pose.clone(),
        angles_given: poses.angles_given,
        dead: poses.dead.clone(),
        order,
    })
}

impl Comparison {
    /// Times all works alternately, `rounds` times, and keeps the medians.
    pub fn measure(
        mechanism: &'static str,
        methods: &[&'static str],
        works: Vec<Work>,
        rounds: usize,
        span: f64,
    ) -> Self {
        let (along, works) = works.into_iter().partition(|work| work.point.is_motion());
        let motions = Motion::all(along);
        let works: Vec<Work> = works;
        let mut points: Vec<Point> = Vec::new();
        for work in &works {
            if !points.contains(&work.point) {
                points.push(work.point.clone());
            }
        }
        let mut times = vec![Vec::with_capacity(rounds); works.len()];
        // The number of passes that fill `span`, measured once.
        let passes: Vec<usize> =
            works.iter().map(|work| (span / seconds(&*work.pass, 2)).ceil().max(1.0) as usize).collect();
        for _ in 0..rounds {
            for ((work, times), &passes) in works.iter().zip(&mut times).zip(&passes) {
                if work.errors.iter().all(Result::is_ok) {
                    times.push(seconds(&*work.pass, passes) / work.inputs.len() as f64);
                }
            }
        }
        let mut costs = vec![vec![None; points.len()]; methods.len()];
        let mut predicted = vec![vec![None; points.len()]; methods.len()];
        let mut failures = Vec::new();
        for (work, mut times) in works.into_iter().zip(times) {
            let method = methods.iter().position(|name| *name == work.method).expect("a method of the list");
            let point = points.iter().position(|point| *point == work.point).expect("a point of the list");
            times.sort_by(f64::total_cmp);
            predicted[method][point] = work.predicted;
            match work.error() {
                Ok(error) => costs[method][point] = Some(Cost { error, time: times[times.len() / 2] }),
                Err(error) => failures.push((method, point, error)),
            }
        }
        Self { mechanism, points, costs, predicted, motions, failures, dominated: vec![None; methods.len()] }
    }

    /// Error and time of each method at one point.
    pub fn at(&self, point: usize) -> Vec<Option<Cost>> {
        self.costs.iter().map(|costs| costs[point]).collect()
    }

    /// Error and time of the methods that are not dominated, at one point.
    pub fn offered(&self, point: usize) -> Vec<Option<Cost>> {
        let costs = self.costs.iter().zip(&self.dominated);
        costs.map(|(costs, by)| costs[point].filter(|_| by.is_none())).collect()
    }

    /// The methods on the Pareto front at one point.
    pub fn front(&self, point: usize) -> Vec<usize> {
        frontier(&self.offered(point))
    }
}

/// Marks the methods that are dominated over all points of all mechanisms.
pub fn compare(comparisons: &mut [Comparison]) {
    let methods = comparisons.first().map_or(0, |comparison| comparison.costs.len());
    let everywhere =
        (0..methods).map(|method| comparisons.iter().flat_map(|comparison| comparison.costs[method].clone()).collect());
    let dominated = dominated(&everywhere.collect::<Vec<Vec<Option<Cost>>>>());
    comparisons.iter_mut().for_each(|comparison| comparison.dominated.clone_from(&dominated));
}

/// The seconds for one pass.
fn seconds(pass: &dyn Fn(), passes: usize) -> f64 {
    let start = std::time::Instant::now();
    (0..passes).for_each(|_| pass());
    (start.elapsed().as_secs_f64() / passes as f64).max(1e-9)
}
