//! Where names stand: beside their points, clear of links and of one another.

use std::f64::consts::TAU;

use nalgebra::Vector2;

/// Names stand this far from their points.
const DISTANCE: f64 = 18.0;

/// Half the width of a letter of a name.
const HALF_LETTER: f64 = 4.0;

/// What names keep clear of at one moment, in pixels.
#[derive(Default)]
pub(super) struct Scene {
    /// Bars and vectors.
    pub segments: Vec<[Vector2<f64>; 2]>,
    /// Points and the names that stand already.
    pub taken: Vec<Vector2<f64>>,
}

/// The sides of the triangle under a pivot on the frame.
pub(super) fn foot(at: Vector2<f64>) -> [[Vector2<f64>; 2]; 3] {
    let [left, right] = [-11.0, 11.0].map(|side| at + Vector2::new(side, 17.0));
    [[at, left], [left, right], [right, at]]
}

/// Of sixteen places around a point the one that is farthest from bars, vectors and other names, on the
/// average over all scenes; `inside` says which places are in the picture.
pub(super) fn offset(
    name: &str,
    inside: impl Fn(Vector2<f64>) -> bool,
    scenes: &[Scene],
    at: impl Fn(&Scene) -> Vector2<f64>,
) -> Vector2<f64> {
    let letters = u32::try_from(name.chars().count()).map_or(1.0, f64::from);
    let half = Vector2::new(HALF_LETTER * letters, 0.0);
    let mut best = (f64::NEG_INFINITY, Vector2::zeros());
    for step in 0..16_u32 {
        let angle = TAU / 16.0 * (f64::from(step) + 0.5);
        let direction = Vector2::new(angle.cos(), -angle.sin());
        let candidate = direction * DISTANCE + half * 0.5 * direction.x;
        let mut sum = 0.0;
        for scene in scenes {
            let at = at(scene);
            let parts = [-half, Vector2::zeros(), half].map(|part| at + candidate + part);
            let lines = scene.segments.iter().flat_map(|ends| parts.map(|part| distance(part, *ends)));
            let others = scene.taken.iter().filter(|other| **other != at);
            let names = others.map(|other| (at + candidate - other).norm());
            let room = lines.chain(names).fold(f64::INFINITY, f64::min);
            sum += if parts.into_iter().all(&inside) { room } else { -DISTANCE };
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
