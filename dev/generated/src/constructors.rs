//! Functions without type parameters for what only moves numbers: constructors, changes of the scalar, and the state of a
//! scene as a column. The program has no functions for them, their signatures are those of the types.

use linkage_compiler::emit::MOST_ARGUMENTS;
use linkage_compiler::program::Code;
use linkage_compiler::program::{Implemented, SceneProgram};
use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, format_ident, quote};

use crate::ident;
use crate::values::Values;

impl Values<'_, '_> {
    /// Those of a driver and of its scenes, and with the first driver those of a mechanism whose inputs are chosen.
    pub(crate) fn constructors(&self) -> Vec<TokenStream> {
        let (types, parameters) = (&self.program.signatures.types, self.mechanism.parameters.len());
        let is_first = self.mechanism.drivers.first().is_some_and(|first| first.name == self.driver.name);
        let of_all = self.mechanism.is_driven_by_choice() && is_first;
        let of_all = of_all.then(|| of_parameters(&self.mechanism.name.to_string(), parameters));
        let mut all = of_parameters(&types.driver, parameters);
        all.extend(of_all.into_iter().flatten());
        all.extend(self.branch_constructor());
        all.extend(self.program.scenes.iter().flat_map(of_scene));
        all
    }

    fn branch_constructor(&self) -> Option<TokenStream> {
        let (name, sides) = (&self.program.signatures.types.branch, &self.program.position.sides);
        let choices = sides.iter().map(|side| {
            let choice = ident(side.choice.name());
            quote!(__rt::#choice)
        });
        constructor(name, &ident(name).to_token_stream(), choices.collect())
    }
}

/// The constructor of a type, and the change of its scalar.
fn of_parameters(name: &str, count: usize) -> Vec<TokenStream> {
    let of = over_scalar(name);
    let arguments = (0..count).map(|_| quote!(T)).collect();
    constructor(name, &of, arguments).into_iter().chain([map(name, &of)]).collect()
}

fn of_scene(scene: &SceneProgram<Code>) -> Vec<TokenStream> {
    let signatures = &scene.signatures;
    let types = &signatures.types;
    let (name, of, driver) = (&types.itself, over_scalar(&types.itself), over_scalar(&types.driver));
    let parameters = signatures.parameters.iter().map(|_| quote!(T));
    let arguments = [driver.clone()].into_iter().chain(parameters).collect();
    let mut all: Vec<TokenStream> = constructor(name, &of, arguments).into_iter().chain([map(name, &of)]).collect();
    if scene.implementation.as_ref().is_some_and(|one| one.of == Implemented::Scene) {
        let [inner, state, parts] = ["mechanism", "state", "parts"].map(|function| wrapper(name, function));
        let [coordinates, inputs] = [&types.coordinates, &types.inputs].map(|name| over_scalar(name));
        let column = quote!(__rt::Column<T, <#of as __rt::Scene>::State>);
        all.extend([
            quote! {
                #[inline(never)]
                pub fn #inner(itself: &#of) -> &#driver {
                    <#of as __rt::Scene>::mechanism(itself)
                }
            },
            quote! {
                #[inline(never)]
                pub fn #state(q: &#coordinates, rates: &#inputs) -> #column {
                    <#of as __rt::Scene>::state(q, rates)
                }
            },
            quote! {
                #[inline(never)]
                pub fn #parts(state: &#column) -> __rt::StateParts<#coordinates, #inputs> {
                    <#of as __rt::Scene>::parts(state)
                }
            },
        ]);
    }
    all
}

/// `new`, which a type with few arguments has.
fn constructor(name: &str, of: &TokenStream, arguments: Vec<TokenStream>) -> Option<TokenStream> {
    let wrapper = wrapper(name, "new");
    let names: Vec<Ident> = (0..arguments.len()).map(|place| format_ident!("a{place}")).collect();
    (arguments.len() <= MOST_ARGUMENTS).then(|| {
        quote! {
            #[inline(never)]
            pub fn #wrapper(#(#names: #arguments),*) -> #of {
                <#of>::new(#(#names),*)
            }
        }
    })
}

fn map(name: &str, of: &TokenStream) -> TokenStream {
    let wrapper = wrapper(name, "map");
    quote! {
        #[inline(never)]
        pub fn #wrapper(itself: #of, scalar: fn(T) -> T) -> #of {
            itself.map(scalar)
        }
    }
}

fn wrapper(name: &str, function: &str) -> Ident {
    format_ident!("{name}_{function}")
}

/// A type over the scalar.
pub(crate) fn over_scalar(name: &str) -> TokenStream {
    let name = ident(name);
    quote!(#name<T>)
}
