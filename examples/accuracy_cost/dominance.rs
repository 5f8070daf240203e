//! Which methods another makes superfluous.

use super::frontier::{Price, Prices, SAME_ERROR};

/// Times within this factor are alike: another run gives them in another order.
const SAME_TIME: f64 = 1.1;

/// Clearly less exact than the other, or clearly slower.
fn is_worse(one: Price, other: Price) -> bool {
    one.error > SAME_ERROR * other.error || one.time > SAME_TIME * other.time
}

/// Whether `other` has a result wherever `one` has, nowhere clearly worse in error or time, and somewhere clearly better.
pub fn is_dominated_by(one: &[Option<Price>], other: &[Option<Price>]) -> bool {
    let mut better = false;
    for (one, other) in one.iter().zip(other) {
        match (one, other) {
            (None, _) => {}
            (Some(_), None) => return false,
            (Some(one), Some(other)) if is_worse(*other, *one) => return false,
            (Some(one), Some(other)) => better |= is_worse(*one, *other),
        }
    }
    better
}

/// For each method the one that makes it superfluous at every point, if there is one.
pub fn dominated(methods: &[Prices]) -> Vec<Option<usize>> {
    let by = |one: &Prices| methods.iter().position(|other| is_dominated_by(one, other));
    methods.iter().map(by).collect()
}
