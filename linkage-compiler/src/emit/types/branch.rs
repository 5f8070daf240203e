//! The type of the branches.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::derives::derives;
use super::parameters::MOST_ARGUMENTS;
use crate::emit::expression::literal;
use crate::emit::names::{comment, ident};
use crate::lower::Code;
use crate::program::{Position, Program, Side};

/// The branch type: a field for each group with two solutions and, if the position has a closed form, one for the turn
/// of each angle that the pose stores as a number.
pub(super) fn branch(program: &Program<Code>, root: &TokenStream) -> TokenStream {
    let visibility = &program.signatures.mechanism.visibility;
    let (driver, branch) = (&program.signatures.driver.name, ident(&program.signatures.types.branch));
    let Position { sides, turns, is_closed, .. } = &program.position;
    let turns = if *is_closed { turns.as_slice() } else { &[] };
    let derives = derives(program.signatures.mechanism, root);
    let title = comment(&match program.signatures.is_open() {
        true => format!(" The branch of [`{driver}`]: an open chain has a single one."),
        false => format!(" The assembly mode of [`{driver}`]: one of the two solutions of each group that has two."),
    });
    let example = (1..=MOST_ARGUMENTS).contains(&sides.len()).then(|| {
        let sides: Vec<String> =
            sides.iter().map(|Side { choice, .. }| format!("{}::{}", choice.name(), choice.variants()[0])).collect();
        let text = comment(&format!(" For instance `{branch}::new({})`.", sides.join(", ")));
        quote!(#[doc = ""] #[doc = #text])
    });
    let choices: Vec<(Ident, TokenStream)> = sides
        .iter()
        .map(|side| {
            let choice = ident(side.choice.name());
            (ident(&side.field), quote!(#root::__rt::#choice))
        })
        .collect();
    let names: Vec<&Ident> = choices.iter().map(|(side, _)| side).collect();
    let members = sides.iter().zip(&choices).map(|(Side { meaning, .. }, (side, of))| {
        let docs = comment(&format!(" {meaning}"));
        quote!(#[doc = #docs] pub #side: #of)
    });
    let turn_members = turns.iter().map(|turn| {
        let docs = comment(&format!(
            " The turn of `{}`: 0 for its principal value, between -pi and pi; n adds 2 pi n.",
            turn.coordinate
        ));
        let field = ident(&turn.field);
        quote!(#[doc = #docs] pub #field: i32)
    });
    let zeros: Vec<TokenStream> = turns
        .iter()
        .map(|turn| {
            let field = ident(&turn.field);
            quote!(#field: 0)
        })
        .collect();
    let new = (sides.len() <= MOST_ARGUMENTS).then(|| {
        let arguments = choices.iter().map(|(side, of)| quote!(#side: #of));
        let text = comment(match turns {
            [] => " The branch with these solutions.",
            _ if sides.is_empty() => " The branch with all turns 0.",
            _ => " The branch with these solutions and all turns 0.",
        });
        quote! {
            #[doc = #text]
            #[must_use]
            pub const fn new(#(#arguments),*) -> Self {
                Self { #(#names,)* #(#zeros),* }
            }
        }
    });
    let bits = (0..sides.len()).map(|place| match place {
        0 => quote!(bits & 1),
        place => {
            let place = literal(place);
            quote!((bits >> #place) & 1)
        }
    });
    let each = sides.iter().zip(&choices).zip(bits).map(|((Side { choice, .. }, (side, of)), bit)| {
        let [first, second] = choice.variants().map(ident);
        quote!(#side: if #bit == 0 { #of::#first } else { #of::#second })
    });
    let every = match sides.len() {
        0 => quote!(::core::iter::once(Self { #(#zeros),* })),
        many => {
            let count = Literal::u32_unsuffixed(1 << many.min(31));
            quote! {
                ::core::iter::Iterator::map(0..#count, |bits: u32| Self {
                    #(#each,)* #(#zeros),*
                })
            }
        }
    };
    let all = program.position.has_few_branches().then(|| {
        let text = if turns.is_empty() {
            " All branches; some may not exist at a given input."
        } else {
            " All branches with turns 0; some may not exist at a given input."
        };
        let text = comment(text);
        quote! {
            #[doc = #text]
            pub fn all() -> impl ::core::iter::Iterator<Item = Self> + ::core::clone::Clone {
                #every
            }
        }
    });
    let functions = (new.is_some() || all.is_some()).then(|| quote!(impl #branch { #new #all }));
    let default = sides.is_empty().then(|| quote!(, ::core::default::Default));
    quote! {
        #[doc = #title]
        #example
        #derives
        #[derive(::core::hash::Hash #default)]
        #visibility struct #branch { #(#members,)* #(#turn_members),* }
        #functions
    }
}
