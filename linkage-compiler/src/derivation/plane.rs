//! Vectors of the plane as expressions.

use std::collections::BTreeSet;

use crate::algebra::simplify;
use crate::graph::{Function, Graph, Node, NodeId};

/// A vector of the plane, or a complex number.
pub(super) type Vector = [NodeId; 2];

/// The product a b as complex numbers.
pub(super) fn turned(g: &mut Graph, [a, b]: Vector, [c, d]: Vector) -> Vector {
    let products = [(a, c), (b, d), (a, d), (b, c)].map(|(x, y)| g.multiply(x, y));
    [g.subtract(products[0], products[1]), g.add(products[2], products[3])]
}

pub(super) fn dot(g: &mut Graph, [a, b]: Vector, [c, d]: Vector) -> NodeId {
    let (x, y) = (g.multiply(a, c), g.multiply(b, d));
    g.add(x, y)
}

pub(super) fn cross(g: &mut Graph, [a, b]: Vector, [c, d]: Vector) -> NodeId {
    let (x, y) = (g.multiply(a, d), g.multiply(b, c));
    g.subtract(x, y)
}

/// The vector w with w . e = `along` and w x e = `across`.
pub(super) fn with_products(g: &mut Graph, e: Vector, square: NodeId, along: NodeId, across: NodeId) -> Vector {
    let minus = g.negate(across);
    let (x, y) = (dot(g, [along, across], e), dot(g, [along, minus], [e[1], e[0]]));
    [g.divide(x, square), g.divide(y, square)]
}

/// a / b as complex numbers, |b|^2 = `square`.
pub(super) fn quotient(g: &mut Graph, a: Vector, b: Vector, square: NodeId) -> Vector {
    let conjugate = [b[0], g.negate(b[1])];
    turned(g, a, conjugate).map(|part| g.divide(part, square))
}

/// |e|, simplified: for a single link its length.
pub(super) fn length(g: &mut Graph, [x, y]: Vector) -> NodeId {
    let modulus = g.call(Function::Hypot, &[x, y]);
    simplify(g, &[modulus], &BTreeSet::new())[0]
}

/// A length without its absolute values: for |l| it is l.
pub(super) fn unsigned(g: &mut Graph, length: NodeId) -> NodeId {
    let inside = |g: &Graph, id: NodeId| match g.node(id) {
        Node::Call(Function::Abs, arguments) => arguments[0],
        _ => id,
    };
    match g.node(length).clone() {
        Node::Product { coefficient, factors } => {
            let mut product = vec![(g.number(coefficient), 1)];
            product.extend(factors.into_iter().map(|(base, exponent)| (inside(g, base), exponent)));
            g.product(&product)
        }
        _ => inside(g, length),
    }
}

/// The square of a length: for |l| it is l^2.
pub(super) fn square_of(g: &mut Graph, length: NodeId) -> NodeId {
    let square = g.power(length, 2);
    simplify(g, &[square], &BTreeSet::new())[0]
}
