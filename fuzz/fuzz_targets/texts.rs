//! Texts: any bytes that are one end with mechanisms or messages, within the budget.
#![no_main]

use libfuzzer_sys::fuzz_target;
use linkage_compiler::budget::Budget;
use linkage_compiler::text;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let budget = Budget::default();
    let found = text::compile(text, &budget, |_| ());
    assert!(budget.left() > 0 || found.is_err());
});
