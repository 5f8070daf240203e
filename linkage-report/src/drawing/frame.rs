//! Conversion from lengths of the mechanism to pixels: one scale for x and y, y up.

use nalgebra::Vector2;

/// The place of the plane in a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    pub pixels_per_unit: f64,
    /// The point of the mechanism in the middle, and the middle in pixels from the top left corner.
    pub centre: Vector2<f64>,
    pub middle: Vector2<f64>,
    /// Half the size of the region for the linkage, in pixels.
    pub half: Vector2<f64>,
}

impl View {
    /// Scales the points so that all fit into a rectangle with a margin on each side; sizes in pixels.
    pub(super) fn within(points: &[Vector2<f64>], size: Vector2<f64>, margin: f64) -> Self {
        let (centre, extent) = bounds(points);
        let room = size - Vector2::repeat(2.0 * margin);
        let pixels_per_unit = (room.x / extent.x).min(room.y / extent.y);
        Self { pixels_per_unit, centre, middle: size / 2.0, half: size / 2.0 }
    }

    /// Converts a point to pixels from the top left corner.
    pub(super) fn pixel(&self, point: Vector2<f64>) -> Vector2<f64> {
        let offset = (point - self.centre) * self.pixels_per_unit;
        self.middle + Vector2::new(offset.x, -offset.y)
    }

    /// True for pixels in the picture, with room for half the height of a name.
    pub(super) fn has_room_at(&self, pixel: Vector2<f64>) -> bool {
        (pixel - self.middle).abs() <= self.half - Vector2::repeat(8.0)
    }
}

/// The visible window of the plane and its position in a picture with axes.
pub(super) struct Frame {
    pub low: Vector2<f64>,
    pub high: Vector2<f64>,
    /// The distance of the plot from the top of the picture, in pixels.
    pub top: f64,
    pixels_per_unit: f64,
}

/// The width of the plot in pixels; its height follows from the drawing, within these bounds. With its margins the picture
/// is as wide as an animation.
pub(super) const WIDTH: f64 = 416.0;
const LEAST_HEIGHT: f64 = 180.0;
const MOST_HEIGHT: f64 = 460.0;
/// The margin for the numbers, in pixels.
pub(super) const LEFT: f64 = 50.0;
/// The room of the shapes around points, such as the triangle below a pivot, in pixels.
const ROOM: f64 = 28.0;

impl Frame {
    /// A window around all points, with a margin on each side.
    pub(super) fn around(points: &[Vector2<f64>], top: f64) -> Self {
        let (centre, size) = bounds(points);
        let room = |pixels: f64| pixels - 2.0 * ROOM;
        let units_per_pixel = (size.x / room(WIDTH)).max(size.y / room(MOST_HEIGHT));
        let height = (size.y / units_per_pixel + 2.0 * ROOM).max(LEAST_HEIGHT);
        let half = Vector2::new(WIDTH, height) * units_per_pixel / 2.0;
        Self { low: centre - half, high: centre + half, top, pixels_per_unit: 1.0 / units_per_pixel }
    }

    pub(super) fn height(&self) -> f64 {
        (self.high.y - self.low.y) * self.pixels_per_unit
    }

    pub(super) fn view(&self) -> View {
        let half = Vector2::new(WIDTH, self.height()) / 2.0;
        let middle = Vector2::new(LEFT, self.top) + half;
        View { pixels_per_unit: self.pixels_per_unit, centre: (self.low + self.high) / 2.0, middle, half }
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
        let view = Frame::around(&[Vector2::new(0.0, 0.0), Vector2::new(60.0, 30.0)], 44.0).view();
        let [origin, right, up] = [[0.0, 0.0], [6.0, 0.0], [0.0, 6.0]].map(|at| view.pixel(Vector2::from(at)));
        assert!(((right.x - origin.x) - (origin.y - up.y)).abs() < 1e-9 * (right.x - origin.x));
        assert!(up.y < origin.y);
    }
}
