//! Files that appear complete or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use tempfile::Builder;

use crate::SweepError;

/// Writes a file under a temporary name in the same folder, and renames it at the end. On an error the temporary file
/// is removed, and a file that was there before remains.
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
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = builder().tempfile_in(folder).map_err(failed(folder, "create a file in"))?;
    let mut writer = BufWriter::new(file.as_file_mut());
    let written = write(&mut writer);
    // Without the rest of the buffer, which is lost with the file.
    let written = written.and_then(|()| Ok(writer.flush().map_err(failed(path, "write"))?));
    drop(writer.into_parts());
    written?;
    file.as_file().sync_all().map_err(failed(path, "write"))?;
    file.persist(path).map_err(|error| failed(path, "rename a file to")(error.error))?;
    Ok(())
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
