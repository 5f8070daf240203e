//! Options of Parquet files.

use linkage_sweep::SweepError;

use crate::Error;

/// The compression of a Parquet file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Compression {
    /// Snappy, which all readers have.
    #[default]
    Snappy,
    /// No compression.
    None,
}

/// Rows per group and compression of a Parquet file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    pub(crate) rows_per_group: Option<usize>,
    pub(crate) compression: Compression,
}

impl Options {
    /// Sets the rows per row group, which are gathered in memory. Otherwise a group has 1 048 576 rows, or fewer if these
    /// take more than 64 MiB before encoding and compression.
    ///
    /// # Errors
    /// [`SweepError::Zero`].
    pub fn with_rows_per_group(mut self, rows: usize) -> Result<Self, Error> {
        if rows == 0 {
            return Err(SweepError::Zero { quantity: "rows per group", column: None }.into());
        }
        self.rows_per_group = Some(rows);
        Ok(self)
    }

    /// Sets the compression, which is Snappy otherwise.
    #[must_use]
    pub fn with_compression(mut self, compression: Compression) -> Self {
        self.compression = compression;
        self
    }
}
