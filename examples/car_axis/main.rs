//! The car axis of the Test Set for IVP Solvers: error, steps, right-hand sides and time by method and tolerance, next to
//! the figures of others.
//!
//! `cargo run --release --example car_axis` prints them and writes `target/car_axis.html`.

use std::error::Error;

mod page;

use linkage::integrate::{Dop853, Dopri5};
use linkage_examples::car_axis::ride::Ride;
use linkage_examples::car_axis::runs::{Run, run};
use linkage_examples::output;
use linkage_gallery::car_axis::Riding;

fn main() -> Result<(), Box<dyn Error>> {
    let high = [4, 6, 8, 10, 11, 12, 13, 14].map(|exponent| run::<Dop853>(10_f64.powi(-exponent)));
    let low = [4, 6, 8, 10].map(|exponent| run::<Dopri5>(10_f64.powi(-exponent)));
    let high = high.into_iter().collect::<Result<Vec<Run>, _>>()?;
    let low = low.into_iter().collect::<Result<Vec<Run>, _>>()?;
    println!("| method | tolerance | positions | velocities | steps | right-hand sides | time in ms |");
    println!("|---|---|---|---|---|---|---|");
    for (method, runs) in [("order 8(5,3)", &high), ("order 5(4)", &low)] {
        for Run { tolerance, errors: [positions, velocities], steps, evaluations, milliseconds } in runs {
            println!(
                "| {method} | {tolerance:.0e} | {positions:.1e} | {velocities:.1e} | {steps} | {evaluations} | {milliseconds:.3} |"
            );
        }
    }
    if cfg!(debug_assertions) {
        println!("The times are for unoptimised code: run with --release.");
    }
    let best = &high[6];
    assert!(best.errors[0] < 1e-10 && best.errors[1] < 1e-8, "{:?}", best.errors);
    let ride = Ride::new(Riding::default())?;
    let [gained, work] = ride.balance;
    println!("energy gained {gained:.9}, work of the bumps {work:.9}");
    let path = output::write("target/car_axis.html", &page::html(&ride, &high, &low)?)?;
    println!("Pictures: {path}");
    Ok(())
}
