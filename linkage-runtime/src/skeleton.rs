//! The joints and parts of a drawing of a mechanism.

use core::fmt::{self, Display, Formatter};

use crate::{Column, Dim, Mechanism, Name};

/// A part of a drawing. Joints are given by their index: that of [`Skeleton::joint_name`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Part<'a> {
    /// A pivot on the ground.
    Ground(usize),
    /// A rigid link.
    Bar {
        /// Its joints; a pivot on the ground comes first.
        joints: &'a [usize],
        /// True if it turns with an input about a pivot on the ground.
        is_driven: bool,
    },
    /// A block that moves on a fixed guide.
    Slider(usize),
    /// A block that slides on a turning arm.
    Sleeve {
        /// The joint at the block.
        pin: usize,
        /// The joint at which the arm starts.
        on: usize,
        /// Another joint of the arm, if it has one.
        towards: Option<usize>,
    },
    /// A point whose path is drawn.
    Trace(usize),
}

/// The reason why a mechanism at run time has no drawing: its type is the same with and without.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum NoDrawing {
    /// It is compiled without `derive drawing;`.
    NotDerived,
    /// It has more joints than a drawing at run time can have.
    TooLarge {
        /// The number of joints.
        joints: usize,
        /// The most.
        most: usize,
    },
}

impl Display for NoDrawing {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotDerived => f.write_str("it is compiled without `derive drawing;`"),
            Self::TooLarge { joints, most } => {
                write!(f, "its {joints} joints are more than the {most} of a mechanism at run time: use `linkage!`")
            }
        }
    }
}

impl core::error::Error for NoDrawing {}

/// A mechanism that knows its drawing.
///
/// `linkage!` implements it on request, by `derive drawing;`. The parts are guessed from the vectors of loops and points:
/// a vector of constant length at a moving angle is a bar, one of variable length a slider or a sleeve; vectors that turn
/// together and share a joint are one link, and so are three links that meet in three joints. A declared point that moves
/// and is no joint leaves its path.
#[diagnostic::on_unimplemented(message = "`{Self}` has no drawing", note = "write `derive drawing;` in its `linkage!`")]
pub trait Skeleton: Mechanism {
    /// Twice the number of joints.
    type Parts: Dim;
    /// The names of the joints: of the declared points, `O` for the origin, numbers for the others.
    const JOINTS: &'static [&'static str];
    /// The parts.
    const PARTS: &'static [Part<'static>];

    /// The reason why a mechanism at run time has no drawing: it has no joints then. Emitted code has one.
    ///
    /// # Errors
    /// That reason.
    fn check_drawing(&self) -> Result<(), NoDrawing> {
        Ok(())
    }

    /// The name of a joint; none beyond the last. The names and parts of emitted code are constants, those of a mechanism at run
    /// time are of its value.
    fn joint_name(&self, place: usize) -> Option<Self::Name> {
        Self::JOINTS.get(place).copied().map(Name::from_static)
    }
    /// The parts, with joints by their index.
    fn drawn_parts(&self) -> &[Part<'_>] {
        Self::PARTS
    }
    /// The names of the joints.
    fn joint_names(&self) -> impl Iterator<Item = Self::Name> {
        (0..).map_while(|place| self.joint_name(place))
    }

    /// x and y of each joint.
    fn joints(&self, pose: &Self::Pose) -> Column<Self::Scalar, Self::Parts>;

    /// x and y along the guide of a slider or the arm of a sleeve, as its vector is written, by its place among these of
    /// the parts.
    fn guide(&self, pose: &Self::Pose, place: usize) -> Option<[Self::Scalar; 2]> {
        let _ = (pose, place);
        None
    }

    /// x and y of the joint of a force, then those of the direction of its first component; the second is a quarter turn
    /// anticlockwise from it. `place` is that of a [`Joint`](crate::Joint).
    fn force_place(&self, pose: &Self::Pose, place: usize) -> Option<[Self::Scalar; 4]> {
        let _ = (pose, place);
        None
    }
}
