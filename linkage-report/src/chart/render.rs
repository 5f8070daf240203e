//! A chart as SVG.

use std::fmt::Write;

use super::{COLOURS, Chart, Curve, Line, Look, STYLE, Unit};
use crate::sheet::escape;

/// The margins, in pixels.
const TOP: f64 = 30.0;
const LEFT: f64 = 48.0;
const BOTTOM: f64 = 42.0;
const RIGHT: f64 = 16.0;

/// The width of a letter, and the height of a row of the legend.
pub(super) const LETTER: f64 = 6.3;
const ROW: f64 = 18.0;

/// The least distance of two labels at the right ends of curves.
const APART: f64 = 11.0;

/// The rows of the names of lines, at the top; a name without place in them is shown when the pointer rests on its line.
const ROWS_OF_NAMES: usize = 4;

/// The width of a letter of these names.
const SMALL_LETTER: f64 = 5.2;

/// Points nearer than this are drawn as one.
const NEAR: f64 = 0.5;

/// The places of values in pixels.
struct Frame<'a> {
    chart: &'a Chart,
    x: [f64; 2],
    y: [f64; 2],
    left: f64,
    right: f64,
    bottom: f64,
}

impl<'a> Frame<'a> {
    fn of(chart: &'a Chart) -> Self {
        let points = || chart.curves.iter().flat_map(|curve| curve.points.iter().flatten());
        let marks = chart.lines.iter().map(|line| line.at).chain(chart.spans.iter().flat_map(|span| span.ends));
        let left = match &chart.y.unit {
            Unit::Names(names) => {
                LETTER * names.iter().map(|name| name.chars().count()).max().unwrap_or(0) as f64 + 18.0
            }
            _ => LEFT,
        };
        let has_labels = chart.curves.iter().any(|curve| curve.look != Look::Discs && !curve.label.is_empty());
        Self {
            chart,
            x: chart.x.ends(points().map(|point| point[0]).chain(marks), false),
            y: chart.y.ends(points().map(|point| point[1]), true),
            left,
            right: chart.size[0] - RIGHT - if has_labels { 14.0 } else { 0.0 },
            bottom: chart.size[1] - BOTTOM,
        }
    }

    /// The place of a distance along the axis x.
    fn across(&self, measure: f64) -> f64 {
        self.left + (measure - self.x[0]) / (self.x[1] - self.x[0]) * (self.right - self.left)
    }

    /// The place of a distance along the axis y.
    fn down(&self, measure: f64) -> f64 {
        TOP + (self.y[1] - measure) / (self.y[1] - self.y[0]) * (self.bottom - TOP)
    }

    /// The place of a point; none if it has none on these axes.
    fn at(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let Chart { x: across, y: up, .. } = self.chart;
        (across.has(x) && up.has(y)).then(|| [self.across(across.measure(x)), self.down(up.measure(y))])
    }
}

impl Chart {
    pub(super) fn svg(&self, style: &str) -> String {
        let frame = Frame::of(self);
        let curves: String = self.curves.iter().map(|curve| frame.curve(curve)).collect();
        let drawn = [frame.spans(), frame.grid(), frame.lines(), curves, frame.labels()].concat();
        titled(style, &self.title, self.size, if self.has_legend { &self.curves } else { &[] }, &drawn)
    }
}

/// The style of a chart that is a file of its own.
pub(super) fn style_of_file() -> String {
    format!("<style>.chart{{background:var(--card)}}{STYLE}</style>")
}

/// A chart under its title, above the legend of these curves; `drawn` is what is between them.
pub(super) fn titled(style: &str, title: &str, size: [f64; 2], curves: &[Curve], drawn: &str) -> String {
    let legend = legend(curves, size[0]);
    let rows = legend.last().map_or(0.0, |(_, [_, row])| row + 1.0);
    let [width, height] = [size[0], size[1] + ROW * rows];
    let (title, legend) = (escape(title), legend_at(&legend, size[1]));
    format!(
        "<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         aria-label=\"{title}\">{style}<text class=\"title\" x=\"8\" y=\"17\">{title}</text>{drawn}{legend}</svg>"
    )
}

/// The curves with names, each with its x and its row, in a legend of this width.
fn legend(curves: &[Curve], width: f64) -> Vec<(&Curve, [f64; 2])> {
    let mut next = [8.0, 0.0];
    let named = curves.iter().filter(|curve| !curve.name.is_empty());
    let placed = named.map(|curve| {
        let wide = 42.0 + LETTER * curve.name.chars().count() as f64;
        if next[0] > 8.0 && next[0] + wide > width {
            next = [8.0, next[1] + 1.0];
        }
        let at = next;
        next[0] += wide;
        (curve, at)
    });
    placed.collect()
}

/// A legend below this height.
fn legend_at(legend: &[(&Curve, [f64; 2])], height: f64) -> String {
    let entries = legend.iter().map(|(curve, [x, row])| {
        let y = height + ROW * row;
        format!(
            "<g class=\"k{}\">{}<text class=\"soft\" x=\"{:.0}\" y=\"{:.0}\">{}</text></g>",
            curve.colour % COLOURS,
            swatch(curve, *x, y + 5.0),
            x + 21.0,
            y + 9.0,
            escape(&curve.name)
        )
    });
    entries.collect()
}

/// The sign of a curve in the legend.
fn swatch(curve: &Curve, x: f64, y: f64) -> String {
    let middle = x + 7.0;
    match curve.look {
        Look::Line | Look::Steps => format!("<path class=\"curve\" d=\"M{x:.0} {y:.0}h14\"/>"),
        Look::Dashed => format!("<path class=\"curve dashed\" d=\"M{x:.0} {y:.0}h14\"/>"),
        Look::Dots => format!("<circle class=\"dot\" cx=\"{middle:.0}\" cy=\"{y:.0}\" r=\"3.5\"/>"),
        Look::Rings => format!("<circle class=\"ring\" cx=\"{middle:.0}\" cy=\"{y:.0}\" r=\"4\"/>"),
        Look::Discs => disc([middle, y], &curve.label),
    }
}

fn disc([x, y]: [f64; 2], label: &str) -> String {
    let label = escape(label);
    format!(
        "<circle class=\"disc\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"8\"/><text class=\"label middle\" x=\"{x:.1}\" y=\"{:.1}\">{label}</text>",
        y + 3.6
    )
}

impl Frame<'_> {
    fn grid(&self) -> String {
        let (chart, mut svg) = (self.chart, String::new());
        let (left, right, bottom) = (self.left, self.right, self.bottom);
        let mut push = |text: std::fmt::Arguments<'_>| {
            let _ = svg.write_fmt(text);
        };
        for tick in chart.x.ticks(self.x) {
            let (x, label) = (self.across(tick.at), escape(&tick.label));
            push(format_args!("<path class=\"grid\" d=\"M{x:.1} {TOP}V{bottom}\"/>"));
            // The label of the last line is not cut.
            let x = x.min(chart.size[0] - 4.0 - 0.5 * LETTER * tick.label.chars().count() as f64);
            push(format_args!("<text class=\"soft middle\" x=\"{x:.1}\" y=\"{:.1}\">{label}</text>", bottom + 15.0));
        }
        for tick in chart.y.ticks(self.y) {
            let (y, label) = (self.down(tick.at), escape(&tick.label));
            let class = if tick.at == 0.0 && chart.y == super::Axis::linear(&*chart.y.name) { "zero" } else { "grid" };
            push(format_args!("<path class=\"{class}\" d=\"M{left:.1} {y:.1}H{right:.1}\"/>"));
            push(format_args!("<text class=\"soft end\" x=\"{:.1}\" y=\"{:.1}\">{label}</text>", left - 6.0, y + 4.0));
        }
        let [across, up] = [&chart.x.name, &chart.y.name].map(|name| escape(name));
        push(format_args!("<text class=\"soft end\" x=\"{right:.1}\" y=\"{:.1}\">{across}</text>", bottom + 32.0));
        if !up.is_empty() {
            let x = chart.size[0] - 8.0;
            push(format_args!("<text class=\"soft end\" x=\"{x:.1}\" y=\"17\">{up}</text>"));
        }
        svg
    }

    fn spans(&self) -> String {
        let spans = self.chart.spans.iter().map(|span| {
            let [from, to] = span.ends.map(|end| self.across(self.chart.x.measure(end)));
            let (x, wide) = (from.min(to), (to - from).abs().max(1.5));
            format!(
                "<rect class=\"span\" x=\"{x:.1}\" y=\"{TOP}\" width=\"{wide:.1}\" height=\"{:.1}\"><title>{}</title></rect>",
                self.bottom - TOP,
                escape(&span.name)
            )
        });
        spans.collect()
    }

    fn lines(&self) -> String {
        let mut lines: Vec<&Line> = self.chart.lines.iter().filter(|line| self.chart.x.has(line.at)).collect();
        lines.sort_by(|one, other| one.at.total_cmp(&other.at));
        // The right end of the last label in each row.
        let mut ends = [f64::NEG_INFINITY; ROWS_OF_NAMES];
        let drawn = lines.into_iter().map(|line| {
            let x = self.across(self.chart.x.measure(line.at));
            let (name, bottom) = (escape(&line.name), self.bottom);
            let wide = SMALL_LETTER * line.name.chars().count() as f64;
            let from = (x + 3.0).min(self.right - wide);
            let fits = !name.is_empty() && wide < (self.right - self.left) / 2.0;
            let row = ends.iter().position(|end| fits && *end < from);
            let label = row.map(|row| {
                ends[row] = from + wide + 4.0;
                let y = TOP + 10.0 + APART * row as f64;
                format!("<text class=\"soft mark\" x=\"{from:.1}\" y=\"{y:.1}\">{name}</text>")
            });
            let line = format!("<path class=\"line\" d=\"M{x:.1} {TOP}V{bottom:.1}\"><title>{name}</title></path>");
            (line, label.unwrap_or_default())
        });
        let (lines, labels): (String, String) = drawn.unzip();
        lines + &labels
    }

    fn curve(&self, curve: &Curve) -> String {
        let places = || curve.points.iter().map(|point| point.and_then(|point| self.at(point)));
        let colour = curve.colour % COLOURS;
        let name = escape(&curve.name);
        let drawn = match curve.look {
            Look::Line => format!("<path class=\"curve\" d=\"{}\"/>", path(places(), false)),
            Look::Dashed => format!("<path class=\"curve dashed\" d=\"{}\"/>", path(places(), false)),
            Look::Steps => format!("<path class=\"curve\" d=\"{}\"/>", path(places(), true)),
            Look::Dots | Look::Rings | Look::Discs => signs(curve, places()),
        };
        format!("<g class=\"k{colour}\"><title>{name}</title>{drawn}</g>")
    }

    /// The labels of lines right of their ends, moved upwards where they would overlap, and downwards at the top.
    fn labels(&self) -> String {
        let labelled = self.chart.curves.iter().filter(|curve| curve.look != Look::Discs && !curve.label.is_empty());
        let end = |curve: &Curve| curve.points.iter().rev().flatten().find_map(|point| self.at(*point));
        let mut ends: Vec<(&Curve, f64)> = labelled.filter_map(|curve| Some((curve, end(curve)?[1]))).collect();
        ends.sort_by(|(_, one), (_, other)| other.total_cmp(one));
        let mut below = self.bottom + APART;
        for (_, y) in &mut ends {
            *y = y.min(below - APART);
            below = *y;
        }
        // From the top downwards again, so that none is above the curves.
        let mut above = TOP - APART;
        for (_, y) in ends.iter_mut().rev() {
            *y = y.max(above + APART);
            above = *y;
        }
        let labels = ends.into_iter().map(|(curve, y)| {
            let (x, colour, label) = (self.right + 5.0, curve.colour % COLOURS, escape(&curve.label));
            format!("<g class=\"k{colour}\"><text class=\"label\" x=\"{x:.1}\" y=\"{:.1}\">{label}</text></g>", y + 3.6)
        });
        labels.collect()
    }
}

/// The sign of a curve at each place.
pub(super) fn signs(curve: &Curve, places: impl Iterator<Item = Option<[f64; 2]>>) -> String {
    let each = places.flatten().map(|[x, y]| match curve.look {
        Look::Rings => format!("<circle class=\"ring\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\"/>"),
        Look::Discs => disc([x, y], &curve.label),
        _ => format!("<circle class=\"dot\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>"),
    });
    each.collect()
}

/// The path through places; a gap begins a new part.
pub(super) fn path(places: impl Iterator<Item = Option<[f64; 2]>>, in_steps: bool) -> String {
    let mut path = String::new();
    let mut last: Option<[f64; 2]> = None;
    let mut places = places.peekable();
    while let Some(place) = places.next() {
        let Some([x, y]) = place else {
            last = None;
            continue;
        };
        let _ = match (last, in_steps) {
            (None, _) => write!(path, "M{x:.1} {y:.1}"),
            (Some(_), true) => write!(path, "H{x:.1}V{y:.1}"),
            (Some([x0, y0]), false) => {
                let ends_here = !matches!(places.peek(), Some(Some(_)));
                if (x - x0).hypot(y - y0) < NEAR && !ends_here {
                    continue;
                }
                write!(path, "L{x:.1} {y:.1}")
            }
        };
        last = place;
    }
    path
}
