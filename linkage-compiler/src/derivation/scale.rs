//! Upper bounds of expressions at given lengths: the scales that make checks independent of units.

use crate::graph::{Function, Graph, Node, NodeId, Number};

/// An upper bound of the magnitude of a determinant. For a product without sums it is the product without its sines and
/// cosines, which shares its factors with the determinant.
pub(super) fn of_determinant(graph: &mut Graph, id: NodeId) -> NodeId {
    let Node::Product { coefficient, factors } = graph.node(id).clone() else { return of(graph, id) };
    if factors.iter().any(|(base, _)| matches!(graph.node(*base), Node::Sum { .. })) {
        return of(graph, id);
    }
    let mut product = vec![(graph.number(coefficient.absolute()), 1)];
    product.extend(factors.into_iter().filter(|(base, exponent)| {
        *exponent < 0 || !matches!(graph.node(*base), Node::Call(Function::Sin | Function::Cos, _))
    }));
    graph.product(&product)
}

/// The sum of the absolute values of the terms, with every sine and cosine replaced by 1.
///
/// It has the unit of the expression, so that their quotient is dimensionless: scaling all lengths by a power of two
/// changes no bit of it.
pub(super) fn of(graph: &mut Graph, id: NodeId) -> NodeId {
    match graph.node(id).clone() {
        Node::Constant(value) => graph.number(value.absolute()),
        Node::Sum { constant, terms } => {
            let constant = graph.number(constant.absolute());
            let mut sum = vec![(Number::ONE, constant)];
            for (coefficient, term) in terms {
                sum.push((coefficient.absolute(), of_product(graph, term)));
            }
            graph.sum(&sum)
        }
        _ => of_product(graph, id),
    }
}

fn of_product(graph: &mut Graph, id: NodeId) -> NodeId {
    let (coefficient, factors) = match graph.node(id).clone() {
        Node::Product { coefficient, factors } => (coefficient.absolute(), factors),
        _ => (Number::ONE, vec![(id, 1)]),
    };
    let mut product = vec![(graph.number(coefficient), 1)];
    for (base, exponent) in factors {
        let bounded = matches!(graph.node(base), Node::Call(Function::Sin | Function::Cos, _));
        if bounded && exponent > 0 {
            continue;
        }
        if exponent > 0 && matches!(graph.node(base), Node::Sum { .. }) {
            let inner = of_sum_once(graph, base);
            product.push((inner, exponent));
        } else {
            product.push((graph.call(Function::Abs, &[base]), exponent));
        }
    }
    graph.product(&product)
}

/// The sum of the absolute values of the terms of a sum inside a product; sums inside these terms are not expanded.
fn of_sum_once(graph: &mut Graph, id: NodeId) -> NodeId {
    let Node::Sum { constant, terms } = graph.node(id).clone() else { return id };
    let constant = graph.number(constant.absolute());
    let mut sum = vec![(Number::ONE, constant)];
    for (coefficient, term) in terms {
        let factors = match graph.node(term).clone() {
            Node::Product { factors, .. } => factors,
            _ => vec![(term, 1)],
        };
        let mut product = Vec::new();
        for (base, exponent) in factors {
            let bounded = matches!(graph.node(base), Node::Call(Function::Sin | Function::Cos, _)) && exponent > 0;
            if !bounded {
                product.push((graph.call(Function::Abs, &[base]), exponent));
            }
        }
        sum.push((coefficient.absolute(), graph.product(&product)));
    }
    graph.sum(&sum)
}
