//! A sign of life during long work, where standard error is a terminal.

use std::time::Duration;

use indicatif::ProgressBar;

/// The time between two signs.
const TICK: Duration = Duration::from_millis(100);

/// Does some work while a spinner turns next to these words.
pub fn during<R>(words: String, work: impl FnOnce() -> R) -> R {
    let spinner = ProgressBar::new_spinner().with_message(words);
    spinner.enable_steady_tick(TICK);
    let result = work();
    spinner.finish_and_clear();
    result
}
