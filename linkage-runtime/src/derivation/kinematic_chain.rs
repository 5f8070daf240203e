//! The links and joints of a mechanism.

/// The links and joints that the vectors of loops and points show. Vectors of constant length that turn together and share
/// a joint are one link; a vector whose length is a coordinate is a guide, on which a link slides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct KinematicChain<'a> {
    /// The links; the ground comes first.
    pub links: &'a [ChainLink<'a>],
    /// The joints; where k links meet in a pin, there are k - 1.
    pub joints: &'a [ChainJoint<'a>],
    /// The number of conditions between coordinates, such as those of gears, cams and belts: the `equation`s.
    pub conditions: usize,
}

/// A rigid link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ChainLink<'a> {
    /// Its name, made of those of the coordinates that move it; `ground`.
    pub name: &'a str,
    /// The coordinates in its angle, by name in the `linkage!` language.
    pub turns_with: &'a [&'a str],
}

/// A joint between two links.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ChainJoint<'a> {
    /// The links by index.
    pub links: [usize; 2],
    /// The coordinate along which it slides; none if it turns.
    pub slides_along: Option<&'a str>,
}
