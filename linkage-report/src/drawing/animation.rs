//! An animated linkage: links, pivots and sliders in one SVG, animated without a script.

use nalgebra::{Point2, Vector2};

use super::figure::{Figure, owned};
use super::part::Part;

/// A builder for an animation: frames of named points, and the parts that connect them. Lengths are those of the
/// mechanism; y points up.
///
/// The first frame is the still picture, for print and for readers who prefer reduced motion.
///
/// ```
/// use linkage_report::drawing::Animation;
///
/// let mut picture = Animation::new("A crank", 4.0);
/// for step in 0..=90_u32 {
///     let angle = f64::from(step * 4).to_radians();
///     picture.frame([("A", [0.0, 0.0]), ("B", [angle.cos(), angle.sin()])]);
/// }
/// picture.ground("A").crank(&["A", "B"]).trace("B");
/// assert!(picture.to_svg()?.starts_with("<svg"));
/// # Ok::<(), linkage_report::drawing::DrawingError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Animation {
    pub(super) title: String,
    pub(super) seconds: f64,
    pub(super) figure: Figure,
}

impl Animation {
    /// Creates an empty animation that repeats its frames after this number of seconds.
    pub fn new(title: impl Into<String>, seconds: f64) -> Self {
        Self { title: title.into(), seconds, figure: Figure::default() }
    }

    fn part(&mut self, part: Part) -> &mut Self {
        self.figure.part(part);
        self
    }

    /// Adds a frame: the positions of the points, with the same names in each frame. Frames are equally spaced in time;
    /// between two of them no link may turn by half a turn or more. For a smooth loop the last frame repeats the first.
    pub fn frame<N, P>(&mut self, points: impl IntoIterator<Item = (N, P)>) -> &mut Self
    where
        N: Into<String>,
        P: Into<Point2<f64>>,
    {
        self.figure.frames.push(points.into_iter().map(|(name, at)| (name.into(), at.into().coords)).collect());
        self
    }

    /// Adds a pivot on the ground.
    pub fn ground(&mut self, point: &str) -> &mut Self {
        self.part(Part::Ground(point.to_owned()))
    }

    /// Adds a line of the ground, hatched on its right side.
    pub fn ground_line(&mut self, line: impl IntoIterator<Item = impl Into<Point2<f64>>>) -> &mut Self {
        self.part(Part::GroundLine(line.into_iter().map(|point| point.into().coords).collect()))
    }

    /// Adds a rigid link through points: a bar through two, a plate through more.
    pub fn link(&mut self, points: &[&str]) -> &mut Self {
        self.figure.link(points, false);
        self
    }

    /// Adds the driving link; an arrow shows its rotation if its first point is at rest.
    pub fn crank(&mut self, points: &[&str]) -> &mut Self {
        self.figure.link(points, true);
        self
    }

    /// Adds a rigid link with bars from point to point, such as an L.
    pub fn bent(&mut self, points: &[&str]) -> &mut Self {
        self.part(Part::Bent(owned(points)))
    }

    /// Adds a sliding block at a point, on the straight guide along which the point moves.
    pub fn slider(&mut self, point: &str) -> &mut Self {
        self.part(Part::Slider { point: point.to_owned(), along: None })
    }

    /// Adds a block at a pin that slides on an arm with the direction from one point to another.
    pub fn sleeve(&mut self, pin: &str, arm: [&str; 2]) -> &mut Self {
        self.figure.sleeve(pin, arm);
        self
    }

    /// Adds a wheel, or the pitch circle of a gear, that turns with the direction from its centre to the point
    /// `towards`.
    pub fn wheel(&mut self, centre: &str, towards: &str, radius: f64) -> &mut Self {
        self.part(Part::Wheel { centre: centre.to_owned(), towards: towards.to_owned(), radius })
    }

    /// Adds a plate of any outline, such as a cam, that turns with the direction from its centre to the point
    /// `towards`. The corners of the outline are relative to the centre, with x in this direction.
    pub fn plate(&mut self, centre: &str, towards: &str, outline: impl IntoIterator<Item = Vector2<f64>>) -> &mut Self {
        let outline = outline.into_iter().collect();
        self.part(Part::Plate { centre: centre.to_owned(), towards: towards.to_owned(), outline })
    }

    /// Adds a spring between two points.
    pub fn spring(&mut self, from: &str, to: &str) -> &mut Self {
        self.part(Part::Spring([from, to].map(str::to_owned)))
    }

    /// Adds the path of a point, such as a coupler curve.
    pub fn trace(&mut self, point: &str) -> &mut Self {
        self.part(Part::Trace(point.to_owned()))
    }

    /// Sets the seconds that all frames take: a turn of 45 rpm takes 60/45.
    pub fn seconds(&mut self, seconds: f64) -> &mut Self {
        self.seconds = seconds;
        self
    }

    /// Sets the width of the picture in pixels; its height follows. Without it the picture fills the place that it has.
    pub fn width(&mut self, pixels: u32) -> &mut Self {
        self.figure.width = Some(pixels);
        self
    }

    /// Lets these points leave their paths, and no others: by default the declared points that are no joints do.
    /// [`DrawingError::UnknownJoint`](super::DrawingError::UnknownJoint) if there is no such point.
    pub fn paths(&mut self, points: &[&str]) -> &mut Self {
        self.figure.trace(points);
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
        self
    }
}
