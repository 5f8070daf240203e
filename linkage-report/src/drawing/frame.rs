//! Conversion from lengths of the mechanism to pixels: one scale for x and y, y up.

use nalgebra::Vector2;

/// The visible window of the plane and its position in the picture.
pub(super) struct Frame {
    pub low: Vector2<f64>,
    pub high: Vector2<f64>,
    pixels_per_unit: f64,
}

/// The width of the plot in pixels; its height follows from the drawing, within these bounds.
pub(super) const WIDTH: f64 = 640.0;
const LEAST_HEIGHT: f64 = 240.0;
const MOST_HEIGHT: f64 = 640.0;
/// Margins for the numbers and the title, in pixels.
pub(super) const LEFT: f64 = 56.0;
pub(super) const TOP: f64 = 44.0;

impl Frame {
    /// A window around all points, with a margin of a twelfth on each side.
    pub(super) fn around(points: &[Vector2<f64>]) -> Self {
        let (centre, size) = bounds(points);
        let width = (size.x * 7.0 / 6.0).max(size.y * 7.0 / 6.0 * WIDTH / MOST_HEIGHT);
        let height = (size.y * 7.0 / 6.0).max(width * LEAST_HEIGHT / WIDTH);
        let half = Vector2::new(width, height) / 2.0;
        Self { low: centre - half, high: centre + half, pixels_per_unit: WIDTH / width }
    }

    pub(super) fn height(&self) -> f64 {
        (self.high.y - self.low.y) * self.pixels_per_unit
    }

    /// Converts a point to pixels from the top left corner, to a hundredth.
    pub(super) fn pixel(&self, point: Vector2<f64>) -> Vector2<f64> {
        let offset = (point - self.low) * self.pixels_per_unit;
        Vector2::new(LEFT + offset.x, TOP + self.height() - offset.y).map(|value| (value * 100.0).round() / 100.0)
    }
}

/// Centre and size of the bounding box of all points; the size is never zero.
pub(super) fn bounds(points: &[Vector2<f64>]) -> (Vector2<f64>, Vector2<f64>) {
    let fold = |pick: fn(f64, f64) -> f64, start: f64| {
        points.iter().fold(Vector2::repeat(start), |a, b| Vector2::new(pick(a.x, b.x), pick(a.y, b.y)))
    };
    let (low, high) = (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY));
    let (centre, size) = ((low + high) / 2.0, high - low);
    if size.amax() <= 1e-12 * centre.amax() || size.amax() == 0.0 {
        return (centre, Vector2::repeat(if centre.amax() > 0.0 { centre.amax() } else { 1.0 }));
    }
    (centre, size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_scale_and_y_up() {
        let frame = Frame::around(&[Vector2::new(0.0, 0.0), Vector2::new(60.0, 30.0)]);
        let [origin, right, up] = [[0.0, 0.0], [6.0, 0.0], [0.0, 6.0]].map(|at| frame.pixel(Vector2::from(at)));
        assert!(((right.x - origin.x) - (origin.y - up.y)).abs() < 0.02);
        assert!(up.y < origin.y);
    }
}
