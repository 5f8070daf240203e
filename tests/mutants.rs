//! Mutants of all mechanisms and scenes under test: the macro never panics, stays within its budget of work and of
//! memory, and emits code without warnings for every mutant that it accepts.
//!
//! `MUTANTS` mutants are expanded, `MUTANTS_COMPILED` of the accepted ones are compiled: other ones for each commit, and as
//! `MUTANTS_SEED` chooses.

use std::fs;
use std::path::Path;

use linkage_compiler::budget::{Budget, MOST_STEPS};
use linkage_gallery::source;
use linkage_tests::expanded::{expanded, is_rejected, parsed};
use linkage_tests::mutants::{Mutator, corpus};
use linkage_tests::programs::{Libraries, succeeded, written};
use linkage_trials::{count, seed};
use proc_macro2::TokenStream;
use rand::SeedableRng;
use rand::rngs::SmallRng;

/// The limit of the memory of the process, in kilobytes.
const MOST_MEMORY: usize = 512 << 10;

/// The mutants that are expanded.
fn expanded_mutants() -> usize {
    count("MUTANTS", 400, 2000)
}

fn mutator() -> Mutator<SmallRng> {
    let root = Path::new(linkage_tests::ROOT);
    let chosen = count("MUTANTS_SEED", seed(1), 1);
    Mutator::new(SmallRng::seed_from_u64(chosen), corpus(root))
}

/// The largest memory of the process, in kilobytes, if the system reports it.
fn memory() -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}

#[test]
fn no_mutant_makes_the_macro_panic_or_run_away() {
    let count = expanded_mutants();
    let (mut mutator, root) = (mutator(), "::linkage".parse().unwrap());
    let (mut accepted, mut most, mut longest) = (0, 0, String::new());
    for number in 1..=count {
        let mutant = mutator.mutant();
        let budget = Budget::default();
        let expansion = expanded(&mutant, &root, &budget);
        accepted += usize::from(!is_rejected(&expansion));
        let steps = MOST_STEPS - budget.left();
        if steps > most {
            (most, longest) = (steps, mutant.to_string());
        }
        if let Some(memory) = memory().filter(|_| number % 100 == 0) {
            assert!(memory < MOST_MEMORY, "{memory} kB after mutant {number}, of which the longest is\n{longest}");
        }
        if number % 200 == 0 {
            // Two expansions of one input are equal, and they are Rust.
            let again = linkage_compiler::expand(mutant.clone(), &root);
            assert_eq!(expansion.to_string(), again.to_string());
            parsed(expansion, &mutant);
        }
    }
    println!("{count} mutants, {accepted} accepted, at most {most} steps, {:?} kB", memory());
    // If all mutants were rejected, the test would check error messages only.
    assert!(5 * accepted > count, "{accepted} of {count}");
}

/// If the budget is spent, at any point, the expansion is an error message.
#[test]
fn a_budget_that_ends_anywhere_is_one_message() {
    let root: TokenStream = "::linkage".parse().unwrap();
    let mut random = SmallRng::seed_from_u64(2);
    for file in
        ["every_function", "five_bar_contacts", "norton_four_bar", "cam_rocker", "slider_crank_scenes", "andrews"]
    {
        let all = {
            let budget = Budget::default();
            assert!(!is_rejected(&linkage_compiler::expand_within(
                source::tokens_of(file),
                &linkage_compiler::Facade::complete(&root),
                &budget
            )));
            MOST_STEPS - budget.left()
        };
        for _ in 0..expanded_mutants() / 100 {
            let budget = Budget::new(rand::Rng::random_range(&mut random, 1..all));
            let expansion = linkage_compiler::expand_within(
                source::tokens_of(file),
                &linkage_compiler::Facade::complete(&root),
                &budget,
            );
            let file: syn::File = syn::parse2(expansion).unwrap();
            let messages = file.items.iter().filter_map(|item| match item {
                syn::Item::Macro(item) if item.mac.path.is_ident("compile_error") => Some(item.mac.tokens.to_string()),
                syn::Item::Macro(item) if item.mac.tokens.to_string().contains("this invocation") => {
                    Some(item.mac.tokens.to_string())
                }
                _ => None,
            });
            let messages: Vec<String> = messages.collect();
            assert!(matches!(messages.as_slice(), [one] if one.contains("budget of work")), "{messages:?}");
        }
    }
}

/// Accepted mutants are Rust without a warning.
#[test]
fn accepted_mutants_compile() {
    let count = count("MUTANTS_COMPILED", 10, 60);
    let (mut mutator, path) = (mutator(), "::linkage".parse().unwrap());
    let mut accepted = || loop {
        let mutant = mutator.mutant();
        let expansion = linkage_compiler::expand(mutant.clone(), &path);
        if !is_rejected(&expansion) {
            return (mutant, expansion);
        }
    };
    let laws = ("cam_laws.rs".to_owned(), include_str!("../dev/gallery/src/cam_laws.rs").to_owned());
    let mut compiled = 0;
    while compiled < count {
        // The number of mutants in one compilation.
        const TOGETHER: usize = 100;
        let together = TOGETHER.min(count - compiled);
        let (mut library, mut files) = (String::from("pub mod cam_laws;\n"), vec![laws.clone()]);
        for number in 0..together {
            let (mutant, expansion) = accepted();
            let text = prettyplease::unparse(&syn::parse2(expansion).unwrap());
            let comment = mutant.to_string().replace('\n', " ");
            files.push((format!("mutant_{number}.rs"), format!("// {comment}\n{text}")));
            library += &format!("pub mod mutant_{number};\n");
        }
        let folder = written("mutants", files.into_iter().chain([("lib.rs".to_owned(), library)]));
        let mut rustc = Libraries::of_tests().rustc(&folder, "lib.rs", &["linkage"]);
        succeeded(rustc.args(["--crate-type=lib", "--emit=metadata", "-Dwarnings"]));
        compiled += together;
    }
}
