//! Programs with mistakes: the messages of rustc and of the macro for them, and their snapshots.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{fs, panic};

use linkage_tests::programs::Libraries;
use serde_json::Value;

/// The messages with a place that rustc gives for a crate in a folder, in their order; its files are named as in the folder.
pub fn messages(folder: &Path, file: &str, kind: &str) -> Vec<Value> {
    let mut rustc = Libraries::of_tests().rustc(folder, file, &["linkage"]);
    rustc.args(["--crate-type", kind, "--emit=metadata", "--error-format=json"]);
    let output = rustc.output().unwrap();
    let lines = String::from_utf8(output.stderr).unwrap().replace(&format!("{}/", folder.display()), "");
    let found = lines.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    // The count of errors has no place.
    let has_place = |line: &Value| line["spans"].as_array().is_some_and(|spans| !spans.is_empty());
    let found: Vec<Value> = found.filter(has_place).collect();
    assert!(!found.is_empty(), "{file}: {lines}");
    found
}

/// The folder of some snapshots.
fn snapshots(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("messages/snapshots").join(folder)
}

/// A snapshot without its head; empty if there is none.
pub fn snapshot(folder: &str, name: &str) -> String {
    let text = fs::read_to_string(snapshots(folder).join(format!("{name}.snap"))).unwrap_or_default();
    text.splitn(3, "---\n").nth(2).unwrap_or_default().to_owned()
}

/// Compares each text with its snapshot in this folder, which has no others but those with these names; all that differ are
/// shown.
pub fn compare<'n>(folder: &str, texts: &[(String, String)], names: impl IntoIterator<Item = &'n str>) {
    let path = snapshots(folder);
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
    let expected: BTreeSet<String> = names.into_iter().map(|name| format!("{name}.snap")).collect();
    let found = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let stale: Vec<String> = found.filter(|file| !expected.contains(file)).collect();
    assert!(stale.is_empty(), "no program has these messages: {stale:?}");
}
