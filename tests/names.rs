//! Names that Rust or the standard library has, as the names of parts of mechanisms: each either compiles or is an error
//! of the macro.

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use proc_macro2::TokenStream;

const KEYWORDS: &str = "as async await break const continue crate dyn else enum extern false fn for if impl in let loop \
    match mod move mut pub ref return self Self static struct super trait true type unsafe use where while abstract \
    become box do final gen macro override priv try typeof unsized virtual yield union raw safe auto default macro_rules";

const PRELUDE: &str = "Copy Send Sized Sync Unpin Drop Fn FnMut FnOnce AsyncFn drop Box ToOwned Clone PartialEq PartialOrd \
    Eq Ord AsRef AsMut Into From Default Iterator Extend IntoIterator DoubleEndedIterator ExactSizeIterator Option Some \
    None Result Ok Err String ToString Vec TryFrom TryInto FromIterator Debug Hash vec println assert panic size_of \
    align_of";

const TYPES: &str = "bool char str u8 u16 u32 u64 u128 usize i8 i16 i32 i64 i128 isize f32 f64 Rc Arc Cell RefCell Mutex \
    HashMap BTreeMap Path Instant Duration Ordering Range Error Add Sub Mul Div Neg Index Display Write Read Matrix \
    Vector2 Point2 SVector Complex Real Mechanism Scene Assembly AssemblyMode Branches Memory Loops Pose Branch Motion Side Elbow Number Formulas Certifiable Column Slope Slider core \
    std alloc nalgebra linkage";

const LETTERS: &str = "a b c d e f g h i j k l m n o p q r s t u v w x y z A B C D E F G H I J K L M N O P Q R S T U V W \
    X Y Z _ __ _0";

fn names() -> impl Iterator<Item = &'static str> {
    [KEYWORDS, PRELUDE, TYPES, LETTERS].into_iter().flat_map(str::split_whitespace)
}

fn expanded(text: &str) -> TokenStream {
    let tokens: TokenStream = text.parse().unwrap();
    linkage_compiler::expand(tokens, &"::linkage".parse().unwrap())
}

fn is_accepted(text: &str) -> bool {
    !expanded(text).to_string().contains("compile_error")
}

/// A part of a mechanism with a name: the mechanism with this part alone, and with all names.
type Role = (&'static str, fn(&[&str]) -> String);

const ROLES: [Role; 4] = [
    ("params", |names| {
        let sum = names.join(" + ");
        format!(
            "pub mechanism M0 {{ derive intervals; param {} = 1; input v0; unknown u0; equation u0 = v0 * ({sum}); }}",
            names.join(" = 1, ")
        )
    }),
    ("unknowns", |names| {
        let equations: Vec<String> = names.iter().map(|name| format!("equation {name} = 2 * v0;")).collect();
        format!(
            "pub mechanism M0 {{ derive intervals; input v0; unknown {}; {} }}",
            names.join(", "),
            equations.concat()
        )
    }),
    ("points", |names| {
        let points: Vec<String> = names.iter().map(|name| format!("point {name} = u0@v0;")).collect();
        format!(
            "pub mechanism M0 {{ derive intervals; input v0; unknown u0; equation u0 = 2 * v0; {} }}",
            points.concat()
        )
    }),
    ("outputs", |names| {
        let outputs: Vec<String> = names.iter().map(|name| format!("output {name} = u0 * sin(v0);")).collect();
        format!(
            "pub mechanism M0 {{ derive intervals; input v0; unknown u0; equation u0 = 2 * v0; {} }}",
            outputs.concat()
        )
    }),
];

/// A mechanism, and a scene of another, with a name.
fn types(name: &str) -> [String; 2] {
    [
        format!(
            "pub mechanism {name} {{ derive intervals; param p0 = 2; input v0; unknown u0; equation u0 = p0 * v0; point P0 = u0@v0; }}"
        ),
        format!(
            "pub mechanism M0 {{ derive intervals; param p0 = 2, m0 = 1; input v0; unknown u0; equation u0 = p0 * v0; \
             body b0 {{ mass m0; center (u0, 0); }} scene {name} {{ inertia; energy; }} }}"
        ),
    ]
}

const MANIFEST: &str = r#"
[package]
name = "names"
version = "0.0.0"
edition = "2024"

[dependencies]
linkage = { path = "ROOT", default-features = false, features = ["dynamics", "std"] }

[workspace]
"#;

#[test]
fn each_name_compiles_or_is_rejected() {
    let root = env!("CARGO_MANIFEST_DIR");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("names");
    fs::create_dir_all(folder.join("src")).unwrap();
    fs::write(folder.join("Cargo.toml"), MANIFEST.replace("ROOT", root)).unwrap();
    // The versions under test are those of this workspace.
    fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    // Names that differ in case only are one field.
    let mut modules = Vec::new();
    for (role, mechanism) in ROLES {
        let accepted: Vec<&str> = names().filter(|name| is_accepted(&mechanism(&[name]))).collect();
        let (upper, lower): (Vec<&str>, Vec<&str>) =
            accepted.iter().partition(|name| name.starts_with(|first: char| first.is_uppercase()));
        println!("{role}: {} of {}", accepted.len(), names().count());
        assert!(lower.len() > 60 && upper.len() > 60, "{role}: {lower:?} {upper:?}");
        modules.extend(
            [("upper", upper), ("lower", lower)]
                .map(|(case, names)| (format!("{role}_{case}"), expanded(&mechanism(&names)).to_string())),
        );
    }
    // A type begins with a capital.
    for name in names().filter(|name| name.starts_with(|first: char| first.is_uppercase())) {
        for (place, text) in types(name).into_iter().enumerate().filter(|(_, text)| is_accepted(text)) {
            modules.push((format!("types_{}_{place}", name), expanded(&text).to_string()));
        }
    }
    let mut library = String::from("#![no_std]\n#![allow(non_snake_case)]\n");
    for (name, text) in modules {
        fs::write(folder.join(format!("src/{name}.rs")), text).unwrap();
        library += &format!("pub mod {name};\n");
    }
    fs::write(folder.join("src/lib.rs"), library).unwrap();
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["check", "--quiet", "--color=never", "--target-dir"])
        // That of the mutants, whose dependencies are the same.
        .arg(folder.with_file_name("mutants").join("target"))
        .current_dir(&folder)
        .env("RUSTFLAGS", "-Dwarnings")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
