//! Velocities, accelerations and forces as arrows, each kind to its scale.

use nalgebra::Vector2;

/// The kind of a vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Velocity,
    Acceleration,
    Force,
}

impl Quantity {
    pub(super) const ALL: [Self; 3] = [Self::Velocity, Self::Acceleration, Self::Force];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Force => "force",
        }
    }
}

/// A vector at a point.
#[derive(Debug, Clone)]
pub(super) struct Arrow {
    pub from: Tail,
    pub vector: Vector2<f64>,
    pub quantity: Quantity,
    /// The words at its tip.
    pub label: String,
}

/// The place at which an arrow begins.
#[derive(Debug, Clone)]
pub(super) enum Tail {
    /// A point by its name.
    Point(String),
    At(Vector2<f64>),
}

/// The length of a unit vector in the drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scale {
    /// The length 1.
    Default,
    Given(f64),
    /// The longest arrow is about a quarter of the linkage.
    Fitted,
}

/// The share of the linkage that the longest arrow of a fitted scale has.
const SHARE: f64 = 0.25;

impl Scale {
    /// The drawn length of a unit, for arrows of these lengths on a linkage of this size. A fitted scale is a round number.
    pub(super) fn factor(self, longest: f64, size: f64) -> f64 {
        match self {
            Self::Default => 1.0,
            Self::Given(scale) => scale,
            Self::Fitted if longest > 0.0 => nearest_round(SHARE * size / longest),
            Self::Fitted => 1.0,
        }
    }
}

/// The nearest of the numbers 1, 2 and 5 times a power of ten, by their ratio.
fn nearest_round(value: f64) -> f64 {
    let power = value.log10().floor();
    let digit = value / 10_f64.powf(power);
    let limits = [(1, 2_f64.sqrt()), (2, 10_f64.sqrt()), (5, 50_f64.sqrt())];
    let near = limits.into_iter().find(|(_, limit)| digit < *limit).map_or((1, power + 1.0), |(near, _)| (near, power));
    // Read as a decimal, it is the nearest number to it.
    format!("{}e{}", near.0, near.1).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_round() {
        let values = [1.3, 1.5, 3.1, 3.2, 7.0, 7.2, 0.019, 3.3e-7];
        assert_eq!(values.map(nearest_round), [1.0, 2.0, 2.0, 5.0, 5.0, 10.0, 0.02, 5e-7]);
        assert_eq!(Scale::Fitted.factor(100.0, 80.0), 0.2);
        assert_eq!(Scale::Fitted.factor(0.0, 80.0), 1.0);
        assert_eq!(Scale::Given(0.3).factor(100.0, 80.0), 0.3);
    }
}
