//! The charts: error against time, errors along a motion, predicted and measured times.

use linkage::chart::{Axis, Chart, Curve, Line, Look, Unit};

use crate::METHODS;
use crate::comparison::{Comparison, Point, QUANTITIES};
use crate::motion::Motion;

/// Errors below are drawn here: a result may be exact.
const LEAST: f64 = 1e-34;

/// The quantity of the chart of predicted times: position and velocity.
const ORDER: usize = 1;

/// The colour of a method: closed forms are orange, Newton's method is blue, tables are green.
pub fn colour(method: usize) -> usize {
    match METHODS[method].split([' ', ',']).next() {
        Some("Newton") => 1,
        Some("table") => 2,
        _ => 0,
    }
}

/// A curve of a method, with its number.
fn curve(method: usize, look: Look) -> Curve {
    Curve { label: (method + 1).to_string(), colour: colour(method), ..Curve::new(METHODS[method], look, []) }
}

fn without_legend(title: String, x: Axis, y: Axis) -> Chart {
    Chart { has_legend: false, ..Chart::new(title, x, y) }
}

/// The charts of a mechanism for well-conditioned poses from the input. A step line passes the Pareto front.
pub fn error_and_time(comparison: &Comparison) -> Vec<Chart> {
    let from_input = |(_, point): &(usize, &Point)| point.pose == "benign" && !point.angles_given;
    let points = comparison.points.iter().enumerate().filter(from_input);
    points
        .map(|(index, point)| {
            let time = Axis::logarithmic("time").unit(Unit::Seconds);
            let title = format!("{}, {}", comparison.mechanism, QUANTITIES[point.order]);
            let mut chart = without_legend(title, time, Axis::logarithmic("largest error"));
            let costs = comparison.at(index);
            let at = |method: usize| costs[method].map(|cost| [cost.time, cost.error]);
            let front = comparison.front(index).into_iter().filter_map(at);
            chart.curves.push(Curve { colour: 4, ..Curve::new("the Pareto front", Look::Steps, front) });
            chart.curves.extend(
                (0..METHODS.len()).map(|method| Curve { points: vec![at(method)], ..curve(method, Look::Discs) }),
            );
            chart
        })
        .collect()
}

/// The curves over the input of a motion. A curve is broken where its method returns an error; dominated methods are dashed.
pub fn errors_along(motion: &Motion, dominated: &[Option<usize>]) -> Chart {
    let input = Axis::linear("input").unit(Unit::Degrees);
    let mut chart = without_legend(motion.title(), input, Axis::logarithmic("error"));
    for (method, errors) in motion.curves.iter().enumerate().filter(|(_, errors)| !errors.is_empty()) {
        let points = errors.iter().map(|(input, error)| error.map(|error| [*input, error.max(LEAST)])).collect();
        let look = if dominated[method].is_none() { Look::Line } else { Look::Dashed };
        chart.curves.push(Curve { points, ..curve(method, look) });
    }
    let dead = motion.point.dead.iter();
    chart.lines.extend(dead.map(|&at| Line { at, name: format!("dead point at {:.3}°", at.to_degrees()) }));
    chart
}

/// The predicted and measured seconds of each method from the input at well-conditioned poses.
pub fn times(comparison: &Comparison) -> impl Iterator<Item = (&'static str, Option<f64>, f64)> {
    let is_shown = |point: &&Point| point.pose == "benign" && !point.angles_given && point.order == ORDER;
    let point = comparison.points.iter().position(|point| is_shown(&point)).expect("a point of the list");
    METHODS.iter().enumerate().filter_map(move |(method, name)| {
        let measured = comparison.costs[method][point]?.time;
        Some((*name, comparison.predicted[method][point], measured))
    })
}

/// A row for each method: a dot for the measured time, a circle for the predicted one.
pub fn predicted_and_measured(comparison: &Comparison) -> Chart {
    let rows: Vec<_> = times(comparison).collect();
    let names = rows.iter().map(|(name, ..)| (*name).to_owned()).collect();
    let time = Axis::logarithmic("time").unit(Unit::Seconds);
    let title = format!("{} and {}", QUANTITIES[0], QUANTITIES[ORDER]);
    let mut chart = Chart::new(title, time, Axis::linear("").unit(Unit::Names(names)));
    let places = || rows.iter().enumerate().map(|(place, row)| (place as f64, row));
    let predicted = places().filter_map(|(place, (_, predicted, _))| Some([(*predicted)?, place]));
    chart.curves.push(Curve { colour: 1, ..Curve::new("predicted", Look::Rings, predicted) });
    chart.curves.push(Curve::new("measured", Look::Dots, places().map(|(place, (.., measured))| [*measured, place])));
    chart
}
