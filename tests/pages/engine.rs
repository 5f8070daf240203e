//! The example `engine`: its energy accounts, its joint forces and its cycle, computed by other methods.

use linkage_oracle::close;
use std::f64::consts::PI;

use linkage::nalgebra::{Point2, Vector2, vector};
use linkage::{Mode, Slider};

use linkage_examples::engine::indicated;
use linkage_examples::engine::loads::Loads;
use linkage_examples::engine::machine::{CYCLE, EngineBranch, Running};
use linkage_examples::engine::run::Run;

fn run() -> Run {
    Run::new(Running::default(), 200.0, (5.0, 3.0 * CYCLE)).unwrap()
}

/// Power integrated over the motion, against the energy, and pressure over volume and friction over distance.
#[test]
fn energy_is_accounted_for() {
    let run = run();
    let (start, last) = (run.moments[0].q.phi, run.moments[run.moments.len() - 1]);
    close("end", last.q.phi, 3.0 * CYCLE, 1e-12);
    let end = run.accounts[run.accounts.len() - 1];
    assert!(end.applied > 1000.0 && end.dissipated > 500.0 && end.gained > 100.0, "{end:?}");
    for account in &run.accounts {
        close("energy", account.gap(), 0.0, 1e-9 * end.applied);
    }
    let [gas, rings] = indicated::work(&run.scene, [start, last.q.phi]).unwrap();
    close("gas", end.applied, gas, 1e-12 * end.applied);
    let brake = run.integral(|state| Ok(run.scene.brake * state.rates.phi.powi(2))).unwrap();
    close("heat", end.dissipated, rings + brake, 1e-12 * end.applied);
}

/// The friction of the rings changes its direction at every dead centre, and only there.
#[test]
fn rings_slip_both_ways() {
    let run = run();
    let mut turns = 0;
    for state in run.ends().skip(1) {
        if state.changes().next().is_some() {
            turns += 1;
            close("dead centre", (state.q.phi / PI).round() * PI, state.q.phi, 1e-9);
        } else if (state.q.phi / PI - (state.q.phi / PI).round()).abs() > 1e-6 {
            let expected = if state.rates.z > 0.0 { Mode::SlipForward } else { Mode::SlipBackward };
            assert_eq!(state.mode("friction on z"), Some(expected), "{state:?}");
        }
    }
    // Three firings and nine dead centres, but neither the first, where it begins, nor the last, where it ends.
    assert_eq!(turns, 11);
}

/// Newton and Euler body by body, by forces from joint to joint; the shaft's work by what it does to flywheel and
/// brake.
#[test]
fn joints_carry_the_bodies() {
    let run = run();
    let (scene, engine) = (&run.scene, &run.scene.mechanism);
    for state in run.moments.iter().skip(5).step_by(97) {
        let loads = Loads::at(scene, state).unwrap();
        let pose = engine.pose_at(&state.q);
        let points = engine.points(&pose).unwrap();
        let velocity = engine.velocity(&pose, state.rates.phi).unwrap();
        let acceleration = engine.acceleration(&pose, &velocity, loads.acceleration).unwrap();
        let size = loads.bearing.norm() + loads.piston_pin.norm();
        assert_eq!(loads.phi, state.q.phi);
        // The piston: gas, rings, weight, and the pin.
        let gas = -(engine.outputs(&pose).unwrap().pressure - scene.ambient) * PI / 4.0 * engine.bore.powi(2);
        let along = gas + loads.drag - scene.m4 * scene.g + loads.piston_pin.x;
        close("piston", along, scene.m4 * acceleration.z, 1e-11 * size);
        // The rod about its centre, under the forces of the crank and, reversed, of the piston.
        let moment = |about: Point2<f64>, at: Point2<f64>, force: Vector2<f64>| (at - about).perp(&force);
        let rod = moment(points.rod, points.pin, loads.crank_pin) - moment(points.rod, points.piston, loads.piston_pin);
        close("rod", rod, scene.j3 * acceleration.psi, 1e-11 * size * engine.l);
        // The crank about its bearing: the rod's force, its weight, the flywheel.
        let weight = moment(Point2::origin(), points.crank, vector![-scene.g * scene.m2, 0.0]);
        let inertia = scene.j2 + scene.m2 * engine.b2.powi(2);
        let crank = moment(Point2::origin(), points.pin, -loads.crank_pin) + weight - loads.torque;
        close("crank", crank, inertia * loads.acceleration, 1e-11 * size * engine.l);
        let flywheel = loads.torque - scene.brake * state.rates.phi;
        close("flywheel", flywheel, scene.flywheel * loads.acceleration, 1e-10 * size * engine.l);
        close("side", loads.side, loads.piston_pin.y, 0.0);
    }
    let work = run.integral(|state| Ok(Loads::at(scene, state)?.torque * state.rates.phi)).unwrap();
    let brake = run.integral(|state| Ok(scene.brake * state.rates.phi.powi(2))).unwrap();
    let [first, last] = [run.moments[0], run.moments[run.moments.len() - 1]].map(|state| state.rates.phi);
    let stored = scene.flywheel / 2.0 * (last * last - first * first);
    close("shaft", work, brake + stored, 1e-9 * work);
    let cycle = run.last_cycles(1.0);
    assert!(cycle[0].q.phi >= 2.0 * CYCLE && cycle[0].q.phi < 2.0 * CYCLE + 1.0);
}

/// Compression is a polytrope until the mixture burns, expansion is one after; both have their work in closed form.
#[test]
fn the_cycle_by_hand() {
    let scene = Running::default();
    let engine = &scene.mechanism;
    let at = |degrees: f64| {
        let pose = engine.assemble(degrees.to_radians(), EngineBranch { psi_z: Slider::Far }).unwrap();
        engine.outputs(&pose).unwrap()
    };
    close("swept", at(180.0).volume - at(0.0).volume, PI / 2.0 * engine.bore.powi(2) * engine.r, 1e-18);
    close("compression", at(180.0).volume / at(0.0).volume, engine.compression, 1e-13);
    for ([from, to], exponent) in [([-160.0, -20.0], engine.kc), ([110.0, 130.0], engine.ke)] {
        let [first, last] = [at(from), at(to)];
        let ratio = (first.volume / last.volume).powf(exponent);
        close("pressure", last.pressure / first.pressure, ratio, 1e-12 * ratio);
        let gas = (last.pressure * last.volume - first.pressure * first.volume) / (1.0 - exponent);
        let work = gas - scene.ambient * (last.volume - first.volume);
        let [found, _] = indicated::work(&scene, [from, to].map(f64::to_radians)).unwrap();
        close("work", found, work, 1e-12 * work.abs());
    }
    // The hottest state by the ideal gas: `heat` times the temperature of compression alone.
    let hot = at(110.0);
    let full = at(180.0).volume;
    let shrunk = full / hot.volume;
    let alone = engine.intake * engine.compression.powf(engine.kc - engine.ke) * shrunk.powf(engine.ke);
    close("heat", hot.pressure / alone, engine.heat, 1e-9);
    // The valves: if one is open, the cylinder has the pressure of its manifold.
    for (degrees, pressure) in [(250.0, engine.exhaust), (450.0, engine.intake)] {
        close("manifold", at(degrees).pressure, pressure, 1e-15 * pressure);
    }
    // One cycle after the other.
    for degrees in [-190.0, -17.0, 40.0, 155.0, 361.0] {
        close("period", at(degrees + 720.0).pressure / at(degrees).pressure, 1.0, 1e-11);
    }
}
