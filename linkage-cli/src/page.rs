//! The built page: the files of the folder `web/dist`, which npm makes.

use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// The folder of the built page, in that of the project.
const BUILT: &str = "web/dist";

/// A file of the built page: of the folder that is given, or of `web/dist` here or in a folder above.
pub fn file(given: Option<&Path>, name: &str) -> Result<String, Failure> {
    let path = given.map(Path::to_path_buf).or_else(above).unwrap_or_else(|| PathBuf::from(BUILT)).join(name);
    fs::read_to_string(&path).map_err(|error| {
        Failure::Outside(format!(
            "the page is not built: {} cannot be read ({error}); in the folder of the project run `npm --prefix web ci` and \
             `npm --prefix web run build`, or name the folder of a built page with --page",
            path.display()
        ))
    })
}

/// The nearest built page in this folder or one above.
fn above() -> Option<PathBuf> {
    let here = std::env::current_dir().ok()?;
    here.ancestors().map(|folder| folder.join(BUILT)).find(|folder| folder.is_dir())
}

/// A text with `new` in place of `old`, which it has once.
pub fn replaced(text: &str, old: &str, new: &str) -> Result<String, Failure> {
    match text.matches(old).count() {
        1 => Ok(text.replacen(old, new, 1)),
        _ => Err(Failure::Outside("the built page is that of another version: build it again".to_owned())),
    }
}
