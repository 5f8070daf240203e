//! Checked counts and memory.

use crate::SweepError;

/// An error if a count is zero.
pub fn positive<N: Copy + PartialEq + From<u8>>(count: N, quantity: &'static str) -> Result<N, SweepError> {
    if count == N::from(0) { Err(SweepError::Zero { quantity, column: None }) } else { Ok(count) }
}

/// A vector with this number of entries, or an error if there is no memory for it.
pub fn filled<T: Clone>(value: T, entries: usize) -> Result<Vec<T>, SweepError> {
    let mut values = Vec::new();
    values.try_reserve_exact(entries).map_err(|_| SweepError::Memory { entries })?;
    values.resize(entries, value);
    Ok(values)
}
