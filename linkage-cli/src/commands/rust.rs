//! `linkage rust`: the expansion, formatted.

use linkage_compiler::emit;
use proc_macro2::TokenStream;
use quote::quote;

use super::compiled::compiled;
use crate::arguments::Code;
use crate::failure::Failure;
use crate::names::place;
use crate::output::{self, form};
use crate::source::read;

pub fn run(arguments: &Code) -> Result<(), Failure> {
    form(&arguments.output, "this code", &[("Rust", &["rs", "txt"])])?;
    let source = read(&arguments.source.file)?;
    let root = quote!(::linkage);
    let compiled = compiled(&source, |of| emit::driver(of.declared, &of.program, Some(&of.derivation), &root))?;
    let names: Vec<String> = compiled.iter().map(|of| of.mechanism.name.to_string()).collect();
    if let Some(asked) = &arguments.source.mechanism {
        place(&source.name, "mechanism", asked, &names.iter().map(String::as_str).collect::<Vec<_>>())?;
    }
    let is_asked = |name: &String| arguments.source.mechanism.as_ref().is_none_or(|asked| asked == name);
    let asked = compiled.into_iter().zip(&names).filter(|(_, name)| is_asked(name));
    let items = asked.map(|(of, _)| emit::mechanism(&of.mechanism, of.drivers, &root));
    output::write(&arguments.output, formatted(quote!(#(#items)*))?.as_bytes(), &arguments.source.file)
}

fn formatted(items: TokenStream) -> Result<String, Failure> {
    let file = syn::parse2(items).map_err(|error| Failure::Outside(format!("the code is not read: {error}")))?;
    Ok(prettyplease::unparse(&file))
}
