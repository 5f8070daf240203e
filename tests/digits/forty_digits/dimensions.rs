//! The length exponents of the symbols of a mechanism, from its constraints and points.

use std::collections::HashMap;

use linkage_compiler::derivation::Derivation;
use linkage_compiler::graph::{Function, Graph, Node, NodeId, Number, SymbolId};
use linkage_compiler::model::{Kind, Mechanism};

/// Exponents of length by symbol; a symbol that is not in the map is a pure number.
pub(super) type Powers = HashMap<SymbolId, f64>;

/// The exponents for which every constraint is homogeneous and every one of these points is a length; None if there are
/// none, because a length is written as a number.
pub(super) fn powers_of_length(mechanism: &Mechanism, derivation: &Derivation, points: &[NodeId]) -> Option<Powers> {
    let graph = &derivation.graph;
    let power = |kind| match kind {
        Kind::Length => Some(1.0),
        Kind::Angle => Some(0.0),
        Kind::Number => None,
    };
    let parameters = mechanism.parameters.iter().map(|parameter| (parameter.symbol, power(parameter.kind)));
    let kinds = mechanism.coordinates.iter().map(|coordinate| (&coordinate.name.field, power(coordinate.kind)));
    let kinds: HashMap<_, _> = kinds.collect();
    let coordinates = derivation.coordinates.iter().map(|coordinate| (coordinate.value, kinds[&coordinate.name]));
    let known = parameters.chain(coordinates).filter_map(|(symbol, power)| Some((symbol, power?))).collect();
    let mut search = Search { graph, powers: known };
    loop {
        let before = search.powers.len();
        for &point in points {
            search.expect(point, 1.0)?;
        }
        for &residual in &derivation.residual {
            if let Some(power) = search.power(residual) {
                search.expect(residual, power)?;
            }
        }
        if search.powers.len() > before {
            continue;
        }
        // What nothing determines: a coordinate is a number, then its factors may follow.
        let free = derivation.coordinates.iter().map(|coordinate| coordinate.value);
        match free.into_iter().find(|symbol| !search.powers.contains_key(symbol)) {
            Some(symbol) => search.powers.insert(symbol, 0.0),
            None => return Some(search.powers),
        };
    }
}

struct Search<'a> {
    graph: &'a Graph,
    powers: Powers,
}

impl Search<'_> {
    /// The exponent of an expression, if its symbols determine it.
    fn power(&self, node: NodeId) -> Option<f64> {
        match self.graph.node(node) {
            Node::Constant(_) | Node::Pi => Some(0.0),
            Node::Symbol(symbol) => self.powers.get(symbol).copied(),
            Node::Sum { constant, terms } if *constant == Number::ZERO => {
                terms.iter().find_map(|&(_, term)| self.power(term))
            }
            Node::Sum { .. } => Some(0.0),
            Node::Product { factors, .. } => {
                factors.iter().map(|&(base, exponent)| Some(self.power(base)? * f64::from(exponent))).sum()
            }
            Node::Call(Function::Sqrt, arguments) => Some(self.power(arguments[0])? / 2.0),
            Node::Call(Function::Abs | Function::Hypot, arguments) => arguments.iter().find_map(|&a| self.power(a)),
            Node::Call(..) => Some(0.0),
            // A cam law gives a part of its stroke, which is the second argument, or a derivative of it by an angle.
            Node::External(_, arguments) => self.power(arguments[1]),
        }
    }

    /// Assigns an exponent to an expression through its symbols; None if it has another.
    fn expect(&mut self, node: NodeId, power: f64) -> Option<()> {
        let graph = self.graph;
        match graph.node(node) {
            Node::Constant(number) => (power == 0.0 || *number == Number::ZERO).then_some(()),
            Node::Pi => (power == 0.0).then_some(()),
            Node::Symbol(symbol) => (*self.powers.entry(*symbol).or_insert(power) == power).then_some(()),
            Node::Sum { constant, terms } => {
                let of_constant = (power == 0.0 || *constant == Number::ZERO).then_some(());
                terms.iter().try_for_each(|&(_, term)| self.expect(term, power)).and(of_constant)
            }
            Node::Product { factors, .. } => {
                let mut rest = power;
                let mut unknown = Vec::new();
                for &(base, exponent) in factors {
                    match self.power(base) {
                        Some(power) => {
                            self.expect(base, power)?;
                            rest -= power * f64::from(exponent);
                        }
                        None => unknown.push((base, f64::from(exponent))),
                    }
                }
                match unknown[..] {
                    [] => (rest == 0.0).then_some(()),
                    [(base, exponent)] => self.expect(base, rest / exponent),
                    _ => Some(()),
                }
            }
            Node::Call(Function::Sqrt, arguments) => self.expect(arguments[0], 2.0 * power),
            Node::Call(Function::Abs | Function::Hypot, arguments) => {
                arguments.iter().try_for_each(|&argument| self.expect(argument, power))
            }
            Node::Call(Function::Atan2, arguments) => {
                let of_both = arguments.iter().find_map(|&argument| self.power(argument));
                let of_both = of_both.map_or(Some(()), |of_both| {
                    arguments.iter().try_for_each(|&argument| self.expect(argument, of_both))
                });
                of_both.filter(|()| power == 0.0)
            }
            Node::Call(_, arguments) => self.expect(arguments[0], 0.0).filter(|()| power == 0.0),
            Node::External(_, arguments) => self.expect(arguments[1], power),
        }
    }
}
