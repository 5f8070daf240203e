//! The charts: error against time on logarithmic axes, a curve for each method.

use std::fmt::Write;

use super::list::{ACCELERATIONS, List, METHODS, REAL_TIME, SIMULATE_8};
use super::report::setting;
use crate::price::axes::{self, Axes, LEFT};
use crate::price::frontier::Price;

/// The size of a panel, in pixels.
const SIZE: [f64; 2] = [400.0, 320.0];

/// The rows of the legend, and the width of its columns.
const LEGEND: (usize, f64) = (5, 265.0);

/// Colours for light and dark mode.
pub const STYLE: &str = ".curve{fill:none;stroke:var(--ink);stroke-width:1.8;stroke-linejoin:round}\
    .dot{fill:var(--ink)}.five .curve,.curve.five{stroke-dasharray:5 3}.ring{fill:none;stroke:currentColor;stroke-width:1.3}\
    .simulate{--ink:#e0700b}.integrate{--ink:#b8930a}.ode-solvers{--ink:#3b82d6}.differential-equations{--ink:#1f9d63}\
    .diffsol{--ink:#9a5fe0}.real-time{--ink:#9c6b3f}.accelerations{--ink:#8b8b8b}.weakly{--ink:#17a2a8}\
    .strongly{--ink:#3b6fd6}.projected{--ink:#d6459a}";

/// The panels of a mechanism: adaptive steps, and fixed steps if there are any.
pub fn panels(list: &List) -> Vec<String> {
    let of = |index: usize| list.rows[index].method;
    let by_tolerance = |method: usize| method < REAL_TIME;
    let of_one_length = |method: usize| method >= REAL_TIME || method == SIMULATE_8;
    let mut panels = vec![panel(list, "By tolerance", by_tolerance)];
    if (0..list.rows.len()).any(|index| of(index) >= ACCELERATIONS) {
        panels.push(panel(list, "Fixed steps, and simulate", of_one_length));
    }
    panels
}

fn panel(list: &List, title: &str, shown: impl Fn(usize) -> bool) -> String {
    let prices = list.prices();
    let points: Vec<(usize, Price)> = (0..prices.len())
        .filter(|&index| shown(list.rows[index].method))
        .filter_map(|index| prices[index].map(|price| (index, price)))
        .collect();
    let axes = Axes::around(SIZE, points.iter().map(|(_, price)| price));
    let mut svg = axes.svg(title);
    let mut push = |text: std::fmt::Arguments| {
        // Writing to a string does not fail.
        let _ = svg.write_fmt(text);
    };
    let front = list.front();
    for (method, named) in METHODS.iter().enumerate() {
        let of_method: Vec<_> = points.iter().filter(|(index, _)| list.rows[*index].method == method).collect();
        let mut path = String::new();
        for (place, (_, price)) in of_method.iter().enumerate() {
            let [x, y] = axes.at(*price);
            let _ = write!(path, "{}{x:.1} {y:.1}", if place == 0 { 'M' } else { 'L' });
        }
        push(format_args!("<g class=\"{}\"><path class=\"curve\" d=\"{path}\"/>", named.class));
        for (index, price) in of_method {
            let [x, y] = axes.at(*price);
            push(format_args!(
                "<g><title>{} at {}: {:.1e} rad, {:.3} ms</title><circle class=\"dot\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.4\"/>",
                named.name,
                setting(method, list.rows[*index].setting),
                price.error,
                1e-6 * price.time
            ));
            if front.contains(index) {
                push(format_args!("<circle class=\"ring\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\"/>"));
            }
            push(format_args!("</g>"));
        }
        push(format_args!("</g>"));
    }
    svg
}

/// One panel as an SVG.
pub fn figure(panel: &str) -> String {
    let [width, height] = SIZE;
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\">{panel}</svg>")
}

/// The legend symbol of a method.
pub fn swatch(class: &str) -> String {
    format!(
        "<g class=\"{class}\"><path class=\"curve\" d=\"M1 7H27\"/><circle class=\"dot\" cx=\"14\" cy=\"7\" r=\"2.4\"/></g>"
    )
}

/// The methods with rows in some list.
pub fn methods(lists: &[List]) -> impl Iterator<Item = (usize, &'static str, &'static str)> {
    let is_there = |method: usize| lists.iter().any(|list| list.rows.iter().any(|row| row.method == method));
    METHODS.iter().enumerate().filter(move |(at, _)| is_there(*at)).map(|(at, method)| (at, method.name, method.class))
}

/// All panels with the names of the methods.
pub fn svg(lists: &[List]) -> String {
    let ([width, height], (rows, column)) = (SIZE, LEGEND);
    let row_height = height + 26.0;
    let legend_top = lists.len() as f64 * row_height + 20.0;
    let size = [2.0 * width + 20.0, legend_top + rows as f64 * 20.0 + 30.0];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\"><style>svg{{background:#fff;color:#1f2126}}{}{STYLE}</style>",
        size[0],
        size[1],
        axes::STYLE
    );
    let mut push = |text: std::fmt::Arguments| {
        let _ = svg.write_fmt(text);
    };
    for (row, list) in lists.iter().enumerate() {
        let top = row as f64 * row_height;
        push(format_args!("<text class=\"title\" x=\"{LEFT}\" y=\"{:.1}\">{}</text>", top + 18.0, list.title));
        for (place, panel) in panels(list).iter().enumerate() {
            let left = place as f64 * width;
            push(format_args!("<g transform=\"translate({left} {:.1})\">{panel}</g>", top + 24.0));
        }
    }
    for (place, (_, name, class)) in methods(lists).enumerate() {
        let (x, y) = (LEFT + (place / rows) as f64 * column, legend_top + (place % rows) as f64 * 20.0);
        push(format_args!(
            "<g transform=\"translate({x} {y})\">{}<text x=\"34\" y=\"11\">{name}</text></g>",
            swatch(class)
        ));
    }
    push(format_args!("</svg>\n"));
    svg
}
