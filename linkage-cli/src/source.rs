//! Texts: a file or standard input, bounded before it is read.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use linkage_compiler::diagnostics::suggestion;
use linkage_compiler::text::{LONGEST, Message};

use crate::mistakes::{Mistake, Mistakes, Source};
use crate::terminal::printable;

/// True for the name of standard input and output.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads a file, or standard input for `-`.
pub fn read(path: &Path) -> Result<Source, Mistakes> {
    let name = if is_standard(path) { "<stdin>".to_owned() } else { printable(&path.display().to_string()) };
    let bytes = match bytes(path) {
        Ok(bytes) => bytes,
        Err(message) => {
            let source = Source { name, text: String::new() };
            return Err(Mistakes { source, all: vec![Mistake::File(message)] });
        }
    };
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Source { name, text }),
        Err(error) => {
            let message = not_utf8(error.as_bytes(), error.utf8_error().valid_up_to());
            let source = Source { name, text: String::from_utf8_lossy(error.as_bytes()).into_owned() };
            Err(Mistakes { source, all: vec![Mistake::Text(message)] })
        }
    }
}

/// The bytes of a file, or why there are none.
fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    let unread = |error: io::Error| cannot_read(path, &error);
    if is_standard(path) {
        return bounded(io::stdin().lock()).map_err(unread)?.ok_or_else(too_long);
    }
    // A directory opens as a file on some systems.
    if path.is_dir() {
        return Err(cannot_read(path, &ErrorKind::IsADirectory.into()));
    }
    bounded(File::open(path).map_err(unread)?).map_err(unread)?.ok_or_else(too_long)
}

/// Reads at most what the compiler takes; none if there is more.
fn bounded(reader: impl Read) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    reader.take(LONGEST as u64 + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() <= LONGEST).then_some(bytes))
}

fn too_long() -> String {
    format!("the file has more than {LONGEST} bytes: split it")
}

fn cannot_read(path: &Path, error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => format!(
            "there is no such file{}",
            suggestion(&file_name(path), names_nearby(path).iter().map(String::as_str))
        ),
        ErrorKind::IsADirectory => "this is a folder: name a file in it".to_owned(),
        ErrorKind::PermissionDenied => "you may not read this file".to_owned(),
        _ => format!("the file cannot be read: {error}"),
    }
}

fn file_name(path: &Path) -> String {
    printable(&path.file_name().unwrap_or_default().to_string_lossy())
}

/// The names of mechanisms' files in the folder of a path.
fn names_nearby(path: &Path) -> Vec<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = fs::read_dir(folder.map_or_else(|| PathBuf::from("."), Path::to_path_buf)).into_iter().flatten();
    let paths = entries.flatten().map(|entry| entry.path());
    let mut names: Vec<String> = paths
        .filter(|path| path.extension().is_some_and(|end| end == "linkage"))
        .map(|path| file_name(&path))
        .collect();
    names.sort();
    names
}

/// The message of the first byte that is not UTF-8.
fn not_utf8(bytes: &[u8], place: usize) -> Message {
    let before = String::from_utf8_lossy(&bytes[..place]);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    let byte = bytes.get(place).copied().unwrap_or_default();
    let is_wide = matches!(bytes, [0xff, 0xfe, ..] | [0xfe, 0xff, ..]);
    let is = if is_wide { "the file is in UTF-16".to_owned() } else { format!("byte {byte:#04x} is not UTF-8") };
    Message { line, column, length: usize::from(!is_wide), text: format!("{is}: save the file in UTF-8"), help: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_a_byte_counts_characters() {
        let Message { line, column, text, .. } = not_utf8(b"mechanism\n\xc3\xa9 \xe9 = 1", 13);
        assert_eq!((line, column), (2, 3));
        assert_eq!(text, "byte 0xe9 is not UTF-8: save the file in UTF-8");
    }

    #[test]
    fn no_more_is_read_than_the_compiler_takes() {
        assert_eq!(bounded(&vec![b' '; LONGEST][..]).unwrap().map(|bytes| bytes.len()), Some(LONGEST));
        assert_eq!(bounded(io::repeat(b' ')).unwrap(), None);
    }
}
