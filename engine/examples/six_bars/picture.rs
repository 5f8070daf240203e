//! Pictures of legs as SVG.

use std::error::Error;
use std::fmt::Write;

use linkage::drawing::Animation;
use linkage::nalgebra::Complex;

use crate::legs::{Leg, NAMES};

/// The side of a picture, in widths of a step: the largest size of the query with a margin.
const SIDE: f64 = 2.7;
/// The side of a picture in its own units.
const UNITS: f64 = 270.0;
/// The radius of a joint.
const JOINT: f64 = 3.6;

/// The seconds of a turn.
const SECONDS: f64 = 3.0;

/// A leg at the first point of the curve, with the curve and the path of its foot. All legs have the same scale.
pub fn still(leg: &Leg, curve: &[Complex<f64>]) -> String {
    let all = leg.positions.iter().flatten().chain(curve);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in all {
        for (place, at) in [point.re, point.im].into_iter().enumerate() {
            (low[place], high[place]) = (low[place].min(at), high[place].max(at));
        }
    }
    let middle = [0, 1].map(|place| f64::midpoint(low[place], high[place]));
    let at = |point: &Complex<f64>| {
        let scale = UNITS / SIDE;
        [UNITS / 2.0 + scale * (point.re - middle[0]), UNITS / 2.0 - scale * (point.im - middle[1])]
    };
    let path = |points: &[Complex<f64>]| {
        let mut text = String::new();
        for (place, point) in points.iter().enumerate() {
            let [x, y] = at(point);
            // Writing to a string does not fail.
            let _ = write!(text, "{}{x:.1} {y:.1}", if place == 0 { "M" } else { "L" });
        }
        text
    };
    let [a, b, c, d, p, q, f, foot] = leg.positions[0];
    let trace: Vec<_> = leg.positions.iter().map(|points| points[7]).collect();
    let [_, ground] = at(&Complex::new(0.0, 0.0));
    let mut svg = format!(
        "<svg class=\"leg\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {UNITS} {UNITS}\" role=\"img\">\
         <title>Design {}</title><path class=\"floor\" d=\"M0 {ground:.1}H{UNITS}\"/>\
         <path class=\"given\" d=\"{}z\"/><path class=\"trace\" d=\"{}z\"/>",
        leg.row.case,
        path(curve),
        path(&trace)
    );
    let links: [(&str, &[_]); 5] = [
        ("rocker", &[d, c]),
        ("lever", &[f, q]),
        ("coupler", &[b, c, p]),
        ("shank", &[p, q, foot]),
        ("crank", &[a, b]),
    ];
    for (class, points) in links {
        let _ = write!(svg, "<path class=\"link {class}\" d=\"{}z\"/>", path(points));
    }
    for pivot in [a, d, f] {
        let [x, y] = at(&pivot);
        let _ = write!(svg, "<path class=\"pivot\" d=\"M{x:.1} {y:.1}l5.5 9h-11z\"/>");
    }
    for joint in [a, b, c, d, p, q, f] {
        let [x, y] = at(&joint);
        let _ = write!(svg, "<circle class=\"joint\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{JOINT}\"/>");
    }
    let [x, y] = at(&foot);
    let _ = write!(svg, "<circle class=\"toe\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{JOINT}\"/></svg>");
    svg
}

/// A leg in motion, with a point that moves on the curve.
pub fn moving(leg: &Leg, curve: &[Complex<f64>]) -> Result<String, Box<dyn Error>> {
    let mut picture = Animation::new(format!("Design {}", leg.row.case), SECONDS);
    let frames = leg.positions.iter().zip(curve);
    for (points, given) in frames.clone().chain(frames.take(1)) {
        let points = NAMES.into_iter().zip(*points).chain([("Given", *given)]);
        picture.frame(points.map(|(name, point)| (name, [point.re, point.im])));
    }
    picture.link(&["B", "C", "P"]).link(&["P", "Q", "Foot"]).link(&["D", "C"]).link(&["F", "Q"]).crank(&["A", "B"]);
    picture.ground("A").ground("D").ground("F").trace("Given").trace("Foot");
    Ok(picture.to_svg()?)
}
