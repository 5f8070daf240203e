//! A bound on the work of one decision.

/// The number of cells that one decision may take, some milliseconds.
const MOST_CELLS: usize = 20_000;

/// The number of cells that are left.
#[derive(Debug, Clone, Copy)]
pub(super) struct Budget(usize);

impl Budget {
    pub(super) fn new() -> Self {
        Self(MOST_CELLS)
    }

    /// Returns false if no cell is left.
    pub(super) fn spend(&mut self) -> bool {
        let is_left = self.0 > 0;
        self.0 = self.0.saturating_sub(1);
        is_left
    }
}
