//! A single-cylinder engine on a brake, with gas pressure, ring friction and flywheel.
//!
//! `cargo run --example engine` simulates it from 200 rad/s, prints performance and joint forces, and writes
//! `target/engine.html`: an animation, and speed, torque, pressure and forces over the crank angle.

use std::error::Error;

mod pictures;

use linkage_examples::engine::indicated;
use linkage_examples::engine::loads::Loads;
use linkage_examples::engine::machine::{CYCLE, Running};
use linkage_examples::engine::run::{Moment, Run};
use linkage_examples::output;

/// The number of four-stroke cycles.
const CYCLES: f64 = 20.0;

fn main() -> Result<(), Box<dyn Error>> {
    let run = Run::new(Running::default(), 200.0, (5.0, CYCLES * CYCLE))?;
    let rows = report(&run)?;
    for [name, value] in &rows {
        println!("{name:44} {value}");
    }
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/engine.html".to_owned());
    let path = output::write(path, &pictures::page(&run, &rows)?)?;
    println!("Pictures: {path}");
    Ok(())
}

/// The maximum of a quantity, and its state.
fn largest<'a, T>(of: &'a [T], quantity: impl Fn(&T) -> f64) -> (f64, &'a T) {
    let better = |best: (f64, &'a T), next: &'a T| if quantity(next) > best.0 { (quantity(next), next) } else { best };
    of[1..].iter().fold((quantity(&of[0]), &of[0]), better)
}

/// The crank angle in degrees since the last firing.
fn degrees(phi: f64) -> f64 {
    phi.rem_euclid(CYCLE).to_degrees()
}

fn report(run: &Run) -> Result<Vec<[String; 2]>, Box<dyn Error>> {
    let (scene, engine) = (&run.scene, &run.scene.mechanism);
    let cycle = run.last_cycles(1.0);
    let loads: Vec<Loads> = cycle.iter().map(|state| Loads::at(scene, state)).collect::<Result<_, _>>()?;
    let pressures: Vec<[f64; 2]> = cycle
        .iter()
        .map(|state| Ok([state.q.phi, engine.outputs(&engine.pose_at(&state.q))?.pressure]))
        .collect::<Result<_, linkage::Error>>()?;
    let (first, last) = (&cycle[0], &cycle[cycle.len() - 1]);
    let mean = (last.q.phi - first.q.phi) / (last.t - first.t);
    let (fastest, _) = largest(cycle, |state| state.rates.phi);
    let (slowest, _) = largest(cycle, |state| -state.rates.phi);
    let (peak, at) = largest(&pressures, |[_, pressure]| *pressure);
    let swept = 2.0 * engine.r * std::f64::consts::PI / 4.0 * engine.bore.powi(2);
    let [gas, rings] = indicated::work(scene, [0.0, CYCLE])?;
    let (twist, twisted) = largest(&loads, |loads| loads.torque);
    let (back, backward) = largest(&loads, |loads| -loads.torque);
    let (gain, gains) = largest(&loads, |loads| loads.acceleration);
    let force = |of: fn(&Loads) -> f64| {
        let (force, at) = largest(&loads, of);
        format!("{:.2} kN at {:.0}°", force / 1e3, degrees(at.phi))
    };
    let account = run.accounts[run.accounts.len() - 1];
    let worst = run.accounts.iter().map(|account| account.gap().abs()).fold(0.0, f64::max);
    let [all_gas, all_rings] = indicated::work(scene, [0.0, last.q.phi])?;
    let by_rings = run.integral(|state| heat_of_rings(scene, state))?;
    assert!(worst < 1e-9 * account.applied, "energy error {worst:e} J");
    let share = |gap: f64| format!("{:.1e} of the work done", gap.abs() / account.applied);
    let rows = [
        ("turns, in seconds", format!("{:.0}, {:.3}", last.q.phi / CYCLE * 2.0, last.t)),
        ("mean speed of the last cycle", format!("{mean:.1} rad/s = {:.0} rpm", mean * 30.0 / std::f64::consts::PI)),
        ("(fastest - slowest) / mean", format!("{:.4}", (fastest + slowest) / mean)),
        ("maximum acceleration of the crank", format!("{:.0} rad/s² at {:.0}°", gain, degrees(gains.phi))),
        ("highest pressure", format!("{:.2} MPa at {:.1}°", peak / 1e6, degrees(at[0]))),
        ("indicated work, over the swept volume", format!("{gas:.1} J, {:.3} MPa", gas / swept / 1e6)),
        ("friction of the rings, over the swept volume", format!("{rings:.1} J, {:.3} MPa", rings / swept / 1e6)),
        ("maximum torque on the flywheel", format!("{twist:.1} N m at {:.0}°", degrees(twisted.phi))),
        ("minimum torque on the flywheel", format!("{:.1} N m at {:.0}°", -back, degrees(backward.phi))),
        ("maximum force on the piston pin", force(|loads| loads.piston_pin.norm())),
        ("maximum force on the crank pin", force(|loads| loads.crank_pin.norm())),
        ("maximum force on the main bearing", force(|loads| loads.bearing.norm())),
        ("maximum side force of the piston", force(|loads| loads.side.abs())),
        ("work of the gas", format!("{:.6} J", account.applied)),
        ("heat of rings and brake", format!("{:.6} J", account.dissipated)),
        ("energy gained since the start", format!("{:.6} J", account.gained)),
        ("largest error of the balance", share(worst)),
        ("work of the gas, from pressure and volume", format!("{all_gas:.6} J, {}", share(all_gas - account.applied))),
        ("heat of the rings, from friction and distance", format!("{all_rings:.6} J, {}", share(all_rings - by_rings))),
    ];
    Ok(rows.map(|(name, value)| [name.to_owned(), value]).into())
}

/// The power dissipated by the rings.
fn heat_of_rings(scene: &Running<f64>, state: &Moment) -> Result<f64, linkage::Error> {
    let all = scene.power(state.t, &state.q, state.rates.phi)?.dissipated;
    Ok(all - scene.brake * state.rates.phi * state.rates.phi)
}
