//! Programs with mistakes in a package of their own, and the messages of rustc and of the macro for them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, panic};

use serde_json::Value;

const MANIFEST: &str = r#"
[package]
name = "NAME"
version = "0.0.0"
edition = "2024"

[dependencies]
linkage = { path = "ROOT", features = ["double-double", "interval", "rounding", "serde"] }

[workspace]
"#;

/// A package of this name with these files, in their places.
pub fn package(name: &str, files: impl IntoIterator<Item = (String, String)>) -> PathBuf {
    let root = linkage_tests::ROOT;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // Those of an earlier version of the list.
    drop(fs::remove_dir_all(folder.join("src")));
    let manifest = MANIFEST.replace("NAME", name).replace("ROOT", root);
    for (file, text) in files.into_iter().chain([("Cargo.toml".to_owned(), manifest)]) {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    folder
}

/// The messages with a place that cargo gives for the targets of a package, in their order, as rustc writes them.
pub fn messages(folder: &Path, targets: &[&str]) -> Vec<Value> {
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["check", "--quiet", "--keep-going", "--message-format=json"])
        .args(targets)
        .arg("--target-dir")
        // One folder for the packages of these tests, which have the same dependencies.
        .arg(folder.with_file_name("messages"))
        .current_dir(folder)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    let lines = String::from_utf8(output.stdout).unwrap();
    let lines = lines.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    // The count of errors has no place.
    let has_place = |line: &Value| line["message"]["spans"].as_array().is_some_and(|spans| !spans.is_empty());
    let path = folder.join("Cargo.toml");
    let is_here = |line: &Value| line["manifest_path"].as_str().is_some_and(|of| Path::new(of) == path);
    let found: Vec<Value> = lines.filter(|line| has_place(line) && is_here(line)).collect();
    assert!(!found.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    found
}

/// Compares each text with its snapshot in this folder, which has no others; all that differ are shown.
pub fn compare(folder: &str, texts: &[(String, String)]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("messages/snapshots").join(folder);
    let settings = || {
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(&path);
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings
    };
    let differs = |(name, text): &&(String, String)| {
        let compared = panic::catch_unwind(|| settings().bind(|| insta::assert_snapshot!(name.as_str(), text)));
        compared.is_err()
    };
    let different: Vec<&str> = texts.iter().filter(differs).map(|(name, _)| name.as_str()).collect();
    assert!(different.is_empty(), "{} of {} differ: {different:?}", different.len(), texts.len());
    let expected: BTreeSet<String> = texts.iter().map(|(name, _)| format!("{name}.snap")).collect();
    let found = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let stale: Vec<String> = found.filter(|file| !expected.contains(file)).collect();
    assert!(stale.is_empty(), "no program has these messages: {stale:?}");
}
