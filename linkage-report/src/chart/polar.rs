//! Polar charts: vectors from one origin, as the load of a bearing over a turn.

use std::f64::consts::TAU;
use std::fmt::Write;

use super::axis::nice;
use super::render::{LETTER, path, style_of_file, titled};
use super::{COLOURS, Curve, Look};
use crate::sheet::escape;

/// The margins around the outermost circle, in pixels: for the title and for the angles.
const TOP: f64 = 46.0;
const SIDE: f64 = 40.0;

/// The circles of the grid, at most, and its rays.
const CIRCLES: f64 = 5.0;
const RAYS: u32 = 12;

/// Vectors from one origin as curves, with equal scales along x and y: radius and angle are those of each vector.
///
/// ```
/// use linkage::chart::Polar;
///
/// let load = (0..=90).map(|step| f64::from(4 * step).to_radians()).map(|a| [3.0 + a.cos(), 2.0 * a.sin()]);
/// let polar = Polar::new("the load of a bearing", "[N]").curve("load", load);
/// assert!(polar.to_svg().contains("<circle class=\"grid\""));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Polar {
    /// The title.
    pub title: String,
    /// The name or the unit of the radius.
    pub radius: String,
    /// The curves, the first ones below the others.
    pub curves: Vec<Curve>,
    /// Width and height in pixels.
    pub size: [f64; 2],
    /// True, by default, if the names of the curves are listed below the chart.
    pub has_legend: bool,
}

impl Polar {
    /// A chart without curves.
    #[must_use]
    pub fn new(title: impl Into<String>, radius: impl Into<String>) -> Self {
        let (title, radius) = (title.into(), radius.into());
        Self { title, radius, curves: Vec::new(), size: [400.0, 400.0], has_legend: true }
    }

    /// Adds a curve of vectors in the next colour.
    #[must_use]
    pub fn curve(mut self, name: impl Into<String>, vectors: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let curve = Curve { colour: self.curves.len(), ..Curve::new(name, Look::Line, vectors) };
        self.curves.push(curve);
        self
    }

    /// The chart as a file.
    #[must_use]
    pub fn to_svg(&self) -> String {
        self.svg(&style_of_file())
    }

    /// The chart as a part of a page that has the [`STYLE`](super::STYLE).
    #[must_use]
    pub fn to_svg_fragment(&self) -> String {
        self.svg("")
    }

    fn svg(&self, style: &str) -> String {
        let disc = Disc::of(self);
        let curves: String = self.curves.iter().map(|curve| disc.curve(curve)).collect();
        let drawn = disc.grid(&self.radius) + &curves;
        titled(style, &self.title, self.size, if self.has_legend { &self.curves } else { &[] }, &drawn)
    }
}

/// The circle within which vectors are drawn.
struct Disc {
    centre: [f64; 2],
    /// Its radius in pixels, and as the length of a vector.
    radius: f64,
    most: f64,
    /// The distance of circles.
    step: f64,
    /// The angle at which the circles have their labels.
    labels: f64,
}

impl Disc {
    fn of(chart: &Polar) -> Self {
        let points = chart.curves.iter().flat_map(|curve| curve.points.iter().flatten());
        let lengths = points.map(|[x, y]| x.hypot(*y)).filter(|length| length.is_finite());
        let longest = lengths.fold(0.0, f64::max);
        let longest = if longest > 0.0 { longest } else { 1.0 };
        let step = nice(longest / CIRCLES);
        let [width, height] = chart.size;
        let radius = ((height - TOP - SIDE) / 2.0).min(width / 2.0 - SIDE).max(1.0);
        // A vector that ends beyond a circle by its rounding error alone needs no further circle.
        let most = (longest / step - 1e-6).ceil() * step;
        let disc = Self { centre: [width / 2.0, TOP + radius], radius, most, step, labels: 0.0 };
        Self { labels: disc.free_angle(chart), ..disc }
    }

    /// The angle between two rays at which curves are farthest from the labels.
    fn free_angle(&self, chart: &Polar) -> f64 {
        let points: Vec<[f64; 2]> = chart
            .curves
            .iter()
            .flat_map(|curve| curve.points.iter().flatten())
            .filter_map(|point| self.at(*point))
            .collect();
        let room = |angle: f64| {
            let labels = (1..=self.circles()).map(|circle| self.around(angle, self.radius * self.part(circle)));
            let gaps = labels.flat_map(|[x, y]| points.iter().map(move |point| (point[0] - x).hypot(point[1] - y)));
            gaps.fold(f64::INFINITY, f64::min)
        };
        let angles = (0..RAYS).map(|ray| TAU * (f64::from(ray) + 0.5) / f64::from(RAYS));
        let free = |best: (f64, f64), angle: f64| {
            let room = room(angle);
            if room > best.1 { (angle, room) } else { best }
        };
        angles.fold((0.0, f64::NEG_INFINITY), free).0
    }

    /// The number of circles.
    fn circles(&self) -> u32 {
        (self.most / self.step).round() as u32
    }

    /// The radius of a circle as a part of the outermost.
    fn part(&self, circle: u32) -> f64 {
        f64::from(circle) / f64::from(self.circles())
    }

    /// The place of a vector; none if it is not finite.
    fn at(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let scale = self.radius / self.most;
        let place = [self.centre[0] + x * scale, self.centre[1] - y * scale];
        place.iter().all(|number| number.is_finite()).then_some(place)
    }

    /// The place at an angle, at so many pixels from the centre.
    fn around(&self, angle: f64, distance: f64) -> [f64; 2] {
        [self.centre[0] + distance * angle.cos(), self.centre[1] - distance * angle.sin()]
    }

    fn grid(&self, name: &str) -> String {
        let mut svg = String::new();
        let mut push = |text: std::fmt::Arguments<'_>| {
            // Writing to a string does not fail.
            _ = svg.write_fmt(text);
        };
        let [x, y] = self.centre;
        for ray in 0..RAYS {
            let angle = TAU * f64::from(ray) / f64::from(RAYS);
            let class = if ray % (RAYS / 4) == 0 { "zero" } else { "grid" };
            let [to_x, to_y] = self.around(angle, self.radius);
            push(format_args!("<path class=\"{class}\" d=\"M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}\"/>"));
            let [at_x, at_y] = self.around(angle, self.radius + 15.0);
            let degrees = 360 / RAYS * ray;
            push(format_args!("<text class=\"soft middle\" x=\"{at_x:.1}\" y=\"{:.1}\">{degrees}°</text>", at_y + 4.0));
        }
        let digits = (-(self.step * (1.0 + 1e-9)).log10().floor()).clamp(0.0, 9.0) as usize;
        for circle in 1..=self.circles() {
            let value = f64::from(circle) * self.step;
            let distance = self.radius * self.part(circle);
            push(format_args!(
                "<circle class=\"grid\" fill=\"none\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{distance:.1}\"/>"
            ));
            let [at_x, at_y] = self.around(self.labels, distance);
            push(format_args!(
                "<text class=\"soft middle mark\" x=\"{at_x:.1}\" y=\"{:.1}\">{value:.digits$}</text>",
                at_y + 3.5
            ));
        }
        let wide = LETTER * name.chars().count() as f64;
        let at = (2.0 * x - 8.0).max(wide);
        push(format_args!("<text class=\"soft end\" x=\"{at:.1}\" y=\"17\">{}</text>", escape(name)));
        svg
    }

    fn curve(&self, curve: &Curve) -> String {
        let places = || curve.points.iter().map(|point| point.and_then(|point| self.at(point)));
        let colour = curve.colour % COLOURS;
        let drawn = match curve.look {
            Look::Line | Look::Steps => format!("<path class=\"curve\" d=\"{}\"/>", path(places(), false)),
            Look::Dashed => format!("<path class=\"curve dashed\" d=\"{}\"/>", path(places(), false)),
            Look::Dots | Look::Rings | Look::Discs => super::render::signs(curve, places()),
        };
        format!("<g class=\"k{colour}\"><title>{}</title>{drawn}</g>", escape(&curve.name))
    }
}
