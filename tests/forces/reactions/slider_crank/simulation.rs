//! Along a simulation over dead points, with frictions by the reactions of a pin and of the guide.

use linkage::simulation::{Start, simulate};

use super::*;

/// Every so many steps the forces are compared.
const STEPS: usize = 30;

/// With the friction forces that were found, the forces in all joints are those by hand, and each friction is its
/// coefficient times the force by hand.
#[test]
fn along_a_simulation() {
    let random = Random::new(6);
    let mut instants = 0;
    for run in 0..3 {
        let (scene, q) = at_random!(random, Worn);
        let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 40.0 }, 0.4, 1e-9).unwrap();
        for step in 0.. {
            let Some(state) = motion.advance().unwrap() else { break };
            if step % STEPS > 0 || state.changes().next().is_some() {
                continue;
            }
            let loads = motion.loads().unwrap();
            assert!(loads.are_unique);
            let mut by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &state.q, state.rates.phi);
            let end = by_hand.machine.at(&by_hand.pins[2]);
            by_hand.machine.force(&end, [-scene.p, 0.0]);
            let alongs = [by_hand.turn(), by_hand.stroke.clone(), Along::Turn([by_hand.rod, by_hand.crank])];
            let forces = [scene.torque, loads.contacts[0], loads.contacts[1]];
            for (along, force) in alongs.into_iter().zip(forces) {
                by_hand.machine.load(along, Law::Force(force));
            }
            let solution = by_hand.machine.solve();
            let found = loads.joints;
            let at = format!("run {run}, {} s", state.t);
            let mut all = compared!(by_hand, found, solution);
            let [x, y] = solution.pin(&by_hand.pins[1], 1);
            let [normal, _] = solution.guide(by_hand.slide);
            let journal = -scene.mu * scene.radius * x.hypot(y) * (state.rates.psi - state.rates.phi).signum();
            let slide = -scene.mu * normal.abs() * state.rates.z.signum();
            let length = by_hand.length;
            all.push(("friction of the guide", [loads.contacts[0], 0.0], [slide, 0.0]));
            all.push(("friction of the pin", [loads.contacts[1] / length, 0.0], [journal / length, 0.0]));
            compare(&at, &all);
            instants += 1;
        }
    }
    println!("{instants} instants");
    assert!(instants > 20, "{instants}");
}
