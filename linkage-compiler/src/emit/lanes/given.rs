//! The given columns of a batch: parameters, inputs or a guess, and the rates and accelerations of the inputs.

use std::ops::Range;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::emit::names::ident;
use crate::emit::rust::{argument, literal};
use crate::emit::types::{field, mark};
use crate::lower::Code;
use crate::model::{Name, TypeName};
use crate::program::{Program, Taken};

pub struct Given {
    pub names: Vec<String>,
    parameters: Vec<Ident>,
    /// The inputs, or all coordinates of a guess.
    start: Vec<Ident>,
    inputs: Vec<Ident>,
    /// The type of the start, and that of the inputs.
    of_start: Ident,
    of_inputs: Ident,
}

impl Given {
    pub fn of(program: &Program<Code>) -> Self {
        let (mechanism, driver) = (program.signatures.mechanism, program.signatures.driver);
        let types = &program.signatures.types;
        let parameters: Vec<&Name> = mechanism.parameters.iter().map(|parameter| &parameter.name).collect();
        let inputs: Vec<&Name> = driver.inputs.iter().map(|&place| &mechanism.coordinates[place].name).collect();
        let order = mechanism.coordinate_order(driver);
        let (start, of_start): (Vec<&Name>, _) = match program.position.is_closed {
            true => (inputs.clone(), &types.inputs),
            false => (order.iter().map(|&place| &mechanism.coordinates[place].name).collect(), &types.coordinates),
        };
        let mut taken = Taken::unreserved();
        let mut names: Vec<String> = parameters.iter().chain(&start).map(|name| taken.unique(&name.text)).collect();
        for ending in ["_rate", "_acceleration"] {
            names.extend(inputs.iter().map(|name| taken.unique(&format!("{}{ending}", name.text))));
        }
        let fields = |names: &[&Name]| -> Vec<Ident> { names.iter().map(|name| field(name)).collect() };
        Self {
            names,
            parameters: fields(&parameters),
            start: fields(&start),
            inputs: fields(&inputs),
            of_start: ident(of_start),
            of_inputs: ident(&types.inputs),
        }
    }

    /// The numbers of parameters and of coordinates to start from.
    pub fn counts(&self) -> [Literal; 2] {
        [literal(self.parameters.len()), literal(self.start.len())]
    }

    /// Statements that bind the start, the rates and the accelerations of one lane; `index` follows the column.
    pub fn bound(&self, index: &TokenStream) -> TokenStream {
        let (no_start, no_inputs) = (mark(&self.start), mark(&self.inputs));
        let Self { parameters, start, inputs, of_start, of_inputs, .. } = self;
        let (p, s, v) = (parameters.len(), start.len(), inputs.len());
        let at_start = at(p..p + s, index);
        let [at_rates, at_accelerations] = [p + s, p + s + v].map(|from| at(from..from + v, index));
        quote! {
            let start = #of_start { #(#start: #at_start,)* #no_start };
            let rates = #of_inputs { #(#inputs: #at_rates,)* #no_inputs };
            let accelerations = #of_inputs { #(#inputs: #at_accelerations,)* #no_inputs };
        }
    }

    /// The functions of the trait between parameters and columns.
    pub fn design(&self) -> TokenStream {
        let (parameters, count) = (&self.parameters, literal(self.names.len()));
        let (at_parameters, places) = (at(0..parameters.len(), &quote!([lane])), (0..parameters.len()).map(literal));
        let mark = parameters.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData));
        let [given, lane] = ["given", "lane"].map(|name| argument(name, !parameters.is_empty()));
        quote! {
            fn write_parameters(&self, #given: &mut [T; #count]) {
                #(given[#places] = self.#parameters;)*
            }
            #[inline(always)]
            fn design<const W: usize>(#given: &[[T; W]; #count], #lane: usize) -> Self {
                Self { #(#parameters: #at_parameters,)* #mark }
            }
        }
    }

    /// `batch`, which takes columns or numbers.
    pub fn batch(&self, name: &TypeName, branch: &Ident) -> TokenStream {
        let Self { parameters, start, inputs, of_start, of_inputs, .. } = self;
        let into = quote!(__rt::Into<__rt::Values<'a, T>>);
        quote! {
            #[doc = " Many positions at once, from columns or single numbers: the parameters; the inputs, or a guess; the branch;"]
            #[doc = " the rates of the inputs; their accelerations."]
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

/// The numbers of one lane in these given columns.
fn at(places: Range<usize>, index: &TokenStream) -> Vec<TokenStream> {
    let places = places.map(literal);
    places.map(|place| quote!(given[#place] #index)).collect()
}
