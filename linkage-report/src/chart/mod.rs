//! Charts as SVG: curves over linear and logarithmic axes, and vectors from one origin, without script, for light and
//! dark mode. [`Chart::of`] and [`Polar::of`] draw columns of a [`Table`](crate::Table).
//!
//! ```
//! use linkage::chart::{Axis, Chart, Curve, Look, Unit};
//!
//! let sine = (0..=90).map(|step| f64::from(step).to_radians() * 4.0).map(|angle| [angle, angle.sin()]);
//! let mut chart = Chart::new("sine", Axis::linear("angle").unit(Unit::Degrees), Axis::linear("value"));
//! chart.curves.push(Curve::new("sin", Look::Line, sine));
//! assert!(chart.to_svg().contains("<path class=\"curve\""));
//! ```

mod axis;
#[cfg(feature = "dynamics")]
mod of_simulation;
mod of_table;
mod page;
mod polar;
mod render;

pub use axis::{Axis, Scale, Unit};
pub use page::{Page, Section};
pub use polar::Polar;

/// The style of charts, for pages that hold fragments of them.
pub const STYLE: &str = include_str!("style.css");

/// Curves over two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The title.
    pub title: String,
    /// The axis from left to right.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// The curves, the first ones below the others.
    pub curves: Vec<Curve>,
    /// Dashed lines upwards, with their names at the top.
    pub lines: Vec<Line>,
    /// Shaded parts of the axis x.
    pub spans: Vec<Span>,
    /// Width and height in pixels.
    pub size: [f64; 2],
    /// True, by default, if the names of the curves are listed below the chart.
    pub has_legend: bool,
}

/// Points of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The name, in the legend and when the pointer rests on the curve.
    pub name: String,
    /// A short name at its right end or, with [`Look::Discs`], in its points.
    pub label: String,
    /// The colour, counted from 0, of [`COLOURS`] in turn.
    pub colour: usize,
    /// The way in which it is drawn.
    pub look: Look,
    /// The points; a curve is broken where there is none.
    pub points: Vec<Option<[f64; 2]>>,
}

/// The number of colours; the next curve has the first one again.
pub const COLOURS: usize = 10;

/// The way in which points are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// A line through the points.
    Line,
    /// A dashed line through the points.
    Dashed,
    /// A line that keeps the value of a point until the next.
    Steps,
    /// A dot at each point.
    Dots,
    /// A circle at each point.
    Rings,
    /// A disc with the label at each point.
    Discs,
}

/// A place on the axis x.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// The place.
    pub at: f64,
    /// Its name.
    pub name: String,
}

/// A part of the axis x.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    /// Its ends.
    pub ends: [f64; 2],
    /// Its name.
    pub name: String,
}

impl Chart {
    /// A chart without curves.
    #[must_use]
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            curves: Vec::new(),
            lines: Vec::new(),
            spans: Vec::new(),
            size: [400.0, 280.0],
            has_legend: true,
        }
    }

    /// Adds a curve in the next colour.
    #[must_use]
    pub fn curve(mut self, name: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let curve = Curve { colour: self.curves.len(), ..Curve::new(name, Look::Line, points) };
        self.curves.push(curve);
        self
    }

    /// The chart as a file.
    #[must_use]
    pub fn to_svg(&self) -> String {
        self.svg(&render::style_of_file())
    }

    /// The chart as a part of a page that has the [`STYLE`].
    #[must_use]
    pub fn to_svg_fragment(&self) -> String {
        self.svg("")
    }
}

impl Curve {
    /// A curve in the first colour.
    #[must_use]
    pub fn new(name: impl Into<String>, look: Look, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let points = points.into_iter().map(Some).collect();
        Self { name: name.into(), label: String::new(), colour: 0, look, points }
    }
}
