//! The mechanisms, and where they begin.

use linkage::linkage;

include!("../mechanisms/block.rs");
include!("../mechanisms/belt.rs");
include!("../mechanisms/yoke.rs");
include!("../mechanisms/slider_crank_contacts.rs");
include!("../mechanisms/five_bar_contacts.rs");

pub(super) fn block(x: f64) -> BlockCoordinates {
    BlockCoordinates { x, y: x }
}

pub(super) fn pair(theta1: f64, theta4: f64) -> PairCoordinates {
    PairCoordinates { theta2: 0.4, theta3: 1.9, theta1, theta4 }
}
