//! The instructions of a scene's derivative beside those of one written by hand, which no machine's mood changes.
//!
//! `benches/twin.rs` is built for release by itself, with nothing but `linkage`, and run by valgrind's callgrind at two
//! numbers of calls, whose difference is that of the calls alone. Without valgrind nothing is tested, and said so.

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

/// As many, and three times as many.
const CALLS: u64 = 1000;

/// All that a run takes.
fn instructions(program: &Path, scene: &str, road: &str, calls: u64) -> u64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args([scene, road, &calls.to_string()])
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    let (_, count) = text.split_once("Collected : ").expect(&text);
    count.split_whitespace().next().unwrap().parse().unwrap()
}

#[test]
fn a_scene_takes_no_more_than_its_hand_written_twin() {
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("not tested: there is no valgrind to count instructions");
        return;
    }
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
        let a_call = |road: &str| {
            let [once, more] = [CALLS, 3 * CALLS].map(|calls| instructions(&program, scene, road, calls));
            (more - once) as f64 / (2 * CALLS) as f64
        };
        let [emitted, alone, hand] = ["emitted", "alone", "hand"].map(a_call);
        println!("{scene}: {emitted} instructions a call, {alone} with no other scene declared, {hand} by hand");
        assert!(emitted > 100.0 && hand > 100.0, "{scene}: the calls are counted");
        assert!(emitted <= hand && alone <= hand, "{scene}: {emitted}, alone {alone}, by hand {hand}");
        // The same operations, which the compiler puts in registers in another order.
        assert!((emitted - alone).abs() <= 0.02 * hand, "{scene}: {emitted}, alone {alone}");
    }
}
