//! The page: a grid of pictures with a description of each.

use std::fmt::Write;

use crate::Family;
use crate::figure::{Course, Figure};

/// The page of these families and of the pictures of all their figures, in order.
pub fn html(families: &[Family], pictures: &[String]) -> String {
    let count: usize = families.iter().map(|family| family.figures.len()).sum();
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>Gallery of linkages</title>\n\
         <style>{}</style>\n</head>\n<body>\n<header>\n<h1>Gallery of linkages</h1>\n\
         <p>{count} pictures of classic mechanisms, each computed from its loop equations. Every frame is a position on one \
         branch, assembled group by group, in closed form if possible. A mode is a position \
         at a given input, counted where there are most; a circuit is all positions that are connected by motion; a full \
         turn passes no dead point. Orange: driving link; red: traced path.</p>\n\
         </header>\n<main>\n",
        include_str!("style.css")
    );
    let mut pictures = pictures.iter();
    for family in families {
        push(&mut html, format_args!("<section>\n<h2>{}</h2>\n<div class=\"grid\">\n", escape(family.name)));
        for (figure, picture) in family.figures.iter().zip(&mut pictures) {
            push(&mut html, format_args!("{}", self::figure(figure, picture)));
        }
        html.push_str("</div>\n</section>\n");
    }
    html.push_str("</main>\n</body>\n</html>\n");
    html
}

fn push(html: &mut String, text: std::fmt::Arguments) {
    // Writing to a string does not fail.
    let _ = html.write_fmt(text);
}

fn figure(figure: &Figure, picture: &str) -> String {
    let Figure { name, about, source, .. } = figure;
    let derivation = figure.derivation;
    let inputs: Vec<String> = derivation.inputs.iter().map(|input| input.formula.to_string()).collect();
    let groups: String = derivation
        .groups
        .iter()
        .map(|group| {
            // The text before the colon is the name of the kind.
            let kind = group.kind.split(':').next().unwrap_or_default();
            let unknowns: Vec<String> = group.unknowns.iter().map(ToString::to_string).collect();
            format!("<li>{} <i>{}</i></li>", escape(kind), escape(&unknowns.join(", ")))
        })
        .collect();
    let branches = match figure.branches {
        None => "positions by Newton's method".to_owned(),
        Some([all, here]) if all == here => all.to_string(),
        Some([all, here]) => format!("{all}, {here} of them in the first frame"),
    };
    let circuits = figure.circuits.map_or_else(String::new, |[modes, circuits, turns]| {
        let [modes, circuits, turns] =
            [(modes, "mode"), (circuits, "circuit"), (turns, "full turn")].map(|(count, noun)| counted(count, noun));
        format!("<div><dt>Circuits</dt><dd>{modes}, {circuits}, {turns}</dd></div>")
    });
    format!(
        "<figure>\n{}\n<figcaption>\n<h3>{}</h3>\n<p>{}</p>\n<dl>\
         <div><dt>Input</dt><dd><i>{}</i>, {}</dd></div><div><dt>Branches</dt><dd>{branches}</dd></div>\
         {circuits}<div><dt>Groups</dt><dd><ol>{groups}</ol></dd></div></dl>\n<p class=\"source\">{}</p>\n</figcaption>\n</figure>\n",
        picture,
        escape(name),
        escape(about),
        escape(&inputs.join(", ")),
        course(figure.course),
        escape(source),
    )
}

/// A number with its noun.
fn counted(count: usize, noun: &str) -> String {
    match count {
        0 => format!("no {noun}"),
        1 => format!("1 {noun}"),
        count => format!("{count} {noun}s"),
    }
}

fn course(course: Course) -> String {
    match course {
        Course::Turn(_) => "a full turn".to_owned(),
        Course::Swing { low, high, .. } => {
            let degrees = |angle: f64| format!("{:.1}°", angle.to_degrees()).replace('-', "−");
            format!("from {} to {}", degrees(low), degrees(high))
        }
        Course::Own(words) => escape(words),
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
