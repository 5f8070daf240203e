//! How many cases a test tries, and which: the inner ring tries few, other ones for each commit, the outer ring tries all.
//!
//! `RING=outer` is the outer ring. A number for a test, such as `POSES=1000`, stands above both rings. `SEED` is a hexadecimal
//! number, such as that of a commit, from which random cases are drawn; without it each test draws those of its own seed.

use std::env;
use std::str::FromStr;

/// True in the outer ring.
#[must_use]
pub fn is_outer() -> bool {
    match env::var("RING") {
        Ok(ring) if ring == "outer" => true,
        Ok(ring) if ring != "inner" => panic!("RING is `inner` or `outer`, not `{ring}`"),
        _ => false,
    }
}

/// The number of cases: that of a variable of the environment, or that of the ring.
///
/// # Panics
///
/// If the variable holds no number.
#[must_use]
pub fn count<N: FromStr>(variable: &str, inner: N, outer: N) -> N {
    match env::var(variable) {
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{variable}={text} is no number of cases")),
        Err(_) if is_outer() => outer,
        Err(_) => inner,
    }
}

/// The seed of random cases that differ from commit to commit: `own`, changed by the variable `SEED`.
///
/// # Panics
///
/// If the variable holds no hexadecimal number of at most sixteen digits.
#[must_use]
pub fn seed(own: u64) -> u64 {
    let of_commit = env::var("SEED").map_or(0, |text| {
        u64::from_str_radix(&text, 16).unwrap_or_else(|_| panic!("SEED={text} is no hexadecimal number of 16 digits"))
    });
    // An odd factor: neighbouring commits have seeds far apart, and no commit leaves the own seed.
    own ^ of_commit.wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// All cases in the outer ring; in the inner ring one of so many, other ones for each commit.
pub fn some<T>(cases: impl IntoIterator<Item = T>, of: usize) -> impl Iterator<Item = T> {
    let step = if is_outer() { 1 } else { of };
    let first = (seed(0) % step as u64) as usize;
    cases.into_iter().skip(first).step_by(step)
}
