//! The links and joints of a mechanism.

use super::{List, Storage, Text};

records! {
    /// The links and joints that the vectors of loops and points show. Vectors of constant length that turn together and share
    /// a joint are one link; a vector whose length is a coordinate is a guide, on which a link slides.
    KinematicChain {
        /// The links; the ground comes first.
        links: List<'a, S, ChainLink<'a, S>>,
        /// The joints; where k links meet in a pin, there are k - 1.
        joints: List<'a, S, ChainJoint<'a, S>>,
        /// The number of conditions between coordinates, such as those of gears, cams and belts: the `equation`s.
        conditions: usize,
    }

    /// A rigid link.
    ChainLink {
        /// Its name, made of those of the coordinates that move it; `ground`.
        name: Text<'a, S>,
        /// The coordinates in its angle, by name in the `linkage!` language.
        turns_with: List<'a, S, Text<'a, S>>,
    }

    /// A joint between two links.
    ChainJoint {
        /// The links by index.
        links: [usize; 2],
        /// The coordinate along which it slides; none if it turns.
        slides_along: Option<Text<'a, S>>,
    }
}
