//! The interpreter, against which tests check emitted code.

use rustc_hash::FxHashMap;

use super::arena::Graph;
use super::node::{External, NodeId, SymbolId, node_value};

impl Graph {
    /// Evaluates `roots`; `bind` returns the value of each symbol, user functions are NaN.
    #[must_use]
    pub fn evaluate(&self, roots: &[NodeId], bind: impl Fn(SymbolId) -> f64) -> Vec<f64> {
        self.evaluate_with(roots, bind, |_, _| f64::NAN)
    }

    /// Evaluates `roots`; `external` returns the values of user functions and of their derivatives.
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
