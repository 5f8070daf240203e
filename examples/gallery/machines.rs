//! Machines: walking legs, a pantograph, a wiper, an engine and a squeezer.

use std::error::Error;
use std::f64::consts::TAU;

use linkage::Elbow::{Left, Right};
use linkage::Slider::Far;
use linkage::nalgebra::center;

use crate::figure::{Course, Figure};

use linkage_gallery::andrews::*;
use linkage_gallery::jansen::*;
use linkage_gallery::klann::*;
use linkage_gallery::pantograph::*;
use linkage_gallery::v_twin::*;
use linkage_gallery::wiper::*;

pub fn figures() -> Result<Vec<Figure>, Box<dyn Error>> {
    Ok(vec![jansen()?, klann()?, pantograph()?, wiper()?, v_twin()?, andrews()?])
}

fn jansen() -> Result<Figure, Box<dyn Error>> {
    let m = Jansen::default();
    let mut figure = assembled!("Jansen's leg", Jansen,
        m on JansenBranch::new(Left, Left, Right, Right, Right),
        from 0.0, |pose, points| []);
    figure.picture.link(&["Pivot", "Upper", "Back"]).link(&["Knee", "Ankle", "Foot"]).link(&["Pin", "Upper"]);
    figure.picture.link(&["Pin", "Knee"]).link(&["Pivot", "Knee"]).link(&["Back", "Ankle"]);
    figure.picture.crank(&["O", "Pin"]).ground("O").ground("Pivot").trace("Foot");
    Ok(figure.words(
        "The leg of the beach animals, with its thirteen numbers; the foot is level for nearly half of the turn.",
        "T. Jansen, The Great Pretender (2007)",
    ))
}

fn klann() -> Result<Figure, Box<dyn Error>> {
    let m = Klann::default();
    let mut figure = assembled!("Klann's leg", Klann,
        m on KlannBranch::new(Right, Left), from 180.0, |pose, points| []);
    figure.picture.bent(&["Pin", "Elbow", "Knee"]).bent(&["Hip", "Knee", "Foot"]).link(&["Lower", "Elbow"]);
    figure.picture.link(&["Upper", "Hip"]).crank(&["O", "Pin"]);
    figure.picture.ground("O").ground("Lower").ground("Upper").trace("Foot");
    Ok(figure.words(
        "Crank, a connecting arm bent at the elbow, a leg bent at the knee, and two rockers.",
        "J. C. Klann, United States patent 6,260,862 (2001)",
    ))
}

fn pantograph() -> Result<Figure, Box<dyn Error>> {
    let m = Pantograph::default();
    let course = Course::Own("a trefoil");
    let mut figure = Figure::new("Pantograph", Pantograph::DERIVATION, course);
    let branch = PantographBranch::new(Left, Right);
    for part in course.inputs() {
        let angle = TAU * part;
        let radius = 0.7 + 0.3 * (3.0 * angle).cos();
        let (x, y) = (4.6 + radius * angle.cos(), 0.4 + radius * angle.sin());
        let inputs = PantographInputs { x, y };
        figure.branches.get_or_insert([PantographBranch::all().count(), m.branches(inputs)?.count()]);
        let pose = m.assemble(inputs, branch)?;
        assert_eq!(m.branch_of(&pose), branch);
        let points = m.points(&pose)?;
        assert!((points.pen - points.tracer * m.ratio).amax() < 1e-12, "the pen does not copy at {angle}");
        frame!(figure, Pantograph, m, &pose, points => []);
    }
    figure.picture.link(&["O", "A", "Knee"]).link(&["A", "Tracer"]).link(&["Tracer", "B"]);
    figure.picture.link(&["Knee", "B", "Pen"]).crank(&["Tracer"]).ground("O").trace("Tracer").trace("Pen");
    Ok(figure.words(
        "The pen repeats what the tracer draws, two and a half times as large.",
        "Ch. Scheiner, Pantographice seu ars delineandi (1631)",
    ))
}

fn wiper() -> Result<Figure, Box<dyn Error>> {
    let m = Wiper::default();
    let mut figure = assembled!("Windscreen wiper", Wiper,
        m on WiperBranch::new(Left, Left), from 60.0, |pose, points| []);
    figure.picture.bent(&["FirstPin", "First", "FirstTip"]).bent(&["SecondPin", "Second", "SecondTip"]);
    figure.picture.link(&["FirstPin", "SecondPin"]).link(&["Pin", "FirstPin"]).crank(&["Motor", "Pin"]);
    figure.picture.ground("Motor").ground("First").ground("Second").trace("FirstTip").trace("SecondTip");
    Ok(figure.words(
        "A central crank-rocker drives the first wiper, and a parallelogram the second.",
        "Dimensions of this gallery, with both strokes of the same time",
    ))
}

fn v_twin() -> Result<Figure, Box<dyn Error>> {
    let m = VTwin::default();
    let mut figure = assembled!("V-twin engine", VTwin,
    m on VTwinBranch::new(Far, Far), from 60.0,
    |pose, points| [
        ("M", center(&points.pin, &points.front)),
        ("N", center(&points.pin, &points.rear)),
    ]);
    figure.picture.link(&["Pin", "M", "Front"]).link(&["Pin", "N", "Rear"]).slider("Front").slider("Rear");
    figure.picture.crank(&["O", "Pin"]).ground("O").trace("M").trace("N");
    Ok(figure.words(
        "Two pistons on one crank pin; the rear one follows the front one with a delay of 45°.",
        "The angle is that of Harley-Davidson's engines",
    ))
}

fn andrews() -> Result<Figure, Box<dyn Error>> {
    let m = Andrews::default();
    let mut figure = assembled!("Andrews' squeezer", Andrews,
        m on AndrewsBranch::new(Left, Right, Left), from -3.536,
        |pose, points| []);
    figure.picture.spring("D", "C").link(&["B", "E", "D"]).link(&["E", "H"]).link(&["A", "H"]).link(&["E", "G"]);
    figure.picture.link(&["A", "G"]).link(&["F", "E"]).crank(&["O", "F"]);
    figure.picture.ground("O").ground("A").ground("B").ground("C").trace("G").trace("E");
    Ok(figure.words(
        "Seven bodies and a spring: a benchmark for multibody programs.",
        "W. Schiehlen (editor), Multibody Systems Handbook (1990)",
    ))
}
