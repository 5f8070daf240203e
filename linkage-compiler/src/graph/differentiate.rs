//! Derivatives: one forward sweep over the graph, each node derived once.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::{Graph, Node, NodeId, Number, SymbolId};

impl Graph {
    /// The derivatives of `roots` along `seeds`, which gives the derivative of each symbol.
    ///
    /// A single seed of 1 is the partial derivative; the rates of all coordinates as seeds give
    /// the derivative with respect to time. Symbols without a seed are constants.
    pub fn differentiate(&mut self, roots: &[NodeId], seeds: &BTreeMap<SymbolId, NodeId>) -> Vec<NodeId> {
        let zero = self.zero();
        let mut derivative: FxHashMap<NodeId, NodeId> = FxHashMap::default();
        for id in self.reachable(roots) {
            let result = match self.node(id).clone() {
                Node::Constant(_) | Node::Pi => zero,
                Node::Symbol(symbol) => seeds.get(&symbol).copied().unwrap_or(zero),
                // (sum k f)' = sum k f'
                Node::Sum { terms, .. } => {
                    let terms: Vec<_> = terms.iter().map(|&(k, term)| (k, derivative[&term])).collect();
                    self.sum(&terms)
                }
                // (k prod f^n)' = sum n k f^(n-1) f' * the other factors
                Node::Product { coefficient, factors } => {
                    let mut terms = Vec::new();
                    for (index, &(base, exponent)) in factors.iter().enumerate() {
                        let inner = derivative[&base];
                        if self.is_zero(inner) {
                            continue;
                        }
                        let mut rest = factors.clone();
                        rest[index].1 = exponent.saturating_sub(1);
                        rest.push((inner, 1));
                        let term = self.product(&rest);
                        terms.push((coefficient.multiply(Number::integer(exponent.into())), term));
                    }
                    self.sum(&terms)
                }
                // f(a, b)' = f_a a' + f_b b'
                Node::Call(function, arguments) => {
                    let inner: Vec<_> = arguments.iter().map(|argument| derivative[argument]).collect();
                    if inner.iter().all(|&d| self.is_zero(d)) {
                        zero
                    } else {
                        let partials = (function.operation().partials)(self, &arguments, id);
                        let mut terms = Vec::new();
                        for (partial, inner) in partials.into_iter().zip(inner) {
                            terms.push((Number::ONE, self.multiply(partial, inner)));
                        }
                        self.sum(&terms)
                    }
                }
                // f(a, p)' = f_a a' + f_p p'
                Node::External(external, arguments) => {
                    let mut terms = Vec::new();
                    for (index, argument) in arguments.iter().enumerate() {
                        let inner = derivative[argument];
                        if !self.is_zero(inner) {
                            let partial = self.apply(external.derived(index), arguments.clone());
                            terms.push((Number::ONE, self.multiply(partial, inner)));
                        }
                    }
                    self.sum(&terms)
                }
            };
            derivative.insert(id, result);
        }
        roots.iter().map(|root| derivative[root]).collect()
    }

    /// The partial derivatives of `roots` with respect to one symbol.
    pub fn partial(&mut self, roots: &[NodeId], symbol: SymbolId) -> Vec<NodeId> {
        let one = self.one();
        self.differentiate(roots, &BTreeMap::from([(symbol, one)]))
    }
}
