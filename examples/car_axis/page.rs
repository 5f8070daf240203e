//! Draws the page.

use linkage::PositionError;
use linkage::drawing::Animation;
use linkage::nalgebra::Point2;
use linkage::simulation::{Start, State, simulate};

use linkage_examples::car_axis::elsewhere::{DOP853, FAILURES};
use linkage_examples::car_axis::ride::Ride;
use linkage_examples::car_axis::runs::{REPETITIONS, Run, ends};
use linkage_examples::plot::{self, Plot, Table};
use linkage_gallery::car_axis::Riding;
use linkage_gallery::car_axis_motion::{
    END, END_TIME, END_VELOCITIES, PUBLISHED_END, PUBLISHED_VELOCITIES, START, START_RATES,
};

/// The duration of the animation in seconds, four times that of the ride.
const SECONDS: f64 = 12.0;

/// The frames of the animation: the fastest vibration has 17 of them.
const FRAMES: u32 = 360;

fn animation(ride: &Ride) -> Result<String, Box<dyn std::error::Error>> {
    let axis = &ride.scene.mechanism;
    let times = (0..=FRAMES).map(|frame| END_TIME * f64::from(frame) / f64::from(FRAMES));
    let start = Start { t: 0.0, q: START, input_rates: START_RATES };
    let mut picture = Animation::new("Car axis", SECONDS);
    for state in simulate(&ride.scene, start, END_TIME, 1e-9)?.at(times) {
        let state = state?;
        let points = axis.points(&axis.pose_at(&state.q))?;
        // The line across the axis along which the left end slides.
        let guide = points.left * (0.75 * axis.l / state.q.s);
        picture.frame([
            ("O", Point2::origin()),
            ("Wheel", points.wheel),
            ("Guide", guide),
            ("Left", points.left),
            ("Right", points.right),
        ]);
    }
    picture.ground("O").crank(&["O", "Wheel"]).bent(&["Wheel", "O", "Guide"]).link(&["Left", "Right"]);
    picture.sleeve("Left", ["O", "Guide"]).spring("O", "Left").spring("Wheel", "Right");
    picture.trace("Right");
    Ok(picture.to_svg()?)
}

/// A coordinate of the ends over time.
fn heights(ride: &Ride, index: usize) -> Result<Vec<[f64; 2]>, PositionError> {
    ride.moments.iter().map(|state| Ok([state.t, ends(state, &ride.scene)?[0][index]])).collect()
}

fn digits(error: f64) -> f64 {
    -error.log10()
}

fn cost(high: &[Run], low: &[Run]) -> String {
    let of = |runs: &[Run]| -> Vec<[f64; 2]> {
        runs.iter().map(|run| [digits(run.errors[0]), 1e-3 * run.evaluations as f64]).collect()
    };
    let elsewhere = DOP853.iter().map(|run| [digits(run.positions), 1e-3 * run.evaluations as f64]);
    Plot::new("Right-hand sides", "correct digits of the positions", "thousands")
        .every(2.0)
        .curve("order 8", of(high))
        .curve("order 5", of(low))
        .marks("DOP853 of scipy", elsewhere)
        .svg()
}

fn figures(ride: &Ride) -> Result<Vec<(String, String)>, Box<dyn std::error::Error>> {
    let scene = &ride.scene;
    let over_time = |value: &dyn Fn(&State<Riding>) -> f64| -> Vec<[f64; 2]> {
        ride.moments.iter().map(|state| [state.t, value(state)]).collect()
    };
    let springs = ride.moments.iter().map(|state| {
        let pose = scene.mechanism.pose_at(&state.q);
        Ok([state.t, scene.mechanism.outputs(&pose)?.spring])
    });
    let springs = springs.collect::<Result<Vec<_>, PositionError>>()?;
    let bumps = |state: &State<Riding>| scene.r * (scene.w * state.t).sin();
    let torques = ride.moments.iter().zip(&ride.torques).map(|(state, torque)| [state.t, *torque]);
    let plots = [
        (
            Plot::new("Height", "time", "")
                .every(0.5)
                .curve("left end", heights(ride, 1)?)
                .curve("right end", heights(ride, 3)?)
                .curve("bumps", over_time(&bumps)),
            "The right wheel follows the bumps; the left one stays at the origin.",
        ),
        (
            Plot::new("Springs", "time", "length")
                .every(0.5)
                .curve("left", over_time(&|state| state.q.s))
                .curve("right", springs),
            "The springs are stiff and the chassis is light: the right spring vibrates a few times for each bump.",
        ),
        (
            Plot::new("Torque of the bumps on the axis", "time", "").every(0.5).curve("", torques),
            "Inverse dynamics of the driven angle: its work is the energy that the chassis gains.",
        ),
    ];
    let slowed = "The motion to t = 3, four times slower if the unit of time is a second.";
    let film = (animation(ride)?, slowed.to_owned());
    Ok([film].into_iter().chain(plots.iter().map(|(plot, words)| (plot.svg(), (*words).to_owned()))).collect())
}

/// The runs by method and tolerance.
fn runs(high: &[Run], low: &[Run]) -> Table {
    let head = ["method", "tolerance", "positions", "velocities", "steps", "right-hand sides", "ms"];
    let ours = [("order 8(5,3)", high), ("order 5(4)", low)].into_iter().flat_map(|(method, runs)| {
        runs.iter().map(move |run| {
            let [positions, velocities] = run.errors.map(|error| format!("{error:.1e}"));
            let [steps, evaluations] = [run.steps, run.evaluations].map(|count| count.to_string());
            let [tolerance, time] = [format!("{:.0e}", run.tolerance), format!("{:.2}", run.milliseconds)];
            vec![method.to_owned(), tolerance, positions, velocities, steps, evaluations, time]
        })
    });
    let elsewhere = DOP853.iter().map(|run| {
        let velocities = run.velocities.map_or_else(String::new, |error| format!("{error:.1e}"));
        let [steps, evaluations] = [run.steps, run.evaluations].map(|count| count.to_string());
        let positions = format!("{:.1e}", run.positions);
        vec![
            "scipy's DOP853".to_owned(),
            format!("{:.0e}", run.tolerance),
            positions,
            velocities,
            steps,
            evaluations,
            String::new(),
        ]
    });
    let unoptimised = if cfg!(debug_assertions) { " The times are for unoptimised code." } else { "" };
    let remark = format!(
        "The largest relative errors at t = 3. Those of simulate are against 40 digits, and the time is that of the fastest of \
         {REPETITIONS}.{unoptimised} The runs of scipy were computed independently, with the four states that are left when the \
         constraints are solved by hand. Their errors are against the figures of the test set, whose own are 6.5e-13 and \
         5.7e-10."
    );
    Table { name: "Runs", head: head.map(str::to_owned).to_vec(), rows: ours.chain(elsewhere).collect(), remark }
}

/// The end of the motion, published, with 40 digits, and found.
fn end(found: [[f64; 4]; 2]) -> Table {
    let names = ["left x", "left y", "right x", "right y"];
    let row = |name: String, [published, exact, found]: [f64; 3]| {
        vec![name, format!("{published:.15}"), format!("{exact:.15}"), format!("{:.1e}", (found / exact - 1.0).abs())]
    };
    let of = |kind: &'static str, published: [f64; 4], exact: [f64; 4], found: [f64; 4]| {
        (0..4).map(move |k| row(format!("{}{kind}", names[k]), [published[k], exact[k], found[k]]))
    };
    let [at, moving] = found;
    let rows =
        of("", PUBLISHED_END, END, at).chain(of(", rate", PUBLISHED_VELOCITIES, END_VELOCITIES, moving)).collect();
    let head = ["", "test set", "with 40 digits", "error at 1e-12"].map(str::to_owned).to_vec();
    let remark = "Published in the Test Set for Initial Value Problem Solvers, release 2.4, problem \"car axis\" (F. Mazzia and \
                  C. Magherini, 2008). The 40 digits are by extrapolation of order 32 in its four coordinates with two \
                  multipliers; two lengths of the steps give the same 28 digits."
        .to_owned();
    Table { name: "At t = 3", head, rows, remark }
}

/// The solvers that do not reach the end elsewhere.
fn failures() -> Table {
    let rows = FAILURES.iter().flat_map(|formulation| {
        formulation.outcomes.iter().map(|[solver, outcome]| {
            let tolerance = format!("{:.0e}", formulation.tolerance);
            vec![(*solver).to_owned(), formulation.name.to_owned(), tolerance, (*outcome).to_owned()]
        })
    });
    let head = ["solver", "formulation", "tolerance", "outcome"].map(str::to_owned).to_vec();
    let remark = "Fourteen pairs of solver and formulation that SciMLBenchmarks.jl lists on its page \"Car Axis DAE Benchmark\", \
                  as printed in 2026 with ModelingToolkit 11.43.1; a later version of the page no longer lists the five of \
                  the reduced form. RADAU5 of E. Hairer and G. Wanner succeeds there at 1e-12; it needs the differentiation \
                  index of each variable as an input."
        .to_owned();
    Table { name: "Solvers that fail elsewhere", head, rows: rows.collect(), remark }
}

/// The page.
///
/// # Errors
/// Those of the positions, the simulation and the drawing.
pub fn html(ride: &Ride, high: &[Run], low: &[Run]) -> Result<String, Box<dyn std::error::Error>> {
    let about = "A hard problem of differential-algebraic equations: a chassis on two stiff springs, of which the right one \
                 stands on a wheel that rides over bumps, and the left one stays perpendicular to the axis. As four \
                 coordinates with two constraints it has index 3. As a linkage it is an open chain of three inputs, of \
                 which the bumps drive one: there is no constraint to solve, and an explicit method rides over them.";
    let chart =
        "Evaluations of the equations of motion by correct digits of the positions. Those of scipy are counted by the \
                 figures of the test set, which have twelve."
            .to_owned();
    let sections = [("Motion", figures(ride)?), ("Cost", vec![(cost(high, low), chart)])];
    let found = ends(&ride.moments[ride.moments.len() - 1], &ride.scene)?;
    let [gained, work] = ride.balance;
    let [least, most] = ride.energies;
    let row = |name: &str, value: f64| vec![name.to_owned(), format!("{value:.12}")];
    let balance = Table {
        name: "Energy",
        head: Vec::new(),
        rows: vec![
            row("least energy of the ride", least),
            row("largest energy", most),
            row("energy gained from start to end", gained),
            row("work of the bumps", work),
        ],
        remark:
            "Kinetic and potential energy; the work is the integral of the torque on the axis over its angle, by Gauss \
                 quadrature within each step."
                .to_owned(),
    };
    Ok(plot::page_with_tables("Car axis", about, &sections, &[runs(high, low), end(found), balance, failures()]))
}
