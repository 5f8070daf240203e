//! Linkages with revolute joints and one, two or three loops.

use std::error::Error;

use linkage::Elbow::{self, Left, Right};
use linkage::Mechanism;
use linkage::nalgebra::center;

use crate::figure::{Course, Figure, STEPS, at};

use linkage_gallery::double_butterfly::*;
use linkage_gallery::five_bar::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::stephenson_i::*;
use linkage_gallery::stephenson_ii::*;
use linkage_gallery::stephenson_iii::*;
use linkage_gallery::watt_i::*;
use linkage_gallery::watt_ii::*;

pub fn figures() -> Result<Vec<Figure>, Box<dyn Error>> {
    Ok(vec![
        four_bar("Four-bar, left branch", Left)?,
        four_bar("Four-bar, right branch", Right)?,
        five_bar()?,
        watt_i()?,
        watt_ii()?,
        stephenson_i()?,
        stephenson_ii()?,
        stephenson_iii()?,
        double_butterfly()?,
    ])
}

fn four_bar(name: &'static str, side: Elbow) -> Result<Figure, Box<dyn Error>> {
    let m = FourBar::default();
    let mut figure = assembled!(name, FourBar, m on FourBarBranch::new(side), from 20.0,
        |pose, points| [("A", at(0.0, 0.0)), ("D", at(m.l1, 0.0))]);
    figure.picture.crank(&["A", "B"]).link(&["B", "G3", "C"]).link(&["D", "C"]);
    figure.picture.ground("A").ground("D").trace("G3");
    Ok(figure.words(
        "Crank-rocker. C is left or right of the line from B to D: two circuits that no motion connects.",
        "Analisi cinematica mediante il metodo delle equazioni di vincolo, La Sapienza (2009-2010)",
    ))
}

fn five_bar() -> Result<Figure, Box<dyn Error>> {
    let m = FiveBar::default();
    let branch = FiveBarBranch { theta2_theta3: Left };
    let course = Course::Own("one turn of θ₁, two turns of θ₄ the other way");
    let mut figure = Figure::new("Five-bar with two inputs", FiveBar::DERIVATION, course);
    for part in course.inputs() {
        let theta1 = std::f64::consts::TAU * part + 1.0;
        let inputs = FiveBarInputs { theta1, theta4: 2.0 - 2.0 * theta1 };
        figure.branches.get_or_insert([FiveBarBranch::all().count(), m.branches(inputs)?.count()]);
        let pose = m.assemble(inputs, branch)?;
        assert_eq!(m.branch_of(&pose), branch);
        let [b, c] = [pose.theta1.complex() * m.a, pose.theta4.complex() * m.d];
        frame!(figure, FiveBar, m, &pose, points => [
            ("A", at(0.0, 0.0)), ("D", at(m.e, 0.0)), ("B", at(b.re, b.im)), ("C", at(m.e + c.re, c.im)),
        ]);
    }
    figure.picture.crank(&["A", "B"]).crank(&["D", "C"]).link(&["B", "P", "Pen"]).link(&["C", "P"]);
    figure.picture.ground("A").ground("D").trace("Pen");
    Ok(figure.words("Both cranks are driven independently.", "A textbook mechanism"))
}

fn watt_i() -> Result<Figure, Box<dyn Error>> {
    let m = WattI::default();
    let mut figure = assembled!("Watt I six-bar", WattI,
        m on WattIBranch::new(Left, Left), from 60.0, |pose, points| []);
    figure.picture.crank(&["A", "B"]).link(&["B", "C", "P"]).link(&["D", "C", "Q"]).link(&["P", "R"]);
    figure.picture.link(&["Q", "R"]).ground("A").ground("D").trace("R");
    Ok(figure.words(
        "Coupler and rocker of a four-bar are ternary, and a dyad joins them.",
        "J. M. McCarthy, G. S. Soh, Geometric Design of Linkages",
    ))
}

fn watt_ii() -> Result<Figure, Box<dyn Error>> {
    let m = WattII::default();
    let mut figure = assembled!("Watt II six-bar", WattII,
        m on WattIIBranch::new(Left, Left), from 60.0,
        |pose, points| [("M", center(&points.b, &points.c))]);
    figure.picture.crank(&["A", "B"]).link(&["B", "M", "C"]).link(&["D", "C", "P"]).link(&["P", "Q"]);
    figure.picture.link(&["F", "Q"]).ground("A").ground("D").ground("F").trace("M");
    Ok(figure.words(
        "Two four-bars in series: the rocker of the first is the crank of the second.",
        "J. M. McCarthy, G. S. Soh, Geometric Design of Linkages",
    ))
}

fn stephenson_i() -> Result<Figure, Box<dyn Error>> {
    let m = StephensonI::default();
    let mut figure = assembled!("Stephenson I six-bar", StephensonI,
        m on StephensonIBranch::new(Left, Left), from 60.0, |pose, points| []);
    figure.picture.crank(&["A", "B", "P"]).link(&["B", "C"]).link(&["D", "C", "Q"]).link(&["P", "R"]);
    figure.picture.link(&["Q", "R"]).ground("A").ground("D").trace("R");
    Ok(figure.words(
        "Crank and rocker of a four-bar are ternary, and a dyad joins their other arms.",
        "J. M. McCarthy, G. S. Soh, Geometric Design of Linkages",
    ))
}

/// Four coupled angles: Newton's method from the previous position, every degree.
fn stephenson_ii() -> Result<Figure, Box<dyn Error>> {
    let m = StephensonII::default();
    let mut figure = Figure::new("Stephenson II six-bar", StephensonII::DERIVATION, Course::Turn(0.0));
    figure.count_circuits(&m, 0.0)?;
    let [alpha, beta, tau, rho] = [30.0, 21.0, -90.0, 54.0].map(f64::to_radians);
    let mut q = StephensonIICoordinates { theta: 0.0, alpha, beta, tau, rho };
    let first = m.pose_at(&m.solve(&q)?.coordinates);
    for degree in 0..=360 {
        q.theta = f64::from(degree).to_radians();
        q = m.solve(&q)?.coordinates;
        let pose = m.pose_at(&q);
        assert!(m.same_branch(&first, &pose), "another branch at {degree} degrees");
        if degree % (360 / STEPS) == 0 {
            frame!(figure, StephensonII, m, &pose, points => []);
        }
    }
    figure.picture.crank(&["O", "A", "B"]).link(&["A", "C"]).link(&["B", "D"]).link(&["C", "D", "E"]);
    figure.picture.link(&["G", "E"]).ground("O").ground("G").trace("D");
    Ok(figure.words(
        "No loop has only two unknowns: four angles are coupled.",
        "J. M. McCarthy, G. S. Soh, Geometric Design of Linkages",
    ))
}

fn stephenson_iii() -> Result<Figure, Box<dyn Error>> {
    let m = StephensonIII::default();
    let mut figure = assembled!("Stephenson III six-bar", StephensonIII,
        m on StephensonIIIBranch::new(Left, Left), from 60.0, |pose, points| []);
    figure.picture.crank(&["A", "B"]).link(&["B", "C", "P"]).link(&["D", "C"]).link(&["P", "Q"]);
    figure.picture.link(&["F", "Q"]).ground("A").ground("D").ground("F").trace("P");
    Ok(figure.words(
        "A coupler point drives a dyad, as in dwell mechanisms.",
        "J. M. McCarthy, G. S. Soh, Geometric Design of Linkages",
    ))
}

/// Six coupled angles: Newton's method from the previous position, every degree.
fn double_butterfly() -> Result<Figure, Box<dyn Error>> {
    let m = DoubleButterfly::default();
    let mut q = DoubleButterflyCoordinates {
        crank: 1.036,
        coupler: 1.0,
        upper: -0.595,
        rocker: 1.408,
        lower: 0.508,
        link: -0.004,
        strut: 1.591,
    };
    let start = q.crank;
    let mut figure = Figure::new("Double butterfly", DoubleButterfly::DERIVATION, Course::Turn(start));
    figure.count_circuits(&m, start)?;
    let first = m.pose_at(&m.solve(&q)?.coordinates);
    for degree in 0..=360 {
        q.crank = start + f64::from(degree).to_radians();
        q = m.solve(&q)?.coordinates;
        let pose = m.pose_at(&q);
        assert!(m.same_branch(&first, &pose), "another branch at {degree} degrees");
        if degree % (360 / STEPS) == 0 {
            frame!(figure, DoubleButterfly, m, &pose, points => []);
        }
    }
    figure.picture.crank(&["A", "C", "D"]).link(&["E", "F", "G"]).link(&["D", "H", "I"]).link(&["B", "F", "J"]);
    figure.picture.link(&["C", "E"]).link(&["G", "H"]).link(&["I", "J"]).ground("A").ground("B").trace("E");
    Ok(figure.words(
        "An eight-bar of four ternary links without a four-bar loop: six angles are coupled.",
        "J. Nielsen, B. Roth (1999); C. W. Wampler (2001)",
    ))
}
