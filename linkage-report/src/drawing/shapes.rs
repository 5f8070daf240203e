//! Shapes of engineering drawings: links, blocks, hatching, springs, arrows. All sizes are in pixels.

use std::f64::consts::PI;

use nalgebra::Vector2;

use super::pen::Pen;

/// Half the width of a link.
pub(super) const HALF_LINK: f64 = 7.0;
/// Half the length and half the width of a sliding block.
pub(super) const BLOCK: [f64; 2] = [15.0, 9.0];
/// Distance and length of the strokes of a hatching.
const HATCH: f64 = 7.0;

fn direction(angle: f64) -> Vector2<f64> {
    Vector2::new(angle.cos(), angle.sin())
}

fn angle(vector: Vector2<f64>) -> f64 {
    vector.y.atan2(vector.x)
}

/// The direction to the right of `vector` on the screen.
fn right(vector: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-vector.y, vector.x)
}

/// The corners of the convex hull, clockwise on the screen.
fn hull(points: &[Vector2<f64>]) -> Vec<Vector2<f64>> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup_by(|a, b| (*a - *b).amax() < 1e-6);
    let chain = |points: &mut dyn Iterator<Item = &Vector2<f64>>| {
        let mut chain: Vec<Vector2<f64>> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp(&(point - b)) <= 1e-6
            {
                chain.pop();
            }
            chain.push(*point);
        }
        chain
    };
    let (mut lower, upper) = (chain(&mut sorted.iter()), chain(&mut sorted.iter().rev()));
    lower.pop();
    lower.extend(&upper[..upper.len().saturating_sub(1)]);
    if lower.is_empty() { sorted } else { lower }
}

/// The outline of a link: the hull of its points, widened by half the width of a link.
pub(super) fn link(points: &[Vector2<f64>]) -> String {
    let (corners, mut pen) = (hull(points), Pen::default());
    if let [centre] = corners[..] {
        return pen.circle(centre, HALF_LINK + 2.0).close().path();
    }
    for (index, corner) in corners.iter().enumerate() {
        let next = corners[(index + 1) % corners.len()];
        let out = -right((next - corner).normalize()) * HALF_LINK;
        if index == 0 {
            pen.move_to(corner + out);
        } else {
            pen.arc_to(HALF_LINK, true, corner + out);
        }
        pen.line_to(next + out);
    }
    if let [first, second, ..] = corners[..] {
        pen.arc_to(HALF_LINK, true, first - right((second - first).normalize()) * HALF_LINK);
    }
    pen.close().path()
}

/// A block around the origin, along its direction of sliding.
pub(super) fn block(along: Vector2<f64>) -> String {
    let [half_length, half_width] = BLOCK;
    let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
    let corners = corners.map(|[a, b]| along * (a * half_length) + right(along) * (b * half_width));
    Pen::default().lines(&corners).close().path()
}

/// Strokes along the right side of a line.
pub(super) fn hatching(line: &[Vector2<f64>]) -> String {
    let mut pen = Pen::default();
    let mut walked = HATCH / 2.0;
    for ends in line.windows(2) {
        let (from, length) = (ends[0], (ends[1] - ends[0]).norm());
        if length == 0.0 {
            continue;
        }
        let along = (ends[1] - from) / length;
        while walked < length {
            let at = from + along * walked;
            pen.move_to(at).line_to(at + (right(along) - along) * (HATCH * 0.8));
            walked += HATCH;
        }
        walked -= length;
    }
    pen.path()
}

/// The triangle under a ground pivot, and the hatched line below it.
pub(super) fn ground(at: Vector2<f64>) -> [String; 2] {
    let point = |x: f64, y: f64| at + Vector2::new(x, y);
    let triangle = Pen::default().lines(&[at, point(10.0, 16.0), point(-10.0, 16.0)]).close().path();
    let line = [point(-17.0, 16.0), point(17.0, 16.0)];
    [triangle, Pen::default().lines(&line).path() + &hatching(&line)]
}

/// A helical spring along x from the origin.
pub(super) fn spring(length: f64) -> String {
    const TURNS: u32 = 7;
    let mut points = vec![[0.0, 0.0], [0.12, 0.0]];
    for turn in 0..TURNS {
        let side = if turn % 2 == 0 { 6.0 } else { -6.0 };
        points.push([0.12 + 0.76 * (f64::from(turn) + 0.5) / f64::from(TURNS), side]);
    }
    points.extend([[0.88, 0.0], [1.0, 0.0]]);
    let points: Vec<_> = points.into_iter().map(|[part, side]| Vector2::new(part * length, side)).collect();
    Pen::default().lines(&points).path()
}

/// A wheel around the origin, with two diameters that show its rotation.
pub(super) fn wheel(radius: f64, towards: Vector2<f64>) -> [String; 2] {
    let mut spokes = Pen::default();
    for spoke in [towards, right(towards)] {
        spokes.move_to(spoke * radius).line_to(-spoke * radius);
    }
    [Pen::default().circle(Vector2::zeros(), radius).close().path(), spokes.path()]
}

/// A curved arrow around a pivot: with one head for a full turn, with two for a swing. The angles are those of the
/// crank on the screen, continuous through the motion. Returns the paths of arc and heads, and points along both.
pub(super) fn turning(pivot: Vector2<f64>, angles: &[f64]) -> ([String; 2], Vec<Vector2<f64>>) {
    let radius = 24.0;
    let fold = |pick: fn(f64, f64) -> f64| angles.iter().copied().reduce(pick).unwrap_or_default();
    let (least, largest) = (fold(f64::min), fold(f64::max));
    let turns = largest - least > 1.9 * PI;
    // Above the pivot, clear of its triangle.
    let (from, to) = if turns { (-1.1 * PI, 0.1 * PI) } else { (least, largest) };
    let (mut arc, mut heads) = (Pen::default(), Pen::default());
    let at = |angle: f64| pivot + direction(angle) * radius;
    let middle = f64::midpoint(from, to);
    arc.move_to(at(from)).arc_to(radius, true, at(middle)).arc_to(radius, true, at(to));
    let clockwise = angles.last() > angles.first();
    for (end, sense, drawn) in [(to, 1.0, !turns || clockwise), (from, -1.0, !turns || !clockwise)] {
        if drawn {
            let tip = at(end + 0.3 * sense);
            let back = at(end);
            let across = direction(angle(back - pivot)) * 4.5;
            heads.lines(&[tip, back + across, back - across]).close();
        }
    }
    let points = (0..=8_u32).map(|step| at(from - 0.3 + (to - from + 0.6) * f64::from(step) / 8.0));
    ([arc.path(), heads.path()], points.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_leave_out_what_is_inside() {
        let point = |x: f64, y: f64| Vector2::new(x, y);
        let square = [point(0.0, 0.0), point(4.0, 0.0), point(4.0, 4.0), point(0.0, 4.0), point(2.0, 2.0)];
        let corners = hull(&square);
        assert_eq!(corners.len(), 4);
        // Clockwise on the screen: the cross product is positive.
        assert!((0..4).all(|k| (corners[(k + 1) % 4] - corners[k]).perp(&(corners[(k + 2) % 4] - corners[k])) > 0.0));
        assert_eq!(hull(&[point(0.0, 0.0), point(1.0, 1.0), point(2.0, 2.0)]).len(), 2);
        assert_eq!(hull(&[point(1.0, 1.0), point(1.0, 1.0)]).len(), 1);
    }

    #[test]
    fn a_bar_is_a_rectangle_with_round_ends() {
        let path = link(&[Vector2::new(10.0, 20.0), Vector2::new(50.0, 20.0)]);
        assert_eq!(path, "M10 13l40 0a7 7 0 0 1 0 14l-40 0a7 7 0 0 1 0-14z");
    }
}
