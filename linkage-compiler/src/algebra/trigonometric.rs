//! Trigonometric identities.
//!
//! - sin a cos b - cos a sin b = sin(a - b)
//! - sin a cos b + cos a sin b = sin(a + b)
//! - cos a cos b + sin a sin b = cos(a - b)
//! - cos a cos b - sin a sin b = cos(a + b)
//! - k sin^2 a + m cos^2 a = k + (m - k) cos^2 a, which for k = m is cos^2 + sin^2 = 1
//!
//! From left to right there are fewer sines, and cancellation is avoided: the difference of products loses all digits
//! if two links are nearly parallel, the sine of the difference does not. Where the sines on the left are computed
//! anyway, the identities are applied from right to left.

use std::collections::BTreeMap;

use super::rational::{Monomial, Polynomial};
use crate::graph::{Function, Graph, Node, NodeId, Number};

/// A term as f(a) g(b) times other factors, where f and g are sine or cosine. The node a is not newer than b, so that a
/// term has one such form for each choice of f and g.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Pair {
    /// a and b.
    angles: [NodeId; 2],
    /// The other factors, with their exponents.
    rest: Vec<(NodeId, i32)>,
    /// True for f and g that are sines.
    sine: [bool; 2],
}

impl Pair {
    /// The pair that an identity combines with this one: sines for cosines and cosines for sines.
    fn partner(&self) -> Self {
        Self { sine: self.sine.map(|sine| !sine), ..self.clone() }
    }
}

/// Applies the identities from left to right until none matches.
pub(super) fn combine(graph: &mut Graph, mut polynomial: Polynomial) -> Polynomial {
    // Terminates: each step combines two terms into one or removes a squared sine.
    while graph.budget().spend(polynomial.len()).is_ok()
        && let Some(shorter) = combine_once(graph, &polynomial)
    {
        polynomial = shorter;
    }
    polynomial
}

/// Applies an identity to the first two terms that match one.
fn combine_once(graph: &mut Graph, polynomial: &Polynomial) -> Option<Polynomial> {
    let mut seen: BTreeMap<Pair, usize> = BTreeMap::new();
    let mut squares = None;
    for (second, (m, monomial)) in polynomial.iter().enumerate() {
        let pairs = pairs(graph, monomial);
        for right in &pairs {
            let Some(&first) = seen.get(&right.partner()) else { continue };
            let k = polynomial[first].0;
            if k == *m || k == m.negate() {
                let (rest, combined) = join(graph, &right.partner(), k, *m);
                return Some(replaced(polynomial, [first, second], [(rest, combined)]));
            }
            if right.angles[0] == right.angles[1] && squares.is_none() {
                squares = Some((first, second, right.clone()));
            }
        }
        for pair in pairs {
            seen.entry(pair).or_insert(second);
        }
    }
    let (first, second, right) = squares?;
    let (k, m) = (polynomial[first].0, polynomial[second].0);
    let (k, m) = if right.sine == [true; 2] { (m, k) } else { (k, m) };
    let rest: Monomial = right.rest.iter().copied().collect();
    let cosine = graph.call(Function::Cos, &[right.angles[0]]);
    let mut squared = rest.clone();
    *squared.entry(cosine).or_insert(0) += 2;
    Some(replaced(polynomial, [first, second], [(k, rest), (m.plus(k.negate()), squared)]))
}

/// The sum of k times `left` and m times its partner as one term, for k = m and k = -m.
fn join(graph: &mut Graph, left: &Pair, k: Number, m: Number) -> (Number, Monomial) {
    let [a, b] = left.angles;
    let same = k == m;
    let (function, minus) = match left.sine {
        [true, false] | [false, true] => (Function::Sin, !same),
        _ => (Function::Cos, same),
    };
    // The coefficient of sin a cos b, or of cos a cos b.
    let leading = match left.sine {
        [true, false] | [false, false] => k,
        _ => m,
    };
    let angle = if minus { graph.subtract(a, b) } else { graph.add(a, b) };
    let combined = graph.call(function, &[angle]);
    let mut factors = left.rest.clone();
    factors.push((combined, 1));
    let product = graph.product(&factors);
    match graph.node(product).clone() {
        Node::Constant(value) => (leading.multiply(value), Monomial::new()),
        Node::Product { coefficient, factors } => (leading.multiply(coefficient), factors.into_iter().collect()),
        _ => (leading, Monomial::from([(product, 1)])),
    }
}

/// The polynomial without the terms at the indices `gone`, and with new ones that are not zero.
fn replaced<const N: usize>(polynomial: &Polynomial, gone: [usize; 2], new: [(Number, Monomial); N]) -> Polynomial {
    let kept = polynomial.iter().enumerate().filter(|(index, _)| !gone.contains(index)).map(|(_, term)| term.clone());
    let new = new.into_iter().filter(|(coefficient, _)| !coefficient.is_zero());
    kept.chain(new).collect()
}

/// All ways to write a term as a product of two sines or cosines and other factors.
fn pairs(graph: &Graph, monomial: &Monomial) -> Vec<Pair> {
    let mut circular = Vec::new();
    for (&base, &exponent) in monomial {
        if let Node::Call(function @ (Function::Sin | Function::Cos), arguments) = graph.node(base) {
            let one = (base, *function == Function::Sin, arguments[0]);
            circular.extend(std::iter::repeat_n(one, usize::try_from(exponent.clamp(0, 2)).unwrap_or(0)));
        }
    }
    let mut pairs = Vec::new();
    for i in 0..circular.len() {
        for j in i + 1..circular.len() {
            let (mut one, mut two) = (circular[i], circular[j]);
            if one.2 > two.2 {
                (one, two) = (two, one);
            }
            let mut rest = monomial.clone();
            for base in [one.0, two.0] {
                if let Some(exponent) = rest.get_mut(&base) {
                    *exponent -= 1;
                }
            }
            let rest = rest.into_iter().filter(|(_, exponent)| *exponent != 0).collect();
            pairs.push(Pair { sine: [one.1, two.1], angles: [one.2, two.2], rest });
        }
    }
    pairs
}

/// Applies an identity from right to left: expands the sine or cosine of a sum of two terms.
pub(super) fn spread(graph: &mut Graph, id: NodeId) -> Option<NodeId> {
    let Node::Call(function @ (Function::Sin | Function::Cos), angle) = graph.node(id).clone() else { return None };
    let Node::Sum { constant, terms } = graph.node(angle[0]).clone() else { return None };
    let (&[(k, a), (m, b)], true) = (terms.as_slice(), constant.is_zero()) else { return None };
    let (a, b) = (graph.scale(k, a), graph.scale(m.absolute(), b));
    let [sin_a, cos_a, sin_b, cos_b] = [(Function::Sin, a), (Function::Cos, a), (Function::Sin, b), (Function::Cos, b)]
        .map(|(function, angle)| graph.call(function, &[angle]));
    let ((first, second), minus) = match function {
        Function::Sin => ((graph.multiply(sin_a, cos_b), graph.multiply(cos_a, sin_b)), m.is_negative()),
        _ => ((graph.multiply(cos_a, cos_b), graph.multiply(sin_a, sin_b)), !m.is_negative()),
    };
    Some(if minus { graph.subtract(first, second) } else { graph.add(first, second) })
}
