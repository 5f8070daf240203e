//! The compiler behind `linkage!`: tokens in, tokens out.
//!
//! [`expand`] is the whole of it in one paragraph; the stages stand in this order, and none looks
//! back at an earlier one's types but through the model:
//! syntax, model, graph, derivation, structure, simplify, emit.

// Formulas and counts are converted between integers and floats on purpose.
pub mod derivation;
pub mod diagnostics;
pub mod emit;
pub mod graph;
pub mod model;
mod places;
pub mod simplify;
pub mod structure;
pub mod syntax;

use proc_macro2::TokenStream;
use quote::quote;

use derivation::Derivation;
use diagnostics::Diagnostics;
use emit::Emitted;
use model::Mechanism;
use simplify::schedule::Operations;

/// Expands the body of one `linkage!` invocation; `root` is the path of the `linkage` crate.
///
/// Mistakes come out as `compile_error!`s on the tokens that made them, beside stubs that have the
/// names and types of what was meant, so that one mistake is one message.
#[must_use]
pub fn expand(input: TokenStream, root: &TokenStream) -> TokenStream {
    let mut diagnostics = Diagnostics::default();
    let trees = syntax::parse(input, &mut diagnostics);
    let mechanisms: Vec<Mechanism> = trees.into_iter().map(|tree| model::resolve(tree, &mut diagnostics)).collect();
    let mut derivations: Vec<Vec<Derivation>> = Vec::new();
    if diagnostics.is_empty() {
        derivations = mechanisms.iter().map(derive).collect();
        for (mechanism, derivations) in mechanisms.iter().zip(&derivations) {
            derivation::check(mechanism, derivations, &mut diagnostics);
        }
    }
    if !diagnostics.is_empty() {
        let errors = diagnostics.to_tokens();
        let stubs = mechanisms.iter().filter(|mechanism| mechanism.is_well_named());
        let stubs = stubs.map(|mechanism| emit::mechanism(mechanism, None, root).tokens);
        return quote! { #errors #(#stubs)* };
    }
    let derived = mechanisms.iter().zip(&mut derivations);
    derived.map(|(mechanism, derivations)| emit::mechanism(mechanism, Some(derivations), root).tokens).collect()
}

/// What a checked mechanism becomes, and how large it is.
#[derive(Debug, Clone)]
pub struct Expansion {
    pub tokens: TokenStream,
    /// The nodes of the expression graphs.
    pub nodes: usize,
    /// The work of all emitted functions, each called once.
    pub operations: Operations,
}

/// Derives and emits a checked mechanism; `root` is the path of the `linkage` crate.
#[must_use]
pub fn compile(mechanism: &Mechanism, root: &TokenStream) -> Expansion {
    let mut derivations = derive(mechanism);
    let Emitted { tokens, operations } = emit::mechanism(mechanism, Some(&mut derivations), root);
    let nodes = derivations.iter().map(|derivation| derivation.graph.len()).sum();
    Expansion { tokens, nodes, operations }
}

/// The derivations of a checked mechanism, one for each driver.
#[must_use]
pub fn derive(mechanism: &Mechanism) -> Vec<Derivation> {
    mechanism
        .drivers
        .iter()
        .filter_map(|driver| {
            let blocks = structure::order(&mechanism.incidence(driver), driver.unknowns.len()).ok()?;
            Some(derivation::derive(mechanism, driver, blocks))
        })
        .collect()
}

/// Reads mechanisms without expanding them, for tests and tools.
///
/// # Errors
/// The messages, if there are mistakes.
pub fn read(input: TokenStream) -> Result<Vec<Mechanism>, Vec<String>> {
    let mut diagnostics = Diagnostics::default();
    let trees = syntax::parse(input, &mut diagnostics);
    let mechanisms = trees.into_iter().map(|tree| model::resolve(tree, &mut diagnostics)).collect();
    if diagnostics.is_empty() { Ok(mechanisms) } else { Err(diagnostics.messages()) }
}
