//! Spans of texts. `proc-macro2` keeps each text that it parses, for the places of tokens; what it keeps is cleared when the
//! outermost reader of this thread ends.

use std::cell::Cell;

thread_local! {
    /// The number of readers at work on this thread: the function that a reader calls may read another text.
    static READERS: Cell<usize> = const { Cell::new(0) };
}

/// A reader at work: the spans of its texts are valid.
pub(super) struct Spans(());

impl Spans {
    pub(super) fn begin() -> Self {
        READERS.set(READERS.get() + 1);
        Self(())
    }
}

impl Drop for Spans {
    fn drop(&mut self) {
        READERS.set(READERS.get().saturating_sub(1));
        if READERS.get() == 0 {
            proc_macro2::extra::invalidate_current_thread_spans();
        }
    }
}
