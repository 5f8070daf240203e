//! The budget of work of one invocation. Work is counted, not timed, so that expansion is deterministic.

use std::cell::Cell;
use std::rc::Rc;

/// The largest number of steps of an invocation. A step reads, makes or prints one part of an expression; allocated
/// nodes count as several.
///
/// 345 legs of Jansen's walking machine with all derivatives, as many as 100 000 tokens define, take 114 million steps.
/// With half the budget they would be an error; with twice the budget an invocation that exceeds it would take twice as
/// long and more than 512 MB.
pub const MOST_STEPS: usize = 150_000_000;

/// The error of a budget without remaining steps: results are then meaningless, and loops must end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spent;

/// The remaining steps of an invocation; all its graphs share them.
#[derive(Debug, Clone)]
pub struct Budget {
    left: Rc<Cell<usize>>,
}

impl Default for Budget {
    fn default() -> Self {
        Self::new(MOST_STEPS)
    }
}

impl Budget {
    /// A budget of this number of steps.
    #[must_use]
    pub fn new(steps: usize) -> Self {
        Self { left: Rc::new(Cell::new(steps)) }
    }

    /// Takes steps.
    ///
    /// # Errors
    /// [`Spent`] if none remain.
    pub fn spend(&self, steps: usize) -> Result<(), Spent> {
        self.count(steps);
        self.check()
    }

    /// Takes the steps of work that ends in any case.
    pub fn count(&self, steps: usize) {
        self.left.set(self.left.get().saturating_sub(steps));
    }

    /// Checks that steps remain.
    ///
    /// # Errors
    /// [`Spent`] if none remain.
    pub fn check(&self) -> Result<(), Spent> {
        if self.left.get() > 0 { Ok(()) } else { Err(Spent) }
    }

    /// The remaining steps.
    #[must_use]
    pub fn left(&self) -> usize {
        self.left.get()
    }
}
