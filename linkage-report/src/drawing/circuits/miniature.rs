//! A small drawing of the linkage at one position.

use linkage_runtime::skeleton::{Part, Skeleton};
use nalgebra::Vector2;
use svg::node::element::{Circle, Group, Path};

use crate::drawing::frame::bounds;
use crate::drawing::pen::Pen;

/// The size of a small drawing, and its margin, in pixels.
pub(super) const HEIGHT: f64 = 84.0;
const SIZE: Vector2<f64> = Vector2::new(108.0, HEIGHT);
const MARGIN: f64 = 9.0;

/// The joints of a linkage at one position, in the lengths of the mechanism, and its parts.
#[derive(Debug, Clone)]
pub(super) struct Miniature {
    joints: Vec<Vector2<f64>>,
    parts: Vec<Drawn>,
}

/// A part that is drawn, with joints by their index.
#[derive(Debug, Clone)]
enum Drawn {
    Ground(usize),
    Bar { joints: Vec<usize>, is_driven: bool },
    Slider(usize),
    Sleeve { pin: usize, on: usize, towards: Option<usize> },
}

impl Drawn {
    /// None for a part that a small drawing does not have, as a path.
    fn of(part: &Part<'_>) -> Option<Self> {
        Some(match *part {
            Part::Ground(joint) => Self::Ground(joint),
            Part::Bar { joints, is_driven } => Self::Bar { joints: joints.to_vec(), is_driven },
            Part::Slider(joint) => Self::Slider(joint),
            Part::Sleeve { pin, on, towards } => Self::Sleeve { pin, on, towards },
            _ => return None,
        })
    }
}

impl Miniature {
    pub fn of<M: Skeleton<Scalar = f64>>(mechanism: &M, pose: &M::Pose) -> Self {
        let joints = mechanism.joints(pose);
        let joints = joints.as_slice().chunks_exact(2).map(|at| Vector2::new(at[0], at[1])).collect();
        Self { joints, parts: mechanism.drawn_parts().iter().filter_map(Drawn::of).collect() }
    }

    /// The joints that are drawn.
    fn drawn(&self) -> impl Iterator<Item = Vector2<f64>> + '_ {
        let joints = self.parts.iter().flat_map(|part| match part {
            Drawn::Ground(joint) | Drawn::Slider(joint) => vec![*joint],
            Drawn::Bar { joints, .. } => joints.clone(),
            Drawn::Sleeve { pin, on, towards } => [*pin, *on].into_iter().chain(*towards).collect(),
        });
        joints.filter_map(|joint| self.joints.get(joint).copied())
    }

    /// True if every joint is at the place of that of another, to a millionth of the size of the linkage.
    pub fn is_near(&self, other: &Self) -> bool {
        let size = bounds(&self.joints).1.amax();
        self.joints.iter().zip(&other.joints).all(|(one, other)| (one - other).amax() <= 1e-6 * size)
    }

    /// Draws the linkage around the middle of the drawing.
    pub fn group(&self, scale: &Scale) -> Group {
        let at = |joint: usize| self.joints.get(joint).map_or_else(Vector2::zeros, |at| scale.pixel(*at));
        let path = |class: &str, points: &[Vector2<f64>]| {
            Path::new().set("class", class).set("d", Pen::default().lines(points).path())
        };
        let mut group = Group::new();
        // Driven links are drawn last, so that no other hides them.
        let (driven, others): (Vec<&Drawn>, _) =
            self.parts.iter().partition(|part| matches!(part, Drawn::Bar { is_driven: true, .. }));
        for part in others.into_iter().chain(driven) {
            match part {
                Drawn::Bar { joints, is_driven } => {
                    let mut points: Vec<Vector2<f64>> = joints.iter().map(|&joint| at(joint)).collect();
                    if points.len() > 2 {
                        points.push(points[0]);
                    }
                    group = group.add(path(if *is_driven { "bar driven" } else { "bar" }, &points));
                }
                Drawn::Sleeve { pin, on, towards } => {
                    group = group.add(path("bar", &[at(*on), at(towards.unwrap_or(*pin))])).add(block(at(*pin)));
                }
                Drawn::Slider(joint) => group = group.add(block(at(*joint))),
                Drawn::Ground(_) => {}
            }
        }
        for part in &self.parts {
            match part {
                Drawn::Ground(joint) => {
                    let pivot = at(*joint);
                    let foot = [pivot, pivot + Vector2::new(5.0, 8.0), pivot + Vector2::new(-5.0, 8.0), pivot];
                    group = group.add(path("foot", &foot)).add(dot(pivot));
                }
                Drawn::Bar { joints, .. } => {
                    group = joints.iter().fold(group, |group, &joint| group.add(dot(at(joint))))
                }
                Drawn::Slider(_) | Drawn::Sleeve { .. } => {}
            }
        }
        group
    }
}

fn dot(at: Vector2<f64>) -> Circle {
    Circle::new().set("class", "pin").set("cx", rounded(at.x)).set("cy", rounded(at.y)).set("r", 2)
}

fn block(at: Vector2<f64>) -> Path {
    let corners = [[-6.0, -4.0], [6.0, -4.0], [6.0, 4.0], [-6.0, 4.0]].map(|corner| at + Vector2::from(corner));
    Path::new().set("class", "block").set("d", Pen::default().lines(&corners).close().path())
}

/// A tenth of a pixel.
pub(super) fn rounded(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}

/// One scale for all drawings of a chart, so that links have equal lengths in each.
pub(super) struct Scale {
    centre: Vector2<f64>,
    pixels_per_unit: f64,
}

impl Scale {
    pub fn of<'a>(all: impl Iterator<Item = &'a Miniature>) -> Self {
        let joints: Vec<Vector2<f64>> = all.flat_map(Miniature::drawn).collect();
        let (centre, size) = bounds(&joints);
        let room = SIZE - Vector2::repeat(2.0 * MARGIN);
        Self { centre, pixels_per_unit: (room.x / size.x).min(room.y / size.y) }
    }

    fn pixel(&self, at: Vector2<f64>) -> Vector2<f64> {
        let offset = (at - self.centre) * self.pixels_per_unit;
        SIZE / 2.0 + Vector2::new(offset.x, -offset.y)
    }
}
