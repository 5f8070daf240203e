//! The page: a chart with a text for each linkage.

use std::fmt::Write;

use crate::Figure;

/// The page of these figures.
pub fn html(figures: &[Figure]) -> String {
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>Circuits of linkages</title>\n\
         <style>{}figure>svg{{aspect-ratio:auto}}</style>\n</head>\n<body>\n<header>\n<h1>Circuits of linkages</h1>\n\
         <p>An assembly mode is a position at a given input; a circuit is all positions that are connected by motion. Each \
         mode at the start input (a dot with its number) is followed until its motion closes. Two modes meet at a dead \
         point (a letter in a circle), and motions cross at a change point (in a square): below, the linkage is drawn \
         there. Angles are modulo a turn.</p>\n</header>\n<main>\n<section>\n<h2>One input</h2>\n<div class=\"grid\">\n",
        include_str!("../gallery/style.css")
    );
    for Figure { words, svg, counts: [modes, circuits, turns] } in figures {
        // Writing to a string does not fail.
        let _ = writeln!(
            html,
            "<figure>\n{svg}\n<figcaption>\n<p>{words}</p>\n\
             <p class=\"source\">{modes} modes, {circuits} {}, {turns} full turns</p>\n</figcaption>\n</figure>",
            if *circuits == 1 { "circuit" } else { "circuits" }
        );
    }
    html.push_str("</div>\n</section>\n</main>\n</body>\n</html>\n");
    html
}
