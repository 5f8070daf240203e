//! Writes the SVG of a drawing: the linkage in the style of an animation, axes, vectors and a legend.

use nalgebra::Vector2;
use svg::node::element::{Description, Group, Line, Path, Rectangle, Style, Text, Title};

use super::DrawingError;
use super::arrows::{Arrow, Quantity, Tail};
use super::axes::{label, ticks};
use super::frame::{Frame, LEFT, WIDTH, bounds};
use super::plain::plain;
use super::stage::{CLASS, STYLE, Shapes};
use super::still::{Drawing, Units};

const PLOT: &str = include_str!("plot.css");

/// The length of an arrow head, in pixels.
const HEAD: f64 = 10.0;

/// The width of a letter of a label, in pixels.
const LETTER: f64 = 5.5;

/// The letters of a line of the title, and the height of a line and of the space for all of them, in pixels.
const TITLE: usize = 54;
const TITLE_LINE: f64 = 18.0;
const TITLE_ROOM: f64 = 24.0;

/// The distance of the entries of the legend, in pixels, and the number in a line.
const ENTRY: [f64; 2] = [208.0, 20.0];
const ENTRIES: usize = 2;

impl Drawing {
    /// Writes the SVG.
    ///
    /// # Errors
    /// [`DrawingError`] if the drawing is empty, a name is unknown or used twice, a number is not finite, or `rename` or
    /// `without` found nothing.
    pub fn to_svg(&self) -> Result<String, DrawingError> {
        svg(self, STYLE.to_owned() + PLOT)
    }

    /// Writes the SVG, and says which place of it a point of the mechanism has: for programs that move a linkage by a pointer.
    ///
    /// # Errors
    /// As [`to_svg`](Self::to_svg).
    pub fn to_placed_svg(&self) -> Result<(String, Placement), DrawingError> {
        placed(self, STYLE.to_owned() + PLOT)
    }

    /// Writes the SVG with plain styles, without variables and always light, for programs that make other formats of it.
    ///
    /// # Errors
    /// As [`to_svg`](Self::to_svg).
    pub fn to_plain_svg(&self) -> Result<String, DrawingError> {
        svg(self, plain(&(STYLE.to_owned() + PLOT)))
    }
}

/// The place of the plane in a picture: a point (x, y) of the mechanism is at (origin.x + scale x, origin.y - scale y), in the
/// units of its `viewBox`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// The origin of the mechanism.
    pub origin: [f64; 2],
    /// The length of a unit of the mechanism.
    pub scale: f64,
}

/// The SVG of a drawing.
fn svg(drawing: &Drawing, style: String) -> Result<String, DrawingError> {
    placed(drawing, style).map(|(svg, _)| svg)
}

/// The SVG of a drawing, and its place.
fn placed(drawing: &Drawing, style: String) -> Result<(String, Placement), DrawingError> {
    let arrows = arrows(drawing)?;
    let ends: Vec<[Vector2<f64>; 2]> = arrows.iter().map(|(_, ends)| *ends).collect();
    let title = wrapped(&drawing.title, TITLE);
    let top = TITLE_ROOM + TITLE_LINE * title.len() as f64;
    let frame = |shown: &[Vector2<f64>]| {
        let all: Vec<Vector2<f64>> = shown.iter().copied().chain(ends.iter().flatten().copied()).collect();
        Frame::around(&all, top)
    };
    let Shapes { back, items, shown, view } = Shapes::of(&drawing.figure, |shown| frame(shown).view(), &ends)?;
    let frame = frame(&shown);
    let legend = legend(drawing);
    let bottom = top + frame.height() + 30.0;
    let height = bottom + ENTRY[1] * legend.len().div_ceil(ENTRIES) as f64 + 6.0;
    let page = drawing.figure.page([LEFT + WIDTH + 14.0, height.ceil()]);
    let mut document = page
        .set("class", CLASS)
        .set("role", "img")
        .set("text-anchor", "middle")
        .add(Title::new(drawing.title.as_str()))
        .add(Description::new().add(svg::node::Text::new(describe(drawing))))
        .add(Style::new(style))
        .add(Rectangle::new().set("class", "paper").set("width", "100%").set("height", "100%"));
    for (line, words) in title.iter().enumerate() {
        document = document.add(text(words, "title", Vector2::new(LEFT, 24.0 + TITLE_LINE * line as f64), "start"));
    }
    document = document.add(axes(&frame, drawing.units.as_ref())).add(back);
    for item in &items {
        document = document.add(item.group(None));
    }
    for (arrow, ends) in &arrows {
        let ends = ends.map(|end| view.pixel(end));
        document = document.add(labelled(vector(ends, arrow.quantity), &arrow.label, ends));
    }
    for (entry, (class, words)) in legend.iter().enumerate() {
        let (x, y) = (LEFT + ENTRY[0] * (entry % ENTRIES) as f64, bottom + ENTRY[1] * (entry / ENTRIES) as f64);
        let y = y + 8.0;
        document = document
            .add(line([Vector2::new(x, y), Vector2::new(x + 26.0, y)], &format!("{class} vector")))
            .add(text(words, "tick", Vector2::new(x + 34.0, y + 4.0), "start"));
    }
    let origin = view.pixel(Vector2::zeros());
    Ok((document.to_string(), Placement { origin: origin.into(), scale: view.pixels_per_unit }))
}

/// The words of a title in lines of at most this number of letters, where words allow it.
fn wrapped(title: &str, letters: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in title.split_whitespace() {
        match lines.last_mut().filter(|line| line.chars().count() + word.chars().count() < letters) {
            Some(line) => *line += &format!(" {word}"),
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

/// An arrow with its ends, in lengths of the mechanism.
type Placed<'a> = (&'a Arrow, [Vector2<f64>; 2]);

/// The arrows of a drawing to scale.
fn arrows(drawing: &Drawing) -> Result<Vec<Placed<'_>>, DrawingError> {
    let finite = |vector: &Vector2<f64>| vector.iter().all(|value| value.is_finite());
    let scales = Quantity::ALL.map(|quantity| scale(drawing, quantity));
    for (scale, quantity) in scales.iter().zip(Quantity::ALL) {
        if !(scale.is_finite() && *scale > 0.0) {
            return Err(DrawingError::NotFinite(format!("the {} scale", quantity.name())));
        }
    }
    let ends = |arrow: &'_ Arrow| {
        let (at, place) = match &arrow.from {
            Tail::Point(name) => {
                let at = drawing.at(name).ok_or_else(|| DrawingError::UnknownPoint(name.clone()))?;
                (at, format!("at `{name}`"))
            }
            Tail::At(at) => (*at, arrow.label.clone()),
        };
        let tip = at + arrow.vector * scales[arrow.quantity as usize];
        if finite(&tip) { Ok([at, tip]) } else { Err(DrawingError::NotFinite(format!("a vector {place}"))) }
    };
    drawing.arrows.iter().map(|arrow| Ok((arrow, ends(arrow)?))).collect()
}

/// The drawn length of a unit.
fn scale(drawing: &Drawing, of: Quantity) -> f64 {
    let places: Vec<Vector2<f64>> = drawing.figure.frames.iter().flatten().map(|(_, at)| *at).collect();
    drawing.scales[of as usize].factor(longest(drawing, of), bounds(&places).1.amax())
}

fn longest(drawing: &Drawing, of: Quantity) -> f64 {
    drawing.arrows.iter().filter(|arrow| arrow.quantity == of).map(|arrow| arrow.vector.norm()).fold(0.0, f64::max)
}

fn legend(drawing: &Drawing) -> Vec<(&'static str, String)> {
    let units = drawing.units.as_ref();
    let names = drawing.language.words().vectors_drawn;
    let shown = Quantity::ALL.into_iter().filter(|of| drawing.arrows.iter().any(|arrow| arrow.quantity == *of));
    let words = |of: Quantity| {
        let unit = match of {
            Quantity::Velocity => units.map(|units| units.time.clone()),
            Quantity::Acceleration => units.map(|units| units.time.clone() + "²"),
            Quantity::Force => {
                units.zip(drawing.force_unit.as_ref()).map(|(units, of)| format!("{}/{of}", units.length))
            }
        };
        let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
        (of.name(), format!("{} × {}{unit}", names[of as usize], scale(drawing, of)))
    };
    shown.map(words).collect()
}

/// An arrow with words beyond its tip.
fn labelled(arrow: Group, label: &str, [from, to]: [Vector2<f64>; 2]) -> Group {
    if label.is_empty() {
        return arrow;
    }
    let along = (to - from).try_normalize(0.0).unwrap_or_else(Vector2::y);
    let at = to + along.component_mul(&Vector2::new(6.0, 13.0)) + Vector2::new(0.0, 4.0);
    let width = LETTER * label.chars().count() as f64;
    let (anchor, at) = if along.x > 0.4 && at.x + width > LEFT + WIDTH {
        // Above the arrow, where there is room.
        ("end", Vector2::new(LEFT + WIDTH, at.y - 12.0))
    } else if along.x > 0.4 {
        ("start", at)
    } else if along.x < -0.4 {
        ("end", at)
    } else {
        ("middle", at)
    };
    arrow.add(text(label, "label", at, anchor))
}

fn describe(drawing: &Drawing) -> String {
    let names: Vec<&str> = drawing.figure.frames.iter().flatten().map(|(name, _)| name.as_str()).collect();
    format!("{} {}", drawing.language.words().points_drawn, names.join(", "))
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
    let (top, bottom, view) = (frame.top, frame.top + frame.height(), frame.view());
    let mut group = Group::new();
    let unit = units.map_or("", |units| units.length.as_str());
    let across = ticks(frame.low.x, frame.high.x);
    for &value in &across {
        let label = label(value, frame.low.x, frame.high.x);
        // The last has the unit.
        let is_last = !unit.is_empty() && across.last() == Some(&value);
        let label = if is_last { format!("{label} {unit}") } else { label };
        let x = view.pixel(Vector2::new(value, frame.low.y)).x;
        group = group.add(line([Vector2::new(x, top), Vector2::new(x, bottom)], "grid")).add(text(
            &label,
            "tick",
            Vector2::new(x, bottom + 17.0),
            "middle",
        ));
    }
    for value in ticks(frame.low.y, frame.high.y) {
        let label = label(value, frame.low.y, frame.high.y);
        let y = view.pixel(Vector2::new(frame.low.x, value)).y;
        group = group.add(line([Vector2::new(LEFT, y), Vector2::new(LEFT + WIDTH, y)], "grid")).add(text(
            &label,
            "tick",
            Vector2::new(LEFT - 7.0, y + 4.0),
            "end",
        ));
    }
    if !unit.is_empty() {
        group = group.add(text(unit, "tick", Vector2::new(LEFT - 7.0, top - 8.0), "end"));
    }
    group.add(
        Rectangle::new()
            .set("class", "frame")
            .set("x", LEFT)
            .set("y", top)
            .set("width", WIDTH)
            .set("height", round(frame.height())),
    )
}

/// An arrow with shaft and head, or the shaft alone if it is too short.
fn vector(ends: [Vector2<f64>; 2], quantity: Quantity) -> Group {
    let [from, to] = ends;
    let along = to - from;
    let mut group = Group::new().set("class", quantity.name()).add(line(ends, "vector"));
    if along.norm() > HEAD {
        let (unit, across) = (along.normalize(), Vector2::new(-along.y, along.x).normalize());
        let (left, right) = (to - unit * HEAD + across * 4.0, to - unit * HEAD - across * 4.0);
        let corners = [to, left, right].map(|p| format!("{} {}", round(p.x), round(p.y)));
        group = group
            .add(Path::new().set("class", "tip").set("d", format!("M{}L{}L{}Z", corners[0], corners[1], corners[2])));
    }
    group
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::Language;

    #[test]
    fn plain_styles_have_no_variables() {
        let style = plain(&(STYLE.to_owned() + PLOT));
        assert!(!style.contains("--") && !style.contains("var(") && !style.contains('@'), "{style}");
        assert!(style.contains(".linkage .paper{fill:#fff}") && style.contains(".linkage .velocity{color:#188038}"));
    }

    #[test]
    fn scales_have_units() {
        let mut drawing = Drawing::new("units");
        drawing.ground("A", [0.0, 0.0]).joint("B", [80.0, 60.0]).bar("A", "B").units("mm", "s");
        drawing
            .velocity_scale(0.02)
            .velocity("B", [0.0, 100.0])
            .acceleration_scale(0.001)
            .acceleration("B", [1e3, 0.0]);
        let svg = drawing.to_svg().unwrap_or_default();
        let texts: Vec<&str> = svg.split('>').map(|piece| piece.split('<').next().unwrap_or("").trim()).collect();
        for text in ["80 mm", "mm", "velocity × 0.02 s", "acceleration × 0.001 s²"] {
            assert_eq!(texts.iter().filter(|found| **found == text).count(), 1, "{text}: {texts:?}");
        }
        let italian = drawing.language(Language::Italian).to_svg().unwrap_or_default();
        assert!(
            ["velocità × 0.02 s", "accelerazione × 0.001 s²"].iter().all(|text| italian.contains(text)),
            "{italian}"
        );
        assert!(["40", "60"].iter().all(|tick| texts.contains(tick)), "only the last tick has the unit: {texts:?}");
    }

    #[test]
    fn vectors_are_drawn_to_scale() {
        let mut drawing = Drawing::new("scale");
        drawing.ground("A", [0.0, 0.0]).joint("B", [10.0, 0.0]).bar("A", "B");
        drawing.velocity_scale(0.02).velocity("B", [0.0, 100.0]);
        let svg = drawing.to_svg().unwrap_or_default();
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
        let joints: Vec<f64> =
            svg.split("translate(").skip(1).filter_map(|rest| rest.split(' ').next()?.parse().ok()).collect();
        let reach = |pick: fn(f64, f64) -> f64| joints.iter().copied().reduce(pick).unwrap_or(f64::NAN);
        let arrow = read("vector");
        let (ten, two) = (reach(f64::max) - reach(f64::min), arrow[1] - arrow[3]);
        assert!((two / ten - 0.2).abs() < 1e-3, "{ten} {two}");
    }
}
