//! The interpreter: the oracle that emitted code is compared with.

use rustc_hash::FxHashMap;

use super::{External, Graph, Node, NodeId, SymbolId};

impl Graph {
    /// The values of `roots` where `bind` gives the value of each symbol; user functions are not a number.
    #[must_use]
    pub fn evaluate(&self, roots: &[NodeId], bind: impl Fn(SymbolId) -> f64) -> Vec<f64> {
        self.evaluate_with(roots, bind, |_, _| f64::NAN)
    }

    /// The values of `roots` where `external` gives those of user functions and of their derivatives.
    #[must_use]
    pub fn evaluate_with(
        &self,
        roots: &[NodeId],
        bind: impl Fn(SymbolId) -> f64,
        external: impl Fn(&External, &[f64]) -> f64,
    ) -> Vec<f64> {
        let mut values: FxHashMap<NodeId, f64> = FxHashMap::default();
        for id in self.reachable(roots) {
            let call = |function: &External, arguments: &[f64]| Some(external(function, arguments));
            let value =
                node_value(self.node(id), |symbol| Some(bind(symbol)), call, |child| values.get(&child).copied());
            values.insert(id, value.unwrap_or(f64::NAN));
        }
        roots.iter().map(|root| values.get(root).copied().unwrap_or(f64::NAN)).collect()
    }
}

/// The value of one node, given those of its symbols and children; `None` if one is missing.
pub(super) fn node_value(
    node: &Node,
    bind: impl Fn(SymbolId) -> Option<f64>,
    external: impl Fn(&External, &[f64]) -> Option<f64>,
    child: impl Fn(NodeId) -> Option<f64>,
) -> Option<f64> {
    match node {
        Node::Constant(value) => Some(value.to_f64()),
        Node::Pi => Some(std::f64::consts::PI),
        Node::Symbol(symbol) => bind(*symbol),
        Node::Sum { constant, terms } => {
            let mut sum = constant.to_f64();
            for (factor, term) in terms {
                sum += factor.to_f64() * child(*term)?;
            }
            Some(sum)
        }
        Node::Product { coefficient, factors } => {
            let mut product = coefficient.to_f64();
            for (base, exponent) in factors {
                product *= child(*base)?.powi(*exponent);
            }
            Some(product)
        }
        Node::Call(function, arguments) => {
            let arguments: Option<Vec<f64>> = arguments.iter().map(|argument| child(*argument)).collect();
            arguments.map(|arguments| (function.operation().value)(&arguments))
        }
        Node::External(function, arguments) => {
            let arguments: Option<Vec<f64>> = arguments.iter().map(|argument| child(*argument)).collect();
            external(function, &arguments?)
        }
    }
}
