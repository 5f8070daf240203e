//! The branch of a position: the solution of each group that has two, and the turns of angles.

use std::collections::BTreeSet;

use super::names::Taken;
use super::pose::PosePlan;
use crate::derivation::{Assembly, Chord, Derivation, Joint, Step};
use crate::graph::SymbolId;
use crate::ids::UnknownId;
use crate::model::{Coordinate, Driver, Guess, Kind, Mechanism};
use crate::structure::{Choice, GroupKind};

/// The properties of the position problem that signatures and types depend on.
#[derive(Debug, Clone, Default)]
pub struct Position {
    /// True if every group has a closed form.
    pub is_closed: bool,
    /// The groups that have none, with the reason.
    pub open: Vec<(String, String)>,
    /// The groups that have two solutions.
    pub sides: Vec<Side>,
    /// The groups whose positions are listed by number; empty unless every group has a closed form or such a list.
    pub modes: Vec<Modes>,
    /// The solved angles that a pose stores as numbers.
    pub turns: Vec<AngleTurn>,
    /// The number of groups.
    pub groups: usize,
}

/// The choice between the two solutions of a group.
#[derive(Debug, Clone)]
pub struct Side {
    /// Its field in the branch.
    pub field: String,
    pub choice: Choice,
    /// The two solutions, in words of the drawing.
    pub meaning: String,
}

impl Side {
    /// The choice of a group, by the names of its unknowns.
    fn of_unknowns(field: String, choice: Choice) -> Self {
        let [first, second] = choice.variants().map(str::to_lowercase);
        let meaning = format!("The solution of the group of `{field}`: {first} or {second}.");
        Self { field, choice, meaning }
    }

    fn of(mechanism: &Mechanism, driver: &Driver, derivation: &Derivation, chord: &Chord) -> Self {
        let group = &derivation.groups[chord.group];
        let side = Self::of_unknowns(group.branch(derivation), chord.choice);
        let coordinate = |unknown: UnknownId| &mechanism.coordinates[driver.unknowns[unknown]];
        let name = |unknown: UnknownId| coordinate(unknown).name.text.as_str();
        let meaning = match (chord.choice, &group.joints, group.unknowns.as_slice()) {
            (Choice::Elbow, Some(joints), &[first, second]) => {
                let [first, second] = [first, second].map(name);
                let graph = &derivation.graph;
                let outer = |joint: &Joint, link: &str| match joint {
                    Joint::Point(point) => format!("`{point}`"),
                    Joint::Fixed([x, y]) => format!("`({}, {})`", graph.text(*x), graph.text(*y)),
                    Joint::Unnamed => format!("the far end of the link at `{link}`"),
                };
                let middle = match &joints.middle {
                    Joint::Point(point) => format!("`{point}`"),
                    _ => format!("The joint of `{first}` and `{second}`"),
                };
                let [from, to] = [(0, first), (1, second)].map(|(index, link)| outer(&joints.outer[index], link));
                format!("{middle} is left or right of the line from {from} to {to}.")
            }
            (Choice::Slider, _, unknowns) => {
                let is_length = |&unknown: &UnknownId| coordinate(unknown).kind != Kind::Angle;
                let lengths = unknowns.iter().copied().filter(is_length);
                match group.slide.map(|slide| slide.length).into_iter().chain(lengths).next() {
                    Some(length) => {
                        format!("Far is the larger, near the smaller of the two solutions for `{}`.", name(length))
                    }
                    None => return side,
                }
            }
            (Choice::Slope, _, &[angle]) => {
                format!("The left side of its equation minus the right is rising or falling with `{}`.", name(angle))
            }
            _ => return side,
        };
        Self { meaning, ..side }
    }
}

/// A group whose positions are listed by number.
#[derive(Debug, Clone)]
pub struct Modes {
    /// Its field in the branch.
    pub field: String,
    /// The names of its unknowns.
    pub unknowns: String,
    /// The number of its loops, of its unknowns, and the largest number of positions.
    pub loops: usize,
    pub count: usize,
    pub most: usize,
}

impl Modes {
    /// The group of these unknowns, if its positions are listed.
    fn of(group: GroupKind, names: &[&str]) -> Option<Self> {
        let (most, count) = (group.most_modes()?, names.len());
        Some(Self { field: names.join("_"), unknowns: names.join(", "), loops: count / 2, count, most })
    }
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

/// The names of the fields of sides.
fn fields_of(sides: &[Side]) -> Taken<'static> {
    let mut taken = Taken::unreserved();
    for side in sides {
        taken.unique(&side.field);
    }
    taken
}

impl Position {
    /// The largest number of branches that `branches` assembles: at a microsecond each, it takes a tenth of a second. For
    /// more it is a stub with this reason.
    pub const MOST_BRANCHES: usize = 1 << 16;

    /// The turns that the branch has: without a closed form they come from the guess, or are those of the listed position.
    #[must_use]
    pub fn turns_of_branch(&self) -> &[AngleTurn] {
        if self.is_closed { &self.turns } else { &[] }
    }

    pub fn new(
        (mechanism, driver): (&Mechanism, &Driver),
        derivation: &Derivation,
        pose: &PosePlan,
        assembly: &Assembly,
        steps: &[Step],
    ) -> Self {
        let side = |chord| Side::of(mechanism, driver, derivation, chord);
        let sides: Vec<Side> = assembly.chords.iter().map(side).collect();
        let mut taken = fields_of(&sides);
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
        let groups = derivation.groups.iter();
        let open = groups.filter_map(|group| Some((group.names(derivation), group.kind.obstacle()?)));
        let open: Vec<_> = open.collect();
        let modes = derivation.groups.iter().filter(|_| open.is_empty()).filter_map(|group| {
            let unknowns = group.names(derivation);
            Modes::of(group.kind, &unknowns.split(", ").collect::<Vec<_>>())
        });
        let modes = modes.collect();
        Self { is_closed: assembly.guesses.is_empty(), open, sides, modes, turns, groups: derivation.groups.len() }
    }

    /// The position of a mechanism with mistakes, by its guessed solution.
    pub fn guessed(mechanism: &Mechanism, driver: &Driver) -> Self {
        let Guess { groups, turns } = Guess::of(mechanism, driver);
        let names = |unknowns: &[UnknownId]| -> Vec<&str> {
            unknowns
                .iter()
                .map(|&unknown| mechanism.coordinates[driver.unknowns[unknown]].name.field.as_str())
                .collect()
        };
        let open = groups.iter().filter_map(|group| Some((names(&group.unknowns).join(", "), group.kind.obstacle()?)));
        let open: Vec<_> = open.collect();
        let listed = groups.iter().filter(|_| open.is_empty());
        let modes = listed.filter_map(|group| Modes::of(group.kind, &names(&group.unknowns))).collect();
        let sides = groups.iter().filter_map(|group| {
            let choice = group.choice?;
            Some(Side::of_unknowns(names(&group.dyad).join("_"), choice))
        });
        let sides: Vec<Side> = sides.collect();
        let mut taken = fields_of(&sides);
        let turns = turns.into_iter().map(|id| {
            let Coordinate { name, symbol, .. } = &mechanism.coordinates[id];
            let field = taken.unique(&format!("{}_turn", name.field));
            AngleTurn { symbol: *symbol, field, number: name.field.clone(), coordinate: name.field.clone() }
        });
        let turns = turns.collect();
        let is_closed = groups.iter().all(|group| group.kind.is_closed());
        Self { is_closed, open, sides, modes, turns, groups: groups.len() }
    }

    /// A sentence for each group without a closed form.
    pub fn obstacles(&self) -> Vec<String> {
        let sentence = |(names, obstacle): &(String, String)| {
            format!("The group of `{}` has no closed form: {obstacle}.", names.replace(", ", "`, `"))
        };
        self.open.iter().map(sentence).collect()
    }

    pub fn has_few_branches(&self) -> bool {
        self.count_branches().is_some_and(|count| count <= Self::MOST_BRANCHES)
    }

    /// True if all branches can be counted by a `u32`.
    pub fn has_counted_branches(&self) -> bool {
        self.count_branches().is_some_and(|count| u32::try_from(count).is_ok())
    }

    /// The number of branches: of all choices between two solutions, and of all numbers of positions.
    pub fn count_branches(&self) -> Option<usize> {
        let sides = 1_usize.checked_shl(u32::try_from(self.sides.len()).ok()?)?;
        self.modes.iter().try_fold(sides, |count, group| count.checked_mul(group.most))
    }

    /// True if all positions can be listed, but not all in closed form.
    pub fn is_listed(&self) -> bool {
        !self.modes.is_empty()
    }
}
