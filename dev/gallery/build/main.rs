//! Says what a mechanism of the gallery lacks, before the compiler meets the traits that it then cannot implement.

mod complete;

use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build");
    println!("cargo::rerun-if-changed=src/mechanisms");
    for message in complete::of_folder(Path::new("src/mechanisms")) {
        println!("cargo::error={message}");
    }
}
