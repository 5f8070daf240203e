//! The chart of predicted and measured times.

use std::fmt::Write;

use crate::METHODS;
use crate::chart::SIZE;
use crate::comparison::{Comparison, QUANTITIES};

/// The margins, in pixels: left of the rows stand the names of the methods.
const LEFT: f64 = 134.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 26.0;

/// The quantity of the chart: position and velocity.
const ORDER: usize = 1;

/// Colours for light and dark mode.
pub const STYLE: &str = ".measured{fill:#d9730d}.predicted{fill:none;stroke:currentColor;stroke-width:1.4}\
    .between{stroke:currentColor;stroke-opacity:.35}";

/// The predicted and measured nanoseconds of each method from the input at well-conditioned poses.
pub fn times(comparison: &Comparison) -> impl Iterator<Item = (&'static str, Option<f64>, f64)> {
    let is_shown = |point: &&crate::Point| point.pose == "benign" && !point.angles_given && point.order == ORDER;
    let point = comparison.points.iter().position(|point| is_shown(&point)).expect("a point of the list");
    METHODS.iter().enumerate().filter_map(move |(method, name)| {
        let measured = comparison.prices[method][point]?.time;
        Some((*name, comparison.predicted[method][point], measured))
    })
}

/// One row for each method: a dot for the measured time, a circle for the predicted one.
pub fn panel(comparison: &Comparison) -> String {
    let rows: Vec<_> = times(comparison).collect();
    let all = || rows.iter().flat_map(|(_, predicted, measured)| predicted.iter().chain([measured]).copied());
    let low = all().fold(f64::INFINITY, f64::min).log10().floor();
    let high = all().fold(0.0, f64::max).log10().ceil();
    let x = |time: f64| LEFT + (time.log10() - low) / (high - low) * (SIZE[0] - LEFT - RIGHT);
    let bottom = SIZE[1] - BOTTOM;
    let mut svg = format!(
        "<text class=\"title\" x=\"8\" y=\"16\">{} and {}, ns</text>\
         <circle class=\"measured\" cx=\"14\" cy=\"30\" r=\"4\"/><text class=\"soft\" x=\"24\" y=\"34\">measured</text>\
         <circle class=\"predicted\" cx=\"100\" cy=\"30\" r=\"4\"/><text class=\"soft\" x=\"110\" y=\"34\">predicted</text>",
        QUANTITIES[0], QUANTITIES[ORDER]
    );
    let mut push = |text: std::fmt::Arguments| {
        // Writing to a string does not fail.
        let _ = svg.write_fmt(text);
    };
    for decade in low as i32..=high as i32 {
        let at = x(10_f64.powi(decade));
        push(format_args!("<path class=\"grid\" d=\"M{at:.1} {TOP}V{bottom}\"/>"));
        let anchor = if decade == high as i32 { "end" } else { "middle" };
        let label = 10_f64.powi(decade);
        push(format_args!(
            "<text class=\"soft\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{label}</text>",
            bottom + 17.0
        ));
    }
    let pitch = (bottom - TOP) / rows.len() as f64;
    for (place, (name, predicted, measured)) in rows.iter().enumerate() {
        let y = TOP + (place as f64 + 0.5) * pitch;
        push(format_args!("<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>", LEFT - 8.0, y + 4.0));
        let at = x(*measured);
        if let Some(predicted) = predicted {
            let there = x(*predicted);
            push(format_args!("<path class=\"between\" d=\"M{at:.1} {y:.1}H{there:.1}\"/>"));
            push(format_args!("<circle class=\"predicted\" cx=\"{there:.1}\" cy=\"{y:.1}\" r=\"4\"/>"));
        }
        push(format_args!(
            "<circle class=\"measured\" cx=\"{at:.1}\" cy=\"{y:.1}\" r=\"4\"><title>{measured:.0} ns</title></circle>"
        ));
    }
    svg
}
