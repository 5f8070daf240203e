//! Prices as text.

use linkage_runtime::derivation::Operations;

use super::effects::EffectPrice;

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

/// The numbers of a count of operations: functions, divisions, products, sums.
pub(super) fn operations(of: Operations) -> [usize; 4] {
    [of.functions, of.divisions, of.multiplications, of.additions]
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
