//! The page: charts, recommendations and all numbers.

use std::fmt::Write;

use crate::comparison::Comparison;
use crate::{METHODS, WANTED, answer, chart, describe};
use linkage::chart::Chart;
use linkage_examples::price;

pub fn html(comparisons: &[Comparison]) -> String {
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>Accuracy and time of position methods</title>\n\
         <style>{}{}</style>\n</head>\n<body>\n<header>\n<h1>Accuracy and time of position methods</h1>\n\
         <p>The largest error against 45 digits and the median time of one evaluation; the methods are timed alternately. \
         The step line passes the methods that are clearly more accurate than every faster one. The error of positions is in radians; that of \
         velocities is relative to the largest one, that of accelerations to the larger of the largest one and the square of the \
         largest velocity. Along a motion closed forms are orange, Newton's \
         method is blue, tables are green; a line is broken where its method returns an error; dashed: dominated methods, and dead points.</p>\n<ol class=\"methods\">",
        price::STYLE,
        linkage::chart::STYLE
    );
    let mut push = |text: std::fmt::Arguments| {
        // Writing to a string does not fail.
        let _ = html.write_fmt(text);
    };
    for (name, by) in METHODS.iter().zip(&comparisons[0].dominated) {
        let note = by.map_or_else(String::new, |by| format!(" <i>dominated by {}</i>", METHODS[by]));
        push(format_args!("<li>{name}{note}</li>"));
    }
    push(format_args!("</ol>\n</header>\n<main>\n"));
    for comparison in comparisons {
        push(format_args!("<section>\n<h2>The {}</h2>\n<div class=\"charts\">", comparison.mechanism));
        let figure = |chart: Chart| format!("<figure>{}</figure>", chart.to_svg_fragment());
        for chart in chart::error_and_time(comparison) {
            push(format_args!("{}", figure(chart)));
        }
        push(format_args!("</div>\n<h3>Errors along a motion</h3>\n<div class=\"charts\">"));
        for motion in &comparison.motions {
            push(format_args!("{}", figure(chart::errors_along(motion, &comparison.dominated))));
        }
        push(format_args!(
            "</div>\n<h3>Predicted and measured time</h3>\n<p>The prediction is the number of operations of each kind times \
             the measured time of one, in two chains of dependent operations. Checks and memory are not in it.</p>\n\
             <div class=\"charts\">{}</div>\n",
            figure(chart::predicted_and_measured(comparison))
        ));
        push(format_args!("<h3>Fastest with error {WANTED:.0e}</h3>\n<ul>"));
        for point in comparison.points.iter().filter(|point| point.pose == "benign" && !point.angles_given) {
            let text = answer(comparison, point);
            push(format_args!("<li>{}</li>", text.split_once(": ").map_or(&*text, |(_, text)| text)));
        }
        push(format_args!("</ul>\n<details><summary>All numbers</summary>\n"));
        for (index, point) in comparison.points.iter().enumerate() {
            let (prices, front) = (comparison.at(index), comparison.front(index));
            push(format_args!("<table><caption>{}</caption>", describe(point)));
            for (method, name) in METHODS.iter().enumerate() {
                let class = if front.contains(&method) { " class=\"front\"" } else { "" };
                if let Some(price) = prices[method] {
                    let (error, time) = (price.error, 1e9 * price.time);
                    push(format_args!("<tr{class}><th>{name}</th><td>{error:.1e}</td><td>{time:.0} ns</td></tr>"));
                } else if comparison.failures.iter().any(|(m, p, _)| (*m, *p) == (method, index)) {
                    push(format_args!("<tr><th>{name}</th><td>error</td><td></td></tr>"));
                }
            }
            push(format_args!("</table>\n"));
        }
        push(format_args!("</details>\n</section>\n"));
    }
    push(format_args!("</main>\n</body>\n</html>\n"));
    html
}
