//! Implied loops and equations: they follow from Psi(q) = 0 if the dimensions are right, and are checked at each position.

use linkage_ir::Intrinsic;

use super::doc::{fenced, lines};
use super::expression::{Expression, Statement};
use super::function::{Body, Function, Value, results};
use super::plan::{Plan, unnamed};
use super::signatures::{Signatures, fallible};
use crate::graph::NodeId;
use crate::program::Type;

impl Plan<'_, '_> {
    /// The residual and the scale of each row.
    pub(super) fn implied_pairs(&self) -> Vec<[NodeId; 2]> {
        self.derivation.implied.iter().map(|implied| [implied.residual, implied.scale]).collect()
    }

    /// `check_implied`: the check at a position.
    pub(super) fn check_implied(&mut self) {
        if self.derivation.implied.is_empty() {
            return;
        }
        let (mut names, mut residuals, mut scales) = (Vec::new(), Vec::new(), Vec::new());
        for implied in &self.derivation.implied {
            names.push(Expression::text(&implied.name));
            residuals.push(implied.residual);
            scales.push(implied.scale);
        }
        let mut doc = lines(["Checks that the implied loops and equations close at a position:"]);
        let zeros: Vec<String> = residuals.iter().map(|&row| format!("0 = {}", self.text(row))).collect();
        doc.extend(fenced(zeros.into_iter()));
        for implied in &self.mechanism.implied {
            doc.extend(implied.description());
        }
        doc.extend(lines([
            "",
            "Functions that find a position call it: `assemble`, `kinematics`, `solve` and those of a `Path`.",
            "",
            "# Errors",
            "`PositionError::NotImplied` if a residual is not zero relative to the sum of the magnitudes of its terms.",
        ]));
        let count = names.len();
        let kernel = self.on_pose(Vec::new(), Vec::new(), unnamed(residuals.into_iter().chain(scales)));
        let all = [names, results(0..count), results(count..2 * count)].map(Expression::List);
        let check = Expression::call(Intrinsic::Implied, std::iter::once(Expression::mechanism()).chain(all));
        let body = Body { kernel: Some(kernel), value: Value::Result(check), ..Body::default() };
        self.add(self.signatures.check_implied(), doc, body);
    }

    /// Adds the check to a body whose value is a pose.
    pub(super) fn with_implied(&self, body: &mut Body) {
        if self.derivation.implied.is_empty() {
            return;
        }
        let Value::Plain(pose) = std::mem::take(&mut body.value) else { return };
        let pose = body.bound(self.signatures.arguments.pose.clone(), pose);
        let check = Expression::own_call("check_implied", [pose.clone().borrowed()]);
        body.after.push(Statement::Do(check.tried()));
        body.value = Value::Plain(pose);
    }
}

impl Signatures {
    /// The check of implied loops and equations at a position.
    pub fn check_implied(&self) -> Function<Body> {
        fallible("check_implied", [self.pose()], Type::Tuple(Vec::new()))
    }
}
