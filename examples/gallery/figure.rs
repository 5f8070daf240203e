//! A mechanism through its course: the positions, what is checked of each, and what is said of it.

use std::f64::consts::TAU;

use linkage::derivation::Derivation;
use linkage::drawing::Animation;
use linkage::nalgebra::{Point2, Vector2};

/// Steps from the first frame to the last, which is the first again.
pub const STEPS: u32 = 72;

/// A picture plays in so many seconds.
const SECONDS: f64 = 6.0;

/// What the input does in one period of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Course {
    /// It turns all the way round, beginning here.
    Turn(f64),
    /// It swings, beginning at the first, between the other two: the mechanism assembles nowhere beyond.
    Swing { from: f64, low: f64, high: f64 },
    /// What the figure says.
    Own(&'static str),
}

impl Course {
    /// All the inputs around one, in radians, at which the mechanism assembles: by trying every degree, and by
    /// bisection at the ends.
    pub fn around(from: f64, assembles: impl Fn(f64) -> bool) -> Self {
        assert!(assembles(from), "no position at {from}");
        let end = |sign: f64| {
            let at = |degrees: u32| from + sign * f64::from(degrees).to_radians();
            let beyond = (1..=360).find(|degrees| !assembles(at(*degrees)))?;
            let (mut inside, mut outside) = (at(beyond - 1), at(beyond));
            for _ in 0..60 {
                let middle = f64::midpoint(inside, outside);
                if assembles(middle) { inside = middle } else { outside = middle }
            }
            Some(inside)
        };
        match [end(-1.0), end(1.0)] {
            [Some(low), Some(high)] => Self::Swing { from, low, high },
            _ => Self::Turn(from),
        }
    }

    /// The inputs of all frames.
    pub fn inputs(self) -> Vec<f64> {
        let part = |step: u32| f64::from(step) / f64::from(STEPS);
        let input = |step: u32| match self {
            Self::Turn(from) => from + TAU * part(step),
            Self::Swing { from, low, high } => {
                // At the very end two branches meet; a millionth of the way before it they are apart.
                let (middle, half) = (f64::midpoint(low, high), (high - low) / 2.0 * (1.0 - 1e-6));
                middle + half * (TAU * part(step) + ((from - middle) / half).asin()).sin()
            }
            Self::Own(_) => part(step),
        };
        (0..=STEPS).map(input).collect()
    }
}

/// One picture of the page.
pub struct Figure {
    pub name: &'static str,
    pub about: &'static str,
    pub source: &'static str,
    pub picture: Animation,
    pub derivation: &'static Derivation,
    pub course: Course,
    /// How many branches there could be, and how many there are in the first frame; none if positions come from
    /// Newton's method.
    pub branches: Option<[usize; 2]>,
    /// The largest residual of any closure, in roundings of the sum of its links.
    pub roundings: f64,
}

impl Figure {
    pub fn new(name: &'static str, derivation: &'static Derivation, course: Course) -> Self {
        let picture = Animation::new(name, SECONDS);
        Self { name, about: "", source: "", picture, derivation, course, branches: None, roundings: 0.0 }
    }

    /// A line about the mechanism, and whose it is.
    pub fn words(mut self, about: &'static str, source: &'static str) -> Self {
        (self.about, self.source) = (about, source);
        self
    }

    /// A position: its points, and how well it closes, which must be to a few roundings of the sum of its links.
    pub fn frame(&mut self, residual: f64, size: f64, points: Vec<(&'static str, Point2<f64>)>) {
        // In the dwell of a cam nothing is left of either.
        let roundings = if residual == 0.0 { 0.0 } else { residual / (f64::EPSILON * size) };
        assert!(roundings <= 8.0, "{} closes to {roundings} roundings", self.name);
        self.roundings = self.roundings.max(roundings);
        self.picture.frame(points);
    }
}

/// The point that is so far from one in the direction of another.
pub fn along(from: Point2<f64>, towards: Point2<f64>, distance: f64) -> Point2<f64> {
    from + (towards - from).normalize() * distance
}

/// A point by its coordinates.
pub fn at(x: f64, y: f64) -> Point2<f64> {
    Point2::new(x, y)
}

/// A vector by its length and its direction.
pub fn polar(length: f64, angle: f64) -> Vector2<f64> {
    Vector2::new(length * angle.cos(), length * angle.sin())
}

/// Adds a position to a figure: the mechanism's own points and those that the picture needs besides.
macro_rules! frame {
    ($figure:ident, $mechanism:ident, $m:expr, $pose:expr, $points:ident => $more:expr) => {{
        let $points = $m.points($pose)?;
        let own: [linkage::nalgebra::Point2<f64>; $mechanism::<f64>::DERIVATION.points.len()] = $points.into();
        let names = $mechanism::<f64>::DERIVATION.points.iter().map(|point| point.name);
        let points = names.zip(own).chain($more).collect();
        $figure.frame($m.residual($pose).amax(), $m.closure_sizes($pose).sum(), points);
    }};
}

/// The figure of a mechanism with one input, on one branch, as far round as it goes from an input in degrees: every
/// position in closed form.
macro_rules! assembled {
    ($name:expr, $mechanism:ident, $m:ident on $branch:ident::new($($side:expr),*), from $degrees:expr,
     |$pose:ident, $points:ident| $more:expr) => {{
        let branch = $branch::new($($side),*);
        let course = Course::around(f64::to_radians($degrees), |input| $m.assemble(input, branch).is_ok());
        let mut figure = Figure::new($name, $mechanism::<f64>::DERIVATION, course);
        for input in course.inputs() {
            figure.branches.get_or_insert([$branch::all().count(), $m.branches(input).count()]);
            let $pose = $m.assemble(input, branch)?;
            assert_eq!($m.branch_of(&$pose), branch, "{} at {input}", $name);
            frame!(figure, $mechanism, $m, &$pose, $points => $more);
        }
        figure
    }};
}
