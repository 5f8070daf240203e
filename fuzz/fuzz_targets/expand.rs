//! Mutants of all mechanisms and scenes: the macro never panics, never emits nothing, stays within its budget, and what
//! it emits is Rust.
#![no_main]

use std::panic;
use std::path::Path;

use libfuzzer_sys::fuzz_target;
use linkage_compiler::budget::Budget;
use linkage_fuzz::Bytes;
use linkage_tests::expanded::{expanded, parsed};
use linkage_tests::mutants::{Mutator, corpus};
use proc_macro2::TokenStream;

thread_local! {
    /// Read once: tokens are not `Send`.
    static MECHANISMS: Vec<TokenStream> =
        corpus(Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the root"));
}

fuzz_target!(
    // The fuzzer's hook ends the process before the mutant is printed.
    init: drop(panic::take_hook()),
    |data: &[u8]| {
        let root = "::linkage".parse().expect("a path");
        let mutant = MECHANISMS.with(|mechanisms| Mutator::new(Bytes::new(data), mechanisms.iter().cloned()).mutant());
        parsed(expanded(&mutant, &root, &Budget::default()), &mutant);
    }
);
