//! The parts of a picture, by the names of their points; see the methods of [`Animation`](super::Animation) and
//! [`Drawing`](super::Drawing).

use nalgebra::Vector2;

/// A part to draw.
#[derive(Debug, Clone)]
pub(super) enum Part {
    Ground(String),
    Link {
        points: Vec<String>,
        driven: bool,
    },
    Bent(Vec<String>),
    /// A block on a fixed guide, whose direction is needed where the motion does not show it.
    Slider {
        point: String,
        along: Option<Vector2<f64>>,
    },
    Sleeve {
        pin: String,
        arm: [String; 2],
    },
    Wheel {
        centre: String,
        towards: String,
        radius: f64,
    },
    Plate {
        centre: String,
        towards: String,
        outline: Vec<Vector2<f64>>,
    },
    Spring([String; 2]),
    GroundLine(Vec<Vector2<f64>>),
    /// A point that leaves its path.
    Trace(String),
    /// A path by its points.
    Path(Vec<Vector2<f64>>),
    /// Places for which the picture has room.
    Room(Vec<Vector2<f64>>),
    /// A joint that is shown also where no parts meet.
    Joint(String),
    /// A point that is no joint.
    Point(String),
}

impl Part {
    pub(super) fn points(&self) -> Vec<&String> {
        match self {
            Self::Ground(point)
            | Self::Slider { point, .. }
            | Self::Trace(point)
            | Self::Joint(point)
            | Self::Point(point) => vec![point],
            Self::Link { points, .. } | Self::Bent(points) => points.iter().collect(),
            Self::Sleeve { pin, arm: [from, to] } => vec![pin, from, to],
            Self::Wheel { centre, towards, .. } | Self::Plate { centre, towards, .. } => vec![centre, towards],
            Self::Spring([from, to]) => vec![from, to],
            Self::GroundLine(_) | Self::Path(_) | Self::Room(_) => Vec::new(),
        }
    }

    pub(super) fn points_mut(&mut self) -> Vec<&mut String> {
        match self {
            Self::Ground(point)
            | Self::Slider { point, .. }
            | Self::Trace(point)
            | Self::Joint(point)
            | Self::Point(point) => vec![point],
            Self::Link { points, .. } | Self::Bent(points) => points.iter_mut().collect(),
            Self::Sleeve { pin, arm: [from, to] } => vec![pin, from, to],
            Self::Wheel { centre, towards, .. } | Self::Plate { centre, towards, .. } => vec![centre, towards],
            Self::Spring([from, to]) => vec![from, to],
            Self::GroundLine(_) | Self::Path(_) | Self::Room(_) => Vec::new(),
        }
    }

    /// The points at which the part is connected to others: points that belong to several parts are drawn as joints.
    pub(super) fn joints(&self) -> impl Iterator<Item = &String> {
        let count = match self {
            Self::Trace(_) | Self::Joint(_) | Self::Point(_) => 0,
            Self::Sleeve { .. } | Self::Wheel { .. } | Self::Plate { .. } => 1,
            _ => usize::MAX,
        };
        self.points().into_iter().take(count)
    }
}
