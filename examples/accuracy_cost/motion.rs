//! The error of each method against the input, over a turn or between two dead points.

use std::fmt::Write;

use crate::comparison::{Point, QUANTITIES, Work};
use crate::{METHODS, chart::SIZE};
use linkage_examples::price::axes::{LEFT, decades};

/// The margins above, below and right of the curves, in pixels; right of them stand the numbers of the methods.
const TOP: f64 = 30.0;
const BOTTOM: f64 = 26.0;
const RIGHT: f64 = 34.0;

/// The least distance of two numbers, in pixels.
const APART: f64 = 12.0;

/// Colours: closed forms orange, Newton's method blue, tables green; dominated methods are pale.
pub const STYLE: &str = ".curve{fill:none;stroke-width:1.5}.number{font-size:10px;font-weight:600}.pale{opacity:.45}\
    .closed .curve{stroke:#d9730d}.closed .number{fill:#d9730d}\
    .newton .curve{stroke:#3b82d6}.newton .number{fill:#3b82d6}\
    .table .curve{stroke:#3f9a63}.table .number{fill:#3f9a63}\
    .dead{stroke:currentColor;stroke-opacity:.55;stroke-dasharray:3 3}";

/// The class of a method in the style.
fn family(method: usize) -> &'static str {
    match METHODS[method].split([' ', ',']).next() {
        Some("Newton") => "newton",
        Some("table") => "table",
        _ => "closed",
    }
}

/// The errors of all methods along a motion.
pub struct Motion {
    point: Point,
    /// By method: each input with the error there, or none if the method returns an error.
    curves: Vec<Vec<(f64, Option<f64>)>>,
}

impl Motion {
    /// Sorts works by their points.
    pub fn all(works: Vec<Work>) -> Vec<Self> {
        let mut motions: Vec<Self> = Vec::new();
        for Work { method, point, errors, inputs, .. } in works {
            let place = motions.iter().position(|motion| motion.point == point).unwrap_or_else(|| {
                motions.push(Self { point, curves: vec![Vec::new(); METHODS.len()] });
                motions.len() - 1
            });
            let method = METHODS.iter().position(|name| *name == method).expect("a method of the list");
            motions[place].curves[method] = inputs.into_iter().zip(errors.into_iter().map(Result::ok)).collect();
        }
        motions
    }

    /// The quantity and the motion.
    pub fn title(&self) -> String {
        let over = if self.point.dead.is_empty() { "over a turn" } else { "between dead points" };
        format!("{} {over}", QUANTITIES[self.point.order])
    }

    /// The largest error of a method; none if it returns an error anywhere.
    pub fn largest(&self, method: usize) -> Option<f64> {
        let errors = self.curves[method].iter().map(|(_, error)| *error);
        errors.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
    }

    /// The curves over the input in degrees.
    pub fn panel(&self, dominated: &[Option<usize>]) -> String {
        let points = || self.curves.iter().flatten().filter_map(|(input, error)| Some((*input, (*error)?)));
        let errors = decades(points().map(|(_, error)| error.max(LEAST)));
        let inputs = points().map(|(input, _)| input).chain(self.point.dead.iter().copied());
        let inputs = inputs.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)]);
        let x = |input: f64| LEFT + (input - inputs[0]) / (inputs[1] - inputs[0]) * (SIZE[0] - LEFT - RIGHT);
        let y = |error: f64| {
            let down = (errors[1] - error.max(LEAST).log10()) / (errors[1] - errors[0]);
            TOP + down * (SIZE[1] - TOP - BOTTOM)
        };
        let (bottom, right) = (SIZE[1] - BOTTOM, SIZE[0] - RIGHT);
        let mut svg = format!("<text class=\"title\" x=\"{LEFT}\" y=\"16\">{}</text>", self.title());
        let mut push = |text: std::fmt::Arguments| {
            // Writing to a string does not fail.
            let _ = svg.write_fmt(text);
        };
        for decade in (errors[0] as i32..=errors[1] as i32).filter(|decade| decade % 8 == 0) {
            let at = y(10_f64.powi(decade));
            push(format_args!("<path class=\"grid\" d=\"M{LEFT} {at:.1}H{right}\"/>"));
            let label = format!("1e{decade}").replace('-', "−");
            push(format_args!(
                "<text class=\"soft\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                LEFT - 7.0,
                at + 4.0
            ));
        }
        let degrees = inputs.map(f64::to_degrees);
        let step = if degrees[1] - degrees[0] > 100.0 { 90.0 } else { 10.0 };
        for count in (degrees[0] / step).ceil() as i32..=(degrees[1] / step).floor() as i32 {
            let at = f64::from(count) * step;
            let place = x(at.to_radians());
            push(format_args!("<path class=\"grid\" d=\"M{place:.1} {TOP}V{bottom}\"/>"));
            let label = format!("{at}°").replace('-', "−");
            push(format_args!(
                "<text class=\"soft\" x=\"{place:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>",
                bottom + 17.0
            ));
        }
        for dead in &self.point.dead {
            push(format_args!(
                "<path class=\"dead\" d=\"M{:.1} {TOP}V{bottom}\"><title>dead point at {:.3}°</title></path>",
                x(*dead),
                dead.to_degrees()
            ));
        }
        let ends = self.curves.iter().enumerate().filter_map(|(method, curve)| {
            let (_, error) = curve.iter().rev().find_map(|(input, error)| Some((*input, (*error)?)))?;
            Some((method, y(error)))
        });
        for (method, at) in apart(ends.collect(), bottom) {
            let (family, pale) = (family(method), if dominated[method].is_none() { "" } else { " pale" });
            let mut path = String::new();
            let mut pen = 'M';
            for (input, error) in &self.curves[method] {
                // A gap where the method returns an error.
                let Some(error) = error else {
                    pen = 'M';
                    continue;
                };
                let _ = write!(path, "{pen}{:.1} {:.1}", x(*input), y(*error));
                pen = 'L';
            }
            push(format_args!(
                "<g class=\"{family}{pale}\"><title>{}</title><path class=\"curve\" d=\"{path}\"/>\
                 <text class=\"number\" x=\"{:.1}\" y=\"{:.1}\">{}</text></g>",
                METHODS[method],
                right + 6.0,
                at + 3.6,
                method + 1
            ));
        }
        svg
    }
}

/// Errors below are drawn here: a result may be exact.
const LEAST: f64 = 1e-34;

/// Moves numbers that would overlap: upwards, from the lowest on.
fn apart(mut ends: Vec<(usize, f64)>, bottom: f64) -> Vec<(usize, f64)> {
    ends.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let mut below = bottom + APART;
    for (_, at) in &mut ends {
        *at = at.min(below - APART);
        below = *at;
    }
    ends
}
