//! A six-bar as a leg, and the numbers by which legs are compared.
//!
//! The case columns of `six_bar` are those of a turn of the crank at constant speed. They are null if a design does not
//! assemble in all positions.
//!
//! | column | meaning |
//! |---|---|
//! | `distance` | root mean square of the distances from the path of the foot to a [given curve](FootPath), position by position, after the [best fit](Fit), relative to the width of the curve |
//! | `min_mu` | least transmission angle in radians, from 0 at a dead point to a right angle: of coupler and rocker, or of leg and lever |
//! | `size` | larger side of the box around all points in all positions after the fit, relative to the width of the curve |
//! | `clearance` | height of the lowest joint in all positions after the fit above the lowest point of the curve, relative to its width |
//!
//! The curve is known at numbers of positions that divide 720; at others all but `min_mu` are null.

mod curve;
mod family;
mod fit;
mod machine;
mod measures;

pub(super) use family::family;

pub use curve::FootPath;
pub use fit::Fit;
pub use machine::{SixBar, SixBarBranch};
