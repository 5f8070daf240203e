//! Loops and equations: their residuals, and what is no equation.

use syn::Attribute;

use super::mechanism::Constraint;
use super::resolver::{Mode, Resolver};
use super::scope::Value;
use crate::graph::{Graph, NodeId};
use crate::syntax::ExpressionId;

/// The left side minus the right: of scalars, or of vectors, for which `0` is the given origin; `None` of others.
pub(super) fn residual(graph: &mut Graph, left: Value, right: Value, origin: [NodeId; 2]) -> Option<Vec<NodeId>> {
    let right = match (left, right) {
        (Value::Scalar(left), Value::Scalar(right)) => return Some(vec![graph.subtract(left, right)]),
        (_, Value::Scalar(zero)) if graph.is_zero(zero) => origin,
        _ => right.vector()?,
    };
    let left = left.vector()?;
    Some([0, 1].map(|axis| graph.subtract(left[axis], right[axis])).into())
}

impl Resolver<'_> {
    pub(super) fn close_loop(
        &mut self,
        attributes: Vec<Attribute>,
        left: ExpressionId,
        right: ExpressionId,
        constraints: &mut Vec<Constraint>,
    ) {
        let (a, b) = self.within(Mode::Loop, |resolver| (resolver.value(left), resolver.value(right)));
        if let (Value::Scalar(_), Value::Scalar(_)) = (a, b) {
            let region = self.expressions.region(left).to(self.expressions.region(right));
            let message = "both sides are scalars, but a `loop` is between vectors: write `equation` instead";
            self.diagnostics.error(region, message);
            return;
        }
        let zero = [self.graph.zero(); 2];
        match (residual(&mut self.graph, a, b, zero), a, b) {
            (Some(rows), ..) => self.close(attributes, left, right, rows, constraints),
            (None, Value::Scalar(_), Value::Vector(..)) => self.expect_vector(left),
            (None, Value::Vector(..), Value::Scalar(_)) => self.expect_vector(right),
            _ => {}
        }
    }

    pub(super) fn close_equation(
        &mut self,
        attributes: Vec<Attribute>,
        left: ExpressionId,
        right: ExpressionId,
        constraints: &mut Vec<Constraint>,
    ) {
        if let (Value::Vector(..), Value::Vector(..)) = (self.value(left), self.value(right)) {
            let region = self.expressions.region(left).to(self.expressions.region(right));
            let message = "both sides are vectors, but an `equation` is between scalars: write `loop` instead";
            self.diagnostics.error(region, message);
        } else if let (Some(a), Some(b)) = (self.scalar(left), self.scalar(right)) {
            self.kinds.sums.push(vec![left, right]);
            let row = self.graph.subtract(a, b);
            self.close(attributes, left, right, vec![row], constraints);
        }
    }

    fn close(
        &mut self,
        attributes: Vec<Attribute>,
        left: ExpressionId,
        right: ExpressionId,
        rows: Vec<NodeId>,
        constraints: &mut Vec<Constraint>,
    ) {
        let region = self.expressions.region(left).to(self.expressions.region(right));
        if self.report_fault(region) {
            return;
        }
        if rows.iter().all(|&row| self.graph.is_zero(row)) {
            self.diagnostics.error(region, "both sides are equal: this equation is always true; remove it");
            return;
        }
        constraints.push(Constraint { span: region.first, attributes, rows });
    }
}
