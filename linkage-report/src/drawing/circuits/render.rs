//! Writes the SVG of a chart of circuits.

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{Circle, Description, Group, Line as Stroke, Path, Rectangle, Style, Text, Title};

use super::miniature::{self, Scale, rounded};
use super::{CircuitChart, MOST_MINIATURES, Place, letter, summary};
use crate::drawing::pen::Pen;

/// The width of the picture and the plot in it, in pixels. Half a page wide, so that a phone shows it with its texts.
const WIDTH: f64 = 480.0;
const LEFT: f64 = 46.0;
const TOP: f64 = 52.0;
const PLOT: Vector2<f64> = Vector2::new(416.0, 260.0);

/// The colours and the dashes of circuits, used in turn: 20 combinations.
const COLOURS: usize = 5;
const DASHES: usize = 4;

/// The heights of a line of the legend, and of a small drawing with its words.
const LEGEND: f64 = 18.0;
const CELL: f64 = miniature::HEIGHT + 40.0;
const CELLS: usize = 4;

/// The most circuits of the legend.
const MOST_WORDS: usize = 8;

pub(super) fn svg(chart: &CircuitChart) -> String {
    let shown = chart.words.len().min(MOST_WORDS);
    let hidden = chart.words.len() - shown;
    let legend = TOP + PLOT.y + 44.0;
    let cells = legend + LEGEND * (shown + usize::from(hidden > 0)) as f64 + 4.0;
    let drawn = chart.places.len().min(MOST_MINIATURES);
    let rows = drawn.div_ceil(CELLS);
    let height = cells + CELL * rows as f64 + 4.0;
    let mut document = Document::new()
        .set("class", "circuits")
        .set("viewBox", (0, 0, WIDTH, height.ceil()))
        .set("role", "img")
        .add(Title::new(chart.title.as_str()))
        .add(Description::new().add(svg::node::Text::new(describe(chart))))
        .add(Style::new(include_str!("chart.css")))
        .add(Rectangle::new().set("class", "paper").set("width", "100%").set("height", "100%"))
        .add(text(&chart.title, "title", Vector2::new(10.0, 20.0)))
        .add(text(&summary(chart), "soft", Vector2::new(10.0, 37.0)))
        .add(axes(chart))
        .add(lines(chart))
        .add(marks(chart));
    for (circuit, words) in chart.all_words().take(shown).enumerate() {
        let y = legend + LEGEND * circuit as f64;
        let sample = [Vector2::new(10.0, y - 4.0), Vector2::new(44.0, y - 4.0)];
        document = document.add(coloured(circuit).add(line(circuit, &sample))).add(text(
            &clipped(&words, 68),
            "soft",
            Vector2::new(52.0, y),
        ));
    }
    if hidden > 0 {
        let words = format!("and {hidden} more circuits");
        document = document.add(text(&words, "soft", Vector2::new(52.0, legend + LEGEND * shown as f64)));
    }
    let scale = Scale::of(chart.places.iter().map(|place| &place.miniature));
    for (number, place) in chart.places.iter().take(drawn).enumerate() {
        let corner = Vector2::new(10.0 + 116.0 * (number % CELLS) as f64, cells + CELL * (number / CELLS) as f64);
        document = document.add(cell(chart, number, place, &scale, corner));
    }
    document.to_string()
}

fn describe(chart: &CircuitChart) -> String {
    let [input, unknown] = [0, 1].map(|axis| &chart.axes[axis].name);
    let circuits: Vec<String> = chart.all_words().collect();
    format!("{unknown} over {input}, {}; {}", summary(chart), circuits.join("; "))
}

/// The text, cut to a number of characters.
fn clipped(words: &str, most: usize) -> String {
    if words.chars().count() <= most {
        return words.to_owned();
    }
    words.chars().take(most - 1).chain(['…']).collect()
}

fn text(words: &str, class: &str, at: Vector2<f64>) -> Text {
    Text::new(words).set("class", class).set("x", rounded(at.x)).set("y", rounded(at.y))
}

/// A group in the colour of a circuit.
fn coloured(circuit: usize) -> Group {
    Group::new().set("class", format!("c{}", circuit % COLOURS))
}

/// A line with the dashes of a circuit.
fn line(circuit: usize, points: &[Vector2<f64>]) -> Path {
    let class = format!("line k{}", circuit % DASHES);
    Path::new().set("class", class).set("d", Pen::default().lines(points).path())
}

/// A point given by fractions of the axes.
fn pixel(at: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(LEFT + at.x * PLOT.x, TOP + (1.0 - at.y) * PLOT.y)
}

fn stroke([from, to]: [Vector2<f64>; 2]) -> Stroke {
    let [from, to] = [from, to].map(|at| at.map(rounded));
    Stroke::new().set("class", "grid").set("x1", from.x).set("y1", from.y).set("x2", to.x).set("y2", to.y)
}

fn axes(chart: &CircuitChart) -> Group {
    let [across, up] = &chart.axes;
    let mut group = Group::new();
    let (bottom, right) = (TOP + PLOT.y, LEFT + PLOT.x);
    for (value, label) in across.ticks() {
        let x = pixel(Vector2::new((value - across.low) / (across.high - across.low), 0.0)).x;
        group = group.add(stroke([Vector2::new(x, TOP), Vector2::new(x, bottom)])).add(text(
            &label,
            "soft middle",
            Vector2::new(x, bottom + 15.0),
        ));
    }
    for (value, label) in up.ticks() {
        let y = pixel(Vector2::new(0.0, (value - up.low) / (up.high - up.low))).y;
        group = group.add(stroke([Vector2::new(LEFT, y), Vector2::new(right, y)])).add(text(
            &label,
            "soft end",
            Vector2::new(LEFT - 5.0, y + 4.0),
        ));
    }
    let frame = Rectangle::new().set("class", "frame").set("x", LEFT).set("y", TOP);
    group
        .add(frame.set("width", PLOT.x).set("height", PLOT.y))
        .add(text(&across.name, "name end", Vector2::new(right, bottom + 29.0)))
        .add(text(&up.name, "name end", Vector2::new(right, TOP - 7.0)))
}

fn lines(chart: &CircuitChart) -> Group {
    chart.lines.iter().fold(Group::new(), |group, motion| {
        let runs = motion.runs.iter().map(|run| run.iter().copied().map(pixel).collect::<Vec<_>>());
        group.add(runs.fold(coloured(motion.circuit), |group, run| group.add(line(motion.circuit, &run))))
    })
}

/// The place of a point of the chart, in pixels.
fn placed(chart: &CircuitChart, at: Vector2<f64>) -> Vector2<f64> {
    pixel(Vector2::new(chart.axes[0].fraction(at.x), chart.axes[1].fraction(at.y)))
}

/// The modes with their numbers, the dead points with their letters.
fn marks(chart: &CircuitChart) -> Group {
    let mut group = Group::new();
    for (number, place) in chart.places.iter().enumerate() {
        group = group.add(badge(place, placed(chart, place.at), number));
    }
    let modes: Vec<Vector2<f64>> = chart.modes.iter().map(|&at| placed(chart, at)).collect();
    for ((number, &at), label) in modes.iter().enumerate().zip(labels(&modes)) {
        let circle = Circle::new().set("class", "mode").set("cx", rounded(at.x)).set("cy", rounded(at.y)).set("r", 3.5);
        let circuit = chart.mode_circuits.get(number).copied().unwrap_or_default();
        group = group.add(coloured(circuit).add(circle)).add(text(&(chart.first + number).to_string(), "label", label));
    }
    group
}

/// The places of the numbers of modes: each next to its dot, at the corner farthest from other dots and numbers.
fn labels(modes: &[Vector2<f64>]) -> Vec<Vector2<f64>> {
    let corners = [[9.0, -5.0], [9.0, 12.0], [-9.0, -5.0], [-9.0, 12.0]].map(Vector2::from);
    let mut placed: Vec<Vector2<f64>> = Vec::new();
    for (number, &mode) in modes.iter().enumerate() {
        // From the middle of the digits.
        let room = |label: Vector2<f64>| {
            let others = modes.iter().enumerate().filter(|&(other, _)| other != number).map(|(_, &at)| at);
            let middle = label - Vector2::new(0.0, 4.0);
            let numbers = placed.iter().map(|at| at - Vector2::new(0.0, 4.0));
            others.chain(numbers).map(|at| (at - middle).norm()).fold(20.0, f64::min)
        };
        let best = corners.map(|corner| mode + corner).into_iter().rev().max_by(|a, b| room(*a).total_cmp(&room(*b)));
        placed.extend(best);
    }
    placed
}

/// The letter of a place: of a dead point in a circle, of a change point in a square.
fn badge(place: &Place, at: Vector2<f64>, number: usize) -> Group {
    let at = at.map(rounded);
    let group = coloured(place.circuit);
    let group = if place.is_dead_point {
        group.add(Circle::new().set("class", "place").set("cx", at.x).set("cy", at.y).set("r", 7))
    } else {
        let square = Rectangle::new().set("class", "place").set("x", rounded(at.x - 6.5)).set("y", rounded(at.y - 6.5));
        group.add(square.set("width", 13).set("height", 13))
    };
    group.add(text(&letter(number), "letter", at + Vector2::new(0.0, 3.7)))
}

/// The linkage at a place, with its letter, its input and its modes.
fn cell(chart: &CircuitChart, number: usize, place: &Place, scale: &Scale, corner: Vector2<f64>) -> Group {
    let input = chart.axes[0].text(chart.axes[0].on_axis(place.at.x));
    let modes = match (place.is_dead_point, place.modes.map(|mode| mode.map(|mode| chart.first + mode))) {
        (true, [Some(one), Some(other)]) => format!("modes {}, {}", one.min(other), one.max(other)),
        (true, [Some(mode), None] | [None, Some(mode)]) => format!("mode {mode}"),
        (true, [None, None]) => String::new(),
        (false, _) => "motions cross".to_owned(),
    };
    let corner = corner.map(rounded);
    Group::new()
        .set("transform", format!("translate({} {})", corner.x, corner.y))
        .add(badge(place, Vector2::new(9.0, 12.0), number))
        .add(text(&input, "", Vector2::new(20.0, 16.0)))
        .add(text(&modes, "soft", Vector2::new(2.0, CELL - 6.0)))
        .add(place.miniature.group(scale).set("transform", "translate(0 18)"))
}
