//! A linkage in motion: its links, pivots and slides as engineers draw them, in one SVG that moves without a
//! script.

use nalgebra::{Point2, Vector2};

use super::{DrawingError, smil};

/// What is drawn, by the names of its points.
#[derive(Debug, Clone)]
pub(super) enum Part {
    Ground(String),
    Link { points: Vec<String>, driven: bool },
    Bent(Vec<String>),
    Slider(String),
    Sleeve { pin: String, arm: [String; 2] },
    Wheel { centre: String, towards: String, radius: f64 },
    Plate { centre: String, towards: String, outline: Vec<Vector2<f64>> },
    Spring([String; 2]),
    GroundLine(Vec<Vector2<f64>>),
    Trace(String),
}

impl Part {
    pub(super) fn points(&self) -> Vec<&String> {
        match self {
            Self::Ground(point) | Self::Slider(point) | Self::Trace(point) => vec![point],
            Self::Link { points, .. } | Self::Bent(points) => points.iter().collect(),
            Self::Sleeve { pin, arm: [from, to] } => vec![pin, from, to],
            Self::Wheel { centre, towards, .. } | Self::Plate { centre, towards, .. } => vec![centre, towards],
            Self::Spring([from, to]) => vec![from, to],
            Self::GroundLine(_) => Vec::new(),
        }
    }

    /// The points at which the part is held.
    pub(super) fn joins(&self) -> impl Iterator<Item = &String> {
        let held = match self {
            Self::Trace(_) => 0,
            Self::Sleeve { .. } | Self::Wheel { .. } | Self::Plate { .. } => 1,
            _ => usize::MAX,
        };
        self.points().into_iter().take(held)
    }
}

/// A moving picture in the making: frames of named points, and the parts that join them. Lengths are those of the
/// mechanism, y points up.
///
/// The first frame is the picture where nothing moves: on paper, and for those who want less motion.
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
    pub(super) frames: Vec<Vec<(String, Vector2<f64>)>>,
    pub(super) parts: Vec<Part>,
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

impl Animation {
    /// An empty picture that plays its frames in so many seconds, again and again.
    pub fn new(title: impl Into<String>, seconds: f64) -> Self {
        Self { title: title.into(), seconds, frames: Vec::new(), parts: Vec::new() }
    }

    fn part(&mut self, part: Part) -> &mut Self {
        self.parts.push(part);
        self
    }

    /// The next frame: where the points are, of the same names each time. Frames are equally far apart in time and
    /// near enough that nothing turns by half a turn between them; the last is the first again where the motion
    /// is to be smooth.
    pub fn frame<N, P>(&mut self, points: impl IntoIterator<Item = (N, P)>) -> &mut Self
    where
        N: Into<String>,
        P: Into<Point2<f64>>,
    {
        self.frames.push(points.into_iter().map(|(name, at)| (name.into(), at.into().coords)).collect());
        self
    }

    /// A pivot on the frame.
    pub fn ground(&mut self, point: &str) -> &mut Self {
        self.part(Part::Ground(point.to_owned()))
    }

    /// A line of the frame, hatched on the right of those who walk along it.
    pub fn ground_line(&mut self, line: impl IntoIterator<Item = impl Into<Point2<f64>>>) -> &mut Self {
        self.part(Part::GroundLine(line.into_iter().map(|point| point.into().coords).collect()))
    }

    /// A rigid link through points: a bar through two, a plate through more.
    pub fn link(&mut self, points: &[&str]) -> &mut Self {
        self.part(Part::Link { points: owned(points), driven: false })
    }

    /// The link that drives; an arrow shows how it turns, if its first point is at rest.
    pub fn crank(&mut self, points: &[&str]) -> &mut Self {
        self.part(Part::Link { points: owned(points), driven: true })
    }

    /// A rigid link whose bars run from point to point, such as an L.
    pub fn bent(&mut self, points: &[&str]) -> &mut Self {
        self.part(Part::Bent(owned(points)))
    }

    /// A block at a point, on the straight guide of the frame along which the point moves.
    pub fn slider(&mut self, point: &str) -> &mut Self {
        self.part(Part::Slider(point.to_owned()))
    }

    /// A block at a pin, sliding on an arm that has the direction from one point to another.
    pub fn sleeve(&mut self, pin: &str, [from, to]: [&str; 2]) -> &mut Self {
        self.part(Part::Sleeve { pin: pin.to_owned(), arm: [from, to].map(str::to_owned) })
    }

    /// A wheel, or the pitch circle of a gear, that turns with the direction from its centre to a point.
    pub fn wheel(&mut self, centre: &str, towards: &str, radius: f64) -> &mut Self {
        self.part(Part::Wheel { centre: centre.to_owned(), towards: towards.to_owned(), radius })
    }

    /// A plate of any outline, such as a cam: its corners as seen from its centre, x being the direction to the
    /// point with which it turns.
    pub fn plate(&mut self, centre: &str, towards: &str, outline: impl IntoIterator<Item = Vector2<f64>>) -> &mut Self {
        let outline = outline.into_iter().collect();
        self.part(Part::Plate { centre: centre.to_owned(), towards: towards.to_owned(), outline })
    }

    /// A spring between two points.
    pub fn spring(&mut self, from: &str, to: &str) -> &mut Self {
        self.part(Part::Spring([from, to].map(str::to_owned)))
    }

    /// The path of a point, such as a coupler curve.
    pub fn trace(&mut self, point: &str) -> &mut Self {
        self.part(Part::Trace(point.to_owned()))
    }

    /// The picture.
    ///
    /// # Errors
    /// [`DrawingError`] if there is nothing to draw, a name is unknown or used twice, a number is not finite, or
    /// the parts contradict the frames: a link that changes its shape, a pivot of the frame that moves, a slider
    /// that leaves its straight line.
    pub fn to_svg(&self) -> Result<String, DrawingError> {
        if !(self.seconds.is_finite() && self.seconds > 0.0) {
            return Err(DrawingError::NotFinite("the time that an animation takes".to_owned()));
        }
        smil::svg(self)
    }
}
