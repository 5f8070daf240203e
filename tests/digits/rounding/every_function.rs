//! Every emitted function of every mechanism of the gallery, against `f64` and `DoubleDouble`.

use std::collections::BTreeMap;

use linkage_double::DoubleDouble;
use linkage_gallery::{Fixture, WithHigherOrders, all_mechanisms};
use linkage_oracle::{Oracle, Sample};
use linkage_rounding::Rounded;

use crate::rounding::poses;
use crate::rounding::results::{Arguments, Results, assembled, given, higher_orders};

/// Poses of each mechanism, if no number is asked for.
const POSES: usize = 5;

/// Mechanisms with user functions that call the platform's sine, in place of which `Rounded` has the runtime's.
const WITH_LAWS: [&str; 2] = ["cam_follower", "cam_rocker"];

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
                assert!(has_bits || WITH_LAWS.iter().any(|file| context().starts_with(file)), "{}: {plain}", context());
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

fn within_their_bounds<F: Fixture>() {
    let (mut at_given, mut at_assembled) = (Found::default(), Found::default());
    for (number, sample) in Oracle::of::<F>().samples(poses(POSES)).enumerate() {
        let plain = arguments(sample);
        let (rounded, exact) = (plain.map(Rounded::from), plain.map(DoubleDouble::from));
        let three = Three {
            plain: given::<f64, F>(&plain),
            rounded: given::<Rounded, F::Of<Rounded>>(&rounded),
            exact: given::<DoubleDouble, F::Of<DoubleDouble>>(&exact),
        };
        at_given.compare(&format!("{} {number}", F::FILE), three);
        let branch = number % F::branch_count();
        let three = Three {
            plain: assembled::<f64, F>(&plain, branch),
            rounded: assembled::<Rounded, F::Of<Rounded>>(&rounded, branch),
            exact: if IN_LINE.contains(&F::FILE) {
                Vec::new()
            } else {
                assembled::<DoubleDouble, F::Of<DoubleDouble>>(&exact, branch)
            },
        };
        at_assembled.compare(&format!("{} {number} assembled", F::FILE), three);
    }
    for (place, found) in [("given", at_given), ("assembled", at_assembled)] {
        println!("{} {place}: {} results, {} unknown, {} turned", F::FILE, found.results, found.unknown, found.turned);
        let is_allowed = IN_LINE.contains(&F::FILE) || 10 * found.turned <= poses(POSES);
        assert!(is_allowed, "{}: {} positions have other turns", F::FILE, found.turned);
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

fn higher_orders_within_their_bounds<F: WithHigherOrders>() {
    let mut found = Found::default();
    for (number, sample) in Oracle::of::<F>().samples(poses(POSES)).enumerate() {
        let plain = arguments(sample);
        let three = Three {
            plain: higher_orders::<f64, F>(&plain),
            rounded: higher_orders::<Rounded, F::OfOrders<Rounded>>(&plain.map(Rounded::from)),
            exact: higher_orders::<DoubleDouble, F::OfOrders<DoubleDouble>>(&plain.map(DoubleDouble::from)),
        };
        found.compare(&format!("{} {number}", F::FILE), three);
    }
    println!("{}: {} results of higher order, {} unknown", F::FILE, found.results, found.unknown);
}

macro_rules! tests {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {$(
        mod $file {
            use linkage_gallery::$file::{$($Mechanism),+};

            #[test]
            fn results_are_within_their_bounds() {
                $(super::within_their_bounds::<$Mechanism>();)+
            }

            tests!(@ $($orders)? $($Mechanism)+);
        }
    )*};
    (@ orders $Mechanism:ident) => {
        #[test]
        fn higher_orders() {
            super::higher_orders_within_their_bounds::<$Mechanism>();
        }
    };
    (@ $($Mechanism:ident)+) => {};
}

all_mechanisms!(tests);
