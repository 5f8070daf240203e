//! The calls: what their arguments are made of, what is asked of their results, and what they were.

mod algorithms;
mod draw;
mod finite;
mod tally;

pub use algorithms::{driven, integrations, mechanism, positions, scene};
pub use draw::{Draw, Pool, Source};
pub use finite::Finite;
pub use linkage::nalgebra::SVector;
pub use tally::{Tally, evaluated};

use std::process::ExitCode;

/// The calls of one mechanism or one scene with the arguments of one trial.
type Subject = fn(&mut Tally, &mut Source);

/// `invalid_numbers 100000` makes so many trials of each subject; `invalid_numbers 100000 FourBar` of those whose names
/// begin so; `invalid_numbers seed 17 FourBar` repeats one trial and tells of it. `invalid_numbers bytes FILE` is what a
/// fuzzer runs: the first byte of the file chooses the subject, the others its parameters, poses and arguments.
pub fn main(subjects: &[(&'static str, Subject)]) -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    if let ["bytes", file] = *arguments.as_slice() {
        return fuzzed(subjects, file);
    }
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
    tally::listen();
    let integrations: (&'static str, Subject) = ("integrate", integrations);
    let chosen = subjects.iter().chain([&integrations]).filter(|(name, _)| name.starts_with(begin));
    let mut all = Tally::default();
    for (number, (name, subject)) in chosen.enumerate() {
        let mut tally = Tally::default();
        for seed in seeds.clone() {
            // Of each mechanism other numbers.
            subject(&mut tally, &mut Source::new(seed.wrapping_mul(1_000_003) ^ (number as u64) << 48, seed));
        }
        tally.tell(name);
        all.add(&tally);
    }
    all.tell("all");
    if all.is_clean() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// One trial by the bytes of a file.
fn fuzzed(subjects: &[(&'static str, Subject)], file: &str) -> ExitCode {
    let Ok(bytes) = std::fs::read(file) else {
        eprintln!("{file} cannot be read");
        return ExitCode::FAILURE;
    };
    let Some((&first, rest)) = bytes.split_first() else { return ExitCode::SUCCESS };
    let (name, subject) = subjects[usize::from(first) % subjects.len()];
    tally::listen();
    let mut tally = Tally::default();
    subject(&mut tally, &mut Source::given(rest.to_vec()));
    tally.tell(name);
    if tally.is_clean() { ExitCode::SUCCESS } else { std::process::abort() }
}
