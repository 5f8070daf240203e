//! Without the standard library every number has the bits that it has with it.

use std::process::Command;

use linkage_tests::programs::{succeeded, written};

use crate::{numbers, of_firmware};

const PROGRAM: &str = r#"
mod numbers;

fn main() {
    print!("{}", numbers::text());
}
"#;

#[test]
fn numbers_have_the_same_bits_without_std() {
    let files = [("main.rs", PROGRAM), ("numbers.rs", include_str!("numbers.rs"))];
    let files = files.map(|(name, text)| (name.to_owned(), text.to_owned()));
    let folder = written("without_std", files);
    let mut rustc = of_firmware("size", None).rustc(&folder, "main.rs", &["linkage"]);
    succeeded(rustc.args(["-Copt-level=z", "-Cpanic=abort"]));
    let output = succeeded(&mut Command::new(folder.join("without_std")));
    let (with, without) = (numbers::text(), String::from_utf8(output.stdout).expect("a text"));
    assert!(with.lines().count() > 1200, "{with}");
    for (one, other) in with.lines().zip(without.lines()) {
        assert_eq!(one, other);
    }
    assert_eq!(with.len(), without.len());
}
