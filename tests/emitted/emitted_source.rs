//! Emitted code as if somebody had written it: a crate made of the expansions alone must pass clippy's
//! pedantic lints and those of its nursery, without the standard library, without unsafe code, and with every item documented.

use linkage_gallery::{FILES, families, source};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const MANIFEST: &str = r#"
[package]
name = "emitted"
version = "0.0.0"
edition = "2024"
# The minimum of `linkage`: clippy rejects what is newer in the standard library.
rust-version = "MINIMUM"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["dynamics", "libm"] }

[lints.rust]
unsafe_code = "forbid"
warnings = "deny"
missing_docs = "deny"
future_incompatible = { level = "deny", priority = -1 }
keyword_idents = { level = "deny", priority = -1 }
let_underscore = { level = "deny", priority = -1 }
nonstandard_style = { level = "deny", priority = -1 }
rust_2018_idioms = { level = "deny", priority = -1 }
rust_2021_compatibility = { level = "deny", priority = -1 }
rust_2024_compatibility = { level = "deny", priority = -1 }
refining_impl_trait = { level = "deny", priority = -1 }
unused = { level = "deny", priority = -1 }

[lints.clippy]
all = { level = "deny", priority = -1 }
pedantic = { level = "deny", priority = -1 }
nursery = { level = "deny", priority = -1 }
# These ask for fused multiplication, which is slow where the machine has none.
suboptimal_flops = "allow"
imprecise_flops = "allow"
# The user chooses the names of the mechanism, and its size.
many_single_char_names = "allow"
similar_names = "allow"
too_many_lines = "allow"
# The user writes the documentation of the mechanism, and what its parameters derive.
too_long_first_doc_paragraph = "allow"
derive_partial_eq_without_eq = "allow"
# Clippy itself does not ask this of what a macro emits.
inline_always = "allow"
missing_const_for_fn = "allow"
or_fun_call = "allow"
suspicious_operation_groupings = "allow"

[profile.dev]
debug = false
incremental = false

[workspace]
"#;

/// A folder for a crate of expansions.
fn crate_called(name: &str) -> PathBuf {
    let root = linkage_tests::ROOT;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(folder.join("src")).unwrap();
    let manifest =
        MANIFEST.replace("ROOT", root).replace("MINIMUM", env!("CARGO_PKG_RUST_VERSION")).replacen("emitted", name, 1);
    fs::write(folder.join("Cargo.toml"), manifest).unwrap();
    // A name in the user's own doc comments.
    fs::write(folder.join("clippy.toml"), r#"doc-valid-idents = ["McCarthy", ".."]"#).unwrap();
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    folder
}

/// Runs a command of cargo on the crate in a folder, which must succeed; all crates share one target folder.
fn succeeds(folder: &Path, command: &str) {
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args([command, "--quiet", "--color=never", "--target-dir"])
        .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("target"))
        .current_dir(folder)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn passes_pedantic_lints() {
    let (folder, root) = (crate_called("emitted"), linkage_tests::ROOT);
    fs::copy(Path::new(root).join("dev/gallery/src/cam_laws.rs"), folder.join("src/cam_laws.rs")).unwrap();
    let mut library = String::from("//! Expansions of the mechanisms under test.\n#![no_std]\n\npub mod cam_laws;\n");
    // Sensitivities with few entries, and points that need nothing of a block that is factorised.
    let orders = |family: String| {
        let derived = family.replacen('{', "{ derive limits, jerk, velocity_ratio_derivatives, sensitivity;", 1);
        format!("pub {derived}").replace("+ b0_0@t0;", ";").parse().unwrap()
    };
    let families = [("chain", orders(families::chain(3))), ("dense", orders(families::dense(2)))];
    let files = FILES.iter().map(|&file| (file, source::tokens_of(file)));
    for (mechanism, tokens) in files.chain(families) {
        let tokens = linkage_compiler::expand(tokens, &"::linkage".parse().unwrap());
        let text = prettyplease::unparse(&syn::parse2(tokens).unwrap());
        fs::write(folder.join(format!("src/{mechanism}.rs")), format!("//! `{mechanism}`.\n\n{text}")).unwrap();
        library += &format!("pub mod {mechanism};\n");
    }
    fs::write(folder.join("src/lib.rs"), library).unwrap();
    succeeds(&folder, "clippy");
}

/// Lints that clippy does not ask of what a macro emits, or that the source of a mechanism does not keep.
const OF_SOURCE: [&str; 5] = [
    "derive_partial_eq_without_eq",
    "inline_always",
    "missing_const_for_fn",
    "or_fun_call",
    "suspicious_operation_groupings",
];

/// A user may deny every lint, those of clippy's nursery too, but for the two that ask for fused multiplication, and for
/// lints of the names, the size and the documentation that a mechanism has from its user.
#[test]
fn a_user_may_deny_every_lint() {
    let folder = crate_called("all_lints");
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
    let is_kept = |line: &&str| !OF_SOURCE.iter().any(|lint| line.starts_with(&format!("{lint} = ")));
    let manifest: Vec<&str> = manifest.lines().filter(is_kept).collect();
    fs::write(folder.join("Cargo.toml"), manifest.join("\n")).unwrap();
    let mut library = String::from("//! Mechanisms of a user.\n#![no_std]\n\n");
    let files = FILES.iter().step_by(4);
    let sources = files.map(|file| (file, source::text_of(file))).filter(|(_, text)| !text.contains("crate::"));
    for (file, text) in sources {
        let text = text.replace("PartialEq)]", "PartialEq, Eq)]");
        // Intervals need the standard library.
        let text = text.replace("derive intervals;", "").replace(", intervals;", ";");
        fs::write(folder.join(format!("src/{file}.rs")), format!("//! `{file}`.\n\n{text}")).unwrap();
        library += &format!("pub mod {file};\n");
    }
    fs::write(folder.join("src/lib.rs"), library).unwrap();
    succeeds(&folder, "clippy");
}

/// Every loop of a chain, checked one by one: the input of each is the output of the one before it.
const CHAIN_OF_TWO_HUNDRED: &str = r#"//! A chain of 200 loops, assembled and driven.

mod chain;

use std::hint::black_box;

use chain::{Chain, ChainCoordinates, ChainInputs};
use linkage::Mechanism;
use linkage::nalgebra::SVector;

const LOOPS: usize = 200;

fn main() {
    let chain = Chain::default();
    let near = SVector::from_fn(|place, _| if place % 2 == 0 { 0.4 } else { 1.5 });
    let branch = chain.branch_of(&chain.pose_at(&ChainCoordinates::from(near)));
    let pose = chain.assemble(0.5, branch).unwrap();
    let (residual, sizes) = (chain.residual(&pose), chain.residual_scales(&pose));
    let coordinates: ChainCoordinates = pose.coordinates();
    let rates = chain.velocity(&pose, 2.0).unwrap();
    let accelerations = chain.acceleration(&pose, &rates, 0.0).unwrap();
    let motion = chain.motion(&coordinates, 2.0, 0.0).unwrap();
    let (q, rates) = (SVector::from(coordinates), SVector::from(rates));
    let [accelerations, again] = [accelerations, motion.accelerations].map(SVector::from);
    let (mut input, mut rate, mut input_acceleration) = (0.5, 2.0, 0.0);
    for i in 0..LOOPS {
        let (t, s, t_rate, s_rate) = (q[2 * i], q[2 * i + 1], rates[2 * i], rates[2 * i + 1]);
        for row in [2 * i, 2 * i + 1] {
            assert!(residual[row].abs() <= 8.0 * f64::EPSILON * sizes[row], "loop {i}: {}", residual[row]);
        }
        // a@in + b@t = d + c@s, differentiated and seen along b.
        let (a, b, c): (f64, f64, f64) = (1.0, 3.0, 2.0);
        let expected = a * (input - t).sin() * rate / (c * (s - t).sin());
        assert!((s_rate - expected).abs() <= 1e-12 * expected.abs(), "loop {i}: {s_rate} is not {expected}");
        let along = [
            a * (input - t).sin() * input_acceleration,
            a * (input - t).cos() * rate * rate,
            b * t_rate * t_rate,
            -c * (s - t).cos() * s_rate * s_rate,
        ];
        let scale: f64 = along.iter().map(|term| term.abs()).sum();
        for value in [accelerations[2 * i + 1], again[2 * i + 1]] {
            let rest = along.iter().sum::<f64>() - c * (s - t).sin() * value;
            assert!(rest.abs() <= 1e-12 * scale, "loop {i}: {rest} of {scale}");
        }
        (input, rate, input_acceleration) = (s, s_rate, accelerations[2 * i + 1]);
    }
    // The others need a stack for matrices of 400 x 400, and are compiled only.
    black_box((
        (Chain::<f64>::jacobian_unknowns as fn(&_, &_) -> _, Chain::<f64>::jacobian_inputs as fn(&_, &_) -> _),
        (Chain::<f64>::jacobian as fn(&_, &_) -> _, Chain::<f64>::solve_any_branch as fn(&_, &_) -> _),
        Chain::<f64>::jacobian_unknowns_scales as fn(&_, &_) -> _,
        Chain::<f64>::jacobian_inputs_scales as fn(&_, &_) -> _,
        (Chain::<f64>::determinant as fn(&_, &_) -> _, Chain::<f64>::block_determinants as fn(&_, &_) -> _),
        (Chain::<f64>::solve_jacobian as fn(&_, &_, &_) -> _, Chain::<f64>::gamma as fn(&_, &_, &_) -> _),
        (Chain::<f64>::velocity_ratios as fn(&_, &_) -> _, Chain::<f64>::point_ratios as fn(&_, &_) -> _),
        (Chain::<f64>::solve as fn(&_, &_) -> _, Chain::<f64>::points as fn(&_, &_) -> _),
        (chain::ChainPose::<f64>::is_finite as fn(&_) -> _, ChainInputs::<f64>::from as fn(f64) -> _),
        Chain::DERIVATION,
    ));
}
"#;

/// A mechanism that is nearly as large as one may be compiles in a plain dev build, with full debug information.
#[test]
fn a_chain_of_two_hundred_loops_runs() {
    let folder = crate_called("large");
    let attribute = r#"#[allow(dead_code, reason = "the program calls a few of the emitted functions")]"#;
    let tokens = format!("{attribute} pub {}", families::chain(200)).parse().unwrap();
    let tokens = linkage_compiler::expand(tokens, &"::linkage".parse().unwrap());
    let text = prettyplease::unparse(&syn::parse2(tokens).unwrap());
    fs::write(folder.join("src/chain.rs"), text).unwrap();
    fs::write(folder.join("src/main.rs"), CHAIN_OF_TWO_HUNDRED).unwrap();
    succeeds(&folder, "run");
}
