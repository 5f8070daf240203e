//! The pose of a position, and the position near a guess.

use quote::quote;

use super::super::kernel;
use super::{Arguments, Body, Kernels, Methods, argument_of, pose_members, without_result};
use crate::graph::{Function, NodeId, SymbolId};
use crate::lower::Stage;

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
            let graph = &mut kernels.derivation.graph;
            let circular: Vec<NodeId> = kernels
                .plan
                .angles()
                .flat_map(|angle| [Function::Cos, Function::Sin].map(|function| graph.call(function, &[angle])))
                .collect();
            let bare: Vec<SymbolId> = kernels.plan.values.iter().map(|(_, _, symbol)| *symbol).collect();
            let bare = kernels.variables(&bare);
            let externals: Vec<NodeId> = kernels.plan.externals.iter().map(|(node, ..)| *node).collect();
            let results = values.iter().chain(&circular).chain(&bare).chain(&externals);
            stages.push(Stage::Return(results.copied().collect()));
            let sources = vec![self.parameters(), self.coordinates(kernels, &q, |c| c.value)];
            let given = self.given(sources, None);
            let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.scope);
            if !circular.is_empty() {
                code.uses.insert("unit");
            }
            let fields = pose_members(kernels.plan, code.results.iter());
            Body::new(code, quote!(#pose { #fields }), [])
        });
        let calls = if self.mechanism.externals.is_empty() { "" } else { ", one call for each function of the user's" };
        let docs =
            [format!("The position at these coordinates, ready for use: one sine and cosine for each angle{calls}.")];
        let q = argument_of(&q, body.as_ref());
        let signature = self.words.total("pose_at", [self.words.borrowed(&q, coordinates)], self.words.of(pose));
        self.function(&without_result(docs.to_vec()), signature, body);

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
            quote!(pub fn solve(&self, guess: #guess) -> Result<#solution, Error>),
            Some(Body::plain(quote!(newton(self, guess)), [], ["newton"])),
        );
    }
}
