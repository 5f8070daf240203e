//! The branch of a position: the solution of each group that has two, and the turns of angles.

use std::collections::BTreeSet;

use super::names::Taken;
use super::pose::PosePlan;
use crate::derivation::{Assembly, Choice, Chord, Derivation, Joint, Step};
use crate::graph::{Graph, SymbolId};
use crate::ids::UnknownId;
use crate::model::{Driver, Kind, Mechanism};
use crate::structure::{Class, Group};

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
    /// The solved angles that a pose stores as numbers; empty unless every group has a closed form.
    pub turns: Vec<AngleTurn>,
    /// The number of groups.
    pub blocks: usize,
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
        let block = &derivation.blocks[chord.block];
        let side = Self::of_unknowns(block.branch(derivation), chord.choice);
        let coordinate = |unknown: UnknownId| &mechanism.coordinates[driver.unknowns[unknown]];
        let name = |unknown: UnknownId| coordinate(unknown).name.text.as_str();
        let meaning = match (chord.choice, &block.joints, block.unknowns.as_slice()) {
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
                let [from, to] = [(0, first), (1, second)].map(|(place, link)| outer(&joints.outer[place], link));
                format!("{middle} is left or right of the line from {from} to {to}.")
            }
            (Choice::Slider, _, unknowns) => {
                let is_length = |&unknown: &UnknownId| coordinate(unknown).kind != Kind::Angle;
                let lengths = unknowns.iter().copied().filter(is_length);
                match block.slide.map(|slide| slide.length).into_iter().chain(lengths).next() {
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
    fn of(group: Group, names: &[&str]) -> Option<Self> {
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

impl Position {
    /// The largest number of branches that `branches` assembles: at a microsecond each, it takes a tenth of a second. For
    /// more it is a stub with this reason.
    pub const MOST_BRANCHES: usize = 1 << 16;

    pub fn new(
        (mechanism, driver): (&Mechanism, &Driver),
        derivation: &Derivation,
        pose: &PosePlan,
        assembly: &Assembly,
        steps: &[Step],
    ) -> Self {
        let side = |chord| Side::of(mechanism, driver, derivation, chord);
        let sides: Vec<Side> = assembly.chords.iter().map(side).collect();
        let mut taken = Taken::unreserved();
        for side in &sides {
            taken.unique(&side.field);
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
        let blocks = derivation.blocks.iter();
        let open = blocks.filter_map(|block| Some((block.names(derivation), block.group.obstacle()?)));
        let open: Vec<_> = open.collect();
        let modes = derivation.blocks.iter().filter(|_| open.is_empty()).filter_map(|block| {
            let unknowns = block.names(derivation);
            Modes::of(block.group, &unknowns.split(", ").collect::<Vec<_>>())
        });
        let modes = modes.collect();
        Self { is_closed: assembly.guesses.is_empty(), open, sides, modes, turns, blocks: derivation.blocks.len() }
    }

    /// A guess for a mechanism with mistakes. If the order of solution is known, the groups are those of the equations
    /// as written; else each pair of unknowns, in the order of declaration, is a group with two solutions.
    pub fn guessed(mechanism: &Mechanism, driver: &Driver) -> Self {
        let name = |place: UnknownId| mechanism.coordinates[driver.unknowns[place]].name.field.as_str();
        if driver.system.blocks.is_empty() {
            let are_angles = |group: &[UnknownId]| {
                group.iter().all(|&place| mechanism.coordinates[driver.unknowns[place]].kind != Kind::Length)
            };
            let places: Vec<UnknownId> = driver.unknowns.ids().collect();
            let sides = places.chunks_exact(2).map(|group| {
                let choice = if are_angles(group) { Choice::Elbow } else { Choice::Slider };
                Side::of_unknowns([name(group[0]), name(group[1])].join("_"), choice)
            });
            let sides: Vec<_> = sides.collect();
            return Self { is_closed: true, blocks: sides.len(), sides, ..Self::default() };
        }
        let mut graph = mechanism.graph.clone();
        let rows = &driver.system.rows;
        let (mut sides, mut solved, mut open, mut modes) = (Vec::new(), BTreeSet::new(), Vec::new(), Vec::new());
        for block in &driver.system.blocks {
            let equations = rows.at(&block.equations);
            let symbols = block.unknowns.iter().map(|&place| mechanism.coordinates[driver.unknowns[place]].symbol);
            let symbols: Vec<SymbolId> = symbols.collect();
            let group = Class::of(&mut graph, &equations, &symbols).group;
            let choice = Choice::of(group, block.slide);
            if choice.is_some() {
                let angles = graph.in_directions(&equations);
                solved.extend(symbols.into_iter().filter(|symbol| angles.contains(symbol)));
            }
            let names: Vec<&str> = block.unknowns.iter().map(|&place| name(place)).collect();
            open.extend(group.obstacle().map(|obstacle| (names.join(", "), obstacle)));
            modes.extend(Modes::of(group, &names));
            let mut dyad = block.unknowns.clone();
            dyad.extend(block.slide.map(|slide| slide.length));
            dyad.sort_unstable();
            let names: Vec<&str> = dyad.into_iter().map(name).collect();
            sides.extend(choice.map(|choice| Side::of_unknowns(names.join("_"), choice)));
        }
        let is_closed = open.is_empty() && modes.is_empty();
        if !open.is_empty() {
            modes.clear();
        }
        let turns = match is_closed {
            true => Self::guessed_turns(mechanism, driver, &mut graph, &sides, &solved),
            false => Vec::new(),
        };
        Self { is_closed, open, sides, modes, turns, blocks: driver.system.blocks.len() }
    }

    /// The turns of the solved angles that appear as numbers in formulas of the mechanism or of its scenes.
    fn guessed_turns(
        mechanism: &Mechanism,
        driver: &Driver,
        graph: &mut Graph,
        sides: &[Side],
        solved: &BTreeSet<SymbolId>,
    ) -> Vec<AngleTurn> {
        let mut formulas = mechanism.kinematic_formulas(&driver.system.rows);
        let directions = graph.directions(&formulas);
        let symbols: Vec<SymbolId> = mechanism.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
        for scene in mechanism.scenes_of(driver) {
            formulas.extend(scene.values());
            let paths = scene.paths(&mechanism.bodies);
            formulas.extend(symbols.iter().flat_map(|&symbol| graph.partial(&paths, symbol)));
        }
        let needed: BTreeSet<SymbolId> = graph.needed_as_numbers(&formulas).into_iter().collect();
        let mut taken = Taken::unreserved();
        for side in sides {
            taken.unique(&side.field);
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
