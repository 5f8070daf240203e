//! Draws the page.

use linkage::chart::Polar;
use linkage::drawing::Animation;
use linkage::nalgebra::{Point2, Vector2, point, vector};
use linkage::simulation::{Start, simulate};
use linkage::{PositionError, Slider};

use linkage_examples::engine::loads::Loads;
use linkage_examples::engine::machine::{CYCLE, Engine, EngineBranch, EngineCoordinates};
use linkage_examples::engine::run::{Moment, Run};
use linkage_examples::plot::{self, Plot};

/// Frames of the animation for one cycle, and its duration in seconds: slow motion.
const FRAMES: u32 = 96;
const SECONDS: f64 = 6.0;

/// The height of the piston above and below its pin.
const CROWN: f64 = 0.022;
const SKIRT: f64 = 0.018;

/// Rotates by a quarter turn: x of the engine points up.
fn up(at: Point2<f64>) -> Point2<f64> {
    point![-at.y, at.x]
}

/// The points at a position.
fn frame(engine: &Engine<f64>, q: &EngineCoordinates<f64>) -> Result<[(&'static str, Point2<f64>); 5], PositionError> {
    let points = engine.points(&engine.pose_at(q))?;
    let (pin, piston) = (up(points.pin), up(points.piston));
    let middle = pin + (piston - pin) / 3.0;
    let crown = piston + vector![0.0, CROWN];
    Ok([("O", Point2::origin()), ("A", pin), ("G", middle), ("B", piston), ("Crown", crown)])
}

/// Adds the parts at these points.
fn draw(picture: &mut Animation, engine: &Engine<f64>) {
    let (wall, stroke) = (engine.bore / 2.0, 2.0 * engine.r);
    let top = engine.r + engine.l + CROWN;
    let (head, foot) = (top + stroke / (engine.compression - 1.0), top - 1.25 * stroke);
    let cylinder = [[wall, foot], [wall, head], [-wall, head], [-wall, foot]];
    let piston = [[-SKIRT, wall], [CROWN, wall], [CROWN, -wall], [-SKIRT, -wall]];
    picture.plate("B", "Crown", piston.map(Vector2::from)).link(&["A", "G", "B"]).ground("O");
    picture.ground_line(cylinder.map(Point2::from));
}

fn animation(run: &Run) -> Result<String, Box<dyn std::error::Error>> {
    let cycle = run.last_cycles(1.0);
    let (first, last) = (cycle[0], cycle[cycle.len() - 1]);
    let times = (0..=FRAMES).map(|frame| first.t + (last.t - first.t) * f64::from(frame) / f64::from(FRAMES));
    let mut picture = Animation::new("Engine", SECONDS);
    for state in
        simulate(&run.scene, Start { t: first.t, q: first.q, input_rates: first.rates.phi }, last.t, 1e-9)?.at(times)
    {
        picture.frame(frame(&run.scene.mechanism, &state?.q)?);
    }
    draw(&mut picture, &run.scene.mechanism);
    Ok(picture.crank(&["O", "A"]).trace("G").to_svg()?)
}

/// A still picture of the engine.
fn station(engine: &Engine<f64>, (stroke, degrees): (&str, f64)) -> Result<String, Box<dyn std::error::Error>> {
    let pose = engine.assemble(degrees.to_radians(), EngineBranch { psi_z: Slider::Far })?;
    let mut picture = Animation::new(stroke, SECONDS);
    picture.frame(frame(engine, &pose.coordinates())?);
    draw(&mut picture, engine);
    Ok(picture.link(&["O", "A"]).to_svg()?)
}

pub fn page(run: &Run, rows: &[[String; 2]]) -> Result<String, Box<dyn std::error::Error>> {
    let (scene, engine) = (&run.scene, &run.scene.mechanism);
    let cycle = run.last_cycles(1.0);
    let start = cycle[cycle.len() - 1].q.phi - CYCLE;
    let angle = |state: &Moment| (state.q.phi - start).to_degrees();
    let loads: Vec<Loads> = cycle.iter().map(|state| Loads::at(scene, state)).collect::<Result<_, _>>()?;
    let over_angle = |quantity: &dyn Fn(&Loads) -> f64| -> Vec<[f64; 2]> {
        cycle.iter().zip(&loads).map(|(state, loads)| [angle(state), quantity(loads)]).collect()
    };
    let outputs = cycle.iter().map(|state| engine.outputs(&engine.pose_at(&state.q))).collect::<Result<Vec<_>, _>>()?;
    let crank = "crank angle, degrees";
    let mean = (cycle[cycle.len() - 1].q.phi - cycle[0].q.phi) / (cycle[cycle.len() - 1].t - cycle[0].t);
    let load = scene.brake * mean;
    let turns = |state: &&Moment| state.q.phi > start - 0.1 && state.changes().next().is_some();
    let plots = [
        (
            Plot::new("Speed", "turns", "rad/s")
                .curve("", run.moments.iter().map(|state| [state.q.phi / CYCLE * 2.0, state.rates.phi])),
            "From 200 rad/s until the brake balances the gas. The shaft is faster after each firing.",
        ),
        (
            Plot::new("Speed", crank, "rad/s")
                .every(180.0)
                .curve("", cycle.iter().map(|state| [angle(state), state.rates.phi]))
                .marks("rings change direction", run.ends().filter(turns).map(|state| [angle(state), state.rates.phi])),
            "The last cycle: the flywheel returns in three strokes the energy of one.",
        ),
        (
            Plot::new("Torque", crank, "N m")
                .every(180.0)
                .curve("on the flywheel", over_angle(&|loads| loads.torque))
                .curve("of the brake, mean", [[0.0, load], [720.0, load]]),
            "Torque at the flange of the crank, from gas, inertia, weight and friction.",
        ),
        (
            Plot::new("Pressure", "cm³", "MPa")
                .curve("", outputs.iter().map(|outputs| [outputs.volume * 1e6, outputs.pressure / 1e6])),
            "The enclosed area is the work of the gas; it agrees with the simulation to the last digits.",
        ),
        (
            Plot::new("Pressure", crank, "MPa")
                .every(180.0)
                .curve("", cycle.iter().zip(&outputs).map(|(state, of)| [angle(state), of.pressure / 1e6])),
            "Ignition 20 degrees before top dead centre; combustion by Wiebe's function.",
        ),
        (
            Plot::new("Forces", crank, "kN")
                .every(180.0)
                .curve("piston pin", over_angle(&|loads| loads.piston_pin.norm() / 1e3))
                .curve("crank pin", over_angle(&|loads| loads.crank_pin.norm() / 1e3))
                .curve("main bearing", over_angle(&|loads| loads.bearing.norm() / 1e3)),
            "Inertia relieves the pins during combustion, and loads them otherwise.",
        ),
        (
            Plot::new("Forces on the cylinder", crank, "kN")
                .every(180.0)
                .curve("side of the piston", over_angle(&|loads| loads.side / 1e3))
                .curve("friction of the rings", over_angle(&|loads| -loads.drag / 1e3)),
            "Both change sign at the dead centres; inertia makes the side force change sign in between, too.",
        ),
        (
            Plot::new("Energy", "s", "kJ")
                .curve("work of gas", run.accounts.iter().map(|account| [account.t, account.applied / 1e3]))
                .curve("heat", run.accounts.iter().map(|account| [account.t, account.dissipated / 1e3]))
                .curve("gained", run.accounts.iter().map(|account| [account.t, account.gained / 1e3])),
            "The work of the gas becomes heat in rings and brake, or kinetic energy.",
        ),
    ];
    let strokes =
        [("Firing", 15.0_f64), ("Expansion", 75.0), ("Exhaust", 255.0), ("Intake", 430.0), ("Compression", 610.0)];
    let stations = strokes
        .into_iter()
        .map(|(stroke, angle)| {
            let pose = engine.assemble(angle.to_radians(), EngineBranch { psi_z: Slider::Far })?;
            let pressure = engine.outputs(&pose)?.pressure / 1e6;
            Ok((station(engine, (stroke, angle))?, format!("{stroke}: {angle:.0}°, {pressure:.2} MPa.")))
        })
        .collect::<Result<Vec<_>, Box<dyn std::error::Error>>>()?;
    let mut moving = vec![(animation(run)?, "One four-stroke cycle, in slow motion.".to_owned())];
    moving.extend(stations);
    let bearing = Polar::new("Main bearing", "kN")
        .curve("", loads.iter().map(|loads| [-loads.bearing.y / 1e3, loads.bearing.x / 1e3]));
    let words = "The force of the bearing on the crank, over one cycle; 90 degrees are along the cylinder.";
    let plots = plots.iter().map(|(plot, words)| (plot.svg(), (*words).to_owned()));
    let plots = plots.chain([(bearing.to_svg_fragment(), words.to_owned())]).collect();
    let about = "A four-stroke cylinder of half a litre, driven by gas pressure, with inertia of \
                 crank, rod, piston and flywheel, weight, dry friction of the rings, an eddy current brake.";
    let sections = [("In motion", moving), ("Over the cycle", plots)];
    Ok(plot::page("An engine on a brake", about, &sections, rows))
}
