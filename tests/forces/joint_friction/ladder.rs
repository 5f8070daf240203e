//! A ladder on a rough floor at a rough wall: it stays where tan(angle) >= (1 - mu_floor mu_wall) / (2 mu_floor), as in
//! every textbook of statics (J. L. Meriam, L. G. Kraige, *Statics*, section 6/3), with the weight at its middle.

use linkage::simulation::{Start, simulate};
use linkage::{Mode, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism Ladder {
        param l = 4;
        param share = 0.5, m = 12, j = 16, g = 9.81, floor = 0.3, wall = 0.2;
        input theta;
        unknown x, y;
        loop (x, 0) + l@(pi - theta) = (0, y);
        body ladder { mass m; inertia j; center (x, 0) + (share * l)@(pi - theta); angle -theta; }
        scene Leaning {
            inertia;
            gravity (0, -g);
            friction floor, reaction on x;
            friction wall, reaction on y;
            reaction on x;
            reaction on y;
        }
    }
}

#[test]
fn it_stays_above_the_textbook_angle() {
    let mut random = SmallRng::seed_from_u64(23);
    for _ in 0..200 {
        let (floor, wall): (f64, f64) = (random.random_range(0.1..0.7), random.random_range(0.0..0.7));
        let scene = Leaning { floor, wall, ..Leaning::default() };
        let limit = ((1.0 - floor * wall) / (2.0 * floor)).atan();
        for (angle, stays) in
            [(limit + 1e-10, true), (limit + 0.05, true), (limit - 1e-10, false), (limit - 0.05, false)]
        {
            let q = scene.mechanism.branches(angle).unwrap().next().unwrap().pose.coordinates();
            let simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 1.0, 1e-9).unwrap();
            let state = simulation.state();
            let is_held = state.contacts.iter().all(|contact| contact.mode == Mode::Stick);
            assert_eq!(is_held, stays, "{floor} {wall} {angle} {limit}: {:?}", state.contacts);
            let loads = simulation.loads().unwrap();
            // Two frictions and one motion: the forces of a ladder at rest are not unique, those given satisfy all laws.
            assert_eq!(loads.are_unique, !stays);
            let weight = scene.m * scene.g;
            for (contact, mu, normal) in [(0, floor, loads.joints.x_normal), (1, wall, loads.joints.y_normal)] {
                let room = mu * normal.abs() - loads.contacts[contact].abs();
                assert!(room >= -1e-11 * weight, "{floor} {wall} {angle}: {room}");
            }
            if stays {
                let upwards = loads.joints.x_normal + loads.contacts[1] - weight;
                assert!(upwards.abs() < 1e-11 * weight, "{upwards}");
            }
        }
    }
}
