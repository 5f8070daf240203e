//! Charts of cells, paths and dots as SVG.

use std::fmt::Write;

use crate::density::{Cells, Grid};
use crate::ticks::{label, nice, ticks};

/// The width of a chart and its margins, in pixels.
const WIDTH: f64 = 400.0;
const LEFT: f64 = 54.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 42.0;

/// The shades of cells, on a logarithmic scale.
const SHADES: u32 = 6;

/// A chart over two axes.
pub struct Chart {
    x: [f64; 2],
    y: [f64; 2],
    height: f64,
    svg: String,
}

impl Chart {
    /// Axes over two ranges, with their names; the height is in pixels, or follows from equal scales.
    pub fn new(title: &str, [x, y]: [[f64; 2]; 2], names: [&str; 2], height: Option<f64>) -> Self {
        let equal = (WIDTH - LEFT - RIGHT) / (x[1] - x[0]) * (y[1] - y[0]);
        let height = height.unwrap_or(equal + TOP + BOTTOM);
        let svg = format!(
            "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\">\
             <title>{title}</title>"
        );
        let mut chart = Self { x, y, height, svg };
        chart.axes(names);
        chart
    }

    fn push(&mut self, text: std::fmt::Arguments) {
        // Writing to a string does not fail.
        let _ = self.svg.write_fmt(text);
    }

    /// The place of a point, in pixels.
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let right = (x - self.x[0]) / (self.x[1] - self.x[0]);
        let up = (y - self.y[0]) / (self.y[1] - self.y[0]);
        [LEFT + right * (WIDTH - LEFT - RIGHT), self.height - BOTTOM - up * (self.height - TOP - BOTTOM)]
    }

    fn contains(&self, [x, y]: [f64; 2]) -> bool {
        (self.x[0]..=self.x[1]).contains(&x) && (self.y[0]..=self.y[1]).contains(&y)
    }

    fn axes(&mut self, [x_name, y_name]: [&str; 2]) {
        let (bottom, right) = (self.height - BOTTOM, WIDTH - RIGHT);
        let steps = [nice(self.x, 6.0), nice(self.y, 5.0)];
        for at in ticks(self.x, steps[0]) {
            let ([place, _], text) = (self.at([at, 0.0]), label(at, steps[0]));
            self.push(format_args!("<path class=\"grid\" d=\"M{place:.1} {TOP}V{bottom:.1}\"/>"));
            self.push(format_args!(
                "<text class=\"soft middle\" x=\"{place:.1}\" y=\"{:.1}\">{text}</text>",
                bottom + 15.0
            ));
        }
        for at in ticks(self.y, steps[1]) {
            let ([_, place], text) = (self.at([0.0, at]), label(at, steps[1]));
            self.push(format_args!("<path class=\"grid\" d=\"M{LEFT} {place:.1}H{right}\"/>"));
            let left = LEFT - 6.0;
            self.push(format_args!("<text class=\"soft end\" x=\"{left}\" y=\"{:.1}\">{text}</text>", place + 4.0));
        }
        self.push(format_args!("<text class=\"soft end\" x=\"{right}\" y=\"{:.1}\">{x_name}</text>", bottom + 33.0));
        let middle = (TOP + bottom) / 2.0;
        self.push(format_args!(
            "<text class=\"soft middle\" transform=\"translate(12 {middle:.1}) rotate(-90)\">{y_name}</text>"
        ));
    }

    /// Adds the cells of a grid, of a stronger colour with more points.
    pub fn cells(mut self, grid: &Grid, cells: &Cells) -> Self {
        let most = cells.counts.iter().copied().max().unwrap_or(0) as f64;
        let shade = |count: u64| match count {
            0 => 0,
            count if most <= 1.0 || count as f64 >= most => SHADES,
            count => 1 + ((count as f64).ln() / most.ln() * f64::from(SHADES)) as u32,
        };
        let [left, low] = self.at([grid.x[0], grid.y[0]]);
        let [right, high] = self.at([grid.x[1], grid.y[1]]);
        let [columns, rows] = grid.cells;
        let scale = [(right - left) / columns as f64, (high - low) / rows as f64];
        self.push(format_args!(
            "<g class=\"cells\" transform=\"translate({left:.2} {low:.2}) scale({:.5} {:.5})\">",
            scale[0], scale[1]
        ));
        for wanted in 1..=SHADES {
            let mut path = String::new();
            for (row, counts) in cells.counts.chunks(columns).enumerate() {
                let mut column = 0;
                // Neighbours of one shade are one rectangle.
                for run in counts.chunk_by(|a, b| shade(*a) == shade(*b)) {
                    if shade(run[0]) == wanted {
                        let _ = write!(path, "M{column} {row}h{0}v1h-{0}z", run.len());
                    }
                    column += run.len();
                }
            }
            self.push(format_args!("<path class=\"shade{wanted}\" d=\"{path}\"/>"));
        }
        self.push(format_args!("</g>"));
        self
    }

    /// Adds a closed line through points.
    pub fn path(mut self, class: &str, points: &[[f64; 2]]) -> Self {
        let mut path = String::new();
        for (place, point) in points.iter().enumerate() {
            let [x, y] = self.at(*point);
            let _ = write!(path, "{}{x:.1} {y:.1}", if place == 0 { "M" } else { "L" });
        }
        self.push(format_args!("<path class=\"curve {class}\" d=\"{path}z\"/>"));
        self
    }

    /// Adds the dots that are within the axes.
    pub fn dots(mut self, class: &str, radius: f64, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        for point in points {
            if !self.contains(point) {
                continue;
            }
            let [x, y] = self.at(point);
            self.push(format_args!("<circle class=\"dot {class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"/>"));
        }
        self
    }

    /// Adds a dot with a letter above it, if it is within the axes.
    pub fn mark(mut self, class: &str, letter: char, point: [f64; 2]) -> Self {
        if !self.contains(point) {
            return self;
        }
        let [x, y] = self.at(point);
        self.push(format_args!("<circle class=\"dot {class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"/>"));
        self.push(format_args!("<text class=\"name middle\" x=\"{x:.1}\" y=\"{:.1}\">{letter}</text>", y - 8.0));
        self
    }

    /// Ends the SVG.
    pub fn svg(self) -> String {
        self.svg + "</svg>"
    }
}
