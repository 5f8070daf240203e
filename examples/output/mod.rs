//! The files of an example. They are in `target` of the current folder, also where `CARGO_TARGET_DIR` gives cargo another.

use std::fs;
use std::path::{Path, absolute};

/// Writes a file, with its folder, and returns its full path; an error names the file.
pub fn write(path: impl AsRef<Path>, text: &str) -> Result<String, String> {
    let path = path.as_ref();
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder
        .map_or(Ok(()), fs::create_dir_all)
        .and_then(|()| fs::write(path, text))
        .and_then(|()| absolute(path))
        .map(|full| full.display().to_string())
        .map_err(|error| format!("{} cannot be written: {error}", path.display()))
}
