//! Files that appear complete or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

use crate::SweepError;

/// The most symbolic links from one name to a file, as in Linux.
const LINKS: usize = 40;

/// The temporary files of this process.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Writes a file under a temporary name in the same folder, and renames it at the end. On an error the temporary file
/// is removed, and a file that was there before remains. If the path is a symbolic link, it remains, and the file that it
/// leads to is written.
///
/// # Errors
/// Those of `write`, [`SweepError::NotAFile`] and [`SweepError::Io`].
pub fn write_whole<E: From<SweepError>>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> Result<(), E>,
) -> Result<(), E> {
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Err(SweepError::NotAFile { path: path.to_owned() }.into());
    }
    let failed = |path: &Path, attempt| {
        let path = Some(path.to_owned());
        move |source: io::Error| SweepError::Io { path, attempt, source }
    };
    let target = target(path).map_err(failed(path, "follow the link"))?;
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (mut file, _listed) = temporary(folder).map_err(failed(folder, "create a file in"))?;
    let mut writer = BufWriter::new(file.as_file_mut());
    let written = write(&mut writer);
    // Without the rest of the buffer, which is lost with the file.
    let written = written.and_then(|()| Ok(writer.flush().map_err(failed(path, "write"))?));
    drop(writer.into_parts());
    written?;
    file.as_file().sync_all().map_err(failed(path, "write"))?;
    let unfinished = unfinished();
    file.persist(&target).map_err(|error| failed(path, "rename a file to")(error.error))?;
    drop(unfinished);
    Ok(())
}

/// Removes the temporary files of this process and keeps it from making others, for a process that ends now: it is
/// interrupted, and its other threads still write. Call it once, and exit then.
pub fn remove_unfinished() {
    let unfinished = unfinished();
    for path in unfinished.iter() {
        // An error has no reader any more.
        let _ = fs::remove_file(path);
    }
    // No other thread makes or renames a file until the process ends.
    std::mem::forget(unfinished);
}

/// The file that a path leads to, over symbolic links; it need not exist.
fn target(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..LINKS {
        if !path.is_symlink() {
            return Ok(path);
        }
        // A relative link begins in the folder of its name; joined to an absolute one, that folder is dropped.
        let next = fs::read_link(&path)?;
        path.pop();
        path.push(next);
    }
    Err(io::Error::other("too many symbolic links"))
}

/// A temporary file in a folder, and its entry in the list of this process.
fn temporary(folder: &Path) -> io::Result<(NamedTempFile, Listed)> {
    let mut unfinished = unfinished();
    let file = builder().tempfile_in(folder)?;
    unfinished.push(file.path().to_owned());
    let listed = Listed(file.path().to_owned());
    Ok((file, listed))
}

/// The entry of a temporary file in the list of this process.
struct Listed(PathBuf);

impl Drop for Listed {
    fn drop(&mut self) {
        unfinished().retain(|path| *path != self.0);
    }
}

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file with the permissions of other new files.
fn builder() -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(".sweep-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Less the mask of the process.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder
}
