//! Programs that call what `linkage!` emits, written from the functions as the compiler plans them: calls by lists of
//! numbers, whose results are texts; algorithms for each mechanism and scene; and functions without type parameters.

mod algorithms;
mod calls;
mod constructors;
mod source;
mod values;
mod wrappers;

use proc_macro2::{Ident, Span};

pub use source::{Calls, Source, source, sources};

/// A name as emitted code has it.
fn ident(name: &str) -> Ident {
    syn::parse_str(name).unwrap_or_else(|_| Ident::new_raw(name, Span::call_site()))
}
