//! Emitted code as if somebody had written it: a crate made of the expansions alone must pass clippy's
//! pedantic lints and those of its nursery, without the standard library, without unsafe code, and with every item documented.
//!
//! `RING=outer` looks at every file of the gallery, and makes a chain of 200 loops.

use std::process::Command;

use linkage_gallery::{FILES, families, source};
use linkage_tests::programs::{Libraries, succeeded, written};
use linkage_tests::turn;
use linkage_trials::is_outer;
use proc_macro2::TokenStream;

/// All that is denied, then what is allowed all the same.
const DENIED: [&str; 15] = [
    "unsafe_code",
    "warnings",
    "missing_docs",
    "future_incompatible",
    "keyword_idents",
    "let_underscore",
    "nonstandard_style",
    "rust_2018_idioms",
    "rust_2021_compatibility",
    "rust_2024_compatibility",
    "refining_impl_trait",
    "unused",
    "clippy::all",
    "clippy::pedantic",
    "clippy::nursery",
];
const ALLOWED: [&str; 7] = [
    // These ask for fused multiplication, which is slow where the machine has none.
    "suboptimal_flops",
    "imprecise_flops",
    // The user chooses the names of the mechanism, and its size.
    "many_single_char_names",
    "similar_names",
    "too_many_lines",
    // The user writes the documentation of the mechanism, and what its parameters derive.
    "too_long_first_doc_paragraph",
    "derive_partial_eq_without_eq",
];
/// Lints that clippy does not ask of what a macro emits.
const NOT_OF_MACROS: [&str; 4] =
    ["inline_always", "missing_const_for_fn", "or_fun_call", "suspicious_operation_groupings"];

/// The minimum of `linkage`, since clippy rejects what is newer in the standard library; a name in the user's own doc
/// comments.
const SETTINGS: &str =
    concat!("msrv = \"", env!("CARGO_PKG_RUST_VERSION"), "\"\ndoc-valid-idents = [\"McCarthy\", \"..\"]\n");

/// One mechanism of each kind: scenes with every effect and with contacts, functions of the user and of the language,
/// groups of two loops, limits, change points, tangential accelerations.
const ALWAYS: [&str; 8] = [
    "cam_follower",
    "double_butterfly",
    "every_function",
    "five_bar_contacts",
    "four_bar_effects",
    "inverted_slider_crank",
    "klann_mirrored",
    "slider_crank_scenes",
];

/// The files of the gallery that are looked at: those, and some that turn with the commit; all in the outer ring.
fn files() -> impl Iterator<Item = &'static str> {
    let turned = turn::of(FILES.len(), 20);
    let is_looked_at =
        move |(place, file): &(usize, &'static str)| is_outer() || ALWAYS.contains(file) || turned(*place);
    FILES.iter().copied().enumerate().filter(is_looked_at).map(|(_, file)| file)
}

/// Modules that pass these lints, in a crate without the standard library.
fn passes(name: &str, modules: Vec<(String, String)>, allowed: &[&str]) {
    let mut library = String::from("//! Mechanisms under test.\n#![no_std]\n\n");
    for (module, _) in &modules {
        library += &format!("pub mod {module};\n");
    }
    let modules = modules.into_iter().map(|(module, text)| (format!("{module}.rs"), text));
    let others = [("lib.rs", library), ("clippy.toml", SETTINGS.to_owned())];
    let others = others.map(|(file, text)| (file.to_owned(), text));
    let folder = written(name, modules.chain(others));
    let mut clippy = Libraries::of_tests().clippy(&folder, "lib.rs", &["linkage"]);
    clippy.arg("--crate-type=lib").args(DENIED.map(|lint| format!("-D{lint}")));
    succeeded(clippy.args(allowed.iter().map(|lint| format!("-Aclippy::{lint}"))));
}

#[test]
fn passes_pedantic_lints() {
    // Sensitivities with few entries, and points that need nothing of a block that is factorised.
    let orders = |family: String| {
        let derived = family.replacen('{', "{ derive limits, jerk, velocity_ratio_derivatives, sensitivity;", 1);
        format!("pub {derived}").replace("+ b0_0@t0;", ";").parse().unwrap()
    };
    let families = [("chain", orders(families::chain(3))), ("dense", orders(families::dense(2)))];
    let files = files().map(|file| (file, source::tokens_of(file)));
    let laws = ("cam_laws".to_owned(), include_str!("../../dev/gallery/src/cam_laws.rs").to_owned());
    let module = |(mechanism, tokens): (&str, TokenStream)| {
        let tokens = linkage_compiler::expand(tokens, &"::linkage".parse().unwrap());
        let text = prettyplease::unparse(&syn::parse2(tokens).unwrap());
        (mechanism.to_owned(), format!("//! `{mechanism}`.\n\n{text}"))
    };
    let modules = files.chain(families).map(module).chain([laws]).collect();
    passes("emitted", modules, &[&ALLOWED[..], &NOT_OF_MACROS].concat());
}

/// A user may deny every lint, those of clippy's nursery too, but for the two that ask for fused multiplication, and for
/// lints of the names, the size and the documentation that a mechanism has from its user.
#[test]
fn a_user_may_deny_every_lint() {
    let own = FILES.iter().map(|&file| (file, source::text_of(file))).filter(|(_, text)| !text.contains("crate::"));
    let own: Vec<_> = own.collect();
    let turned = turn::of(own.len(), if is_outer() { 4 } else { 40 });
    let module = |(file, text): (&str, &str)| {
        let text = text.replace("PartialEq)]", "PartialEq, Eq)]");
        (file.to_owned(), format!("//! `{file}`.\n\n{text}"))
    };
    let chosen = own.into_iter().enumerate().filter(|(place, _)| turned(*place));
    let modules = chosen.map(|(_, one)| module(one)).collect();
    let of_source = |lint: &&str| *lint != "derive_partial_eq_without_eq";
    passes("all_lints", modules, &ALLOWED.into_iter().filter(of_source).collect::<Vec<_>>());
}

/// Every loop of a chain, checked one by one: the input of each is the output of the one before it.
const CHAIN: &str = r#"//! A chain of loops, assembled and driven.

mod chain;

use std::hint::black_box;

use chain::{Chain, ChainCoordinates, ChainInputs};
use linkage::Mechanism;
use linkage::nalgebra::SVector;

const LOOPS: usize = COUNT;

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

/// A mechanism that is nearly as large as one may be compiles in a plain dev build, with full debug information: of 200
/// loops, of 20 in the inner ring.
#[test]
fn a_long_chain_of_loops_runs() {
    let loops = linkage_trials::count("LOOPS", 20, 200);
    let attribute = r#"#[allow(dead_code, reason = "the program calls a few of the emitted functions")]"#;
    let tokens = format!("{attribute} pub {}", families::chain(loops)).parse().unwrap();
    let tokens = linkage_compiler::expand(tokens, &"::linkage".parse().unwrap());
    let text = prettyplease::unparse(&syn::parse2(tokens).unwrap());
    let files = [("chain.rs", text), ("main.rs", CHAIN.replace("COUNT", &loops.to_string()))];
    let folder = written("large", files.map(|(file, text)| (file.to_owned(), text)));
    let mut rustc = Libraries::of_tests().rustc(&folder, "main.rs", &["linkage"]);
    let lints = DENIED.into_iter().filter(|lint| !lint.contains("clippy")).map(|lint| format!("-D{lint}"));
    succeeded(rustc.arg("-Cdebuginfo=2").args(lints));
    succeeded(&mut Command::new(folder.join("large")));
}
