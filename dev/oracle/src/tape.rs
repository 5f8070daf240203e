//! A graph as a list of steps, evaluated in any scalar.

use std::collections::{HashMap, HashSet};

use linkage_compiler::graph::{External, Function, Graph, Node, NodeId, Number, SymbolId};

use crate::precise::Scalar;

/// An operation on the values of the steps before.
enum Step {
    Constant(Number),
    Pi,
    Symbol(SymbolId),
    Sum { constant: Number, terms: Vec<(Number, usize)> },
    Product { coefficient: Number, factors: Vec<(usize, i32)> },
    Call(Function, Vec<usize>),
    External(External, Vec<usize>),
}

/// Expressions in an order in which they can be evaluated; those that depend on changing symbols come last.
pub struct Tape {
    steps: Vec<Step>,
    /// The number of steps before those that depend on changing symbols.
    fixed: usize,
    roots: Vec<usize>,
}

impl Tape {
    /// The values of `roots`, for repeated evaluation with `changing` symbols.
    pub fn new(graph: &Graph, roots: &[NodeId], changing: &[SymbolId]) -> Self {
        let order = graph.reachable(roots);
        let mut changes = HashSet::new();
        for &id in &order {
            let of_child = |child: &NodeId| changes.contains(child);
            let is_changing = match graph.node(id) {
                Node::Symbol(symbol) => changing.contains(symbol),
                Node::Sum { terms, .. } => terms.iter().any(|(_, term)| of_child(term)),
                Node::Product { factors, .. } => factors.iter().any(|(base, _)| of_child(base)),
                Node::Call(_, arguments) | Node::External(_, arguments) => arguments.iter().any(of_child),
                Node::Constant(_) | Node::Pi => false,
            };
            if is_changing {
                changes.insert(id);
            }
        }
        let (last, first): (Vec<NodeId>, Vec<NodeId>) = order.into_iter().partition(|id| changes.contains(id));
        let fixed = first.len();
        let order = [first, last].concat();
        let places: HashMap<NodeId, usize> = order.iter().enumerate().map(|(place, &id)| (id, place)).collect();
        let all = |ids: &[NodeId]| ids.iter().map(|id| places[id]).collect::<Vec<_>>();
        let step = |&id: &NodeId| match graph.node(id) {
            Node::Constant(number) => Step::Constant(*number),
            Node::Pi => Step::Pi,
            Node::Symbol(symbol) => Step::Symbol(*symbol),
            Node::Sum { constant, terms } => Step::Sum {
                constant: *constant,
                terms: terms.iter().map(|(factor, term)| (*factor, places[term])).collect(),
            },
            Node::Product { coefficient, factors } => Step::Product {
                coefficient: *coefficient,
                factors: factors.iter().map(|(base, exponent)| (places[base], *exponent)).collect(),
            },
            Node::Call(function, arguments) => Step::Call(*function, all(arguments)),
            Node::External(external, arguments) => Step::External(external.clone(), all(arguments)),
        };
        Self { steps: order.iter().map(step).collect(), fixed, roots: all(roots) }
    }

    /// The values of the roots. `external` has the values of user functions in doubles, which are taken for exact: they
    /// are data.
    pub fn evaluate<S: Scalar>(
        &self,
        bind: impl Fn(SymbolId) -> S,
        external: impl Fn(&External, &[f64]) -> f64,
    ) -> Vec<S> {
        self.evaluate_again(&mut Vec::new(), bind, external)
    }

    /// The values of the roots, where `values` are those of all steps from the last evaluation, or empty: steps that
    /// depend on no changing symbol are not repeated.
    pub fn evaluate_again<S: Scalar>(
        &self,
        values: &mut Vec<S>,
        bind: impl Fn(SymbolId) -> S,
        external: impl Fn(&External, &[f64]) -> f64,
    ) -> Vec<S> {
        values.truncate(self.fixed);
        for step in &self.steps[values.len()..] {
            let value = step.value(values, &bind, &external);
            values.push(value);
        }
        self.roots.iter().map(|&root| values[root].clone()).collect()
    }

    /// The sum of the magnitudes of the terms of each root, multiplied out.
    pub fn magnitudes(&self, bind: impl Fn(SymbolId) -> f64, external: impl Fn(&External, &[f64]) -> f64) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.steps.len());
        self.evaluate_again(&mut values, bind, external);
        let mut sizes: Vec<f64> = Vec::with_capacity(values.len());
        for (place, step) in self.steps.iter().enumerate() {
            sizes.push(match step {
                Step::Sum { constant, terms } => {
                    let terms = terms.iter().map(|&(factor, term)| factor.to_f64().abs() * sizes[term]);
                    constant.to_f64().abs() + terms.sum::<f64>()
                }
                Step::Product { coefficient, factors } => {
                    let power = |&(base, exponent): &(usize, i32)| match exponent {
                        1.. => sizes[base].powi(exponent),
                        _ => values[base].abs().powi(exponent),
                    };
                    coefficient.to_f64().abs() * factors.iter().map(power).product::<f64>()
                }
                _ => values[place].abs(),
            });
        }
        self.roots.iter().map(|&root| sizes[root]).collect()
    }
}

impl Step {
    fn value<S: Scalar>(
        &self,
        values: &[S],
        bind: impl Fn(SymbolId) -> S,
        external: impl Fn(&External, &[f64]) -> f64,
    ) -> S {
        match self {
            Self::Constant(number) => S::number(*number),
            Self::Pi => S::pi(),
            Self::Symbol(symbol) => bind(*symbol),
            Self::Sum { constant, terms } => {
                let scaled = terms.iter().map(|&(factor, term)| times(factor, &values[term]));
                let constant = (!constant.is_zero()).then(|| S::number(*constant));
                constant.into_iter().chain(scaled).reduce(|sum, term| sum.add(&term)).unwrap_or_else(|| S::of(0.0))
            }
            Self::Product { coefficient, factors } => {
                let powers = factors.iter().map(|&(base, exponent)| match exponent {
                    1 => values[base].clone(),
                    _ => values[base].power(exponent),
                });
                let product = powers.reduce(|product, power| product.multiply(&power));
                times(*coefficient, &product.unwrap_or_else(|| S::of(1.0)))
            }
            Self::Call(function, arguments) => {
                let arguments: Vec<S> = arguments.iter().map(|&place| values[place].clone()).collect();
                S::call(*function, &arguments)
            }
            Self::External(function, arguments) => {
                let arguments: Vec<f64> = arguments.iter().map(|&place| values[place].double()).collect();
                S::of(external(function, &arguments))
            }
        }
    }
}

fn times<S: Scalar>(factor: Number, value: &S) -> S {
    match factor {
        Number::Ratio(1, 1) => value.clone(),
        Number::Ratio(-1, 1) => value.negate(),
        _ => S::number(factor).multiply(value),
    }
}
