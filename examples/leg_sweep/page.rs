//! The page.

use std::error::Error;
use std::fmt::Write;

use crate::chart::Chart;
use crate::fates::Fate;
use crate::gait::Gait;
use crate::machine::{LENGTHS, SPREAD};
use crate::study::{Chosen, LEAST_STRIDE, Study};

/// The style of the gallery, of plots, and of this page.
const STYLE: &str =
    concat!(include_str!("../gallery/style.css"), include_str!("../plot/style.css"), include_str!("style.css"));

/// Writes the page.
pub fn html(study: &Study, legs: &[Chosen], rows: &[[String; 2]]) -> Result<String, Box<dyn Error>> {
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>Legs</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{} legs</h1>\n\
         <p>Theo Jansen's leg with twelve lengths changed at random by up to {:.0} %, each over a turn of the crank. The \
         ground phase is the half of the turn in which the foot is lowest. Unevenness is the range of the foot's height \
         in this phase, and step height the height of the path above it, both divided by the stride, the length of the \
         phase. To be compared, a leg must have one ground phase in a turn and at least {LEAST_STRIDE} of the stride of \
         Jansen's leg, and its foot must stay below the circle of the crank.</p>\n</header>\n<main>\n",
        thousands(study.designs),
        100.0 * SPREAD
    );
    html.push_str("<section>\n<h2>Flat or high</h2>\n<div class=\"grid wide\">\n");
    let caption = format!(
        "The colour of a cell is stronger if more designs have this unevenness and step height; {} designs are beyond \
         the chart. The dots are the Pareto front: no design is flatter and steps higher.",
        thousands(study.gaits.1.outside)
    );
    figure(&mut html, &front(study, legs), &caption);
    let caption = format!(
        "The region of the feet of all {} walking legs, stronger where they are more often, with the paths of the legs \
         below; {} positions are beyond the chart.",
        thousands(study.fates.get(&Fate::Walks).copied().unwrap_or(0)),
        thousands(study.reach.1.outside)
    );
    figure(&mut html, &reach(study, legs), &caption);
    html.push_str("</div>\n</section>\n<section>\n<h2>Legs</h2>\n<div class=\"grid\">\n");
    for Chosen { letter, name, walker } in legs {
        let caption = format!("<b class=\"leg{letter}\">{letter}</b> {name}: {}.", gait(&walker.gait));
        figure(&mut html, &walker.picture(name)?, &caption);
    }
    html.push_str("</div>\n</section>\n<section>\n<h2>Lengths</h2>\n<table class=\"lengths\">\n<tr><th></th>");
    for Chosen { letter, .. } in legs {
        let _ = write!(html, "<td><b class=\"leg{letter}\">{letter}</b></td>");
    }
    html.push_str("</tr>\n");
    for (place, length) in LENGTHS.into_iter().enumerate() {
        let _ = write!(html, "<tr><th><i>{length}</i></th>");
        for Chosen { walker, .. } in legs {
            let lengths: [f64; LENGTHS.len()] = walker.design.clone().into();
            let _ = write!(html, "<td>{:.1}</td>", lengths[place]);
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</table>\n</section>\n<section>\n<h2>In numbers</h2>\n<table>\n");
    for [name, value] in rows {
        let _ = writeln!(html, "<tr><th>{name}</th><td>{value}</td></tr>");
    }
    html.push_str("</table>\n</section>\n</main>\n</body>\n</html>\n");
    Ok(html)
}

fn figure(html: &mut String, picture: &str, caption: &str) {
    // Writing to a string does not fail.
    let _ = writeln!(html, "<figure>\n{picture}\n<figcaption><p>{caption}</p></figcaption>\n</figure>");
}

/// The gaits of all designs, the front and the chosen legs.
fn front(study: &Study, legs: &[Chosen]) -> String {
    let (grid, cells) = &study.gaits;
    let names = ["unevenness, % of the stride", "step height, % of the stride"];
    let mut chart = Chart::new("Step height over unevenness", [grid.x, grid.y], names, Some(300.0)).cells(grid, cells);
    let points = study.front.iter().map(|leg| [-100.0 * leg.scores[0], 100.0 * leg.scores[1]]);
    chart = chart.dots("front", 1.8, points);
    for Chosen { letter, walker, .. } in legs {
        let class = format!("leg{letter}");
        chart = chart.mark(&class, *letter, [100.0 * walker.gait.unevenness, 100.0 * walker.gait.step]);
    }
    chart.svg()
}

/// The region that the feet reach, and the paths of the chosen legs.
fn reach(study: &Study, legs: &[Chosen]) -> String {
    let (grid, cells) = &study.reach;
    let mut chart = Chart::new("Region of the foot", [grid.x, grid.y], ["x", "y"], None).cells(grid, cells);
    for Chosen { letter, walker, .. } in legs {
        chart = chart.path(&format!("leg{letter}"), &walker.path);
    }
    chart.svg()
}

/// A gait in words.
pub fn gait(gait: &Gait) -> String {
    let Gait { unevenness, step, stride, .. } = gait;
    format!("unevenness {:.2} %, step height {:.1} %, stride {stride:.1}", 100.0 * unevenness, 100.0 * step)
}

/// A number with spaces between groups of three digits.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().filter_map(|group| str::from_utf8(group).ok()).collect();
    groups.join("\u{202f}")
}
