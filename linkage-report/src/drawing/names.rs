//! Placement of names: next to their points, clear of links and of one another.

use std::f64::consts::TAU;

use nalgebra::Vector2;

/// The distances of a name from its point, in pixels: near, or far where points are crowded.
const NEAR: f64 = 18.0;
const FAR: f64 = 30.0;

/// The distance of a name from other shapes beyond which more room counts only a hundredth, so that names stay near, in
/// pixels.
const ENOUGH: f64 = 16.0;

/// Half the width of a letter, in pixels.
const HALF_LETTER: f64 = 4.0;

/// The obstacles for names in one frame, in pixels.
#[derive(Default)]
pub(super) struct Obstacles {
    /// Bars and vectors.
    pub segments: Vec<[Vector2<f64>; 2]>,
    /// Points.
    pub points: Vec<Vector2<f64>>,
    /// Beginning, middle and end of the names already placed.
    names: Vec<Vector2<f64>>,
}

impl Obstacles {
    pub(super) fn new(segments: Vec<[Vector2<f64>; 2]>, points: Vec<Vector2<f64>>) -> Self {
        Self { segments, points, names: Vec::new() }
    }

    /// Adds a placed name as an obstacle.
    pub(super) fn place_name(&mut self, name: &str, at: Vector2<f64>) {
        self.names.extend(extent(name).map(|part| at + part));
    }
}

/// Beginning, middle and end of a name.
fn extent(name: &str) -> [Vector2<f64>; 3] {
    let letters = u32::try_from(name.chars().count()).map_or(1.0, f64::from);
    [-1.0, 0.0, 1.0].map(|side| Vector2::new(side * HALF_LETTER * letters, 0.0))
}

/// The sides of the triangle under a ground pivot.
pub(super) fn foot(at: Vector2<f64>) -> [[Vector2<f64>; 2]; 3] {
    let [left, right] = [-11.0, 11.0].map(|side| at + Vector2::new(side, 17.0));
    [[at, left], [left, right], [right, at]]
}

/// Returns the offset of a name from its point, in one of sixteen directions, that is farthest from bars, vectors and
/// other names on average over the frames; `inside` is true for positions in the picture.
pub(super) fn offset(
    name: &str,
    inside: impl Fn(Vector2<f64>) -> bool,
    frames: &[Obstacles],
    at: impl Fn(&Obstacles) -> Vector2<f64>,
) -> Vector2<f64> {
    let extent = extent(name);
    let mut best = (f64::NEG_INFINITY, Vector2::zeros());
    for step in 0..32_u32 {
        let angle = TAU / 16.0 * (f64::from(step) + 0.5);
        let direction = Vector2::new(angle.cos(), -angle.sin());
        let (away, cost) = if step < 16 { (NEAR, 0.0) } else { (FAR, 4.0) };
        let candidate = direction * away + extent[2] * 0.5 * direction.x;
        let mut sum = 0.0;
        for obstacles in frames {
            let at = at(obstacles);
            let parts = extent.map(|part| at + candidate + part);
            let lines = obstacles.segments.iter().flat_map(|ends| parts.map(|part| distance(part, *ends)));
            let others = obstacles.points.iter().filter(|other| **other != at).chain(&obstacles.names);
            let names = others.flat_map(|other| parts.map(|part| (part - other).norm()));
            let room = lines.chain(names).fold(f64::INFINITY, f64::min);
            sum += if parts.into_iter().all(&inside) { room.min(ENOUGH) + room * 0.01 - cost } else { -FAR };
        }
        if sum > best.0 + 1e-9 {
            best = (sum, candidate);
        }
    }
    best.1
}

fn distance(point: Vector2<f64>, [from, to]: [Vector2<f64>; 2]) -> f64 {
    let along = to - from;
    let length = along.norm_squared();
    let fraction = if length > 0.0 { ((point - from).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (point - from - along * fraction).norm()
}
