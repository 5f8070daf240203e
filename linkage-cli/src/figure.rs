//! The joints and parts of a mechanism, from its formulas: also of one that has too many unknowns for the algorithms of the
//! runtime, as a machine of three legs.

use linkage_compiler::derivation;
use linkage_compiler::graph::NodeId;
use linkage_report::drawing::Parts;
use linkage_runtime::skeleton::Part;

use crate::failure::Failure;
use crate::machine::{Machine, Motion};
use crate::terminal::say;

/// The joints and parts of a mechanism, and their places.
pub struct Figure<'m> {
    machine: &'m Machine,
    skeleton: &'m derivation::Skeleton,
}

impl<'m> Figure<'m> {
    pub fn of(machine: &'m Machine) -> Result<Self, Failure> {
        let skeleton = machine.about.derivation.skeleton.as_ref();
        let skeleton = skeleton.ok_or_else(|| {
            Failure::Outside(format!("`{}` has no drawing: write `derive drawing;` in it", machine.about.name))
        })?;
        for place in &skeleton.unplaced {
            say!(
                "loop {} of `{}` is drawn from the origin: if it begins at another joint, declare a point on it",
                place + 1,
                machine.about.name
            );
        }
        Ok(Self { machine, skeleton })
    }

    /// The places of the joints at a position.
    pub fn joints(&self, motion: &Motion) -> Result<Vec<[f64; 2]>, Failure> {
        self.places(&self.skeleton.joints.iter().map(|(_, at)| *at).collect::<Vec<_>>(), motion)
    }

    /// Applies a function to the parts, with the directions of guides at a position.
    pub fn with_parts<R>(&self, motion: &Motion, f: impl FnOnce(Parts<'_>) -> R) -> Result<R, Failure> {
        let joints: Vec<&str> = self.skeleton.joints.iter().map(|(name, _)| name.as_str()).collect();
        let parts: Vec<Part<'_>> = self.skeleton.parts.iter().map(part).collect();
        let guides = self.places(&self.skeleton.guides, motion)?;
        Ok(f(Parts { joints: &joints, parts: &parts, guides: &guides }))
    }

    fn places(&self, nodes: &[[NodeId; 2]], motion: &Motion) -> Result<Vec<[f64; 2]>, Failure> {
        let numbers = self.machine.formulas_at(nodes.as_flattened(), &motion.inputs, &motion.unknowns)?;
        Ok(numbers.chunks_exact(2).map(|at| [at[0], at[1]]).collect())
    }
}

fn part(part: &derivation::Part) -> Part<'_> {
    match part {
        derivation::Part::Ground(joint) => Part::Ground(*joint),
        derivation::Part::Bar { joints, is_driven } => Part::Bar { joints, is_driven: *is_driven },
        derivation::Part::Slider(joint) => Part::Slider(*joint),
        derivation::Part::Sleeve { pin, on, towards } => Part::Sleeve { pin: *pin, on: *on, towards: *towards },
        derivation::Part::Trace(joint) => Part::Trace(*joint),
    }
}
