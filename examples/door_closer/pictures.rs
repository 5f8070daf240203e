//! Draws the page.

use linkage::drawing::Animation;
use linkage::nalgebra::{Point2, point};
use linkage::simulation::{Start, simulate};

use linkage_examples::door_closer::closing::{END, Moment, Run};
use linkage_examples::plot::{self, Plot};

/// Frames per second of the animation, which runs in real time.
const FRAMES: u32 = 16;

fn animation(run: &Run) -> Result<String, Box<dyn std::error::Error>> {
    let closer = &run.scene.mechanism;
    // One second after the door has closed.
    let seconds = (run.impacts[run.impacts.len() - 1].t + 1.0).ceil().min(END);
    let count = seconds as u32 * FRAMES;
    let times = (0..=count).map(|frame| seconds * f64::from(frame) / f64::from(count));
    let mut picture = Animation::new("Door closer", seconds);
    for state in simulate(&run.scene, Start { t: 0.0, q: run.moments[0].q, input_rates: 0.0 }, END, 1e-9)?.at(times) {
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
    // The rate jumps at an impact: a vertical line in its curve.
    let plots = [
        (
            Plot::new("Angle", "s", "degrees")
                .every(1.0)
                .curve("", run.moments.iter().map(angle))
                .marks("impacts", hits().map(angle)),
            "Released at rest. Near the frame the arms have their best lever and the damping is low, so that the door latches.",
        ),
        (
            Plot::new("Rate", "s", "rad/s")
                .every(1.0)
                .curve("", run.moments.iter().map(rate))
                .marks("impacts", hits().map(rate)),
            "Slow in the damped range, fast in the last degrees.",
        ),
        (
            Plot::new("Bounces", "s", "degrees").curve("", bounces().map(angle)).marks("impacts", hits().map(angle)),
            "Each impact reduces the speed; finally the door rests exactly on the stop.",
        ),
        (
            Plot::new("Bounces", "s", "rad/s").curve("", bounces().map(rate)).marks("impacts", hits().map(rate)),
            "The door leaves the frame with 0.35 of its impact speed.",
        ),
        (
            Plot::new("Energy", "s", "J")
                .curve("", run.moments.iter().zip(&run.energies).map(|(state, energy)| [state.t, *energy])),
            "Potential energy of the spring plus kinetic energy: it never grows.",
        ),
    ];
    let mut figures = vec![(animation(run)?, "From above, in real time.".to_owned())];
    figures.extend(plots.iter().map(|(plot, words)| (plot.svg(), (*words).to_owned())));
    let about = "A door of 40 kg with a closer of two arms: a spring and an oil damper at the spindle, whose valve opens \
                 for the last degrees, and a stop with restitution.";
    Ok(plot::page("A door closer", about, &[("Motion", figures)], rows))
}
