//! Positions on branches, and all positions at inputs.

use linkage_runtime::{Assembly, Branches, Column, Dim, Kinematic as _, Mechanism as _, PositionError};

use super::parameters::Parameters;
use super::{AtRunTime, BranchAtRunTime, CoordinatesAtRunTime, PoseAtRunTime};
use crate::machine::Value;

/// A mechanism with a group without a closed form returns [`PositionError::NoClosedForm`], always.
impl<'p, V: Dim, P: Parameters> Assembly for AtRunTime<'p, V, P> {
    fn assemble(
        &self,
        inputs: Column<f64, V>,
        branch: BranchAtRunTime<'p>,
    ) -> Result<PoseAtRunTime<V>, PositionError<&'p str>> {
        let given = [self.inputs_value(&inputs), self.branch_value(&branch)];
        self.result("assemble", given).map(|pose| self.read_pose(pose))
    }
    fn assemble_near(
        &self,
        guess: &CoordinatesAtRunTime<V>,
        branch: BranchAtRunTime<'p>,
    ) -> Result<PoseAtRunTime<V>, PositionError<&'p str>> {
        match self.prepared.counts_turns() {
            true => {
                let given = [self.coordinates_value(guess), self.branch_value(&branch)];
                self.result("assemble_near", given).map(|pose| self.read_pose(pose))
            }
            false => self.assemble(guess.inputs, branch),
        }
    }
}

/// A mechanism whose positions cannot be listed returns the error of its function `branches`, always; an open chain has one
/// position.
impl<'p, V: Dim, P: Parameters> Branches for AtRunTime<'p, V, P> {
    fn all_positions(
        &self,
        inputs: Column<f64, V>,
    ) -> Result<impl Iterator<Item = (BranchAtRunTime<'p>, CoordinatesAtRunTime<V>)>, PositionError<&'p str>> {
        let all = if self.prepared.has("all_positions") {
            let all = self.result("all_positions", [self.inputs_value(&inputs)])?;
            let pairs = all.as_list().unwrap_or_default().iter().filter_map(|pair| match pair.as_list() {
                Ok([branch, q]) => Some((self.read_branch(branch), self.read_coordinates(q))),
                _ => None,
            });
            pairs.collect()
        } else if self.prepared.has("branches") {
            self.result("branches", [self.inputs_value(&inputs)])?;
            Vec::new()
        } else {
            let branch = self.read_branch(&Value::record([]));
            let pose = self.assemble(inputs, branch)?;
            vec![(self.branch_of(&pose), Self::coordinates_of(&pose))]
        };
        Ok(all.into_iter())
    }
}
