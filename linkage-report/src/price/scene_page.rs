//! The price of a scene as charts and as a page.

use super::page::{LEAST, figures, page, table};
use super::parts::PartPrice;
use super::runs::Order;
use super::scene::{RunOutcome, ScenePrice, WithoutPrice};
use super::text::{UNOPTIMISED, error, not_counted, operations, time};
use super::timing::Time;
use crate::chart::{Axis, Chart, Curve, Look, Unit};
use crate::sheet::escape;

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

    /// The sections of the page alone, to be part of another, which has the style of sheets and [`style`](super::style).
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
            let of = |times: &[Option<Time>; 2]| {
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
