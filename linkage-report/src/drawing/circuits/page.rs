//! Charts of circuits as an HTML page.

use super::CircuitChart;
use crate::sheet::{document, escape};

/// The page: `text` has an empty line between its paragraphs, and its lines stay.
pub(super) fn html(title: &str, text: &str, charts: &[CircuitChart]) -> String {
    let title = escape(title);
    let paragraphs = text.split("\n\n").map(|paragraph| escape(paragraph.trim()).replace('\n', "<br>\n"));
    let paragraphs: String = paragraphs.map(|paragraph| format!("<p>{paragraph}</p>\n")).collect();
    let charts: String = charts.iter().map(|chart| format!("<figure>\n{}\n</figure>\n", chart.to_svg())).collect();
    let body = format!(
        "<header>\n<p class=\"over\">Circuits</p>\n<h1>{title}</h1>\n</header>\n<section>\n{charts}</section>\n\
         <section>\n{paragraphs}</section>\n"
    );
    document(&title, &body)
}
