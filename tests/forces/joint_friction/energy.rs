//! The balance of energy where frictions depend on reactions.

use linkage::simulation::{Start, simulate};
use linkage::{Slider, linkage};

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism Pump {
        param r = 0.1, l = 0.4;
        param m2 = 1, j2 = 0.01, m3 = 0.7, j3 = 0.02, m4 = 1.3, g = 9.81, load = 40, torque = 4, mu = 0.1, rp = 0.02;
        input theta;
        unknown psi, s;
        loop r@theta + l@psi = s@0;
        point O = (0, 0);
        point A = r@theta;
        body crank { mass m2; inertia j2; center (0.4 * r)@theta; angle theta; }
        body rod { mass m3; inertia j3; center A + (0.4 * l)@psi; angle psi; }
        body piston { mass m4; center A + l@psi; }
        scene Dry {
            inertia;
            gravity (0, -g);
            torque torque on theta;
            force (-load, 0) at A + l@psi;
            friction mu, rp, reaction on theta;
            friction mu, rp, reaction on psi - theta;
            friction mu, reaction on s;
            energy;
            power;
        }
    }
}

#[test]
fn what_flows_is_accounted_for() {
    let scene = Dry::default();
    let q = scene.mechanism.assemble(0.7, PumpBranch { psi_s: Slider::Far }).unwrap().coordinates();
    let start = scene.energy(&q, 8.0).unwrap();
    let (mut applied, mut dissipated) = (0.0, 0.0);
    let mut simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 8.0 }, 0.3, 1e-12).unwrap();
    let mut last = 0.0;
    let mut times = Vec::new();
    while let Some(state) = simulation.advance().unwrap() {
        times.push(state.t);
    }
    // Gauss-Legendre points of each step; the frictions jump at the ends of steps only.
    let nodes = [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
    let mut simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 8.0 }, 0.3, 1e-12).unwrap();
    let mut at = Vec::new();
    for &t in &times {
        let parts = 32;
        for part in 0..parts {
            let width = (t - last) / f64::from(parts);
            at.extend(nodes.map(|(place, weight)| (last + (f64::from(part) + place) * width, weight * width)));
        }
        last = t;
    }
    let instants: Vec<f64> = at.iter().map(|(t, _)| *t).collect();
    let states: Vec<_> = simulation.at(instants).collect::<Result<_, _>>().unwrap();
    for (state, (_, weight)) in states.iter().zip(&at) {
        let power = scene.power(state.t, &state.q, state.rates.theta).unwrap();
        applied += weight * power.applied;
        dissipated += weight * power.dissipated;
    }
    let end = simulation.state();
    let after = scene.energy(&end.q, end.rates.theta).unwrap();
    let gained = after.kinetic + after.potential - start.kinetic - start.potential;
    let gap = gained - applied + dissipated;
    println!("applied {applied}, dissipated {dissipated}, gained {gained}, gap {gap:e}");
    assert!(dissipated > 0.1, "{dissipated}");
    assert!(gap.abs() < 1e-9 * (applied.abs() + dissipated), "{gap:e}");
}

#[test]
fn a_swing_comes_to_rest_and_stays() {
    let scene = Dry { torque: 0.0, load: 0.0, mu: 0.3, ..Dry::default() };
    let q = scene.mechanism.assemble(-1.2, PumpBranch { psi_s: Slider::Far }).unwrap().coordinates();
    let mut simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 1.0 }, 20.0, 1e-9).unwrap();
    simulation.finish(|_, _| true).unwrap();
    assert_eq!(simulation.state().rates.theta, 0.0);
}
