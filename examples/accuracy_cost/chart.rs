//! The chart: error against time on logarithmic axes, with the Pareto front.

use std::fmt::Write;

use crate::comparison::Comparison;
use crate::{METHODS, QUANTITIES};
use linkage_examples::price::axes::{self, Axes, LEFT};
use linkage_examples::price::frontier::Prices;

/// The size of a panel, in pixels.
pub const SIZE: [f64; 2] = [340.0, 240.0];

/// Colours for light and dark mode, and the text on them.
pub const STYLE: &str = ".front{fill:none;stroke:#d9730d;stroke-width:2}\
    .on circle{fill:#d9730d;stroke:#d9730d}.on text{fill:#fff}\
    .off circle{fill:var(--card,#fff);stroke:currentColor;stroke-opacity:.55}\
    circle{stroke-width:1.2}.mark text{font-size:10px;font-weight:600;text-anchor:middle}";

/// The panels of a mechanism with their titles, for well-conditioned poses from the input.
pub fn panels(comparison: &Comparison) -> Vec<String> {
    let from_input = |(_, point): &(usize, &crate::Point)| point.pose == "benign" && !point.angles_given;
    let points = comparison.points.iter().enumerate().filter(from_input);
    points
        .map(|(index, point)| {
            panel(
                &format!("{}, {}", comparison.mechanism, QUANTITIES[point.order]),
                &comparison.at(index),
                &comparison.front(index),
            )
        })
        .collect()
}

fn panel(title: &str, prices: &Prices, front: &[usize]) -> String {
    let axes = Axes::around(SIZE, prices.iter().flatten());
    let mut svg = axes.svg(title);
    let mut push = |text: std::fmt::Arguments| {
        // Writing to a string does not fail.
        let _ = svg.write_fmt(text);
    };
    let mut path = String::new();
    for (place, &method) in front.iter().enumerate() {
        let Some(price) = prices[method] else { continue };
        let [x, y] = axes.at(price);
        // A staircase: between two points the best error is that of the faster method.
        let step = if place == 0 { format!("M{x:.1} {y:.1}") } else { format!("H{x:.1}V{y:.1}") };
        path.push_str(&step);
    }
    push(format_args!("<path class=\"front\" d=\"{path}\"/>"));
    // Points on the front are drawn last, on top.
    for is_on in [false, true] {
        for (method, price) in prices.iter().enumerate().filter(|(method, _)| front.contains(method) == is_on) {
            let Some(price) = price else { continue };
            let class = if is_on { "on" } else { "off" };
            let [x, y] = axes.at(*price);
            push(format_args!(
                "<g class=\"mark {class}\"><title>{}: {:.1e}, {:.0} ns</title><circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"8\"/>\
                 <text x=\"{x:.1}\" y=\"{:.1}\">{}</text></g>",
                METHODS[method],
                price.error,
                price.time,
                y + 3.6,
                method + 1
            ));
        }
    }
    svg
}

/// One panel as an SVG.
pub fn figure(panel: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\">{panel}</svg>",
        SIZE[0], SIZE[1]
    )
}

/// All panels with the names of the methods.
pub fn svg(comparisons: &[Comparison]) -> String {
    let (width, height) = (3.0 * SIZE[0], comparisons.len() as f64 * SIZE[1] + 110.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\"><style>svg{{background:#fff;color:#1f2126}}{}{STYLE}</style>",
        axes::STYLE
    );
    for (row, comparison) in comparisons.iter().enumerate() {
        for (column, panel) in panels(comparison).iter().enumerate() {
            let (x, y) = (column as f64 * SIZE[0], row as f64 * SIZE[1]);
            let _ = write!(svg, "<g transform=\"translate({x} {y})\">{panel}</g>");
        }
    }
    for (method, name) in METHODS.iter().enumerate() {
        let (x, y) = (LEFT + (method % 4) as f64 * 245.0, height - 80.0 + (method / 4) as f64 * 26.0);
        let note = if comparisons[0].dominated[method].is_some() { " (dominated)" } else { "" };
        let _ = write!(
            svg,
            "<g class=\"mark off\"><circle cx=\"{x}\" cy=\"{y}\" r=\"8\"/><text x=\"{x}\" y=\"{}\">{}</text></g>\
             <text x=\"{}\" y=\"{}\">{name}{note}</text>",
            y + 3.6,
            method + 1,
            x + 14.0,
            y + 4.0
        );
    }
    svg.push_str("</svg>\n");
    svg
}
