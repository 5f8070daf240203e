//! Sweeps as CSV.

use std::io::Write;
use std::ops::ControlFlow;
use std::path::Path;

use linkage_runtime::lanes::Lanes;

use crate::file::write_whole;
use crate::names::names;
use crate::{Chunk, Column, Progress, Sweep, SweepError};

impl<M: Lanes> Sweep<M>
where
    M::Branch: Send + Sync,
{
    /// Writes the columns asked for as CSV, then a column `accepted` of `true` and `false`.
    ///
    /// Numbers have all digits, so that they read back to the same bits. A number that does not exist is `NaN`, as are all
    /// found numbers of rejected rows. A given column with the name of a found column in the same file gets the prefix
    /// "given ". The file appears when it is complete: on an error or after a cancellation there is none, and one that was
    /// there before remains.
    ///
    /// # Errors
    /// [`SweepError::Io`], [`NotAFile`](SweepError::NotAFile), [`Twice`](SweepError::Twice), and those of
    /// [`for_each_chunk`](Sweep::for_each_chunk).
    pub fn write_csv(
        &self,
        path: impl AsRef<Path>,
        columns: &[Column],
        progress: impl FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(), SweepError> {
        let header = header::<M>(columns)?;
        let path = path.as_ref();
        write_whole(path, |file| {
            self.write_rows(file, &header, columns, progress).map_err(|error| match error {
                SweepError::Io { path: None, attempt, source } => {
                    SweepError::Io { path: Some(path.to_owned()), attempt, source }
                }
                error => error,
            })
        })
    }

    /// Writes CSV, as [`write_csv`](Self::write_csv), to a writer. It gets one call for each chunk.
    ///
    /// # Errors
    /// Those of [`write_csv`](Self::write_csv).
    pub fn write_csv_to(
        &self,
        mut writer: impl Write,
        columns: &[Column],
        progress: impl FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(), SweepError> {
        self.write_rows(&mut writer, &header::<M>(columns)?, columns, progress)?;
        writer.flush().map_err(failed)
    }

    fn write_rows(
        &self,
        writer: &mut dyn Write,
        header: &str,
        columns: &[Column],
        progress: impl FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(), SweepError> {
        writer.write_all(header.as_bytes()).map_err(failed)?;
        // The numbers become text on the threads that compute them.
        self.deliver(columns, progress, text, |_, text| writer.write_all(text).map_err(failed))
    }
}

fn failed(source: std::io::Error) -> SweepError {
    SweepError::Io { path: None, attempt: "write", source }
}

/// The line of names.
fn header<M: Lanes>(columns: &[Column]) -> Result<String, SweepError> {
    let quoted = |name: &String| match name.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", name.replace('"', "\"\"")),
        false => name.clone(),
    };
    Ok(names::<M>(columns)?.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n")
}

/// The rows of a chunk as text.
fn text<M: Lanes>(chunk: &Chunk<M>, text: &mut Vec<u8>) -> Result<(), SweepError> {
    text.clear();
    let columns: Vec<&[M::Scalar]> = chunk.columns().map(|(_, _, values)| values).collect();
    for (row, accepted) in chunk.accepted().iter().enumerate() {
        for value in columns.iter().filter_map(|values| values.get(row)) {
            // The shortest digits that read back to the same bits.
            write!(text, "{value:?},").map_err(failed)?;
        }
        writeln!(text, "{accepted}").map_err(failed)?;
    }
    Ok(())
}
