//! The user's own functions: one private function each, where their paths mean what they mean to the user
//! and a wrong type is said once.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};

use super::super::names::{Taken, call_of};
use super::Methods;
use crate::model::ExternalFunction;

impl Methods<'_> {
    /// Those that are called.
    pub(super) fn calls(&self, private: &TokenStream) -> Option<TokenStream> {
        let driver = &self.types.driver;
        let called = self.mechanism.externals.iter().filter(|external| self.externals.contains(&external.id));
        let calls: Vec<TokenStream> = called.map(|external| self.call(external)).collect();
        let block = quote!(impl<T: #private::Real> #driver<T> { #(#calls)* });
        (!calls.is_empty()).then_some(block)
    }

    fn call(&self, external: &ExternalFunction) -> TokenStream {
        let ExternalFunction { path, attributes, arguments, names, .. } = external;
        // What does not fit the function is said of its name.
        let place = path.segments.last().map_or_else(Span::call_site, |segment| segment.ident.span());
        let place = Span::call_site().located_at(place);
        let mut taken = Taken::default();
        // No argument stands before the function.
        if let Some(function) = path.get_ident() {
            taken.unique(&function.to_string());
        }
        let arguments: Vec<Ident> = arguments.iter().map(|name| Ident::new(&taken.unique(name), place)).collect();
        let fields: Vec<String> = names.iter().map(|name| name.field.clone()).collect();
        let texts: Vec<&str> = names.iter().map(|name| name.text.as_str()).collect();
        let docs = attributes.iter().filter(|attribute| attribute.path().is_ident("doc"));
        let text = format!(" `({})` of the user's function.", texts.join(", "));
        let scalars = texts.iter().map(|_| quote!(T));
        let result = if texts.len() == 1 { quote!(T) } else { quote!((#(#scalars),*)) };
        let (name, call) = (call_of(&fields), quote_spanned!(place=> #path(#(#arguments),*)));
        quote! {
            #(#docs)*
            #[doc = #text]
            #[inline]
            fn #name(#(#arguments: T),*) -> #result {
                #call
            }
        }
    }
}
