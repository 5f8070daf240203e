//! Which of several methods are worth their price.

/// What a method costs at one point: its largest error and its time in nanoseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Price {
    pub error: f64,
    pub time: f64,
}

/// Errors within this factor are alike: three bits are what roundings happen to do at a few poses.
pub const SAME_ERROR: f64 = 8.0;

/// The price of each point where there is a result.
pub type Prices = Vec<Option<Price>>;

/// The methods at one point of which each is clearly more exact than all that are faster, by rising time.
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

/// The least time among those as exact as this, and what is faster but not, if anything is.
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
