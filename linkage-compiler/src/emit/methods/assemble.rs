//! Position group by group.

use std::borrow::Cow;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::kernel;
use super::super::kernel::{Code, Given, Shape, Source};
use super::super::tokens::Tokens;
use super::branch::Branches;
use super::{Arguments, Body, Kernels, Methods, argument_of, bind, check_finite, lines, pose_members};
use crate::derivation::Assembly;
use crate::graph::{Function, NodeId, SymbolId};
use crate::lower::Stage;

impl Methods<'_> {
    pub(super) fn assemble(&mut self, kernels: Option<&mut Kernels>) {
        let Some(kernels) = kernels else { return };
        let assembly = kernels.derivation.assembly();
        let (stages, results) = position_stages(kernels, &assembly);
        let branches = Branches::new(kernels, &assembly, &stages);
        let (pose, inputs, branch_type) = (&self.types.pose, &self.types.inputs, &self.types.branch);
        let Arguments { inputs: v, branch, turn, guess, .. } = self.arguments.clone();
        let position = if !assembly.guesses.is_empty() {
            self.guess(kernels, &guess, &assembly.guesses)
        } else if branches.turns.is_empty() {
            self.inputs(kernels, &v, |c| c.value)
        } else {
            // Converted before.
            Source { from: Tokens::name(&v), ..self.inputs(kernels, &v, |c| c.value) }
        };
        let given = Given {
            sources: vec![self.parameters(), position],
            pose: None,
            branch: &self.arguments.branch,
            turn: &self.arguments.turn,
            turns: branches.turns.iter().enumerate().map(|(place, turn)| (turn.symbol, place)).collect(),
            dyads: dyads(kernels, &assembly, results),
        };
        let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.scope);
        let (bindings, finite, fields) = checked_pose(kernels, &given, &mut code);
        if !branches.sides.is_empty() {
            code.arguments.push(branch.clone());
        }
        let mut body = Body::new(code, quote!(#bindings #finite Ok(#pose { #fields })), []);
        let used_branch = argument_of(&branch, Some(&body));
        if !assembly.guesses.is_empty() {
            let docs = near_docs(kernels, &stages);
            let signature = self.near_signature(&used_branch);
            if !branches.turns.is_empty() {
                let near = branches.turns.iter().map(|turn| &turn.coordinate);
                let near = quote!([#(#guess.#near),*]);
                let kernel = body.tokens;
                body.tokens =
                    quote!(countable(Self::NAME, #near)?; let #turn = NearestTurns::new(#near); #kernel).into();
                body.uses.extend(["countable", "NearestTurns", "Turn"]);
            }
            self.function(&docs, signature, Some(body));
        } else if branches.turns.is_empty() {
            let arguments = [
                self.words.converted(&argument_of(&v, Some(&body)), inputs),
                Tokens::from(quote!(#used_branch: #branch_type)),
            ];
            let signature = self.words.fallible("assemble", arguments, self.words.of(pose));
            self.function(&lines(ASSEMBLE), signature, Some(body));
        } else {
            let docs = lines(["The position at these inputs on this branch, with angles in the turns that are given."]);
            let v = argument_of(&v, Some(&body));
            let signature = quote!(#[inline] fn assemble_in_turns(
                &self, #v: #inputs<T>, #used_branch: #branch_type, #turn: &impl Turn<T>,
            ) -> Result<#pose<T>, Error>);
            body.uses.insert("Turn");
            self.function(&docs, signature, Some(body));
            // People know its work by the name of the function that calls it.
            if let Some((name, _)) = self.kernels.last_mut() {
                "assemble".clone_into(name);
            }
            self.assemble_by_turns(&branches);
        }
        if assembly.guesses.is_empty() {
            self.branches(&branches.sides);
            self.is_assembled = true;
        }
        self.branch_of(kernels, &assembly.chords, &branches);
        self.branches = Some(branches);
    }

    /// `assemble` and `assemble_near` of a mechanism with angles whose number matters.
    fn assemble_by_turns(&mut self, branches: &Branches) {
        let (pose, inputs, branch_type) = (&self.types.pose, &self.types.inputs, &self.types.branch);
        let Arguments { inputs: v, branch, guess, .. } = self.arguments.clone();
        let fields = branches.turns.iter().map(|turn| &turn.field);
        let body = quote!(self.assemble_in_turns(#v.into(), #branch, &Turns([#(#branch.#fields),*])));
        let signature = quote!(pub fn assemble(&self, #v: impl Into<#inputs<T>>, #branch: #branch_type)
            -> Result<#pose<T>, Error>);
        let body = Body::plain(body, [&v, &branch], ["Turns"]);
        self.function(&lines(ASSEMBLE), signature, Some(body));

        let names: Vec<_> = branches.turns.iter().map(|turn| format!("`{}`", turn.coordinate)).collect();
        let docs = lines([
            "The position at the inputs of a guess in closed form, on the branch that is asked for, but in the turns of",
            &format!("{} that are nearest to the guess.", names.join(", ")),
            "",
            "# Errors",
            "Those of `assemble`, and `OutOfRange` if a guess is more turns away than a branch can count.",
        ]);
        let near = branches.turns.iter().map(|turn| &turn.coordinate);
        let near = quote!([#(#guess.#near),*]);
        let body = quote!(
            countable(Self::NAME, #near)?;
            self.assemble_in_turns(#inputs::from(#guess), #branch, &NearestTurns::new(#near))
        );
        let signature = self.near_signature(&branch);
        let body = Body::plain(body, [&guess, &branch], ["countable", "NearestTurns"]);
        self.function(&docs, signature, Some(body));
    }

    fn near_signature(&self, branch: &Ident) -> TokenStream {
        let (guess, coordinates) = (&self.arguments.guess, &self.types.coordinates);
        let (pose, branch_type) = (&self.types.pose, &self.types.branch);
        quote!(pub fn assemble_near(&self, #guess: &#coordinates<T>, #branch: #branch_type) -> Result<#pose<T>, Error>)
    }

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
}

const ASSEMBLE: [&str; 5] = [
    "The position at these inputs in closed form: group by group, on the branch that is asked for.",
    "",
    "# Errors",
    "`Unbuildable` if a group does not reach, `Undetermined` if it can stand anywhere, as between joints that",
    "coincide, `NotFinite` if a number is not finite.",
];

fn near_docs(kernels: &Kernels, stages: &[Stage]) -> Vec<String> {
    let is_iterated = |block: usize| {
        stages.iter().any(|stage| matches!(stage, Stage::Newton { block: other, .. } if *other == block))
    };
    let blocks = kernels.derivation.blocks.iter().enumerate().filter(|(number, _)| is_iterated(*number));
    let iterated: Vec<_> = blocks.map(|(_, block)| block.names(kernels.derivation)).collect();
    lines([
        "The position at the inputs of a guess: group by group, in closed form on the branch that is asked for,",
        &format!("but {} by Newton's method from the guess.", iterated.join(", then ")),
        "",
        "# Errors",
        "`Unbuildable` if a group does not reach, `Undetermined` if it can stand anywhere, `NotConverged` if",
        "Newton's method finds no position, `OtherBranch` if it finds one beyond a dead point, `NotFinite` if a",
        "number is not finite.",
    ])
}

/// The stages of a position, and the expressions of the functions of the user that it holds: a pose holds, in this
/// order, determinants, cosines and sines, numbers, and values of functions.
fn position_stages(kernels: &mut Kernels, assembly: &Assembly) -> (Vec<Stage>, usize) {
    let determinants: Vec<NodeId> =
        kernels.plan.determinants.iter().map(|(block, _, _)| assembly.determinants[block]).collect();
    let angles: Vec<NodeId> = kernels.plan.angles().collect();
    let graph = &mut kernels.derivation.graph;
    let circular: Vec<NodeId> = angles
        .into_iter()
        .flat_map(|angle| [Function::Cos, Function::Sin].map(|function| graph.call(function, &[angle])))
        .collect();
    let circular = assembly.solved(graph, &circular);
    let numbers: Vec<SymbolId> = kernels.plan.values.iter().map(|(_, _, symbol)| *symbol).collect();
    let numbers = kernels.variables(&numbers);
    let externals: Vec<NodeId> = kernels.plan.externals.iter().map(|(node, ..)| *node).collect();
    let externals = assembly.solved(&mut kernels.derivation.graph, &externals);
    let mut stages = assembly.stages.clone();
    let results = determinants.iter().chain(&circular).chain(&numbers).chain(&externals);
    stages.push(Stage::Return(results.copied().collect()));
    (needed(&kernels.derivation.graph, stages), externals.len())
}

/// The dyad that each result of a position is solved by, if one is.
fn dyads(kernels: &Kernels, assembly: &Assembly, externals: usize) -> Vec<Option<usize>> {
    let dyad_of = |symbol: Option<SymbolId>| symbol.and_then(|symbol| assembly.of_dyads.get(&symbol).copied());
    let graph = &kernels.derivation.graph;
    let mut dyads = vec![None; kernels.plan.determinants.len()];
    dyads.extend(kernels.plan.angles().flat_map(|angle| [dyad_of(graph.as_symbol(angle)); 2]));
    dyads.extend(kernels.plan.values.iter().map(|(_, _, symbol)| dyad_of(Some(*symbol))));
    dyads.extend((0..externals).map(|_| None));
    dyads
}

/// The names of the results of a position, what refuses those that are not finite, and the members of the pose.
fn checked_pose(kernels: &Kernels, given: &Given, code: &mut Code) -> (TokenStream, TokenStream, TokenStream) {
    let plan = kernels.plan;
    let mut wishes: Vec<String> = plan.determinants.iter().map(|(_, field, _)| field.clone()).collect();
    wishes.extend(plan.directions.values().flat_map(|field| [format!("cos_{field}"), format!("sin_{field}")]));
    wishes.extend(plan.values.iter().map(|(_, field, _)| field.clone()));
    wishes.extend(plan.externals.iter().map(|(_, field, _)| field.clone()));
    let (bindings, bound) = bind(&code.results, &wishes, &mut code.taken);
    let unproven = bound.iter().zip(&given.dyads).zip(&code.proven).filter(|(_, proven)| !**proven);
    let (of_dyads, others): (Vec<_>, Vec<_>) =
        unproven.map(|((value, dyad), _)| (value.clone(), *dyad)).partition(|(_, dyad)| dyad.is_some());
    let [of_dyads, others] =
        [of_dyads, others].map(|values| values.into_iter().map(|(value, _)| value).collect::<Vec<_>>());
    let finite = check_finite(code, "the position", &others);
    let of_dyads = check_finite(code, "the position", &of_dyads);
    let plain: Vec<_> = code.plain.values().collect();
    let finite = match plain.as_slice() {
        [] => finite,
        [only] => quote!(#finite if !#only { #of_dyads }),
        several => quote!(#finite if !(#(#several)&&*) { #of_dyads }),
    };
    let fields = pose_members(plan, bound.iter());
    if !plan.directions.is_empty() {
        code.uses.insert("unit");
    }
    (bindings, finite, fields)
}

/// The stages without the names that nothing refers to; verdicts stay.
fn needed(graph: &crate::graph::Graph, stages: Vec<Stage>) -> Vec<Stage> {
    let mut used = std::collections::BTreeSet::new();
    let mut kept = Vec::new();
    for stage in stages.into_iter().rev() {
        if !matches!(&stage, Stage::Let { symbol, .. } | Stage::Turn { symbol, .. } if !used.contains(symbol)) {
            used.extend(graph.symbols_of(&stage.nodes()));
            kept.push(stage);
        }
    }
    kept.reverse();
    kept
}
