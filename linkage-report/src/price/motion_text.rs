//! The price of a motion as text.

use core::fmt;

use super::data::{MethodPrice, QUANTITIES};
use super::motion::MotionPrice;
use super::text::{UNOPTIMISED, error, time};
use crate::report::prose::{end, written};

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
