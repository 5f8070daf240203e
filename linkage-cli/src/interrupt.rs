//! Interrupts: the file that is being written disappears, the old one stays, and the exit code is 130.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::{fs, process};

/// 128 and the number of the signal, as shells count.
const CODE: i32 = 130;

/// The file that is being written, next to the one that it will replace.
static UNFINISHED: Mutex<Option<PathBuf>> = Mutex::new(None);

fn unfinished() -> MutexGuard<'static, Option<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the program on an interrupt.
pub fn install() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| {
        // Held to the end, so that no file is renamed any more.
        let mut unfinished = unfinished();
        remove(&mut unfinished);
        process::exit(CODE);
    })
}

fn remove(unfinished: &mut Option<PathBuf>) {
    if let Some(path) = unfinished.take() {
        let _ = fs::remove_file(path);
    }
}

/// Notes the file that is being written.
pub fn begin(path: &Path) {
    *unfinished() = Some(path.to_path_buf());
}

/// Applies the step that finishes the file, which no interrupt divides.
pub fn finish<R>(step: impl FnOnce() -> R) -> R {
    let mut unfinished = unfinished();
    let result = step();
    *unfinished = None;
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unfinished_file_disappears() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let mut unfinished = Some(file.path().to_path_buf());
        remove(&mut unfinished);
        assert!(unfinished.is_none() && !file.path().exists());
    }
}
