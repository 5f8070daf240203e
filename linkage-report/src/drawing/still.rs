//! A linkage at one position, with axes and with vectors to scale.

use linkage_runtime::skeleton::Skeleton;
use linkage_runtime::{Joint, JointForces, Kinematic, PointMotion};
use nalgebra::{Point2, Vector2};

use super::Animation;
use super::arrows::{Arrow, Quantity, Scale, Tail};
use super::figure::Figure;
use super::part::Part;
use crate::sheet::Language;

/// A builder for a drawing. Lengths are those of the mechanism; y points up.
///
/// ```
/// use linkage_report::drawing::{Drawing, DrawingError};
///
/// let mut drawing = Drawing::new("A lever and its load");
/// drawing.ground("O", [0.0, 0.0]).joint("A", [3.0, 0.0]).joint("B", [3.0, 1.0]).link(&["O", "A", "B"]);
/// drawing.force("A", [0.0, -200.0]).rename("B", "Handle");
/// assert!(drawing.to_svg()?.contains("force × 0.005"));
/// // No part connects these two alone.
/// drawing.without(&["O", "A"]);
/// assert!(matches!(drawing.to_svg(), Err(DrawingError::NoPart(_))));
/// # Ok::<(), DrawingError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Drawing {
    pub(super) title: String,
    pub(super) figure: Figure,
    pub(super) arrows: Vec<Arrow>,
    /// The scale of each kind of vector, in the order of [`Quantity::ALL`].
    pub(super) scales: [Scale; 3],
    pub(super) units: Option<Units>,
    pub(super) force_unit: Option<String>,
    pub(super) language: Language,
}

#[derive(Debug, Clone)]
pub(super) struct Units {
    pub length: String,
    pub time: String,
}

/// The motion of the points of a mechanism.
type MotionOfPoints<M> = <M as Kinematic>::Points<PointMotion<f64>>;

/// The link at rest, in the names of forces.
const GROUND: &str = "ground";

/// True if the sum of two forces is no more than a rounding error of the larger one.
fn is_opposite(one: Vector2<f64>, other: Vector2<f64>) -> bool {
    (one + other).norm() <= 1e-9 * one.norm().max(other.norm())
}

impl Drawing {
    /// Creates an empty drawing. By default a unit velocity or acceleration is drawn with the length 1.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            figure: Figure { frames: vec![Vec::new()], ..Figure::default() },
            arrows: Vec::new(),
            scales: [Scale::Default; 3],
            units: None,
            force_unit: None,
            language: Language::default(),
        }
    }

    /// Sets the width of the picture in pixels; its height follows. Without it the picture fills the place that it has.
    pub fn width(&mut self, pixels: u32) -> &mut Self {
        self.figure.width = Some(pixels);
        self
    }

    fn place(&mut self, name: &str, at: impl Into<Point2<f64>>, parts: impl IntoIterator<Item = fn(String) -> Part>) {
        self.figure.frames[0].push((name.to_owned(), at.into().coords));
        self.figure.parts.extend(parts.into_iter().map(|part| part(name.to_owned())));
    }

    /// Adds a pivot on the ground.
    pub fn ground(&mut self, name: &str, at: impl Into<Point2<f64>>) -> &mut Self {
        self.place(name, at, [Part::Ground as fn(String) -> Part, Part::Joint]);
        self
    }

    /// Adds a moving joint.
    pub fn joint(&mut self, name: &str, at: impl Into<Point2<f64>>) -> &mut Self {
        self.place(name, at, [Part::Joint as fn(String) -> Part]);
        self
    }

    /// Adds a point that is not a joint, such as a centre of mass.
    pub fn point(&mut self, name: &str, at: impl Into<Point2<f64>>) -> &mut Self {
        self.place(name, at, [Part::Point as fn(String) -> Part]);
        self
    }

    /// Adds a straight bar between two points, given by name.
    pub fn bar(&mut self, from: &str, to: &str) -> &mut Self {
        self.link(&[from, to])
    }

    /// Adds a rigid link through points, given by name: a bar through two, a plate through more.
    pub fn link(&mut self, points: &[&str]) -> &mut Self {
        self.figure.link(points, false);
        self
    }

    /// Adds the driving link, in its own colour.
    pub fn crank(&mut self, points: &[&str]) -> &mut Self {
        self.figure.link(points, true);
        self
    }

    /// Adds a sliding block at a point, on a straight guide of this direction.
    pub fn slider(&mut self, point: &str, along: impl Into<Vector2<f64>>) -> &mut Self {
        self.figure.part(Part::Slider { point: point.to_owned(), along: Some(along.into()) });
        self
    }

    /// Adds a block at a pin that slides on an arm with the direction from one point to another.
    pub fn sleeve(&mut self, pin: &str, arm: [&str; 2]) -> &mut Self {
        self.figure.sleeve(pin, arm);
        self
    }

    /// Adds a spring between two points.
    pub fn spring(&mut self, from: &str, to: &str) -> &mut Self {
        self.figure.part(Part::Spring([from, to].map(str::to_owned)));
        self
    }

    /// Adds the path of a point, such as a coupler curve.
    pub fn path(&mut self, points: impl IntoIterator<Item = impl Into<Point2<f64>>>) -> &mut Self {
        self.figure.part(Part::Path(points.into_iter().map(|point| point.into().coords).collect()));
        self
    }

    /// Adds the paths that points leave in an animation, such as one over a turn: those of [`Animation::paths`].
    pub fn paths(&mut self, film: &Animation) -> &mut Self {
        for part in &film.figure.parts {
            if let Part::Trace(point) = part {
                let places = film.figure.frames.iter().flatten().filter(|(name, _)| name == point);
                self.figure.part(Part::Path(places.map(|(_, at)| *at).collect()));
            }
        }
        self
    }

    /// Gives the picture room for all frames of an animation, so that the pictures of a motion have one scale and one frame.
    pub fn room(&mut self, film: &Animation) -> &mut Self {
        let places = film.figure.frames.iter().flatten().map(|(_, at)| *at);
        self.figure.part(Part::Room(places.collect()));
        self
    }

    /// Removes the parts that connect exactly these points: to draw another one there.
    /// [`DrawingError::NoPart`](super::DrawingError::NoPart) if there is none.
    pub fn without(&mut self, points: &[&str]) -> &mut Self {
        self.figure.without(points);
        self
    }

    /// Gives a joint or point another name, which it has from here on.
    /// [`DrawingError::UnknownJoint`](super::DrawingError::UnknownJoint) if none has the first name.
    pub fn rename(&mut self, from: &str, to: &str) -> &mut Self {
        self.figure.rename(from, to);
        for arrow in &mut self.arrows {
            if let Tail::Point(point) = &mut arrow.from
                && point == from
            {
                to.clone_into(point);
            }
        }
        self
    }

    /// Names the units of length and time, such as mm and s. The axes show the first; the scale of velocities is a time, that
    /// of accelerations its square.
    pub fn units(&mut self, length: impl Into<String>, time: impl Into<String>) -> &mut Self {
        self.units = Some(Units { length: length.into(), time: time.into() });
        self
    }

    /// Sets the language of the legend and of the description; English by default.
    pub fn language(&mut self, language: Language) -> &mut Self {
        self.language = language;
        self
    }

    /// Sets the drawn length of a unit velocity.
    pub fn velocity_scale(&mut self, scale: f64) -> &mut Self {
        self.scale(Quantity::Velocity, Scale::Given(scale))
    }

    /// Sets the drawn length of a unit acceleration.
    pub fn acceleration_scale(&mut self, scale: f64) -> &mut Self {
        self.scale(Quantity::Acceleration, Scale::Given(scale))
    }

    fn scale(&mut self, of: Quantity, scale: Scale) -> &mut Self {
        self.scales[of as usize] = scale;
        self
    }

    /// Adds the velocity of a point, given by name.
    pub fn velocity(&mut self, of: &str, vector: impl Into<Vector2<f64>>) -> &mut Self {
        self.arrow(of, vector.into(), Quantity::Velocity)
    }

    /// Adds the acceleration of a point, given by name.
    pub fn acceleration(&mut self, of: &str, vector: impl Into<Vector2<f64>>) -> &mut Self {
        self.arrow(of, vector.into(), Quantity::Acceleration)
    }

    /// Adds the velocities of all points that move, from the motion of a mechanism: `drawing.velocities(&m, &motion.points)`.
    /// The longest arrow is about a quarter of the linkage, unless the scale is set.
    pub fn velocities<M: Kinematic<Scalar = f64>>(&mut self, mechanism: &M, points: &MotionOfPoints<M>) -> &mut Self {
        self.of_points(mechanism, points, Quantity::Velocity, |point| point.velocity)
    }

    /// Adds the accelerations of all points that have one, from the motion of a mechanism, as
    /// [`velocities`](Self::velocities) does.
    pub fn accelerations<M: Kinematic<Scalar = f64>>(
        &mut self,
        mechanism: &M,
        points: &MotionOfPoints<M>,
    ) -> &mut Self {
        self.of_points(mechanism, points, Quantity::Acceleration, |point| point.acceleration)
    }

    fn of_points<M: Kinematic<Scalar = f64>>(
        &mut self,
        mechanism: &M,
        points: &MotionOfPoints<M>,
        quantity: Quantity,
        vector: fn(&PointMotion<f64>) -> Vector2<f64>,
    ) -> &mut Self {
        self.fit(quantity);
        for (place, motion) in M::each_point(*points).iter().enumerate() {
            let (name, vector) = (self.figure.current(mechanism.point_name(place).as_ref()), vector(motion));
            if vector == Vector2::zeros() {
                continue;
            }
            if self.at(&name).is_none() {
                self.point(&name, motion.position);
            }
            self.arrow(&name, vector, quantity);
        }
        self
    }

    /// Sets the drawn length of a unit force.
    pub fn force_scale(&mut self, scale: f64) -> &mut Self {
        self.scale(Quantity::Force, Scale::Given(scale))
    }

    /// Names the unit of forces, such as N.
    pub fn force_unit(&mut self, unit: impl Into<String>) -> &mut Self {
        self.force_unit = Some(unit.into());
        self
    }

    /// Adds a force at a point, given by name. The longest arrow is about a quarter of the linkage, unless the scale is set.
    pub fn force(&mut self, at: &str, vector: impl Into<Vector2<f64>>) -> &mut Self {
        self.fit(Quantity::Force);
        self.arrow(at, vector.into(), Quantity::Force)
    }

    /// Adds the forces in the joints of a scene at a pose, as its `reactions` or the `joints` of its loads have them, each with
    /// the link on which it acts. Of two forces in a joint that are opposite, one is drawn, and that on the ground is not.
    /// The longest arrow is about a quarter of the linkage, unless the scale is set.
    pub fn forces<M, F>(&mut self, mechanism: &M, pose: &M::Pose, forces: &F) -> &mut Self
    where
        M: Skeleton<Scalar = f64>,
        F: JointForces<f64, M::Name, Mechanism = M>,
    {
        self.fit(Quantity::Force);
        let all = forces.joints().zip(forces.each()).filter_map(|(joint, [first, second])| {
            // The second number of a guide is a moment.
            let (on, place, second) = match joint {
                Joint::Pin { on, place, .. } => (on, place, second),
                Joint::Guide { on, place, .. } => (on, place, 0.0),
            };
            let [x, y, along_x, along_y] = mechanism.force_place(pose, place)?;
            let along = Vector2::new(along_x, along_y);
            Some((on, Vector2::new(x, y), along * first + Vector2::new(-along.y, along.x) * second))
        });
        let all: Vec<(M::Name, Vector2<f64>, Vector2<f64>)> = all.collect();
        for (index, &(ref link, at, vector)) in all.iter().enumerate() {
            let link = link.as_ref();
            let here: Vec<usize> = (0..all.len()).filter(|&other| all[other].1 == at).collect();
            let is_shown = match here[..] {
                [one, other] if is_opposite(all[one].2, all[other].2) => {
                    let on_ground = if all[one].0.as_ref() == GROUND { one } else { other };
                    index != on_ground
                }
                _ => true,
            };
            if is_shown && vector != Vector2::zeros() {
                self.force_on(link, at, vector);
            }
        }
        self
    }

    /// Adds a force on a link, or the link to an arrow that is there.
    fn force_on(&mut self, link: &str, at: Vector2<f64>, vector: Vector2<f64>) {
        let is_same = |arrow: &&mut Arrow| {
            matches!(arrow.from, Tail::At(tail) if tail == at)
                && arrow.quantity == Quantity::Force
                && is_opposite(arrow.vector, -vector)
        };
        match self.arrows.iter_mut().find(is_same) {
            Some(arrow) => arrow.label += &format!(", {link}"),
            None => {
                let label = format!("on {link}");
                self.arrows.push(Arrow { from: Tail::At(at), vector, quantity: Quantity::Force, label });
            }
        }
    }

    /// Fits the scale of a kind of vectors, unless it is set.
    fn fit(&mut self, quantity: Quantity) {
        if self.scales[quantity as usize] == Scale::Default {
            self.scale(quantity, Scale::Fitted);
        }
    }

    fn arrow(&mut self, of: &str, vector: Vector2<f64>, quantity: Quantity) -> &mut Self {
        self.arrows.push(Arrow { from: Tail::Point(of.to_owned()), vector, quantity, label: String::new() });
        self
    }

    pub(super) fn at(&self, name: &str) -> Option<Vector2<f64>> {
        self.figure.frames[0].iter().find(|(other, _)| other == name).map(|(_, at)| *at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::DrawingError;

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
