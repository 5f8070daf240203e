//! A knee of two links pushes a block along a guide. However great the torque, it does not move while the angle between
//! the second link and the normal of the guide is within the angle of friction.

use linkage::simulation::{Start, simulate};
use linkage::{Mode, Slider, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism Knee {
        param a = 0.3, b = 0.4, offset = 0.1;
        param m = 2, j = 0.05, torque = 30, mu = 0.2;
        input theta;
        unknown psi, s;
        loop a@theta + b@psi = (s, offset);
        body lever { inertia j; angle theta; }
        body block { mass m; center (s, offset); }
        scene Pushed {
            inertia;
            torque torque on theta;
            friction mu, reaction on s;
            reaction on s;
        }
    }
}

#[test]
fn it_locks_exactly_at_the_angle_of_friction() {
    let mut random = SmallRng::seed_from_u64(22);
    let mut locked = 0;
    for _ in 0..300 {
        let theta: f64 = random.random_range(-3.0..3.0);
        let mut scene = Pushed::default();
        let Ok(pose) = scene.mechanism.assemble(theta, KneeBranch { psi_s: Slider::Far }) else { continue };
        let q = pose.coordinates();
        // The angle of the second link from the normal of the guide.
        let slope = (q.psi.cos() / q.psi.sin()).abs();
        scene.torque = random.random_range(-1e4..1e4);
        for (mu, is_locked) in [(slope, true), (slope * (1.0 + 1e-11), true), (slope * (1.0 - 1e-11), false)] {
            scene.mu = mu;
            let simulation = match simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 1.0, 1e-9) {
                Ok(simulation) => simulation,
                // The block pushed the other way by its own friction: Painleve.
                Err(error) => panic!("{theta} {mu}: {error}"),
            };
            let mode = simulation.state().contacts[0].mode;
            assert_eq!(mode == Mode::Stick, is_locked, "{theta} {mu} {}: {mode:?}", scene.torque);
            locked += usize::from(is_locked);
        }
    }
    assert!(locked > 300, "{locked}");
}
