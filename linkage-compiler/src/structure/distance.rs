//! Equations that give the length of a vector: |V| = f, or |V|^2 = f^2, in any of the forms in which they are written.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use crate::algebra::simplify;
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

/// A row k (|V| - f) or k (|V|^2 - f^2) with a number k and an f that does not depend on the unknowns.
#[derive(Debug, Clone, Copy)]
pub struct Distance {
    /// V.
    pub vector: [NodeId; 2],
    /// True if V is written as a vector; else it is not known which of its components is x.
    pub is_ordered: bool,
    /// f.
    pub length: NodeId,
    /// A number that is negative if there is no solution: f of |V| = f, f^2 of |V|^2 = f^2. `None` if it never is.
    pub bound: Option<NodeId>,
    /// w: the derivative of the row is w V . dV where |V| = f.
    pub weight: NodeId,
}

impl Distance {
    /// The distance that a row gives, `None` if it has another form.
    pub fn of(graph: &mut Graph, row: NodeId, unknowns: &[SymbolId]) -> Option<Self> {
        // A sum of one item is without a number before the sum.
        let row = graph.sum(&[(Number::ONE, row)]);
        let mut found = Self::as_written(graph, row, unknowns).or_else(|| Self::circle(graph, row, unknowns))?;
        // Of two squares, that of the cosine is the one of x.
        let has_cosine = |&part: &NodeId| {
            let cosine = |id| matches!(graph.node(id), Node::Call(Function::Cos, angle) if graph.depends_on(angle[0], unknowns[0]));
            graph.reachable(&[part]).into_iter().any(cosine)
        };
        let [x, y] = found.vector;
        if !found.is_ordered && has_cosine(&y) && !has_cosine(&x) {
            found.vector = [y, x];
        }
        Some(found)
    }

    fn as_written(graph: &mut Graph, row: NodeId, unknowns: &[SymbolId]) -> Option<Self> {
        let holds = |graph: &Graph, id: NodeId| unknowns.iter().any(|&unknown| graph.depends_on(id, unknown));
        let all = graph.terms(row);
        let (held, rest): (Vec<_>, Vec<_>) = all.into_iter().partition(|(_, term)| holds(graph, *term));
        let rest = graph.sum(&rest);
        let mut parts = held
            .into_iter()
            .map(|(coefficient, term)| split(graph, coefficient, term, |graph, (base, _)| holds(graph, base)));
        let (first, second, third) = (parts.next()??, parts.next(), parts.next());
        match (first, second, third) {
            ((factor, (base, exponent)), None, _) => match (norm(graph, base), exponent) {
                (Some((vector, is_ordered)), 1) => Some(Self { is_ordered, ..Self::norm(graph, vector, factor, rest) }),
                (Some((vector, is_ordered)), 2) => {
                    Some(Self { is_ordered, ..Self::square(graph, vector, factor, rest) })
                }
                (None, 2) => Some(Self::half(graph, base, factor, rest)),
                _ => None,
            },
            ((factor, (x, 2)), Some(Some((same, (y, 2)))), None) if factor == same => {
                Some(Self::square(graph, [x, y], factor, rest))
            }
            _ => None,
        }
    }

    /// k |V| + r
    fn norm(graph: &mut Graph, vector: [NodeId; 2], factor: Number, rest: NodeId) -> Self {
        let length = graph.scale(factor.power(-1).negate(), rest);
        // A length is positive where there is a solution, whatever its formula begins with.
        let positive = if graph.leads_negative(length) { graph.call(Function::Abs, &[length]) } else { length };
        let factor = graph.number(factor);
        let weight = graph.divide(factor, positive);
        let is_number = graph.constant_value(length).is_some_and(|length| length >= 0.0);
        Self { vector, is_ordered: false, length, bound: (!is_number).then_some(length), weight }
    }

    /// k |V|^2 + r
    fn square(graph: &mut Graph, vector: [NodeId; 2], factor: Number, rest: NodeId) -> Self {
        let square = graph.scale(factor.power(-1).negate(), rest);
        let weight = graph.number(factor.multiply(Number::integer(2)));
        let root = graph.call(Function::Sqrt, &[square]);
        let length = simplify(graph, &[root], &BTreeSet::new())[0];
        let has_root = |id: &NodeId| matches!(graph.node(*id), Node::Call(Function::Sqrt, _));
        let is_plain = match graph.constant_value(square) {
            Some(square) => square >= 0.0,
            None => !graph.reachable(&[length]).iter().any(has_root),
        };
        Self { vector, is_ordered: false, length, bound: (!is_plain).then_some(square), weight }
    }

    /// k x^2 + r: V = (x, h) if r is k h^2 plus other terms, else V = (x, 0).
    fn half(graph: &mut Graph, x: NodeId, factor: Number, rest: NodeId) -> Self {
        for (coefficient, term) in graph.terms(rest) {
            let is_square = |_: &Graph, (_, exponent): (NodeId, i32)| exponent == 2;
            let Some((same, (y, _))) = split(graph, coefficient, term, is_square) else { continue };
            if same == factor {
                let other = graph.sum(&[(Number::ONE, rest), (coefficient.negate(), term)]);
                return Self::square(graph, [x, y], factor, other);
            }
        }
        let zero = graph.zero();
        Self::square(graph, [x, zero], factor, rest)
    }

    /// A row whose second derivatives by x and y are 2 k, 2 k and 0: its centre is where its gradient vanishes.
    fn circle(graph: &mut Graph, row: NodeId, unknowns: &[SymbolId]) -> Option<Self> {
        let &[x, y] = unknowns else { return None };
        let half = Number::ratio(1, 2);
        let gradient = [x, y].map(|unknown| graph.partial(&[row], unknown)[0]);
        let [of_x, of_y] = [x, y].map(|unknown| graph.partial(&gradient, unknown));
        let factor = graph.as_number(of_x[0]).filter(|factor| !factor.is_zero())?;
        let is_round = of_x[0] == of_y[1] && graph.is_zero(of_x[1]) && graph.is_zero(of_y[0]);
        is_round.then_some(())?;
        let variables = [x, y].map(|unknown| graph.variable(unknown));
        let zero = graph.zero();
        let by: FxHashMap<_, _> = variables.iter().map(|&variable| (variable, zero)).collect();
        let centre: Vec<NodeId> = graph
            .replace(&gradient, &by)
            .into_iter()
            .map(|slope| {
                let part = graph.scale(factor.power(-1).negate(), slope);
                simplify(graph, &[part], &BTreeSet::new())[0]
            })
            .collect();
        let by: FxHashMap<_, _> = variables.iter().copied().zip(centre.iter().copied()).collect();
        let least = graph.replace(&[row], &by)[0];
        let vector = [graph.subtract(variables[0], centre[0]), graph.subtract(variables[1], centre[1])];
        let least = simplify(graph, &[least], &BTreeSet::new())[0];
        Some(Self::square(graph, vector, factor.multiply(half), least))
    }
}

/// Splits a term into a number and the only power that has a property; `None` if there are other factors.
fn split(
    graph: &Graph,
    coefficient: Number,
    term: NodeId,
    has: impl Fn(&Graph, (NodeId, i32)) -> bool,
) -> Option<(Number, (NodeId, i32))> {
    let (inner, factors) = match graph.node(term) {
        Node::Product { coefficient, factors } => (*coefficient, factors.clone()),
        _ => (Number::ONE, vec![(term, 1)]),
    };
    match factors.as_slice() {
        &[power] if has(graph, power) => Some((coefficient.multiply(inner), power)),
        _ => None,
    }
}

/// V of |V| = hypot(x, y) = sqrt(x^2 + y^2), and true for the first.
fn norm(graph: &mut Graph, id: NodeId) -> Option<([NodeId; 2], bool)> {
    match graph.node(id).clone() {
        Node::Call(Function::Hypot, arguments) => Some(([arguments[0], arguments[1]], true)),
        Node::Call(Function::Sqrt, arguments) => {
            let terms = graph.terms(arguments[0]);
            let &[x, y] = terms.as_slice() else { return None };
            let square = |(coefficient, term)| {
                let (factor, (base, _)) = split(graph, coefficient, term, |_, (_, exponent)| exponent == 2)?;
                factor.is_one().then_some(base)
            };
            Some(([square(x)?, square(y)?], false))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// V = (x - p cos t, y - p sin t), and rows that give its length.
    struct Circle {
        graph: Graph,
        point: [SymbolId; 2],
        centre: [NodeId; 2],
        length: NodeId,
    }

    impl Circle {
        fn new() -> Self {
            let mut graph = Graph::default();
            let point = ["x", "y"].map(|name| graph.symbol(name));
            let [p, t, length] = ["p", "t", "b"].map(|name| {
                let symbol = graph.symbol(name);
                graph.variable(symbol)
            });
            let centre = [Function::Cos, Function::Sin].map(|function| {
                let part = graph.call(function, &[t]);
                graph.multiply(p, part)
            });
            Self { graph, point, centre, length }
        }

        fn vector(&mut self) -> [NodeId; 2] {
            [0, 1].map(|axis| {
                let variable = self.graph.variable(self.point[axis]);
                self.graph.subtract(variable, self.centre[axis])
            })
        }

        /// k (f - b^n)
        fn row(&mut self, factor: Number, f: NodeId, power: i32) -> NodeId {
            let length = self.graph.power(self.length, power);
            let row = self.graph.subtract(f, length);
            self.graph.scale(factor, row)
        }

        fn check(&mut self, row: NodeId, length: &str, bound: Option<&str>, weight: &str) {
            let text = self.graph.text(row);
            let found = Distance::of(&mut self.graph, row, &self.point).expect(&text);
            let vector = self.vector();
            assert_eq!(found.vector, vector, "{text}");
            assert_eq!(self.graph.text(found.length), length, "{text}");
            assert_eq!(found.bound.map(|bound| self.graph.text(bound)).as_deref(), bound, "{text}");
            assert_eq!(self.graph.text(found.weight), weight, "{text}");
        }
    }

    #[test]
    fn every_form_of_a_distance() {
        let mut circle = Circle::new();
        let [x, y] = circle.vector();
        let g = &mut circle.graph;
        let squares = [x, y].map(|part| (Number::ONE, g.power(part, 2)));
        let (norm, sum) = (g.call(Function::Hypot, &[x, y]), g.sum(&squares));
        let (root, norm_squared) = (g.call(Function::Sqrt, &[sum]), g.power(norm, 2));
        let expanded = {
            let terms: Vec<_> = [(x, 0), (y, 1)]
                .into_iter()
                .flat_map(|(_, axis)| {
                    let (variable, centre) = (g.variable(circle.point[axis]), circle.centre[axis]);
                    let (square, mixed, constant) =
                        (g.power(variable, 2), g.multiply(variable, centre), g.power(centre, 2));
                    [(Number::ONE, square), (Number::integer(-2), mixed), (Number::ONE, constant)]
                })
                .collect();
            g.sum(&terms)
        };
        for f in [norm, root] {
            let row = circle.row(Number::integer(3), f, 1);
            circle.check(row, "b", Some("b"), "3/b");
        }
        for f in [sum, norm_squared, expanded] {
            let row = circle.row(Number::integer(-3), f, 2);
            circle.check(row, "abs(b)", None, "-6");
        }
    }
}
