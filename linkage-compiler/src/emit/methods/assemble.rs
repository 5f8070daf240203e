//! Position group by group.

use std::borrow::Cow;

use proc_macro2::Ident;
use quote::quote;

use super::super::kernel;
use super::super::kernel::{Given, Shape, Source};
use super::super::tokens::Tokens;
use super::super::{names::ident, types};
use super::{Body, Kernels, Methods, argument_of, bind, check_finite, lines, pose_members};
use crate::derivation::{Choice, Chord};
use crate::graph::{Function, NodeId, SymbolId};
use crate::simplify::schedule::Stage;

impl Methods<'_> {
    pub(super) fn assemble(&mut self, kernels: Option<&mut Kernels>) {
        let Some(kernels) = kernels else { return };
        let assembly = kernels.derivation.assembly();
        let (pose, inputs, branch_type) = (&self.types.pose, &self.types.inputs, &self.types.branch);
        let (v, branch) = (self.arguments.inputs.clone(), self.arguments.branch.clone());
        let sides: Vec<_> = assembly
            .chords
            .iter()
            .map(|chord| (ident(&kernels.derivation.blocks[chord.block].branch(kernels.derivation)), chord.choice))
            .collect();
        let chords = assembly.chords.clone();
        let guess = self.arguments.guess.clone();
        let is_iterated = |block: usize| {
            assembly.stages.iter().any(|stage| matches!(stage, Stage::Newton { block: other, .. } if *other == block))
        };
        let iterated: Vec<bool> = (0..kernels.derivation.blocks.len()).map(is_iterated).collect();

        let determinants: Vec<NodeId> =
            kernels.plan.determinants.iter().map(|(block, _, _)| assembly.determinants[block]).collect();
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
        let mut stages = assembly.stages.clone();
        let results = determinants.iter().chain(&circular).chain(&bare).chain(&externals);
        stages.push(Stage::Return(results.copied().collect()));
        let stages = needed(&kernels.derivation.graph, stages);
        let position = if assembly.guesses.is_empty() {
            self.inputs(kernels, &v, |c| c.value)
        } else {
            self.guess(kernels, &guess, &assembly.guesses)
        };
        let sources = vec![self.parameters(), position];
        let given = Given { sources, pose: None, branch: &self.arguments.branch };
        let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.scope);
        let mut wishes: Vec<String> = kernels.plan.determinants.iter().map(|(_, field, _)| field.clone()).collect();
        wishes.extend(
            kernels.plan.directions.values().flat_map(|field| [format!("cos_{field}"), format!("sin_{field}")]),
        );
        wishes.extend(kernels.plan.values.iter().map(|(_, field, _)| field.clone()));
        wishes.extend(kernels.plan.externals.iter().map(|(_, field, _)| field.clone()));
        let (bindings, bound) = bind(&code.results, &wishes, &mut code.taken);
        let unproven = bound.iter().zip(&code.proven).filter(|(_, proven)| !**proven).map(|(value, _)| value.clone());
        let unproven: Vec<_> = unproven.collect();
        let finite = check_finite(&mut code, "the position", &unproven);
        let fields = pose_members(kernels.plan, bound.iter());
        if !circular.is_empty() {
            code.uses.insert("unit");
        }
        if !sides.is_empty() {
            code.arguments.push(branch.clone());
        }
        let body = Some(Body::new(code, quote!(#bindings #finite Ok(#pose { #fields })), []));
        let branch = argument_of(&branch, body.as_ref());
        if assembly.guesses.is_empty() {
            let docs = lines([
                "The position at these inputs in closed form: group by group, on the branch that is asked for.",
                "",
                "# Errors",
                "`Unbuildable` if a group does not reach, `NotFinite` if a number is not finite.",
            ]);
            let arguments = [
                self.words.converted(&argument_of(&v, body.as_ref()), inputs),
                Tokens::from(quote!(#branch: #branch_type)),
            ];
            let signature = self.words.fallible("assemble", arguments, self.words.of(pose));
            self.function(&docs, signature, body);
            self.branches(&sides);
            self.is_assembled = true;
        } else {
            let iterated = kernels.derivation.blocks.iter().zip(iterated).filter(|(_, iterated)| *iterated);
            let iterated: Vec<_> = iterated.map(|(block, _)| block.names(kernels.derivation)).collect();
            let docs = lines([
                "The position at the inputs of a guess: group by group, in closed form on the branch that is asked for,",
                &format!("but {} by Newton's method from the guess.", iterated.join(", then ")),
                "",
                "# Errors",
                "`Unbuildable` if a group does not reach, `NotConverged` if Newton's method finds no position,",
                "`OtherBranch` if it finds one beyond a dead point, `NotFinite` if a number is not finite.",
            ]);
            let coordinates = &self.types.coordinates;
            let signature = quote!(pub fn assemble_near(&self, #guess: &#coordinates<T>, #branch: #branch_type)
                -> Result<#pose<T>, Error>);
            self.function(&docs, signature, body);
        }
        self.branch_of(kernels, &chords, &sides);
        self.branches = Some(sides);
    }

    fn branch_of(&mut self, kernels: &Kernels, chords: &[Chord], sides: &[(Ident, Choice)]) {
        let (pose, branch_type) = (&self.types.pose, &self.types.branch);
        let argument = self.arguments.pose.clone();
        let members = chords.iter().zip(sides).filter_map(|(chord, (side, _))| {
            let (_, field, _) = kernels.plan.determinants.iter().find(|(block, ..)| *block == chord.block)?;
            let (field, minus) = (ident(field), chord.is_opposite.then(|| quote!(-)));
            Some(quote!(#side: side_of(#minus #argument.#field)))
        });
        let members = quote!(#branch_type { #(#members),* });
        let body = if sides.is_empty() {
            Body::plain(members, [], [])
        } else {
            Body::plain(members, [&argument], ["side_of"])
        };
        let docs = lines(["The branch that a position belongs to."]);
        let argument = argument_of(&argument, Some(&body));
        let signature =
            self.words.total("branch_of", [self.words.borrowed(&argument, pose)], Tokens::name(branch_type));
        self.function(&docs, signature, Some(body));
    }
}

impl Methods<'_> {
    /// The inputs of a guess, and the unknowns that have no closed form under names of their own.
    fn guess<'k>(&self, kernels: &'k Kernels, guess: &Ident, guesses: &[(usize, SymbolId)]) -> Source<'k> {
        let coordinates = &kernels.derivation.coordinates;
        let inputs = kernels.derivation.inputs.iter().map(|&index| (index, coordinates[index].value));
        let fields = inputs.chain(guesses.iter().copied());
        let mut fields: Vec<_> = fields.map(|(index, symbol)| (Cow::from(&coordinates[index].name), symbol)).collect();
        // The others are fields as well, so that the pattern is complete only if it names them all.
        let named = fields.len();
        fields.extend((named..coordinates.len()).map(|_| (Cow::from(""), SymbolId::NONE)));
        let of = &self.types.coordinates;
        Source {
            argument: Some(guess.clone()),
            from: Tokens::behind(guess),
            of: Shape::Fields(Tokens::name(of)),
            fields,
        }
    }

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
        self.function(&docs, signature, Some(Body::plain(tokens, [v], ["existing"])));
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
