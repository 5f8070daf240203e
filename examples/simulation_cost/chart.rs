//! The charts: error against time on logarithmic axes, a curve for each method.

use linkage::chart::{Axis, Chart, Curve, Look, Unit};
use linkage::price::Cost;

use super::list::{ACCELERATIONS, List, METHODS, REAL_TIME, SIMULATE_8};

/// The charts of a mechanism: adaptive steps, and fixed steps if there are any.
pub fn charts(list: &List) -> Vec<Chart> {
    let of = |index: usize| list.rows[index].method;
    let by_tolerance = |method: usize| method < REAL_TIME;
    let of_one_length = |method: usize| method >= REAL_TIME || method == SIMULATE_8;
    let mut charts = vec![chart(list, "By tolerance", by_tolerance)];
    if (0..list.rows.len()).any(|index| of(index) >= ACCELERATIONS) {
        charts.push(chart(list, "Fixed steps, and simulate", of_one_length));
    }
    charts
}

/// Circles are at runs that are clearly more accurate than every faster one.
fn chart(list: &List, title: &str, shown: impl Fn(usize) -> bool) -> Chart {
    let costs = list.costs();
    let time = Axis::logarithmic("time of a run").unit(Unit::Seconds);
    let mut chart = Chart::new(title, time, Axis::logarithmic("error at the end"));
    (chart.size, chart.has_legend) = ([400.0, 320.0], false);
    let at = |cost: Cost| [cost.time, cost.error];
    for (method, named) in METHODS.iter().enumerate().filter(|(method, _)| shown(*method)) {
        let rows = || list.rows.iter().zip(&costs).filter(move |(row, _)| row.method == method);
        let points = || rows().filter_map(|(_, cost)| cost.map(at));
        let look = if named.is_dashed { Look::Dashed } else { Look::Line };
        chart.curves.push(Curve { colour: named.colour, ..Curve::new(named.name, look, points()) });
        chart.curves.push(Curve { colour: named.colour, ..Curve::new(named.name, Look::Dots, points()) });
    }
    let front = list.front().into_iter().filter(|&index| shown(list.rows[index].method));
    let front = front.filter_map(|index| costs[index].map(at));
    chart.curves.push(Curve { colour: 7, ..Curve::new("the Pareto front", Look::Rings, front) });
    chart
}

/// The methods with rows in some list.
pub fn methods(lists: &[List]) -> impl Iterator<Item = &'static super::list::Method> {
    let is_there = |method: usize| lists.iter().any(|list| list.rows.iter().any(|row| row.method == method));
    METHODS.iter().enumerate().filter(move |(at, _)| is_there(*at)).map(|(_, method)| method)
}
