//! Which of its positions a mechanism stands in: the sides of its groups, and the turns of its angles.

use std::collections::BTreeSet;

use proc_macro2::Ident;
use quote::quote;

use super::super::names::{Taken, ident};
use super::super::tokens::Tokens;
use super::super::types;
use super::{Body, Kernels, Methods, argument_of, lines};
use crate::derivation::{Assembly, Choice, Chord};
use crate::graph::SymbolId;
use crate::lower::Stage;

/// The members of a branch.
pub(in crate::emit) struct Branches {
    /// The groups that have two solutions.
    pub(in crate::emit) sides: Vec<(Ident, Choice)>,
    /// The solved angles that a pose holds as numbers.
    pub(in crate::emit) turns: Vec<AngleTurn>,
}

/// The turn of a solved angle.
pub(in crate::emit) struct AngleTurn {
    pub(in crate::emit) symbol: SymbolId,
    /// The fields of the turn in the branch, of the angle in the coordinates, and of its number in the pose.
    pub(in crate::emit) field: Ident,
    pub(in crate::emit) coordinate: Ident,
    number: Ident,
}

impl Branches {
    pub(super) fn new(kernels: &Kernels, assembly: &Assembly, stages: &[Stage]) -> Self {
        let derivation = &*kernels.derivation;
        let group = |chord: &Chord| derivation.blocks[chord.block].branch(derivation);
        let sides: Vec<(Ident, Choice)> =
            assembly.chords.iter().map(|chord| (ident(&group(chord)), chord.choice)).collect();
        let mut taken = Taken::default();
        for (side, _) in &sides {
            taken.unique(&side.to_string());
        }
        let solved = stages.iter().filter_map(|stage| match stage {
            Stage::Turn { symbol, .. } => Some(*symbol),
            _ => None,
        });
        let solved: Vec<SymbolId> = solved.collect();
        let numbers = kernels.plan.values.iter().filter(|(_, _, symbol)| solved.contains(symbol));
        let turns = numbers.map(|(index, number, symbol)| {
            let coordinate = &derivation.coordinates[*index].name;
            let field = ident(&taken.unique(&format!("{coordinate}_turn")));
            AngleTurn { symbol: *symbol, field, coordinate: ident(coordinate), number: ident(number) }
        });
        let turns = turns.collect();
        Self { sides, turns }
    }
}

impl Methods<'_> {
    pub(super) fn branch_of(&mut self, kernels: &Kernels, chords: &[Chord], branches: &Branches) {
        let (pose, inputs, branch_type) = (&self.types.pose, &self.types.inputs, &self.types.branch);
        let (argument, branch) = (self.arguments.pose.clone(), &self.arguments.branch);
        let Branches { sides, turns } = branches;
        // Newton's method starts from a guess, which says the turns as well.
        let turns: &[AngleTurn] = if self.is_assembled { turns } else { &[] };
        let members = chords.iter().zip(sides).filter_map(|(chord, (side, _))| {
            let (_, field, _) = kernels.plan.determinants.iter().find(|(block, ..)| *block == chord.block)?;
            let (field, minus) = (ident(field), chord.is_opposite.then(|| quote!(-)));
            Some(quote!(#side: side_of(#minus #argument.#field)))
        });
        let fields: Vec<&Ident> = turns.iter().map(|turn| &turn.field).collect();
        let members = quote!(#branch_type { #(#members,)* #(#fields: 0),* });
        let is_turned = !turns.is_empty();
        let mut uses = BTreeSet::new();
        uses.extend((!sides.is_empty()).then_some("side_of"));
        uses.extend(is_turned.then_some("NearestTurns"));
        let body = if is_turned {
            let given = kernels.plan.values.iter().filter(|(index, ..)| kernels.derivation.inputs.contains(index));
            let given = given.map(|(index, field, _)| {
                let (input, field) = (ident(&kernels.derivation.coordinates[*index].name), ident(field));
                quote!(#input: #argument.#field)
            });
            let (numbers, turn) = (turns.iter().map(|turn| &turn.number), &self.arguments.turn);
            quote!(
                let #branch = #members;
                let #turn = NearestTurns::new([#(#argument.#numbers),*]);
                // Where nothing can be assembled, the turns are those of the numbers alone.
                let _ = self.assemble_in_turns(#inputs { #(#given),* }, #branch, &#turn);
                let [#(#fields),*] = #turn.turns();
                #branch_type { #(#fields,)* ..#branch }
            )
        } else {
            members
        };
        let mut body = Body::plain(body, [], []);
        if !sides.is_empty() || is_turned {
            body.arguments.push(argument.clone());
        }
        body.uses = uses;
        let docs = if is_turned {
            lines([
                "The branch that a position belongs to, by the signs of determinants, and by assembling it for the turns:",
                "`assemble` on the branch gives the numbers of the angles back. Nothing is refused: of a determinant that is",
                "not a number the sign tells as well, and the turn of such an angle is 0.",
            ])
        } else {
            lines([
                "The branch that a position belongs to, by the signs of determinants; nothing is refused: of one that is not a",
                "number the sign tells as well.",
            ])
        };
        let argument = argument_of(&argument, Some(&body));
        let signature =
            self.words.total("branch_of", [self.words.borrowed(&argument, pose)], Tokens::name(branch_type));
        self.function(&docs, signature, Some(body));
    }

    /// All positions at some inputs.
    pub(super) fn branches(&mut self, sides: &[(Ident, Choice)]) {
        if sides.len() > types::MOST_BRANCHING {
            return;
        }
        let (pose, inputs, branch_type) = (&self.types.pose, &self.types.inputs, &self.types.branch);
        let (v, branch) = (&self.arguments.inputs, &self.arguments.branch);
        let docs = lines([
            "Every position that exists at these inputs, each with its branch.",
            "",
            "# Errors",
            "`NotFinite` if a number is not finite; a branch that cannot be assembled is left out, and one on which a group",
            "is undetermined.",
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
