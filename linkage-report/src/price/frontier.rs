//! The Pareto front of error and time.

/// An error and the time that it takes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Cost {
    /// The largest error.
    pub error: f64,
    /// The time.
    pub time: f64,
}

/// Errors within this factor count as equal: with few poses the largest rounding error varies by about three bits.
pub const SAME_ERROR: f64 = 8.0;

/// The places of the costs that are clearly more accurate than every faster one, by rising time.
#[must_use]
pub fn frontier(costs: &[Option<Cost>]) -> Vec<usize> {
    let mut order = by_time(costs);
    let mut least = f64::INFINITY;
    order.retain(|(_, cost)| {
        let is_kept = SAME_ERROR * cost.error < least;
        if is_kept {
            least = cost.error;
        }
        is_kept
    });
    order.into_iter().map(|(place, _)| place).collect()
}

/// The place of the fastest with at most this error, and of the next faster one, if there is one.
#[must_use]
pub fn cheapest(costs: &[Option<Cost>], error: f64) -> Option<(usize, Option<usize>)> {
    let order = by_time(costs);
    let found = order.iter().position(|(_, cost)| cost.error <= error)?;
    Some((order[found].0, found.checked_sub(1).map(|before| order[before].0)))
}

fn by_time(costs: &[Option<Cost>]) -> Vec<(usize, Cost)> {
    let known = costs.iter().enumerate().filter_map(|(place, cost)| cost.map(|cost| (place, cost)));
    let mut order: Vec<(usize, Cost)> = known.collect();
    order.sort_by(|(_, one), (_, other)| one.time.total_cmp(&other.time).then(one.error.total_cmp(&other.error)));
    order
}
