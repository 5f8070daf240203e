//! The trials of the program, each by a seed.

use std::process::ExitCode;

use rand::SeedableRng;
use rand::rngs::SmallRng;

use crate::harness::{Source, Subject, Tally, listen};

/// `trials 100000` makes this many trials of each subject; `trials 100000 four_bar` of those whose names begin so;
/// `trials seed 17 four_bar` repeats one trial and prints it.
pub fn main(subjects: &[(String, Subject)]) -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (seeds, begin) = match *arguments.as_slice() {
        ["seed", seed] => (seed.parse().map(|seed: u64| seed..seed + 1), ""),
        ["seed", seed, begin] => (seed.parse().map(|seed: u64| seed..seed + 1), begin),
        [trials] => (trials.parse().map(|trials| 0..trials), ""),
        [trials, begin] => (trials.parse().map(|trials| 0..trials), begin),
        _ => (Ok(0..40), ""),
    };
    let Ok(seeds) = seeds else {
        eprintln!("how many trials?");
        return ExitCode::FAILURE;
    };
    listen();
    let chosen = subjects.iter().filter(|(name, _)| name.starts_with(begin));
    let mut all = Tally::default();
    for (number, (name, subject)) in chosen.enumerate() {
        let mut tally = Tally::default();
        for seed in seeds.clone() {
            // Each mechanism has other numbers.
            let random = SmallRng::seed_from_u64(seed.wrapping_mul(1_000_003) ^ (number as u64) << 48);
            subject.try_out(&mut tally, &mut Source::new(Box::new(random), seed));
        }
        tally.tell(name);
        all += &tally;
    }
    all.tell("all");
    if all.is_clean() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
