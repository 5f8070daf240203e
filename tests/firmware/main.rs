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
use std::{env, fs};

use graph::Graph;
use linkage_tests::programs::{Libraries, succeeded, tool, written};

/// The levels of optimisation, with the profiles `firmware-three` .. of the workspace; at the last one most calls are left.
const LEVELS: [(&str, &str); 3] = [("three", "3"), ("two", "2"), ("size", "z")];

/// The target that is asked for, or else this machine.
fn chosen_target() -> Option<String> {
    env::var("FIRMWARE_TARGET").ok()
}

/// `linkage` as firmware has it: without the standard library, by a profile for a target.
fn of_firmware(profile: &str, target: Option<&str>) -> Libraries {
    Libraries::of("linkage", "libm,dynamics", &format!("firmware-{profile}"), target)
}

/// The folder of the libraries of Rust for a target; it exists if the target is installed.
fn of_rust(target: Option<&str>) -> PathBuf {
    let mut command = tool("rustc");
    command.args(["--print", "target-libdir"]).current_dir(linkage_tests::ROOT);
    if let Some(target) = target {
        command.args(["--target", target]);
    }
    PathBuf::from(String::from_utf8(succeeded(&mut command).stdout).unwrap().trim())
}

/// A library that is built in a folder at a level, and all that are under it.
fn libraries(folder: &Path, (profile, level): (&str, &str), target: Option<&str>) -> Vec<PathBuf> {
    let Libraries { mut files, .. } = {
        let libraries = of_firmware(profile, target);
        let mut rustc = libraries.rustc(folder, "lib.rs", &["linkage"]);
        rustc.args(["--crate-type=rlib", "-Cpanic=abort", "-Cembed-bitcode=no"]).arg(format!("-Copt-level={level}"));
        succeeded(&mut rustc);
        libraries
    };
    let own = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.extend(own.filter(|file| file.extension().is_some_and(|end| end == "rlib")));
    let found = fs::read_dir(of_rust(target)).unwrap().map(|entry| entry.unwrap().path());
    let is_core = |file: &PathBuf| {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        name.ends_with(".rlib") && (name.starts_with("libcore-") || name.starts_with("libcompiler_builtins-"))
    };
    files.extend(found.filter(is_core));
    files
}

/// True for a function without type parameters of a module `wrappers` of a library.
fn is_wrapper(library: &str) -> impl Fn(&str) -> bool {
    let beginning = format!("{library}::");
    move |name: &str| {
        // Not a Rust closure inside of a wrapper.
        let inside = name.strip_prefix(&beginning).and_then(|name| name.split_once("::wrappers::"));
        inside.is_some_and(|(_, function)| !function.contains("::"))
    }
}

/// In the outer ring at all levels, otherwise at the last.
#[test]
fn emitted_functions_cannot_panic() {
    let (sources, count) = wrappers::files(Path::new(linkage_tests::ROOT));
    let levels = if linkage_trials::is_outer() { &LEVELS[..] } else { &LEVELS[2..] };
    // Side by side: one after the other, much of the time only one core is busy.
    std::thread::scope(|scope| {
        for level in levels {
            let sources = sources.clone();
            scope.spawn(move || check(sources, *level, count));
        }
    });
}

/// No function of emitted code, of which there are so many, comes to a panic, but for those that search for the modes of
/// contacts or for all positions of a group.
fn check(sources: Vec<(String, String)>, level: (&str, &str), count: usize) {
    let mut graph = Graph::default();
    let name = format!("firmware_{}", level.0);
    let folder = written(&name, sources);
    for library in libraries(&folder, level, chosen_target().as_deref()) {
        graph.add(&library);
    }
    let (is_wrapper, level) = (is_wrapper(&name), level.0);
    let missing = graph.missing(&is_wrapper);
    assert!(missing.is_empty(), "{level}: in no library: {missing:#?}");
    let (planted, emitted): (Vec<_>, Vec<_>) =
        graph.panics(&is_wrapper).into_iter().partition(|(name, _)| name.contains("::planted::"));
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
    // The powers of a scene with frictions by reaction are among them, as function and as columns of tables.
    let search = ["_reactions", "_power", "_applied_and_dissipated", "_drive_forces"];
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
