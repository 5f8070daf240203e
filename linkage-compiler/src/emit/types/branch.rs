//! The type of the branches.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::derives::derives;
use super::parameters::MOST_ARGUMENTS;
use crate::emit::names::{comment, ident};
use crate::emit::rust::literal;
use crate::lower::Code;
use crate::program::{Modes, Position, Program, Side};

/// The branch type: a field for each group with two solutions, one for each group whose positions have numbers, and, if
/// the position has a closed form, one for the turn of each angle that the pose stores as a number.
pub(super) fn branch(program: &Program<Code>, root: &TokenStream) -> TokenStream {
    let visibility = &program.signatures.mechanism.visibility;
    let (driver, branch) = (&program.signatures.driver.name, ident(&program.signatures.types.branch));
    let Position { sides, modes, turns, is_closed, .. } = &program.position;
    let turns = if *is_closed { turns.as_slice() } else { &[] };
    let derives = derives(program.signatures.mechanism, root);
    let title = comment(&match program.signatures.is_open() {
        true => format!(" The branch of [`{driver}`]: an open chain has a single one."),
        false if modes.is_empty() => {
            format!(" The assembly mode of [`{driver}`]: one of the two solutions of each group that has two.")
        }
        false if sides.is_empty() => {
            format!(" The assembly mode of [`{driver}`]: the number of the position of each group without closed form.")
        }
        false => format!(
            " The assembly mode of [`{driver}`]: one of the two solutions of each group that has two, and the number of the \
             position of each group without closed form."
        ),
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
    let numbers = modes.iter().map(|Modes { field, unknowns, .. }| {
        let docs = comment(&format!(
            " The number of the position of the group of `{}`, among all that it has at the same inputs. Functions with a guess \
             do not use it.",
            unknowns.replace(", ", "`, `")
        ));
        let field = ident(field);
        quote!(#[doc = #docs] pub #field: #root::__rt::AssemblyMode)
    });
    let turn_members = turns.iter().map(|turn| {
        let docs = comment(&format!(
            " The turn of `{}`: 0 for its principal value, between -pi and pi; n adds 2 pi n.",
            turn.coordinate
        ));
        let field = ident(&turn.field);
        quote!(#[doc = #docs] pub #field: i32)
    });
    let of_guess = modes.iter().map(|group| {
        let field = ident(&group.field);
        quote!(#field: #root::__rt::AssemblyMode::OfGuess)
    });
    let zeros = turns.iter().map(|turn| {
        let field = ident(&turn.field);
        quote!(#field: 0)
    });
    let zeros: Vec<TokenStream> = of_guess.chain(zeros).collect();
    let new = (sides.len() <= MOST_ARGUMENTS).then(|| {
        let arguments = choices.iter().map(|(side, of)| quote!(#side: #of));
        let text = comment(match turns {
            _ if sides.is_empty() && !modes.is_empty() => " The branch near a guess, without numbers.",
            _ if !modes.is_empty() => " The branch with these solutions near a guess, without numbers.",
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
    let every = every(&program.position, &zeros, root);
    let all = program.position.has_counted_branches().then(|| {
        let text = if !modes.is_empty() {
            " All branches with a number for each group without closed form, numbers fastest; some may not exist at a given input."
        } else if turns.is_empty() {
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
        #visibility struct #branch { #(#members,)* #(#numbers,)* #(#turn_members),* }
        #functions
    }
}

/// An iterator of all branches: numbers change fastest, that of the last group first.
fn every(position: &Position, zeros: &[TokenStream], root: &TokenStream) -> TokenStream {
    let Position { sides, modes, .. } = position;
    // The part of the place in the order that counts the numbers of a group, or those of all.
    let mut steps = vec![1];
    for group in modes.iter().rev() {
        steps.insert(0, group.most * steps[0]);
    }
    let (place, of) = match modes.as_slice() {
        [] => (ident("bits"), quote!(u32)),
        _ => (ident("place"), quote!(usize)),
    };
    let bits = match steps[0] {
        1 => quote!(#place),
        step => {
            let step = literal(step);
            quote!((#place / #step))
        }
    };
    let each = sides.iter().enumerate().map(|(bit, Side { field, choice, .. })| {
        let (field, of) = (ident(field), ident(choice.name()));
        let [first, second] = choice.variants().map(ident);
        let bit = match bit {
            0 => quote!(#bits & 1),
            bit => {
                let bit = literal(bit);
                quote!((#bits >> #bit) & 1)
            }
        };
        quote!(#field: if #bit == 0 { #root::__rt::#of::#first } else { #root::__rt::#of::#second })
    });
    let numbers = modes.iter().zip(&steps[1..]).map(|(Modes { field, most, .. }, step)| {
        let (field, most) = (ident(field), literal(*most));
        let number = match *step {
            1 => quote!(#place % #most),
            step => {
                let step = literal(step);
                quote!(#place / #step % #most)
            }
        };
        quote!(#field: #root::__rt::AssemblyMode::Number(#number))
    });
    let (each, zeros) = (each.chain(numbers).collect::<Vec<_>>(), if modes.is_empty() { zeros } else { &[] });
    match position.count_branches() {
        Some(1) => quote!(::core::iter::once(Self { #(#zeros),* })),
        count => {
            let count = Literal::usize_unsuffixed(count.unwrap_or(usize::MAX));
            quote! {
                ::core::iter::Iterator::map(0..#count, |#place: #of| Self {
                    #(#each,)* #(#zeros),*
                })
            }
        }
    }
}
