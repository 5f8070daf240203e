//! The page: charts, the practical answer, and every number.

use std::fmt::Write;

use crate::price::{self, axes};
use crate::stall::Stall;
use crate::{METHODS, WANTED, answer, chart, describe};

pub fn html(stalls: &[Stall]) -> String {
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>What digits cost</title>\n\
         <style>{}{}{}</style>\n</head>\n<body>\n<header>\n<h1>What digits cost</h1>\n\
         <p>The largest error against 45 digits, beside the median time of one evaluation, all methods timed in turns. \
         Orange: clearly more exact than everything that is faster. Of positions the error is in radians; of \
         velocities it is relative to the largest of them, of accelerations to the larger of those and the square of the \
         velocities, which they are made of.</p>\n<ol class=\"methods\">",
        price::STYLE,
        axes::STYLE,
        chart::STYLE
    );
    let mut push = |text: std::fmt::Arguments| {
        // Writing to a string does not fail.
        let _ = html.write_fmt(text);
    };
    for (name, by) in METHODS.iter().zip(&stalls[0].dominated) {
        let note = by.map_or_else(String::new, |by| format!(" <i>dominated by {}</i>", METHODS[by]));
        push(format_args!("<li>{name}{note}</li>"));
    }
    push(format_args!("</ol>\n</header>\n<main>\n"));
    for stall in stalls {
        push(format_args!("<section>\n<h2>The {}</h2>\n<div class=\"charts\">", stall.mechanism));
        for panel in chart::panels(stall) {
            push(format_args!("<figure>{}</figure>", chart::figure(&panel)));
        }
        push(format_args!("</div>\n<h3>Cheapest for {WANTED:.0e}</h3>\n<ul>"));
        for point in stall.points.iter().filter(|point| point.pose == "benign" && !point.angles_given) {
            let text = answer(stall, point);
            push(format_args!("<li>{}</li>", text.split_once(": ").map_or(&*text, |(_, text)| text)));
        }
        push(format_args!("</ul>\n<details><summary>All numbers</summary>\n"));
        for (index, point) in stall.points.iter().enumerate() {
            let (prices, front) = (stall.at(index), stall.front(index));
            push(format_args!("<table><caption>{}</caption>", describe(point)));
            for (method, name) in METHODS.iter().enumerate() {
                let class = if front.contains(&method) { " class=\"front\"" } else { "" };
                if let Some(price) = prices[method] {
                    let (error, time) = (price.error, price.time);
                    push(format_args!("<tr{class}><th>{name}</th><td>{error:.1e}</td><td>{time:.0} ns</td></tr>"));
                } else if stall.refusals.iter().any(|(m, p, _)| (*m, *p) == (method, index)) {
                    push(format_args!("<tr><th>{name}</th><td>refused</td><td></td></tr>"));
                }
            }
            push(format_args!("</table>\n"));
        }
        push(format_args!("</details>\n</section>\n"));
    }
    push(format_args!("</main>\n</body>\n</html>\n"));
    html
}
