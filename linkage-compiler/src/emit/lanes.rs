//! Many positions at once: the type of the columns to find, the function that takes the given ones, and the conversions
//! between parameters and columns.

use linkage_ir::code::Code;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::Declared;
use super::names::{comment, ident};
use super::numbers::literal;
use super::rust::argument;
use super::types::{field, mark, other_scalar};
use crate::model::Name;
use crate::program::{Associated, Implementation, Program};

/// The type with one field for each column to find.
pub(super) fn columns(of: Declared<'_>, program: &Program<Code>) -> TokenStream {
    let (mechanism, driver) = (of.mechanism, &of.driver.name);
    let (visibility, name) = (&mechanism.visibility, ident(&program.signatures.types.columns));
    let fields: Vec<Ident> = program.columns.iter().map(|column| ident(&column.name)).collect();
    let docs = program.columns.iter().map(|column| comment(&format!(" {}", column.doc)));
    let (count, entry) = (literal(fields.len()), other_scalar(mechanism));
    // The stub of a mechanism without coordinates has none.
    let none = fields.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData<#entry>));
    let title = comment(&format!(
        " One entry for each column of a batch of [`{driver}`]: `Option<&mut [T]>` for the columns to find."
    ));
    quote! {
        #[doc = #title]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::default::Default)]
        #visibility struct #name<#entry> {
            #(#[doc = #docs] pub #fields: #entry,)*
            #none
        }
        impl<#entry> #name<#entry> {
            #[doc = " The columns in order, as `Batch::run` takes them."]
            #[must_use]
            pub fn list(self) -> [#entry; #count] {
                [#(self.#fields),*]
            }
        }
    }
}

/// The functions of the trait between parameters and columns.
pub(super) fn design(of: Declared<'_>, implementation: &Implementation<Code>) -> TokenStream {
    let parameters = parameters(of);
    let given = implementation.types.iter().find_map(|(name, is)| match is {
        Associated::Dimension(count) if *name == "Given" => Some(literal(*count)),
        _ => None,
    });
    let indices: Vec<_> = (0..parameters.len()).map(literal).collect();
    let mark = mark(&parameters);
    let [of_given, lane] = ["given", "lane"].map(|name| argument(name, !parameters.is_empty()));
    quote! {
        fn write_parameters(&self, #of_given: &mut [T; #given]) {
            #(given[#indices] = self.#parameters;)*
        }
        #[inline(always)]
        fn design<const W: usize>(#of_given: &[[T; W]; #given], #lane: usize) -> Self {
            Self { #(#parameters: given[#indices] [lane],)* #mark }
        }
    }
}

/// `batch`, which takes columns or numbers.
pub(super) fn batch(of: Declared<'_>, program: &Program<Code>) -> TokenStream {
    let Declared { mechanism, driver } = of;
    let (name, types) = (&driver.name, &program.signatures.types);
    let [branch, of_inputs] = [&types.branch, &types.inputs].map(|name| ident(name));
    let named = |names: Vec<&Name>| -> Vec<Ident> { names.into_iter().map(field).collect() };
    let (parameters, inputs) = (parameters(of), driver.inputs.iter());
    let inputs = named(inputs.map(|&index| &mechanism.coordinates[index].name).collect());
    let (start, of_start) = match program.position.is_closed {
        true => (inputs.clone(), of_inputs.clone()),
        false => {
            let order = mechanism.coordinate_order(driver);
            let all = order.iter().map(|&index| &mechanism.coordinates[index].name).collect();
            (named(all), ident(&types.coordinates))
        }
    };
    let into = quote!(__rt::Into<__rt::Values<'a, T>>);
    quote! {
        impl<T: __rt::Real> #name<T> {
            #[doc = " Many positions at once, from columns or single numbers: the parameters; the inputs, or a guess; the branch;"]
            #[doc = " the rates of the inputs; their accelerations. Each position is that of the branch, which at a change point may jump"]
            #[doc = " to another motion."]
            #[doc = ""]
            #[doc = " # Errors"]
            #[doc = " `InputError::ColumnLength` if two columns differ in length."]
            pub fn batch<'a>(
                design: #name<impl #into>,
                start: #of_start<impl #into>,
                branch: #branch,
                rates: #of_inputs<impl #into>,
                accelerations: #of_inputs<impl #into>,
            ) -> __rt::Result<__rt::Batch<'a, Self>, __rt::InputError> {
                __rt::Batch::new(
                    [
                        #(design.#parameters.into(),)*
                        #(start.#start.into(),)*
                        #(rates.#inputs.into(),)*
                        #(accelerations.#inputs.into(),)*
                    ],
                    branch,
                )
            }
        }
    }
}

fn parameters(of: Declared<'_>) -> Vec<Ident> {
    of.mechanism.parameters.iter().map(|parameter| field(&parameter.name)).collect()
}
