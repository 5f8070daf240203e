//! What functions are made of besides the lines of their kernels: results in their types, and verdicts on them.

use std::collections::BTreeSet;

use proc_macro2::{Delimiter, Ident, Literal, TokenStream};
use quote::{ToTokens, quote};
use rustc_hash::FxHashSet;

use super::super::kernel::{Code, Operand};
use super::super::names::{Taken, ident, string};
use super::super::pose::PosePlan;
use super::super::tokens::Tokens;
use crate::graph::ExternalId;
use crate::lower::Operations;

/// The body of a function.
pub(super) struct Body {
    pub(super) tokens: Tokens,
    pub(super) operations: Operations,
    /// The arguments that it uses.
    pub(super) arguments: Vec<Ident>,
    /// What it uses of the runtime.
    pub(super) uses: BTreeSet<&'static str>,
    /// The functions of the user's that it calls.
    pub(super) externals: BTreeSet<ExternalId>,
}

impl Body {
    /// A kernel with its last lines, which use these names of the runtime.
    pub(super) fn new<const N: usize>(code: Code, tail: TokenStream, also: [&'static str; N]) -> Self {
        let Code { mut body, operations, arguments, mut uses, externals, .. } = code;
        body.extend(tail);
        uses.extend(also);
        Self { tokens: body, operations, arguments, uses, externals }
    }

    /// Lines that compute nothing themselves.
    pub(super) fn plain<const N: usize, const M: usize>(
        tokens: TokenStream,
        arguments: [&Ident; N],
        uses: [&'static str; M],
    ) -> Self {
        let arguments = arguments.into_iter().cloned().collect();
        let (operations, externals) = (Operations::default(), BTreeSet::new());
        Self { tokens: tokens.into(), operations, arguments, uses: BTreeSet::from(uses), externals }
    }
}

/// The name of an argument in the signature of a function: with an underscore if the body ignores it.
pub(super) fn argument_of(name: &Ident, body: Option<&Body>) -> Ident {
    if body.is_some_and(|body| body.arguments.contains(name)) { name.clone() } else { ident(&format!("_{name}")) }
}

/// A size without suffix, as people write it.
pub(super) fn literal(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

/// The members of a pose from determinants, cosines and sines, what is held as a number, and the values of
/// the user's functions.
pub(super) fn pose_members<'a>(plan: &PosePlan, mut results: impl Iterator<Item = &'a Operand>) -> TokenStream {
    let mut members = TokenStream::new();
    for ((_, field, _), value) in plan.determinants.iter().zip(results.by_ref()) {
        let member = member(&ident(field), value);
        members.extend(quote!(#member,));
    }
    for field in plan.directions.values() {
        let (field, parts) = (ident(field), results.by_ref().take(2));
        members.extend(quote!(#field: unit(#(#parts),*),));
    }
    let values = plan.values.iter().map(|(_, field, _)| field);
    for (field, value) in values.chain(plan.externals.iter().map(|(_, field, _)| field)).zip(results) {
        let member = member(&ident(field), value);
        members.extend(quote!(#member,));
    }
    members
}

/// `name: value`, or `name` alone if the value is called so.
pub(super) fn member(name: &Ident, value: &Operand) -> TokenStream {
    match value {
        Operand::Name(value) if value == name => quote!(#name),
        value => quote!(#name: #value),
    }
}

/// A matrix from its entries, column by column.
pub(super) fn columns_of(entries: &[impl ToTokens], rows: usize) -> TokenStream {
    let columns = entries.chunks(rows).map(|column| quote!([#(#column),*]));
    quote!(SMatrix::from([#(#columns),*]))
}

/// Values separated by commas, in lists of lists of so many each, the outer ones first.
pub(super) fn in_parts(values: Vec<Operand>, sizes: &[usize]) -> Tokens {
    let mut tokens = Tokens::default();
    let count = values.len() / sizes.iter().product::<usize>().max(1);
    write_parts(&mut tokens, &mut values.into_iter(), count, sizes);
    tokens
}

pub(super) fn write_parts(
    tokens: &mut Tokens,
    values: &mut std::vec::IntoIter<Operand>,
    count: usize,
    sizes: &[usize],
) {
    for index in 0..count {
        if index > 0 {
            tokens.punct(',');
        }
        if let Some((&size, inner)) = sizes.split_first() {
            let mut list = Tokens::default();
            write_parts(&mut list, values, size, inner);
            tokens.group(Delimiter::Bracket, list);
            continue;
        }
        match values.next() {
            Some(Operand::Name(name)) => tokens.append(name),
            Some(Operand::Constant(value) | Operand::Formula(value)) => tokens.join(value),
            None => {}
        }
    }
}

/// `finite(NAME, what, [values])?;`, each value once.
pub(super) fn check_finite(code: &mut Code, what: &str, values: &[Operand]) -> TokenStream {
    let mut seen = FxHashSet::default();
    let values: Vec<_> = values
        .iter()
        .filter(|value| match value {
            Operand::Name(name) => seen.insert(name.to_string()),
            Operand::Constant(_) => false,
            Operand::Formula(_) => true,
        })
        .collect();
    if values.is_empty() {
        return TokenStream::new();
    }
    code.uses.insert("finite");
    let what = string(what);
    quote!(finite(Self::NAME, #what, [#(#values),*])?;)
}

/// Gives a name to every result that is not one already.
pub(super) fn bind(results: &[Operand], wishes: &[String], taken: &mut Taken) -> (TokenStream, Vec<Operand>) {
    let mut bindings = Tokens::default();
    let mut names = Vec::new();
    for (result, wish) in results.iter().zip(wishes) {
        names.push(match result {
            Operand::Formula(formula) => {
                let name = ident(&taken.unique(wish));
                bindings.word("let");
                bindings.ident(&name);
                bindings.punct('=');
                bindings.join(formula.clone());
                bindings.punct(';');
                Operand::Name(name)
            }
            named => named.clone(),
        });
    }
    (bindings.into(), names)
}
