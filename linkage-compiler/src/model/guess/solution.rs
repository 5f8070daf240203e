//! The order of solution of a driver, and the fields of its pose, without a derivation.

use std::collections::BTreeSet;

use crate::graph::{Graph, SymbolId};
use crate::ids::{CoordinateId, UnknownId};
use crate::model::kind::Kind;
use crate::model::mechanism::{Driver, Mechanism};
use crate::structure::{Choice, Class, GroupKind};

/// The properties of a solution that types and signatures depend on.
#[derive(Debug, Clone)]
pub struct Guess {
    pub groups: Vec<GuessedGroup>,
    /// The solved angles that a pose stores as numbers, in the order of the coordinates; none unless every group has a
    /// closed form.
    pub turns: Vec<CoordinateId>,
}

/// A group of unknowns.
#[derive(Debug, Clone)]
pub struct GuessedGroup {
    pub unknowns: Vec<UnknownId>,
    /// Its unknowns, and the length of the slider that its angle moves.
    pub dyad: Vec<UnknownId>,
    pub kind: GroupKind,
    pub choice: Option<Choice>,
}

impl Guess {
    /// Guesses the solution of a driver. If the order of solution is known, the groups are those of the equations as
    /// written; else each pair of unknowns, in the order of declaration, is a group with two solutions.
    #[must_use]
    pub fn of(mechanism: &Mechanism, driver: &Driver) -> Self {
        if driver.system.groups.is_empty() {
            let unknowns: Vec<UnknownId> = driver.unknowns.ids().collect();
            let is_length = |&unknown: &UnknownId| mechanism.coordinates[driver.unknowns[unknown]].kind == Kind::Length;
            let groups = unknowns.chunks_exact(2).map(|pair| {
                let kind = if pair.iter().any(is_length) { GroupKind::Rrp } else { GroupKind::Rrr };
                let choice = Choice::of(kind, None);
                GuessedGroup { unknowns: pair.to_vec(), dyad: pair.to_vec(), kind, choice }
            });
            return Self { groups: groups.collect(), turns: Vec::new() };
        }
        let mut graph = mechanism.graph.clone();
        let (mut groups, mut solved) = (Vec::new(), BTreeSet::new());
        for group in &driver.system.groups {
            let equations = driver.system.rows.at(&group.equations);
            let symbol = |&unknown: &UnknownId| mechanism.coordinates[driver.unknowns[unknown]].symbol;
            let symbols: Vec<SymbolId> = group.unknowns.iter().map(symbol).collect();
            let kind = Class::of(&mut graph, &equations, &symbols).kind;
            let choice = Choice::of(kind, group.slide);
            if choice.is_some() {
                let angles = graph.in_directions(&equations);
                solved.extend(symbols.into_iter().filter(|symbol| angles.contains(symbol)));
            }
            let mut dyad = group.unknowns.clone();
            dyad.extend(group.slide.map(|slide| slide.length));
            dyad.sort_unstable();
            groups.push(GuessedGroup { unknowns: group.unknowns.clone(), dyad, kind, choice });
        }
        let turns = match groups.iter().all(|group| group.kind.is_closed()) {
            true => turns(mechanism, driver, &mut graph, &solved),
            false => Vec::new(),
        };
        Self { groups, turns }
    }

    /// The coordinates that a pose has in the order of its fields, and whether it has an angle as a direction and as a
    /// number.
    #[must_use]
    pub fn pose(mechanism: &Mechanism, driver: &Driver) -> Vec<(CoordinateId, bool)> {
        let order = mechanism.coordinate_order(driver).into_iter();
        order.map(|id| (id, mechanism.coordinates[id].kind == Kind::Angle)).collect()
    }

    /// True if a number may stand for the inputs: they may be one.
    #[must_use]
    pub fn may_have_one_input(driver: &Driver) -> bool {
        driver.inputs.len() != 1
    }
}

/// The solved angles that appear as numbers in formulas of the mechanism or of its scenes, or whose ranges count turns.
fn turns(mechanism: &Mechanism, driver: &Driver, graph: &mut Graph, solved: &BTreeSet<SymbolId>) -> Vec<CoordinateId> {
    let mut formulas = mechanism.kinematic_formulas(&driver.system.rows);
    let directions = graph.directions(&formulas);
    let symbols: Vec<SymbolId> = mechanism.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    for (_, scene) in mechanism.scenes_of(driver) {
        formulas.extend(scene.values());
        let paths = scene.paths(&mechanism.bodies);
        formulas.extend(symbols.iter().flat_map(|&symbol| graph.partial(&paths, symbol)));
    }
    let needed = graph.needed_as_numbers(&formulas).into_iter();
    let needed: BTreeSet<SymbolId> = needed.chain(mechanism.counted_by_ranges()).collect();
    let order = mechanism.coordinate_order(driver).into_iter();
    let turning = order.filter(|&id| {
        let symbol = mechanism.coordinates[id].symbol;
        solved.contains(&symbol) && (needed.contains(&symbol) || !directions.contains(&symbol))
    });
    turning.collect()
}
