//! Mutants of all mechanisms and scenes under test: the macro never panics, stays within its budget of work and of
//! memory, and emits code without warnings for every mutant that it accepts.
//!
//! `MUTANTS` mutants are expanded, `MUTANTS_COMPILED` of the accepted ones are compiled; `MUTANTS_SEED` chooses others.

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use linkage_compiler::budget::{Budget, MOST_STEPS};
use linkage_gallery::source;
use linkage_tests::expanded::{expanded, is_rejected, parsed};
use linkage_tests::mutants::{Mutator, corpus};
use proc_macro2::TokenStream;
use rand::SeedableRng;
use rand::rngs::SmallRng;

/// The limit of the memory of the process, in kilobytes.
const MOST_MEMORY: usize = 512 << 10;

fn setting(name: &str, usual: usize) -> usize {
    env::var(name).map_or(usual, |text| text.parse().unwrap())
}

fn mutator() -> Mutator<SmallRng> {
    let root = Path::new(linkage_tests::ROOT);
    Mutator::new(SmallRng::seed_from_u64(setting("MUTANTS_SEED", 1) as u64), corpus(root))
}

/// The largest memory of the process, in kilobytes, if the system reports it.
fn memory() -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}

#[test]
fn no_mutant_makes_the_macro_panic_or_run_away() {
    let count = setting("MUTANTS", 2000);
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
        if number % 500 == 0 {
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
        for _ in 0..setting("MUTANTS", 2000) / 100 {
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

const MANIFEST: &str = r#"
[package]
name = "mutants"
version = "0.0.0"
edition = "2024"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["std", "dynamics"] }

[lints.rust]
warnings = "deny"

[profile.dev]
debug = false
incremental = false

[workspace]
"#;

/// Accepted mutants are Rust without a warning.
#[test]
fn accepted_mutants_compile() {
    let count = setting("MUTANTS_COMPILED", 60);
    let root = linkage_tests::ROOT;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mutants");
    fs::create_dir_all(folder.join("src")).unwrap();
    fs::write(folder.join("Cargo.toml"), MANIFEST.replace("ROOT", root)).unwrap();
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    fs::copy(Path::new(root).join("dev/gallery/src/cam_laws.rs"), folder.join("src/cam_laws.rs")).unwrap();
    let (mut mutator, path) = (mutator(), "::linkage".parse().unwrap());
    let mut written = 0;
    while written < count {
        // The number of mutants in one compilation.
        const TOGETHER: usize = 100;
        let together = TOGETHER.min(count - written);
        let mut library = String::from("pub mod cam_laws;\n");
        for number in 0..together {
            let (mutant, expansion) = loop {
                let mutant = mutator.mutant();
                let expansion = linkage_compiler::expand(mutant.clone(), &path);
                if !is_rejected(&expansion) {
                    break (mutant, expansion);
                }
            };
            let text = prettyplease::unparse(&syn::parse2(expansion).unwrap());
            let comment = mutant.to_string().replace('\n', " ");
            fs::write(folder.join(format!("src/mutant_{number}.rs")), format!("// {comment}\n{text}")).unwrap();
            library += &format!("pub mod mutant_{number};\n");
        }
        fs::write(folder.join("src/lib.rs"), library).unwrap();
        let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
        let output = Command::new(cargo)
            .args(["check", "--quiet", "--color=never", "--target-dir"])
            // One folder for all crates that tests write, which have the same dependencies.
            .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("target"))
            .current_dir(&folder)
            .env_remove("RUSTFLAGS")
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "after {written}:\n{errors}");
        written += together;
    }
}
