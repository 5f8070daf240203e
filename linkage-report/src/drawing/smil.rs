//! The animation as SVG: bodies are moved by `animateTransform`; readers who prefer reduced motion see a still copy
//! instead.

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{Description, Group, Rectangle, Style, Title};

use super::DrawingError;
use super::animation::Animation;
use super::frame::View;
use super::part::Part;
use super::stage::{CLASS, STYLE, Shapes};

/// The size of the picture and its margin, in pixels.
const SIZE: Vector2<f64> = Vector2::new(480.0, 360.0);
const MARGIN: f64 = 40.0;

impl Animation {
    /// Writes the SVG.
    ///
    /// # Errors
    /// [`DrawingError`] if there is nothing to draw, a name is unknown or used twice, a number is not finite, or the
    /// parts contradict the frames: a link changes its shape, a ground pivot moves, a slider leaves its straight line; or if
    /// `rename`, `paths` or `without` found nothing.
    pub fn to_svg(&self) -> Result<String, DrawingError> {
        if !(self.seconds.is_finite() && self.seconds > 0.0) {
            return Err(DrawingError::NotFinite("the duration of an animation".to_owned()));
        }
        svg(self)
    }
}

fn svg(animation: &Animation) -> Result<String, DrawingError> {
    let Shapes { back, items, .. } = Shapes::of(&animation.figure, |shown| View::within(shown, SIZE, MARGIN), &[])?;
    let (mut moving, mut still) = (Group::new().set("class", "moving"), Group::new().set("class", "still"));
    for item in &items {
        moving = moving.add(item.group(Some(animation.seconds)));
        still = still.add(item.group(None));
    }
    let document = Document::new()
        .set("class", CLASS)
        .set("viewBox", (0, 0, SIZE.x, SIZE.y))
        .set("role", "img")
        .set("text-anchor", "middle")
        .add(Title::new(animation.title.as_str()))
        .add(Description::new().add(svg::node::Text::new(describe(animation))))
        .add(Style::new(STYLE))
        .add(Rectangle::new().set("class", "paper").set("width", "100%").set("height", "100%"))
        .add(back)
        .add(moving)
        .add(still);
    Ok(document.to_string())
}

fn describe(animation: &Animation) -> String {
    let traces = animation.figure.parts.iter().filter_map(|part| match part {
        Part::Trace(point) => Some(point.as_str()),
        _ => None,
    });
    let traces: Vec<&str> = traces.collect();
    if traces.is_empty() {
        "A linkage in motion".to_owned()
    } else {
        format!("A linkage in motion, with the path of {}", traces.join(" and of "))
    }
}
