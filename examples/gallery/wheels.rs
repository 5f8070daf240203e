//! Gears, wheels, and the Maltese cross.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use linkage::Elbow::{self, Left, Right};
use linkage::Slider::Far;
use linkage::nalgebra::{Point2, Vector2};

use crate::figure::{Course, Figure, STEPS, at, polar};

use linkage_gallery::cardan::*;
use linkage_gallery::coupled_wheels::*;
use linkage_gallery::geared_five_bar::*;
use linkage_gallery::geneva::*;

pub fn figures() -> Result<Vec<Figure>, Box<dyn Error>> {
    Ok(vec![geared_five_bar()?, cardan()?, parallelogram()?, antiparallelogram()?, geneva()?])
}

fn geared_five_bar() -> Result<Figure, Box<dyn Error>> {
    let m = GearedFiveBar::default();
    let mut figure = assembled!("Geared five-bar", GearedFiveBar,
    m on GearedFiveBarBranch::new(Left), from 70.0,
    |pose, points| {
        let theta1 = pose.theta1.angle();
        let theta4 = m.ratio * theta1 + m.phase;
        [("A", at(0.0, 0.0)), ("D", at(m.e, 0.0)), ("B", polar(m.a, theta1).into()), ("C", at(m.e, 0.0) + polar(m.d, theta4))]
    });
    // Two pitch circles in contact, with ratio two to one.
    let pitch = m.e / (1.0 - m.ratio);
    figure.picture.wheel("A", "B", -m.ratio * pitch).wheel("D", "C", pitch);
    figure.picture.crank(&["A", "B"]).link(&["D", "C"]).link(&["B", "P"]).link(&["C", "P"]);
    figure.picture.ground("A").ground("D").trace("P");
    Ok(figure.words("The second crank is geared to the first, two to one.", "A textbook mechanism"))
}

fn cardan() -> Result<Figure, Box<dyn Error>> {
    let m = Cardan::default();
    let mut figure = assembled!("Cardan gears", Cardan, m on CardanBranch::new(), from 50.0, |pose, points| []);
    figure.picture.ground_line((0..=72).map(|step| Point2::from(polar(m.ring, f64::from(step) * TAU / 72.0))));
    figure.picture.wheel("Centre", "Rim", m.planet).crank(&["O", "Centre"]).ground("O").trace("Rim").trace("Pen");
    Ok(figure.words(
        "A planet rolls in a ring of twice its size: its rim moves on a diameter, its inner points on ellipses.",
        "G. Cardano, Opus novum de proportionibus (1570)",
    ))
}

/// The parallelogram passes both its change points, where it could become an antiparallelogram; the branch changes at
/// each. No frame is exactly there.
fn parallelogram() -> Result<Figure, Box<dyn Error>> {
    let mut figure = coupled_wheels("Coupled wheels", [Left, Right])?;
    let CoupledWheels { crank, base } = CoupledWheels::default();
    let radius = 1.9 * crank;
    figure.picture.ground_line([at(-radius, -radius), at(base + radius, -radius)]);
    figure.picture.wheel("A", "B", radius).wheel("D", "C", radius);
    figure.picture.crank(&["A", "B"]).link(&["D", "C"]).link(&["B", "Middle", "C"]).trace("Middle");
    Ok(figure.words(
        "A parallelogram that passes both its change points: half a turn on each branch.",
        "F. Reuleaux, Theoretische Kinematik (1875)",
    ))
}

/// The antiparallelogram: the same links on the other branches.
fn antiparallelogram() -> Result<Figure, Box<dyn Error>> {
    let mut figure = coupled_wheels("Antiparallelogram", [Right, Left])?;
    figure.picture.crank(&["A", "B"]).link(&["D", "C"]).link(&["B", "Middle", "C"]);
    figure.picture.ground("A").ground("D").trace("Middle");
    Ok(figure.words(
        "The links of the coupled wheels on the other branches: the cranks turn in opposite senses.",
        "F. Reuleaux, Theoretische Kinematik (1875)",
    ))
}

/// A full turn, on one branch while the crank is above the line of the pivots and on the other while it is below.
fn coupled_wheels(name: &'static str, [above, below]: [Elbow; 2]) -> Result<Figure, Box<dyn Error>> {
    let m = CoupledWheels::default();
    // Start half a step after the change point.
    let course = Course::Turn((180.0 / f64::from(STEPS)).to_radians());
    let mut figure = Figure::new(name, CoupledWheels::DERIVATION, course);
    figure.count_circuits(&m, 1.0)?;
    for theta in course.inputs() {
        let branch = CoupledWheelsBranch::new(if theta.sin() > 0.0 { above } else { below });
        figure.branches.get_or_insert([CoupledWheelsBranch::all().count(), m.branches(theta)?.count()]);
        let pose = m.assemble(theta, branch)?;
        assert_eq!(m.branch_of(&pose), branch);
        frame!(figure, CoupledWheels, m, &pose, points => []);
    }
    Ok(figure)
}

/// While the pin is in a slot the loop equation holds; for the rest of the turn the locking disc holds the wheel.
fn geneva() -> Result<Figure, Box<dyn Error>> {
    let m = Geneva::default();
    let branch = GenevaBranch { psi_s: Far };
    let engaged = FRAC_PI_2 - PI / m.slots;
    let course = Course::Own("in the slot between −45° and 45°, then a dwell");
    let mut figure = Figure::new("Geneva drive", Geneva::DERIVATION, course);
    figure.count_circuits(&m, 0.1)?;
    for part in course.inputs() {
        // From the middle of one dwell to the middle of the next.
        let theta = PI + TAU * part;
        let turned = (theta - TAU).clamp(-engaged, engaged);
        figure.branches.get_or_insert([GenevaBranch::all().count(), m.branches(turned)?.count()]);
        let pose = m.assemble(turned, branch)?;
        assert_eq!(m.branch_of(&pose), branch);
        frame!(figure, Geneva, m, &pose, points => [("Crank", polar(m.crank, theta).into())]);
    }
    figure.picture.plate("Wheel", "Mouth", cross(&m)).plate("O", "Crank", locking_disc(&m));
    figure.picture.crank(&["O", "Crank"]).ground("O").ground("Wheel").trace("Crank");
    Ok(figure.words(
        "The pin enters a slot tangentially and turns the wheel by one slot; then the locking disc holds the wheel.",
        "J. H. Bickford, Mechanisms for Intermittent Motion (1972)",
    ))
}

/// The radius of the locking disc, relative to the crank.
const LOCK: f64 = 0.72;

/// The outline of the wheel: slots at equal angles from x, and hollows for the locking disc between them.
fn cross(m: &Geneva) -> Vec<Vector2<f64>> {
    let base = m.crank / (PI / m.slots).sin();
    let (reach, depth, half_width) = (m.crank / (PI / m.slots).tan(), base - m.crank, 0.07 * m.crank);
    let mut outline = Vec::new();
    for slot in 0..m.slots as u32 {
        let angle = TAU / m.slots * f64::from(slot);
        let turned = |x: f64, y: f64| polar(x, angle) + polar(y, angle + FRAC_PI_2);
        outline.push(turned(reach, -half_width));
        // Around the bottom, clockwise.
        for step in 0..=8 {
            let round = angle - FRAC_PI_2 - PI * f64::from(step) / 8.0;
            outline.push(turned(depth, 0.0) + polar(half_width, round));
        }
        outline.push(turned(reach, half_width));
        for step in 0..=16 {
            let across = PI + PI / m.slots;
            let hollow = polar(base, angle + PI / m.slots)
                + polar(LOCK * m.crank, angle + across + 0.62 - 1.24 * f64::from(step) / 16.0);
            outline.push(hollow);
        }
    }
    outline
}

/// The locking disc, with a cut-out for the turning wheel.
fn locking_disc(m: &Geneva) -> Vec<Vector2<f64>> {
    let base = m.crank / (PI / m.slots).sin();
    let reach = 1.03 * m.crank / (PI / m.slots).tan();
    let disc = |step: u32| polar(LOCK * m.crank, TAU * f64::from(step) / 72.0);
    (0..72)
        .map(disc)
        .map(|at| {
            let from_wheel = at - Vector2::new(base, 0.0);
            if from_wheel.norm() < reach { Vector2::new(base, 0.0) + from_wheel.normalize() * reach } else { at }
        })
        .collect()
}
