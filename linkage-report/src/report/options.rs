//! The options of a report.

use linkage_runtime::circuits::CircuitOptions;
use linkage_runtime::range_of_motion::RangeOptions;

/// The options of a report.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ReportOptions {
    /// The range of the motion, and what it does at change points: by default it passes them smoothly.
    pub range: RangeOptions,
    /// The options of the circuits.
    pub circuits: CircuitOptions,
    /// The definition of a dwell.
    pub dwell: DwellOptions,
}

/// The definition of a dwell: a part of the motion in which a quantity hardly moves. Both numbers are ratios, so that no
/// unit matters.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DwellOptions {
    /// The largest rate within a dwell, by default 1/10: at it, the quantity would move in the whole motion by a tenth of
    /// the distance between its extremes. A sine moves by twice that distance in a turn.
    pub slowest: f64,
    /// The shortest dwell, by default 1/24 of the motion: 15 degrees of a turn. A sine is slower than a tenth in 1/99.
    pub shortest: f64,
}

impl Default for DwellOptions {
    fn default() -> Self {
        Self { slowest: 0.1, shortest: 1.0 / 24.0 }
    }
}

impl Default for ReportOptions {
    fn default() -> Self {
        let range = RangeOptions::through_change_points();
        Self { range, circuits: CircuitOptions::default(), dwell: DwellOptions::default() }
    }
}
