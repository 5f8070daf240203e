//! 2 x 2 determinants, and Cramer's rule.
//!
//! Expanded, simplified by trigonometric identities and factored, the determinant of two link vectors becomes the
//! product of their lengths and the sine of the angle between them. The numerators of Cramer's rule are determinants,
//! too, so that common lengths cancel.

use super::rational::{MOST_TERMS, collect, factor, multiply, terms};
use super::trigonometric::combine;
use crate::graph::{Graph, NodeId, Number};

/// a d - b c.
pub fn determinant(graph: &mut Graph, [[a, b], [c, d]]: [[NodeId; 2]; 2]) -> NodeId {
    let mut product = |x: NodeId, y: NodeId| {
        let (x, y) = (terms(graph, x), terms(graph, y));
        multiply(graph, &x, &y)
    };
    if let (Some(mut polynomial), Some(other)) = (product(a, d), product(b, c))
        && polynomial.len() + other.len() <= MOST_TERMS
    {
        polynomial.extend(other.into_iter().map(|(coefficient, monomial)| (coefficient.negate(), monomial)));
        let polynomial = combine(graph, polynomial);
        let sum = collect(graph, &polynomial);
        return factor(graph, sum);
    }
    let (left, right) = (graph.multiply(a, d), graph.multiply(b, c));
    graph.subtract(left, right)
}

/// The solution of J x = r by Cramer's rule; `whole` is det J.
pub fn cramer(
    graph: &mut Graph,
    [[a, b], [c, d]]: [[NodeId; 2]; 2],
    whole: NodeId,
    [p, q]: [NodeId; 2],
) -> [NodeId; 2] {
    [[[p, b], [q, d]], [[a, p], [c, q]]].map(|matrix| {
        let above = determinant(graph, matrix);
        graph.divide(above, whole)
    })
}

/// adj J, so that J^-1 = adj J / det J.
pub fn adjugate(graph: &mut Graph, [[a, b], [c, d]]: [[NodeId; 2]; 2]) -> [[NodeId; 2]; 2] {
    [[d, graph.scale(Number::MINUS_ONE, b)], [graph.scale(Number::MINUS_ONE, c), a]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Function;

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
        // Equation 1.1: the first column is the vector z2 + z3 rotated by 90 degrees, the second a unit vector.
        let (x, y) = (g.add(rod[0], arm[0]), g.add(rod[1], arm[1]));
        let (cosine, sine) = (g.call(Function::Cos, &[phi2]), g.call(Function::Sin, &[phi2]));
        let introductory = determinant(&mut g, [[x, cosine], [y, sine]]);
        assert_eq!(g.text(introductory), "-z2 - z3*cos(delta)");
    }
    /// The nine products of their parts, 18 terms before they are combined, are within the limit of work.
    #[test]
    fn links_of_three_parts_each_give_nine_sines() {
        let mut g = Graph::default();
        let names = [("a", "alpha"), ("b", "beta"), ("c", "gamma"), ("p", "phi"), ("q", "psi"), ("r", "chi")];
        let parts = names.map(|names| {
            <[&str; 2]>::from(names).map(|name| {
                let symbol = g.symbol(name);
                g.variable(symbol)
            })
        });
        let (one, other) = parts.split_at(3);
        let [left, right] = [one, other].map(|parts| {
            [Function::Cos, Function::Sin].map(|function| {
                let terms: Vec<_> = parts
                    .iter()
                    .map(|&[length, angle]| {
                        let component = g.call(function, &[angle]);
                        (Number::ONE, g.multiply(length, component))
                    })
                    .collect();
                g.sum(&terms)
            })
        });
        let found = determinant(&mut g, [[left[0], right[0]], [left[1], right[1]]]);
        let mut sines = Vec::new();
        for &[length, angle] in one {
            for &[other_length, other_angle] in other {
                let between = g.subtract(other_angle, angle);
                let sine = g.call(Function::Sin, &[between]);
                sines.push((Number::ONE, g.product(&[(length, 1), (other_length, 1), (sine, 1)])));
            }
        }
        let expected = g.sum(&sines);
        assert_eq!(g.text(found), g.text(expected));
    }
    /// Nothing of the entry opposite to a zero is left to be taken for a term of the other product.
    #[test]
    fn a_zero_hides_no_identity() {
        let mut g = Graph::default();
        let [phi, psi] = ["phi", "psi"].map(|name| {
            let symbol = g.symbol(name);
            g.variable(symbol)
        });
        let mut product = |of_phi, of_psi| {
            let (one, other) = (g.call(of_phi, &[phi]), g.call(of_psi, &[psi]));
            g.multiply(one, other)
        };
        let (left, right) = (product(Function::Sin, Function::Cos), product(Function::Cos, Function::Sin));
        let (difference, zero, one) = (g.subtract(left, right), g.number(Number::ZERO), g.one());
        let found = determinant(&mut g, [[zero, one], [difference, left]]);
        assert_eq!(g.text(found), "-sin(phi - psi)");
    }
}
