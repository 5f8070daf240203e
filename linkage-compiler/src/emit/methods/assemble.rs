//! Position in closed form.

use proc_macro2::Ident;
use quote::quote;

use super::super::kernel;
use super::super::kernel::Given;
use super::super::{names::ident, types};
use super::{Body, Kernels, Methods, argument_of, bind, check_finite, lines, pose_members};
use crate::derivation::Choice;
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
            .map(|chord| (ident(&kernels.derivation.blocks[chord.block].branch(kernels.derivation)), chord.choice))
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
        let externals: Vec<NodeId> = kernels.plan.externals.iter().map(|(node, ..)| *node).collect();
        let externals = assembly.solved(&mut kernels.derivation.graph, &externals);
        let mut stages = assembly.stages;
        let results = determinants.iter().chain(&circular).chain(&bare).chain(&externals);
        stages.push(Stage::Return(results.copied().collect()));
        let stages = needed(&kernels.derivation.graph, stages);
        let sources = vec![self.parameters(), self.inputs(kernels, &v, |c| c.value)];
        let given = Given { sources, pose: None, branch: &self.arguments.branch };
        let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.reserved);
        let mut wishes: Vec<String> = kernels.plan.determinants.iter().map(|(_, field, _)| field.clone()).collect();
        wishes.extend(
            kernels.plan.directions.values().flat_map(|field| [format!("cos_{field}"), format!("sin_{field}")]),
        );
        wishes.extend(kernels.plan.values.iter().map(|(_, field, _)| field.clone()));
        wishes.extend(kernels.plan.externals.iter().map(|(_, field, _)| field.clone()));
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

        self.branches(&sides);

        let pose_argument = self.arguments.pose.clone();
        let members = chords.iter().zip(&sides).filter_map(|(chord, (side, _))| {
            let (_, field, _) = kernels.plan.determinants.iter().find(|(block, ..)| *block == chord.block)?;
            let (field, minus) = (ident(field), chord.is_opposite.then(|| quote!(-)));
            Some(quote!(#side: side_of(#minus #pose_argument.#field)))
        });
        let members = quote!(#branch_type { #(#members),* });
        let body = if sides.is_empty() {
            Body::plain(members, [], [])
        } else {
            Body::plain(members, [&pose_argument], ["side_of"])
        };
        let docs = lines(["The branch that a position belongs to."]);
        let pose_argument = argument_of(&pose_argument, Some(&body));
        let signature = quote!(#[must_use] pub fn branch_of(&self, #pose_argument: &#pose<T>) -> #branch_type);
        self.function(&docs, &signature, Some(body));
        self.branches = Some(sides);
    }
}

impl Methods<'_> {
    /// All positions at some inputs.
    fn branches(&mut self, sides: &[(Ident, Choice)]) {
        if sides.len() > types::MOST_BRANCHING {
            return;
        }
        let (pose, inputs, branch_type) = (&self.types.pose, &self.types.inputs, &self.types.branch);
        let (v, branch) = (&self.arguments.inputs, &self.arguments.branch);
        let docs = lines([
            "Every position that exists at these inputs, each with its branch.",
            "",
            "# Errors",
            "`NotFinite` if a number is not finite; a branch that cannot be assembled is left out.",
        ]);
        let signature = quote!(pub fn branches(&self, #v: impl Into<#inputs<T>>)
            -> impl Iterator<Item = Result<(#branch_type, #pose<T>), Error>> + '_);
        let tokens = quote!(
            let #v = #v.into();
            existing(#branch_type::all(), move |#branch| self.assemble(#v, #branch))
        );
        self.function(&docs, &signature, Some(Body::plain(tokens, [v], ["existing"])));
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
