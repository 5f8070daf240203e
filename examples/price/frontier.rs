//! The Pareto front of error and time.

/// The largest error of a method at one point, and its time in nanoseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Price {
    pub error: f64,
    pub time: f64,
}

/// Errors within this factor count as equal: with few poses the largest rounding error varies by about three bits.
pub const SAME_ERROR: f64 = 8.0;

/// Error and time of each method or run; None without a result.
pub type Prices = Vec<Option<Price>>;

/// Returns the methods at one point that are clearly more accurate than every faster one, by rising time.
pub fn frontier(prices: &[Option<Price>]) -> Vec<usize> {
    let mut order = by_time(prices);
    let mut least = f64::INFINITY;
    order.retain(|(_, price)| {
        let is_kept = SAME_ERROR * price.error < least;
        if is_kept {
            least = price.error;
        }
        is_kept
    });
    order.into_iter().map(|(index, _)| index).collect()
}

/// Returns the fastest method with at most this error, and the next faster method, if there is one.
pub fn cheapest(prices: &[Option<Price>], error: f64) -> Option<(usize, Option<usize>)> {
    let order = by_time(prices);
    let place = order.iter().position(|(_, price)| price.error <= error)?;
    Some((order[place].0, place.checked_sub(1).map(|place| order[place].0)))
}

fn by_time(prices: &[Option<Price>]) -> Vec<(usize, Price)> {
    let known = prices.iter().enumerate().filter_map(|(index, price)| price.map(|price| (index, price)));
    let mut order: Vec<(usize, Price)> = known.collect();
    order.sort_by(|(_, a), (_, b)| a.time.total_cmp(&b.time).then(a.error.total_cmp(&b.error)));
    order
}
