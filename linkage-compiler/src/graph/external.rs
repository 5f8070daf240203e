//! User functions: only their names and the number of their derivatives are known.

use super::arena::Graph;
use super::node::{External, ExternalId, Node, NodeId};

impl Graph {
    /// Adds a user function with the names of its value and of its derivatives by the first argument, in order.
    pub fn external(&mut self, names: Vec<String>) -> ExternalId {
        self.externals.push(names);
        ExternalId::new(self.externals.len() - 1)
    }

    /// The names of the value and of the declared derivatives, in order.
    #[must_use]
    pub fn external_names(&self, function: ExternalId) -> &[String] {
        &self.externals[function.index()]
    }

    /// The declared name of this derivative, if there is one.
    #[must_use]
    pub fn external_name(&self, external: &External) -> Option<&str> {
        self.external_names(external.function).get(external.order()?).map(String::as_str)
    }

    /// A call of a user function or of a derivative.
    pub fn apply(&mut self, external: External, arguments: Vec<NodeId>) -> NodeId {
        self.intern(Node::External(external, arguments))
    }

    /// The user functions and derivatives in this graph, declared or not.
    pub fn applied(&self) -> impl Iterator<Item = &External> {
        self.nodes.iter().filter_map(|node| match &**node {
            Node::External(external, _) => Some(external),
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::graph::Number;

    /// f(x, p) = p x^5 and its derivatives by x.
    fn power(external: &External, at: &[f64]) -> f64 {
        let order = i32::try_from(external.order().unwrap()).unwrap();
        let factor: i32 = (0..order).map(|k| 5 - k).product();
        at[1] * f64::from(factor) * at[0].powi(5 - order)
    }

    #[test]
    fn derivatives_follow_the_chain_rule() {
        let mut g = Graph::default();
        let [t, p] = ["t", "p"].map(|name| g.symbol(name));
        let [time, parameter] = [t, p].map(|symbol| g.variable(symbol));
        let f = g.external(["f", "df", "ddf"].map(str::to_owned).to_vec());
        let square = g.power(time, 2);
        let x = g.scale(Number::integer(3), square);
        let value = g.apply(External::new(f, 2, 0), vec![x, parameter]);
        let first = g.partial(&[value], t)[0];
        let second = g.partial(&[first], t)[0];
        assert_eq!(g.text(first), "6*t*df(3*t^2, p)");
        // p (3 t^2)^5 = 243 p t^10
        let bind = |symbol| if symbol == t { 0.5 } else { 7.0 };
        let found = g.evaluate_with(&[value, first, second], bind, power);
        for (found, (factor, exponent)) in found.into_iter().zip([(243.0, 10), (2430.0, 9), (21_870.0, 8)]) {
            let expected = 7.0 * factor * 0.5_f64.powi(exponent);
            assert!((found - expected).abs() <= 1e-15 * expected, "{found} is not {expected}");
        }
        assert!(g.evaluate(&[value], bind)[0].is_nan());
        // The derivative by the parameter has no name.
        let other = g.differentiate(&[value], &BTreeMap::from([(p, time)]))[0];
        let by: Vec<_> = g.applied().filter(|applied| applied.order().is_none()).cloned().collect();
        assert_eq!(by, [External { function: f, by: vec![0, 1] }]);
        assert_eq!(g.external_name(&by[0]), None);
        assert_eq!(g.text(other), "t*…(3*t^2, p)");
    }
}
