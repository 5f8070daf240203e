//! Outputs that are angles.
//!
//! The terms of a sum are of one kind: it is an angle if one of them is, and none is a length. A term is an angle if it is a
//! coordinate or a parameter that is one, an inverse function such as `atan2`, or a number times one of these. A product of two
//! names is none: `r * theta` may be a length.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::{Kind, Mechanism};
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

/// An output that is an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputAngle {
    /// The jump of its formula where an `atan2` in it goes from pi to -pi.
    pub jump: Option<f64>,
}

/// The outputs that are angles, in their order.
#[must_use]
pub fn output_angles(mechanism: &Mechanism) -> Vec<Option<OutputAngle>> {
    let parameters = mechanism.parameters.iter().map(|of| (of.symbol, of.kind));
    let coordinates = mechanism.coordinates.iter().map(|of| (of.symbol, of.kind));
    let kinds: BTreeMap<SymbolId, Kind> = coordinates.chain(parameters).collect();
    mechanism.outputs.iter().map(|output| angle(&mechanism.graph, output.value, &kinds)).collect()
}

/// A term of a sum.
enum Term {
    Angle,
    /// An `atan2` times a number.
    Jumping(f64),
    Length,
    Other,
}

pub(super) fn angle(graph: &Graph, sum: NodeId, kinds: &BTreeMap<SymbolId, Kind>) -> Option<OutputAngle> {
    let term = |number: Number, of: NodeId| match graph.node(of) {
        Node::Symbol(symbol) => match kinds.get(symbol) {
            Some(Kind::Angle) => Term::Angle,
            Some(Kind::Length) => Term::Length,
            Some(Kind::Number) | None => Term::Other,
        },
        Node::Call(Function::Atan2, _) => Term::Jumping(TAU * number.to_f64().abs()),
        Node::Call(Function::Asin | Function::Acos | Function::Atan, _) => Term::Angle,
        Node::Call(Function::Abs, of) if of.iter().all(|of| angle(graph, *of, kinds).is_some()) => Term::Angle,
        _ => Term::Other,
    };
    // A number times a term is a product.
    let scaled = |number: Number, of: NodeId| match graph.node(of) {
        Node::Product { coefficient, factors } => match factors.as_slice() {
            [(base, 1)] => term(number.multiply(*coefficient), *base),
            _ => term(number, of),
        },
        _ => term(number, of),
    };
    let terms: Vec<Term> = match graph.node(sum) {
        Node::Sum { terms, .. } => terms.iter().map(|(number, of)| scaled(*number, *of)).collect(),
        _ => vec![scaled(Number::ONE, sum)],
    };
    let jumps = terms.iter().filter_map(|term| match term {
        Term::Jumping(jump) => Some(*jump),
        _ => None,
    });
    let jump = jumps.reduce(f64::min);
    let is_one = terms.iter().all(|term| !matches!(term, Term::Length))
        && terms.iter().any(|term| matches!(term, Term::Angle | Term::Jumping(_)));
    is_one.then_some(OutputAngle { jump })
}
