//! Ranges of coordinates and outputs, whose ends are numbers or expressions of parameters.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use proc_macro2::Ident;

use super::kind::{Kind, bare_symbols};
use super::mechanism::{Coordinate, Driver, JointRange, Mechanism};
use super::resolver::Resolver;
use crate::diagnostics::Region;
use crate::graph::{NodeId, SymbolId};
use crate::ids::{CoordinateId, Table};
use crate::syntax::{ExpressionId, Range};

/// Two ends differ by at most a turn up to this number of ulps of the larger one, as in `Ranged` of the runtime.
const SLACK_ULPS: f64 = 4.0;

impl Mechanism {
    /// The angles whose range has one end only or is longer than a turn by its numbers: they count turns. One whose length
    /// depends on parameters is understood as a range of directions.
    #[must_use]
    pub fn counted_by_ranges(&self) -> BTreeSet<SymbolId> {
        let counts_turns = |range: &&JointRange| match range.ends {
            [Some(least), Some(most)] => match [least, most].map(|end| self.graph.constant_value(end)) {
                [Some(least), Some(most)] => {
                    most - least - least.abs().max(most.abs()) * f64::EPSILON * SLACK_ULPS > TAU
                }
                _ => false,
            },
            _ => true,
        };
        let counted = self.ranges.iter().filter(counts_turns).filter_map(|range| self.graph.as_symbol(range.value));
        let counted: BTreeSet<SymbolId> = counted.collect();
        let angles = self.coordinates.iter().filter(|coordinate| coordinate.kind == Kind::Angle);
        angles.map(|coordinate| coordinate.symbol).filter(|symbol| counted.contains(symbol)).collect()
    }

    /// The symbols of which whole turns change a formula, as those of a gear's angle, of half an angle, and all lengths, and
    /// those that a range counts.
    #[must_use]
    pub fn counted(&self, driver: &Driver) -> BTreeSet<SymbolId> {
        let mut formulas = self.kinematic_formulas(&driver.system.rows);
        let mut graph = Cow::Borrowed(&self.graph);
        for (_, scene) in self.scenes_of(driver) {
            formulas.extend(scene.values());
            let (paths, graph) = (scene.paths(&self.bodies), graph.to_mut());
            formulas.extend(self.coordinates.iter().flat_map(|coordinate| graph.partial(&paths, coordinate.symbol)));
        }
        graph.needed_as_numbers(&formulas).into_iter().chain(self.counted_by_ranges()).collect()
    }

    /// The ranges with both ends of angles whose value a position has, not their direction alone.
    #[must_use]
    pub fn ranges_of_turns(&self, driver: &Driver) -> BTreeMap<SymbolId, [NodeId; 2]> {
        if self.ranges.is_empty() {
            return BTreeMap::new();
        }
        let counted = self.counted(driver);
        let directions = self.graph.directions(&self.kinematic_formulas(&driver.system.rows));
        let angles = self.coordinates.iter().filter(|coordinate| coordinate.kind == Kind::Angle);
        let angles: BTreeSet<SymbolId> = angles
            .map(|coordinate| coordinate.symbol)
            .filter(|symbol| counted.contains(symbol) || !directions.contains(symbol))
            .collect();
        let of_range = |range: &JointRange| {
            let symbol = self.graph.as_symbol(range.value).filter(|symbol| angles.contains(symbol))?;
            let [Some(least), Some(most)] = range.ends else { return None };
            Some((symbol, [least, most]))
        };
        self.ranges.iter().filter_map(of_range).collect()
    }
}

impl Resolver<'_> {
    /// The ends of a range: all its expressions are evaluated, also after a mistake in one.
    pub(super) fn ends(
        &mut self,
        name: &Ident,
        range: &Range,
        coordinates: &Table<CoordinateId, Coordinate>,
    ) -> Option<[Option<NodeId>; 2]> {
        let moving: BTreeSet<SymbolId> = coordinates.iter().map(|coordinate| coordinate.symbol).collect();
        let ends = range.ends.map(|end| end.map(|id| self.end(id, &moving)));
        let is_read = ends.iter().all(|end| *end != Some(None));
        let ends = ends.map(Option::flatten);
        if let [Some(least), Some(most)] = ends.map(|end| end.and_then(|end| self.graph.constant_value(end)))
            && least >= most
        {
            let message = format!("the range of `{name}` is empty: its first end must be less than its second");
            self.diagnostics.error(range.region, message);
            return None;
        }
        is_read.then_some(ends)
    }

    fn end(&mut self, id: ExpressionId, moving: &BTreeSet<SymbolId>) -> Option<NodeId> {
        let node = self.scalar(id)?;
        let moves = self.graph.symbols_of(&[node]).iter().any(|symbol| moving.contains(symbol));
        if moves {
            let message = "the end of a range must be constant: use numbers and parameters only";
            self.diagnostics.error(self.expressions.region(id), message);
        }
        (!moves).then_some(node)
    }

    /// Reports ends that have another unit than their coordinate or output.
    pub(super) fn kinds_of_ranges(&mut self, result: &Mechanism) {
        for range in &result.ranges {
            let Some(kind) = self.kind_of_terms(range.value) else { continue };
            for (id, node) in range.written.iter().zip(range.ends) {
                let (Some(id), Some(node)) = (*id, node) else { continue };
                let is_slip = match kind {
                    Kind::Angle => self.degrees_without_unit(id),
                    _ => self.has_unit(id, &format!("the length `{}`", range.name)),
                };
                if !is_slip {
                    self.end_has_kind(node, kind, &range.name, self.expressions.region(id));
                }
            }
        }
    }

    /// The kind of an expression whose terms are names of one kind.
    fn kind_of_terms(&self, node: NodeId) -> Option<Kind> {
        let kinds = bare_symbols(&self.graph, node).into_iter().map(|symbol| self.length_or_angle(symbol));
        let kinds: Option<Vec<Kind>> = kinds.collect();
        let kinds = kinds?;
        let first = *kinds.first()?;
        kinds.iter().all(|kind| *kind == first).then_some(first)
    }

    /// Records the kind of the parameters that are terms of an end, or reports one of another kind.
    fn end_has_kind(&mut self, node: NodeId, kind: Kind, name: &str, region: Region) {
        let symbols: Vec<SymbolId> = bare_symbols(&self.graph, node);
        let other = symbols.iter().find_map(|&symbol| Some((symbol, self.length_or_angle(symbol)?)));
        if let Some((symbol, other)) = other.filter(|(_, other)| *other != kind) {
            let [own, of_end] = [kind, other].map(|kind| if kind == Kind::Angle { "angle" } else { "length" });
            let end = self.graph.symbol_name(symbol);
            let message = format!("`{name}` is an {own}, but the end `{end}` of its range is an {of_end}");
            self.diagnostics.error(region, message.replace("an length", "a length"));
            return;
        }
        for symbol in symbols {
            self.kinds.known.entry(symbol).or_insert(kind);
            if kind == Kind::Length {
                self.kinds.of_places.insert(symbol);
            }
        }
    }
}
