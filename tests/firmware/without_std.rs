//! Without the standard library every number has the bits that it has with it.

use std::process::Command;

use crate::{MANIFEST, built, numbers, package};

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
    let manifest = MANIFEST.replace("name = \"firmware\"", "name = \"without_std\"");
    let folder = package("without_std", &manifest, files.to_vec());
    let [program] = &built(&folder, "three", None, |file| file.ends_with("without_std"))[..] else {
        panic!("one program");
    };
    let output = Command::new(program).output().expect("it runs");
    let (with, without) = (numbers::text(), String::from_utf8(output.stdout).expect("a text"));
    assert!(with.lines().count() > 1200, "{with}");
    for (one, other) in with.lines().zip(without.lines()) {
        assert_eq!(one, other);
    }
    assert_eq!(with.len(), without.len());
}
