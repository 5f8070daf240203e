//! Reasons why the positions of a group are found by Newton's method only.

/// The reason why the positions of a group cannot be listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Obstacle {
    MoreLoops,
    TwoGuides,
    LengthsInOneLoop,
    ProductOfLengths,
    UserFunction,
    NotLoops,
}

impl Obstacle {
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::MoreLoops => "it has more than three loops",
            Self::TwoGuides => "it has two sliders on two unknown directions",
            Self::LengthsInOneLoop => "one of its loops has two unknown lengths",
            Self::ProductOfLengths => "two of them, or the square of one, are multiplied",
            Self::UserFunction => "a function of the program takes one of them",
            Self::NotLoops => "they are not the angles and lengths of links in two or three loops",
        }
    }
}
