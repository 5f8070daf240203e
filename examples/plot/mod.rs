//! Plots of curves as SVG, and an HTML page for them.

use std::fmt::Write;

pub mod ticks;

use ticks::{label, nice, ticks};

/// The size of a plot and its margins, in pixels.
const SIZE: [f64; 2] = [360.0, 250.0];
const LEFT: f64 = 50.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 46.0;
const BOTTOM: f64 = 40.0;

/// The style of the gallery, and colours for light and dark mode.
const STYLE: &str = concat!(include_str!("../gallery/style.css"), include_str!("style.css"));

/// The colours of curves, used in turn.
const COLOURS: [&str; 4] = ["a", "b", "c", "d"];

/// A plot of curves over one axis.
pub struct Plot {
    title: String,
    axes: [String; 2],
    step: Option<f64>,
    curves: Vec<Curve>,
    marks: Vec<(String, Vec<[f64; 2]>)>,
}

struct Curve {
    name: String,
    points: Vec<[f64; 2]>,
}

impl Plot {
    /// Creates a plot without curves; the axes are named by their units.
    pub fn new(title: &str, x: &str, y: &str) -> Self {
        let axes = [x, y].map(str::to_owned);
        Self { title: title.to_owned(), axes, step: None, curves: Vec::new(), marks: Vec::new() }
    }

    /// Sets the distance of grid lines along x.
    pub fn every(mut self, step: f64) -> Self {
        self.step = Some(step);
        self
    }

    /// Adds a line through points; a single curve needs no name.
    pub fn curve(mut self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.curves.push(Curve { name: name.to_owned(), points: points.into_iter().collect() });
        self
    }

    /// Adds dots at points.
    pub fn marks(mut self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.marks.push((name.to_owned(), points.into_iter().collect()));
        self
    }

    fn range(&self, axis: usize) -> [f64; 2] {
        let points = self.curves.iter().flat_map(|curve| &curve.points).chain(self.marks.iter().flat_map(|(_, at)| at));
        points.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at[axis]), high.max(at[axis])])
    }

    /// Writes the SVG.
    pub fn svg(&self) -> String {
        let [x_range, y_range] = [self.range(0), self.range(1)];
        assert!([x_range, y_range].as_flattened().iter().all(|end| end.is_finite()), "{}: nothing to plot", self.title);
        let (x_step, y_step) = (self.step.unwrap_or_else(|| nice(x_range, 6.0)), nice(y_range, 5.0));
        // A rounding error beyond a grid line does not extend the range.
        let [low, high] = [(y_range[0] / y_step + 1e-6).floor(), (y_range[1] / y_step - 1e-6).ceil()];
        let [low, high] = [low * y_step, high * y_step];
        let x = |at: f64| LEFT + (at - x_range[0]) / (x_range[1] - x_range[0]) * (SIZE[0] - LEFT - RIGHT);
        let y = |at: f64| TOP + (high - at) / (high - low) * (SIZE[1] - TOP - BOTTOM);
        let (bottom, right) = (SIZE[1] - BOTTOM, SIZE[0] - RIGHT);
        let mut svg = format!(
            "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\">\
             <title>{}</title>",
            SIZE[0], SIZE[1], self.title
        );
        let mut push = |text: std::fmt::Arguments| {
            // Writing to a string does not fail.
            let _ = svg.write_fmt(text);
        };
        for at in ticks(x_range, x_step) {
            let (place, label) = (x(at), label(at, x_step));
            push(format_args!("<path class=\"grid\" d=\"M{place:.1} {TOP}V{bottom}\"/>"));
            push(format_args!("<text class=\"soft middle\" x=\"{place:.1}\" y=\"{}\">{label}</text>", bottom + 15.0));
        }
        for at in ticks([low, high], y_step) {
            let (place, label) = (y(at), label(at, y_step));
            let class = if at == 0.0 { "zero" } else { "grid" };
            push(format_args!("<path class=\"{class}\" d=\"M{LEFT} {place:.1}H{right}\"/>"));
            push(format_args!("<text class=\"soft end\" x=\"{}\" y=\"{:.1}\">{label}</text>", LEFT - 6.0, place + 4.0));
        }
        let [x_name, y_name] = &self.axes;
        push(format_args!("<text class=\"soft end\" x=\"{right}\" y=\"{}\">{x_name}</text>", bottom + 32.0));
        push(format_args!("<text x=\"8\" y=\"16\"><tspan class=\"name\">{}</tspan> {y_name}</text>", self.title));
        for (curve, colour) in self.curves.iter().zip(COLOURS.iter().cycle()) {
            let mut path = String::new();
            let mut last: Option<[f64; 2]> = None;
            for (place, at) in curve.points.iter().enumerate() {
                let next = [x(at[0]), y(at[1])];
                // Skip points closer than a pixel.
                let is_near = last.is_some_and(|last| (next[0] - last[0]).hypot(next[1] - last[1]) < 0.7);
                if !is_near || place + 1 == curve.points.len() {
                    let _ = write!(path, "{}{:.1} {:.1}", if last.is_none() { "M" } else { "L" }, next[0], next[1]);
                    last = Some(next);
                }
            }
            push(format_args!("<path class=\"curve {colour}\" d=\"{path}\"/>"));
        }
        for at in self.marks.iter().flat_map(|(_, points)| points) {
            push(format_args!("<circle class=\"mark\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"3\"/>", x(at[0]), y(at[1])));
        }
        let mut place = 8.0;
        for (curve, colour) in
            self.curves.iter().zip(COLOURS.iter().cycle()).filter(|(curve, _)| !curve.name.is_empty())
        {
            push(format_args!("<path class=\"curve {colour}\" d=\"M{place:.0} 30h14\"/>"));
            push(format_args!("<text class=\"soft\" x=\"{:.0}\" y=\"34\">{}</text>", place + 18.0, curve.name));
            place += 32.0 + 6.2 * curve.name.chars().count() as f64;
        }
        for (name, _) in &self.marks {
            push(format_args!("<circle class=\"mark\" cx=\"{:.0}\" cy=\"30\" r=\"3\"/>", place + 7.0));
            push(format_args!("<text class=\"soft\" x=\"{:.0}\" y=\"34\">{name}</text>", place + 18.0));
        }
        svg.push_str("</svg>");
        svg
    }
}

/// A section of a page: its name, and pictures with captions.
pub type Section = (&'static str, Vec<(String, String)>);

/// A table of a page.
pub struct Table {
    /// The heading above it.
    pub name: &'static str,
    /// The names of its columns; none without a head.
    pub head: Vec<String>,
    pub rows: Vec<Vec<String>>,
    /// A note below it; empty if there is none.
    pub remark: String,
}

/// Writes a page: title, introduction, pictures, and a table of numbers.
pub fn page(title: &str, about: &str, sections: &[Section], rows: &[[String; 2]]) -> String {
    let rows = rows.iter().map(|row| row.to_vec()).collect();
    let numbers = Table { name: "In numbers", head: Vec::new(), rows, remark: String::new() };
    page_with_tables(title, about, sections, &[numbers])
}

/// A cell with the sign of a number instead of a hyphen.
fn minus(cell: &str) -> String {
    let is_sign =
        |at: usize| cell[at..].starts_with('-') && cell[at + 1..].starts_with(|next: char| next.is_ascii_digit());
    cell.char_indices().map(|(at, letter)| if is_sign(at) { '−' } else { letter }).collect()
}

/// Writes a page: title, introduction, pictures and tables.
pub fn page_with_tables(title: &str, about: &str, sections: &[Section], tables: &[Table]) -> String {
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n<p>{about}</p>\n</header>\n<main>\n"
    );
    for (name, figures) in sections {
        let _ = writeln!(html, "<section>\n<h2>{name}</h2>\n<div class=\"grid\">");
        for (picture, words) in figures {
            let _ = writeln!(html, "<figure>\n{picture}\n<figcaption><p>{words}</p></figcaption>\n</figure>");
        }
        html.push_str("</div>\n</section>\n");
    }
    for Table { name, head, rows, remark } in tables {
        let kind = if head.is_empty() { "" } else { " class=\"wide\"" };
        let _ = writeln!(html, "<section>\n<h2>{name}</h2>\n<div{kind}><table>");
        for (kind, row) in [head]
            .into_iter()
            .filter(|head| !head.is_empty())
            .map(|head| (" class=\"head\"", head))
            .chain(rows.iter().map(|row| ("", row)))
        {
            let _ = write!(html, "<tr{kind}>");
            for (column, cell) in row.iter().enumerate() {
                let kind = if column == 0 { "th" } else { "td" };
                let _ = write!(html, "<{kind}>{}</{kind}>", if column == 0 { cell.clone() } else { minus(cell) });
            }
            html.push_str("</tr>\n");
        }
        html.push_str("</table></div>\n");
        if !remark.is_empty() {
            let _ = writeln!(html, "<p class=\"remark\">{remark}</p>");
        }
        html.push_str("</section>\n");
    }
    html.push_str("</main>\n</body>\n</html>\n");
    html
}
