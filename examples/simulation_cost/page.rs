//! The page: conclusions, charts and all numbers.

use std::fmt::Write;

use super::chart;
use super::list::{List, METHODS};
use super::reading::Paragraph;
use super::report::setting;
use crate::price;

/// Additions to the shared style.
const STYLE: &str = ".legend{list-style:none;columns:17rem;max-width:64rem;margin:1rem 0 0;padding:0}\
    .legend svg{width:28px;height:14px;margin-right:.5rem;vertical-align:-2px}\
    main p,main li,main h3{max-width:52rem}.charts{max-width:64rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,22rem),1fr))}.about{color:var(--soft)}table{width:min(100%,38rem)}\
    td.why{color:var(--soft);text-align:left;white-space:normal}";

pub fn html(lists: &[List], reading: &[Paragraph]) -> String {
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>Accuracy and time of simulation</title>\n\
         <style>{}{}{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>Accuracy and time of simulation</h1>\n\
         <p>The largest error of an angle at the end, in radians, and the median time of a whole run; the methods are \
         timed alternately. Ringed: clearly more accurate than every faster run, fixed steps included. Dashed: \
         order 5. All but the formulations with multipliers (index 1) use the same right-hand side. Without projection the \
         absolute tolerance equals the relative one, in rad and rad/s.</p>\n<ul class=\"legend\">",
        price::STYLE,
        linkage::chart::STYLE
    );
    let mut push = |text: std::fmt::Arguments| {
        // Writing to a string does not fail.
        let _ = html.write_fmt(text);
    };
    for method in chart::methods(lists) {
        let class = if method.is_dashed { "curve dashed" } else { "curve" };
        push(format_args!(
            "<li><svg class=\"chart\" viewBox=\"0 0 28 14\"><g class=\"k{}\"><path class=\"{class}\" d=\"M1 7H27\"/>\
             <circle class=\"dot\" cx=\"14\" cy=\"7\" r=\"2.4\"/></g></svg>{}</li>",
            method.colour, method.name
        ));
    }
    push(format_args!("</ul>\n</header>\n<main>\n<h2>Conclusions</h2>\n"));
    for paragraph in reading {
        push(format_args!("<h3>{}</h3>\n<ul>", paragraph.question));
        paragraph.answers.iter().for_each(|answer| push(format_args!("<li>{answer}</li>")));
        push(format_args!("</ul>\n<p class=\"about\">{}</p>\n", paragraph.remark));
    }
    for list in lists {
        push(format_args!(
            "<section>\n<h2>{}</h2>\n<p class=\"about\">{}</p>\n<div class=\"charts\">",
            list.title, list.about
        ));
        for chart in chart::charts(list) {
            push(format_args!("<figure>{}</figure>", chart.to_svg_fragment()));
        }
        push(format_args!(
            "</div>\n<details><summary>All numbers</summary>\n<table><tr><th>method</th><td>setting</td><td>error</td>\
             <td>right-hand sides</td><td>ms</td><td>gap</td></tr>"
        ));
        let front = list.front();
        for (index, row) in list.rows.iter().enumerate() {
            let class = if front.contains(&index) { " class=\"front\"" } else { "" };
            let (name, setting) = (METHODS[row.method].name, setting(row.method, row.setting));
            push(format_args!("<tr{class}><th>{name}</th><td>{setting}</td>"));
            match &row.outcome {
                Ok((outcome, price)) => push(format_args!(
                    "<td>{:.1e}</td><td>{}</td><td>{:.3}</td><td>{:.0e}</td></tr>",
                    price.error,
                    outcome.evaluations,
                    1e3 * price.time,
                    outcome.gap
                )),
                Err(error) => {
                    let error = error.lines().next().unwrap_or_default().replace('<', "&lt;");
                    push(format_args!("<td class=\"why\" colspan=\"4\">{error}</td></tr>"));
                }
            }
        }
        push(format_args!("</table>\n</details>\n</section>\n"));
    }
    push(format_args!("</main>\n</body>\n</html>\n"));
    html
}
