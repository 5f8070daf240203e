//! Every emitted function of every mechanism of the gallery, against `f64` and `DoubleDouble`.

use std::collections::BTreeMap;

use linkage_double::DoubleDouble;
use linkage_gallery::checks::each;
use linkage_gallery::listed::{Listed, ListedWithOrders, all, same_as, with_orders};
use linkage_oracle::{Oracle, Sample, scalars};
use linkage_rounding::Rounded;

use crate::rounding::poses;
use crate::rounding::results::{Arguments, Results, assembled, given, higher_orders};

/// Poses of each mechanism, if no number is asked for.
const POSES: usize = 5;

/// Mechanisms of equal links, which are in line on some branches: that they are is a decision of the values, and so is the
/// side of the cut of atan2. `DoubleDouble` decides otherwise. Assembled positions are compared in 48 digits only.
const IN_LINE: [&str; 3] = ["five_windows", "one_window", "two_windows"];

/// Errors, bounds and numbers of results.
#[derive(Default)]
pub struct Found {
    /// By function: the errors and bounds in ulps.
    pub ulps: BTreeMap<&'static str, Vec<[f64; 2]>>,
    pub results: usize,
    pub unknown: usize,
    /// Positions at which `DoubleDouble` has other turns.
    pub turned: usize,
}

/// Results in three scalars.
pub struct Three {
    pub plain: Results<f64>,
    pub rounded: Results<Rounded>,
    pub exact: Results<DoubleDouble>,
}

/// True if an angle is on the other side of the cut of atan2 in `DoubleDouble`: then other numbers are computed.
fn is_turned(plain: &Results<f64>, exact: &Results<DoubleDouble>) -> bool {
    let mut pairs = plain.iter().zip(exact).filter(|((name, _), _)| *name == "coordinates");
    pairs.any(|((_, plain), (_, exact))| {
        let (Ok(plain), Ok(exact)) = (plain, exact) else { return false };
        plain.iter().zip(exact).any(|(plain, exact)| (plain - exact.high()).abs() > 6.0)
    })
}

impl Found {
    /// Compares the results: bits, errors, bounds.
    ///
    /// Near a singular position `DoubleDouble`, whose epsilon is smaller, may have a result where `f64` has an error.
    pub fn compare(&mut self, context: &str, Three { plain, rounded, exact }: Three) {
        assert_eq!(plain.len(), rounded.len(), "{context}");
        let exact = if is_turned(&plain, &exact) { Vec::new() } else { exact };
        self.turned += usize::from(exact.is_empty());
        for ((name, plain), (_, rounded)) in plain.iter().zip(&rounded) {
            let (plain, rounded) = match (plain, rounded) {
                (Ok(plain), Ok(rounded)) => (plain, rounded),
                (plain, rounded) => {
                    assert_eq!(plain.as_ref().err(), rounded.as_ref().err(), "{context}: {name}");
                    continue;
                }
            };
            let of_exact = exact.iter().find(|(other, _)| other == name);
            let exact = of_exact.and_then(|(_, exact)| exact.as_ref().ok());
            for (place, (plain, rounded)) in plain.iter().zip(rounded).enumerate() {
                let context = || format!("{context}: {name}[{place}] = {rounded:?}");
                let has_bits = plain.to_bits() == rounded.value().to_bits();
                assert!(has_bits, "{}: {plain}", context());
                self.results += 1;
                if !rounded.error().is_finite() {
                    self.unknown += 1;
                    continue;
                }
                let Some(exact) = exact else { continue };
                let error = exact[place] - DoubleDouble::from(rounded.value());
                let error = error.high().abs();
                // The error of the 31 digits, as large relative to the bound as theirs to those of a double.
                let slack = 1e-12 * rounded.error() + 1e-28 * plain.abs();
                assert!(error <= rounded.error() + slack, "{}, off by {error:e}", context());
                let ulp = Rounded::with_error(*plain, 1.0).ulps();
                self.ulps.entry(name).or_default().push([error * ulp, rounded.ulps()]);
            }
        }
    }
}

pub fn arguments(sample: Sample) -> Arguments<f64> {
    let Sample { parameters, q, rates, accelerations, .. } = sample;
    Arguments { parameters, q, rates, accelerations }
}

#[test]
fn results_are_within_their_bounds() {
    each(all(), |of| within_their_bounds(of, same_as(scalars::rounded(), of), same_as(scalars::doubled(), of)));
}

fn within_their_bounds(of: &dyn Listed<f64>, rounded: &dyn Listed<Rounded>, doubled: &dyn Listed<DoubleDouble>) {
    let (mut at_given, mut at_assembled) = (Found::default(), Found::default());
    for (number, sample) in Oracle::of(of).samples(poses(POSES)).enumerate() {
        let plain = arguments(sample);
        let (with_bounds, exact) = (plain.map(Rounded::from), plain.map(DoubleDouble::from));
        let three =
            Three { plain: given(of, &plain), rounded: given(rounded, &with_bounds), exact: given(doubled, &exact) };
        at_given.compare(&format!("{} {number}", of.file()), three);
        let branch = number % of.branch_count();
        let three = Three {
            plain: assembled(of, &plain, branch),
            rounded: assembled(rounded, &with_bounds, branch),
            exact: if IN_LINE.contains(&of.file()) { Vec::new() } else { assembled(doubled, &exact, branch) },
        };
        at_assembled.compare(&format!("{} {number} assembled", of.file()), three);
    }
    for (place, found) in [("given", at_given), ("assembled", at_assembled)] {
        println!(
            "{} {place}: {} results, {} unknown, {} turned",
            of.file(),
            found.results,
            found.unknown,
            found.turned
        );
        let is_allowed = IN_LINE.contains(&of.file()) || 10 * found.turned <= poses(POSES);
        assert!(is_allowed, "{}: {} positions have other turns", of.file(), found.turned);
        found.report(&["velocity", "acceleration"]);
    }
}

impl Found {
    /// Writes the medians of errors and bounds.
    pub fn report(&self, names: &[&str]) {
        for name in names {
            let Some(ulps) = self.ulps.get(name) else { continue };
            let [error, bound] = [0, 1].map(|kind| median(ulps.iter().map(|pair| pair[kind])));
            println!("    {name}: median error {error:.2} ulp, bound {bound:.2} ulp, {:.1}", bound / error);
        }
    }
}

/// The median; NaN of nothing.
pub fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut all: Vec<f64> = numbers.collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
}

#[test]
fn higher_orders_are_within_their_bounds() {
    each(with_orders(), |of| {
        let (rounded, doubled) = (scalars::rounded_with_orders(), scalars::doubled_with_orders());
        higher_orders_within_their_bounds(of, same_as(rounded, of), same_as(doubled, of));
    });
}

fn higher_orders_within_their_bounds(
    of: &dyn ListedWithOrders<f64>,
    rounded: &dyn ListedWithOrders<Rounded>,
    doubled: &dyn ListedWithOrders<DoubleDouble>,
) {
    let mut found = Found::default();
    for (number, sample) in Oracle::of(of).samples(poses(POSES)).enumerate() {
        let plain = arguments(sample);
        let three = Three {
            plain: higher_orders(of, &plain),
            rounded: higher_orders(rounded, &plain.map(Rounded::from)),
            exact: higher_orders(doubled, &plain.map(DoubleDouble::from)),
        };
        found.compare(&format!("{} {number}", of.file()), three);
    }
    println!("{}: {} results of higher order, {} unknown", of.file(), found.results, found.unknown);
}
