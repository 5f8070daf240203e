//! The shapes of a picture that names should not cover.

use nalgebra::Vector2;

use super::DrawingError;
use super::figure::Figure;
use super::film::Film;
use super::names::{Shape, foot};
use super::part::Part;
use super::shapes::{BLOCK, HALF_LINK};

/// The corners that stand for a wheel, an outline or a path.
const CORNERS: usize = 16;

/// The shapes at one moment, of which `places` has the points in pixels.
pub(super) fn shapes(figure: &Figure, film: &Film, places: &[Vector2<f64>]) -> Result<Vec<Shape>, DrawingError> {
    let mut shapes = Vec::new();
    for part in &figure.parts {
        let at = |name: &String| Ok::<_, DrawingError>(places[film.index(name)?]);
        match part {
            Part::Ground(point) => shapes.extend(foot(at(point)?)),
            Part::Link { points, .. } => {
                let points: Vec<Vector2<f64>> = points.iter().map(at).collect::<Result<_, _>>()?;
                shapes.extend(closed(&points).map(|ends| Shape::line(ends, HALF_LINK)));
            }
            Part::Bent(points) => {
                let points: Vec<Vector2<f64>> = points.iter().map(at).collect::<Result<_, _>>()?;
                shapes.extend(points.windows(2).map(|ends| Shape::line([ends[0], ends[1]], HALF_LINK)));
            }
            Part::Spring([from, to]) => shapes.push(Shape::line([at(from)?, at(to)?], 6.0)),
            Part::Slider { point, along } => {
                let guide = film.guide(film.index(point)?, *along)?;
                shapes.push(block(at(point)?, guide.along));
                shapes.push(Shape::faint(guide.ends));
            }
            Part::Sleeve { pin, arm: [from, to] } => shapes.push(block(at(pin)?, at(to)? - at(from)?)),
            Part::Wheel { centre, radius, .. } => {
                let (centre, radius) = (at(centre)?, radius * film.view.pixels_per_unit);
                let corner = |corner: usize| std::f64::consts::TAU * corner as f64 / CORNERS as f64;
                let rim: Vec<_> = (0..CORNERS).map(corner).map(|angle| centre + polar(radius, angle)).collect();
                shapes.extend(closed(&rim).map(Shape::faint));
            }
            Part::Plate { centre, towards, outline } => {
                let (centre, towards) = (at(centre)?, at(towards)?);
                let x = (towards - centre).try_normalize(0.0).unwrap_or_else(Vector2::x) * film.view.pixels_per_unit;
                let y = Vector2::new(x.y, -x.x);
                let corners = outline.iter().step_by(outline.len().div_ceil(CORNERS).max(1));
                let corners: Vec<_> = corners.map(|corner| centre + x * corner.x + y * corner.y).collect();
                shapes.extend(closed(&corners).map(Shape::faint));
            }
            Part::GroundLine(line) => {
                shapes.extend(
                    line.windows(2).map(|ends| Shape::faint([film.view.pixel(ends[0]), film.view.pixel(ends[1])])),
                );
            }
            Part::Trace(point) => shapes.extend(curve(&film.track(film.index(point)?))),
            Part::Path(path) => {
                shapes.extend(curve(&path.iter().map(|at| film.view.pixel(*at)).collect::<Vec<_>>()));
            }
            Part::Joint(_) | Part::Point(_) | Part::Room(_) => {}
        }
    }
    Ok(shapes)
}

/// Some of the points of a path as a polygon.
fn curve(points: &[Vector2<f64>]) -> Vec<Shape> {
    let corners: Vec<_> = points.iter().step_by(points.len().div_ceil(CORNERS).max(1)).copied().collect();
    closed(&corners).map(Shape::faint).collect()
}

/// The sides of a polygon.
fn closed(corners: &[Vector2<f64>]) -> impl Iterator<Item = [Vector2<f64>; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(from, to)| [*from, *to])
}

/// A sliding block along a direction.
fn block(at: Vector2<f64>, along: Vector2<f64>) -> Shape {
    let [half_length, half_width] = BLOCK;
    let half = along.try_normalize(0.0).unwrap_or_else(Vector2::x) * (half_length - half_width);
    Shape::line([at - half, at + half], half_width)
}

fn polar(length: f64, angle: f64) -> Vector2<f64> {
    Vector2::new(length * angle.cos(), length * angle.sin())
}
