//! Linkages as SVG: a [`Drawing`] of one position, with named points, joints, bars, velocity and acceleration
//! vectors to scale, axes and a legend; an [`Animation`] of a whole motion, with coupler curves; a [`CircuitChart`] of the
//! circuits of a mechanism.
//!
//! ```
//! use linkage_report::drawing::Drawing;
//!
//! let mut drawing = Drawing::new("One bar");
//! drawing.ground("A", [0.0, 0.0]).joint("B", [3.0, 4.0]).bar("A", "B");
//! drawing.velocity_scale(0.5).velocity("B", [-4.0, 3.0]);
//! let svg = drawing.to_svg()?;
//! assert!(svg.starts_with("<svg"));
//! # Ok::<(), linkage_report::drawing::DrawingError>(())
//! ```

mod animation;
mod axes;
mod circuits;
mod film;
mod frame;
mod mechanism;
mod names;
mod obstacles;
mod pen;
mod render;
mod shapes;
mod smil;

use std::fmt;

use nalgebra::{Point2, Vector2};

pub use animation::Animation;
pub use circuits::CircuitChart;

/// The symbol at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mark {
    Ground,
    Joint,
    Point,
}

/// The kind of a vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Velocity,
    Acceleration,
}

#[derive(Debug, Clone)]
struct Place {
    name: String,
    at: Vector2<f64>,
    mark: Mark,
}

#[derive(Debug, Clone)]
struct Arrow {
    from: String,
    vector: Vector2<f64>,
    quantity: Quantity,
}

/// A builder for a drawing. Lengths are those of the mechanism; y points up.
#[derive(Debug, Clone)]
pub struct Drawing {
    title: String,
    places: Vec<Place>,
    bars: Vec<(String, String)>,
    paths: Vec<Vec<Vector2<f64>>>,
    arrows: Vec<Arrow>,
    velocity_scale: f64,
    acceleration_scale: f64,
    units: Option<Units>,
}

#[derive(Debug, Clone)]
struct Units {
    length: String,
    time: String,
}

/// The error of a drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DrawingError {
    /// The drawing is empty.
    Empty,
    /// A bar or a vector refers to an unknown point.
    UnknownPoint(String),
    /// The mechanism has no such unknown.
    UnknownCoordinate(String),
    /// Two points have the same name.
    DuplicatePoint(String),
    /// A number is infinite or NaN, or a scale, a radius or a duration is not positive.
    NotFinite(String),
    /// This frame, counted from 0, has different points than the first.
    OtherPoints(usize),
    /// A link changes its shape.
    NotRigid(String),
    /// A ground pivot moves.
    Moves(String),
    /// The point of a slider rests, or leaves its straight line.
    NotStraight(String),
    /// The mechanism has no position at an input.
    NoPosition(String),
}

impl fmt::Display for DrawingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("the drawing is empty: add points"),
            Self::UnknownPoint(name) => write!(f, "the drawing has no point `{name}`: add it first"),
            Self::UnknownCoordinate(name) => {
                write!(f, "the mechanism has no unknown `{name}`: name one of its unknowns")
            }
            Self::DuplicatePoint(name) => write!(f, "the drawing has two points `{name}`: rename one"),
            Self::NotFinite(what) => {
                write!(f, "{what} must be finite, and positive if it is a scale, a radius or a duration")
            }
            Self::OtherPoints(frame) => {
                write!(f, "frame {frame} has different points than frame 0: give every frame the same names")
            }
            Self::NotRigid(link) => write!(f, "the link `{link}` changes its shape between frames"),
            Self::Moves(point) => write!(f, "the ground pivot `{point}` moves between frames"),
            Self::NoPosition(why) => f.write_str(why),
            Self::NotStraight(point) => write!(f, "the slider `{point}` does not move along a straight line"),
        }
    }
}

impl std::error::Error for DrawingError {}

impl Drawing {
    /// Creates an empty drawing. By default a unit velocity or acceleration is drawn with the length 1.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            places: Vec::new(),
            bars: Vec::new(),
            paths: Vec::new(),
            arrows: Vec::new(),
            velocity_scale: 1.0,
            acceleration_scale: 1.0,
            units: None,
        }
    }

    fn place(&mut self, name: &str, at: Vector2<f64>, mark: Mark) -> &mut Self {
        self.places.push(Place { name: name.to_owned(), at, mark });
        self
    }

    /// Adds a pivot on the ground.
    pub fn ground(&mut self, name: &str, at: impl Into<Point2<f64>>) -> &mut Self {
        self.place(name, at.into().coords, Mark::Ground)
    }

    /// Adds a moving joint.
    pub fn joint(&mut self, name: &str, at: impl Into<Point2<f64>>) -> &mut Self {
        self.place(name, at.into().coords, Mark::Joint)
    }

    /// Adds a point that is not a joint, such as a centre of mass.
    pub fn point(&mut self, name: &str, at: impl Into<Point2<f64>>) -> &mut Self {
        self.place(name, at.into().coords, Mark::Point)
    }

    /// Adds a straight bar between two points, given by name.
    pub fn bar(&mut self, from: &str, to: &str) -> &mut Self {
        self.bars.push((from.to_owned(), to.to_owned()));
        self
    }

    /// Adds the path of a point, such as a coupler curve.
    pub fn path(&mut self, points: impl IntoIterator<Item = impl Into<Point2<f64>>>) -> &mut Self {
        self.paths.push(points.into_iter().map(|point| point.into().coords).collect());
        self
    }

    /// Names the units of length and time, such as mm and s. The axes show the first; the scale of velocities is a time, that
    /// of accelerations its square.
    pub fn units(&mut self, length: impl Into<String>, time: impl Into<String>) -> &mut Self {
        self.units = Some(Units { length: length.into(), time: time.into() });
        self
    }

    /// Sets the drawn length of a unit velocity.
    pub fn velocity_scale(&mut self, scale: f64) -> &mut Self {
        self.velocity_scale = scale;
        self
    }

    /// Sets the drawn length of a unit acceleration.
    pub fn acceleration_scale(&mut self, scale: f64) -> &mut Self {
        self.acceleration_scale = scale;
        self
    }

    /// Adds the velocity of a point, given by name.
    pub fn velocity(&mut self, of: &str, vector: impl Into<Vector2<f64>>) -> &mut Self {
        self.arrows.push(Arrow { from: of.to_owned(), vector: vector.into(), quantity: Quantity::Velocity });
        self
    }

    /// Adds the acceleration of a point, given by name.
    pub fn acceleration(&mut self, of: &str, vector: impl Into<Vector2<f64>>) -> &mut Self {
        self.arrows.push(Arrow { from: of.to_owned(), vector: vector.into(), quantity: Quantity::Acceleration });
        self
    }

    /// Writes the SVG.
    ///
    /// # Errors
    /// [`DrawingError`] if the drawing is empty, a name is unknown or used twice, or a number is not
    /// finite.
    pub fn to_svg(&self) -> Result<String, DrawingError> {
        self.check()?;
        Ok(render::svg(self))
    }

    fn check(&self) -> Result<(), DrawingError> {
        if self.places.is_empty() && self.paths.iter().all(Vec::is_empty) {
            return Err(DrawingError::Empty);
        }
        for (scale, what) in [(self.velocity_scale, "velocity"), (self.acceleration_scale, "acceleration")] {
            if !(scale.is_finite() && scale > 0.0) {
                return Err(DrawingError::NotFinite(format!("the {what} scale")));
            }
        }
        let finite = |vector: &Vector2<f64>| vector.iter().all(|value| value.is_finite());
        for (index, place) in self.places.iter().enumerate() {
            if self.places[..index].iter().any(|other| other.name == place.name) {
                return Err(DrawingError::DuplicatePoint(place.name.clone()));
            }
            if !finite(&place.at) {
                return Err(DrawingError::NotFinite(format!("the point `{}`", place.name)));
            }
        }
        if !self.paths.iter().flatten().all(finite) {
            return Err(DrawingError::NotFinite("a path".to_owned()));
        }
        for name in
            self.bars.iter().flat_map(|(from, to)| [from, to]).chain(self.arrows.iter().map(|arrow| &arrow.from))
        {
            if self.at(name).is_none() {
                return Err(DrawingError::UnknownPoint(name.clone()));
            }
        }
        for arrow in &self.arrows {
            if !finite(&self.tip(arrow)) {
                return Err(DrawingError::NotFinite(format!("a vector at `{}`", arrow.from)));
            }
        }
        Ok(())
    }

    fn at(&self, name: &str) -> Option<Vector2<f64>> {
        self.places.iter().find(|place| place.name == name).map(|place| place.at)
    }

    /// The end of an arrow.
    fn tip(&self, arrow: &Arrow) -> Vector2<f64> {
        let scale = match arrow.quantity {
            Quantity::Velocity => self.velocity_scale,
            Quantity::Acceleration => self.acceleration_scale,
        };
        self.at(&arrow.from).unwrap_or_default() + arrow.vector * scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar() -> Drawing {
        let mut drawing = Drawing::new("a < b & c");
        drawing.ground("A", [0.0, 0.0]).joint("B", [3.0, 4.0]).bar("A", "B");
        drawing
    }

    #[test]
    fn mistakes_are_named() {
        assert_eq!(Drawing::new("nothing").to_svg(), Err(DrawingError::Empty));
        assert_eq!(bar().bar("A", "C").to_svg(), Err(DrawingError::UnknownPoint("C".to_owned())));
        assert_eq!(bar().joint("A", [1.0, 1.0]).to_svg(), Err(DrawingError::DuplicatePoint("A".to_owned())));
        assert!(matches!(bar().joint("N", [f64::NAN, 1.0]).to_svg(), Err(DrawingError::NotFinite(_))));
        assert!(matches!(bar().velocity_scale(0.0).to_svg(), Err(DrawingError::NotFinite(_))));
    }

    #[test]
    fn text_is_escaped_and_output_repeatable() {
        let svg = bar().to_svg().unwrap_or_default();
        assert!(svg.contains("a &lt; b &amp; c") && !svg.contains("a < b"));
        assert_eq!(bar().to_svg(), Ok(svg));
    }

    #[test]
    fn degenerate_and_extreme_drawings_have_a_picture() {
        for scale in [1e-12, 1.0, 1e12] {
            let mut drawing = Drawing::new("one point");
            drawing.ground("A", [scale, scale]);
            let svg = drawing.to_svg().unwrap_or_default();
            assert!(svg.contains("</svg>") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }
}
