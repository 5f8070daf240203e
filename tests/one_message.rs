//! One mistake is one message: the first program of the README with a mistake planted in its mechanism gives the
//! message of the macro and nothing of rustc, because types and functions stand there for the rest of the program.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

/// A mistake: its name, the text of the README that is replaced, the replacement, and the message.
const MISTAKES: &[(&str, &str, &str, &str)] = &[
    // Names.
    ("misspelt_in_loop", "l3@theta3 + l4@", "l3@thta3 + l4@", "unknown name `thta3`"),
    ("misspelt_in_point", "B + l3@theta3", "A + l3@theta3", "unknown name `A`"),
    ("misspelt_in_default", "l4 = 70", "l4 = seventy", "unknown name `seventy`"),
    ("name_in_default", "l4 = 70", "l4 = l1", "a default must be a number"),
    ("duplicate_parameter", "l4 = 70", "l4 = 70, l4 = 80", "`l4` is already in use"),
    ("duplicate_unknown", "theta3, theta4;", "theta3, theta4, theta3;", "`theta3` is already in use"),
    ("input_among_unknowns", "theta3, theta4;", "theta3, theta4, theta2;", "`theta2` is already in use"),
    ("point_like_point", "point G3", "point C", "`C` is already in use"),
    ("point_like_parameter", "point G3", "point l3", "`l3` is already in use"),
    ("points_of_one_field", "point G3", "point c", "both become the field `c`"),
    ("rust_keyword", "point G3", "point fn", "`fn` is a Rust keyword"),
    ("undeclared_parameter", ", l4 = 70", "", "unknown name `l4`"),
    ("unused_parameter", "l4 = 70", "l4 = 70, l5 = 10", "the parameter `l5` is never used"),
    ("unused_unknown", "theta3, theta4;", "theta3, theta4, theta5;", "the coordinate `theta5` is never used"),
    ("unused_input", "input   theta2;", "input   theta2, theta5;", "the coordinate `theta5` is never used"),
    ("missing_unknown", "theta3, theta4;", "theta3;", "unknown name `theta4`"),
    ("misspelt_unknown", "theta3, theta4;", "thta3, theta4;", "unknown name `theta3`"),
    ("missing_input", "input   theta2;", "", "unknown name `theta2`"),
    ("used_before_definition", "point B  =", "point B  = C +", "used before it is defined"),
    // Counts.
    ("equation_too_many", "point B  =", "equation theta3 = theta4; point B  =", "2 unknowns, but 3 scalar equations"),
    ("loop_too_many", "point B  =", "loop l2@theta3 = l1@theta4; point B  =", "2 unknowns, but 4 scalar equations"),
    ("implied_point", "point B  =", "implied point A = l2@theta2; point B  =", "expected `loop` or `equation`"),
    ("misspelt_implied", "point B  =", "implid loop l2@theta3 = l3@theta4; point B  =", "unknown statement `implid`"),
    ("implied_without_unknown", "point B  =", "implied loop l2@theta2 = l1@0; point B  =", "no unknown of `FourBar`"),
    ("implied_scalar", "point B  =", "implied loop l2@theta3 = l1; point B  =", "expected a vector"),
    ("misspelt_in_implied", "point B  =", "implied loop l2@theta3 = l1@thta4; point B  =", "unknown name `thta4`"),
    ("implied_unread", "point B  =", "implied loop l2@theta3 + = l1@0; point B  =", "expected an expression"),
    ("no_loop", "loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;", "", "2 unknowns, but 0 scalar equations"),
    ("no_input", "input   theta2;", "unknown theta2;", "3 unknowns, but 2 scalar equations"),
    ("equal_sides", "= l1@0;", "= l2@theta2 + l3@theta3 + l4@theta4;", "both sides are equal"),
    // Punctuation.
    ("no_semicolon_after_param", "l4 = 70;", "l4 = 70", "expected `;` before this"),
    ("no_semicolon_after_input", "theta2;\n        unknown", "theta2\n        unknown", "expected `;` before this"),
    ("no_semicolon_after_unknown", "theta4;\n", "theta4\n", "expected `;` before this"),
    ("no_semicolon_after_loop", "l1@0;\n\n        point", "l1@0\n\n        point", "expected `;` before this"),
    ("no_semicolon_after_point", "l2@theta2;\n", "l2@theta2\n", "expected `;` before this"),
    ("no_semicolon_at_the_end", "(l3/2)@theta3;", "(l3/2)@theta3", "expected `;` after this"),
    ("comma_for_semicolon", "theta2;\n        unknown", "theta2,\n        unknown", "expected"),
    ("comma_after_point", "l2@theta2;\n", "l2@theta2,\n", "expected"),
    ("comma_too_many", "theta3, theta4;", "theta3, theta4,;", "expected a name"),
    ("comma_doubled", "l1 = 80,", "l1 = 80,,", "expected a name"),
    ("comma_missing", "theta3, theta4;", "theta3 theta4;", "expected"),
    ("comma_missing_in_param", "l1 = 80,", "l1 = 80", "expected"),
    ("decimal_comma", "l1 = 80,", "l1 = 80,5,", "expected a name"),
    ("no_equals_in_loop", "= l1@0;", "l1@0;", "expected `=`"),
    ("doubled_equals_in_loop", "= l1@0;", "== l1@0;", "expected"),
    ("no_equals_in_point", "point C  =", "point C", "expected `=`"),
    ("doubled_equals_in_point", "point C  =", "point C  ==", "expected"),
    ("colon_in_point", "point C  =", "point C:", "expected `=`"),
    ("no_equals_in_param", "l1 = 80", "l1 80", "expected"),
    ("doubled_equals_in_param", "l1 = 80", "l1 == 80", "expected"),
    ("colon_in_param", "l1 = 80", "l1: 80", "expected"),
    ("stray_operator", "l2@theta2 + l3", "l2@theta2 + / l3", "expected an expression"),
    ("stray_comma", "l2@theta2 + l3", "l2@theta2 +, l3", "expected an expression"),
    ("stray_name", "point B  =", "crank; point B  =", "unknown statement `crank`"),
    ("stray_number", "point B  =", "3; point B  =", "expected a statement"),
    ("stray_sign", "point B  =", "? point B  =", "expected a statement"),
    ("semicolon_doubled", "l1@0;\n\n        point", "l1@0;;\n\n        point", "expected a statement"),
    ("empty_parentheses", "(l3/2)", "()", "expected"),
    ("three_components", "(l3/2)", "(l3, l2, l1)", "expected"),
    // Keywords.
    ("keyword_in_capitals", "param l1", "PARAM l1", "unknown statement `PARAM`"),
    ("keyword_with_capital", "loop l2", "Loop l2", "unknown statement `Loop`"),
    ("keyword_in_plural", "unknown theta3", "unknowns theta3", "unknown statement `unknowns`"),
    ("misspelt_keyword", "point C", "piont C", "unknown statement `piont`"),
    ("misspelt_input", "input   theta2", "inptu   theta2", "unknown statement `inptu`"),
    ("unknown_keyword", "point C", "joint C", "unknown statement `joint`"),
    ("unknown_keyword_for_unknowns", "unknown theta3", "variables theta3", "unknown statement `variables`"),
    ("unknown_keyword_for_parameters", "param l1", "lengths l1", "unknown statement `lengths`"),
    ("unknown_keyword_for_the_input", "input   theta2", "crank   theta2", "unknown statement `crank`"),
    ("keyword_missing", "point C  =", "C  =", "unknown statement `C`"),
    // Kinds.
    ("equation_of_vectors", "loop l2", "equation l2", "both sides are vectors"),
    ("scalar_in_loop", "= l1@0;", "= l1;", "found a scalar"),
    ("scalars_in_loop", "l2@theta2 + l3@theta3 + l4@theta4 = l1@0;", "l2 = l1;", "both sides are scalars"),
    ("scalar_as_point", "point C  = B + l3@theta3", "point C  = l3 * theta3", "found a scalar"),
    ("vector_as_angle", "(l3/2)@theta3", "(l3/2)@B", "found a vector"),
    ("vector_as_default", "l4 = 70", "l4 = (70, 0)", "found a vector"),
    ("scalar_plus_vector", "B + l3@theta3", "B + l3", "scalar"),
    ("product_of_vectors", "B + l3@theta3", "B * B", "vector"),
    ("quotient_by_vector", "(l3/2)", "(l3/B)", "vector"),
    ("length_and_angle", "(l3/2)@theta3", "theta2@theta3", "theta2"),
    ("no_angle", "l2@theta2 + l3", "l2@ + l3", "expected an expression"),
    ("two_angles", "(l3/2)@theta3", "(l3/2)@theta3@theta4", "a vector has one angle"),
    // Formulas.
    ("division_by_zero", "(l3/2)", "(l3/0)", "zero"),
    ("unknown_function", "(l3/2)", "(sen(l3))", "sen"),
    ("too_many_arguments", "(l3/2)", "sin(l3, 2)", "argument"),
    ("too_few_arguments", "(l3/2)", "hypot(l3)", "argument"),
    ("function_without_parentheses", "(l3/2)", "sin l3", "expected"),
    ("function_as_name", "(l3/2)", "sqrt", "sqrt"),
    ("no_operator", "(l3/2)", "(2 l3)", "expected"),
    ("doubled_star", "(l3/2)", "(l3**2)", "expected an expression"),
    ("field_of_point", "(l3/2)", "(B.x)", "expected parentheses"),
    ("unit", "l4 = 70", "l4 = 70mm", "unknown unit `mm`"),
    ("text_as_default", "l4 = 70", "l4 = \"70\"", "expected a number"),
    ("no_default", "l4 = 70", "l4 = ", "expected an expression"),
    ("infinite_number", "l4 = 70", "l4 = 1e999", "range"),
    // Requests and attributes.
    ("unknown_request", "point B  =", "derive jrek; point B  =", "unknown keyword `jrek`"),
    ("request_twice", "point B  =", "derive jerk, jerk; point B  =", "is named twice"),
    ("tokens_after_attribute", "PartialEq)]", "PartialEq) Eq]", "unexpected token"),
    ("attribute_of_point", "point B  =", "#[inline] point B  =", "has no effect here"),
    ("tokens_after_attribute_of_point", "point C", "#[doc = \"C\" C] point C", "unexpected token"),
    ("broken_attribute", "point C", "#[3] point C", "expected"),
    ("deprecated", "pub mechanism", "#[deprecated] pub mechanism", "would warn"),
    ("configured_point", "point C", "#[cfg(test)] point C", "does not work on a part"),
    // The head.
    ("mechanism_misspelt", "pub mechanism FourBar", "pub mechanisms FourBar", "expected `mechanism NAME"),
    ("mechanism_missing", "pub mechanism FourBar", "pub FourBar", "expected `mechanism NAME"),
    ("struct_for_mechanism", "pub mechanism FourBar", "pub struct FourBar", "expected `mechanism NAME"),
    ("colon_after_name", "FourBar {\n        param", "FourBar: {\n        param", "expected `{`"),
    // Scenes, with the bodies and parameters that they need.
    (
        "unknown_effect",
        "point G3 = B + (l3/2)@theta3;",
        "point G3 = B + (l3/2)@theta3; body rod { mass l1; center G3; } scene Fall { inertia; gravty (0, -9.81); }",
        "unknown effect `gravty`",
    ),
    (
        "unknown_property",
        "point G3 = B + (l3/2)@theta3;",
        "point G3 = B + (l3/2)@theta3; body rod { mas l1; center G3; } scene Fall { inertia; }",
        "a body has no `mas`",
    ),
];

const MANIFEST: &str = r#"
[package]
name = "one_message"
version = "0.0.0"
edition = "2024"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["std", "dynamics"] }

[workspace]
"#;

/// The first program of the README, as a module.
fn program() -> String {
    let readme = include_str!("../README.md");
    let program = readme.split("```rust\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    with(program, "fn main()", "pub fn main()")
}

/// A text with one replacement of what occurs once.
fn with(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "`{from}` in\n{text}");
    text.replacen(from, to, 1)
}

/// The messages of rustc for each file: level, whether it has a code, and text.
fn messages(folder: &Path) -> BTreeMap<String, Vec<String>> {
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["check", "--quiet", "--message-format=json", "--target-dir"])
        // That of the mutants, whose dependencies are the same.
        .arg(folder.with_file_name("mutants").join("target"))
        .current_dir(folder)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    let mut messages: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for line in String::from_utf8(output.stdout).unwrap().lines() {
        let line: serde_json::Value = serde_json::from_str(line).unwrap();
        let message = &line["message"];
        let (Some(level), Some(text)) = (message["level"].as_str(), message["message"].as_str()) else { continue };
        let spans = message["spans"].as_array().unwrap();
        let file = spans.iter().find(|span| span["is_primary"] == true).map(|span| span["file_name"].as_str().unwrap());
        // The count of errors has no file.
        let Some(file) = file.and_then(|file| file.strip_prefix("src/")?.strip_suffix(".rs")) else { continue };
        let code = message["code"]["code"].as_str().map_or_else(String::new, |code| format!("[{code}]"));
        messages.entry(file.to_owned()).or_default().push(format!("{level}{code}: {text}"));
    }
    assert!(!messages.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    messages
}

/// The programs are modules of one crate, so that one run of rustc checks them all; a mistake in `main` shows that
/// rustc goes on after the messages of the macro.
#[test]
fn one_mistake_is_one_message() {
    let root = env!("CARGO_MANIFEST_DIR");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("one_message");
    fs::create_dir_all(folder.join("src")).unwrap();
    fs::write(folder.join("Cargo.toml"), MANIFEST.replace("ROOT", root)).unwrap();
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let mut library = String::new();
    let mut write = |name: &str, text: &str| {
        fs::write(folder.join(format!("src/{name}.rs")), text).unwrap();
        library += &format!("pub mod {name};\n");
    };
    let program = program();
    write("correct", &program);
    let broken = with(&program, "l3@theta3 + l4@", "l3@thta3 + l4@");
    write("also_in_main", &with(&broken, "four_bar.velocity_ratios", "four_bar.velocity_rations"));
    for (name, from, to, _) in MISTAKES {
        write(name, &with(&program, from, to));
    }
    fs::write(folder.join("src/lib.rs"), library).unwrap();
    let found = messages(&folder);
    let none = Vec::new();
    let of = |name: &str| found.get(name).unwrap_or(&none).as_slice();
    assert_eq!(of("correct"), [""; 0]);
    let [first, second] = of("also_in_main") else { panic!("{:?}", of("also_in_main")) };
    assert!(first.starts_with("error: unknown name"), "{first}");
    assert!(second.starts_with("error[E0599]"), "{second}");
    let wrong = MISTAKES.iter().filter(
        |(name, _, _, message)| !matches!(of(name), [one] if one.starts_with("error: ") && one.contains(message)),
    );
    let wrong: Vec<_> = wrong.map(|(name, ..)| format!("{name}\n    {}\n", of(name).join("\n    "))).collect();
    assert!(wrong.is_empty(), "{} of {}\n{}", wrong.len(), MISTAKES.len(), wrong.concat());
}
