//! User functions: emits one private function for each, outside of the runtime's imports, so that paths resolve as at
//! the invocation and a type error is reported once.

use std::collections::BTreeSet;

use linkage_ir::code::Code;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};

use super::names::ident;
use crate::graph::ExternalId;
use crate::model::{ExternalFunction, Mechanism, TypeName};
use crate::program::{Functions, Taken, call_of};
use crate::syntax::identifier;

/// Emits the user functions that some functions call, as associated functions of `of`.
pub(super) fn calls(
    mechanism: &Mechanism,
    functions: &Functions<Code>,
    of: &TypeName,
    root: &TokenStream,
) -> Option<TokenStream> {
    let bodies = functions.iter().filter_map(|function| function.body.as_ref());
    let called: BTreeSet<ExternalId> = bodies.flat_map(|body| body.readable.externals.iter().copied()).collect();
    let calls = mechanism.externals.iter().enumerate();
    let calls =
        calls.filter(|(place, _)| called.contains(&ExternalId::new(*place))).map(|(_, external)| call(external));
    let calls: Vec<TokenStream> = calls.collect();
    (!calls.is_empty()).then(|| quote!(impl<T: #root::__rt::Real> #of<T> { #(#calls)* }))
}

fn call(external: &ExternalFunction) -> TokenStream {
    let ExternalFunction { path, arguments, names, .. } = external;
    // Type errors are reported at the last segment of the path.
    let span = path.segments.last().map_or_else(Span::call_site, |segment| segment.ident.span());
    let span = Span::call_site().located_at(span);
    // An argument must not shadow the function.
    let reserved: BTreeSet<String> = path.get_ident().map(ToString::to_string).into_iter().collect();
    let mut taken = Taken::new(&reserved);
    let arguments: Vec<Ident> = arguments.iter().map(|name| identifier(&taken.unique(name), span)).collect();
    let fields: Vec<String> = names.iter().map(|name| name.field.clone()).collect();
    let scalars = names.iter().map(|_| quote!(T));
    let result = if names.len() == 1 { quote!(T) } else { quote!((#(#scalars),*)) };
    let (name, call) = (ident(&call_of(&fields)), quote_spanned!(span=> #path(#(#arguments),*)));
    quote! {
        #[doc(hidden)]
        #[inline]
        fn #name(#(#arguments: T),*) -> #result {
            #call
        }
    }
}
