//! Emitted code cannot panic: no function that panics is left in what firmware links.
//!
//! A library without the standard library holds every function that is emitted for every mechanism and scene of these
//! tests, compiled at the levels that firmware uses. In its object files, and in those of all libraries under it and of
//! `core`, no call leads from an emitted function to a function that panics.
//!
//! In `f32`, no double is computed with either: `single_precision`. Numbers have the bits that they have with the standard
//! library: `without_std`.
//!
//! ```text
//! cargo test --test firmware                                          for this machine
//! FIRMWARE_TARGET=thumbv7em-none-eabihf cargo test --test firmware    for another target that is installed
//! ```

#![cfg(target_os = "linux")]

mod graph;
mod numbers;
mod single_precision;
mod without_std;
mod wrappers;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use graph::Graph;

const MANIFEST: &str = r#"
[package]
name = "firmware"
version = "0.0.0"
edition = "2024"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["libm", "dynamics"] }

[profile.three]
inherits = "release"
opt-level = 3
panic = "abort"

[profile.two]
inherits = "three"
opt-level = 2

[profile.size]
inherits = "three"
opt-level = "z"

[workspace]
"#;

/// The levels of optimisation by the names of their profiles.
const LEVELS: [&str; 3] = ["three", "two", "size"];

fn cargo() -> Command {
    let mut command = Command::new(env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()));
    command.env_remove("RUSTFLAGS");
    command
}

/// The target that is asked for, or else this machine.
fn chosen_target() -> Option<String> {
    env::var("FIRMWARE_TARGET").ok()
}

/// Writes a package with these files and returns its folder. A file that is there is not written, so that it is not built
/// again.
fn package(name: &str, manifest: &str, files: Vec<(String, String)>) -> PathBuf {
    let root = linkage_tests::ROOT;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(folder.join("src")).unwrap();
    let manifest = ("Cargo.toml".to_owned(), manifest.replace("ROOT", root));
    let sources = files.into_iter().map(|(file, text)| (format!("src/{file}"), text));
    for (file, text) in sources.chain([manifest]) {
        let path = folder.join(file);
        if fs::read_to_string(&path).ok().as_ref() != Some(&text) {
            fs::write(path, text).unwrap();
        }
    }
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    folder
}

/// The files that a package makes, built in its folder at a level for a target.
fn built(folder: &Path, level: &str, target: Option<&str>, is_meant: impl Fn(&Path) -> bool) -> Vec<PathBuf> {
    let mut command = cargo();
    command.args(["build", "--quiet", "--message-format=json-render-diagnostics", "--profile", level, "--target-dir"]);
    // One for all packages, so that the macro is built once.
    command.arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("firmware/target")).current_dir(folder);
    if let Some(target) = target {
        command.args(["--target", target]);
    }
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let messages = String::from_utf8(output.stdout).unwrap();
    let messages = messages.lines().map(|line| serde_json::from_str::<serde_json::Value>(line).unwrap());
    let files = messages.filter_map(|message| message["filenames"].as_array().cloned()).flatten();
    files.filter_map(|file| Some(PathBuf::from(file.as_str()?))).filter(|file| is_meant(file)).collect()
}

/// The folder of the libraries of Rust for a target; it exists if the target is installed.
fn of_rust(folder: &Path, target: Option<&str>) -> PathBuf {
    let mut command = Command::new(env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned()));
    command.args(["--print", "target-libdir"]);
    if let Some(target) = target {
        command.args(["--target", target]);
    }
    let output = command.current_dir(folder).output().unwrap();
    PathBuf::from(String::from_utf8(output.stdout).unwrap().trim())
}

/// The library and all that are under it, built in a folder at a level.
fn libraries(folder: &Path, level: &str, target: Option<&str>) -> Vec<PathBuf> {
    let mut files = built(folder, level, target, |file| file.extension().is_some_and(|end| end == "rlib"));
    let found = fs::read_dir(of_rust(folder, target)).unwrap().map(|entry| entry.unwrap().path());
    let is_core = |file: &PathBuf| {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        name.ends_with(".rlib") && (name.starts_with("libcore-") || name.starts_with("libcompiler_builtins-"))
    };
    files.extend(found.filter(is_core));
    files
}

#[test]
fn emitted_functions_cannot_panic() {
    let (sources, count) = wrappers::files(Path::new(linkage_tests::ROOT));
    let folder = package("firmware", MANIFEST, sources);
    // Side by side: one after the other, much of the time only one core is busy.
    std::thread::scope(|scope| {
        for level in LEVELS {
            let folder = &folder;
            scope.spawn(move || judge(folder, level, count));
        }
    });
}

/// No function of emitted code, of which there are so many, comes to a panic, but for those that search for the modes of
/// contacts or for all positions of a group.
fn judge(folder: &Path, level: &str, count: usize) {
    let mut graph = Graph::default();
    for library in libraries(folder, level, chosen_target().as_deref()) {
        graph.add(&library);
    }
    // Not a Rust closure inside of a wrapper.
    let is_wrapper = |name: &str| {
        let inside = name.strip_prefix("firmware::").and_then(|name| name.split_once("::wrappers::"));
        inside.is_some_and(|(_, function)| !function.contains("::"))
    };
    let missing = graph.missing(is_wrapper);
    assert!(missing.is_empty(), "{level}: in no library: {missing:#?}");
    let (planted, emitted): (Vec<_>, Vec<_>) =
        graph.panics(is_wrapper).into_iter().partition(|(name, _)| name.contains("::planted::"));
    let last = |name: &str| name.rsplit("::").next().unwrap_or_default().to_owned();
    let mut found: Vec<_> = planted.iter().map(|(name, way)| (last(name), way.is_some())).collect();
    found.sort_unstable();
    let expected = [("indexes", true), ("looks", false), ("points", true)];
    assert_eq!(found, expected.map(|(name, panics)| (name.to_owned(), panics)), "{level}: {planted:#?}");
    assert_eq!(emitted.len(), count, "{level}: each function that is emitted is in the library once");
    let ways: Vec<String> = emitted.iter().filter_map(|(_, way)| Some(way.as_ref()?.join("\n     -> "))).collect();
    // The modes of contacts at rest are searched for by the library, whose loops over contacts are not shown to stay
    // within their arrays.
    let (searching, ways): (Vec<_>, Vec<_>) =
        ways.into_iter().partition(|way| way.contains("-> linkage_dynamics::reactions::"));
    let search = ["_reactions", "_power", "_drive_forces"];
    let is_known = |way: &String| way.lines().next().is_some_and(|name| search.iter().any(|end| name.ends_with(end)));
    assert!(searching.iter().all(is_known), "{level}: {searching:#?}");
    // So are the positions of groups of two and three loops.
    let (listing, ways): (Vec<_>, Vec<_>) =
        ways.into_iter().partition(|way| way.contains("-> linkage_runtime::modes::"));
    let lists = |way: &String| {
        way.lines().next().is_some_and(|name| name.ends_with("_assemble") || name.ends_with("_branches"))
    };
    assert!(listing.iter().all(lists), "{level}: {listing:#?}");
    println!("{level}: {} of {count} functions can come to a panic", ways.len());
    assert!(ways.is_empty(), "{level}: {} of {count} functions can come to a panic:\n{}", ways.len(), ways.join("\n"));
}
