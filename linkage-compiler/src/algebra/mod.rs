//! Simplification: identities that make formulas shorter or more accurate.
//!
//! The modules `rational`, `trigonometric`, `modulus` and `determinant` compute other forms of an expression, of which
//! the one of least [`cost()`] is used; the tests prove that all forms are equal. The graph records the conditions that
//! an identity assumes, such as a divisor that is not zero.

pub mod cost;
mod determinant;
mod modulus;
mod rational;
mod trigonometric;

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use crate::graph::{Condition, Graph, Node, NodeId, Number};
use cost::{Cost, cost};
pub use determinant::{adjugate, cramer, determinant};
use rational::Polynomial;
pub use rational::{factor, gather};

/// The largest number of times that all identities are tried on one node. Each time makes it cheaper or is the last; at
/// most three have been observed.
const MOST_ROUNDS: usize = 8;

/// The largest number of nodes of an expression that is simplified: the work grows with the square of this number, and
/// longer formulas are not printed.
const LARGEST: usize = 400;

/// Returns the cheapest form of each root that the identities find. The sines and cosines of the angles in `given` cost
/// nothing: they are computed anyway. Expressions of more than `LARGEST` nodes are not changed.
pub fn simplify(graph: &mut Graph, roots: &[NodeId], given: &BTreeSet<NodeId>) -> Vec<NodeId> {
    let mut better: FxHashMap<NodeId, NodeId> = FxHashMap::default();
    let nodes = graph.reachable(roots);
    if nodes.len() > LARGEST {
        return roots.to_vec();
    }
    for id in nodes {
        let rebuilt = graph.rebuilt(id, &better);
        let mut forms = Forms { given, best: rebuilt, cost: cost(graph, rebuilt, given), conditions: BTreeSet::new() };
        // The result of one identity may allow another.
        for _ in 0..MOST_ROUNDS {
            let before = forms.best;
            forms.offer_all(graph, before);
            if forms.best == before || graph.budget().check().is_err() {
                break;
            }
        }
        graph.assume(forms.conditions);
        better.insert(id, forms.best);
    }
    roots.iter().map(|root| better[root]).collect()
}

/// The cheapest form of one node so far, and the conditions that it assumes.
struct Forms<'a> {
    given: &'a BTreeSet<NodeId>,
    best: NodeId,
    cost: Cost,
    conditions: BTreeSet<Condition>,
}

impl Forms<'_> {
    /// Tries another form; it replaces the best one if it is cheaper.
    fn offer(&mut self, graph: &mut Graph, form: impl FnOnce(&mut Graph) -> Option<NodeId>) {
        let Some((form, conditions)) = graph.attempt(form) else { return };
        let cost = cost(graph, form, self.given);
        if cost < self.cost {
            (self.best, self.cost) = (form, cost);
            self.conditions.extend(conditions);
        }
    }

    /// Tries the forms of a node that the identities give.
    fn offer_all(&mut self, graph: &mut Graph, id: NodeId) {
        match graph.node(id).clone() {
            Node::Sum { terms, .. } if terms.len() <= rational::MOST_TERMS => self.offer_forms_of_sum(graph, id),
            Node::Product { coefficient, factors } => {
                self.offer(graph, |graph| modulus::form(graph, id));
                self.offer_forms_of_product(graph, id, coefficient, &factors);
            }
            Node::Call(_, arguments) => {
                self.offer(graph, |graph| modulus::form(graph, id));
                if !self.given.contains(&arguments[0]) {
                    self.offer(graph, |graph| trigonometric::spread(graph, id));
                }
            }
            _ => {}
        }
    }

    fn offer_forms_of_sum(&mut self, graph: &mut Graph, id: NodeId) {
        self.offer(graph, |graph| Some(rational::factor(graph, id)));
        self.offer_polynomial(graph, |graph| Some(rational::terms(graph, id)));
        self.offer_polynomial(graph, |graph| rational::expanded(graph, id));
    }

    /// Tries a polynomial, its trigonometric terms combined and its common factors factored out.
    fn offer_polynomial(&mut self, graph: &mut Graph, polynomial: impl FnOnce(&mut Graph) -> Option<Polynomial>) {
        self.offer(graph, |graph| {
            let polynomial = polynomial(graph)?;
            let combined = trigonometric::combine(graph, polynomial);
            let sum = rational::collect(graph, &combined);
            Some(rational::factor(graph, sum))
        });
    }

    fn offer_forms_of_product(
        &mut self,
        graph: &mut Graph,
        id: NodeId,
        coefficient: Number,
        factors: &[(NodeId, i32)],
    ) {
        self.offer_polynomial(graph, |graph| rational::expanded(graph, id).filter(|polynomial| polynomial.len() > 1));
        let sums = |sign: i32| factors.iter().filter(move |(_, n)| n.signum() == sign);
        for &(above, _) in sums(1) {
            for &(below, _) in sums(-1) {
                let are_sums = [above, below].iter().all(|&base| matches!(graph.node(base), Node::Sum { .. }));
                if are_sums {
                    self.offer(graph, |graph| {
                        let quotient = rational::quotient(graph, above, below)?;
                        graph.assume(BTreeSet::from([Condition::NonZero(below)]));
                        // Build the product from its factors, so that no other cancellation is recorded as a condition.
                        let mut product: Vec<_> = factors
                            .iter()
                            .map(|&(base, n)| (base, n - i32::from(base == above) + i32::from(base == below)))
                            .collect();
                        product.extend([(quotient, 1), (graph.number(coefficient), 1)]);
                        Some(graph.product(&product))
                    });
                }
            }
        }
    }
}
