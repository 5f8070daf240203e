//! Writes the SVG of a drawing.

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{Circle, Description, Group, Line, Path, Polyline, Rectangle, Style, Text, Title};

use super::axes::{label, ticks};
use super::frame::{Frame, LEFT, TOP, WIDTH};
use super::names::{Name, Shape, foot, offsets};
use super::{Drawing, Mark, Quantity, Units};

const STYLE: &str = "
.paper{fill:#fff}.frame{fill:none;stroke:#888}.grid{stroke:#ddd}.tick{fill:#444;font-size:12px}
.title{fill:#111;font-size:15px;font-weight:600}.bar{stroke:#d9822b;stroke-width:4;stroke-linecap:round}
.joint{fill:#fff;stroke:#0b7285;stroke-width:2.5}.ground{fill:#0b7285;fill-opacity:.35;stroke:#0b7285;stroke-width:1.5}
.point{fill:#333}.path{fill:none;stroke:#6741d9;stroke-width:1.5;stroke-dasharray:5 3}
.velocity{stroke:#188038;fill:#188038}.acceleration{stroke:#d11a2a;fill:#d11a2a}.vector{stroke-width:2.5}
.name{fill:#111;font-size:14px;font-style:italic;paint-order:stroke;stroke:#fff;stroke-width:4px;stroke-linejoin:round}
text{font-family:sans-serif}
@media (prefers-color-scheme:dark){.paper{fill:#16181c}.frame{stroke:#777}.grid{stroke:#33373d}.tick{fill:#bbb}
.title{fill:#eee}.joint{fill:#16181c;stroke:#3bc9db}.ground{fill:#3bc9db;stroke:#3bc9db}.point{fill:#ddd}
.path{stroke:#b197fc}.velocity{stroke:#51cf66;fill:#51cf66}.acceleration{stroke:#ff6b6b;fill:#ff6b6b}
.name{fill:#eee;stroke:#16181c}}
";

/// The length of an arrow head, in pixels.
const HEAD: f64 = 10.0;

/// The SVG of a validated drawing.
pub(super) fn svg(drawing: &Drawing) -> String {
    let tips = drawing.arrows.iter().map(|arrow| drawing.tip(arrow));
    let all: Vec<Vector2<f64>> = drawing
        .places
        .iter()
        .map(|place| place.at)
        .chain(tips)
        .chain(drawing.paths.iter().flatten().copied())
        .collect();
    let frame = Frame::around(&all);
    let legend = legend(drawing);
    let bottom = TOP + frame.height() + 30.0;
    let (width, height) = (LEFT + WIDTH + 18.0, bottom + 24.0 * f64::from(u8::from(!legend.is_empty())) + 6.0);
    let mut document = Document::new()
        .set("viewBox", (0, 0, width, height.ceil()))
        .set("role", "img")
        .add(Title::new(drawing.title.as_str()))
        .add(Description::new().add(svg::node::Text::new(describe(drawing))))
        .add(Style::new(STYLE))
        .add(Rectangle::new().set("class", "paper").set("width", "100%").set("height", "100%"))
        .add(text(&drawing.title, "title", Vector2::new(LEFT, 27.0), "start"))
        .add(axes(&frame, drawing.units.as_ref()));
    for path in &drawing.paths {
        let points: Vec<String> = path.iter().map(|at| frame.pixel(*at)).map(|p| format!("{},{}", p.x, p.y)).collect();
        document = document.add(Polyline::new().set("class", "path").set("points", points.join(" ")));
    }
    let mut shapes = Vec::new();
    for (from, to) in &drawing.bars {
        let ends = [from, to].map(|name| frame.pixel(drawing.at(name).unwrap_or_default()));
        shapes.push(Shape::line(ends, 2.0));
        document = document.add(line(ends, "bar"));
    }
    for arrow in &drawing.arrows {
        let ends = [frame.pixel(drawing.at(&arrow.from).unwrap_or_default()), frame.pixel(drawing.tip(arrow))];
        shapes.push(Shape::line(ends, 1.5));
        document = document.add(vector(ends, arrow.quantity));
    }
    for place in &drawing.places {
        let at = frame.pixel(place.at);
        if place.mark == Mark::Ground {
            shapes.extend(foot(at));
        }
        document = document.add(mark(at, place.mark));
    }
    let places: Vec<Vector2<f64>> = drawing.places.iter().map(|place| frame.pixel(place.at)).collect();
    shapes.extend(places.iter().copied().map(Shape::joint));
    let names = drawing.places.iter().zip(&places).map(|(place, at)| Name { text: &place.name, at: vec![*at] });
    let names: Vec<Name> = names.collect();
    for (name, offset) in names.iter().zip(offsets(&names, &[shapes], |_| true)) {
        let at = name.at[0] + offset[0];
        document = document.add(text(name.text, "name", at + Vector2::new(0.0, 5.0), "middle"));
    }
    let mut x = LEFT;
    for (class, words) in legend {
        let y = bottom + 12.0;
        document = document
            .add(line([Vector2::new(x, y), Vector2::new(x + 26.0, y)], &format!("{class} vector")))
            .add(text(&words, "tick", Vector2::new(x + 34.0, y + 4.0), "start"));
        x += 200.0;
    }
    document.to_string()
}

fn legend(drawing: &Drawing) -> Vec<(&'static str, String)> {
    [
        (Quantity::Velocity, "velocity", drawing.velocity_scale),
        (Quantity::Acceleration, "acceleration", drawing.acceleration_scale),
    ]
    .into_iter()
    .filter(|(quantity, ..)| drawing.arrows.iter().any(|arrow| arrow.quantity == *quantity))
    .map(|(quantity, name, scale)| {
        let squared = if quantity == Quantity::Acceleration { "²" } else { "" };
        let unit = drawing.units.as_ref().map_or_else(String::new, |units| format!(" {}{squared}", units.time));
        (name, format!("{name} × {scale}{unit}"))
    })
    .collect()
}

fn describe(drawing: &Drawing) -> String {
    let names: Vec<&str> = drawing.places.iter().map(|place| place.name.as_str()).collect();
    format!("Linkage with the points {}", names.join(", "))
}

fn text(words: &str, class: &str, at: Vector2<f64>, anchor: &str) -> Text {
    Text::new(words).set("class", class).set("x", round(at.x)).set("y", round(at.y)).set("text-anchor", anchor)
}

fn round(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

fn line([from, to]: [Vector2<f64>; 2], class: &str) -> Line {
    Line::new()
        .set("class", class)
        .set("x1", round(from.x))
        .set("y1", round(from.y))
        .set("x2", round(to.x))
        .set("y2", round(to.y))
}

fn axes(frame: &Frame, units: Option<&Units>) -> Group {
    let bottom = TOP + frame.height();
    let mut group = Group::new();
    let unit = units.map_or("", |units| units.length.as_str());
    let across = ticks(frame.low.x, frame.high.x);
    for &value in &across {
        let label = label(value, frame.low.x, frame.high.x);
        // The last has the unit.
        let is_last = !unit.is_empty() && across.last() == Some(&value);
        let label = if is_last { format!("{label} {unit}") } else { label };
        let x = frame.pixel(Vector2::new(value, frame.low.y)).x;
        group = group.add(line([Vector2::new(x, TOP), Vector2::new(x, bottom)], "grid")).add(text(
            &label,
            "tick",
            Vector2::new(x, bottom + 17.0),
            "middle",
        ));
    }
    for value in ticks(frame.low.y, frame.high.y) {
        let label = label(value, frame.low.y, frame.high.y);
        let y = frame.pixel(Vector2::new(frame.low.x, value)).y;
        group = group.add(line([Vector2::new(LEFT, y), Vector2::new(LEFT + WIDTH, y)], "grid")).add(text(
            &label,
            "tick",
            Vector2::new(LEFT - 7.0, y + 4.0),
            "end",
        ));
    }
    if !unit.is_empty() {
        group = group.add(text(unit, "tick", Vector2::new(LEFT - 7.0, TOP - 8.0), "end"));
    }
    group.add(
        Rectangle::new()
            .set("class", "frame")
            .set("x", LEFT)
            .set("y", TOP)
            .set("width", WIDTH)
            .set("height", round(frame.height())),
    )
}

/// An arrow with shaft and head, or the shaft alone if it is too short.
fn vector(ends: [Vector2<f64>; 2], quantity: Quantity) -> Group {
    let class = match quantity {
        Quantity::Velocity => "velocity",
        Quantity::Acceleration => "acceleration",
    };
    let [from, to] = ends;
    let along = to - from;
    let mut group = Group::new().set("class", class).add(line(ends, "vector"));
    if along.norm() > HEAD {
        let (unit, across) = (along.normalize(), Vector2::new(-along.y, along.x).normalize());
        let (left, right) = (to - unit * HEAD + across * 4.0, to - unit * HEAD - across * 4.0);
        let corners = [to, left, right].map(|p| format!("{} {}", round(p.x), round(p.y)));
        group = group.add(Path::new().set("d", format!("M{}L{}L{}Z", corners[0], corners[1], corners[2])));
    }
    group
}

fn mark(at: Vector2<f64>, mark: Mark) -> Group {
    let circle =
        |radius: f64, class: &str| Circle::new().set("class", class).set("cx", at.x).set("cy", at.y).set("r", radius);
    match mark {
        Mark::Ground => Group::new()
            .add(Path::new().set("class", "ground").set("d", format!("M{} {}l-11 17h22Z", at.x, at.y)))
            .add(circle(5.0, "joint")),
        Mark::Joint => Group::new().add(circle(5.0, "joint")),
        Mark::Point => Group::new().add(circle(3.2, "point")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_have_units() {
        let mut drawing = Drawing::new("units");
        drawing.ground("A", [0.0, 0.0]).joint("B", [80.0, 60.0]).bar("A", "B").units("mm", "s");
        drawing
            .velocity_scale(0.02)
            .velocity("B", [0.0, 100.0])
            .acceleration_scale(0.001)
            .acceleration("B", [1e3, 0.0]);
        let svg = svg(&drawing);
        let texts: Vec<&str> = svg.split('>').map(|piece| piece.split('<').next().unwrap_or("").trim()).collect();
        for text in ["80 mm", "mm", "velocity × 0.02 s", "acceleration × 0.001 s²"] {
            assert_eq!(texts.iter().filter(|found| **found == text).count(), 1, "{text}: {texts:?}");
        }
        assert!(["40", "60"].iter().all(|tick| texts.contains(tick)), "only the last tick has the unit: {texts:?}");
    }

    #[test]
    fn vectors_are_drawn_to_scale() {
        let mut drawing = Drawing::new("scale");
        drawing.ground("A", [0.0, 0.0]).joint("B", [10.0, 0.0]).bar("A", "B");
        drawing.velocity_scale(0.02).velocity("B", [0.0, 100.0]);
        let svg = svg(&drawing);
        let read = |class: &str| -> Vec<f64> {
            let element = svg.split('<').find(|element| element.contains(&format!("class=\"{class}\""))).unwrap_or("");
            ["x1", "y1", "x2", "y2"]
                .map(|name| {
                    element
                        .split(&format!("{name}=\""))
                        .nth(1)
                        .and_then(|rest| rest.split('"').next()?.parse().ok())
                        .unwrap_or(f64::NAN)
                })
                .to_vec()
        };
        let (bar, arrow) = (read("bar"), read("vector"));
        let (ten, two) = (bar[2] - bar[0], arrow[1] - arrow[3]);
        assert!((two / ten - 0.2).abs() < 1e-3, "{ten} {two}");
    }
}
