//! Every public function of every mechanism and scene of these tests, called with random and extreme arguments: every
//! number of an `Ok` is finite, no call takes more than a stated number of evaluations, none panics.
//!
//! The functions are those of `linkage_called`, for the gallery as it is compiled; the algorithms of the runtime are called for
//! eight mechanisms and their scenes, and for systems that are none. In the outer ring the gallery and the machines of the
//! examples are emitted anew with all `derive` requests, the algorithms are called for all of them, and evaluations of user
//! functions are counted within emitted functions too.
//!
//! ```text
//! cargo test --test input invalid_numbers                                  40 calls of each function
//! INVALID_NUMBERS_TRIALS=100000 cargo test --test input invalid_numbers    this many, as in the outer ring, optimised
//! ```

use std::env;
use std::path::Path;
use std::process::Command;

use linkage_tests::programs::{Libraries, succeeded, written};
use linkage_tests::subjects;

/// Calls of each function in an ordinary run of the tests.
const TRIALS: &str = "40";

/// One mechanism of each kind, with eight scenes: laws of the user, a group of two loops, all functions of the language, two
/// inputs, a slider as a guide, an open chain, frictions, a stop.
const OF_ALGORITHMS: [&str; 8] = [
    "cam_follower",
    "double_butterfly",
    "every_function",
    "five_bar_scenes",
    "inverted_slider_crank",
    "one_window",
    "pendulum",
    "slider_crank_contacts",
];

#[test]
fn no_ok_holds_a_number_that_is_not_finite() {
    let root = Path::new(linkage_tests::ROOT);
    let trials = env::var("INVALID_NUMBERS_TRIALS").ok();
    let is_outer = linkage_trials::is_outer() || trials.is_some();
    let files = if is_outer { subjects::emitted(root, None) } else { subjects::of_gallery(root, &OF_ALGORITHMS) };
    let folder =
        written("invalid_numbers", files.into_iter().chain([("main.rs".to_owned(), subjects::MAIN.to_owned())]));
    let libraries = Libraries::of_tests();
    let mut rustc = libraries.rustc(&folder, "main.rs", &["linkage", "linkage_called", "linkage_gallery", "rand"]);
    // With all checks.
    let optimised = ["-Copt-level=1", "-Coverflow-checks=yes", "-Cdebug-assertions=yes"];
    succeeded(rustc.args(optimised.iter().filter(|_| trials.is_some())));
    let mut program = Command::new(folder.join("invalid_numbers"));
    let output = program.arg(trials.as_deref().unwrap_or(TRIALS)).output().unwrap();
    println!("{}", String::from_utf8_lossy(&output.stdout));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
