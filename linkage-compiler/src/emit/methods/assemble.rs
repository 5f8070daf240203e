//! Position in closed form.

use quote::quote;

use super::super::kernel;
use super::super::kernel::Given;
use super::super::names::ident;
use super::{Body, Kernels, Methods, argument_of, bind, check_finite, lines, pose_members};
use crate::graph::{Function, NodeId, SymbolId};
use crate::simplify::schedule::Stage;

impl Methods<'_> {
    pub(super) fn assemble(&mut self, kernels: Option<&mut Kernels>) {
        let Some(kernels) = kernels else { return };
        let Some(assembly) = kernels.derivation.assembly() else { return };
        let (pose, inputs, branch_type) = (&self.types.pose, &self.types.inputs, &self.types.branch);
        let (v, branch) = (self.arguments.inputs.clone(), self.arguments.branch.clone());
        let sides: Vec<_> = assembly
            .chords
            .iter()
            .map(|&(block, _)| ident(&kernels.derivation.blocks[block].branch(kernels.derivation)))
            .collect();
        let chords = assembly.chords.clone();

        let determinants: Vec<NodeId> =
            kernels.plan.determinants.iter().map(|(block, _, _)| assembly.determinants[*block]).collect();
        let angles: Vec<NodeId> = kernels.plan.angles().collect();
        let graph = &mut kernels.derivation.graph;
        let circular: Vec<NodeId> = angles
            .into_iter()
            .flat_map(|angle| [Function::Cos, Function::Sin].map(|function| graph.call(function, &[angle])))
            .collect();
        let circular = assembly.solved(graph, &circular);
        let bare: Vec<SymbolId> = kernels.plan.values.iter().map(|(_, _, symbol)| *symbol).collect();
        let bare = kernels.variables(&bare);
        let mut stages = assembly.stages;
        stages.push(Stage::Return(determinants.iter().chain(&circular).chain(&bare).copied().collect()));
        let stages = needed(&kernels.derivation.graph, stages);
        let sources = vec![self.parameters(), self.inputs(kernels, &v, |c| c.value)];
        let given = Given { sources, pose: None, branch: &self.arguments.branch };
        let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.reserved);
        let mut wishes: Vec<String> = kernels.plan.determinants.iter().map(|(_, field, _)| field.clone()).collect();
        wishes.extend(
            kernels.plan.directions.values().flat_map(|field| [format!("cos_{field}"), format!("sin_{field}")]),
        );
        wishes.extend(kernels.plan.values.iter().map(|(_, field, _)| field.clone()));
        let (bindings, bound) = bind(&code.results, &wishes, &mut code.taken);
        let finite = check_finite(&mut code, "the position", &bound);
        let fields = pose_members(kernels.plan, bound.iter());
        if !circular.is_empty() {
            code.uses.insert("unit");
        }
        if !sides.is_empty() {
            code.arguments.push(branch.clone());
        }
        let body = Some(Body::new(code, quote!(#bindings #finite Ok(#pose { #fields })), []));
        let docs = lines([
            "The position at these inputs in closed form: group by group, on the branch that is asked for.",
            "",
            "# Errors",
            "`Unbuildable` if a group does not reach, `NotFinite` if a number is not finite.",
        ]);
        let [v, branch] = [&v, &branch].map(|argument| argument_of(argument, body.as_ref()));
        let signature =
            quote!(pub fn assemble(&self, #v: impl Into<#inputs<T>>, #branch: #branch_type) -> Result<#pose<T>, Error>);
        self.function(&docs, &signature, body);

        let pose_argument = self.arguments.pose.clone();
        let roots = chords.iter().filter_map(|(block, negative)| {
            let (_, field, _) = kernels.plan.determinants.iter().find(|(other, ..)| other == block)?;
            let (field, minus) = (ident(field), negative.then(|| quote!(-)));
            Some(quote!(Side::of(#minus #pose_argument.#field)))
        });
        let members = quote!(#branch_type { #(#sides: #roots),* });
        let body = if sides.is_empty() {
            Body::plain(members, [], [])
        } else {
            Body::plain(members, [&pose_argument], ["Side"])
        };
        let docs = lines(["The branch that a position belongs to."]);
        let pose_argument = argument_of(&pose_argument, Some(&body));
        let signature = quote!(#[must_use] pub fn branch_of(&self, #pose_argument: &#pose<T>) -> #branch_type);
        self.function(&docs, &signature, Some(body));
        self.branches = Some(sides);
    }
}

/// The stages without the names that nothing refers to; verdicts stay.
fn needed(graph: &crate::graph::Graph, stages: Vec<Stage>) -> Vec<Stage> {
    let mut used = std::collections::BTreeSet::new();
    let mut kept = Vec::new();
    for stage in stages.into_iter().rev() {
        if !matches!(&stage, Stage::Let { symbol, .. } if !used.contains(symbol)) {
            used.extend(graph.symbols_of(&stage.nodes()));
            kept.push(stage);
        }
    }
    kept.reverse();
    kept
}
