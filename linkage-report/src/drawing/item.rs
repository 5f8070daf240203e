//! A shape and its name as SVG, at rest or moved by `animateTransform`.

use nalgebra::Vector2;
use svg::node::element::{AnimateTransform, Group, Text};

use super::film::Body;
use super::pen::short;

/// A shape and its motion.
pub(super) struct Item {
    pub body: Body,
    /// The shape around its origin, at the angle of the first frame.
    pub drawn: Group,
    /// The lengths of a spring, which is drawn along x; empty for other shapes.
    pub lengths: Vec<f64>,
    /// The name of a joint.
    pub name: Option<Label>,
}

/// A name next to its point.
pub(super) struct Label {
    pub text: String,
    /// Its places relative to the point, at equal steps of time.
    pub offsets: Vec<Vector2<f64>>,
}

impl Label {
    /// The name in one of this number of frames.
    fn still(&self, frame: usize, frames: usize) -> Text {
        let last = self.offsets.len() - 1;
        let place = &self.offsets[(frame * last + frames / 2) / (frames - 1).max(1)];
        Text::new(self.text.as_str()).set("x", short(place.x, 1)).set("y", short(place.y + 4.5, 1))
    }

    /// The name, which walks around its point in this number of seconds, or stays at its first place.
    fn text(&self, seconds: Option<f64>) -> Text {
        let first = self.offsets[0];
        let text = Text::new(self.text.as_str()).set("x", short(first.x, 1)).set("y", short(first.y + 4.5, 1));
        // Whole pixels, and only the moments between which it walks, keep the file small.
        let walk = |offset: &Vector2<f64>| format!("{} {}", short(offset.x - first.x, 0), short(offset.y - first.y, 0));
        let last = self.offsets.len() - 1;
        let is_kept = |&at: &usize| {
            at == 0
                || at == last
                || self.offsets[at - 1] != self.offsets[at]
                || self.offsets[at] != self.offsets[at + 1]
        };
        let kept: Vec<usize> = (0..=last).filter(is_kept).collect();
        let values = kept.iter().map(|&at| walk(&self.offsets[at])).collect();
        let times: Vec<String> = kept.iter().map(|&at| short(at as f64 / last as f64, 3)).collect();
        let walk = animate("translate", values, seconds).map(|walk| walk.set("keyTimes", times.join(";")));
        walk.into_iter().fold(text, Text::add)
    }
}

/// The animation through values at equal steps of time; none of a picture at rest or of values that do not change.
fn animate(kind: &str, values: Vec<String>, seconds: Option<f64>) -> Option<AnimateTransform> {
    let moves = values.iter().any(|value| *value != values[0]);
    seconds.filter(|_| moves).map(|seconds| {
        AnimateTransform::new()
            .set("attributeName", "transform")
            .set("type", kind)
            .set("dur", format!("{}s", short(seconds, 3)))
            .set("repeatCount", "indefinite")
            .set("values", values.join(";"))
    })
}

impl Item {
    /// The item in one frame, at rest.
    pub(super) fn still(&self, frame: usize) -> Group {
        let mut drawn = self.drawn.clone();
        if let Some(name) = &self.name {
            drawn = drawn.add(name.still(frame, self.body.places.len()));
        }
        let place = &self.body.places[frame];
        let turned = (self.body.angles[frame] - self.body.angles[0]).to_degrees();
        let mut moved = format!("translate({} {})rotate({})", short(place.x, 1), short(place.y, 1), short(turned, 2));
        if let Some((&now, &first)) = self.lengths.get(frame).zip(self.lengths.first()) {
            let along = self.body.angles[0].to_degrees();
            moved += &format!("rotate({})scale({} 1)", short(along, 2), short(now / first, 3));
        }
        drawn.set("transform", moved)
    }

    /// The item in its first position, or animated through all frames in this number of seconds.
    pub(super) fn group(&self, seconds: Option<f64>) -> Group {
        let first = self.body.places[0];
        let mut drawn = self.drawn.clone();
        if let Some(name) = &self.name {
            drawn = drawn.add(name.text(seconds));
        }
        let animate = |kind: &str, values: Vec<String>| animate(kind, values, seconds);
        if let Some(&length) = self.lengths.first() {
            let stretch = self.lengths.iter().map(|now| format!("{} 1", short(now / length, 3))).collect();
            drawn = animate("scale", stretch).into_iter().fold(drawn, Group::add);
            let along = format!("rotate({})", short(self.body.angles[0].to_degrees(), 2));
            drawn = Group::new().add(drawn).set("transform", along);
            drawn = Group::new().add(drawn);
        }
        let place = |at: &Vector2<f64>| format!("{} {}", short(at.x, 1), short(at.y, 1));
        let moves = animate("translate", self.body.places.iter().map(place).collect());
        let angle = |angle: &f64| short((angle - self.body.angles[0]).to_degrees(), 2);
        let turns = animate("rotate", self.body.angles.iter().map(angle).collect());
        // The rotation is applied after the translation, animated or not.
        let turns = turns.map(|turns| turns.set("additive", "sum"));
        let group = drawn.set("transform", format!("translate({})", place(&first)));
        moves.into_iter().chain(turns).fold(group, Group::add)
    }
}
