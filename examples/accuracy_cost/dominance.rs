//! Dominated methods.

use linkage::price::{Cost, SAME_ERROR};

/// Times within this factor count as equal: their order changes from run to run.
const SAME_TIME: f64 = 1.1;

/// Returns true if the error or the time is clearly larger.
fn is_worse(one: Cost, other: Cost) -> bool {
    one.error > SAME_ERROR * other.error || one.time > SAME_TIME * other.time
}

/// Returns true if `other` has a result wherever `one` has, is nowhere clearly worse, and is somewhere clearly better.
pub fn is_dominated_by(one: &[Option<Cost>], other: &[Option<Cost>]) -> bool {
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

/// For each method, one that dominates it over all points, or None.
pub fn dominated(methods: &[Vec<Option<Cost>>]) -> Vec<Option<usize>> {
    let by = |one: &Vec<Option<Cost>>| methods.iter().position(|other| is_dominated_by(one, other));
    methods.iter().map(by).collect()
}
