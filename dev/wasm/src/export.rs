//! The functions that `run.mjs` calls: lines, and the message of a panic, as UTF-8 at an address.

use std::cell::RefCell;
use std::panic;

thread_local! {
    /// The last line, or the last message.
    static TEXT: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Keeps the messages of panics; returns the number of lines.
#[expect(unsafe_code, reason = "a name that is called from outside")]
#[unsafe(no_mangle)]
pub extern "C" fn begin() -> usize {
    panic::set_hook(Box::new(|message| TEXT.set(message.to_string())));
    crate::count()
}

/// Computes a line.
#[expect(unsafe_code, reason = "a name that is called from outside")]
#[unsafe(no_mangle)]
pub extern "C" fn compute(place: usize) {
    TEXT.set(crate::line(place).unwrap_or_default());
}

/// The address of the text.
#[expect(unsafe_code, reason = "a name that is called from outside")]
#[unsafe(no_mangle)]
pub extern "C" fn text() -> *const u8 {
    TEXT.with_borrow(|text| text.as_ptr())
}

/// The bytes of the text.
#[expect(unsafe_code, reason = "a name that is called from outside")]
#[unsafe(no_mangle)]
pub extern "C" fn bytes() -> usize {
    TEXT.with_borrow(String::len)
}
