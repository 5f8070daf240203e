//! The animation as SVG: bodies are moved by `animateTransform`; readers who prefer reduced motion see a still copy
//! instead.

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{Description, Group, Rectangle, Style, Title};

use super::DrawingError;
use super::animation::Animation;
use super::frame::View;
use super::part::Part;
use super::plain::plain;
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
        self.check()?;
        svg(self)
    }

    /// Writes an SVG for each frame, at rest and with plain styles, for programs that make films in other formats. The first
    /// and the last frame of a smooth loop are the same picture.
    ///
    /// # Errors
    /// As [`to_svg`](Self::to_svg).
    pub fn frames_to_svg(&self) -> Result<impl ExactSizeIterator<Item = String>, DrawingError> {
        self.check()?;
        let Shapes { back, items, .. } = shapes(self)?;
        let empty = page(self, plain(STYLE)).add(back);
        let frame = move |frame| items.iter().fold(empty.clone(), |page, item| page.add(item.still(frame))).to_string();
        Ok((0..self.figure.frames.len()).map(frame))
    }

    fn check(&self) -> Result<(), DrawingError> {
        match self.seconds.is_finite() && self.seconds > 0.0 {
            true => Ok(()),
            false => Err(DrawingError::NotFinite("the duration of an animation".to_owned())),
        }
    }
}

fn shapes(animation: &Animation) -> Result<Shapes, DrawingError> {
    Shapes::of(&animation.figure, |shown| View::within(shown, SIZE, MARGIN), &[])
}

/// An empty picture.
fn page(animation: &Animation, style: impl Into<String>) -> Document {
    let page = animation.figure.page(SIZE.into());
    page.set("class", CLASS)
        .set("role", "img")
        .set("text-anchor", "middle")
        .add(Title::new(animation.title.as_str()))
        .add(Description::new().add(svg::node::Text::new(describe(animation))))
        .add(Style::new(style))
        .add(Rectangle::new().set("class", "paper").set("width", "100%").set("height", "100%"))
}

fn svg(animation: &Animation) -> Result<String, DrawingError> {
    let Shapes { back, items, .. } = shapes(animation)?;
    let (mut moving, mut still) = (Group::new().set("class", "moving"), Group::new().set("class", "still"));
    for item in &items {
        moving = moving.add(item.group(Some(animation.seconds)));
        still = still.add(item.group(None));
    }
    Ok(page(animation, STYLE).add(back).add(moving).add(still).to_string())
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A crank and a spring at quarters of a turn.
    fn film() -> Animation {
        let mut film = Animation::new("A crank and a spring", 1.0);
        for step in 0..=4 {
            let [x, y] = [[3.0, 0.0], [0.0, 3.0], [-3.0, 0.0], [0.0, -3.0], [3.0, 0.0]][step];
            film.frame([("A", [0.0, 0.0]), ("B", [x, y]), ("C", [6.0, 0.0])]);
        }
        film.ground("A").ground("C").crank(&["A", "B"]).spring("C", "B");
        film
    }

    /// The transforms of the parts in a picture.
    fn transforms(svg: &str) -> Vec<&str> {
        svg.split("transform=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect()
    }

    #[test]
    fn frames_are_at_rest_and_close_the_loop() {
        let frames: Vec<String> = film().frames_to_svg().unwrap().collect();
        assert_eq!(frames.len(), 5);
        assert_eq!(frames[0].replacen("rotate(0)", "rotate(-360)", 1), frames[4]);
        for (frame, turned) in frames.iter().zip([0, -90, -180, -270, -360]) {
            assert!(!frame.contains("animate") && !frame.contains("var(") && frame.contains("</svg>"));
            // The crank comes first; on the screen y points down.
            assert!(transforms(frame)[0].ends_with(&format!("rotate({turned})")), "{:?}", transforms(frame));
        }
        // The spring is drawn along x from C to B, 3 long in the first frame and 9 in the middle.
        let stretch = |frame: usize| {
            transforms(&frames[frame]).iter().find_map(|of| of.split("scale(").nth(1)).map(str::to_owned)
        };
        assert_eq!([stretch(0), stretch(2)], [Some("1 1)".to_owned()), Some("3 1)".to_owned())]);
        assert!(Animation::new("empty", 1.0).frames_to_svg().is_err());
        assert!(film().seconds(0.0).frames_to_svg().is_err());
    }
}
