//! Andrews' squeezing mechanism: error, right-hand sides and time by method and tolerance.
//!
//! `cargo run --release --example andrews`

use std::time::Instant;

use linkage::integrate::{Dop853, Dopri5, Method};
use linkage::simulation::{Start, simulate};

use linkage_gallery::andrews_motion::{END, START};
use linkage_gallery::andrews_scene::*;

/// The number of repetitions; the fastest counts.
const REPETITIONS: usize = 50;

fn angles(q: SqueezerCoordinates<f64>) -> [f64; 7] {
    [q.beta, q.theta, q.gamma, q.phi, q.delta, q.omega, q.epsilon]
}

fn row<M: Method>(name: &str, tolerance: f64) -> Result<(), linkage::Error> {
    let scene = Squeezing::default();
    let mut fastest = f64::INFINITY;
    let mut row = (0.0_f64, 0);
    for _ in 0..REPETITIONS {
        let clock = Instant::now();
        let mut motion =
            simulate(&scene, Start { t: 0.0, q: START, input_rates: 0.0 }, 0.03, tolerance)?.method::<M>()?;
        motion.finish(|_, _| true)?;
        fastest = fastest.min(clock.elapsed().as_secs_f64());
        let pairs = angles(motion.state().q).into_iter().zip(angles(END));
        let error = pairs.fold(0.0_f64, |worst, (found, exact)| worst.max((found / exact - 1.0).abs()));
        row = (error, motion.counts().evaluations);
    }
    println!("| {name} | {tolerance:.0e} | {:.1e} | {} | {:.3} |", row.0, row.1, 1e3 * fastest);
    Ok(())
}

fn main() -> Result<(), linkage::Error> {
    println!("| method | tolerance | largest relative error of an angle | right-hand sides | time in ms |");
    println!("|---|---|---|---|---|");
    for exponent in [6, 8, 10, 11, 12, 13, 14] {
        row::<Dop853>("order 8(5,3)", 10.0_f64.powi(-exponent))?;
    }
    for exponent in [4, 6, 8, 10] {
        row::<Dopri5>("order 5(4)", 10.0_f64.powi(-exponent))?;
    }
    Ok(())
}
