//! The page.

use linkage::drawing::Animation;
use linkage::nalgebra::{Point2, point};
use linkage::simulation::simulate;

use crate::closing::{END, Moment, Run};
use crate::plot::{self, Plot};

/// In each second of the animation, which plays as fast as the door closes.
const FRAMES: u32 = 16;

fn animation(run: &Run) -> Result<String, Box<dyn std::error::Error>> {
    let closer = &run.scene.mechanism;
    // A second more than it takes.
    let seconds = (run.impacts[run.impacts.len() - 1].t + 1.0).ceil().min(END);
    let count = seconds as u32 * FRAMES;
    let times = (0..=count).map(|frame| seconds * f64::from(frame) / f64::from(count));
    let mut picture = Animation::new("Door closer", seconds);
    for state in simulate(&run.scene, (0.0, run.moments[0].q, 0.0), END, 1e-9)?.at(times) {
        let points = closer.points(&closer.pose_at(&state?.q))?;
        picture.frame([
            ("Hinge", Point2::origin()),
            ("Edge", points.edge),
            ("Spindle", points.spindle),
            ("Elbow", points.elbow),
            ("Shoe", points.shoe),
        ]);
    }
    let (width, gap) = (closer.width, 0.03);
    picture.link(&["Hinge", "Spindle", "Edge"]).link(&["Spindle", "Elbow"]).link(&["Shoe", "Elbow"]);
    picture.ground("Hinge").ground("Shoe").trace("Elbow");
    for wall in [[-0.2, -gap], [width + gap, width + 0.2]] {
        picture.ground_line(wall.map(|x| point![x, 0.0]));
    }
    Ok(picture.to_svg()?)
}

pub fn page(run: &Run, rows: &[[String; 2]]) -> Result<String, Box<dyn std::error::Error>> {
    let angle = |state: &Moment| [state.t, state.q.door.to_degrees()];
    let rate = |state: &Moment| [state.t, state.rates.door];
    let first = run.impacts[0].t;
    let rest = run.impacts[run.impacts.len() - 1].t;
    let near = |state: &&Moment| state.t > first - 0.04 && state.t < rest + 0.1;
    let bounces = || run.moments.iter().filter(near);
    let hits = || run.impacts.iter();
    // The rate jumps at an impact: its curve goes straight down to the rebound.
    let plots = [
        (
            Plot::new("Angle", "s", "degrees")
                .every(1.0)
                .curve("", run.moments.iter().map(angle))
                .marks("impacts", hits().map(angle)),
            "Let go at rest; near the frame the arms are at their best lever and the oil lets go, so that it latches.",
        ),
        (
            Plot::new("Rate", "s", "rad/s")
                .every(1.0)
                .curve("", run.moments.iter().map(rate))
                .marks("impacts", hits().map(rate)),
            "Slow where the oil brakes, fast for the last degrees.",
        ),
        (
            Plot::new("Bounces", "s", "degrees").curve("", bounces().map(angle)).marks("impacts", hits().map(angle)),
            "Each rebound takes a part of the speed; then it rests, on the stop exactly.",
        ),
        (
            Plot::new("Bounces", "s", "rad/s").curve("", bounces().map(rate)).marks("impacts", hits().map(rate)),
            "What hits the frame with some speed leaves it with 0.35 of that.",
        ),
        (
            Plot::new("Energy", "s", "J")
                .curve("", run.moments.iter().zip(&run.energies).map(|(state, energy)| [state.t, *energy])),
            "Of the spring and of what moves: it never grows.",
        ),
    ];
    let mut figures = vec![(animation(run)?, "From above, as fast as it is.".to_owned())];
    figures.extend(plots.iter().map(|(plot, words)| (plot.svg(), (*words).to_owned())));
    let about = "A door of 40 kg with a closer of two arms: a spring and an oil damper at the spindle, whose valve opens \
                 for the last degrees, and a stop that gives back a part of the speed.";
    Ok(plot::page("A door closer", about, &[("Let go", figures)], rows))
}
