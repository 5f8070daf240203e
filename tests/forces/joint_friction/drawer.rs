//! A drawer that is pulled off its middle, guided at two corners a length L apart: it jams where 2 mu e >= L, whatever
//! the pull (F. P. Beer, E. R. Johnston, *Vector Mechanics for Engineers: Statics*, problems of chapter 8).

use linkage::simulation::{Start, simulate};
use linkage::{Mode, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism Drawer {
        /// The distances of the corners along and across the rails.
        param l = 0.4, b = 0.3;
        param m = 4, j = 0.1, e = 0.2, pull = 50, mu = 0.3;
        input rear;
        unknown phi, front;
        loop (rear, 0) + (l, b)@phi = (front, b);
        body drawer { mass m; inertia j; center (rear, 0) + (l / 2, b / 2)@phi; angle phi; }
        scene Pulled {
            inertia;
            force (pull, 0) at (rear, 0) + (l, b / 2 + e)@phi;
            friction mu, reaction on rear;
            friction mu, reaction on front;
            reaction on rear;
            reaction on front;
        }
    }
}

#[test]
fn it_jams_at_the_textbook_ratio() {
    let mut random = SmallRng::seed_from_u64(24);
    for _ in 0..200 {
        let mut scene = Pulled::default();
        let l: f64 = random.random_range(0.2..0.6);
        (scene.mechanism.l, scene.mechanism.b) = (l, random.random_range(0.1..0.6));
        scene.e = random.random_range(0.05..0.5) * if random.random() { 1.0 } else { -1.0 };
        scene.pull = random.random_range(1.0..500.0);
        let limit = l / (2.0 * scene.e.abs());
        // A wide drawer is held by forces of its corners against each other, without any pull.
        let shares = [(1.0 + 1e-10, true), (1.1, true), (1.0 - 1e-10, false), (0.9, false)];
        for (share, jams) in shares.into_iter().filter(|(share, _)| share * limit * scene.mechanism.b < 0.999 * l) {
            scene.mu = share * limit;
            let q = DrawerCoordinates { rear: 0.3, phi: 0.0, front: 0.3 + l };
            let mut simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 0.1, 1e-9).unwrap();
            let is_jammed = simulation.state().contacts.iter().all(|contact| contact.mode == Mode::Stick);
            assert_eq!(is_jammed, jams, "{scene:?}");
            let loads = simulation.loads().unwrap();
            assert!((loads.joints.rear_normal + loads.joints.front_normal).abs() < 1e-11 * scene.pull);
            simulation.finish(|_, _| true).unwrap();
            let a = scene.pull * (1.0 - scene.mu / limit) / scene.m;
            let expected = if jams { 0.0 } else { a * 0.1 * 0.1 / 2.0 };
            let moved = simulation.state().q.rear - q.rear;
            assert!((moved - expected).abs() < 1e-10 * scene.pull / scene.m, "{scene:?}: {moved} {expected}");
        }
    }
}
