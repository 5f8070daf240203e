//! Axes of the chart, and curves cut where an angle has made a whole turn.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector2;

use crate::drawing::axes;

/// An axis of the chart.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub name: String,
    pub is_angle: bool,
    pub low: f64,
    pub high: f64,
}

impl Axis {
    /// The axis of an angle is one turn from `turn_from`, that of a length the range of its values.
    pub fn new(name: &str, is_angle: bool, turn_from: f64, values: impl Iterator<Item = f64>) -> Self {
        let name = name.to_owned();
        if is_angle {
            return Self { name, is_angle, low: turn_from, high: turn_from + TAU };
        }
        let (low, high) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        // Room on both sides; for one value about its magnitude, or 1.
        let size = [high - low, low.abs(), 1.0].into_iter().find(|size| *size > 0.0).unwrap_or(1.0);
        Self { name, is_angle, low: low - 0.05 * size, high: high + 0.05 * size }
    }

    /// The number of whole turns below a value.
    fn tile(&self, at: f64) -> f64 {
        if self.is_angle { ((at - self.low) / TAU).floor() } else { 0.0 }
    }

    /// The value on the axis, and the fraction of the axis below it.
    pub fn fraction(&self, at: f64) -> f64 {
        (at - self.tile(at) * TAU - self.low) / (self.high - self.low)
    }

    /// The marks of the axis and their texts.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        if self.is_angle {
            let first = (self.low / (PI / 2.0)).round();
            let angle = |quarter: u32| (first + f64::from(quarter)) * PI / 2.0;
            return (0..=4).map(angle).map(|at| (at, self.text(at))).collect();
        }
        let values = axes::ticks(self.low, self.high);
        values.into_iter().map(|at| (at, axes::label(at, self.low, self.high).replace('-', "−"))).collect()
    }

    /// A value of the axis in degrees, or as a length.
    pub fn text(&self, at: f64) -> String {
        let text = if self.is_angle {
            let text = format!("{:.1}", at.to_degrees());
            format!("{}°", text.trim_end_matches('0').trim_end_matches('.'))
        } else {
            let digits = (3.0 - (self.high - self.low).log10().floor()).clamp(0.0, 12.0) as usize;
            format!("{at:.digits$}")
        };
        text.replace('-', "−")
    }

    /// The value modulo whole turns, on the axis.
    pub fn on_axis(&self, at: f64) -> f64 {
        at - self.tile(at) * TAU
    }
}

/// The parts of a curve, as fractions of the axes, cut where one of its coordinates passes the end of its axis.
pub(super) fn runs(axes: &[Axis; 2], curve: &[Vector2<f64>]) -> Vec<Vec<Vector2<f64>>> {
    let tiles = |at: &Vector2<f64>| Vector2::new(axes[0].tile(at.x), axes[1].tile(at.y));
    let placed = |at: Vector2<f64>, tile: Vector2<f64>| {
        let at = at - tile * TAU;
        Vector2::new(
            (at.x - axes[0].low) / (axes[0].high - axes[0].low),
            (at.y - axes[1].low) / (axes[1].high - axes[1].low),
        )
    };
    let Some(first) = curve.first() else { return Vec::new() };
    let mut tile = tiles(first);
    let mut runs = vec![vec![placed(*first, tile)]];
    for ends in curve.windows(2) {
        let (mut from, to) = (ends[0], ends[1]);
        // A step of a path is shorter than half a turn: it passes one end of each axis at most.
        for _ in 0..2 {
            let Some((part, axis)) = first_end(axes, tile, from, to) else { break };
            let at = from + (to - from) * part;
            push(&mut runs, placed(at, tile));
            tile[axis] += (to - from)[axis].signum();
            runs.push(vec![placed(at, tile)]);
            from = at;
        }
        push(&mut runs, placed(to, tile));
    }
    runs.retain(|run| run.len() > 1);
    runs
}

fn push(runs: &mut [Vec<Vector2<f64>>], at: Vector2<f64>) {
    if let Some(run) = runs.last_mut() {
        run.push(at);
    }
}

/// The first end of an axis on the line between two points, as the fraction of the line and the axis.
fn first_end(axes: &[Axis; 2], tile: Vector2<f64>, from: Vector2<f64>, to: Vector2<f64>) -> Option<(f64, usize)> {
    let part = |axis: usize| {
        let [low, high] = [axes[axis].low, axes[axis].high].map(|end| end + tile[axis] * TAU);
        let end = if to[axis] > high { high } else { low };
        let is_beyond = axes[axis].is_angle && (to[axis] > high || to[axis] < low);
        is_beyond.then(|| (((end - from[axis]) / (to[axis] - from[axis])).clamp(0.0, 1.0), axis))
    };
    [0, 1].into_iter().filter_map(part).min_by(|one, other| one.0.total_cmp(&other.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turns() -> [Axis; 2] {
        [Axis::new("input", true, 0.0, [].into_iter()), Axis::new("angle", true, -PI, [].into_iter())]
    }

    /// A diagonal over two turns leaves through both ends, and each part is a diagonal.
    #[test]
    fn curves_are_cut_at_the_ends_of_both_axes() {
        let curve: Vec<_> = (0..=80).map(|step| Vector2::repeat(TAU * f64::from(step) / 40.0 + 0.05)).collect();
        let parts = runs(&turns(), &curve);
        assert_eq!(parts.len(), 5);
        for part in &parts {
            assert!(part.iter().flatten().all(|&at| (-1e-12..=1.0 + 1e-12).contains(&at)), "{part:?}");
            let along = part[part.len() - 1] - part[0];
            assert!((along.x - along.y).abs() < 1e-12 && along.x > 0.0, "{part:?}");
        }
        let length: f64 = parts.iter().map(|part| part[part.len() - 1].x - part[0].x).sum();
        assert!((length - 2.0).abs() < 1e-12, "{length}");
    }

    #[test]
    fn lengths_are_not_cut_and_have_room() {
        let axes = [Axis::new("s", false, 0.0, [2.0, 4.0].into_iter()), turns()[1].clone()];
        assert_eq!(runs(&axes, &[Vector2::new(2.0, 0.0), Vector2::new(4.0, 0.5)]).len(), 1);
        assert!(axes[0].low < 2.0 && axes[0].high > 4.0);
        assert_eq!(
            axes[0].ticks().iter().map(|(_, text)| text.as_str()).collect::<Vec<_>>(),
            ["2.0", "2.5", "3.0", "3.5", "4.0"]
        );
        assert_eq!((axes[0].text(3.0), turns()[1].text(-PI / 2.0)), ("3.000".to_owned(), "−90°".to_owned()));
        let one = Axis::new("s", false, 0.0, [0.0].into_iter());
        assert!(one.low < 0.0 && one.high > 0.0);
    }
}
