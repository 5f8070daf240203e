//! The pages of prices.

use crate::chart::{self, Chart};
use crate::sheet::document;

/// Errors below are drawn here: a result may be exact.
pub(super) const LEAST: f64 = 1e-34;

/// Additions to the style of sheets.
const STYLE: &str = include_str!("style.css");

/// A table with a column of names.
pub(super) fn table(caption: &str, heads: &[&str], rows: impl Iterator<Item = String>) -> String {
    let heads: String = heads.iter().map(|head| format!("<td>{head}</td>")).collect();
    let rows: String = rows.collect();
    format!(
        "<div class=\"wide\"><table><caption>{caption}</caption>\n<tr><th></th>{heads}</tr>\n{rows}</table></div>\n"
    )
}

/// The style of the fragments of prices, for a page that has that of sheets.
#[must_use]
pub fn style() -> String {
    format!("{}{STYLE}", chart::STYLE)
}

/// A page with this heading, and these sections.
pub(super) fn page(name: &str, over: &str, sections: &str) -> String {
    let style = style();
    let header = format!("<header>\n<p class=\"over\">{over}</p>\n<h1>{name}</h1>\n</header>\n");
    document(name, &format!("<style>{style}</style>\n<div class=\"price\">\n{header}{sections}</div>\n"))
}

/// A section of charts.
pub(super) fn figures(heading: &str, about: &str, charts: impl Iterator<Item = Chart>) -> String {
    let charts: String = charts.map(|chart| format!("<figure>{}</figure>\n", chart.to_svg_fragment())).collect();
    format!("<section>\n<h2>{heading}</h2>\n<p>{about}</p>\n<div class=\"charts\">\n{charts}</div>\n</section>\n")
}
