//! The six-bar as a table, with the numbers by which legs are compared.

use std::sync::Arc;

use linkage::Elbow;

use super::measures::{clearance, fit, foot, least_transmission, points, sines, size};
use super::{FootPath, SixBar, SixBarBranch};
use crate::{EngineError, Family};

/// The six-bar with the case columns `distance`, `min_mu`, `size` and `clearance`. The branches are named by the side of Q
/// on the way from P to F.
///
/// # Errors
/// [`EngineError::Sweep`], if the given curve cannot be computed.
pub fn family() -> Result<Family<SixBar<f64>>, EngineError> {
    let curve = Arc::new(FootPath::new()?);
    let [of_distance, of_size, of_clearance] = [&curve, &curve, &curve].map(Arc::clone);
    let branch = |elbow| SixBarBranch::new(Elbow::Left, elbow);
    Ok(Family::new(SixBar::default(), branch(Elbow::Right))
        .branch("left", branch(Elbow::Left))
        .branch("right", branch(Elbow::Right))
        .case_column("distance", foot(), move |case| fit(&of_distance, case).map(|fit| fit.distance))
        .case_column("min_mu", sines(), least_transmission)
        .case_column("size", points(), move |case| size(&of_size, case))
        .case_column("clearance", points(), move |case| clearance(&of_clearance, case)))
}
