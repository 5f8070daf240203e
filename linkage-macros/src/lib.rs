//! The `linkage!` macro: compiles the loop equations of a mechanism to specialised Rust.
//!
//! Use it through the `linkage` crate. Its manual is the documentation of `linkage::linkage!`.

#![warn(missing_docs)]

use linkage_compiler::Facade;
use linkage_compiler::budget::Budget;
use proc_macro::TokenStream;

/// Defines mechanisms by their loop equations; see `linkage::linkage!`.
#[proc_macro]
pub fn linkage(input: TokenStream) -> TokenStream {
    // The macro of the facade passes its own path as the first token.
    let mut tokens = proc_macro2::TokenStream::from(input).into_iter();
    let root = tokens.next().into_iter().collect();
    let facade = Facade {
        path: root,
        has_dynamics: cfg!(feature = "dynamics"),
        has_serde: cfg!(feature = "serde"),
        has_intervals: cfg!(feature = "interval"),
    };
    linkage_compiler::expand_within(tokens.collect(), &facade, &Budget::default()).into()
}
