//! Mutants of the gallery's mechanisms that compile: their functions end with values or errors.
//!
//! `MUTANTS=10000 cargo test --release -p linkage-tests --test interpreted mutants` is the full size: 851 778 values and 177 222
//! errors in 129 s of one core, no panic.

use std::panic::{AssertUnwindSafe, catch_unwind};

use linkage_interpreter::{CallError, Program};
use linkage_tests::mutants::{Mutator, corpus};
use rand::SeedableRng;
use rand::rngs::SmallRng;

use crate::drawn::Drawn;

/// The calls of each mutant.
const CALLS: usize = 100;

/// The steps of the compiler's budget: a mutant is no larger than what it is made of.
const STEPS: usize = 20_000_000;

#[test]
fn no_mutant_panics_when_it_runs() {
    let wanted = linkage_trials::count("MUTANTS", 10, 30);
    let random = SmallRng::seed_from_u64(linkage_trials::seed(51));
    let mut mutants = Mutator::new(random, corpus(std::path::Path::new(linkage_tests::ROOT)));
    let (mut compiled, mut values, mut errors) = (0, 0, 0);
    while compiled < wanted {
        let text = mutants.mutant().to_string();
        let run = || {
            let Ok(program) = Program::compile_within(&text, STEPS) else { return [0; 3] };
            let mut found = [1, 0, 0];
            for mechanism in program.mechanisms() {
                let functions: Vec<&str> = mechanism.functions().collect();
                for call in 0..CALLS {
                    let mut drawn = Drawn::new(call as u64, 0.05);
                    let parameters: Vec<f64> =
                        mechanism.design().parameters().iter().map(|value| drawn.near(*value)).collect();
                    let design = mechanism.design().with_parameters(&parameters);
                    let function = functions[call % functions.len()];
                    let arguments = design.arguments(function).expect("a function of its own");
                    // A user function is not given: its mutants have no poses.
                    if design.call("pose_at", &[drawn.list(mechanism.sizes()[0])]).is_err() {
                        break;
                    }
                    let arguments: Vec<_> =
                        arguments.iter().map(|argument| drawn.argument(mechanism, &design, &argument.shape)).collect();
                    match design.call(function, &arguments) {
                        Ok(_) => found[1] += 1,
                        Err(CallError::Function(_)) => found[2] += 1,
                        Err(other) => panic!("{function}: {other}"),
                    }
                }
            }
            found
        };
        let found = catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| panic!("{text}"));
        compiled += found[0];
        values += found[1];
        errors += found[2];
    }
    println!("{compiled} mutants, {values} values, {errors} errors");
    assert!(values > 10 * compiled, "{values} values of {compiled} mutants");
}
