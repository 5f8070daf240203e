//! manual
#![warn(missing_docs)]

use proc_macro::TokenStream;

/// Mechanisms.
#[proc_macro]
pub fn linkage(input: TokenStream) -> TokenStream {
    // The facade's macro hands its own path over as the first token.
    let mut tokens = proc_macro2::TokenStream::from(input).into_iter();
    let root = tokens.next().into_iter().collect();
    linkage_compiler::expand(tokens.collect(), &root).into()
}
