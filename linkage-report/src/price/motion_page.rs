//! The price of a motion as charts and as a page.

use super::data::{Family, MethodPrice, QUANTITIES};
use super::motion::MotionPrice;
use super::page::{LEAST, figures, page, table};
use super::text::{UNOPTIMISED, error, time};
use crate::chart::{Axis, Chart, Curve, Line, Look, Span, Unit};
use crate::report::prose::end;
use crate::sheet::escape;

impl MethodPrice {
    fn colour(&self) -> usize {
        match self.family {
            Family::ClosedForm => 0,
            Family::Newton => 1,
            Family::Table => 2,
        }
    }
}

impl MotionPrice {
    /// The chart of error against time for a quantity, by its order of derivative. A step line passes the methods that
    /// are clearly more accurate than every faster one.
    #[must_use]
    pub fn error_and_time(&self, order: usize) -> Chart {
        let time = Axis::logarithmic("time").unit(Unit::Seconds);
        let mut chart = Chart::new(quantity(order), time, Axis::logarithmic("largest error"));
        chart.has_legend = false;
        let costs = self.costs(order);
        let at = |place: usize| costs[place].map(|cost| [cost.time, cost.error.max(LEAST)]);
        let front = self.front(order).into_iter().filter_map(at);
        chart.curves.push(Curve { colour: 4, ..Curve::new("the most accurate so far", Look::Steps, front) });
        for (place, method) in self.methods.iter().enumerate() {
            let curve = Curve::new(&*method.name, Look::Discs, at(place));
            chart.curves.push(Curve { label: (place + 1).to_string(), colour: method.colour(), ..curve });
        }
        chart
    }

    /// The chart of the errors along the motion for a quantity, by its order of derivative. A curve is broken where its
    /// method fails; inputs without a position are shaded; dashed lines are at dead points, at other ends, at change points
    /// and at inputs that are left out.
    #[must_use]
    pub fn errors_along(&self, order: usize) -> Chart {
        let unit = if self.input.is_angle { Unit::Degrees } else { Unit::Number };
        let across = Axis::linear(&*self.input.name).unit(unit).range(self.asked);
        let mut chart = Chart::new(quantity(order), across, Axis::logarithmic("error"));
        chart.has_legend = false;
        for (place, method) in self.methods.iter().enumerate() {
            let errors = self.inputs.iter().zip(&method.quantities[order].errors);
            let points = errors.map(|(input, error)| error.ok().map(|error| [*input, error.max(LEAST)])).collect();
            let curve = Curve { points, ..Curve::new(&*method.name, Look::Line, []) };
            chart.curves.push(Curve { label: (place + 1).to_string(), colour: method.colour(), ..curve });
        }
        for gap in &self.gaps {
            let name = format!("no position: {}", end(gap.reason));
            chart.lines.push(Line { at: gap.from, name: end(gap.reason) });
            chart.spans.push(Span { ends: [gap.from, gap.to], name });
        }
        let points = self.change_points.iter().map(|point| {
            let name = format!("change point of {}", point.groups.join("; "));
            Line { at: point.input, name }
        });
        chart.lines.extend(points);
        let left_out = self.left_out.iter().map(|out| Line { at: out.input, name: out.error.to_string() });
        chart.lines.extend(left_out);
        chart
    }

    /// The chart of predicted and measured times of a quantity, by its order of derivative.
    #[must_use]
    pub fn predicted_and_measured(&self, order: usize) -> Chart {
        let timed = self.methods.iter().filter_map(|method| {
            let quantity = &method.quantities[order];
            Some((&method.name, quantity.time?.median, quantity.predicted))
        });
        let rows: Vec<_> = timed.collect();
        let names = rows.iter().map(|(name, ..)| (*name).clone()).collect();
        let across = Axis::logarithmic("time").unit(Unit::Seconds);
        let mut chart = Chart::new(quantity(order), across, Axis::linear("").unit(Unit::Names(names)));
        for (place, (_, measured, predicted)) in rows.iter().enumerate() {
            let between = predicted.iter().flat_map(|predicted| [*predicted, *measured]).map(|at| [at, place as f64]);
            chart.curves.push(Curve { colour: 1, ..Curve::new("", Look::Line, between) });
        }
        let predicted = rows.iter().enumerate().filter_map(|(place, row)| Some([row.2?, place as f64]));
        chart.curves.push(Curve { colour: 1, ..Curve::new("predicted", Look::Rings, predicted) });
        let measured = rows.iter().enumerate().map(|(place, row)| [row.1, place as f64]);
        chart.curves.push(Curve::new("measured", Look::Dots, measured));
        chart
    }

    /// The price as one HTML file, which loads nothing and runs no script.
    #[must_use]
    pub fn to_html(&self) -> String {
        let name = escape(&self.mechanism);
        page(&name, "The price of accuracy", &self.to_html_fragment())
    }

    /// The sections of the page alone, to be part of another, which has the style of charts and of
    /// [`style`](super::style).
    #[must_use]
    pub fn to_html_fragment(&self) -> String {
        let mut body = String::new();
        for about in self.about() {
            body += &format!("<p>{}</p>\n", escape(&about));
        }
        if !self.is_optimised {
            body += &format!("<p>{UNOPTIMISED}</p>\n");
        }
        body += "<ol class=\"methods\">\n";
        for method in &self.methods {
            body += &format!("<li class=\"k{}\">{}</li>\n", method.colour(), escape(&method.name));
        }
        body += "</ol>\n";
        let orders = || 0..QUANTITIES.len();
        let along = "The error at each input. A curve is broken where its method returns an error; inputs without a \
                     position are shaded; dashed lines are at ends of the motion and at change points.";
        let against = "The largest error of each method and the median time of one evaluation from the input. The step line \
                       passes the methods that are clearly more accurate than every faster one; a method that fails at an input \
                       has no point.";
        let predicted = "The prediction is the number of operations of each kind times the measured time of one, in two chains of \
                         dependent operations. Checks and memory are not in it.";
        body += &figures("Error against time", against, orders().map(|order| self.error_and_time(order)));
        body += &figures("Error along the motion", along, orders().map(|order| self.errors_along(order)));
        body += &figures(
            "Predicted and measured time",
            predicted,
            orders().map(|order| self.predicted_and_measured(order)),
        );
        body += "<section>\n<h2>The fastest for a wanted error</h2>\n<ul>\n";
        for wanted in &self.wanted {
            for order in orders() {
                let answer = escape(&self.answer(order, *wanted));
                body += &format!("<li>{} to {}: {answer}</li>\n", QUANTITIES[order], error(*wanted));
            }
        }
        body += "</ul>\n</section>\n<section>\n<h2>All numbers</h2>\n";
        for order in orders() {
            body += &self.table(order);
        }
        body += "</section>\n";
        body
    }

    fn table(&self, order: usize) -> String {
        let front = self.front(order);
        let mut rows = String::new();
        for (place, method) in self.methods.iter().enumerate() {
            let quantity = &method.quantities[order];
            let class = if front.contains(&place) { " class=\"front\"" } else { "" };
            rows += &format!("<tr{class}><th>{}</th>", escape(&method.name));
            if let (Ok(largest), Some(median), Some(measured)) = (quantity.largest(), quantity.median(), quantity.time)
            {
                let [low, high] = measured.quartiles.map(time);
                rows += &format!(
                    "<td>{}</td><td>{}</td><td>{}</td><td>{low} to {high}</td><td>{:.2}</td><td>{}</td></tr>\n",
                    error(largest),
                    error(median),
                    time(measured.median),
                    measured.ratio,
                    quantity.predicted.map_or_else(String::new, time)
                );
            } else {
                let failure = self.failure(place, order).unwrap_or_default();
                rows += &format!("<td class=\"why\" colspan=\"6\">{}</td></tr>\n", escape(&failure));
            }
        }
        let heads = ["largest error", "median error", "time", "quartiles", "ratio", "predicted"];
        table(quantity_name(order), &heads, [rows].into_iter())
    }
}

fn quantity(order: usize) -> &'static str {
    QUANTITIES.get(order).copied().unwrap_or_default()
}

/// The title of a table: the position is part of all times.
fn quantity_name(order: usize) -> &'static str {
    ["Position", "Position and velocity", "Position, velocity and acceleration"].get(order).copied().unwrap_or_default()
}
