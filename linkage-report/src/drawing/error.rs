//! The mistakes of a drawing.

use std::fmt;

use linkage_runtime::skeleton::NoDrawing;

/// The error of a drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DrawingError {
    /// The drawing is empty.
    Empty,
    /// A mechanism at run time has no drawing.
    NoDrawing {
        /// The mechanism.
        mechanism: String,
        /// The reason.
        why: NoDrawing,
    },
    /// A bar or a vector refers to an unknown point.
    UnknownPoint(String),
    /// No joint or point has the name that is to be changed or to leave a path.
    UnknownJoint {
        /// The name.
        name: String,
        /// The most similar name that there is.
        nearest: Option<String>,
    },
    /// No part connects exactly these points.
    NoPart(Vec<String>),
    /// The mechanism has no such unknown.
    UnknownCoordinate(String),
    /// Two points have the same name.
    DuplicatePoint(String),
    /// A number is infinite or NaN, or a scale, a radius or a duration is not positive.
    NotFinite(String),
    /// This frame, counted from 0, has different points than the first.
    OtherPoints(usize),
    /// A link changes its shape.
    NotRigid(String),
    /// A ground pivot moves.
    Moves(String),
    /// The point of a slider rests, or leaves its straight line.
    NotStraight(String),
    /// The mechanism has no position at an input.
    NoPosition(String),
}

impl fmt::Display for DrawingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("the drawing is empty: add points"),
            Self::NoDrawing { mechanism, why } => write!(f, "`{mechanism}` has no drawing: {why}"),
            Self::UnknownPoint(name) => write!(f, "the drawing has no point `{name}`: add it first"),
            Self::UnknownJoint { name, nearest } => {
                write!(f, "the drawing has no joint or point `{name}`")?;
                nearest.as_ref().map_or(Ok(()), |nearest| write!(f, ": is it `{nearest}`?"))
            }
            Self::NoPart(points) => {
                write!(f, "no part connects exactly the points `{}`: name all points of a part", points.join("`, `"))
            }
            Self::UnknownCoordinate(name) => {
                write!(f, "the mechanism has no unknown `{name}`: name one of its unknowns")
            }
            Self::DuplicatePoint(name) => write!(f, "the drawing has two points `{name}`: rename one"),
            Self::NotFinite(what) => {
                write!(f, "{what} must be finite, and positive if it is a scale, a radius or a duration")
            }
            Self::OtherPoints(frame) => {
                write!(f, "frame {frame} has different points than frame 0: give every frame the same names")
            }
            Self::NotRigid(link) => write!(f, "the link `{link}` changes its shape between frames"),
            Self::Moves(point) => write!(f, "the ground pivot `{point}` moves between frames"),
            Self::NoPosition(why) => f.write_str(why),
            Self::NotStraight(point) => write!(f, "the slider `{point}` does not move along a straight line"),
        }
    }
}

impl std::error::Error for DrawingError {}
