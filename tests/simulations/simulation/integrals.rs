//! Positions are the integrals of rates, in each step and in each that an event cuts.

use linkage::linkage;
use linkage::simulation::{Start, simulate};

linkage! {
    /// Three cars between walls, each pushed by the one before it.
    mechanism Train {
        param m1 = 1.307162752062995, m2 = 1.7577790393438768, m3 = 1.0424614042928595, am = 20, w = 1.2653955493385958,
            ph = 5.849280077051741, weight = 9.81, mu1 = 0.1, mu3 = 0.4, ga = 0.18111500586127932, gb = 0.2283353414946867,
            wall = 0.7733869390804317, e = 0.7;
        input x1, x2, x3;
        body first { mass m1; center (x1, 0); }
        body second { mass m2; center (x2, 0); }
        body third { mass m3; center (x3, 0); }
        scene Go {
            inertia;
            force (am*sin(w*t + ph), 0) at (x1, 0);
            friction mu1, m1*weight on x1;
            friction mu3, m3*weight on x3;
            stop x2 - x1 in -ga..ga, restitution e;
            stop x3 - x2 in -gb..gb, restitution e;
            stop x3 in -wall..wall, restitution 1;
        }
    }
}

/// The places and weights of Gauss's rule with eight points, from 0 to 1: exact for polynomials of degree 15.
const RULE: [(f64, f64); 8] = [
    (0.019_855_071_751_231_88, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_64, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_65),
    (0.408_282_678_752_175_1, 0.181_341_891_689_180_9),
    (0.591_717_321_247_825, 0.181_341_891_689_180_9),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_65),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];

/// A step is cut where cars meet; that to the end of the motion, a hundred times as far away, is one of them.
#[test]
fn positions_are_integrals_of_rates() {
    let scene = Go::default();
    let q = TrainCoordinates { x1: 0.062_834_680_867_395_08, x2: 0.178_494_773_494_504_2, x3: 0.304_848_449_026_865_7 };
    let input_rates =
        TrainInputs { x1: 0.340_517_146_392_345_54, x2: 0.133_640_779_372_366_4, x3: 0.546_443_486_415_379_1 };
    for tolerance in [1e-4, 1e-6, 1e-9] {
        let motion = || simulate(&scene, Start { t: 0.0, q, input_rates }, 3.0, tolerance).unwrap();
        let mut states = Vec::new();
        motion()
            .finish(|state, _| {
                states.push(*state);
                state.t < 1.0
            })
            .unwrap();
        let steps: Vec<_> = states.windows(2).filter(|pair| pair[1].t > pair[0].t).collect();
        let places = steps.iter().flat_map(|pair| RULE.map(|(at, _)| pair[0].t + (pair[1].t - pair[0].t) * at));
        let rates: Vec<[f64; 3]> =
            motion().at(places).map(|state| state.unwrap().rates).map(|rates| [rates.x1, rates.x2, rates.x3]).collect();
        let mut largest = 0.0_f64;
        for (pair, rates) in steps.iter().zip(rates.chunks(RULE.len())) {
            let [from, to] = [pair[0], pair[1]].map(|state| [state.q.x1, state.q.x2, state.q.x3]);
            for car in 0..3 {
                let integral: f64 = RULE.iter().zip(rates).map(|((_, weight), rates)| weight * rates[car]).sum();
                let error = to[car] - from[car] - integral * (pair[1].t - pair[0].t);
                largest = largest.max(error.abs());
            }
        }
        println!("{tolerance}: {} steps, {largest}", steps.len());
        // The cars are within one of each other and of the walls.
        assert!(largest <= 10.0 * tolerance, "{tolerance}: {largest}");
    }
}
