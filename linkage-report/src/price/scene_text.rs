//! The price of a scene as text.

use core::fmt;

use linkage_dynamics::integrate::Counts;

use super::parts::PartPrice;
use super::runs::Order;
use super::scene::{RunOutcome, ScenePrice, WithoutPrice};
use super::text::{UNOPTIMISED, error, not_counted, operations, time};
use super::timing::Time;

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
