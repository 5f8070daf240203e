//! Along a simulation: the seal of one cylinder slips or sticks while the other meets its end, bounces and stays there.

use linkage::Mode;
use linkage::simulation::{Start, simulate};

use super::*;

#[test]
fn along_a_simulation() {
    let random = Random::new(35);
    let (mut compared_at, mut slipping_on_the_stop) = (0, 0);
    for run in 0..6 {
        let (scene, q) = at_random!(random, Stopped);
        let scene = Stopped { lower: q.s2 - 0.004, f2: -2.0 * scene.f2, mu: 0.5 * scene.mu, ..scene };
        let mut motion =
            simulate(&scene, Start { t: 0.0, q, input_rates: inputs([0.1, 0.3, -0.2]) }, 0.25, 1e-9).unwrap();
        while let Some(state) = motion.advance().unwrap() {
            if state.changes().next().is_some() {
                continue;
            }
            let found = motion.loads().unwrap().joints;
            let rates = [state.rates.boom, state.rates.s1, state.rates.s2];
            let by_hand = ByHand::new(&scene.mechanism, &masses_of!(scene), &state.q, rates);
            let mut by_hand = by_hand.driven(scene.torque, [scene.f1, scene.f2]);
            let modes = state.contacts.map(|contact| contact.mode);
            for (stroke, mode) in by_hand.strokes.clone().into_iter().zip(modes.iter()) {
                let limit = scene.mu * scene.seal;
                match mode {
                    Mode::SlipForward => by_hand.machine.load(stroke, Law::Force(-limit)),
                    Mode::SlipBackward => by_hand.machine.load(stroke, Law::Force(limit)),
                    Mode::Open => {}
                    Mode::Stick | Mode::AtLower | Mode::AtUpper => {
                        by_hand.machine.hold(stroke, 0.0);
                    }
                }
            }
            let at = format!("run {run}, {} s: {modes:?}", state.t);
            compare(&at, &compared!(by_hand, found, by_hand.machine.solve()));
            compared_at += 1;
            let slips = matches!(modes[0], Mode::SlipForward | Mode::SlipBackward);
            slipping_on_the_stop += usize::from(slips && modes[1] == Mode::AtLower);
        }
    }
    println!("{compared_at} instants, {slipping_on_the_stop} of them with slip and a closed stop");
    assert!(compared_at > 20 && slipping_on_the_stop > 5, "{compared_at} {slipping_on_the_stop}");
}
