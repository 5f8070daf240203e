//! Derivatives: one forward sweep over the graph, each node derived once.

use std::collections::BTreeMap;

use super::{Graph, Node, NodeId, Number, SymbolId};

impl Graph {
    /// The derivatives of `roots` along `seeds`, which gives the derivative of each symbol.
    ///
    /// A single seed of 1 is the partial derivative; the rates of all coordinates as seeds give
    /// the derivative with respect to time. Symbols without a seed are constants.
    pub fn differentiate(&mut self, roots: &[NodeId], seeds: &BTreeMap<SymbolId, NodeId>) -> Vec<NodeId> {
        let zero = self.zero();
        let nodes = self.reachable(roots);
        // Nought unless a node stands on a seed, which most do not.
        let mut derivatives = vec![zero; nodes.last().map_or(0, |last| last.index() + 1)];
        for id in nodes {
            let result = match &self.nodes[id.index()] {
                Node::Constant(_) | Node::Pi => zero,
                Node::Symbol(symbol) => seeds.get(symbol).copied().unwrap_or(zero),
                // (sum k f)' = sum k f'
                Node::Sum { terms, .. } => {
                    let mut derived = Vec::new();
                    for &(k, term) in terms {
                        let inner = derivatives[term.index()];
                        if inner != zero {
                            derived.push((k, inner));
                        }
                    }
                    if derived.is_empty() { zero } else { self.sum(&derived) }
                }
                // (k prod f^n)' = sum n k f^(n-1) f' * the other factors
                Node::Product { coefficient, factors } => {
                    let (coefficient, mut parts) = (*coefficient, Vec::new());
                    for (index, &(base, exponent)) in factors.iter().enumerate() {
                        let inner = derivatives[base.index()];
                        if inner != zero {
                            let mut rest = factors.clone();
                            rest[index].1 = exponent.saturating_sub(1);
                            rest.push((inner, 1));
                            parts.push((coefficient.multiply(Number::integer(exponent.into())), rest));
                        }
                    }
                    let mut terms = Vec::with_capacity(parts.len());
                    for (coefficient, rest) in parts {
                        terms.push((coefficient, self.product(&rest)));
                    }
                    if terms.is_empty() { zero } else { self.sum(&terms) }
                }
                // f(a, b)' = f_a a' + f_b b'
                Node::Call(function, arguments) => {
                    let inner: Vec<_> = arguments.iter().map(|argument| derivatives[argument.index()]).collect();
                    if inner.iter().all(|&inner| inner == zero) {
                        zero
                    } else {
                        let (function, arguments) = (*function, arguments.clone());
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
                    let (external, arguments) = (external.clone(), arguments.clone());
                    let mut terms = Vec::new();
                    for (index, argument) in arguments.iter().enumerate() {
                        let inner = derivatives[argument.index()];
                        if inner != zero {
                            let partial = self.apply(external.derived(index), arguments.clone());
                            terms.push((Number::ONE, self.multiply(partial, inner)));
                        }
                    }
                    self.sum(&terms)
                }
            };
            derivatives[id.index()] = result;
        }
        roots.iter().map(|root| derivatives[root.index()]).collect()
    }

    /// The partial derivatives of `roots` with respect to one symbol.
    pub fn partial(&mut self, roots: &[NodeId], symbol: SymbolId) -> Vec<NodeId> {
        let one = self.one();
        self.differentiate(roots, &BTreeMap::from([(symbol, one)]))
    }
}
