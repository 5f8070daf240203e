//! `length_scale` of an open chain with lengths as inputs: no loop equation gives these a scale.

use linkage_ir::Intrinsic;

use super::expression::Expression;
use super::function::{Body, results};
use super::plan::{Plan, unnamed};
use crate::ids::ColumnId;
use crate::model::Kind;

impl Plan<'_, '_> {
    /// max |d point / d angle|, which is about the reach of the longest arm.
    pub(super) fn length_scale(&mut self) {
        let coordinates = &self.mechanism.coordinates;
        let inputs = self.driver.inputs.iter().zip(&self.derivation.inputs);
        let (angles, others): (Vec<_>, Vec<_>) = inputs.partition(|(id, _)| coordinates[**id].kind == Kind::Angle);
        let angles: Vec<ColumnId> = angles.into_iter().map(|(_, &column)| column).collect();
        if others.is_empty() {
            return;
        }
        let nodes = self.derivation.point_scales(&angles);
        if nodes.is_empty() {
            return;
        }
        let all = Expression::List(results(0..nodes.len()));
        let kernel = self.on_pose(Vec::new(), Vec::new(), unnamed(nodes));
        let body = Body::of(kernel, Expression::call(Intrinsic::Largest, [all]));
        self.add(self.signatures.length_scale(), Vec::new(), body);
    }
}
