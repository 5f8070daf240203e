//! The instructions of a scene's derivative relative to those of one written by hand, and of the main functions of some
//! mechanisms relative to a committed table.
//!
//! Programs are built for release by themselves, with nothing but `linkage` or `linkage-interpreter`, and run by valgrind's
//! callgrind at two numbers of calls, whose difference is that of the calls alone. `.ci/run` calls it and installs valgrind:
//!
//! ```text
//! cargo test --test instructions
//! UPDATE=1 cargo test --test instructions       writes tests/instructions.tsv
//! ```

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use linkage_tests::programs::{Libraries, succeeded, written};

/// The emitted code may take this many times the instructions by hand: another version of the compiler moves both by some
/// per cent. On Rust 1.95 they take 0.94 and 0.95 times as many.
const MARGIN: f64 = 1.05;

/// A function may take this fraction more or less than the table says.
const TOLERANCE: f64 = 0.03;

/// Calls of the first run; the second makes three times as many.
const CALLS: u64 = 1000;

/// Fewer calls of what takes millions of instructions.
const FEW_CALLS: u64 = 2;

/// Builds a program with a library of these features for release; returns its path.
fn built(name: &str, path: &str, [library, features]: [&str; 2]) -> PathBuf {
    let named = library.replace('-', "_");
    let folder = written(name, []);
    fs::create_dir_all(&folder).unwrap();
    let file = Path::new(linkage_tests::ROOT).join("benches").join(path);
    let mut rustc = Libraries::of(library, features, "release", None).rustc(&folder, file.to_str().unwrap(), &[&named]);
    succeeded(rustc.args(["-Copt-level=3", "-Cembed-bitcode=no", "-Cstrip=debuginfo"]));
    folder.join(name)
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
fn a_call(program: &Path, arguments: [&str; 2], calls: u64) -> f64 {
    let [once, more] = [calls, 3 * calls].map(|calls| instructions(program, arguments, calls));
    (more - once) as f64 / (2 * calls) as f64
}

#[test]
fn a_scene_takes_no_more_than_its_hand_written_twin() {
    let program = built("twin", "twin.rs", ["linkage", "std,dynamics,interval"]);
    for scene in ["bare", "mounted"] {
        let [emitted, alone, hand] =
            ["emitted", "alone", "hand"].map(|version| a_call(&program, [scene, version], CALLS));
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
    let kernels = &built("kernels", "poses/kernels.rs", ["linkage", "std,dynamics,interval"]);
    let from_text = &built("from_text", "from_text.rs", ["linkage-interpreter", "default"]);
    let table = Path::new(linkage_tests::ROOT).join("tests/instructions.tsv");
    let committed = fs::read_to_string(&table).unwrap();
    let mut found = String::from("mechanism\tfunction\tinstructions\n");
    let mut wrong = Vec::new();
    let mechanisms = ["four_bar", "slider_crank", "stephenson_iii", "jansen", "chain"];
    let functions = ["kinematics", "assemble", "velocity", "acceleration", "pose_at", "motion"];
    let single = mechanisms.iter().flat_map(|mechanism| functions.map(|function| [*mechanism, function]));
    // Of eight lanes: more if the loop over them is not vectorised.
    let emitted = single.chain([["four_bar", "lanes"], ["jansen", "lanes"]]).map(|row| (kernels, row, CALLS));
    let at_run_time = ["four_bar", "jansen"].into_iter().flat_map(|mechanism| {
        [("by_name", CALLS), ("from_text", FEW_CALLS)]
            .map(|(function, calls)| (from_text, [mechanism, function], calls))
    });
    for (program, [mechanism, function], calls) in emitted.chain(at_run_time) {
        let count = a_call(program, [mechanism, function], calls);
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
