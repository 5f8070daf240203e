//! The pose of a position, and the position near a guess.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::kernel;
use super::super::kernel::Given;
use super::super::names::ident;
use super::{Arguments, Body, Kernels, Methods, argument_of, member};
use crate::graph::{NodeId, SymbolId};
use crate::simplify::schedule::Stage;

impl Methods<'_> {
    pub(super) fn position(&mut self, kernels: Option<&mut Kernels>) {
        let Arguments { q, .. } = &self.arguments;
        let q = q.clone();
        let (coordinates, pose) = (&self.types.coordinates, &self.types.pose);
        let body = kernels.map(|kernels| {
            let mut stages = Vec::new();
            let blocks = &kernels.derivation.blocks;
            let values: Vec<NodeId> = kernels
                .plan
                .determinants
                .iter()
                .filter_map(|(block, _, _)| Some(blocks[*block].determinant?.value))
                .collect();
            let angles: Vec<NodeId> = kernels.plan.angles().collect();
            let bare: Vec<SymbolId> = kernels.plan.values.iter().map(|(_, _, symbol)| *symbol).collect();
            let bare = kernels.variables(&bare);
            stages.push(Stage::Return(values.iter().chain(&angles).chain(&bare).copied().collect()));
            let sources = vec![self.parameters(), self.coordinates(kernels, &q, |c| c.value)];
            let given = Given { sources, pose: None };
            let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.reserved);
            code.operations.functions += kernels.plan.directions.len();
            let mut results = code.results.iter();
            let mut fields = TokenStream::new();
            for ((_, field, _), value) in kernels.plan.determinants.iter().zip(results.by_ref()) {
                let member = member(&ident(field), value);
                fields.extend(quote!(#member,));
            }
            for ((_, field), value) in kernels.plan.directions.iter().zip(results.by_ref()) {
                let field = ident(field);
                fields.extend(quote!(#field: direction(#value),));
            }
            for ((_, field, _), value) in kernels.plan.values.iter().zip(results) {
                let field = ident(field);
                let member = member(&field, value);
                fields.extend(quote!(#member,));
            }
            if !kernels.plan.directions.is_empty() {
                code.uses.insert("direction");
            }
            Body::new(code, quote!(#pose { #fields }), [])
        });
        let docs = ["The position at these coordinates, ready for use: one sine and cosine for each angle.".to_owned()];
        let q = argument_of(&q, body.as_ref());
        let signature = quote!(#[must_use] pub fn pose_at(&self, #q: &#coordinates<T>) -> #pose<T>);
        self.function(&docs, &signature, body);

        // The name of a function is never that of a `let`, so the trait's can be called beside it.
        let (guess, solution) = (quote!(&#coordinates<T>), quote!(Solution<#coordinates<T>>));
        let docs = [
            "The position near `guess` whose inputs are those of `guess`, by Newton's method.".to_owned(),
            String::new(),
            "# Errors".to_owned(),
            "`NotConverged` if no position is found, `NotFinite` if a number is not finite.".to_owned(),
        ];
        self.function(
            &docs,
            &quote!(pub fn solve(&self, guess: #guess) -> Result<#solution, Error>),
            Some(Body::plain(quote!(newton(self, guess)), [], ["newton"])),
        );
    }
}
