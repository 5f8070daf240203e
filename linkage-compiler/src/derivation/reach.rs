//! The links that do not reach each other: the steps of a position in closed form are run in doubles, up to the first that has no
//! solution.

use std::collections::BTreeMap;
use std::fmt;

use super::{ChordGeometry, Derivation, Step};
use crate::graph::{Function, Graph, Node, NodeId, SymbolId};
use crate::ids::{GroupId, Table};
use crate::model::{Driver, Mechanism};
use crate::structure::GroupKind;

/// A link by its formula.
#[derive(Debug, Clone, PartialEq)]
pub struct Length {
    /// The formula of its length, if it is short.
    pub name: Option<String>,
    pub value: f64,
}

/// The reason why a group has no position.
#[derive(Debug, Clone, PartialEq)]
pub enum Missing {
    /// Two links together are shorter than the distance of their outer joints.
    TooShort { links: [Length; 2], distance: f64 },
    /// One of two links is longer than the other one and the distance of their outer joints together.
    TooLong { long: Length, short: Length, distance: f64 },
    /// A link is shorter than the distance of the line on which its end is.
    OffLine { link: Length, distance: f64 },
    /// A line that turns is farther from its pivot than the other joint is.
    OffPivot { offset: f64, distance: f64 },
}

/// A number with five digits.
struct Digits(f64);

impl fmt::Display for Digits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:.4e}", self.0);
        match text.parse::<f64>() {
            Ok(value) if (1e-4..1e7).contains(&value.abs()) => write!(f, "{value}"),
            Ok(0.0) => f.write_str("0"),
            _ => f.write_str(&text),
        }
    }
}

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.name {
            Some(name) => f.write_str(name),
            None => write!(f, "the link of length {}", Digits(self.value)),
        }
    }
}

/// The links and what they lack: `l3 and l4 together are 12.3 too short: their ends are 132.3 apart`.
impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooShort { links: [one, other], distance } => {
                let (by, distance) = (Digits(distance - one.value - other.value), Digits(*distance));
                write!(f, "{one} and {other} together are {by} too short: their ends are {distance} apart")
            }
            Self::TooLong { long, short, distance } => {
                let (by, distance) = (Digits(long.value - short.value - distance), Digits(*distance));
                write!(f, "{long} is {by} too long, or {short} too short: their ends are only {distance} apart")
            }
            Self::OffLine { link, distance } => {
                let (by, distance) = (Digits(distance - link.value), Digits(*distance));
                write!(f, "{link} is {by} too short: the line on which its end is lies {distance} away")
            }
            Self::OffPivot { offset, distance } => {
                let (by, offset, distance) = (Digits(offset - distance), Digits(*offset), Digits(*distance));
                write!(
                    f,
                    "its joints are {by} too near: they are only {distance} apart, and the line that turns lies {offset} away \
                     from one of them"
                )
            }
        }
    }
}

/// The steps of a position as far as they have a closed form.
#[derive(Debug, Clone)]
pub struct Reach {
    graph: Graph,
    steps: Vec<Step>,
    kinds: Table<GroupId, GroupKind>,
    /// The groups with two solutions, in the order of the branch.
    chords: Vec<GroupId>,
    /// The names as they are written.
    names: BTreeMap<SymbolId, String>,
    parameters: Vec<SymbolId>,
    inputs: Vec<SymbolId>,
}

impl Reach {
    /// The steps of the derivation of a driver.
    #[must_use]
    pub fn of(mechanism: &Mechanism, driver: &Driver, derivation: &Derivation) -> Self {
        let mut derivation = derivation.clone();
        let parameters = mechanism.parameters.iter().map(|of| (of.symbol, of.name.text.clone()));
        let coordinates = mechanism.coordinates.iter().map(|of| (of.symbol, of.name.text.clone()));
        let names = parameters.chain(coordinates).collect();
        let parameters = mechanism.parameters.iter().map(|of| of.symbol).collect();
        let inputs = driver.inputs.iter().map(|id| mechanism.coordinates[*id].symbol).collect();
        let assembly = derivation.assembly();
        let kinds = derivation.groups.iter().map(|group| group.kind).collect();
        let chords = assembly.chords.iter().map(|chord| chord.group).collect();
        Self { graph: derivation.graph, steps: assembly.steps, kinds, chords, names, parameters, inputs }
    }

    /// The reason why the first group without a position has none, at these values of parameters and inputs; `negative` has a flag
    /// for each group with two solutions, true for that of the negative root. None if it is another reason, or not known.
    #[must_use]
    pub fn missing(&self, parameters: &[f64], inputs: &[f64], negative: &[bool]) -> Option<Missing> {
        let parameters = self.parameters.iter().copied().zip(parameters.iter().copied());
        let inputs = self.inputs.iter().copied().zip(inputs.iter().copied());
        let mut values: BTreeMap<SymbolId, f64> = parameters.chain(inputs).collect();
        let is_negative = |group: GroupId| {
            let place = self.chords.iter().position(|chord| *chord == group);
            place.and_then(|place| negative.get(place)).copied().unwrap_or_default()
        };
        for step in &self.steps {
            let found = |node: NodeId| -> Option<f64> {
                let symbols = self.graph.symbols_of(&[node]);
                symbols.iter().all(|symbol| values.contains_key(symbol)).then_some(())?;
                let value = |symbol: SymbolId| values.get(&symbol).copied().unwrap_or(f64::NAN);
                self.graph.evaluate(&[node], value).first().copied().filter(|value| value.is_finite())
            };
            match step {
                Step::Let { symbol, node } => {
                    let value = found(*node)?;
                    values.insert(*symbol, value);
                }
                Step::Turn { symbol, principal, .. } => {
                    let value = found(*principal)?;
                    values.insert(*symbol, value);
                }
                Step::Chord { group, symbol, factors: [low, high], size, of } => {
                    let factors = [found(*low)?, found(*high)?];
                    if factors.iter().any(|factor| *factor < 0.0) {
                        return self.of_chord(*group, factors, *size, of, found);
                    }
                    let root = (factors[0] * factors[1]).sqrt();
                    values.insert(*symbol, if is_negative(*group) { -root } else { root });
                }
                Step::Guard { .. } | Step::Solvable { .. } | Step::Pivots { .. } => {}
                Step::Reach { length, .. } => {
                    found(*length).filter(|length| *length >= 0.0)?;
                }
                Step::Factor { .. } | Step::Solve { .. } | Step::Newton { .. } | Step::Modes { .. } => return None,
            }
        }
        None
    }

    fn of_chord(
        &self,
        group: GroupId,
        [low, high]: [f64; 2],
        size: NodeId,
        of: &ChordGeometry<NodeId>,
        found: impl Fn(NodeId) -> Option<f64>,
    ) -> Option<Missing> {
        let length = |node: NodeId| Some(Length { name: self.name(node), value: found(node)?.abs() });
        match of {
            ChordGeometry::Triangle { links: [one, other], distance_squared, .. } => {
                let (one, other, distance) = (length(*one)?, length(*other)?, found(*distance_squared)?.sqrt());
                if low < 0.0 {
                    return Some(Missing::TooShort { links: [one, other], distance });
                }
                let [long, short] = if one.value < other.value { [other, one] } else { [one, other] };
                Some(Missing::TooLong { long, short, distance })
            }
            _ if self.kinds[group] == GroupKind::Rpr
                && matches!(self.graph.node(size), Node::Call(Function::Sqrt, _)) =>
            {
                Some(Missing::OffPivot { offset: (high - low).abs() / 2.0, distance: found(size)? })
            }
            // Of another group the radius may be the distance of two joints, or have the unit of a guide.
            _ if self.kinds[group] != GroupKind::Angle && self.graph.as_symbol(self.unsigned(size)).is_none() => None,
            _ => Some(Missing::OffLine { link: length(size)?, distance: (high - low).abs() / 2.0 }),
        }
    }

    /// A length without its absolute value.
    fn unsigned(&self, node: NodeId) -> NodeId {
        match self.graph.node(node) {
            Node::Call(Function::Abs, inside) => inside.first().copied().unwrap_or(node),
            _ => node,
        }
    }

    /// The formula of a length with names as they are written; none if it is long, or has a name that is written otherwise.
    fn name(&self, node: NodeId) -> Option<String> {
        /// The most letters of a formula in a sentence.
        const LONGEST: usize = 24;

        let node = self.unsigned(node);
        if let Some(symbol) = self.graph.as_symbol(node) {
            return self.names.get(&symbol).map(|name| format!("`{name}`"));
        }
        let as_written =
            |symbol: &SymbolId| self.names.get(symbol).is_some_and(|name| *name == self.graph.symbol_name(*symbol));
        let text = self.graph.text(node);
        let is_short = text.chars().count() <= LONGEST && self.graph.symbols_of(&[node]).iter().all(as_written);
        (is_short && self.graph.constant_value(node).is_none()).then(|| format!("`{text}`"))
    }
}
