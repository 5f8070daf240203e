//! Every public function of every mechanism and scene of these tests, called with random and extreme arguments: every
//! number of an `Ok` is finite, no call takes more than a stated number of evaluations, none panics.
//!
//! The program that makes the calls is written from what the compiler emits: each `pub fn` of each `impl` becomes one
//! call, with arguments by their types, and each emitted type is taken apart field by field. So a new mechanism, a new
//! function and a new field need no line here, and an argument of a new kind is a failure.
//!
//! ```text
//! cargo test --test input invalid_numbers                                  100 000 calls
//! INVALID_NUMBERS_TRIALS=100000 cargo test --test input invalid_numbers    this many calls of each function, in release
//! ```

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use linkage_tests::calls;

/// Calls of each function in an ordinary run of the tests.
const TRIALS: &str = "40";

/// The program is a package of its own, with all checks in release too.
const MANIFEST: &str = r#"
[package]
name = "invalid_numbers"
version = "0.0.0"
edition = "2024"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["std", "dynamics"] }
rand = { version = "0.9", default-features = false, features = ["small_rng"] }

[profile.dev]
debug = false
incremental = false

[profile.release]
opt-level = 1
overflow-checks = true
debug-assertions = true

[workspace]
"#;

const MAIN: &str = r#"
include!("subjects.rs");
#[path = "ROOT/tests/input/invalid_numbers/trials.rs"]
mod trials;
fn main() -> std::process::ExitCode {
    trials::main(SUBJECTS)
}
"#;

#[test]
fn no_ok_holds_a_number_that_is_not_finite() {
    let root = linkage_tests::ROOT;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("invalid_numbers");
    fs::create_dir_all(folder.join("src")).unwrap();
    fs::write(folder.join("Cargo.toml"), MANIFEST.replace("ROOT", root)).unwrap();
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let main = ("main.rs".to_owned(), MAIN.replace("ROOT", root));
    for (file, text) in calls::files(Path::new(root), None).into_iter().chain([main]) {
        let path = folder.join("src").join(file);
        // An unchanged program is not built again.
        if fs::read_to_string(&path).ok().as_ref() != Some(&text) {
            fs::write(path, text).unwrap();
        }
    }
    let (trials, profile) = match env::var("INVALID_NUMBERS_TRIALS") {
        Ok(trials) => (trials, "release"),
        Err(_) => (TRIALS.to_owned(), "dev"),
    };
    let output = Command::new(env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()))
        .args(["run", "--quiet", "--color=never", "--profile", profile, "--target-dir"])
        // One folder for all crates that tests write, which have the same dependencies.
        .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("target"))
        .args(["--", &trials])
        .current_dir(&folder)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    println!("{}", String::from_utf8_lossy(&output.stdout));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
