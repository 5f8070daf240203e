//! Logarithmic axes of error against time.

use std::fmt::Write;

use super::frontier::Price;

/// The margins for the labels, in pixels.
pub const LEFT: f64 = 48.0;
const BOTTOM: f64 = 26.0;
const TOP: f64 = 30.0;
const RIGHT: f64 = 14.0;

/// Above the first number of decades every eighth has a grid line, above the second every fourth, else every second.
const MANY: [f64; 2] = [16.0, 9.0];

/// The style of the axes, for light and dark mode.
pub const STYLE: &str = "text{font:12px system-ui,sans-serif;fill:currentColor}\
    .grid{stroke:currentColor;stroke-opacity:.13}.soft{fill-opacity:.65}.title{font-weight:600}";

const TIMES: [&str; 11] =
    ["1 ns", "10 ns", "100 ns", "1 µs", "10 µs", "100 µs", "1 ms", "10 ms", "100 ms", "1 s", "10 s"];

/// The axes of a panel, over whole decades.
pub struct Axes {
    size: [f64; 2],
    times: [f64; 2],
    errors: [f64; 2],
}

impl Axes {
    /// Creates axes around all these points.
    pub fn around<'a>(size: [f64; 2], prices: impl Iterator<Item = &'a Price> + Clone) -> Self {
        Self {
            size,
            times: decades(prices.clone().map(|price| price.time)),
            errors: decades(prices.map(|price| price.error)),
        }
    }

    /// The position of a point, in pixels.
    pub fn at(&self, price: Price) -> [f64; 2] {
        let (times, errors) = (self.times, self.errors);
        let right = (price.time.log10() - times[0]) / (times[1] - times[0]);
        let down = (errors[1] - price.error.log10()) / (errors[1] - errors[0]);
        [LEFT + right * (self.size[0] - LEFT - RIGHT), TOP + down * (self.size[1] - TOP - BOTTOM)]
    }

    /// The title, the grid and its labels.
    pub fn svg(&self, title: &str) -> String {
        let (times, errors) = (self.times, self.errors);
        let (bottom, right) = (self.size[1] - BOTTOM, self.size[0] - RIGHT);
        let mut svg = format!("<text class=\"title\" x=\"{LEFT}\" y=\"16\">{title}</text>");
        let mut push = |text: std::fmt::Arguments| {
            // Writing to a string does not fail.
            let _ = svg.write_fmt(text);
        };
        for decade in times[0] as i32..=times[1] as i32 {
            let [at, _] = self.at(Price { time: 10_f64.powi(decade), error: 1.0 });
            push(format_args!("<path class=\"grid\" d=\"M{at:.1} {TOP}V{bottom}\"/>"));
            let label = TIMES[decade.clamp(0, TIMES.len() as i32 - 1) as usize];
            let anchor = if decade == times[1] as i32 { "end" } else { "middle" };
            push(format_args!(
                "<text class=\"soft\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{label}</text>",
                bottom + 17.0
            ));
        }
        let span = errors[1] - errors[0];
        let every =
            [(MANY[0], 8), (MANY[1], 4)].into_iter().find(|(many, _)| span > *many).map_or(2, |(_, every)| every);
        for decade in errors[0] as i32..=errors[1] as i32 {
            if decade % every == 0 {
                let [_, at] = self.at(Price { time: 1.0, error: 10_f64.powi(decade) });
                push(format_args!("<path class=\"grid\" d=\"M{LEFT} {at:.1}H{right}\"/>"));
                let label = format!("1e{decade}").replace("1e-", "1e−");
                push(format_args!(
                    "<text class=\"soft\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                    LEFT - 7.0,
                    at + 4.0
                ));
            }
        }
        svg
    }
}

/// The exponents of the largest power of ten below all values and the smallest above.
pub fn decades(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let low = values.clone().fold(f64::INFINITY, f64::min).log10().floor();
    let high = values.fold(0.0, f64::max).log10().ceil();
    [low, high.max(low + 1.0)]
}
