//! Plots of curves as SVG, and an HTML page for them.

use std::fmt::Write;

use linkage::chart::{self, Axis, Chart, Curve, Look};

/// The style of the gallery, and colours for light and dark mode.
const STYLE: &str = concat!(include_str!("../gallery/style.css"), include_str!("style.css"));

/// A plot of curves over one axis.
pub struct Plot(Chart);

impl Plot {
    /// Creates a plot without curves; the axes are named by their units.
    pub fn new(title: &str, x: &str, y: &str) -> Self {
        let mut chart = Chart::new(title, Axis::linear(x), Axis::linear(y));
        chart.size = [360.0, 250.0];
        Self(chart)
    }

    /// Sets the distance of grid lines along x.
    pub fn every(mut self, step: f64) -> Self {
        self.0.x.step = Some(step);
        self
    }

    /// Adds a line through points; a single curve needs no name.
    pub fn curve(self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        Self(self.0.curve(name, points))
    }

    /// Adds dots at points.
    pub fn marks(mut self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.0.curves.push(Curve { colour: 3, ..Curve::new(name, Look::Dots, points) });
        self
    }

    /// Writes the SVG.
    pub fn svg(&self) -> String {
        let points = self.0.curves.iter().flat_map(|curve| curve.points.iter().flatten());
        assert!(points.clone().count() > 0, "{}: nothing to plot", self.0.title);
        assert!(points.flatten().all(|number| number.is_finite()), "{}: not finite", self.0.title);
        self.0.to_svg_fragment()
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
         <style>{}{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n<p>{about}</p>\n</header>\n<main>\n",
        chart::STYLE
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
