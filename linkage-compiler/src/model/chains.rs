//! The chains of a mechanism, found in its expressions.

use std::collections::BTreeMap;

use super::chain::{Chain, Chains, Link, Mean, in_order};
use super::resolver::Resolver;
use super::scope::Value;
use crate::graph::{NodeId, Number};
use crate::syntax::{Expression, ExpressionId, Operator, Statement, StatementKind};

/// The longest chain; a longer one has no named joints.
const LONGEST: usize = 256;

/// The chains of the `let`s of vectors; None for the name of a point, from which chains start.
type Named = BTreeMap<String, Option<Chain>>;

impl Resolver<'_> {
    /// Finds the chains once all expressions have values.
    pub(super) fn chains(&mut self, statements: &[Statement]) -> Chains {
        let (mut chains, mut named) = (Chains::default(), Named::new());
        for statement in statements {
            match &statement.kind {
                StatementKind::Let { name, value } => {
                    let chain = self.chain(*value, &named).unwrap_or_default();
                    named.insert(name.to_string(), Some(chain));
                }
                StatementKind::Point { name, value } => {
                    chains.points.push(self.chain(*value, &named).unwrap_or_default());
                    named.insert(name.to_string(), None);
                }
                StatementKind::Loop { left, right, .. } => {
                    let sides = [left, right].map(|&side| self.chain(side, &named));
                    let is_zero = |side: &Option<Chain>| {
                        side.as_ref().is_some_and(|chain| chain.links.is_empty() && chain.start.is_none())
                    };
                    chains.zeros.push(sides.each_ref().map(is_zero));
                    chains.loops.push(sides.map(Option::unwrap_or_default));
                }
                StatementKind::Body(body) => {
                    let center = body.property("center");
                    let chain = center.and_then(|value| self.chain(value, &named));
                    chains.centers.push(chain.unwrap_or_default());
                    let mean = center.and_then(|value| self.mean(value));
                    chains.means.push(mean);
                }
                _ => {}
            }
        }
        chains
    }

    fn chain(&mut self, id: ExpressionId, named: &Named) -> Option<Chain> {
        let mut chain = Chain::default();
        self.add_links(id, false, named, &mut chain)?;
        (chain.links.len() <= LONGEST).then_some(chain)
    }

    /// The points of which an expression is a mean: their weights add up to 1.
    fn mean(&mut self, id: ExpressionId) -> Option<Mean> {
        let zero = self.graph.zero();
        let mut mean = Mean { points: Vec::new(), offset: [zero; 2] };
        let one = self.graph.number(Number::ONE);
        let weight = self.add_points(id, one, &mut mean)?;
        let rest = self.graph.subtract(weight, one);
        (mean.points.len() > 1 && self.graph.is_zero(rest)).then_some(mean)
    }

    /// Adds the points of an expression to a mean, and its other vectors to the offset; returns the sum of the weights.
    fn add_points(&mut self, id: ExpressionId, weight: NodeId, mean: &mut Mean) -> Option<NodeId> {
        let expressions = self.expressions;
        let Value::Vector(x, y) = self.value(id) else { return None };
        match expressions.get(id) {
            Expression::Sum(operands) => {
                let mut sum = self.graph.zero();
                for &(operator, operand) in operands {
                    let weight = if operator == Operator::Inverse { self.graph.negate(weight) } else { weight };
                    let added = self.add_points(operand, weight, mean)?;
                    sum = self.graph.add(sum, added);
                }
                Some(sum)
            }
            Expression::Negate(inner) => {
                let weight = self.graph.negate(weight);
                self.add_points(*inner, weight, mean)
            }
            Expression::Product(operands) => {
                let (mut factors, mut vector) = (vec![(weight, 1)], None);
                for &(operator, operand) in operands {
                    match self.value(operand) {
                        Value::Scalar(node) => factors.push((node, if operator == Operator::Inverse { -1 } else { 1 })),
                        Value::Vector(..) => vector = Some(operand),
                        Value::Poison => return None,
                    }
                }
                let weight = self.graph.product(&factors);
                self.add_points(vector?, weight, mean)
            }
            Expression::Name(_) => {
                mean.points.push([x, y]);
                Some(weight)
            }
            _ => {
                let added = [x, y].map(|part| self.graph.multiply(weight, part));
                mean.offset = [0, 1].map(|axis| self.graph.add(mean.offset[axis], added[axis]));
                Some(self.graph.zero())
            }
        }
    }

    /// Adds the vectors of an expression to a chain; None if one is not understood.
    fn add_links(&mut self, id: ExpressionId, is_reversed: bool, named: &Named, chain: &mut Chain) -> Option<()> {
        let expressions = self.expressions;
        let vector = match self.value(id) {
            Value::Vector(x, y) => [x, y],
            // `= 0`, the zero vector.
            Value::Scalar(zero) if self.graph.is_zero(zero) => return Some(()),
            _ => return None,
        };
        if vector.iter().all(|&part| self.graph.is_zero(part)) {
            return Some(());
        }
        match expressions.get(id) {
            Expression::Sum(operands) => {
                for (operator, operand) in in_order(operands, is_reversed) {
                    self.add_links(operand, is_reversed != (operator == Operator::Inverse), named, chain)?;
                }
                return (chain.links.len() <= LONGEST).then_some(());
            }
            Expression::Negate(inner) => return self.add_links(*inner, !is_reversed, named, chain),
            Expression::Name(name) => match named.get(&name.to_string())? {
                Some(Chain { start, links }) => {
                    if let Some(start) = start {
                        start_from(chain, *start, is_reversed)?;
                    }
                    let turned = |link: &Link| Link { is_reversed: link.is_reversed != is_reversed, ..*link };
                    match is_reversed {
                        false => chain.links.extend(links.iter().map(turned)),
                        true => chain.links.extend(links.iter().rev().map(turned)),
                    }
                    return Some(());
                }
                None => return start_from(chain, vector, is_reversed),
            },
            _ => {}
        }
        let link = Link::of(expressions, id, is_reversed, self.graph.zero(), &mut |id| self.value(id));
        chain.links.extend(link);
        Some(())
    }
}

/// Lets a chain start from a point: only one, and not subtracted.
fn start_from(chain: &mut Chain, point: [NodeId; 2], is_reversed: bool) -> Option<()> {
    let is_first = chain.start.is_none() && !is_reversed;
    chain.start = Some(point);
    is_first.then_some(())
}
