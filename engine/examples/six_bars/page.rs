//! The page.

use std::error::Error;
use std::fmt::Write;

use linkage_engine::mechanisms::six_bar::FootPath;

use crate::legs::{FINE, Leg};
use crate::picture;
use crate::query::{RANGES, Row};

/// The style of the gallery, of plots, and of this page.
const STYLE: &str = concat!(
    include_str!("../../../examples/gallery/style.css"),
    include_str!("../../../examples/plot/style.css"),
    include_str!("style.css")
);

/// The meaning of the dimensions.
const DIMENSIONS: &str = "<p class=\"dimensions\">Unfold a design for its dimensions, relative to the crank A-B: coupler B-C, \
    rocker D-C, ground A-D, leg P-Q, lever F-Q. P is at (<i>px</i>, <i>py</i>) from B with the first axis towards C, the foot \
    at (<i>u</i>, <i>v</i>) from P with the first axis towards Q, and F at (<i>fx</i>, <i>fy</i>) from A with the first axis \
    towards D. C is to the left on the way from B to D, Q to the right on the way from P to F.</p>\n";

/// The legs that are shown in motion.
const MOVING: usize = 3;

/// The page of an answer. `numbers` are names and values of the last table.
pub fn html(
    legs: &[Leg],
    curve: &FootPath,
    designs: u64,
    query: &str,
    numbers: &[[String; 2]],
) -> Result<String, Box<dyn Error>> {
    let curve = curve.at(FINE).ok_or("no curve")?;
    let (count, designs) = (legs.len(), thousands(designs));
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>Six-bar legs</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>The best {count} of {designs} six-bars</h1>\n\
         <p>A leg of Theo Jansen's walking machine has eight links: which six-bar brings its foot along the same path? Each \
         design is a Stephenson III six-bar with random dimensions, over a turn of its crank at constant speed. Its foot \
         should be where Jansen's is, position by position, after the best shift, rotation and scale. Distance is the root \
         mean square of the gaps, relative to the width of the given curve; the angle is the least transmission angle, \
         between coupler and rocker or leg and lever; size is the larger side of the box around all positions and clearance \
         the height of the lowest joint, both relative to the same width.</p>\n\
         <p class=\"key\"><span class=\"given\">given curve</span> <span class=\"trace\">path of the foot</span> \
         <span class=\"crank\">crank</span> <span class=\"shank\">leg</span></p>\n</header>\n<main>\n\
         <section>\n<h2>The closest in motion</h2>\n<div class=\"grid closest\">\n"
    );
    // Writing to a string does not fail.
    for (place, leg) in legs.iter().take(MOVING).enumerate() {
        let caption = caption(place, &leg.row);
        let _ = writeln!(
            html,
            "<figure>\n{}\n<figcaption>{caption}</figcaption>\n</figure>",
            picture::moving(leg, &curve)?
        );
    }
    html.push_str("</div>\n</section>\n<section>\n<h2>All, the closest first</h2>\n");
    html.push_str(DIMENSIONS);
    html.push_str("<div class=\"grid all\">\n");
    for (place, leg) in legs.iter().enumerate() {
        let (picture, caption) = (picture::still(leg, &curve), caption(place, &leg.row));
        let _ = writeln!(html, "<figure>\n{picture}\n<figcaption>{caption}{}</figcaption>\n</figure>", lengths(leg));
    }
    let _ = write!(
        html,
        "</div>\n</section>\n<section>\n<h2>The query</h2>\n<pre>{}</pre>\n</section>\n\
         <section>\n<h2>In numbers</h2>\n<table>\n",
        escape(query)
    );
    for [name, value] in numbers {
        let _ = writeln!(html, "<tr><th>{name}</th><td>{value}</td></tr>");
    }
    html.push_str("</table>\n</section>\n</main>\n</body>\n</html>\n");
    Ok(html)
}

/// The rank and the numbers of a design.
fn caption(place: usize, row: &Row) -> String {
    let Row { distance, min_mu, size, clearance, .. } = row;
    format!(
        "<h3>{}<span>{:.2} %</span></h3><p title=\"least transmission angle; size and clearance in widths of a step\">\
         {:.0}°, size {size:.2}<br>clearance {clearance:.2}</p>",
        place + 1,
        100.0 * distance,
        min_mu.to_degrees()
    )
}

/// The sense of the crank and the dimensions, to unfold.
fn lengths(leg: &Leg) -> String {
    let Leg { row, is_clockwise, .. } = leg;
    let mut html = format!(
        "<details><summary>design {}</summary><p>The crank turns {}clockwise.</p><table>",
        row.case,
        if *is_clockwise { "" } else { "counter-" }
    );
    for (name, length) in names().zip(row.lengths) {
        let _ = write!(html, "<tr><th><i>{name}</i></th><td>{length:.4}</td></tr>");
    }
    html + "</table></details>"
}

/// The names of the dimensions.
fn names() -> impl Iterator<Item = &'static str> {
    ["crank"].into_iter().chain(RANGES.into_iter().map(|(name, ..)| name))
}

/// The answer as CSV, with all digits.
pub fn csv(legs: &[Leg]) -> String {
    let names: Vec<&str> = ["case"].into_iter().chain(names()).chain(crate::query::MEASURES).collect();
    let mut csv = names.join(",") + "\n";
    for Leg { row, .. } in legs {
        let _ = write!(csv, "{}", row.case);
        for number in row.lengths.into_iter().chain([row.distance, row.min_mu, row.size, row.clearance]) {
            let _ = write!(csv, ",{number:?}");
        }
        csv.push('\n');
    }
    csv
}

/// A number with spaces between groups of three digits.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().filter_map(|group| str::from_utf8(group).ok()).collect();
    groups.join("\u{202f}")
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
