//! Square roots of squares.
//!
//! - sqrt(x^2) = |x|
//! - hypot(x, y) = sqrt(x^2 + y^2), where the sum of the squares is a square itself: the distance
//!   between two joints of one link, for instance
//! - |x|^2 = x^2, |x y| = |x| |y| for a number x

use super::rational::{self, Monomial};
use super::trigonometric;
use crate::graph::{Function, Graph, Node, NodeId, Number};

/// Another form of a root or an absolute value, if there is one.
pub(super) fn form(graph: &mut Graph, id: NodeId) -> Option<NodeId> {
    match graph.node(id).clone() {
        Node::Call(Function::Sqrt, arguments) => root(graph, arguments[0]),
        Node::Call(Function::Hypot, arguments) => {
            let squares = [arguments[0], arguments[1]].map(|x| (Number::ONE, graph.power(x, 2)));
            let sum = graph.sum(&squares);
            let (plain, expanded) = (rational::terms(graph, sum), rational::expanded(graph, sum));
            [Some(plain), expanded].into_iter().flatten().find_map(|polynomial| {
                let combined = trigonometric::combine(graph, polynomial);
                let sum = rational::collect(graph, &combined);
                root(graph, sum)
            })
        }
        Node::Call(Function::Abs, arguments) => {
            let Node::Product { coefficient, factors } = graph.node(arguments[0]).clone() else { return None };
            if coefficient.is_one() {
                return None;
            }
            let rest = graph.product(&factors);
            let modulus = graph.call(Function::Abs, &[rest]);
            Some(graph.scale(coefficient.absolute(), modulus))
        }
        Node::Product { coefficient, factors } => {
            let is_modulus = |graph: &Graph, base: NodeId, n: i32| -> Option<NodeId> {
                match graph.node(base) {
                    Node::Call(Function::Abs, x) if n % 2 == 0 => Some(x[0]),
                    _ => None,
                }
            };
            if !factors.iter().any(|&(base, n)| is_modulus(graph, base, n).is_some()) {
                return None;
            }
            let mut product = vec![(graph.number(coefficient), 1)];
            product.extend(factors.iter().map(|&(base, n)| (is_modulus(graph, base, n).unwrap_or(base), n)));
            Some(graph.product(&product))
        }
        _ => None,
    }
}

/// sqrt(k x^2m y^2n) = sqrt(k) |x|^m |y|^n for a square k.
fn root(graph: &mut Graph, id: NodeId) -> Option<NodeId> {
    let (coefficient, monomial) = match graph.node(id).clone() {
        Node::Product { coefficient, factors } => (coefficient, factors.into_iter().collect()),
        Node::Constant(number) => (number, Monomial::new()),
        _ => return None,
    };
    if monomial.values().any(|n| n % 2 != 0) {
        return None;
    }
    let number = graph.number(coefficient);
    let root = graph.call(Function::Sqrt, &[number]);
    graph.as_number(root)?;
    let mut product = vec![(root, 1)];
    for (base, n) in monomial {
        product.push((graph.call(Function::Abs, &[base]), n / 2));
    }
    Some(graph.product(&product))
}
