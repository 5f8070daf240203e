//! The work that one invocation may take: counted, never timed, so that two expansions of one input are equal.

use std::cell::Cell;
use std::rc::Rc;

/// The steps of an invocation; a step is a part of an expression that is looked at, made or written, and what stays in
/// memory counts as several.
///
/// 345 legs of Jansen's walking machine with all their derivatives, which are as many as 100 000 tokens hold, take
/// 114 million. With half as many steps they would be refused; twice as many would let an invocation that is refused in
/// the end take twice as long, and more memory than 512 MB.
pub const MOST_STEPS: usize = 150_000_000;

/// The remaining steps of an invocation, which all its graphs share.
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
    /// A budget of so many steps.
    #[must_use]
    pub fn new(steps: usize) -> Self {
        Self { left: Rc::new(Cell::new(steps)) }
    }

    /// Takes steps; gives whether there were so many.
    pub fn spend(&self, steps: usize) -> bool {
        let left = self.left.get().saturating_sub(steps);
        self.left.set(left);
        left > 0
    }

    /// True if nothing is left: what is made from now on has no meaning, and loops end.
    #[must_use]
    pub fn is_spent(&self) -> bool {
        self.left.get() == 0
    }

    /// The steps that are left.
    #[must_use]
    pub fn left(&self) -> usize {
        self.left.get()
    }
}
