//! The circuits of a mechanism as one picture: the input across, one of the unknowns up, the circuits in colours, modes and
//! dead points marked, and the linkage at each dead point.

mod miniature;
mod page;
mod render;
mod runs;

use linkage_runtime::circuits::{Circuits, CurveEnd, CurveEvent, CurveMeeting, MotionCurve};
use linkage_runtime::skeleton::Skeleton;
use linkage_runtime::{BorrowedName, D, Dim};
use nalgebra::Vector2;

use super::DrawingError;
use super::mechanism::check;
use miniature::Miniature;
use runs::{Axis, runs};

/// The most linkages drawn below the chart.
const MOST_MINIATURES: usize = 24;

/// A picture of [`Circuits`].
///
/// Angles are drawn modulo a turn. The colour and the dashes of a line are those of its circuit; a dot is a mode, with its
/// number; a letter is a dead point or a change point, where the linkage is drawn below. Curves are drawn through the
/// points of the motions: a `longest_step` of 1/16 gives smooth ones.
///
/// ```
/// linkage::linkage! {
///     pub mechanism FourBar {
///         param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
///         input theta;
///         unknown phi, psi;
///         loop crank@theta + coupler@phi = ground@0 + rocker@psi;
///         derive drawing;
///     }
/// }
/// use linkage::circuits::Circuits;
/// use linkage::drawing::CircuitChart;
///
/// let m = FourBar::default();
/// let circuits = Circuits::of(&m, 0.5, Default::default())?;
/// let svg = CircuitChart::of(&m, &circuits, "psi")?.title("No link turns").to_svg();
/// assert!(svg.contains("one circuit of 2 modes"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct CircuitChart {
    title: String,
    /// The input and the unknown.
    axes: [Axis; 2],
    lines: Vec<Line>,
    modes: Vec<Vector2<f64>>,
    /// The circuit of each mode.
    mode_circuits: Vec<usize>,
    places: Vec<Place>,
    /// The words about each circuit.
    words: Vec<Words>,
    /// The number of the first mode and of the first circuit.
    first: usize,
}

/// The modes of a circuit, and what else is said about it.
#[derive(Debug, Clone)]
struct Words {
    modes: Vec<usize>,
    others: String,
}

/// A motion as lines of the chart.
#[derive(Debug, Clone)]
struct Line {
    circuit: usize,
    runs: Vec<Vec<Vector2<f64>>>,
}

/// A dead point or a change point.
#[derive(Debug, Clone)]
struct Place {
    circuit: usize,
    is_dead_point: bool,
    at: Vector2<f64>,
    modes: [Option<usize>; 2],
    miniature: Miniature,
}

impl CircuitChart {
    /// The chart of a mechanism with `derive drawing;`; `unknown` is the coordinate that is drawn up.
    ///
    /// # Errors
    /// [`DrawingError::NoDrawing`] if the mechanism has none, [`DrawingError::Empty`] if there is no motion, [`DrawingError::UnknownCoordinate`] if the mechanism has no such
    /// unknown, [`DrawingError::NotFinite`] if a coordinate is infinite or NaN.
    pub fn of<M, B>(
        mechanism: &M,
        circuits: &Circuits<M::Coordinates, B, f64, M::Name>,
        unknown: &str,
    ) -> Result<Self, DrawingError>
    where
        M: Skeleton<Scalar = f64, V = D<1>>,
        B: Copy,
    {
        check(mechanism)?;
        let (u, ..) = mechanism.dims();
        let row = (0..u.count()).find(|&place| mechanism.unknown_name(place).to_string() == unknown);
        let row = row.ok_or_else(|| DrawingError::UnknownCoordinate(unknown.to_owned()))?;
        let at = |q: &M::Coordinates| Vector2::new(M::inputs(q)[0], M::unknowns(q)[row]);
        let points = |motion: &MotionCurve<M::Coordinates, f64, M::Name>| -> Vec<Vector2<f64>> {
            motion.points.iter().map(|point| at(&point.position)).collect()
        };
        let curves: Vec<Vec<Vector2<f64>>> = circuits.motions.iter().map(points).collect();
        let all: Vec<Vector2<f64>> = curves.iter().flatten().copied().collect();
        if all.is_empty() {
            return Err(DrawingError::Empty);
        }
        if !all.iter().flatten().all(|number| number.is_finite()) {
            return Err(DrawingError::NotFinite("a coordinate of a motion".to_owned()));
        }
        let is_angle = |all: &[bool], place: usize| all.get(place) == Some(&true);
        let input = Axis::new(
            mechanism.input_name(0).as_ref(),
            is_angle(mechanism.input_angles(), 0),
            0.0,
            all.iter().map(|at| at.x),
        );
        let turn_from = -std::f64::consts::PI;
        let axes = [
            input,
            Axis::new(unknown, is_angle(mechanism.unknown_angles(), row), turn_from, all.iter().map(|at| at.y)),
        ];
        let circuit_of = |motion: usize| circuits.circuit_of(motion).unwrap_or_default();
        let lines = curves
            .iter()
            .enumerate()
            .map(|(motion, curve)| Line { circuit: circuit_of(motion), runs: runs(&axes, curve) });
        let mut places: Vec<Place> = Vec::new();
        for (motion, curve) in circuits.motions.iter().enumerate() {
            for meeting in curve.dead_points().chain(curve.change_points()) {
                let CurveMeeting { point, modes } = meeting;
                let is_dead_point = matches!(point.event, Some(CurveEvent::DeadPoint { .. }));
                let miniature = Miniature::of(mechanism, &mechanism.pose_at(&point.position));
                let place =
                    Place { circuit: circuit_of(motion), is_dead_point, at: at(&point.position), modes, miniature };
                if !places.iter().any(|other| other.is_the_place(&place)) {
                    places.push(place);
                }
            }
        }
        let words = circuits.circuits.iter().map(|motions| words(circuits, motions)).collect();
        let (title, lines) = (mechanism.name().to_string(), lines.collect());
        let modes = circuits.modes.iter().map(|mode| at(&mode.position)).collect();
        let mode_circuits = circuits.modes.iter().map(|mode| circuit_of(mode.motion)).collect();
        Ok(Self { title, axes, lines, modes, mode_circuits, places, words, first: 0 })
    }

    /// Sets the title, by default the name of the mechanism.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Sets the number of the first mode and of the first circuit, by default 0 as in [`Circuits`]. Reports count from 1.
    #[must_use]
    pub fn numbered_from(mut self, first: usize) -> Self {
        self.first = first;
        self
    }

    /// Writes the SVG.
    #[must_use]
    pub fn to_svg(&self) -> String {
        render::svg(self)
    }

    /// Writes several charts, such as one for each unknown, as one HTML file, which loads nothing and runs no script. The text
    /// comes after them; an empty line begins a paragraph.
    #[must_use]
    pub fn to_html(title: &str, charts: &[Self], text: &str) -> String {
        page::html(title, text, charts)
    }

    /// The modes, turns and dead points of each circuit, with its number.
    fn all_words(&self) -> impl Iterator<Item = String> {
        self.words.iter().zip(self.first..).map(|(words, circuit)| {
            let modes: Vec<String> = words.modes.iter().map(|mode| (self.first + mode).to_string()).collect();
            let ending = if modes.len() == 1 { "" } else { "s" };
            format!("circuit {circuit}: mode{ending} {}{}", modes.join(", "), words.others)
        })
    }
}

impl Place {
    /// True if both are one change point, which two motions pass.
    fn is_the_place(&self, other: &Self) -> bool {
        !self.is_dead_point && !other.is_dead_point && self.miniature.is_near(&other.miniature)
    }
}

/// The letter of a dead point or change point: a to z, then a2 to z2.
fn letter(place: usize) -> String {
    let letter = char::from(b'a' + (place % 26) as u8);
    if place < 26 { letter.to_string() } else { format!("{letter}{}", place / 26 + 1) }
}

/// The modes, turns and dead points of a circuit.
fn words<Q: Copy, B, N: BorrowedName>(circuits: &Circuits<Q, B, f64, N>, motions: &[usize]) -> Words {
    let curves = || motions.iter().filter_map(|&motion| circuits.motions.get(motion));
    let mut modes: Vec<usize> = curves().flat_map(MotionCurve::modes).collect();
    modes.sort_unstable();
    let mut words = String::new();
    let mut add = |count: usize, one: &str, many: &str| match count {
        0 => {}
        1 => words += &format!(", {one}"),
        count => words += &format!(", {count} {many}"),
    };
    let count = |is_counted: fn(&MotionCurve<Q, f64, N>) -> bool| curves().filter(|curve| is_counted(curve)).count();
    add(curves().map(|curve| curve.dead_points().count()).sum(), "1 dead point", "dead points");
    add(count(|curve| curve.change_points().next().is_some()), "change points", "motions that cross");
    add(count(|curve| curve.full_turns().abs() == 1), "a full turn", "full turns");
    add(count(|curve| curve.end == CurveEnd::Open), "not closed", "motions that do not close");
    for turns in curves().map(|curve| curve.full_turns().abs()).filter(|&turns| turns > 1) {
        words += &format!(", closed after {turns} turns");
    }
    Words { modes, others: words }
}

/// The counts of modes, circuits and full turns in words.
fn summary(chart: &CircuitChart) -> String {
    let circuits = match chart.words.len() {
        1 => "one circuit".to_owned(),
        count => format!("{count} circuits"),
    };
    match chart.modes.len() {
        1 => format!("{circuits} of 1 mode"),
        count => format!("{circuits} of {count} modes"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_go_on_after_z() {
        assert_eq!([0, 25, 26, 53].map(letter), ["a", "z", "a2", "b3"]);
    }
}
