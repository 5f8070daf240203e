//! The choice between the two solutions of a group.

use super::{GroupKind, Slide};

/// The names of the two solutions of a group; the first is that of the positive root.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    pub fn of(group: GroupKind, slide: Option<Slide>) -> Option<Self> {
        match (group, slide) {
            (GroupKind::Rrr | GroupKind::Circles | GroupKind::LinkToCircle, _) => Some(Self::Elbow),
            (GroupKind::Rrp | GroupKind::Rpr | GroupKind::SliderToCircle, _) | (GroupKind::Angle, Some(_)) => {
                Some(Self::Slider)
            }
            (GroupKind::Angle, None) => Some(Self::Slope),
            (
                GroupKind::Sliders
                | GroupKind::Linear
                | GroupKind::Scalar
                | GroupKind::Pair
                | GroupKind::Loops(_)
                | GroupKind::Irreducible(..),
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
