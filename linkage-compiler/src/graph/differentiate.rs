//! Differentiation: one forward sweep over the graph, each node differentiated once.

use std::collections::BTreeMap;

use super::arena::Graph;
use super::node::{Node, NodeId, SymbolId};
use super::{Function, Number};

impl Graph {
    /// The derivatives of `roots`, where `seeds` are the derivatives of symbols.
    ///
    /// A single seed of 1 gives a partial derivative; the rates of all coordinates as seeds give
    /// the derivative with respect to time. Symbols without a seed are constants.
    pub fn differentiate(&mut self, roots: &[NodeId], seeds: &BTreeMap<SymbolId, NodeId>) -> Vec<NodeId> {
        let zero = self.zero();
        let nodes = self.reachable(roots);
        // Zero unless the node depends on a seeded symbol.
        let mut derivatives = vec![zero; nodes.last().map_or(0, |last| last.index() + 1)];
        for id in nodes {
            let result = match self.node(id).clone() {
                Node::Constant(_) | Node::Pi => zero,
                Node::Symbol(symbol) => seeds.get(&symbol).copied().unwrap_or(zero),
                // (sum k f)' = sum k f'
                Node::Sum { terms, .. } => {
                    let inner = terms.into_iter().map(|(k, term)| (k, derivatives[term.index()]));
                    let derived: Vec<_> = inner.filter(|(_, inner)| *inner != zero).collect();
                    self.sum(&derived)
                }
                // (k prod f^n)' = sum n k f^(n-1) f' * the other factors
                Node::Product { coefficient, factors } => {
                    let mut terms = Vec::new();
                    for (index, &(base, exponent)) in factors.iter().enumerate() {
                        let inner = derivatives[base.index()];
                        // (hypot(x, y)^n)' = n hypot^(n-2) (x x' + y y'), without a quotient that is 0 / 0 at zero
                        if let (2.., Node::Call(Function::Hypot, parts)) = (exponent, self.node(base).clone()) {
                            let products = parts.iter().map(|&part| (part, derivatives[part.index()]));
                            let products: Vec<_> =
                                products.map(|(part, inner)| (Number::ONE, self.multiply(part, inner))).collect();
                            let mut rest = factors.clone();
                            rest[index].1 = exponent - 2;
                            rest.push((self.sum(&products), 1));
                            terms.push((coefficient.multiply(Number::integer(exponent.into())), self.product(&rest)));
                        } else if inner != zero {
                            let mut rest = factors.clone();
                            rest[index].1 = exponent.saturating_sub(1);
                            rest.push((inner, 1));
                            terms.push((coefficient.multiply(Number::integer(exponent.into())), self.product(&rest)));
                        }
                    }
                    self.sum(&terms)
                }
                // if_nonzero(a, v, w)' = if_nonzero(a, v', w') if a does not move
                Node::Call(Function::IfNonzero, arguments) if derivatives[arguments[0].index()] == zero => {
                    let [value, limit] = [1, 2].map(|place| derivatives[arguments[place].index()]);
                    self.call(Function::IfNonzero, &[arguments[0], value, limit])
                }
                // f(a, b)' = f_a a' + f_b b'
                Node::Call(function, arguments) => {
                    let inner: Vec<_> = arguments.iter().map(|argument| derivatives[argument.index()]).collect();
                    if inner.iter().all(|&inner| inner == zero) {
                        zero
                    } else {
                        let partials = (super::operation(function).partials)(self, &arguments, id);
                        let products = partials.into_iter().zip(inner);
                        let terms: Vec<_> =
                            products.map(|(partial, inner)| (Number::ONE, self.multiply(partial, inner))).collect();
                        self.sum(&terms)
                    }
                }
                // f(a, p)' = f_a a' + f_p p'
                Node::External(external, arguments) => {
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
