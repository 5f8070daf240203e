//! The type of the branches.

use linkage_ir::code::Code;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::derives::derives;
use super::parameters::MOST_ARGUMENTS;
use crate::emit::Declared;
use crate::emit::names::{comment, ident};
use crate::program::{Modes, Position, Program, Side};

/// The branch type: a field for each group with two solutions, one for each group whose positions have numbers, and, if
/// the position has a closed form, one for the turn of each angle that the pose stores as a number.
pub(super) fn branch(of: Declared<'_>, program: &Program<Code>, root: &TokenStream) -> TokenStream {
    let visibility = &of.mechanism.visibility;
    let (driver, branch) = (&of.driver.name, ident(&program.signatures.types.branch));
    let (Position { sides, modes, .. }, turns) = (&program.position, program.position.turns_of_branch());
    let derives = derives(of.mechanism, root);
    let title = comment(&match program.signatures.is_open {
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
    let functions = new.map(|new| quote!(impl #branch { #new }));
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
