//! A figure of the gallery: its positions, their checks, and its text.

use std::f64::consts::TAU;

use linkage::circuits::{CircuitError, CircuitOptions, Circuits};
use linkage::derivation::Derivation;
use linkage::drawing::Animation;
use linkage::nalgebra::{Point2, Vector2};
use linkage::{Branches, D};

/// The number of steps of a period; the last frame equals the first.
pub const STEPS: u32 = 72;

/// The inputs at which motions start that are counted: a prime number, so that few are at an angle that is special.
const STARTS: u32 = 11;

/// The duration of an animation in seconds.
const SECONDS: f64 = 6.0;

/// The motion of the input in one period of the animation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Course {
    /// A full turn from this angle.
    Turn(f64),
    /// An oscillation between the limits of the input, starting at `from`.
    Swing { from: f64, low: f64, high: f64 },
    /// A motion that the figure describes.
    Own(&'static str),
}

impl Course {
    /// Finds the range of inputs around one, in radians, in which the mechanism assembles: by steps of a degree, and
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
                // Two branches meet at the exact limit: stop a millionth of the range before it.
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
    pub derivation: &'static Derivation<'static>,
    pub course: Course,
    /// The number of branches in general and in the first frame; None if positions come from Newton's method.
    pub branches: Option<[usize; 2]>,
    /// The numbers of modes, circuits and full turns; None for several inputs.
    pub circuits: Option<[usize; 3]>,
    /// The largest residual of any loop equation, in ulps of the sum of its link lengths.
    pub ulps: f64,
}

impl Figure {
    pub fn new(name: &'static str, derivation: &'static Derivation<'static>, course: Course) -> Self {
        let picture = Animation::new(name, SECONDS);
        let (branches, circuits) = (None, None);
        Self { name, about: "", source: "", picture, derivation, course, branches, circuits, ulps: 0.0 }
    }

    /// Sets a sentence about the mechanism, and its source.
    pub fn words(mut self, about: &'static str, source: &'static str) -> Self {
        (self.about, self.source) = (about, source);
        self
    }

    /// Counts the circuits through the modes at [`STARTS`] inputs, one of them given, the most modes at one of these, and
    /// the motions on which the input turns fully.
    pub fn count_circuits<M>(&mut self, mechanism: &M, input: f64) -> Result<(), CircuitError<M::Name>>
    where
        M: Branches<Scalar = f64, V = D<1>>,
    {
        let starts = (0..STARTS).map(|start| input + TAU * f64::from(start) / f64::from(STARTS));
        let found = Circuits::over(mechanism, starts.clone(), CircuitOptions::default())?;
        let modes_at = |start: f64| {
            let is_at = |position: &M::Coordinates| M::inputs(position)[0] == start;
            found.modes.iter().filter(|mode| is_at(&mode.position)).count()
        };
        let most = starts.map(modes_at).max().unwrap_or_default();
        self.circuits = Some([most, found.circuits.len(), found.full_turns()]);
        Ok(())
    }

    /// Adds a position; its residual must be a few ulps of the sum of the link lengths.
    pub fn frame(&mut self, residual: f64, size: f64, points: Vec<(&'static str, Point2<f64>)>) {
        // Both are zero in the dwell of a cam.
        let ulps = if residual == 0.0 { 0.0 } else { residual / (f64::EPSILON * size) };
        assert!(ulps <= 8.0, "{}: residual of {ulps} ulps", self.name);
        self.ulps = self.ulps.max(ulps);
        self.picture.frame(points);
    }
}

/// The point at a distance from one point towards another.
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

/// Adds a position to a figure: the mechanism's points and further points of the picture.
macro_rules! frame {
    ($figure:ident, $mechanism:ident, $m:expr, $pose:expr, $points:ident => $more:expr) => {{
        let $points = $m.points($pose)?;
        let own: [linkage::nalgebra::Point2<f64>; $mechanism::<f64>::DERIVATION.points.len()] = $points.into();
        let names = $mechanism::<f64>::DERIVATION.points.iter().map(|point| point.name);
        let points = names.zip(own).chain($more).collect();
        let (residual, scales) = {
            use linkage::Mechanism as _;
            ($m.residual($pose), $m.residual_scales($pose))
        };
        $figure.frame(residual.largest(), scales.sum(), points);
    }};
}

/// The figure of a mechanism with one input on one branch, over the whole input range around an angle in degrees, in
/// closed form.
macro_rules! assembled {
    ($name:expr, $mechanism:ident, $m:ident on $branch:ident::new($($side:expr),*), from $degrees:expr,
     |$pose:ident, $points:ident| $more:expr) => {{
        let branch = $branch::new($($side),*);
        let course = Course::around(f64::to_radians($degrees), |input| $m.assemble(input, branch).is_ok());
        let mut figure = Figure::new($name, $mechanism::<f64>::DERIVATION, course);
        figure.count_circuits(&$m, f64::to_radians($degrees))?;
        for input in course.inputs() {
            figure.branches.get_or_insert([$branch::all().count(), $m.branches(input)?.count()]);
            let $pose = $m.assemble(input, branch)?;
            assert_eq!($m.branch_of(&$pose), branch, "{} at {input}", $name);
            frame!(figure, $mechanism, $m, &$pose, $points => $more);
        }
        figure
    }};
}
