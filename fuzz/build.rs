//! Writes the calls of the public functions of some mechanisms, as `tests/input/invalid_numbers` does for all in the outer ring.

use std::path::Path;
use std::{env, fs};

use linkage_tests::subjects;

/// One mechanism of each kind, since the code for coverage is slow to build: groups of two unknowns and of more, gears,
/// belts, slots and cams, limits and change points, scenes with every effect, stops and friction.
const CHOSEN: [&str; 13] = [
    "belt",
    "cam_follower",
    "cam_rocker",
    "double_butterfly",
    "every_function",
    "five_bar_contacts",
    "four_bar_effects",
    "geared_five_bar",
    "inverted_slider_crank",
    "peaucellier",
    "pin_and_slot",
    "slider_crank_contacts",
    "three_together",
];

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let written = env::var("OUT_DIR").unwrap();
    for (file, text) in subjects::emitted(root, Some(&CHOSEN)) {
        fs::write(Path::new(&written).join(file), text).unwrap();
    }
    for read in ["tests/input/invalid_numbers", "dev/called/src", "dev/gallery/src"] {
        println!("cargo::rerun-if-changed={}", root.join(read).display());
    }
}
