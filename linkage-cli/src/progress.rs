//! A sign of life during long work, where standard error is a terminal.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressBarIter, ProgressFinish, ProgressStyle};

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

/// The items of some work, with a bar that shows how many are done.
pub fn over<I: ExactSizeIterator>(words: &'static str, items: I) -> ProgressBarIter<I> {
    let style =
        ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len}").unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(items.len() as u64).with_style(style).with_message(words);
    bar.with_finish(ProgressFinish::AndClear).wrap_iter(items)
}
