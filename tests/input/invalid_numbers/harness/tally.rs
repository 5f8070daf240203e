//! The outcomes of the calls.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::ops::AddAssign;
use std::panic::{AssertUnwindSafe, catch_unwind};

use linkage::Error;

use super::Source;
use super::finite::{all_finite, is_finite};

thread_local! {
    static EVALUATIONS: Cell<u64> = const { Cell::new(0) };
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Counts one evaluation: of a position, of the equations of motion, of a user function.
pub fn evaluated() {
    EVALUATIONS.set(EVALUATIONS.get() + 1);
}

/// Keeps the message of a panic.
pub fn listen() {
    std::panic::set_hook(Box::new(|panic| PANIC.with_borrow_mut(|said| *said = panic.to_string())));
}

/// The calls of one function.
#[derive(Default, Clone)]
struct Row {
    calls: u64,
    finite: u64,
    /// By the error: of inputs, positions, paths and motions; last those of functions whose results are texts.
    errors: [u64; 5],
    not_finite: u64,
    panics: u64,
    /// The most evaluations of one call.
    evaluations: u64,
}

/// The calls of the functions of one mechanism, or of all.
#[derive(Default)]
pub struct Tally {
    rows: BTreeMap<Name, Row>,
}

/// A function and its type; an algorithm has none.
type Name = (&'static str, &'static str);

/// The number of failures of each function that are printed.
const EXAMPLES: u64 = 2;

/// The limit of evaluations of one call: Newton's method at most 60 steps of 40 halvings each, a search for limits in
/// 720 steps with a closer search at each, a path 20 steps of 64 trials, a simulation 60 steps, and dense output four
/// states of one simulation in one call. The largest of 3.6e8 calls was such a call, 259 059.
const MOST_EVALUATIONS: u64 = 400_000;

impl Tally {
    /// A call that may return an error; its result if there is one and all numbers are finite.
    pub fn fallible<R: Debug, E: Into<Error>>(
        &mut self,
        source: &Source,
        name: &'static str,
        call: impl FnOnce() -> Result<R, E>,
    ) -> Option<R> {
        let (result, row) = self.call(source.seed, ("", name), call)?;
        match result {
            Ok(result) if is_finite(&result) => {
                row.finite += 1;
                return Some(result);
            }
            Ok(result) => {
                row.not_finite += 1;
                if row.not_finite <= EXAMPLES {
                    println!("  {name} seed {}: {result:?}", source.seed);
                }
            }
            Err(error) => {
                let kind = match error.into() {
                    Error::Input(_) => 0,
                    Error::Position(_) => 1,
                    Error::Path(_) => 2,
                    Error::Motion(_) => 3,
                    other => panic!("an error of a new kind: {other:?}"),
                };
                row.errors[kind] += 1;
            }
        }
        None
    }

    /// A call that gives several results, each of which may be an error.
    pub fn each<R: Debug, E: Into<Error>>(
        &mut self,
        source: &Source,
        name: &'static str,
        call: impl FnOnce() -> Vec<Result<R, E>>,
    ) {
        let results = self.call(source.seed, ("", name), call).map(|(results, _)| results);
        for result in results.into_iter().flatten() {
            self.fallible(source, name, || result);
        }
    }

    /// A call that always gives a result, which is not checked here.
    pub fn total<R>(&mut self, source: &Source, name: &'static str, call: impl FnOnce() -> R) -> Option<R> {
        let (result, row) = self.call(source.seed, ("", name), call)?;
        row.finite += 1;
        Some(result)
    }

    /// A call whose result is a text. One of a function without `Result` is not checked: its docs say what it gives for invalid
    /// numbers.
    pub fn text(&mut self, seed: u64, name: Name, call: impl FnOnce() -> String) {
        let Some((result, row)) = self.call(seed, name, call) else { return };
        if result.starts_with("Err(") {
            row.errors[4] += 1;
        } else if result.starts_with("Ok(") && !all_finite(&result) {
            row.not_finite += 1;
            if row.not_finite <= EXAMPLES {
                println!("  {}::{} seed {seed}: {result}", name.0, name.1);
            }
        } else {
            row.finite += 1;
        }
    }

    fn call<R>(&mut self, seed: u64, name: Name, call: impl FnOnce() -> R) -> Option<(R, &mut Row)> {
        let row = self.rows.entry(name).or_default();
        row.calls += 1;
        let before = EVALUATIONS.get();
        let result = catch_unwind(AssertUnwindSafe(call));
        row.evaluations = row.evaluations.max(EVALUATIONS.get() - before);
        if result.is_err() {
            row.panics += 1;
            if row.panics <= EXAMPLES {
                println!("  {}::{} seed {seed}: {}", name.0, name.1, PANIC.take());
            }
        }
        result.ok().map(|result| (result, row))
    }

    /// Checks that no result is infinite or NaN, that nothing panicked, and that no call exceeded the limit of
    /// evaluations.
    pub fn is_clean(&self) -> bool {
        self.rows.values().all(|row| row.not_finite == 0 && row.panics == 0 && row.evaluations <= MOST_EVALUATIONS)
    }

    pub fn tell(&self, name: &str) {
        let sum = |number: fn(&Row) -> u64| self.rows.values().map(number).sum::<u64>();
        let [calls, finite] = [sum(|row| row.calls), sum(|row| row.finite)];
        let errors = [0, 1, 2, 3, 4].map(|kind| self.rows.values().map(|row| row.errors[kind]).sum::<u64>());
        let [not_finite, panics] = [sum(|row| row.not_finite), sum(|row| row.panics)];
        let most = self.rows.values().map(|row| row.evaluations).max().unwrap_or_default();
        println!(
            "{name}: {calls} calls of {} functions, {finite} finite, errors of input, position, path, motion, functions {errors:?}, \
             {not_finite} not finite, {panics} panics, at most {most} evaluations",
            self.rows.len()
        );
        for ((of, function), row) in &self.rows {
            let is_wrong = row.not_finite > 0 || row.panics > 0 || row.evaluations > MOST_EVALUATIONS;
            if is_wrong || (name == "all" && of.is_empty()) {
                println!(
                    "  {of}::{function}: {} calls, {} finite, {:?} errors, {} not finite, {} panics, at most {} evaluations",
                    row.calls, row.finite, row.errors, row.not_finite, row.panics, row.evaluations
                );
            }
        }
        let fewest = self.rows.iter().filter(|((of, _), _)| !of.is_empty()).min_by_key(|(_, row)| row.calls);
        if let Some(((of, function), row)) = fewest.filter(|_| name == "all") {
            println!("  fewest: {} calls of {of}::{function}", row.calls);
        }
    }
}

impl AddAssign<&Self> for Tally {
    fn add_assign(&mut self, other: &Self) {
        for (name, row) in &other.rows {
            let sum = self.rows.entry(*name).or_default();
            sum.calls += row.calls;
            sum.finite += row.finite;
            for (sum, errors) in sum.errors.iter_mut().zip(row.errors) {
                *sum += errors;
            }
            sum.not_finite += row.not_finite;
            sum.panics += row.panics;
            sum.evaluations = sum.evaluations.max(row.evaluations);
        }
    }
}
