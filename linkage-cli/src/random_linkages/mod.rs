//! Random linkages: each is asked for everything, and the answers are compared with each other and with small steps.
//!
//! A linkage is built of joints at random places, so that it has a position. It is written as text for the program; its equations
//! and their derivatives are computed without that text, and small steps of Newton's method across the tangent follow its motion.
//! Two answers may differ by rounding errors: each equation is right but for some units in the last place of the sum of its
//! terms, and the inverse of the Jacobian says what that is for each unknown.
//!
//! All failures are collected, and told by kinds, each with the shortest text.
//!
//! Ten thousand have been compared, three in four of `SEED=0f9c3d8b`, in parts of a hundred: 50 s of a core each, in a release build.
//!
//! Both rings: `LINKAGES=10000` is a number of linkages, `FIRST=4711` the first one, to see it alone with `LINKAGES=1`.

mod algebra;
mod compare;
mod families;
mod linkage;
mod program;
mod steps;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::time::Instant;

use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use compare::{Comparison, Found};
use families::FAMILIES;
use program::Program;
use steps::Stepped;

/// Failures of one kind.
struct Kind {
    families: BTreeMap<&'static str, usize>,
    /// The shortest text, and what was found for it.
    shortest: String,
    found: Found,
}

/// All answers about some linkages.
#[derive(Default)]
struct Answers {
    failures: BTreeMap<String, Kind>,
    counts: BTreeMap<String, usize>,
    slowest: (f64, String),
}

impl Answers {
    fn of(&mut self, number: usize, seed: u64, program: &Program) {
        let mut random = SmallRng::seed_from_u64(seed ^ (number as u64).wrapping_mul(0x2545_f491_4f6c_dd1d));
        let family = FAMILIES[number % FAMILIES.len()];
        let linkage = families::linkage(family, &mut random);
        let text = linkage.text();
        program.write(&text);
        let begun = Instant::now();
        let mut comparison = Comparison {
            linkage: &linkage,
            program,
            stepped: Stepped { linkage: &linkage, moving: linkage.unknowns },
            at: linkage.start.clone(),
            random: std::array::from_fn(|_| random.random()),
            found: Vec::new(),
            counts: Vec::new(),
        };
        comparison.run();
        let (found, counts) = (comparison.found, comparison.counts);
        let seconds = begun.elapsed().as_secs_f64();
        println!("{number} {family}: {seconds:.2} s, of commands until now {:.2?}", program.seconds.borrow());
        found.iter().for_each(|one| println!("  found: {}", one.kind));
        if seconds > self.slowest.0 {
            self.slowest = (seconds, text.clone());
        }
        for count in counts {
            *self.counts.entry(count).or_default() += 1;
        }
        for found in found {
            let entry = self.failures.entry(found.kind.clone());
            let kind = entry.or_insert_with(|| Kind {
                families: BTreeMap::new(),
                shortest: text.clone(),
                found: found.clone(),
            });
            *kind.families.entry(family).or_default() += 1;
            if text.len() < kind.shortest.len() {
                (kind.shortest, kind.found) = (text.clone(), found);
            }
        }
    }

    fn report(&self) -> String {
        let mut text = String::new();
        for (count, number) in &self.counts {
            let _ = writeln!(text, "{number:6} {count}");
        }
        let _ = writeln!(text, "slowest: {:.1} s\n{}", self.slowest.0, self.slowest.1);
        for (kind, Kind { families, shortest, found }) in &self.failures {
            let count: usize = families.values().sum();
            let Found { question, answer, right, .. } = found;
            let has_forces = question.starts_with("equilibrium") || question.starts_with("simulate");
            let is_needed =
                |line: &&str| has_forces || !["    body", "    scene"].iter().any(|of| line.starts_with(of));
            let shortest: String = shortest.lines().filter(is_needed).map(|line| line.to_owned() + "\n").collect();
            let _ = writeln!(
                text,
                "\n## {kind}: {count} {families:?}\n{shortest}linkage {question}\nanswer: {answer}\nright: {right}"
            );
        }
        text
    }
}

/// The seed of the inner ring. It stays, since other linkages are known to pass by the hundred only, and a failure is one of the
/// program and not of the change that is tested: `RING=outer` draws others.
const SEED: u64 = 0xd017_118e_9bc0_90de;

#[test]
fn random_linkages_have_one_answer_for_every_reader() {
    let program = Program::new();
    let mut answers = Answers::default();
    let first = linkage_trials::count("FIRST", 0, 0);
    let count = linkage_trials::count("LINKAGES", 9, 300);
    let seed = if linkage_trials::is_outer() { linkage_trials::seed(0) } else { SEED };
    for number in first..first + count {
        answers.of(number, seed, &program);
    }
    let report = answers.report();
    println!("{report}");
    assert!(answers.failures.is_empty(), "{} kinds of failures\n{report}", answers.failures.len());
}
