//! Positions are the integrals of rates, in each step and in each that an event cuts, and outputs are those of the law that
//! the step had.

use linkage::contact::Change;
use linkage::linkage;
use linkage::simulation::{Start, simulate};

use linkage_oracle::close;

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

linkage! {
    /// A block on a slope, and its place from one that slips without friction.
    mechanism Resting {
        param m = 1.3, f = 1, slope = -1;
        input x, u;
        body free { mass m; center (x, 0); }
        body block { mass m; center (x + u, 0); }
        scene Down { inertia; gravity (slope, 0); friction f, 1 on x + u; }
    }
}

linkage! {
    /// A block on a plane that turns round at t = 1.
    mechanism Turning {
        param m = 1.3, f = 0.8, v = 1.1;
        input b, x;
        body block { mass m; center (x, 0); }
        scene Round { inertia; drive b = v * abs(t - 1); friction f, 1 on x - b; }
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

/// A motion that ends where a block stops, to some ulps: the last step has no event, and the block sticks at its end. Outputs
/// within the step are those of the block that slips.
#[test]
fn outputs_in_a_step_to_the_rest_of_a_block() {
    let mut rests_at_the_end = 0;
    for (tenths, (slope, f)) in (3..30).flat_map(|tenths| [(-1.0, 1.0), (-2.0, 0.3), (0.0, 0.7)].map(|of| (tenths, of)))
    {
        let scene = Down { slope, f, ..Down::default() };
        let (speed, brake) = (0.1 * f64::from(tenths), f / scene.m - slope);
        let input_rates = RestingInputs { x: 0.4, u: speed - 0.4 };
        let start = Start { t: 1.0, q: RestingCoordinates { x: 0.1, u: 0.2 }, input_rates };
        let rest = 1.0 + speed / brake;
        for end in [rest.next_down(), rest, rest.next_up(), rest.next_up().next_up()] {
            let last = simulate(&scene, start, end, 1e-6).unwrap().last().unwrap().unwrap();
            rests_at_the_end += i32::from(last.t == end && last.changes().any(|(_, change)| change == Change::Sticks));
            let times = (1..20).map(|part| 1.0 + (end - 1.0) * f64::from(part) / 20.0);
            for state in simulate(&scene, start, end, 1e-6).unwrap().at(times) {
                let state = state.unwrap();
                let span = state.t - 1.0;
                close("rate", state.rates.x + state.rates.u, speed - brake * span, 1e-13 * speed);
                close("place", state.q.x + state.q.u, 0.3 + (speed - 0.5 * brake * span) * span, 1e-13 * speed);
            }
        }
    }
    println!("{rests_at_the_end} rest at the end");
    assert!(rests_at_the_end > 10, "{rests_at_the_end}");
}

/// A block slips on a plane whose rate jumps, so that friction turns round: before and after that the motion is a parabola.
#[test]
fn outputs_in_a_step_to_the_jump_of_a_drive() {
    let scene = Round::default();
    let (v, a) = (scene.v, scene.f / scene.m);
    let start = Start { t: 0.0, q: TurningCoordinates { b: v, x: 0.0 }, input_rates: TurningInputs { b: -v, x: 0.0 } };
    for tolerance in [1e-4, 1e-6, 1e-9] {
        let mut turns = 0;
        let mut motion = simulate(&scene, start, 1.5, tolerance).unwrap();
        motion
            .finish(|state, _| {
                turns += state.changes().filter(|(_, change)| *change == Change::Slips).count();
                true
            })
            .unwrap();
        assert_eq!(turns, 1, "{tolerance}");
        let times = (1..60).map(|part| f64::from(part) / 40.0);
        for state in simulate(&scene, start, 1.5, tolerance).unwrap().at(times) {
            let state = state.unwrap();
            let after = (state.t - 1.0).max(0.0);
            let (rate, place) = (a * (state.t - 2.0 * after), 0.5 * a * state.t * state.t - a * after * after);
            close("rate", state.rates.x, -rate, 1e-14);
            close("place", state.q.x, -place, 1e-14);
        }
    }
}
