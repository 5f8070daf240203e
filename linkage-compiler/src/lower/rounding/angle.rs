//! Angles as sums of stored angles.

use super::super::schedule::Schedule;
use super::super::value::{Leaf, Signed, Value};
use crate::graph::{Graph, Node, NodeId, SymbolId};

/// The number of an angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct AngleId(usize);

/// Symbols with their factors, ascending, the first factor positive.
type Terms = Vec<(SymbolId, f64)>;

#[derive(Debug, Default)]
pub(super) struct Angles(Vec<Terms>);

impl Angles {
    /// An angle up to its sign, with true if its sign changed; `None` for a constant.
    fn add(&mut self, mut terms: Terms) -> Option<(AngleId, bool)> {
        terms.retain(|(_, factor)| *factor != 0.0);
        terms.sort_by_key(|(symbol, _)| *symbol);
        let is_negative = terms.first()?.1 < 0.0;
        if is_negative {
            terms.iter_mut().for_each(|(_, factor)| *factor = -*factor);
        }
        let index = self.0.iter().position(|other| *other == terms).unwrap_or_else(|| {
            self.0.push(terms);
            self.0.len() - 1
        });
        Some((AngleId(index), is_negative))
    }

    /// The angle of a direction of a pose.
    pub(super) fn of_node(&mut self, graph: &Graph, node: NodeId) -> Option<(AngleId, bool)> {
        let terms = match graph.node(node) {
            Node::Sum { constant, terms } if constant.is_zero() => {
                let symbols = terms.iter().map(|(factor, term)| Some((graph.as_symbol(*term)?, factor.to_f64())));
                symbols.collect::<Option<Terms>>()?
            }
            _ => vec![(graph.as_symbol(node)?, 1.0)],
        };
        self.add(terms)
    }

    /// The angle that is the argument of a sine in the code.
    pub(super) fn of_value(&mut self, schedule: &Schedule, angle: Signed) -> Option<(AngleId, bool)> {
        let symbol = |part: &Signed| match schedule.value(part.value) {
            Value::Given(Leaf::Symbol(symbol)) => {
                Some((*symbol, if part.negative != angle.negative { -1.0 } else { 1.0 }))
            }
            _ => None,
        };
        let terms = match schedule.value(angle.value) {
            Value::Sum(parts) => parts.iter().map(symbol).collect::<Option<Terms>>()?,
            _ => vec![symbol(&Signed { negative: false, value: angle.value })?],
        };
        self.add(terms)
    }

    /// a + b, or a - b.
    pub(super) fn combined(&mut self, [a, b]: [AngleId; 2], is_difference: bool) -> Option<(AngleId, bool)> {
        let mut terms = self.terms(a).to_vec();
        for &(symbol, factor) in &self.0[b.0] {
            let factor = if is_difference { -factor } else { factor };
            match terms.iter_mut().find(|(other, _)| *other == symbol) {
                Some((_, sum)) => *sum += factor,
                None => terms.push((symbol, factor)),
            }
        }
        self.add(terms)
    }

    pub(super) fn terms(&self, angle: AngleId) -> &[(SymbolId, f64)] {
        &self.0[angle.0]
    }

    /// The rounding of an angle, relative to it: none for a stored one, one for a sum of two; `None` where terms may cancel
    /// after a rounding.
    pub(super) fn rounding(&self, angle: AngleId) -> Option<f64> {
        let terms = self.terms(angle);
        let is_exact = terms.iter().all(|(_, factor)| is_power_of_two(*factor));
        match (terms.len(), is_exact) {
            (1, true) => Some(0.0),
            (1, false) | (2, true) => Some(1.0),
            _ => None,
        }
    }
}

/// A product with such a number is exact.
pub(super) fn is_power_of_two(number: f64) -> bool {
    /// The bits of a double after the leading one.
    const MANTISSA: u64 = (1 << 52) - 1;
    number.is_normal() && number.to_bits() & MANTISSA == 0
}
