//! Which of its positions a mechanism stands in: the sides of its groups, and the turns of its angles.

use std::collections::BTreeSet;

use super::names::Taken;
use super::pose::PosePlan;
use crate::derivation::{Assembly, Choice, Chord, Derivation, Step};
use crate::graph::SymbolId;
use crate::model::{Driver, Kind, Mechanism};

/// How a position is found, and what tells positions apart.
#[derive(Debug, Clone)]
pub struct Position {
    /// True if every group has a closed form.
    pub is_closed: bool,
    /// The groups that have two solutions.
    pub sides: Vec<(String, Choice)>,
    /// The solved angles that a pose holds as numbers, where every group has a closed form.
    pub turns: Vec<AngleTurn>,
    /// The number of groups.
    pub blocks: usize,
}

/// The turn of a solved angle.
#[derive(Debug, Clone)]
pub struct AngleTurn {
    pub symbol: SymbolId,
    /// The fields of the turn in the branch, of the angle in the coordinates, and of its number in the pose.
    pub field: String,
    pub coordinate: String,
    pub number: String,
}

impl Position {
    /// Nobody tries all branches of more groups than this.
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

    /// The most likely one of a mechanism with mistakes: groups of two unknowns as they were declared, each with two
    /// solutions.
    pub fn guessed(mechanism: &Mechanism, driver: &Driver) -> Self {
        let side = |group: &[usize]| {
            let coordinates = || group.iter().map(|&index| &mechanism.coordinates[index]);
            let names: Vec<&str> = coordinates().map(|coordinate| coordinate.name.field.as_str()).collect();
            let are_angles = coordinates().all(|coordinate| coordinate.kind == Kind::Angle);
            (names.join("_"), if are_angles { Choice::Elbow } else { Choice::Slider })
        };
        let sides: Vec<_> = driver.unknowns.chunks_exact(2).map(side).collect();
        Self { is_closed: true, blocks: sides.len(), sides, turns: Vec::new() }
    }

    pub fn has_few_branches(&self) -> bool {
        self.sides.len() <= Self::MOST_BRANCHING
    }
}
