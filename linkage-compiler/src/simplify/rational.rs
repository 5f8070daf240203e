//! Rational identities.
//!
//! - common factors: a b + a c = a (b + c)

use std::collections::BTreeMap;

use crate::graph::{Graph, Node, NodeId, Number};

/// Takes the common factors out of a sum; any other node is returned as it is.
pub fn factor(graph: &mut Graph, id: NodeId) -> NodeId {
    let Node::Sum { constant, terms } = graph.node(id).clone() else { return id };
    if !constant.is_zero() {
        return id;
    }
    let mut common: Option<BTreeMap<NodeId, i32>> = None;
    for &(_, term) in &terms {
        let factors: BTreeMap<NodeId, i32> = factors(graph, term).into_iter().collect();
        common = Some(match common {
            None => factors,
            // Powers of one sign only: x + 1/x is not x times something shorter.
            Some(common) => common
                .into_iter()
                .filter_map(|(base, n)| {
                    let m = *factors.get(&base)?;
                    (n.signum() == m.signum()).then(|| (base, if n > 0 { n.min(m) } else { n.max(m) }))
                })
                .collect(),
        });
    }
    let common: Vec<(NodeId, i32)> = common.unwrap_or_default().into_iter().collect();
    if common.is_empty() {
        return id;
    }
    let inverse: Vec<_> = common.iter().map(|&(base, n)| (base, -n)).collect();
    let mut rest = Vec::new();
    for (coefficient, term) in terms {
        let mut items = vec![(term, 1)];
        items.extend(&inverse);
        rest.push((coefficient, graph.product(&items)));
    }
    let mut product = common;
    product.push((graph.sum(&rest), 1));
    graph.product(&product)
}

/// base^exponent of a term without coefficient.
pub(super) fn factors(graph: &Graph, term: NodeId) -> Vec<(NodeId, i32)> {
    match graph.node(term) {
        Node::Product { factors, .. } => factors.clone(),
        _ => vec![(term, 1)],
    }
}

/// A sum of coefficient * product of base^exponent.
pub(super) type Polynomial = Vec<(Number, BTreeMap<NodeId, i32>)>;

/// The terms of a node, one level deep.
pub(super) fn terms(graph: &Graph, id: NodeId) -> Polynomial {
    match graph.node(id) {
        Node::Sum { constant, terms } => {
            let mut polynomial: Polynomial = terms
                .iter()
                .map(|&(coefficient, term)| (coefficient, factors(graph, term).into_iter().collect()))
                .collect();
            if !constant.is_zero() {
                polynomial.push((*constant, BTreeMap::new()));
            }
            polynomial
        }
        Node::Constant(value) if value.is_zero() => Vec::new(),
        Node::Constant(value) => vec![(*value, BTreeMap::new())],
        Node::Product { coefficient, factors } => vec![(*coefficient, factors.iter().copied().collect())],
        _ => vec![(Number::ONE, BTreeMap::from([(id, 1)]))],
    }
}
