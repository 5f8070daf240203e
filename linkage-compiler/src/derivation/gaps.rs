//! Bounds of the change of a gap of a stop while the coordinates move, in complex directions too.
//!
//! If each coordinate in an expression moves by at most so much, in any complex direction, the expression changes by at most
//! this *change*, a formula of the coordinates and of their moves. By Cauchy's estimate it bounds the derivatives of all orders
//! of the gap along a motion, so that simulations miss no impact between the samples of a step.

use std::collections::BTreeMap;

use rustc_hash::{FxHashMap, FxHashSet};

use super::data::Derivation;
use super::scene::{Contact, ContactFormula, Scene};
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

/// An expression that depends on coordinates: a bound of its magnitude, and its change.
#[derive(Clone, Copy)]
struct Bounded {
    size: NodeId,
    change: NodeId,
}

impl Derivation {
    /// The changes of the gaps of stops, by contact; the moves are in place of the rates. None for a friction, for a polynomial in
    /// the coordinates, which changes no faster than these, and where no bound is known, as with a user function.
    pub(super) fn derive_gap_changes(&mut self, scene: &Scene) -> Vec<Option<NodeId>> {
        let moves: BTreeMap<SymbolId, SymbolId> = self.coordinates.iter().map(|c| (c.value, c.rate)).collect();
        let of_stop = |contact: &Contact| matches!(contact.law, ContactFormula::Stop { .. }).then_some(contact.value);
        let gaps: Vec<Option<NodeId>> = scene.contacts.iter().map(of_stop).collect();
        let change = |gap: Option<NodeId>| {
            gap.filter(|&gap| !is_polynomial(&self.graph, gap, &moves))
                .and_then(|gap| change(&mut self.graph, gap, &moves))
        };
        gaps.into_iter().map(change).collect()
    }
}

/// True of a polynomial in the coordinates, and of one with magnitudes.
fn is_polynomial(graph: &Graph, gap: NodeId, moves: &BTreeMap<SymbolId, SymbolId>) -> bool {
    let mut moving: FxHashSet<NodeId> = FxHashSet::default();
    graph.reachable(&[gap]).into_iter().all(|node| {
        let is_coordinate = graph.as_symbol(node).is_some_and(|symbol| moves.contains_key(&symbol));
        if !is_coordinate && !graph.children(node).iter().any(|child| moving.contains(child)) {
            return true;
        }
        moving.insert(node);
        match graph.node(node) {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) | Node::Sum { .. } | Node::Call(Function::Abs, _) => true,
            Node::Product { factors, .. } => {
                factors.iter().all(|(base, exponent)| *exponent > 0 || !moving.contains(base))
            }
            Node::Call(..) | Node::External(..) => false,
        }
    })
}

/// The change of an expression.
fn change(graph: &mut Graph, gap: NodeId, moves: &BTreeMap<SymbolId, SymbolId>) -> Option<NodeId> {
    let mut found: FxHashMap<NodeId, Bounded> = FxHashMap::default();
    for node in graph.reachable(&[gap]) {
        let of = if let Some(&by) = graph.as_symbol(node).and_then(|symbol| moves.get(&symbol)) {
            let change = graph.variable(by);
            Bounded { size: magnitude(graph, node), change }
        } else if graph.children(node).iter().any(|child| found.contains_key(child)) {
            bounded(graph, node, &found)?
        } else {
            continue;
        };
        found.insert(node, of);
    }
    found.get(&gap).map(|of| of.change)
}

/// The bounds of a node by those of its children that depend on coordinates.
fn bounded(graph: &mut Graph, node: NodeId, found: &FxHashMap<NodeId, Bounded>) -> Option<Bounded> {
    Some(match graph.node(node).clone() {
        Node::Sum { terms, .. } => {
            let changes = terms.iter().filter_map(|(factor, term)| Some((factor.absolute(), found.get(term)?.change)));
            let changes: Vec<_> = changes.collect();
            Bounded { size: magnitude(graph, node), change: graph.sum(&changes) }
        }
        Node::Product { coefficient, factors } => product(graph, coefficient, &factors, found),
        Node::Call(function, arguments) => {
            let of = |place: usize| Some((*arguments.get(place)?, found.get(arguments.get(place)?).copied()));
            call(graph, node, function, of(0)?, of(1))?
        }
        Node::Constant(_) | Node::Pi | Node::Symbol(_) | Node::External(..) => return None,
    })
}

/// (s1 + c1) (s2 + c2) .. - s1 s2 .. for factors of the sizes s and the changes c.
fn product(
    graph: &mut Graph,
    coefficient: Number,
    factors: &[(NodeId, i32)],
    found: &FxHashMap<NodeId, Bounded>,
) -> Bounded {
    let coefficient = graph.number(coefficient.absolute());
    let (mut size, mut change) = (coefficient, graph.zero());
    for &(base, exponent) in factors {
        let Some(of) = found.get(&base) else {
            let fixed = magnitude(graph, base);
            let fixed = graph.power(fixed, exponent);
            size = graph.multiply(size, fixed);
            change = graph.multiply(change, fixed);
            continue;
        };
        let (own, moved) = if exponent > 0 {
            // (s + c)^n - s^n
            let own = graph.power(of.size, exponent);
            let sum = graph.add(of.size, of.change);
            let sum = graph.power(sum, exponent);
            (own, graph.subtract(sum, own))
        } else {
            let base = magnitude(graph, base);
            let own = graph.power(base, exponent);
            let of_logarithm = change_of_logarithm(graph, base, of.change);
            let grown = growth(graph, Number::integer(i64::from(exponent.unsigned_abs())), of_logarithm);
            (own, graph.multiply(own, grown))
        };
        let [grows, moves] = [graph.multiply(change, own), graph.multiply(size, moved)];
        let both = graph.multiply(change, moved);
        let terms = [grows, moves, both].map(|term| (Number::ONE, term));
        (size, change) = (graph.multiply(size, own), graph.sum(&terms));
    }
    Bounded { size, change }
}

/// The change of a function of arguments with these changes; `None` of those without a coordinate.
fn call(
    graph: &mut Graph,
    node: NodeId,
    function: Function,
    (x, of_x): (NodeId, Option<Bounded>),
    second: Option<(NodeId, Option<Bounded>)>,
) -> Option<Bounded> {
    let zero = graph.zero();
    let change = of_x.map_or(zero, |of| of.change);
    let one = graph.one();
    let changed = match function {
        // |sin(x + d) - sin x| <= e^|d| - 1
        Function::Sin | Function::Cos => growth(graph, Number::ONE, change),
        // e^x (e^d - 1)
        Function::Exp => {
            let grown = growth(graph, Number::ONE, change);
            graph.multiply(node, grown)
        }
        Function::Ln => change_of_logarithm(graph, x, change),
        // Between its kinks |x| is x or -x; simulations end their steps at kinks.
        Function::Abs => change,
        // sqrt x = e^(ln x / 2)
        Function::Sqrt => {
            let of_logarithm = change_of_logarithm(graph, x, change);
            let grown = growth(graph, Number::ratio(1, 2), of_logarithm);
            graph.multiply(node, grown)
        }
        // (x + i y) (x - i y) is the square of the one, the other has the derivative (x dy - y dx) / (x^2 + y^2).
        Function::Hypot | Function::Atan2 => {
            let (y, of_y) = second?;
            let other = of_y.map_or(zero, |of| of.change);
            let both = graph.add(change, other);
            let distance = if function == Function::Hypot { node } else { graph.call(Function::Hypot, &[y, x]) };
            let of_logarithm = change_of_logarithm(graph, distance, both);
            if function == Function::Atan2 {
                of_logarithm
            } else {
                let grown = growth(graph, Number::ONE, of_logarithm);
                graph.multiply(node, grown)
            }
        }
        // The direction of 1 + i x.
        Function::Atan => {
            let distance = graph.call(Function::Hypot, &[one, x]);
            change_of_logarithm(graph, distance, change)
        }
        // sin x / cos x, of which the quotient has the derivative 1 / cos^2 x.
        Function::Tan => {
            let cosine = graph.call(Function::Cos, &[x]);
            let grown = growth(graph, Number::ONE, change);
            let of_logarithm = change_of_logarithm(graph, cosine, grown);
            let inverse = growth(graph, Number::ONE, of_logarithm);
            let inverse = graph.add(inverse, one);
            let square = graph.power(cosine, -2);
            graph.product(&[(grown, 1), (inverse, 1), (square, 1)])
        }
        // The derivative is 1 / sqrt(1 - x^2).
        Function::Asin | Function::Acos => {
            let square = graph.power(x, 2);
            let rest = graph.subtract(one, square);
            let size = magnitude(graph, x);
            let twice = graph.sum(&[(Number::integer(2), size), (Number::ONE, change)]);
            let of_square = graph.multiply(change, twice);
            let of_logarithm = change_of_logarithm(graph, rest, of_square);
            let grown = growth(graph, Number::ratio(1, 2), of_logarithm);
            let grown = graph.add(grown, one);
            let root = graph.call(Function::Sqrt, &[rest]);
            let root = graph.power(root, -1);
            graph.product(&[(change, 1), (grown, 1), (root, 1)])
        }
        Function::IfNonzero => return None,
    };
    let size = match function {
        Function::Sin | Function::Cos => one,
        _ => magnitude(graph, node),
    };
    Some(Bounded { size, change: changed })
}

/// |x|, written as x where it has no sign.
fn magnitude(graph: &mut Graph, x: NodeId) -> NodeId {
    if graph.is_length(x) { x } else { graph.call(Function::Abs, &[x]) }
}

/// |ln(x + d) - ln x| <= -ln(1 - |d / x|): no number if |d| is larger than |x|.
fn change_of_logarithm(graph: &mut Graph, x: NodeId, change: NodeId) -> NodeId {
    let size = magnitude(graph, x);
    let part = graph.divide(change, size);
    let one = graph.one();
    let rest = graph.subtract(one, part);
    let logarithm = graph.call(Function::Ln, &[rest]);
    graph.negate(logarithm)
}

/// |e^(n d) - 1| <= e^(n |d|) - 1
fn growth(graph: &mut Graph, factor: Number, change: NodeId) -> NodeId {
    let change = graph.scale(factor, change);
    let power = graph.call(Function::Exp, &[change]);
    let one = graph.one();
    graph.subtract(power, one)
}
