//! `ranges`: the coordinates and outputs that have a range, with their values and its ends at a position.

use std::collections::BTreeSet;

use linkage_ir::{Constant, Intrinsic};

use super::doc::{fenced, lines, without_result};
use super::expression::{Expression, Type};
use super::function::{Argument, Body, Function, Passed};
use super::names::Order;
use super::plan::{Plan, unnamed};
use super::signatures::{Signatures, total};
use crate::graph::{NodeId, SymbolId};
use crate::model::Kind;

impl Plan<'_, '_> {
    pub(super) fn ranges(&mut self) {
        let ranges = &self.mechanism.ranges;
        if ranges.is_empty() {
            return;
        }
        let texts = ranges.iter().map(|range| {
            let [least, most] = range.ends.map(|end| end.map_or_else(String::new, |end| self.text(end)));
            format!("{} in {least}..{most}", range.name)
        });
        let mut doc =
            lines(["The values that have a range, each with its ends; `assemble` and `kinematics` do not check them."]);
        doc.extend(fenced(texts.collect::<Vec<_>>().into_iter()));
        let (nodes, all) = self.with_ends(Intrinsic::RangedDirection);
        let kernel = self.kernel(vec![self.coordinates(Order::Value)], Vec::new(), unnamed(nodes));
        self.add(self.signatures.ranges(), without_result(doc), Body::of(kernel, Expression::List(all)));
    }

    /// The function of the trait `Formulas` that returns one of them over numbers of any kind.
    pub(super) fn ranged_of_columns(&mut self) -> Option<Function<Body>> {
        if self.mechanism.ranges.is_empty() {
            return None;
        }
        let (nodes, all) = self.with_ends(Intrinsic::RangedModuloTurns);
        let kernel = self.kernel_of_columns(unnamed(nodes), false);
        let place = Expression::name(&self.signatures.arguments.position);
        let found = Expression::call(Intrinsic::Get, [Expression::List(all), place]);
        let body = Body::of(kernel, Expression::call(Intrinsic::Copied, [found]));
        Some(Function { body: Some(body), ..self.signatures.ranged_of_columns() })
    }

    /// The formulas of all values and ends, and what is made of them; `direction` makes that of an angle of which whole turns
    /// change nothing.
    fn with_ends(&self, direction: Intrinsic) -> (Vec<NodeId>, Vec<Expression>) {
        let directions = self.directions_with_ranges();
        let mut nodes: Vec<NodeId> = Vec::new();
        let mut result = |node: NodeId| {
            nodes.push(node);
            Expression::Result(nodes.len() - 1)
        };
        let made = self.mechanism.ranges.iter().map(|range| {
            let value = result(range.value);
            let ends = range.ends.map(|end| perhaps(end.map(&mut result)));
            let symbol = self.derivation.graph.as_symbol(range.value);
            let is_direction = symbol.is_some_and(|symbol| directions.contains(&symbol));
            let of = if is_direction { direction } else { Intrinsic::Ranged };
            Expression::call(of, std::iter::once(value).chain(ends))
        });
        let made = made.collect();
        (nodes, made)
    }

    /// The angles of which whole turns change nothing: they are numbers in no formula.
    fn directions_with_ranges(&self) -> BTreeSet<SymbolId> {
        let Self { mechanism, driver, .. } = self;
        let turns = self.position.turns.iter().map(|turn| turn.symbol);
        let counted: BTreeSet<SymbolId> = mechanism.counted(driver).into_iter().chain(turns).collect();
        let angles = mechanism.coordinates.iter().filter(|coordinate| coordinate.kind == Kind::Angle);
        angles.map(|coordinate| coordinate.symbol).filter(|symbol| !counted.contains(symbol)).collect()
    }
}

fn perhaps(value: Option<Expression>) -> Expression {
    match value {
        Some(value) => Expression::call(Intrinsic::Some, [value]),
        None => Expression::Constant(Constant::None),
    }
}

impl Signatures {
    /// The values with ranges at a position.
    pub fn ranges(&self) -> Function<Body> {
        let count = self.ranges.len();
        total("ranges", [self.coordinates(Order::Value)], Type::List(Box::new(ranged()), count))
    }

    /// One of them, by its place, over numbers of any kind. Its name is that of an argument, which no value has.
    pub(super) fn ranged_of_columns(&self) -> Function<Body> {
        let place = Argument { name: self.arguments.position.clone(), passed: Passed::ByValue(Type::Count) };
        let returns = Type::Around("Option", Box::new(ranged()));
        let of_columns = self.function_of_columns("ranged", Order::Value, returns);
        Function { arguments: std::iter::once(place).chain(of_columns.arguments.clone()).collect(), ..of_columns }
    }
}

/// A value with its range.
pub(super) fn ranged() -> Type {
    Type::Around("Ranged", Box::new(Type::Scalar))
}
