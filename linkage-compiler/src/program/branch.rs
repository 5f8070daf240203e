//! The branch of a position: the solution of each group that has two, and the turns of angles.

use std::collections::BTreeSet;

use super::names::Taken;
use super::pose::PosePlan;
use crate::derivation::{Assembly, Choice, Chord, Derivation, Step};
use crate::graph::{Graph, SymbolId};
use crate::ids::UnknownId;
use crate::model::{Driver, Kind, Mechanism};
use crate::structure::Group;

/// The properties of the position problem that signatures and types depend on.
#[derive(Debug, Clone, Default)]
pub struct Position {
    /// True if every group has a closed form.
    pub is_closed: bool,
    /// The groups that have two solutions.
    pub sides: Vec<(String, Choice)>,
    /// The solved angles that a pose stores as numbers; empty unless every group has a closed form.
    pub turns: Vec<AngleTurn>,
    /// The number of groups.
    pub blocks: usize,
}

/// The turn of a solved angle.
#[derive(Debug, Clone)]
pub struct AngleTurn {
    pub symbol: SymbolId,
    /// The field of the turn in the branch, of the angle in the coordinates, and of the angle in the pose.
    pub field: String,
    pub coordinate: String,
    pub number: String,
}

impl Position {
    /// The largest number of groups with two solutions for which `all` and `branches` are emitted: 2^16 branches.
    const MOST_BRANCHING: usize = 16;

    pub fn new(derivation: &Derivation, pose: &PosePlan, assembly: &Assembly, steps: &[Step]) -> Self {
        let group = |chord: &Chord| derivation.blocks[chord.block].branch(derivation);
        let sides: Vec<_> = assembly.chords.iter().map(|chord| (group(chord), chord.choice)).collect();
        let nothing = BTreeSet::new();
        let mut taken = Taken::new(&nothing);
        for (side, _) in &sides {
            taken.unique(side);
        }
        let solved = steps.iter().filter_map(|step| match step {
            Step::Turn { symbol, .. } => Some(*symbol),
            _ => None,
        });
        let solved: BTreeSet<SymbolId> = solved.collect();
        let numbers = pose.values.iter().filter(|(_, _, symbol)| solved.contains(symbol));
        let turns = numbers.map(|(index, number, symbol)| {
            let coordinate = derivation.coordinates[*index].name.clone();
            let field = taken.unique(&format!("{coordinate}_turn"));
            AngleTurn { symbol: *symbol, field, coordinate, number: number.clone() }
        });
        let turns = turns.collect();
        Self { is_closed: assembly.guesses.is_empty(), sides, turns, blocks: derivation.blocks.len() }
    }

    /// A guess for a mechanism with mistakes. If the order of solution is known, the groups are those of the equations
    /// as written; else each pair of unknowns, in the order of declaration, is a group with two solutions.
    pub fn guessed(mechanism: &Mechanism, driver: &Driver) -> Self {
        let name = |place: UnknownId| mechanism.coordinates[driver.unknowns[place]].name.field.as_str();
        if driver.blocks.is_empty() {
            let are_angles = |group: &[UnknownId]| {
                group.iter().all(|&place| mechanism.coordinates[driver.unknowns[place]].kind != Kind::Length)
            };
            let places: Vec<UnknownId> = driver.unknowns.ids().collect();
            let sides = places.chunks_exact(2).map(|group| {
                let choice = if are_angles(group) { Choice::Elbow } else { Choice::Slider };
                ([name(group[0]), name(group[1])].join("_"), choice)
            });
            let sides: Vec<_> = sides.collect();
            return Self { is_closed: true, blocks: sides.len(), sides, turns: Vec::new() };
        }
        let mut graph = mechanism.graph.clone();
        let rows = mechanism.rows();
        let (mut sides, mut solved, mut is_closed) = (Vec::new(), BTreeSet::new(), true);
        for block in &driver.blocks {
            let equations = rows.at(&block.equations);
            let symbols = block.unknowns.iter().map(|&place| mechanism.coordinates[driver.unknowns[place]].symbol);
            let symbols: Vec<SymbolId> = symbols.collect();
            let group = Group::of(&mut graph, &equations, &symbols);
            let choice = Choice::of(group, block.slide);
            if choice.is_some() {
                let angles = graph.in_directions(&equations);
                solved.extend(symbols.into_iter().filter(|symbol| angles.contains(symbol)));
            }
            is_closed &= !matches!(group, Group::Scalar | Group::Pair | Group::Irreducible(_));
            let mut dyad = block.unknowns.clone();
            dyad.extend(block.slide.map(|slide| slide.length));
            dyad.sort_unstable();
            let names: Vec<&str> = dyad.into_iter().map(name).collect();
            sides.extend(choice.map(|choice| (names.join("_"), choice)));
        }
        let turns = match is_closed {
            true => Self::guessed_turns(mechanism, driver, &mut graph, &sides, &solved),
            false => Vec::new(),
        };
        Self { is_closed, sides, turns, blocks: driver.blocks.len() }
    }

    /// The turns of the solved angles that appear as numbers in formulas of the mechanism or of its scenes.
    fn guessed_turns(
        mechanism: &Mechanism,
        driver: &Driver,
        graph: &mut Graph,
        sides: &[(String, Choice)],
        solved: &BTreeSet<SymbolId>,
    ) -> Vec<AngleTurn> {
        let mut formulas = mechanism.kinematic_formulas();
        let directions = graph.directions(&formulas);
        let symbols: Vec<SymbolId> = mechanism.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
        for scene in mechanism.scenes_of(driver) {
            formulas.extend(scene.values());
            let paths = scene.paths(&mechanism.bodies);
            formulas.extend(symbols.iter().flat_map(|&symbol| graph.partial(&paths, symbol)));
        }
        let needed: BTreeSet<SymbolId> = graph.needed_as_numbers(&formulas).into_iter().collect();
        let nothing = BTreeSet::new();
        let mut taken = Taken::new(&nothing);
        for (side, _) in sides {
            taken.unique(side);
        }
        let order = mechanism.coordinate_order(driver);
        let coordinates = order.into_iter().map(|index| &mechanism.coordinates[index]);
        let turning = coordinates.filter(|coordinate| {
            let symbol = coordinate.symbol;
            solved.contains(&symbol) && (needed.contains(&symbol) || !directions.contains(&symbol))
        });
        let turns = turning.map(|coordinate| {
            let name = coordinate.name.field.clone();
            let field = taken.unique(&format!("{name}_turn"));
            AngleTurn { symbol: coordinate.symbol, field, number: name.clone(), coordinate: name }
        });
        turns.collect()
    }

    pub fn has_few_branches(&self) -> bool {
        self.sides.len() <= Self::MOST_BRANCHING
    }
}
