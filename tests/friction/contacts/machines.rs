//! The mechanisms, and where they begin.

pub use linkage_gallery::belt::*;
pub use linkage_gallery::block::*;
pub use linkage_gallery::five_bar_contacts::*;
pub use linkage_gallery::slider_crank_contacts::*;
pub use linkage_gallery::yoke::*;

pub(super) fn block(x: f64) -> BlockCoordinates {
    BlockCoordinates { x, y: x }
}

pub(super) fn pair(theta1: f64, theta4: f64) -> PairCoordinates {
    PairCoordinates { theta2: 0.4, theta3: 1.9, theta1, theta4 }
}
