//! The mechanisms of the gallery in scalars other than doubles, compiled once for the tests that share them.

use std::sync::LazyLock;

use linkage_double::DoubleDouble;
use linkage_gallery::listed::{Listed, ListedWithOrders, all_of, with_orders_of};
use linkage_rounding::Rounded;

static ROUNDED: LazyLock<Vec<&'static dyn Listed<Rounded>>> = LazyLock::new(all_of);
static ROUNDED_WITH_ORDERS: LazyLock<Vec<&'static dyn ListedWithOrders<Rounded>>> = LazyLock::new(with_orders_of);
static DOUBLED: LazyLock<Vec<&'static dyn Listed<DoubleDouble>>> = LazyLock::new(all_of);
static DOUBLED_WITH_ORDERS: LazyLock<Vec<&'static dyn ListedWithOrders<DoubleDouble>>> = LazyLock::new(with_orders_of);

/// All mechanisms in `Rounded`, a number that carries a bound of its rounding error.
#[must_use]
pub fn rounded() -> &'static [&'static dyn Listed<Rounded>] {
    &ROUNDED
}

/// Those that derive higher orders.
#[must_use]
pub fn rounded_with_orders() -> &'static [&'static dyn ListedWithOrders<Rounded>] {
    &ROUNDED_WITH_ORDERS
}

/// All mechanisms in 31 digits.
#[must_use]
pub fn doubled() -> &'static [&'static dyn Listed<DoubleDouble>] {
    &DOUBLED
}

/// Those that derive higher orders.
#[must_use]
pub fn doubled_with_orders() -> &'static [&'static dyn ListedWithOrders<DoubleDouble>] {
    &DOUBLED_WITH_ORDERS
}
