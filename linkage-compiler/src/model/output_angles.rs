//! Outputs that are angles.
//!
//! The terms of a sum are of one kind: it is an angle if one of them is, and none is a length. A term is an angle if it is a
//! coordinate or a parameter that is one, an inverse function such as `atan2`, the magnitude of an angle, or a number times an
//! angle, also times a sum that is one. A product of two names is none: `r * theta` may be a length.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use rustc_hash::FxHashMap;

use super::{Kind, Measure, Mechanism, Parameter};
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

/// An output that is an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputAngle {
    /// The jump of its formula where an `atan2` in it goes from pi to -pi, of which all its jumps are multiples.
    pub jump: Option<f64>,
    /// True if it has jumps that are no multiples of one of them: a value does not tell which of its angles has jumped, and
    /// `jump` is none.
    pub jumps_differ: bool,
}

impl OutputAngle {
    fn jumps(jump: Option<f64>) -> Self {
        Self { jump, jumps_differ: false }
    }

    /// This times a number.
    fn times(self, number: Number) -> Self {
        Self { jump: self.jump.map(|jump| jump * number.to_f64().abs()), ..self }
    }

    /// The sum of two.
    fn and(self, other: Self) -> Self {
        match (self.jump, other.jump) {
            _ if self.jumps_differ || other.jumps_differ => Self { jump: None, jumps_differ: true },
            (Some(one), Some(other)) => {
                let [small, large] = [one.min(other), one.max(other)];
                // Factors such as 0.1 and 0.3 are rounded.
                let ratio = large / small;
                let is_multiple = (ratio - ratio.round()).abs() <= 4.0 * f64::EPSILON * ratio;
                Self { jump: is_multiple.then_some(small), jumps_differ: !is_multiple }
            }
            (one, other) => Self::jumps(one.or(other)),
        }
    }
}

/// The outputs that are angles, in their order.
#[must_use]
pub fn output_angles(mechanism: &Mechanism) -> Vec<Option<OutputAngle>> {
    // One with a default in degrees is an angle, also where its use does not say so.
    let kind = |of: &Parameter| if of.measure == Measure::Angle { Kind::Angle } else { of.kind };
    let parameters = mechanism.parameters.iter().map(|of| (of.symbol, kind(of)));
    let coordinates = mechanism.coordinates.iter().map(|of| (of.symbol, of.kind));
    let kinds: BTreeMap<SymbolId, Kind> = coordinates.chain(parameters).collect();
    mechanism.outputs.iter().map(|output| angle(&mechanism.graph, output.value, &kinds)).collect()
}

/// The quantity of an expression.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Found {
    Angle(OutputAngle),
    Length,
    Other,
}

impl Found {
    fn angle(jump: Option<f64>) -> Self {
        Self::Angle(OutputAngle::jumps(jump))
    }

    /// This times a number.
    fn times(self, number: Number) -> Self {
        match self {
            Self::Angle(angle) => Self::Angle(angle.times(number)),
            other => other,
        }
    }

    /// The sum of terms.
    fn sum(terms: impl Iterator<Item = Self>) -> Self {
        terms.fold(Self::Other, |sum, term| match (sum, term) {
            (Self::Length, _) | (_, Self::Length) => Self::Length,
            (Self::Angle(one), Self::Angle(other)) => Self::Angle(one.and(other)),
            (Self::Angle(angle), Self::Other) | (Self::Other, Self::Angle(angle)) => Self::Angle(angle),
            (Self::Other, Self::Other) => Self::Other,
        })
    }
}

/// The angle that a formula is, from its parts to the whole.
pub(super) fn angle(graph: &Graph, formula: NodeId, kinds: &BTreeMap<SymbolId, Kind>) -> Option<OutputAngle> {
    let mut found: FxHashMap<NodeId, Found> = FxHashMap::default();
    for id in graph.reachable(&[formula]) {
        let of = |part: NodeId| found.get(&part).copied().unwrap_or(Found::Other);
        let here = match graph.node(id) {
            Node::Symbol(symbol) => match kinds.get(symbol) {
                Some(Kind::Angle) => Found::angle(None),
                Some(Kind::Length) => Found::Length,
                Some(Kind::Number) | None => Found::Other,
            },
            Node::Call(Function::Atan2, _) => Found::angle(Some(TAU)),
            Node::Call(Function::Asin | Function::Acos | Function::Atan, _) => Found::angle(None),
            // The magnitude of an angle by `atan2` is pi on both sides of its jump.
            Node::Call(Function::Abs, parts) => match Found::sum(parts.iter().map(|part| of(*part))) {
                Found::Angle(_) => Found::angle(None),
                other => other,
            },
            Node::Product { coefficient, factors } => match factors.as_slice() {
                [(base, 1)] => of(*base).times(*coefficient),
                _ => Found::Other,
            },
            Node::Sum { terms, .. } => Found::sum(terms.iter().map(|(number, term)| of(*term).times(*number))),
            _ => Found::Other,
        };
        found.insert(id, here);
    }
    match found.get(&formula) {
        Some(Found::Angle(angle)) => Some(*angle),
        _ => None,
    }
}
