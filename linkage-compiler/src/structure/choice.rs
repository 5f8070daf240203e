//! The choice between the two solutions of a group.

use super::{Group, Slide};

/// The names of the two solutions of a group; the first is that of the positive root.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// Left or right of the line between the outer joints.
    Elbow,
    /// Far or near.
    Slider,
    /// The equation rises or falls with the angle.
    Slope,
}

impl Choice {
    /// The choice of a group with two solutions. The angle of a dyad with a slider has those of the slider.
    #[must_use]
    pub fn of(group: Group, slide: Option<Slide>) -> Option<Self> {
        match (group, slide) {
            (Group::Rrr | Group::Circles | Group::LinkToCircle, _) => Some(Self::Elbow),
            (Group::Rrp | Group::Rpr | Group::SliderToCircle, _) | (Group::Angle, Some(_)) => Some(Self::Slider),
            (Group::Angle, None) => Some(Self::Slope),
            (
                Group::Sliders | Group::Linear | Group::Scalar | Group::Pair | Group::Loops(_) | Group::Irreducible(..),
                _,
            ) => None,
        }
    }

    /// The name of its type in the runtime.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Elbow => "Elbow",
            Self::Slider => "Slider",
            Self::Slope => "Slope",
        }
    }

    /// The variants of the positive and of the negative root.
    #[must_use]
    pub fn variants(self) -> [&'static str; 2] {
        match self {
            Self::Elbow => ["Left", "Right"],
            Self::Slider => ["Far", "Near"],
            Self::Slope => ["Rising", "Falling"],
        }
    }
}
