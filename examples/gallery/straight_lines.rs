//! Exact and approximate straight-line linkages.

use std::error::Error;

use linkage::Elbow::{Left, Right};

use crate::figure::{Course, Figure};

use linkage_gallery::chebyshev::*;
use linkage_gallery::hart::*;
use linkage_gallery::hoecken::*;
use linkage_gallery::peaucellier::*;
use linkage_gallery::roberts::*;
use linkage_gallery::watt_line::*;

pub fn figures() -> Result<Vec<Figure>, Box<dyn Error>> {
    Ok(vec![watt_line()?, roberts()?, chebyshev()?, hoecken()?, peaucellier()?, hart()?])
}

/// On one branch the pen draws half of its curve. At the limits of the input the branches meet, and the other one draws
/// the rest.
fn watt_line() -> Result<Figure, Box<dyn Error>> {
    let m = WattLine::default();
    let [there, back] = [Right, Left].map(|phi_psi| WattLineBranch { phi_psi });
    let course = Course::around(0.0, |theta| m.assemble(theta, there).is_ok());
    let mut figure = Figure::new("Watt's line", WattLine::DERIVATION, course);
    figure.count_circuits(&m, 0.0)?;
    let inputs = course.inputs();
    for (step, &theta) in inputs.iter().enumerate() {
        let rises = inputs[(step + 1) % inputs.len()] > inputs[step.saturating_sub(1)];
        let branch = if rises { there } else { back };
        figure.branches.get_or_insert([WattLineBranch::all().count(), m.branches(theta)?.count()]);
        let pose = m.assemble(theta, branch)?;
        assert_eq!(m.branch_of(&pose), branch);
        frame!(figure, WattLine, m, &pose, points => []);
    }
    figure.picture.crank(&["Left", "B"]).link(&["B", "P", "C"]).link(&["Right", "C"]);
    figure.picture.ground("Left").ground("Right").trace("P");
    Ok(figure.words(
        "The middle of the link between two equal arms draws a figure of eight with a straight crossing: one branch \
         there, the other back.",
        "J. Watt, British patent 1432 (1784)",
    ))
}

fn roberts() -> Result<Figure, Box<dyn Error>> {
    let m = Roberts::default();
    let mut figure = assembled!("Roberts' line", Roberts, m on RobertsBranch::new(Left), from 67.4,
        |pose, points| []);
    figure.picture.crank(&["A", "B"]).link(&["B", "C", "P"]).link(&["D", "C"]);
    figure.picture.ground("A").ground("D").trace("P");
    Ok(figure.words(
        "The apex of the middle one of three equal triangles approximates the line between the pivots.",
        "R. Willis, Principles of Mechanism (1841), who credits Richard Roberts",
    ))
}

fn chebyshev() -> Result<Figure, Box<dyn Error>> {
    let m = ChebyshevCoupler::default();
    let mut figure = assembled!("Chebyshev's line", ChebyshevCoupler,
        m on ChebyshevCouplerBranch::new(Left), from 180.0, |pose, points| []);
    figure.picture.link(&["A", "B"]).link(&["D", "C"]).crank(&["B", "P", "C"]);
    figure.picture.ground("A").ground("D").trace("P");
    Ok(figure.words(
        "Crossed equal rockers; the coupler drives and makes full turns.",
        "P. L. Chebyshev, Théorie des mécanismes connus sous le nom de parallélogrammes (1854)",
    ))
}

fn hoecken() -> Result<Figure, Box<dyn Error>> {
    let m = Hoecken::default();
    let mut figure = assembled!("Hoecken's line", Hoecken, m on HoeckenBranch::new(Left), from 60.0,
        |pose, points| []);
    figure.picture.crank(&["A", "B"]).link(&["B", "C", "P"]).link(&["D", "C"]);
    figure.picture.ground("A").ground("D").trace("P");
    Ok(figure.words(
        "A nearly straight line at nearly constant speed during half a turn of the crank.",
        "K. Hoecken, Werkstattstechnik (1926)",
    ))
}

fn peaucellier() -> Result<Figure, Box<dyn Error>> {
    let m = Peaucellier::default();
    let mut figure = assembled!("Peaucellier-Lipkin cell", Peaucellier,
        m on PeaucellierBranch::new(Left, Right, Left),
        from 30.0, |pose, points| []);
    figure.picture.crank(&["Centre", "P"]).link(&["O", "Upper"]).link(&["O", "Lower"]);
    figure.picture.link(&["P", "Upper"]).link(&["P", "Lower"]).link(&["Q", "Upper"]).link(&["Q", "Lower"]);
    figure.picture.ground("O").ground("Centre").trace("P").trace("Q");
    Ok(figure.words(
        "The rhombus inverts the circle of P through O: Q draws an exact straight line.",
        "C.-N. Peaucellier (1864, 1873); L. I. Lipkin (1871)",
    ))
}

fn hart() -> Result<Figure, Box<dyn Error>> {
    let m = Hart::default();
    let mut figure = assembled!("Hart's inversor", Hart, m on HartBranch::new(Left, Left),
        from 30.0, |pose, points| []);
    figure.picture.crank(&["Centre", "P"]).link(&["A", "O", "B"]).link(&["A", "P", "D"]);
    figure.picture.link(&["B", "Q", "C"]).link(&["C", "D"]);
    figure.picture.ground("O").ground("Centre").trace("P").trace("Q");
    Ok(figure.words(
        "A crossed parallelogram that inverts as Peaucellier's cell does, with two links fewer.",
        "H. Hart, Messenger of Mathematics 4 (1875)",
    ))
}
