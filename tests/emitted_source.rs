//! Emitted code as if somebody had written it: a crate made of the expansions alone must pass clippy's
//! pedantic lints, without the standard library, without unsafe code, and with every item documented.

#[path = "source/families.rs"]
mod families;
mod source;

use std::path::Path;
use std::process::Command;
use std::{env, fs};

const MECHANISMS: [&str; 26] = [
    "andrews_scene",
    "belt",
    "block",
    "cam_follower",
    "cam_rocker",
    "components",
    "double_butterfly",
    "elliptic_trammel",
    "every_function",
    "five_bar",
    "five_bar_contacts",
    "five_bar_scenes",
    "four_bar",
    "four_bar_scenes",
    "geared_five_bar",
    "introductory",
    "jansen",
    "norton_four_bar",
    "offset_slider_crank",
    "rpr",
    "rrr",
    "scotch_yoke",
    "six_bar",
    "slider_crank",
    "slider_crank_contacts",
    "slider_crank_scenes",
];

const MANIFEST: &str = r#"
[package]
name = "emitted"
version = "0.0.0"
edition = "2024"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["libm"] }

[lints.rust]
unsafe_code = "forbid"
warnings = "deny"
missing_docs = "deny"

[lints.clippy]
pedantic = { level = "deny", priority = -1 }
# The user chooses the names of the mechanism, and its size.
many_single_char_names = "allow"
similar_names = "allow"
too_many_lines = "allow"
# Clippy itself does not ask this of what a macro emits.
inline_always = "allow"

[workspace]
"#;

#[test]
fn passes_pedantic_lints() {
    let root = env!("CARGO_MANIFEST_DIR");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emitted");
    fs::create_dir_all(folder.join("src")).unwrap();
    fs::write(folder.join("Cargo.toml"), MANIFEST.replace("ROOT", root)).unwrap();
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    fs::copy(Path::new(root).join("tests/source/cam_laws.rs"), folder.join("src/cam_laws.rs")).unwrap();
    let mut library = String::from("//! Expansions of the mechanisms under test.\n#![no_std]\n\npub mod cam_laws;\n");
    // Sensitivities with few entries, and points that need nothing of a block that is factorised.
    let orders = |family: String| {
        let derived = family.replacen('{', "{ derive limits, jerk, velocity_ratio_derivatives, sensitivity;", 1);
        format!("pub {derived}").replace("+ b0_0@t0;", ";").parse().unwrap()
    };
    let families = [("chain", orders(families::chain(3))), ("dense", orders(families::dense(2)))];
    let files = MECHANISMS.map(|mechanism| (mechanism, source::tokens_of(mechanism)));
    for (mechanism, tokens) in files.into_iter().chain(families) {
        let tokens = linkage_compiler::expand(tokens, &"::linkage".parse().unwrap());
        let text = prettyplease::unparse(&syn::parse2(tokens).unwrap());
        fs::write(folder.join(format!("src/{mechanism}.rs")), format!("//! `{mechanism}`.\n\n{text}")).unwrap();
        library += &format!("pub mod {mechanism};\n");
    }
    fs::write(folder.join("src/lib.rs"), library).unwrap();
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["clippy", "--quiet", "--color=never", "--target-dir"])
        .arg(folder.join("target"))
        .current_dir(&folder)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
