//! The implementations of the runtime's traits for formulas over numbers of any kind.

use linkage_ir::code::Code;
use proc_macro2::{Span, TokenStream};
use quote::quote;

use super::Declared;
use super::functions;
use super::names::{ident, string};
use super::numbers::literal;
use super::types::other_scalar;
use crate::program::{Family, Program};

/// Implements `Formulas` over every number, and `Certifiable` over `f64`.
pub(super) fn of_driver(of: Declared<'_>, program: &Program<Code>, span: Span) -> Option<TokenStream> {
    let (signatures, any) = (&program.signatures, program.any_number.as_ref()?);
    let (name, parameters) = (&of.driver.name, &signatures.parameters);
    let [p, u, v, q] =
        [parameters.len(), signatures.unknowns.len(), signatures.inputs.len(), signatures.components()].map(literal);
    let fields = parameters.iter().map(|parameter| ident(&parameter.name.field));
    let (error, other) = (ident("PositionError"), other_scalar(of.mechanism));
    let functions =
        any.functions.iter().map(|function| functions::function(function, &program.names, &error, None, span));
    let parameters = parameters.iter().map(|parameter| string(&parameter.name.text));
    let quantities = [Family::Points, Family::Outputs].into_iter().flat_map(|family| family.components(signatures));
    let quantities = quantities.map(|name| string(&name));
    let users = any.user_functions.iter().map(|user| match user {
        Some(name) => {
            let name = string(name);
            quote!(__rt::Some(#name))
        }
        None => quote!(__rt::None),
    });
    Some(quote! {
        impl<T: __rt::Number> __rt::Formulas for #name<T> {
            type Number = T;
            type U = __rt::D<#u>;
            type V = __rt::D<#v>;
            type Q = __rt::D<#q>;
            #(#functions)*
        }
        impl __rt::Certifiable for #name<f64> {
            type P = __rt::D<#p>;
            type Q = __rt::D<#q>;
            type Over<#other: __rt::Number> = #name<#other>;
            const PARAMETERS: &'static [&'static str] = &[#(#parameters),*];
            const QUANTITIES: &'static [&'static str] = &[#(#quantities),*];
            const USER_FUNCTIONS: &'static [__rt::Option<&'static str>] = &[#(#users),*];
            fn parameters(&self) -> __rt::Column<f64, __rt::D<#p>> {
                [#(self.#fields),*].into()
            }
            fn with(&self, parameters: __rt::Column<f64, __rt::D<#p>>) -> Self {
                <[f64; #p]>::from(parameters).into()
            }
            fn over<#other: __rt::Number>(&self, parameters: __rt::Column<#other, __rt::D<#p>>) -> #name<#other> {
                <[#other; #p]>::from(parameters).into()
            }
        }
    })
}
