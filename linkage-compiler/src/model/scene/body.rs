//! Analysis of `body` statements.

use std::collections::{BTreeMap, BTreeSet};

use super::Body;
use crate::graph::{NodeId, SymbolId};
use crate::model::mechanism::Mechanism;
use crate::model::name::Name;
use crate::model::resolver::Resolver;
use crate::syntax::{self, ExpressionId};

impl Resolver<'_> {
    /// Declares time and the rates of the coordinates, for the laws of scenes.
    pub(in crate::model) fn declare_motion(&mut self, result: &mut Mechanism) {
        let mut name = "t".to_owned();
        let fields =
            result.parameters.iter().map(|p| &p.name.field).chain(result.coordinates.iter().map(|c| &c.name.field));
        let fields: BTreeSet<&String> = fields.collect();
        while fields.contains(&name) {
            name.push('_');
        }
        result.time = Some(self.graph.symbol(name));
        for coordinate in result.coordinates.iter_mut() {
            let rate = self.graph.symbol(format!("{}_rate", coordinate.name.field));
            coordinate.rate = Some(rate);
            self.motion.rates.insert(coordinate.symbol, self.graph.variable(rate));
        }
        self.motion.time = result.time.map(|time| self.graph.variable(time));
    }

    pub(in crate::model) fn body(&mut self, tree: &syntax::Body, result: &mut Mechanism) {
        let before = self.scope.uses();
        let mut given: BTreeMap<String, ExpressionId> = BTreeMap::new();
        for (word, value) in &tree.properties {
            if given.insert(word.to_string(), *value).is_some() {
                self.diagnostics.error(word.span(), format_args!("`{word}` of `{}` is given twice", tree.name));
            }
        }
        // Expressions must be evaluated in the order of the source.
        let (mut scalars, mut center) = (BTreeMap::new(), None);
        self.scope.is_body = true;
        for (word, value) in &tree.properties {
            if word == "center" {
                center = self.vector(*value);
            } else if let Some(node) = self.scalar(*value) {
                if word == "angle" {
                    self.angle_of_body(node, self.expressions.region(*value), &tree.name.to_string());
                }
                scalars.insert(word.to_string(), node);
            }
        }
        self.scope.is_body = false;
        for word in ["mass", "inertia"] {
            if let (Some(&value), Some(&node)) = (given.get(word), scalars.get(word)) {
                self.positive(value, node, &format!("the {word} of `{}`", tree.name));
            }
        }
        let mut missing = |given_word: &str, needed: &str, example: &str| {
            if tree.is_complete && given.contains_key(given_word) && !given.contains_key(needed) {
                let message = format!("`{}` has {given_word}, but no {needed}: add `{example}`", tree.name);
                self.diagnostics.error(tree.name.span(), message);
            }
        };
        missing("mass", "center", "center G;");
        missing("inertia", "angle", "angle phi;");
        missing("center", "mass", "mass m;");
        missing("angle", "inertia", "inertia j;");
        if result.bodies.iter().any(|body| tree.name == body.name.text) {
            self.diagnostics.error(tree.name.span(), format_args!("the body `{}` is declared twice", tree.name));
        }
        result.bodies.push(Body {
            name: Name::new(&tree.name),
            mass: scalars.get("mass").copied().zip(center.map(|(x, y)| [x, y])),
            inertia: scalars.get("inertia").copied().zip(scalars.get("angle").copied()),
            mentions: self.scope.used_since(before),
        });
    }

    /// Reports an expression that is not constant in time, or is a negative number.
    pub(super) fn positive(&mut self, id: ExpressionId, node: NodeId, what: &str) {
        self.still(id, node, what);
        if self.graph.constant_value(node).is_some_and(|value| value < 0.0) {
            self.diagnostics.error(self.expressions.region(id), format_args!("{what} is negative"));
        }
    }

    /// Reports an expression that depends on coordinates, rates or time.
    pub(super) fn still(&mut self, id: ExpressionId, node: NodeId, what: &str) {
        let motion = self.motion.rates.values().chain(&self.motion.time).filter_map(|&node| self.graph.as_symbol(node));
        let motion: BTreeSet<SymbolId> = motion.chain(self.motion.rates.keys().copied()).collect();
        if self.graph.symbols_of(&[node]).iter().any(|symbol| motion.contains(symbol)) {
            let message = format!("{what} must be constant: use parameters only");
            self.diagnostics.error(self.expressions.region(id), message);
        }
    }
}
