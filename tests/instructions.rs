//! The instructions of a scene's derivative relative to those of one written by hand, and of the main functions of some
//! mechanisms relative to a committed table.
//!
//! Two programs are built for release by themselves, with nothing but `linkage`, and run by valgrind's callgrind at two
//! numbers of calls, whose difference is that of the calls alone. `.ci/run` calls it and installs valgrind:
//!
//! ```text
//! cargo test --test instructions
//! UPDATE=1 cargo test --test instructions       writes tests/instructions.tsv
//! ```

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const MANIFEST: &str = r#"
[package]
name = "instructions"
version = "0.0.0"
edition = "2024"

[[bin]]
name = "twin"
path = "ROOT/benches/twin.rs"

[[bin]]
name = "kernels"
path = "ROOT/benches/poses/kernels.rs"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["std", "dynamics", "interval"] }

[workspace]
"#;

/// The emitted code may take this many times the instructions by hand: another version of the compiler moves both by some
/// per cent. On Rust 1.95 they take 0.94 and 0.95 times as many.
const MARGIN: f64 = 1.05;

/// A function may take this fraction more or less than the table says.
const TOLERANCE: f64 = 0.03;

/// Calls of the first run; the second makes three times as many.
const CALLS: u64 = 1000;

/// Builds a program; returns its path.
fn built(name: &str) -> PathBuf {
    let root = linkage_tests::ROOT;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("Cargo.toml"), MANIFEST.replace("ROOT", root)).unwrap();
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("instructions");
    let output = Command::new(env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()))
        .args(["build", "--release", "--quiet", "--color=never", "--bin", name, "--target-dir"])
        .arg(&target)
        .current_dir(&folder)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    target.join("release").join(name)
}

/// All that a run takes.
fn instructions(program: &Path, arguments: [&str; 2], calls: u64) -> u64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(arguments)
        .arg(calls.to_string())
        .output()
        .expect("valgrind counts the instructions: install it");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    let (_, count) = text.split_once("Collected : ").expect(&text);
    count.split_whitespace().next().unwrap().parse().unwrap()
}

/// The instructions of one call.
fn a_call(program: &Path, arguments: [&str; 2]) -> f64 {
    let [once, more] = [CALLS, 3 * CALLS].map(|calls| instructions(program, arguments, calls));
    (more - once) as f64 / (2 * CALLS) as f64
}

#[test]
fn a_scene_takes_no_more_than_its_hand_written_twin() {
    let program = built("twin");
    for scene in ["bare", "mounted"] {
        let [emitted, alone, hand] = ["emitted", "alone", "hand"].map(|version| a_call(&program, [scene, version]));
        println!("{scene}: {emitted} instructions a call, {alone} with no other scene declared, {hand} by hand");
        assert!(emitted > 100.0 && hand > 100.0, "{scene}: the calls are counted");
        let most = MARGIN * hand;
        assert!(emitted <= most && alone <= most, "{scene}: {emitted}, alone {alone}, by hand {hand}");
        // The same operations, which the compiler puts in registers in another order.
        assert!((emitted - alone).abs() <= 0.02 * hand, "{scene}: {emitted}, alone {alone}");
    }
}

#[test]
fn functions_take_what_the_table_says() {
    let program = built("kernels");
    let table = Path::new(linkage_tests::ROOT).join("tests/instructions.tsv");
    let committed = fs::read_to_string(&table).unwrap();
    let mut found = String::from("mechanism\tfunction\tinstructions\n");
    let mut wrong = Vec::new();
    let mechanisms = ["four_bar", "slider_crank", "stephenson_iii", "jansen", "chain"];
    let functions = ["kinematics", "assemble", "velocity", "acceleration", "pose_at", "motion"];
    let single = mechanisms.iter().flat_map(|mechanism| functions.map(|function| [*mechanism, function]));
    // Of eight lanes: more if the loop over them is not vectorised.
    for [mechanism, function] in single.chain([["four_bar", "lanes"], ["jansen", "lanes"]]) {
        let count = a_call(&program, [mechanism, function]);
        let name = format!("{mechanism}\t{function}\t");
        writeln!(found, "{name}{count:.0}").unwrap();
        let known: Option<f64> =
            committed.lines().find_map(|line| line.strip_prefix(&name)).map(|count| count.parse().unwrap());
        if known.is_none_or(|known| (count - known).abs() > TOLERANCE * known) {
            wrong.push(format!("{name}{count:.0}, in the table {known:?}"));
        }
    }
    if env::var_os("UPDATE").is_some() {
        fs::write(&table, found).unwrap();
    } else {
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }
}
