//! In `f32` no double is computed with: a processor without instructions for doubles links none of the functions that
//! replace them, and no power function.
//!
//! Errors state in `f64` how far a position is from one. That is a conversion, `__aeabi_f2d`, and no arithmetic.

use std::collections::BTreeSet;
use std::path::Path;

use object::{Object, ObjectSection, ObjectSymbol, SectionFlags};

use linkage_tests::programs::{succeeded, written};

use crate::graph::Graph;
use crate::{LEVELS, is_wrapper, libraries, of_firmware, of_rust, wrappers};

/// A processor with instructions for floats, and none for doubles: a Cortex-M4F.
const TARGET: &str = "thumbv7em-none-eabihf";

/// True if the target is installed; if not, the test that asks passes and says so.
fn is_installed() -> bool {
    let is_there = of_rust(Some(TARGET)).is_dir();
    if !is_there {
        println!("not tried, since the target is not installed: rustup target add {TARGET}");
    }
    is_there
}

/// Arithmetic with doubles, and conversions to them but that of a float, by the names of the ABI for ARM; and powers.
fn computes_in_doubles(name: &str) -> bool {
    let of_doubles = ["__aeabi_d", "__aeabi_i2d", "__aeabi_ui2d", "__aeabi_l2d", "__aeabi_ul2d"];
    let is_power = name.rsplit("::").next().is_some_and(|name| matches!(name, "pow" | "powf" | "powi"));
    of_doubles.iter().any(|start| name.starts_with(start)) || name.contains("libm::") && is_power
}

/// A program for a four-bar as firmware would be: the motion of all links and points in one call.
const PROGRAM: &str = r#"
#![no_std]
#![no_main]

use core::hint::black_box;
use linkage::{Elbow, linkage};

linkage! {
    mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;

        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;

        point C = l2@theta2 + l3@theta3;
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {}
}

#[unsafe(no_mangle)]
extern "C" fn _start() -> ! {
    let four_bar = FourBar::default().map(|length: f64| length as f32);
    let branch = FourBarBranch::new(Elbow::Left);
    loop {
        let (angle, rate) = black_box((0.5_f32, 1.0_f32));
        let _ = black_box(four_bar.full_kinematics(angle, branch, rate, 0.0));
    }
}
"#;

/// The program may have this many bytes, code and constants: on Rust 1.95 it has 6732.
const MOST: u64 = 7_000;

#[test]
fn a_program_links_no_doubles() {
    if !is_installed() {
        return;
    }
    let folder = written("program", [("main.rs".to_owned(), PROGRAM.to_owned())]);
    let mut rustc = of_firmware("program", Some(TARGET)).rustc(&folder, "main.rs", &["linkage"]);
    succeeded(rustc.args(["-Copt-level=z", "-Cpanic=abort", "-Clto", "-Ccodegen-units=1"]));
    let data = std::fs::read(folder.join("program")).unwrap();
    let file = object::File::parse(&*data).unwrap();
    let names = file.symbols().filter_map(|symbol| symbol.name().map(str::to_owned).ok());
    let names: Vec<String> = names.map(|name| format!("{:#}", rustc_demangle::demangle(&name))).collect();
    assert!(names.iter().any(|name| name.contains("linkage_runtime::")), "the symbols are not there: {names:?}");
    let doubles: Vec<_> = names.iter().filter(|name| computes_in_doubles(name)).collect();
    assert!(doubles.is_empty(), "{doubles:#?}");
    let is_loaded = |flags| matches!(flags, SectionFlags::Elf { sh_flags } if sh_flags & 2 != 0);
    let loaded = file.sections().filter(|section| is_loaded(section.flags()));
    let bytes: u64 = loaded.map(|section| section.size()).sum();
    println!("{bytes} bytes");
    assert!(bytes <= MOST, "{bytes} bytes, more than {MOST}");
}

/// Mechanisms with a group of more than two unknowns: where it is nearly singular, it is solved in twice the precision.
const IN_TWICE_THE_PRECISION: [&str; 8] = [
    "DoubleButterfly",
    "SliderTriadFar",
    "StephensonFar",
    "StephensonII",
    "SwivelTriadFar",
    "ThreeRrr",
    "ThreeTogether",
    "TwoTriads",
];

/// Mechanisms with functions that `libm` computes in doubles, tan and asin, and with constants of user functions that are doubles.
const WITH_FUNCTIONS_IN_DOUBLES: [&str; 5] = ["CamFollower", "Engine", "EveryFunction", "Geneva", "Introductory"];

#[test]
fn closed_forms_compute_in_floats() {
    if !is_installed() {
        return;
    }
    let files = wrappers::in_floats(Path::new(linkage_tests::ROOT));
    let folder = written("floats", files);
    let mut graph = Graph::default();
    for library in libraries(&folder, LEVELS[2], Some(TARGET)) {
        graph.add(&library);
    }
    let ways = graph.ways(is_wrapper("floats"), computes_in_doubles);
    let last = |name: &str| name.rsplit("::").next().unwrap_or_default().to_owned();
    let in_doubles = ways.iter().filter(|(_, way)| way.is_some());
    let found: BTreeSet<String> = in_doubles.clone().map(|(name, _)| last(name)).collect();
    let expected = IN_TWICE_THE_PRECISION.into_iter().chain(WITH_FUNCTIONS_IN_DOUBLES).map(str::to_owned).collect();
    let ways_to = |(_, way): &(&str, Option<Vec<&str>>)| Some(way.as_ref()?.join("\n     -> "));
    let text: Vec<String> = in_doubles.filter_map(ways_to).collect();
    println!("{} of {} mechanisms compute in doubles", found.len(), ways.len());
    assert_eq!(found, expected, "{}", text.join("\n"));
}
