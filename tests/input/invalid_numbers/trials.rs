//! The trials of the program, each by a seed.

use std::process::ExitCode;

use rand::SeedableRng;
use rand::rngs::SmallRng;

use crate::harness::tally::evaluated;
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
    assert_faults_are_found();
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

/// Results that the trials must find, and results that they must not.
fn assert_faults_are_found() {
    let tried = |text: &str| {
        let mut tally = Tally::default();
        tally.text(0, ("planted", "text"), || if text == "panic" { panic!("planted") } else { text.to_owned() });
        tally.is_clean()
    };
    for text in ["Ok(Solution { x: 1.0, y: NaN })", "Ok([1.0, -inf])", "Ok((Err(NaN), \"a\", inf))", "panic"] {
        assert!(!tried(text), "{text} is found");
    }
    for text in ["Ok(Info { inf_x: 1.0, name: \"NaN \\\" inf\" })", "Err(NotFinite { is: (NaN, 1.0) })", "NaN"] {
        assert!(tried(text), "{text} is right");
    }
    let mut tally = Tally::default();
    tally.text(0, ("planted", "evaluations"), || {
        (0..1_000_000).for_each(|_| evaluated());
        String::new()
    });
    assert!(!tally.is_clean(), "too many evaluations are found");
}
