//! All runs of all methods, evaluated and timed.

use std::time::Instant;

use linkage::price::{Cost, cheapest, frontier};

/// A curve of the charts.
pub struct Method {
    pub name: &'static str,
    /// The colour of its curve.
    pub colour: usize,
    /// True for methods of order 5.
    pub is_dashed: bool,
    /// The kind of its settings.
    pub setting: Setting,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Setting {
    Tolerance,
    Step,
}

const fn method(name: &'static str, colour: usize, is_dashed: bool, setting: Setting) -> Method {
    Method { name, colour, is_dashed, setting }
}

pub const SIMULATE_8: usize = 0;
pub const SIMULATE_5: usize = 1;
pub const INTEGRATE_8: usize = 2;
pub const INTEGRATE_5: usize = 3;
pub const ODE_SOLVERS_8: usize = 4;
pub const ODE_SOLVERS_5: usize = 5;
pub const DIFFERENTIAL_EQUATIONS_8: usize = 6;
pub const DIFFERENTIAL_EQUATIONS_5: usize = 7;
pub const REAL_TIME: usize = 9;
pub const ACCELERATIONS: usize = 10;
pub const WEAKLY: usize = 11;
pub const STRONGLY: usize = 12;
pub const PROJECTED: usize = 13;

/// All methods, in the order of the tables.
pub const METHODS: [Method; 14] = [
    method("simulate, 8(5,3)", 0, false, Setting::Tolerance),
    method("simulate, 5(4)", 0, true, Setting::Tolerance),
    method("integrate, 8(5,3)", 8, false, Setting::Tolerance),
    method("integrate, 5(4)", 8, true, Setting::Tolerance),
    method("ode_solvers, 8(5,3)", 1, false, Setting::Tolerance),
    method("ode_solvers, 5(4)", 1, true, Setting::Tolerance),
    method("differential-equations, 8(5,3)", 2, false, Setting::Tolerance),
    method("differential-equations, 5(4)", 2, true, Setting::Tolerance),
    method("diffsol, Tsitouras 5(4)", 4, true, Setting::Tolerance),
    method("RealTime, order 4", 6, false, Setting::Step),
    method("index 1, order 4", 7, false, Setting::Step),
    method("index 1, Baumgarte weak", 5, false, Setting::Step),
    method("index 1, Baumgarte strong", 9, false, Setting::Step),
    method("index 1, projected", 3, false, Setting::Step),
];

/// The result of a run.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// The largest error of an angle, in radians.
    pub error: f64,
    /// The largest residual of the constraints at the end, in metres.
    pub gap: f64,
    /// The evaluations of the right-hand side.
    pub evaluations: usize,
}

/// One method at one setting.
pub struct Work {
    pub method: usize,
    /// The tolerance, or the step in seconds.
    pub setting: f64,
    pub run: Box<dyn Fn() -> Result<Outcome, String>>,
}

/// A run with its result and time, or its error.
pub struct Row {
    pub method: usize,
    pub setting: f64,
    pub outcome: Result<(Outcome, Cost), String>,
}

/// All runs for one mechanism.
pub struct List {
    pub title: &'static str,
    pub about: &'static str,
    pub rows: Vec<Row>,
}

/// Runs longer than this, in seconds, are timed fewer times.
const LONG: f64 = 1e-2;
const ROUNDS_OF_LONG: usize = 3;

/// Errors are raised to this value for the logarithmic axis: smaller ones are coincidences of rounding errors.
const LEAST: f64 = 1e-17;

fn timed(work: &Work) -> (Result<Outcome, String>, f64) {
    let clock = Instant::now();
    let outcome = std::hint::black_box((work.run)());
    (outcome, clock.elapsed().as_secs_f64())
}

impl List {
    /// Times all runs alternately, `rounds` times, and keeps the medians.
    pub fn open(title: &'static str, about: &'static str, works: Vec<Work>, rounds: usize) -> Self {
        let (outcomes, mut times): (Vec<_>, Vec<_>) =
            works.iter().map(timed).map(|(outcome, time)| (outcome, vec![time])).unzip();
        for round in 1..rounds {
            for ((work, outcome), times) in works.iter().zip(&outcomes).zip(&mut times) {
                if outcome.is_ok() && (round < ROUNDS_OF_LONG || times[0] < LONG) {
                    times.push(timed(work).1);
                }
            }
        }
        let rows = works.into_iter().zip(outcomes).zip(times).map(|((work, outcome), mut times)| {
            times.sort_by(f64::total_cmp);
            let priced = |outcome: Outcome| {
                let price = Cost { error: outcome.error.max(LEAST), time: times[times.len() / 2] };
                if outcome.error.is_finite() { Ok((outcome, price)) } else { Err("the error is NaN".to_owned()) }
            };
            Row { method: work.method, setting: work.setting, outcome: outcome.and_then(priced) }
        });
        Self { title, about, rows: rows.collect() }
    }

    /// Error and time of each row.
    pub fn costs(&self) -> Vec<Option<Cost>> {
        self.rows.iter().map(|row| row.outcome.as_ref().ok().map(|(_, price)| *price)).collect()
    }

    /// The rows that are clearly more accurate than every faster one.
    pub fn front(&self) -> Vec<usize> {
        frontier(&self.costs())
    }

    /// The fastest row of these methods with at most this error.
    pub fn cheapest(&self, methods: &[usize], error: f64) -> Option<(&Row, Outcome, Cost)> {
        let priced = self.rows.iter().zip(self.costs());
        let costs: Vec<Option<Cost>> =
            priced.map(|(row, price)| price.filter(|_| methods.contains(&row.method))).collect();
        let (index, _) = cheapest(&costs, error)?;
        let row = &self.rows[index];
        row.outcome.as_ref().ok().map(|&(outcome, price)| (row, outcome, price))
    }

    /// The result of a method at a setting.
    pub fn at(&self, method: usize, setting: f64) -> Option<(Outcome, Cost)> {
        let is_it = |row: &&Row| row.method == method && (row.setting / setting - 1.0).abs() < 1e-9;
        self.rows.iter().find(is_it)?.outcome.as_ref().ok().copied()
    }
}
