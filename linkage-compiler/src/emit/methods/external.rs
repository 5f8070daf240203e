//! The user's own functions: one private function each, where their paths mean what they mean to the user
//! and a wrong type is said once.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::names::{Taken, call_of, ident};
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
        let fields: Vec<String> = names.iter().map(|name| name.field.clone()).collect();
        let call = call_of(&fields);
        // No argument stands before the user's function.
        let mut taken = Taken::default();
        if let Some(function) = path.get_ident() {
            taken.unique(&function.to_string());
        }
        let arguments: Vec<Ident> = arguments.iter().map(|name| ident(&taken.unique(name))).collect();
        let texts: Vec<&str> = names.iter().map(|name| name.text.as_str()).collect();
        let docs = attributes.iter().filter(|attribute| attribute.path().is_ident("doc"));
        let text = format!(" `({})` of the user's function.", texts.join(", "));
        let scalars = texts.iter().map(|_| quote!(T));
        let result = if texts.len() == 1 { quote!(T) } else { quote!((#(#scalars),*)) };
        quote! {
            #(#docs)*
            #[doc = #text]
            #[inline]
            fn #call(#(#arguments: T),*) -> #result {
                #path(#(#arguments),*)
            }
        }
    }
}
