//! Packages as they would be published: what each says of itself, and its files.

use std::env;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Runs cargo offline in this folder; returns what it prints.
fn cargo(arguments: &[&str]) -> String {
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(arguments)
        .arg("--offline")
        .current_dir(linkage_tests::ROOT)
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The packages that are published: all but those with `publish = false`.
fn published(manifest: &str) -> Vec<Value> {
    let metadata = cargo(&["metadata", "--no-deps", "--format-version=1", "--manifest-path", manifest]);
    let metadata: Value = serde_json::from_str(&metadata).expect("JSON");
    let packages = metadata["packages"].as_array().expect("packages").clone();
    packages.into_iter().filter(|package| package["publish"].is_null()).collect()
}

fn all() -> Vec<(&'static str, Value)> {
    let manifests = ["Cargo.toml", "linkage-sweep-arrow/Cargo.toml"];
    let all = manifests.into_iter().flat_map(|manifest| published(manifest).into_iter().map(move |of| (manifest, of)));
    all.collect()
}

#[test]
fn packages_say_what_they_are() {
    let all = all();
    assert_eq!(all.len(), 15);
    for (_, package) in &all {
        let name = package["name"].as_str().expect("a name");
        for field in ["description", "license", "readme", "rust_version"] {
            assert!(package[field].as_str().is_some_and(|text| !text.is_empty()), "{name} has no {field}");
        }
        for field in ["keywords", "categories"] {
            let count = package[field].as_array().map_or(0, Vec::len);
            assert!((1..=5).contains(&count), "{name} has {count} {field}");
        }
        assert_eq!(package["rust_version"], env!("CARGO_PKG_RUST_VERSION"), "{name}");
        let has_features = package["features"].as_object().is_some_and(|features| !features.is_empty());
        let documents_them = package["metadata"]["docs"]["rs"]["all-features"] == true;
        assert!(!has_features || documents_them, "the documentation of {name} lacks its features");
    }
}

/// Sources, licences and texts for readers, and nothing else.
#[test]
fn packages_hold_what_users_need() {
    for (manifest, package) in all() {
        let name = package["name"].as_str().expect("a name");
        // A lock file is made from the registry, which needs a network.
        let list = cargo(&[
            "package",
            "--list",
            "--allow-dirty",
            "--exclude-lockfile",
            "--manifest-path",
            manifest,
            "--package",
            name,
        ]);
        let files: Vec<&str> = list.lines().collect();
        let root = if name == "linkage-cli" { "src/main.rs" } else { "src/lib.rs" };
        for needed in ["LICENSE-APACHE", "LICENSE-MIT", "README.md", root] {
            assert!(files.contains(&needed), "{name} lacks {needed}");
        }
        // Cargo adds its own.
        let texts = ["LICENSE-APACHE", "LICENSE-MIT", "README.md", "CHANGELOG.md"];
        let own = ["Cargo.toml", "Cargo.toml.orig", "Cargo.lock", ".cargo_vcs_info.json"];
        let is_known = |file: &&str| texts.contains(file) || own.contains(file) || Path::new(file).starts_with("src");
        let others: Vec<&&str> = files.iter().filter(|file| !is_known(file)).collect();
        assert!(others.is_empty(), "{name} has {others:?}");
    }
}

/// Without the feature `serde` no crate of that name is built.
#[test]
fn serde_is_built_on_request_only() {
    let tree = |features: &str| {
        cargo(&["tree", "--package=linkage", "--edges=normal", "--prefix=none", "--no-default-features", features])
    };
    let has_serde = |tree: &str| tree.lines().any(|line| line.starts_with("serde"));
    assert!(!has_serde(&tree("--features=std,dynamics,drawing,sheet,double-double,rounding,simd")));
    assert!(has_serde(&tree("--features=std,serde")));
}

/// The places of tokens in a text cost each expansion; only those who read texts at run time ask for them.
#[test]
fn places_of_tokens_are_built_on_request_only() {
    let keeps_places = |of: &[&str]| {
        // Each package with its features.
        let tree = cargo(&[&["tree", "--edges=no-dev", "--prefix=none", "--format={p} {f}"], of].concat());
        let with_features: Vec<&str> = tree.lines().filter(|line| line.starts_with("proc-macro2 ")).collect();
        assert!(!with_features.is_empty(), "{tree}");
        with_features.iter().any(|line| line.contains("span-locations"))
    };
    for name in ["linkage", "linkage-macros", "linkage-sweep"] {
        assert!(!keeps_places(&["--package", name, "--all-features"]), "{name}");
    }
    assert!(keeps_places(&["--package=linkage-compiler", "--features=text"]));
}
