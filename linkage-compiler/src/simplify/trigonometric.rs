//! Trigonometric identities, for determinants.
//!
//! - sin a cos b - cos a sin b = sin(a - b)
//! - sin a cos b + cos a sin b = sin(a + b)
//! - cos a cos b + sin a sin b = cos(a - b), which for a = b is cos^2 + sin^2 = 1
//! - cos a cos b - sin a sin b = cos(a + b)
//!
//! The left sides subtract products of rounded sines and lose every digit where the links
//! are nearly parallel; the right sides keep them all for the angles as stored.

use std::collections::BTreeMap;

use super::rational::{Polynomial, factor, terms};
use crate::graph::{Function, Graph, Node, NodeId, Number};

/// A product of more terms than this is not multiplied out.
const MOST_TERMS: usize = 64;

/// a d - b c, multiplied out, with sines and cosines of sums and differences.
pub fn determinant(graph: &mut Graph, [[a, b], [c, d]]: [[NodeId; 2]; 2]) -> NodeId {
    let product = |x: NodeId, y: NodeId, sign: Number| {
        let (x, y) = (terms(graph, x), terms(graph, y));
        let mut polynomial = Polynomial::new();
        for (left, ours) in &x {
            for (right, theirs) in &y {
                let mut factors = ours.clone();
                for (&base, &exponent) in theirs {
                    *factors.entry(base).or_insert(0) += exponent;
                }
                factors.retain(|_, exponent| *exponent != 0);
                polynomial.push((left.multiply(*right).multiply(sign), factors));
            }
        }
        polynomial
    };
    let mut polynomial = product(a, d, Number::ONE);
    polynomial.extend(product(b, c, Number::MINUS_ONE));
    if polynomial.len() <= MOST_TERMS {
        while let Some(shorter) = combine_once(graph, &polynomial) {
            polynomial = shorter;
        }
        let sum = collect(graph, &polynomial);
        factor(graph, sum)
    } else {
        let (left, right) = (graph.multiply(a, d), graph.multiply(b, c));
        graph.subtract(left, right)
    }
}

fn collect(graph: &mut Graph, polynomial: &Polynomial) -> NodeId {
    let mut sum = Vec::new();
    for (coefficient, factors) in polynomial {
        let factors: Vec<_> = factors.iter().map(|(&base, &exponent)| (base, exponent)).collect();
        sum.push((*coefficient, graph.product(&factors)));
    }
    graph.sum(&sum)
}

/// A term seen as f(a) g(b) times the rest, f and g being sine or cosine.
struct Pair {
    sine: [bool; 2],
    angles: [NodeId; 2],
    rest: BTreeMap<NodeId, i32>,
}

/// Applies the identities to the first two terms they fit.
fn combine_once(graph: &mut Graph, polynomial: &Polynomial) -> Option<Polynomial> {
    let pairs: Vec<Vec<Pair>> = polynomial.iter().map(|(_, factors)| pairs(graph, factors)).collect();
    for first in 0..polynomial.len() {
        for second in first + 1..polynomial.len() {
            let (k, m) = (polynomial[first].0, polynomial[second].0);
            for left in &pairs[first] {
                for right in &pairs[second] {
                    let flipped = right.sine == [!left.sine[0], !left.sine[1]];
                    let fits = flipped && left.angles == right.angles && left.rest == right.rest;
                    if !fits || (k != m && k != m.negate()) {
                        continue;
                    }
                    let [a, b] = left.angles;
                    // The sign of the products of sines or of the second sine cosine pair.
                    let same = k == m;
                    let (function, minus) = match left.sine {
                        [true, false] | [false, true] => (Function::Sin, !same),
                        _ => (Function::Cos, same),
                    };
                    // Leading term: sin a cos b, or cos a cos b.
                    let leading = match left.sine {
                        [true, false] | [false, false] => k,
                        _ => m,
                    };
                    let angle = if minus { graph.subtract(a, b) } else { graph.add(a, b) };
                    let combined = graph.call(function, &[angle]);
                    let mut result: Polynomial = polynomial.clone();
                    result.remove(second);
                    let mut factors: Vec<_> = left.rest.iter().map(|(&base, &n)| (base, n)).collect();
                    factors.push((combined, 1));
                    let product = graph.product(&factors);
                    result.remove(first);
                    for (inner, factors) in terms(graph, product) {
                        result.push((leading.multiply(inner), factors));
                    }
                    return Some(result);
                }
            }
        }
    }
    None
}

fn pairs(graph: &Graph, factors: &BTreeMap<NodeId, i32>) -> Vec<Pair> {
    let mut circular = Vec::new();
    for (&base, &exponent) in factors {
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
            let mut rest = factors.clone();
            for base in [one.0, two.0] {
                if let Some(exponent) = rest.get_mut(&base) {
                    *exponent -= 1;
                }
            }
            rest.retain(|_, exponent| *exponent != 0);
            pairs.push(Pair { sine: [one.1, two.1], angles: [one.2, two.2], rest });
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn determinants_of_the_lecture_notes() {
        let mut g = Graph::default();
        let [z1, z2, z3, phi1, phi2, delta] = ["z1", "z2", "z3", "phi1", "phi2", "delta"].map(|name| {
            let symbol = g.symbol(name);
            g.variable(symbol)
        });
        let shifted = g.subtract(phi2, delta);
        let mut column = |modulus: NodeId, angle: NodeId| {
            let (sine, cosine) = (g.call(Function::Sin, &[angle]), g.call(Function::Cos, &[angle]));
            let x = g.multiply(modulus, sine);
            [g.negate(x), g.multiply(modulus, cosine)]
        };
        let [crank, rod, arm] = [column(z1, phi1), column(z2, phi2), column(z3, shifted)];
        let engine = determinant(&mut g, [[crank[0], rod[0]], [crank[1], rod[1]]]);
        assert_eq!(g.text(engine), "-z1*z2*sin(phi1 - phi2)");
        // Equation 1.1: the first column is that of z2 and z3 turned together, the second a unit vector.
        let (x, y) = (g.add(rod[0], arm[0]), g.add(rod[1], arm[1]));
        let (cosine, sine) = (g.call(Function::Cos, &[phi2]), g.call(Function::Sin, &[phi2]));
        let introductory = determinant(&mut g, [[x, cosine], [y, sine]]);
        assert_eq!(g.text(introductory), "-z2 - z3*cos(delta)");
    }
}
