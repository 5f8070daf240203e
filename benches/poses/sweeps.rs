//! Rows per second of a sweep: a four-bar with velocity and acceleration, reduced to the extremes and a histogram of
//! its transmission angle, on one thread and on two, in alternating rounds; medians and their ratio. Then the time of a
//! tenth and of all rows, with the largest memory of the process after each.
//!
//! `cargo bench --features simd --bench sweeps`; `-- --rows 1000000000` sets the rows, `-- --threads 1` the threads of
//! the second part.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

use linkage::{Elbow, linkage};
use linkage_sweep::{Bins, Bounds, Distribution, Extremes, Histogram, Plan, Sequence, Sweep, SweepError, found};

linkage! {
    /// Four-bar linkage with its transmission angle, whose bounds show how well the rocker is driven.
    #[derive(Clone)]
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta;
        unknown theta3, theta4;

        loop l2@theta + l3@theta3 + l4@theta4 = l1@0;

        output transmission = theta4 - theta3;

        derive lanes;
    }
}

const ROUNDS: usize = 9;
/// Positions of a turn.
const TURN: u64 = 1000;

/// A sweep of random designs over a turn each; at least one design.
fn sweep(rows: u64, threads: usize) -> Result<Sweep<FourBar>, SweepError> {
    let lengths = [("l2", 20.0), ("l3", 50.0), ("l4", 70.0)];
    let columns = lengths.map(|(name, mean)| (name, Distribution::Normal { mean, deviation: 0.5 }));
    let plan = Plan::new().sample(columns, (rows / TURN).max(1), Sequence::QuasiRandom).turn("theta", TURN);
    let plan = plan.constant("theta_rate", 41.9).constant("theta_acceleration", 3.7);
    Sweep::new(&FourBar::default(), FourBarBranch::new(Elbow::Left), plan)?.with_threads(threads)
}

type Summary = (Bounds<f64>, Bounds<f64>, Bounds<f64>, Bins);

/// The summary of all rows, and the seconds that it takes.
fn reduce(sweep: &Sweep<FourBar>) -> Result<(Summary, f64), SweepError> {
    let reducers = (
        Extremes::of(found("transmission")),
        Extremes::of(found("theta4_rate")),
        Extremes::of(found("theta4_acceleration")),
        Histogram::of(found("transmission"), -FRAC_PI_2, FRAC_PI_2, 90),
    );
    let start = Instant::now();
    let summary = black_box(sweep).reduce(&reducers, |_| ControlFlow::Continue(()))?;
    Ok((summary, start.elapsed().as_secs_f64()))
}

/// The number after an option.
fn option(name: &str) -> Result<Option<u64>, Box<dyn Error>> {
    let mut arguments = std::env::args().skip_while(|argument| argument != name).skip(1);
    match arguments.next() {
        Some(text) => Ok(Some(text.parse().map_err(|error| format!("{name} {text}: {error}"))?)),
        None => Ok(None),
    }
}

/// The largest memory of the process so far, as the system states it.
fn memory() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.map_or("unknown on this system".to_owned(), |line| line.trim().to_owned())
}

fn main() -> Result<(), Box<dyn Error>> {
    let rows = option("--rows")?.unwrap_or(20_000_000);
    let threads = usize::try_from(option("--threads")?.unwrap_or(2))?;

    let sweeps = [sweep(rows.min(20_000_000), 1)?, sweep(rows.min(20_000_000), 2)?];
    let mut speeds = [const { Vec::new() }; 2];
    let mut first = None;
    for _ in 0..ROUNDS {
        for (sweep, speeds) in sweeps.iter().zip(&mut speeds) {
            let (summary, seconds) = reduce(sweep)?;
            speeds.push(sweep.rows() as f64 / seconds);
            assert_eq!(*first.get_or_insert(summary.clone()), summary, "the threads change the result");
        }
    }
    let [one, two] = speeds.map(|mut speeds| {
        speeds.sort_by(f64::total_cmp);
        speeds[ROUNDS / 2]
    });
    println!("1 thread   {:7.2} million rows/s", 1e-6 * one);
    println!("2 threads  {:7.2} million rows/s, ratio {:.2}", 1e-6 * two, two / one);

    for rows in [rows / 10, rows] {
        let sweep = sweep(rows, threads)?;
        let ((transmission, ..), seconds) = reduce(&sweep)?;
        let [least, most] = [transmission.least, transmission.most].map(|end| end.map_or(f64::NAN, |end| end.value));
        println!(
            "{} rows, threads {threads}: {seconds:.2} s, {:.2} million rows/s, largest memory {}; transmission angle \
             from {:.1} to {:.1} degrees",
            sweep.rows(),
            1e-6 * sweep.rows() as f64 / seconds,
            memory(),
            least.to_degrees(),
            most.to_degrees()
        );
    }
    Ok(())
}
