//! An animated linkage: links, pivots and sliders in one SVG, animated without a script.

use nalgebra::{Point2, Vector2};

/// A part to draw, by the names of its points; see the methods of [`Animation`].
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

    /// The points at which the part is connected to others: points that belong to several parts are drawn as joints.
    pub(super) fn joints(&self) -> impl Iterator<Item = &String> {
        let count = match self {
            Self::Trace(_) => 0,
            Self::Sleeve { .. } | Self::Wheel { .. } | Self::Plate { .. } => 1,
            _ => usize::MAX,
        };
        self.points().into_iter().take(count)
    }
}

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
    pub(super) frames: Vec<Vec<(String, Vector2<f64>)>>,
    pub(super) parts: Vec<Part>,
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

impl Animation {
    /// Creates an empty animation that repeats its frames after this number of seconds.
    pub fn new(title: impl Into<String>, seconds: f64) -> Self {
        Self { title: title.into(), seconds, frames: Vec::new(), parts: Vec::new() }
    }

    fn part(&mut self, part: Part) -> &mut Self {
        self.parts.push(part);
        self
    }

    /// Adds a frame: the positions of the points, with the same names in each frame. Frames are equally spaced in time;
    /// between two of them no link may turn by half a turn or more. For a smooth loop the last frame repeats the first.
    pub fn frame<N, P>(&mut self, points: impl IntoIterator<Item = (N, P)>) -> &mut Self
    where
        N: Into<String>,
        P: Into<Point2<f64>>,
    {
        self.frames.push(points.into_iter().map(|(name, at)| (name.into(), at.into().coords)).collect());
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
        self.part(Part::Link { points: owned(points), driven: false })
    }

    /// Adds the driving link; an arrow shows its rotation if its first point is at rest.
    pub fn crank(&mut self, points: &[&str]) -> &mut Self {
        self.part(Part::Link { points: owned(points), driven: true })
    }

    /// Adds a rigid link with bars from point to point, such as an L.
    pub fn bent(&mut self, points: &[&str]) -> &mut Self {
        self.part(Part::Bent(owned(points)))
    }

    /// Adds a sliding block at a point, on the straight guide along which the point moves.
    pub fn slider(&mut self, point: &str) -> &mut Self {
        self.part(Part::Slider(point.to_owned()))
    }

    /// Adds a block at a pin that slides on an arm with the direction from one point to another.
    pub fn sleeve(&mut self, pin: &str, [from, to]: [&str; 2]) -> &mut Self {
        self.part(Part::Sleeve { pin: pin.to_owned(), arm: [from, to].map(str::to_owned) })
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
}
