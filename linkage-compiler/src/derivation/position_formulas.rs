//! The closed form of each group as formulas for documentation: what the steps of its position name, one after the other.
//!
//! The steps keep a cosine and a sine of each solved angle under names of their own; here they are cos θ and sin θ again. The
//! other names are letters: Δ for the vector between the outer joints of a dyad, δ for Δ / 2Δ², κ for the root whose sign is the
//! branch, λ for the distance of a guide, x and y with the name of an angle for the vector of its link.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::assembly::Assembly;
use super::data::Derivation;
use super::step::Step;
use crate::graph::{Function, NodeId, SymbolId};
use crate::ids::{GroupId, Id, Table};
use crate::structure::Choice;

/// The closed form of a group.
#[derive(Debug, Clone, Default)]
pub struct ClosedForm {
    /// The equations, left and right: each in terms of those before it.
    pub equations: Vec<[NodeId; 2]>,
    /// The root whose sign tells two solutions apart, and their names.
    pub root: Option<(NodeId, Choice)>,
}

/// The beginning of the name of a squared distance.
const SQUARE: &str = "distance_squared_";

/// The letters for what a group computes on the way: the first that the mechanism leaves free, else the word.
const LETTERS: [(&str, [&str; 3]); 5] = [
    ("line_", ["Delta", "rho", "distance"]),
    (SQUARE, ["Delta", "rho", "distance"]),
    ("divided_line_", ["delta", "tau", "divided"]),
    ("offset_", ["lambda", "sigma", "offset"]),
    ("chord_", ["kappa", "chi", "chord"]),
];

impl Derivation {
    /// The closed form of each group; without equations where Newton's method finds the position.
    pub fn closed_forms(&mut self, assembly: &Assembly) -> Table<GroupId, ClosedForm> {
        let groups: Vec<GroupId> = self.groups.ids().collect();
        let mut forms: Vec<ClosedForm> = groups.into_iter().map(|id| self.closed_form(id, assembly)).collect();
        let shown = self.shown(assembly);
        let nodes = |form: &ClosedForm| {
            form.equations.iter().flatten().copied().chain(form.root.map(|(root, _)| root)).collect::<Vec<_>>()
        };
        let all: Vec<NodeId> = forms.iter().flat_map(nodes).collect();
        let mut all = self.graph.replace(&all, &shown).into_iter();
        for form in &mut forms {
            let nodes = form.equations.iter_mut().flatten().chain(form.root.as_mut().map(|(root, _)| root));
            nodes.zip(&mut all).for_each(|(node, other)| *node = other);
        }
        forms.into()
    }

    fn closed_form(&mut self, id: GroupId, assembly: &Assembly) -> ClosedForm {
        let mut form = ClosedForm::default();
        for step in assembly.closed.get(&id).into_iter().flat_map(|steps| &assembly.steps[steps.clone()]) {
            match step {
                Step::Let { symbol, node } => form.equations.push([self.graph.variable(*symbol), *node]),
                Step::Chord { symbol, factors: [low, high], .. } => {
                    let root = self.graph.variable(*symbol);
                    let square = self.graph.power(root, 2);
                    form.equations.push([square, self.graph.multiply(*low, *high)]);
                    let chord = assembly.chords.iter().find(|chord| chord.group == id);
                    form.root = chord.map(|chord| (root, chord.choice));
                }
                // The angle of a direction, and checks.
                _ => {}
            }
        }
        form
    }

    /// The nodes that stand for symbols of steps: cosines and sines of the solved angles, and letters.
    fn shown(&mut self, assembly: &Assembly) -> FxHashMap<NodeId, NodeId> {
        let mut shown = FxHashMap::default();
        for (&angle, &named) in &assembly.named_directions {
            let angle = self.graph.variable(angle);
            for (function, name) in [Function::Cos, Function::Sin].into_iter().zip(named) {
                shown.insert(name, self.graph.call(function, &[angle]));
            }
        }
        let known: BTreeSet<SymbolId> = self.graph.symbols_of(&self.residual).into_iter().collect();
        let taken: Vec<String> = known.iter().map(|&symbol| self.graph.symbol_name(symbol).to_owned()).collect();
        let letters = LETTERS.map(|(prefix, letters)| (prefix, free(letters, &taken)));
        let is_alone = self.groups.len() == 1;
        for (&id, steps) in &assembly.closed {
            for symbol in assembly.steps[steps.clone()].iter().flat_map(Step::introduced) {
                let name = self.graph.symbol_name(symbol).to_owned();
                let number = if is_alone { String::new() } else { id.number().to_string() };
                if let Some(letter) = letter(&name, &number, &letters).filter(|_| !known.contains(&symbol)) {
                    let letter = self.graph.symbol(letter);
                    let letter = self.graph.variable(letter);
                    let symbol = self.graph.variable(symbol);
                    if name.starts_with(SQUARE) {
                        let root = self.graph.call(Function::Sqrt, &[symbol]);
                        shown.extend([(root, letter), (symbol, self.graph.power(letter, 2))]);
                    } else {
                        shown.insert(symbol, letter);
                    }
                }
            }
        }
        shown
    }
}

/// The letter for the symbol of a step in the group with this number, if it has one.
fn letter(name: &str, number: &str, letters: &[(&str, &str)]) -> Option<String> {
    let as_letter = |(prefix, letter): &(&str, &str)| {
        let axis = name.strip_prefix(prefix)?.trim_start_matches(|letter: char| letter.is_ascii_digit());
        Some(format!("{letter}{number}{axis}"))
    };
    // `link_theta3_x` is a component of the link.
    let as_component = || {
        let (angle, axis) = name.strip_prefix("link_")?.rsplit_once('_')?;
        Some(format!("{axis}_{angle}"))
    };
    letters.iter().find_map(as_letter).or_else(as_component)
}

/// The first letter with which no name of the mechanism begins, else the last; symbols are in small letters.
fn free(letters: [&'static str; 3], taken: &[String]) -> &'static str {
    let is_free = |letter: &&str| {
        let small = letter.to_lowercase();
        let mut rests = taken.iter().filter_map(|name| name.strip_prefix(&small));
        !rests.any(|rest| rest.is_empty() || rest.starts_with(|next: char| next == '_' || next.is_ascii_digit()))
    };
    letters.into_iter().find(is_free).unwrap_or(letters[2])
}
