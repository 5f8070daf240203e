//! The expansion of a mutant, and what holds for every one; if it does not, these functions panic with the mutant.

use std::panic::{AssertUnwindSafe, catch_unwind};

use linkage_compiler::budget::Budget;
use proc_macro2::{TokenStream, TokenTree};

/// Expands a mutant: the macro does not panic, gives something, and accepts nothing beyond its budget.
pub fn expanded(mutant: &TokenStream, root: &TokenStream, budget: &Budget) -> TokenStream {
    let expand = || linkage_compiler::expand_within(mutant.clone(), &linkage_compiler::Facade::complete(root), budget);
    let expansion = catch_unwind(AssertUnwindSafe(expand)).unwrap_or_else(|_| panic!("the macro panics:\n{mutant}"));
    assert!(!expansion.is_empty(), "this vanishes:\n{mutant}");
    assert!(budget.left() > 0 || is_rejected(&expansion), "this is beyond the budget:\n{mutant}");
    expansion
}

/// Parses the expansion as Rust.
pub fn parsed(expansion: TokenStream, mutant: &TokenStream) -> syn::File {
    syn::parse2(expansion).unwrap_or_else(|error| panic!("{error}:\n{mutant}"))
}

/// True if an expansion begins with a message.
pub fn is_rejected(expansion: &TokenStream) -> bool {
    let beginning = expansion.clone().into_iter().take(8);
    beginning.into_iter().any(|token| matches!(token, TokenTree::Ident(word) if word == "compile_error"))
}
