//! The chart: error against time, both as powers of ten, the frontier marked.

use std::fmt::Write;

use crate::frontier::Prices;
use crate::stall::Stall;
use crate::{METHODS, QUANTITIES};

/// A panel's size, and the room that its axes take.
const SIZE: [f64; 2] = [340.0, 240.0];
const LEFT: f64 = 48.0;
const BOTTOM: f64 = 26.0;
const TOP: f64 = 30.0;
const RIGHT: f64 = 14.0;

/// Colours that tell themselves apart on light and on dark, and the text on them.
pub const STYLE: &str = "text{font:12px system-ui,sans-serif;fill:currentColor}\
    .grid{stroke:currentColor;stroke-opacity:.13}.soft{fill-opacity:.65}.title{font-weight:600}\
    .front{fill:none;stroke:#d9730d;stroke-width:2}\
    .on circle{fill:#d9730d;stroke:#d9730d}.on text{fill:#fff}\
    .off circle{fill:var(--card,#fff);stroke:currentColor;stroke-opacity:.55}\
    circle{stroke-width:1.2}.mark text{font-size:10px;font-weight:600;text-anchor:middle}";

/// The panels of a mechanism, each with its title: benign, from the input.
pub fn panels(stall: &Stall) -> Vec<String> {
    let from_input = |(_, point): &(usize, &crate::Point)| point.pose == "benign" && !point.angles_given;
    let points = stall.points.iter().enumerate().filter(from_input);
    points
        .map(|(index, point)| {
            panel(&format!("{}, {}", stall.mechanism, QUANTITIES[point.order]), &stall.at(index), &stall.front(index))
        })
        .collect()
}

/// Decades of an axis: from the largest power of ten below all values to the smallest above.
fn decades(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let low = values.clone().fold(f64::INFINITY, f64::min).log10().floor();
    let high = values.fold(0.0, f64::max).log10().ceil();
    [low, high.max(low + 1.0)]
}

fn panel(title: &str, prices: &Prices, front: &[usize]) -> String {
    let known = prices.iter().flatten();
    let times = decades(known.clone().map(|price| price.time));
    let errors = decades(known.map(|price| price.error));
    let x = |time: f64| LEFT + (time.log10() - times[0]) / (times[1] - times[0]) * (SIZE[0] - LEFT - RIGHT);
    let y = |error: f64| TOP + (errors[1] - error.log10()) / (errors[1] - errors[0]) * (SIZE[1] - TOP - BOTTOM);
    let (bottom, right) = (SIZE[1] - BOTTOM, SIZE[0] - RIGHT);
    let mut svg = format!("<text class=\"title\" x=\"{LEFT}\" y=\"16\">{title}</text>");
    let mut push = |text: std::fmt::Arguments| {
        // Writing to a string does not fail.
        let _ = svg.write_fmt(text);
    };
    for decade in times[0] as i32..=times[1] as i32 {
        let at = x(10_f64.powi(decade));
        push(format_args!("<path class=\"grid\" d=\"M{at:.1} {TOP}V{bottom}\"/>"));
        let label = ["1 ns", "10 ns", "100 ns", "1 µs", "10 µs", "100 µs", "1 ms"][decade.clamp(0, 6) as usize];
        let anchor = if decade == times[1] as i32 { "end" } else { "middle" };
        push(format_args!(
            "<text class=\"soft\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{label}</text>",
            bottom + 17.0
        ));
    }
    let every = if errors[1] - errors[0] > 16.0 { 8 } else { 4 };
    for decade in errors[0] as i32..=errors[1] as i32 {
        if decade % every == 0 {
            let at = y(10_f64.powi(decade));
            push(format_args!("<path class=\"grid\" d=\"M{LEFT} {at:.1}H{right}\"/>"));
            let label = format!("1e{decade}").replace("1e-", "1e−");
            push(format_args!(
                "<text class=\"soft\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                LEFT - 7.0,
                at + 4.0
            ));
        }
    }
    let mut path = String::new();
    for (place, &method) in front.iter().enumerate() {
        let Some(price) = prices[method] else { continue };
        let (x, y) = (x(price.time), y(price.error));
        // A step: until the next is paid for, the digits are those of the last.
        let step = if place == 0 { format!("M{x:.1} {y:.1}") } else { format!("H{x:.1}V{y:.1}") };
        path.push_str(&step);
    }
    push(format_args!("<path class=\"front\" d=\"{path}\"/>"));
    // What is on the frontier is drawn last, above all else.
    for is_on in [false, true] {
        for (method, price) in prices.iter().enumerate().filter(|(method, _)| front.contains(method) == is_on) {
            let Some(price) = price else { continue };
            let class = if is_on { "on" } else { "off" };
            let (x, y) = (x(price.time), y(price.error));
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

/// One panel alone.
pub fn figure(panel: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\">{panel}</svg>",
        SIZE[0], SIZE[1]
    )
}

/// All panels and the names of the methods.
pub fn svg(stalls: &[Stall]) -> String {
    let (width, height) = (3.0 * SIZE[0], stalls.len() as f64 * SIZE[1] + 110.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\"><style>svg{{background:#fff;color:#1f2126}}{STYLE}</style>"
    );
    for (row, stall) in stalls.iter().enumerate() {
        for (column, panel) in panels(stall).iter().enumerate() {
            let (x, y) = (column as f64 * SIZE[0], row as f64 * SIZE[1]);
            let _ = write!(svg, "<g transform=\"translate({x} {y})\">{panel}</g>");
        }
    }
    for (method, name) in METHODS.iter().enumerate() {
        let (x, y) = (LEFT + (method % 4) as f64 * 245.0, height - 80.0 + (method / 4) as f64 * 26.0);
        let note = if stalls[0].dominated[method].is_some() { " (dominated)" } else { "" };
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
