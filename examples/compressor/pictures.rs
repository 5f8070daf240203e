//! Draws the page.

use std::f64::consts::TAU;

use linkage::PositionError;
use linkage::chart::Polar;
use linkage::drawing::Animation;
use linkage::nalgebra::{Point2, Vector2, point};

use crate::Balanced;
use crate::loads::{BRANCH, Loads};
use crate::machine::{Compressor, Running};
use linkage_examples::plot::{self, Plot};

/// Frames of the animation, and its duration in seconds: slow motion.
const FRAMES: u32 = 72;
const SECONDS: f64 = 4.0;

/// The height of the piston above and below its pin.
const CROWN: f64 = 0.03;
const SKIRT: f64 = 0.016;

/// Rotates by a quarter turn: x of the machine points up.
fn up(at: Point2<f64>) -> Point2<f64> {
    point![-at.y, at.x]
}

fn frame(machine: &Compressor<f64>, phi: f64) -> Result<[(&'static str, Point2<f64>); 6], PositionError> {
    let points = machine.points(&machine.assemble(phi, BRANCH)?)?;
    let on_shaft = points.shaft + 0.6 * machine.r * Vector2::new(-phi.cos(), phi.sin());
    let weight = point![-0.8 * machine.r * phi.cos(), -0.8 * machine.r * phi.sin()];
    let [pin, piston, crown] = [points.crank_pin, points.piston_pin, points.crown].map(up);
    Ok([("O", Point2::origin()), ("A", pin), ("B", piston), ("Crown", crown), ("W", up(weight)), ("S", up(on_shaft))])
}

fn animation(scene: &Running<f64>) -> Result<String, Box<dyn std::error::Error>> {
    let machine = &scene.mechanism;
    let mut picture = Animation::new("Compressor", SECONDS);
    for step in 0..=FRAMES {
        let phi = TAU * f64::from(step) / f64::from(FRAMES);
        let mut points = frame(machine, phi)?.to_vec();
        points.push(("Shaft", up(point![-scene.mechanism.depth, 0.0])));
        picture.frame(points);
    }
    let (wall, stroke) = (scene.bore / 2.0, 2.0 * machine.r);
    let top = machine.r + machine.l + CROWN;
    let (head, foot) = (top + 0.06 * stroke, top - 1.6 * stroke);
    let cylinder = [[wall, foot], [wall, head], [-wall, head], [-wall, foot]];
    let piston = [[-SKIRT, wall], [CROWN, wall], [CROWN, -wall], [-SKIRT, -wall]];
    picture.plate("B", "Crown", piston.map(Vector2::from)).link(&["A", "B"]).ground("O").ground("Shaft");
    picture.ground_line(cylinder.map(Point2::from));
    picture.crank(&["W", "O", "A"]).crank(&["Shaft", "S"]);
    Ok(picture.to_svg()?)
}

pub fn page(
    scene: &Running<f64>,
    machines: &[Balanced],
    rows: &[[String; 2]],
) -> Result<String, Box<dyn std::error::Error>> {
    let over_angle = |loads: &[Loads], of: &dyn Fn(&Loads) -> f64| -> Vec<[f64; 2]> {
        loads.iter().map(|loads| [loads.phi.to_degrees(), of(loads)]).collect()
    };
    let bare = &machines[0].loads;
    let top = scene.mechanism.r + scene.mechanism.l;
    let way = |loads: &Loads| [(top - loads.place) * 1e3, loads.pressure / 1e6];
    let ends = [scene.inlet, scene.outlet];
    let opening =
        bare.windows(2).filter(|pair| pair[0].pressure != pair[1].pressure && ends.contains(&pair[1].pressure));
    let opening = opening.map(|pair| way(&pair[1]));
    let crank = "crank angle, degrees";
    let mut main = Plot::new("Main bearing", crank, "kN").every(90.0);
    let mut shaking = Plot::new("Shaking force", crank, "N").every(90.0);
    // The cylinder is upwards.
    let mut loci = Polar::new("Shaking force", "N");
    let crank_pin = bare.iter().map(|loads| loads.joints.crank_pin_on_rod / 1e3).map(|force| [-force.y, force.x]);
    let crank_pin = Polar::new("Crank pin", "kN").curve("", crank_pin);
    for Balanced { name, loads, .. } in machines {
        main = main.curve(name, over_angle(loads, &|loads| loads.joints.bearing_on_crank.norm() / 1e3));
        shaking = shaking.curve(name, over_angle(loads, &|loads| loads.shaking.norm()));
        loci = loci.curve(*name, loads.iter().map(|loads| [-loads.shaking.y, loads.shaking.x]));
    }
    let plots = [
        (
            Plot::new("Pressure", "way of the piston, mm", "MPa")
                .curve("", bare.iter().map(way))
                .marks("valves open", opening),
            "Compression, and expansion of the air in the clearance; the valves open at inlet and outlet pressure.",
        ),
        (
            Plot::new("Forces", crank, "kN")
                .every(90.0)
                .curve("piston pin", over_angle(bare, &|loads| loads.joints.piston_pin_on_rod.norm() / 1e3))
                .curve("crank pin", over_angle(bare, &|loads| loads.joints.crank_pin_on_rod.norm() / 1e3)),
            "The forces on the rod at both ends.",
        ),
        (
            Plot::new("Guide", crank, "kN")
                .every(90.0)
                .curve("", over_angle(bare, &|loads| loads.joints.z_normal / 1e3)),
            "The normal force of the cylinder on the piston.",
        ),
        (
            Plot::new("Torque", crank, "N m").every(90.0).curve("", over_angle(bare, &|loads| loads.torque)),
            "The torque that keeps the speed constant.",
        ),
        (main, "The main bearing carries the counterweight as well as what it balances."),
        (shaking, "The force on the foundation, which does not know the pressure: only masses count."),
    ];
    let polars = [
        (loci, "With both masses the second order is left, along the cylinder, at 90 degrees."),
        (crank_pin, "The force of the crank pin on the rod over a turn, with the cylinder at 90 degrees."),
    ];
    let plots = plots.iter().map(|(plot, words)| (plot.svg(), (*words).to_owned()));
    let plots =
        plots.chain(polars.iter().map(|(polar, words)| (polar.to_svg_fragment(), (*words).to_owned()))).collect();
    let moving = vec![(animation(scene)?, "One turn; the balance shaft turns against the crank.".to_owned())];
    let about = "A slider-crank that compresses air to eight bar at constant speed: the force in every joint over a \
                 turn, and the balancing masses that leave the least shaking force.";
    Ok(plot::page("A compressor and its balance", about, &[("In motion", moving), ("Over a turn", plots)], rows))
}
