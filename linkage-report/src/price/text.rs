//! Prices as text.

use core::fmt;

use linkage_dynamics::integrate::Counts;
use linkage_runtime::derivation::Operations;

use super::data::{MethodPrice, QUANTITIES};
use super::effects::EffectPrice;
use super::motion::MotionPrice;
use super::scene::{Order, PartPrice, RunOutcome, ScenePrice, WithoutPrice};
use super::timing::Time;
use crate::report::prose::{end, written};

/// A note under times of code that is not optimised.
pub(super) const UNOPTIMISED: &str = "The times are those of unoptimised code: build with --release.";

/// A time with three digits.
pub(super) fn time(seconds: f64) -> String {
    let (unit, name) = [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns")]
        .into_iter()
        .find(|(unit, _)| seconds >= *unit)
        .unwrap_or((1e-9, "ns"));
    let number = seconds / unit;
    let digits =
        [(100.0, 0), (10.0, 1)].into_iter().find(|(least, _)| number >= *least).map_or(2, |(_, digits)| digits);
    format!("{number:.digits$} {name}")
}

/// An error with two digits.
pub(super) fn error(error: f64) -> String {
    format!("{error:.1e}").replace('-', "−")
}

impl MotionPrice {
    /// The inputs, and what lies at their ends and between: a sentence each.
    pub(super) fn about(&self) -> Vec<String> {
        let name = &self.input.name;
        let at = |input: f64| written((input * 1e6).round() / 1e6, self.input.is_angle);
        let [low, high] = self.asked.map(at);
        let mut about = vec![format!("{} inputs, {name} from {low} to {high}.", self.inputs.len())];
        about.extend(self.gaps.iter().map(|gap| {
            let [low, high] = [gap.from.min(gap.to), gap.from.max(gap.to)].map(at);
            let (from, reason) = (at(gap.from), end(gap.reason));
            format!("No position between {name} = {low} and {high}: the end of the motion at {from} is {reason}.")
        }));
        about.extend(self.change_points.iter().map(|point| {
            format!(
                "At {name} = {} other motions cross: a change point of {}.",
                at(point.input),
                point.groups.join("; ")
            )
        }));
        about.extend(self.left_out.iter().map(|out| format!("Left out: {}.", out.error)));
        let reference = error(self.reference);
        about.push(format!("The reference has 31 digits; the last step of Newton's method to it was {reference}."));
        about
    }

    /// The answer to the question for the fastest method with an error.
    pub(super) fn answer(&self, order: usize, wanted: f64) -> String {
        let Some((fastest, faster)) = self.fastest(order, wanted) else { return "none".to_owned() };
        let of = |method: &MethodPrice| {
            let quantity = &method.quantities[order];
            let largest = quantity.largest().map_or(f64::NAN, |largest| largest);
            (quantity.time.map_or_else(String::new, |of| time(of.median)), error(largest))
        };
        let (seconds, largest) = of(fastest);
        let reason = faster.map_or_else(
            || "none is faster".to_owned(),
            |faster| {
                let (seconds, largest) = of(faster);
                format!("{} takes {seconds}, but its error is {largest}", faster.name)
            },
        );
        format!("{}, {seconds}, error {largest}; {reason}", fastest.name)
    }

    /// The failures of a method, if it has some: their number and the first of them.
    pub(super) fn failure(&self, method: usize, order: usize) -> Option<String> {
        let quantity = &self.methods[method].quantities[order];
        let first = quantity.errors.iter().find_map(|error| error.err())?;
        Some(format!("no result at {} of {} inputs: {first}", quantity.failures(), quantity.errors.len()))
    }
}

/// A table for each quantity: the largest error, the median time, the ratio and the prediction of each method; stars are
/// at those that are clearly more accurate than every faster one.
impl fmt::Display for MotionPrice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: error and time along a motion", self.mechanism)?;
        for about in self.about() {
            writeln!(f, "{about}")?;
        }
        for (order, quantity) in QUANTITIES.iter().enumerate() {
            writeln!(f, "\n{quantity:<26}  error   median       time   ratio  predicted")?;
            let front = self.front(order);
            for (place, method) in self.methods.iter().enumerate() {
                let of = &method.quantities[order];
                let mark = if front.contains(&place) { '*' } else { ' ' };
                write!(f, "{mark} {:<24}", method.name)?;
                if let (Ok(largest), Some(median), Some(measured)) = (of.largest(), of.median(), of.time) {
                    let predicted = of.predicted.map_or_else(String::new, time);
                    let (largest, median, seconds) = (error(largest), error(median), time(measured.median));
                    writeln!(f, "{largest:>8} {median:>8} {seconds:>10} {:7.2} {predicted:>10}", measured.ratio)?;
                } else {
                    writeln!(f, " {}", self.failure(place, order).unwrap_or_default())?;
                }
            }
        }
        writeln!(f)?;
        for wanted in &self.wanted {
            for (order, quantity) in QUANTITIES.iter().enumerate() {
                writeln!(
                    f,
                    "Fastest {quantity} with an error of {}: {}.",
                    error(*wanted),
                    self.answer(order, *wanted)
                )?;
            }
        }
        if self.is_optimised { Ok(()) } else { writeln!(f, "{UNOPTIMISED}") }
    }
}

impl ScenePrice {
    /// The times and the reference: a sentence each.
    pub(super) fn about(&self) -> Vec<String> {
        let [start, end] = self.times;
        let (tolerance, reference) = (error(self.reference), error(self.reference_error));
        vec![
            format!("From t = {start} to {end}."),
            format!(
                "The reference is a simulation in double-double at the tolerance {tolerance}, with {} right-hand sides; at ten times \
                 that tolerance it differs by {reference}. Smaller errors are not resolved.",
                self.reference_evaluations
            ),
        ]
    }

    /// The answer to the question for the fastest run with an error.
    pub(super) fn answer(&self, wanted: f64) -> String {
        let run = self.fastest(wanted).and_then(|run| Some((run, run.outcome.as_ref().ok()?)));
        run.map_or_else(
            || "none".to_owned(),
            |(run, outcome)| {
                format!(
                    "{} at {}, {} right-hand sides, {}, error {}",
                    run.order,
                    error(run.tolerance),
                    outcome.counts.evaluations,
                    outcome.time.map_or_else(String::new, |of| time(of.median)),
                    error(outcome.error)
                )
            },
        )
    }
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Eight => "order 8(5,3)",
            Self::Five => "order 5(4)",
        })
    }
}

/// The numbers of a count of operations: functions, divisions, products, sums.
pub(super) fn operations(of: Operations) -> [usize; 4] {
    [of.functions, of.divisions, of.multiplications, of.additions]
}

/// A table of the runs, of the functions that a step calls, and of the effects; stars are at runs that are clearly more
/// accurate than every faster one.
impl fmt::Display for ScenePrice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: error, right-hand sides and time by tolerance", self.scene)?;
        for about in self.about() {
            writeln!(f, "{about}")?;
        }
        writeln!(f, "\n               tolerance    error   at end  right sides  steps  rejected       time")?;
        let front = self.front();
        for (place, run) in self.runs.iter().enumerate() {
            let mark = if front.contains(&place) { '*' } else { ' ' };
            write!(f, "{mark} {:<13} {:>8} ", run.order, error(run.tolerance))?;
            match &run.outcome {
                Ok(RunOutcome { error: largest, error_at_end, counts, time: of }) => {
                    let seconds = of.map_or_else(String::new, |of| time(of.median));
                    let (largest, at_end) = (error(*largest), error(*error_at_end));
                    let Counts { evaluations, accepted, rejected } = counts;
                    writeln!(f, "{largest:>8} {at_end:>8} {evaluations:12} {accepted:6} {rejected:9} {seconds:>10}")?;
                }
                Err(error) => writeln!(f, " {error}")?,
            }
        }
        writeln!(f, "\nA call                                               time   ratio")?;
        for PartPrice { name, time: of } in &self.parts {
            if let Some(of) = of {
                writeln!(f, "  {name:<44} {:>10} {:7.2}", time(of.median), of.ratio)?;
            }
        }
        writeln!(f, "\nBodies and effects by their formulas  functions  quotients  products  sums    time")?;
        for effect in &self.effects {
            let [functions, divisions, products, sums] = operations(effect.operations);
            let (seconds, calls) = (time(effect.predicted), not_counted(effect));
            writeln!(
                f,
                "  {:<36} {functions:9} {divisions:10} {products:9} {sums:5} {seconds:>7}{calls}",
                effect.name
            )?;
        }
        for WithoutPrice { name, derivative, run, evaluations: [with, without] } in &self.without {
            let ratio = |times: &[Option<Time>; 2]| times[1].map_or(f64::NAN, |time| time.ratio);
            writeln!(
                f,
                "Without {name}: {:.2} of the time of a right-hand side, {without} in place of {with} of them, {:.2} of the time.",
                ratio(derivative),
                ratio(run)
            )?;
        }
        writeln!(f)?;
        for wanted in &self.wanted {
            writeln!(f, "Fastest run with an error of {}: {}.", error(*wanted), self.answer(*wanted))?;
        }
        if self.is_optimised { Ok(()) } else { writeln!(f, "{UNOPTIMISED}") }
    }
}

/// A note of the operations of an effect that are not known.
pub(super) fn not_counted(effect: &EffectPrice) -> String {
    let mut names: Vec<&str> = effect.calls.iter().map(String::as_str).collect();
    names.sort_unstable();
    names.dedup();
    let counted = |name: &&str| {
        let count = effect.calls.iter().filter(|call| call == name).count();
        if count == 1 { (*name).to_owned() } else { format!("{name} {count} times") }
    };
    let mut parts: Vec<String> = names.iter().map(counted).collect();
    if effect.is_shortened {
        parts.push("parts that are not printed".to_owned());
    }
    if parts.is_empty() { String::new() } else { format!(", and {}", parts.join(", ")) }
}
