//! Files are written next to the old ones and renamed, so that a failure loses nothing.

use std::fs::{self, Permissions};
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile, PersistError};

use crate::failure::Failure;
use crate::interrupt;
use crate::source::is_standard;
use crate::terminal::{printable, say};

/// A form of output: its name in messages, and the endings of its files.
pub type Form = (&'static str, &'static [&'static str]);

/// The place of the form that the ending of a file says; none if it says nothing.
pub fn form(path: &Path, what: &str, forms: &[Form]) -> Result<Option<usize>, Failure> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if ending.is_empty() {
        return Ok(None);
    }
    let found = forms.iter().position(|(_, endings)| endings.contains(&ending.as_str()));
    found.map(Some).ok_or_else(|| {
        let names = either(forms.iter().map(|(name, _)| (*name).to_owned()));
        let endings = either(forms.iter().filter_map(|(_, endings)| endings.first()).map(|end| format!("NAME.{end}")));
        Failure::Argument(format!("{what} is {names}: write -o {endings}, not `.{ending}`"))
    })
}

/// "a, b or c".
fn either(words: impl Iterator<Item = String>) -> String {
    let words: Vec<String> = words.collect();
    match words.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => words.concat(),
    }
}

/// The file next to another with this ending, or standard output for standard input.
pub fn next_to(file: &Path, ending: &str) -> PathBuf {
    if is_standard(file) { PathBuf::from("-") } else { file.with_extension(ending) }
}

/// Writes a file, or to standard output for `-`; says on standard error which file it wrote. It is not the source of what is
/// written.
pub fn write(path: &Path, contents: &[u8], source: &Path) -> Result<(), Failure> {
    if is_standard(path) {
        return print(contents);
    }
    // A link stays, and leads to the new contents.
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    if !is_standard(source) && fs::canonicalize(source).is_ok_and(|source| source == place) {
        let message = format!("{} would replace what it is made of: write another name with -o", path.display());
        return Err(Failure::Argument(message));
    }
    // A pipe or a device is no file to replace.
    let is_special = fs::metadata(&place).is_ok_and(|found| !found.is_file() && !found.is_dir());
    let written = if is_special { fs::write(&place, contents) } else { replaced(&place, contents) };
    written.map_err(|error| cannot_write(path, &error))?;
    say!("wrote {}", path.display());
    Ok(())
}

/// Writes a file that is not there yet.
pub fn create(path: &Path, contents: &[u8]) -> Result<(), Failure> {
    let written = temporary_file(path, contents).and_then(|file| renamed(|| file.persist_noclobber(path)));
    written.map_err(|error| cannot_write(path, &error))?;
    say!("wrote {}", path.display());
    Ok(())
}

/// Writes to standard output.
pub fn print(contents: &[u8]) -> Result<(), Failure> {
    let mut standard = io::stdout().lock();
    let shown = standard.is_terminal().then(|| printable(&String::from_utf8_lossy(contents)));
    let contents = shown.as_ref().map_or(contents, String::as_bytes);
    let written = standard.write_all(contents).and_then(|()| standard.flush());
    written.map_err(|error| Failure::of_standard_output(&error))
}

fn replaced(path: &Path, contents: &[u8]) -> io::Result<()> {
    if path.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    let old = fs::metadata(path).map(|found| found.permissions());
    // Renaming would replace a file that may not be written.
    if old.as_ref().is_ok_and(Permissions::readonly) {
        return Err(ErrorKind::PermissionDenied.into());
    }
    let file = temporary_file(path, contents)?;
    if let Ok(permissions) = old {
        file.as_file().set_permissions(permissions)?;
    }
    renamed(|| file.persist(path))
}

/// A new file in the folder of a path, with these contents.
fn temporary_file(path: &Path, contents: &[u8]) -> io::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.map_or_else(|| PathBuf::from("."), Path::to_path_buf);
    let mut builder = Builder::new();
    builder.prefix(".linkage-");
    // As of any new file; the default is for secrets.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    interrupt::begin(file.path());
    file.write_all(contents)?;
    file.as_file().sync_all()?;
    Ok(file)
}

fn renamed<T>(step: impl FnOnce() -> Result<T, PersistError>) -> io::Result<()> {
    interrupt::finish(step).map(|_| ()).map_err(|error| error.error)
}

fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    let why = match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => "its folder does not exist".to_owned(),
        ErrorKind::IsADirectory => "it is a folder".to_owned(),
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => "you may not write there".to_owned(),
        ErrorKind::AlreadyExists => "it exists; write another name".to_owned(),
        ErrorKind::StorageFull => "the disk is full".to_owned(),
        _ => error.to_string(),
    };
    Failure::Outside(format!("{} is not written: {why}", path.display()))
}
