//! Draws the page.

use linkage::drawing::Animation;
use linkage::nalgebra::{Point2, point, vector};
use linkage::simulation::{Start, simulate};

use crate::locking::{toggle, torques, way, wedge};
use linkage_examples::plot::{self, Plot};

/// Frames of an animation, and its duration in seconds.
const FRAMES: u32 = 60;
const SECONDS: f64 = 3.0;

type Picture = Result<String, Box<dyn std::error::Error>>;

/// The wedge for a tenth of a second after its release.
fn sliding(alpha: f64) -> Picture {
    let (scene, q) = wedge(alpha)?;
    let times = (0..=FRAMES).map(|frame| 0.1 * f64::from(frame) / f64::from(FRAMES));
    let title = format!("Wedge of {:.0}°", alpha.to_degrees());
    let mut picture = Animation::new(&title, SECONDS);
    let slope = vector![alpha.cos(), -alpha.sin()];
    for state in simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 0.1, 1e-9)?.at(times) {
        let state = state?;
        let points = scene.mechanism.points(&scene.mechanism.pose_at(&state.q))?;
        // A rounded block touches the slope below its end.
        let (toe, block) = (points.toe, points.block + vector![0.0, 0.035]);
        let heel = point![toe.x - 0.45, 0.0];
        let top = toe - slope * (0.45 / alpha.cos());
        picture.frame([
            ("Toe", toe),
            ("Heel", heel),
            ("Top", top),
            ("Block", block),
            ("Head", block + vector![0.0, 0.12]),
        ]);
    }
    picture.link(&["Toe", "Heel", "Top"]).link(&["Block", "Head"]);
    picture.ground_line([[-0.4, -0.012], [0.75, -0.012]].map(Point2::from));
    Ok(picture.to_svg()?)
}

/// The toggle after its release.
fn opening(theta: f64, time: f64) -> Picture {
    let (scene, q) = toggle(theta)?;
    let times = (0..=FRAMES).map(|frame| time * f64::from(frame) / f64::from(FRAMES));
    let title = format!("Lever at {:.1}°", theta.to_degrees());
    let mut picture = Animation::new(&title, SECONDS);
    for state in simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, time, 1e-9)?.at(times) {
        let state = state?;
        let points = scene.mechanism.points(&scene.mechanism.pose_at(&state.q))?;
        picture.frame([("O", points.o), ("A", points.a), ("B", points.b), ("Jaw", points.b + vector![0.02, 0.0])]);
    }
    picture.ground("O").link(&["A", "B"]).link(&["B", "Jaw"]).crank(&["O", "A"]);
    picture.ground_line([[0.08, -0.01], [0.17, -0.01]].map(Point2::from));
    Ok(picture.to_svg()?)
}

pub fn page([steepest, knee]: [f64; 2], rows: &[[String; 2]]) -> Picture {
    let angles = (2..=40).map(|step| f64::from(step).to_radians());
    let ways = angles.map(|alpha| Ok([alpha.to_degrees(), way(alpha, 0.05)? * 1e3]));
    let ways: Vec<[f64; 2]> = ways.collect::<Result<_, linkage::Error>>()?;
    let levers = (1..=32).map(|step| (f64::from(step) / 4.0).to_radians());
    let torques = levers.map(|theta| Ok((theta.to_degrees(), torques(theta)?)));
    let torques: Vec<(f64, [f64; 3])> = torques.collect::<Result<_, linkage::Error>>()?;
    let curve = |at: usize| torques.iter().map(move |(theta, torques)| [*theta, torques[at]]);
    let plots = [
        (
            Plot::new("Wedge", "angle, degrees", "mm in 0.05 s")
                .curve("way", ways)
                .marks("angle of friction", [[steepest.to_degrees(), 0.0]]),
            "Up to the angle of friction it stays, whatever the load; beyond, it is pushed away.",
        ),
        (
            Plot::new("Toggle", "angle of the lever, degrees", "N m")
                .every(2.0)
                .curve("no friction", curve(0))
                .curve("closes", curve(1))
                .curve("opens", curve(2))
                .marks("without a hand", [[knee.to_degrees(), 0.0]]),
            "The torque of the hand: it closes below one curve and opens above the other; between them friction in the pins \
             holds the clamp.",
        ),
    ];
    let plots = plots.iter().map(|(plot, words)| (plot.svg(), (*words).to_owned())).collect();
    let moving = vec![
        (sliding(steepest * 0.95)?, "Below the angle of friction: it stays.".to_owned()),
        (sliding(steepest * 1.3)?, "Above: the block comes down.".to_owned()),
        (opening(knee * 0.98, 0.02)?, "A knee within two friction circles: closed without a hand.".to_owned()),
        (opening(knee * 1.3, 0.02)?, "Outside of them: the workpiece opens the clamp.".to_owned()),
    ];
    let about = "Friction by the force in its own joint decides whether a clamp stays closed: a wedge by its angle, a \
                 toggle by the friction circles of its pins.";
    Ok(plot::page("Clamps that lock themselves", about, &[("Released", moving), ("Limits", plots)], rows))
}
