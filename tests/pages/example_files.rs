//! The files that examples write: their folder is made, and an error names the file.

use std::fs;
use std::path::Path;

use linkage_examples::output;

/// An empty folder of this test.
fn folder(name: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("example_files").join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

#[test]
fn the_folder_of_a_file_is_made() {
    let path = folder("made").join("target").join("page.html");
    let full = output::write(&path, "a page").expect("a file");
    assert!(Path::new(&full).is_absolute());
    assert_eq!(fs::read_to_string(&full).expect("the page"), "a page");
    output::write(&path, "another page").expect("a file that is written again");
    assert_eq!(fs::read_to_string(path).expect("the page"), "another page");
}

#[test]
fn an_error_names_the_file() {
    let path = folder("in_the_way");
    output::write(&path, "a file where a folder should be").expect("a file");
    let below = path.join("page.html");
    let error = output::write(&below, "a page").expect_err("no folder");
    assert!(error.starts_with(&format!("{} cannot be written: ", below.display())), "{error}");
    let empty = output::write("", "a page").expect_err("no name");
    assert!(empty.contains("cannot be written"), "{empty}");
}
