//! Prices as charts and pages.

use super::data::{Family, MethodPrice, QUANTITIES};
use super::motion::MotionPrice;
use super::scene::{Order, PartPrice, RunOutcome, ScenePrice, WithoutPrice};
use super::text::{UNOPTIMISED, error, not_counted, operations, time};
use crate::chart::{self, Axis, Chart, Curve, Line, Look, Span, Unit};
use crate::report::prose::end;
use crate::sheet::{document, escape};

/// Errors below are drawn here: a result may be exact.
const LEAST: f64 = 1e-34;

/// Additions to the style of sheets.
const STYLE: &str = include_str!("style.css");

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

impl ScenePrice {
    /// A curve of the runs by each method.
    fn by_method(&self, chart: Chart, at: impl Fn(&RunOutcome, f64) -> Option<[f64; 2]>) -> Chart {
        let methods = [(Order::Eight, 0, Look::Line), (Order::Five, 1, Look::Dashed)];
        methods.into_iter().fold(chart, |mut chart, (order, colour, look)| {
            let runs = self.runs.iter().filter(|run| run.order == order);
            let points = runs.map(|run| at(run.outcome.as_ref().ok()?, run.tolerance));
            let points: Vec<_> = points.collect();
            let dots = points.iter().flatten().copied();
            chart.curves.push(Curve { colour, ..Curve::new("", Look::Dots, dots) });
            chart.curves.push(Curve { colour, points, ..Curve::new(order.to_string(), look, []) });
            chart
        })
    }

    /// The chart of error against the time of a run.
    #[must_use]
    pub fn error_and_time(&self) -> Chart {
        let time = Axis::logarithmic("time of a run").unit(Unit::Seconds);
        let chart = Chart::new("Error by time", time, Axis::logarithmic("largest error"));
        self.by_method(chart, |outcome, _| Some([outcome.time?.median, outcome.error.max(LEAST)]))
    }

    /// The chart of error by tolerance.
    #[must_use]
    pub fn error_by_tolerance(&self) -> Chart {
        let tolerance = Axis::logarithmic("tolerance");
        let chart = Chart::new("Error by tolerance", tolerance, Axis::logarithmic("largest error"));
        self.by_method(chart, |outcome, tolerance| Some([tolerance, outcome.error.max(LEAST)]))
    }

    /// The chart of right-hand sides by tolerance.
    #[must_use]
    pub fn evaluations_by_tolerance(&self) -> Chart {
        let tolerance = Axis::logarithmic("tolerance");
        let chart = Chart::new("Right-hand sides by tolerance", tolerance, Axis::logarithmic("right-hand sides"));
        self.by_method(chart, |outcome, tolerance| Some([tolerance, outcome.counts.evaluations as f64]))
    }

    /// The chart of what a step calls and of what effects cost by their formulas.
    #[must_use]
    pub fn parts_and_effects(&self) -> Chart {
        let short = |name: &str| name.split(':').next().unwrap_or(name).to_owned();
        let parts = self.parts.iter().filter_map(|part| Some((short(&part.name), part.time?.median)));
        let effects = self.effects.iter().filter(|effect| effect.predicted > 0.0);
        let effects = effects.map(|effect| (effect.name.clone(), effect.predicted));
        let (parts, effects): (Vec<_>, Vec<_>) = (parts.collect(), effects.collect());
        let names = parts.iter().chain(&effects).map(|(name, _)| name.clone()).collect();
        let across = Axis::logarithmic("time").unit(Unit::Seconds);
        let mut chart = Chart::new("Parts and effects", across, Axis::linear("").unit(Unit::Names(names)));
        let at = |first: usize, rows: &[(String, f64)]| -> Vec<[f64; 2]> {
            rows.iter().enumerate().map(|(place, (_, time))| [*time, (first + place) as f64]).collect()
        };
        chart.curves.push(Curve::new("measured", Look::Dots, at(0, &parts)));
        let predicted = Curve::new("by the formula", Look::Rings, at(parts.len(), &effects));
        chart.curves.push(Curve { colour: 1, ..predicted });
        chart
    }

    /// The price as one HTML file, which loads nothing and runs no script.
    #[must_use]
    pub fn to_html(&self) -> String {
        page(&escape(&self.scene), "The price of accuracy", &self.to_html_fragment())
    }

    /// The sections of the page alone, to be part of another, which has the style of sheets and [`style`].
    #[must_use]
    pub fn to_html_fragment(&self) -> String {
        let mut body: String = self.about().iter().map(|about| format!("<p>{}</p>\n", escape(about))).collect();
        if !self.is_optimised {
            body += &format!("<p>{UNOPTIMISED}</p>\n");
        }
        let by_tolerance = "The largest error of a coordinate at the sampled times, in radians; that of a length is divided by the \
                            lengths of its loops. Times are medians of whole runs.";
        let charts = [self.error_and_time(), self.error_by_tolerance(), self.evaluations_by_tolerance()];
        body += &figures("Error, right-hand sides and time", by_tolerance, charts.into_iter());
        body += "<section>\n<h2>The fastest for a wanted error</h2>\n<ul>\n";
        for wanted in &self.wanted {
            body += &format!("<li>{}: {}</li>\n", error(*wanted), escape(&self.answer(*wanted)));
        }
        body += "</ul>\n</section>\n";
        let parts = "What a step calls, as measured, and what bodies and effects add to a right-hand side by the operations of their \
                     formulas, without those of user functions; sines and cosines of coordinates are those of the pose.";
        body += &figures("What its parts cost", parts, [self.parts_and_effects()].into_iter());
        body += &self.parts_table();
        body += &self.effects_table();
        body += &self.without_table();
        body += "<section>\n<h2>All runs</h2>\n";
        body += &self.runs_table();
        body += "</section>\n";
        body
    }

    fn runs_table(&self) -> String {
        let front = self.front();
        let rows = self.runs.iter().enumerate().map(|(place, run)| {
            let class = if front.contains(&place) { " class=\"front\"" } else { "" };
            let setting = format!("<tr{class}><th>{}</th><td>{}</td>", run.order, error(run.tolerance));
            let rest = match &run.outcome {
                Ok(RunOutcome { error: largest, error_at_end, counts, time: of }) => format!(
                    "<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
                    error(*largest),
                    error(*error_at_end),
                    counts.evaluations,
                    counts.accepted,
                    counts.rejected,
                    of.map_or_else(String::new, |of| time(of.median))
                ),
                Err(error) => format!("<td class=\"why\" colspan=\"6\">{}</td>", escape(&error.to_string())),
            };
            setting + &rest + "</tr>\n"
        });
        let heads = ["tolerance", "largest error", "at the end", "right-hand sides", "steps", "rejected", "time"];
        table("Runs", &heads, rows)
    }

    fn parts_table(&self) -> String {
        let rows = self.parts.iter().filter_map(|PartPrice { name, time: of }| {
            let of = (*of)?;
            let [low, high] = of.quartiles.map(time);
            let name = escape(name);
            Some(format!(
                "<tr><th>{name}</th><td>{}</td><td>{low} to {high}</td><td>{:.2}</td></tr>\n",
                time(of.median),
                of.ratio
            ))
        });
        table("Calls", &["time", "quartiles", "ratio"], rows)
    }

    fn effects_table(&self) -> String {
        let rows = self.effects.iter().map(|effect| {
            let all = operations(effect.operations).map(|count| format!("<td>{count}</td>")).concat();
            let alone: usize = operations(effect.alone).iter().sum();
            let calls = not_counted(effect);
            let name = escape(&effect.name);
            format!(
                "<tr><th>{name}{}</th>{all}<td>{alone}</td><td>{}</td></tr>\n",
                escape(&calls),
                time(effect.predicted)
            )
        });
        let heads = ["functions", "quotients", "products", "sums", "of it alone", "time"];
        table("Bodies and effects by their formulas", &heads, rows)
    }

    fn without_table(&self) -> String {
        if self.without.is_empty() {
            return String::new();
        }
        let rows = self.without.iter().map(|WithoutPrice { name, derivative, run, evaluations: [with, without] }| {
            let of = |times: &[Option<super::Time>; 2]| {
                let texts = times.map(|of| of.map_or_else(String::new, |of| time(of.median)));
                let ratio = times[1].map_or(f64::NAN, |of| of.ratio);
                format!("<td>{} → {}</td><td>{ratio:.2}</td>", texts[0], texts[1])
            };
            format!("<tr><th>{}</th>{}<td>{with} → {without}</td>{}</tr>\n", escape(name), of(derivative), of(run))
        });
        let heads = ["a right-hand side", "ratio", "right-hand sides", "a run", "ratio"];
        table("Without an effect, as measured", &heads, rows)
    }
}

/// A table with a column of names.
fn table(caption: &str, heads: &[&str], rows: impl Iterator<Item = String>) -> String {
    let heads: String = heads.iter().map(|head| format!("<td>{head}</td>")).collect();
    let rows: String = rows.collect();
    format!(
        "<div class=\"wide\"><table><caption>{caption}</caption>\n<tr><th></th>{heads}</tr>\n{rows}</table></div>\n"
    )
}

fn quantity(order: usize) -> &'static str {
    QUANTITIES.get(order).copied().unwrap_or_default()
}

/// The title of a table: the position is part of all times.
fn quantity_name(order: usize) -> &'static str {
    ["Position", "Position and velocity", "Position, velocity and acceleration"].get(order).copied().unwrap_or_default()
}

/// The style of the fragments of prices, for a page that has that of sheets.
#[must_use]
pub fn style() -> String {
    format!("{}{STYLE}", chart::STYLE)
}

/// A page with this heading, and these sections.
pub(super) fn page(name: &str, over: &str, sections: &str) -> String {
    let style = style();
    let header = format!("<header>\n<p class=\"over\">{over}</p>\n<h1>{name}</h1>\n</header>\n");
    document(name, &format!("<style>{style}</style>\n<div class=\"price\">\n{header}{sections}</div>\n"))
}

/// A section of charts.
pub(super) fn figures(heading: &str, about: &str, charts: impl Iterator<Item = Chart>) -> String {
    let charts: String = charts.map(|chart| format!("<figure>{}</figure>\n", chart.to_svg_fragment())).collect();
    format!("<section>\n<h2>{heading}</h2>\n<p>{about}</p>\n<div class=\"charts\">\n{charts}</div>\n</section>\n")
}
