//! The instructions of a scene's derivative relative to those of one written by hand.
//!
//! `benches/twin.rs` is built for release by itself, with nothing but `linkage`, and run by valgrind's callgrind at two
//! numbers of calls, whose difference is that of the calls alone. `.ci/run` calls it and installs valgrind:
//!
//! ```text
//! cargo test --test instructions
//! ```

use std::path::Path;
use std::process::Command;
use std::{env, fs};

const MANIFEST: &str = r#"
[package]
name = "twin"
version = "0.0.0"
edition = "2024"

[[bin]]
name = "twin"
path = "ROOT/benches/twin.rs"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["std", "dynamics"] }

[workspace]
"#;

/// The emitted code may take this many times the instructions by hand: another version of the compiler moves both by some
/// per cent. On Rust 1.95 they take 0.94 and 0.95 times as many.
const MARGIN: f64 = 1.05;

/// Calls of the first run; the second makes three times as many.
const CALLS: u64 = 1000;

/// All that a run takes.
fn instructions(program: &Path, scene: &str, version: &str, calls: u64) -> u64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args([scene, version, &calls.to_string()])
        .output()
        .expect("valgrind counts the instructions: install it");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    let (_, count) = text.split_once("Collected : ").expect(&text);
    count.split_whitespace().next().unwrap().parse().unwrap()
}

#[test]
fn a_scene_takes_no_more_than_its_hand_written_twin() {
    let root = env!("CARGO_MANIFEST_DIR");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("twin");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("Cargo.toml"), MANIFEST.replace("ROOT", root)).unwrap();
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let output = Command::new(env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()))
        .args(["build", "--release", "--quiet", "--color=never", "--target-dir"])
        .arg(folder.join("target"))
        .current_dir(&folder)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let program = folder.join("target/release/twin");
    for scene in ["bare", "mounted"] {
        let a_call = |version: &str| {
            let [once, more] = [CALLS, 3 * CALLS].map(|calls| instructions(&program, scene, version, calls));
            (more - once) as f64 / (2 * CALLS) as f64
        };
        let [emitted, alone, hand] = ["emitted", "alone", "hand"].map(a_call);
        println!("{scene}: {emitted} instructions a call, {alone} with no other scene declared, {hand} by hand");
        assert!(emitted > 100.0 && hand > 100.0, "{scene}: the calls are counted");
        let most = MARGIN * hand;
        assert!(emitted <= most && alone <= most, "{scene}: {emitted}, alone {alone}, by hand {hand}");
        // The same operations, which the compiler puts in registers in another order.
        assert!((emitted - alone).abs() <= 0.02 * hand, "{scene}: {emitted}, alone {alone}");
    }
}
