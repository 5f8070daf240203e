//! The rows of a case that are not on one motion.

use linkage_runtime::lanes::{Given, Lanes};
use linkage_runtime::range_of_motion::{RangeOfMotion, RangeOptions};
use linkage_runtime::{Assembly, D, Dim, Kinematic, Mechanism, PathError, PerInput};

use crate::{Sweep, SweepError};

/// A row whose position is not on the motion of its case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffMotion {
    /// The row.
    pub row: u64,
    /// Why the motion does not reach this input; none if it has another position there.
    pub ended: Option<PathError>,
}

impl<M> Sweep<M>
where
    M: Lanes
        + Assembly
        + Kinematic<V = D<1>>
        + Mechanism<Scalar = <M as Lanes>::Scalar, Name = &'static str, Branch = <M as Lanes>::Branch>,
{
    /// The accepted rows of a case, planned as a turn or a grid of the input, that are not on one motion: that of its first
    /// accepted row, which passes change points smoothly. The rows of a sweep are positions on a branch, which may jump from
    /// one motion to another at a change point.
    ///
    /// It follows one motion and compares each row with it, which takes much longer than the rows themselves.
    ///
    /// # Errors
    /// [`SweepError::OutOfRange`]; [`SweepError::SeveralDesigns`] if a parameter varies within the case;
    /// [`SweepError::NoMotion`] if the motion cannot be followed from any of its rows.
    pub fn off_motion(&self, case: u64) -> Result<Vec<OffMotion>, SweepError> {
        let rows_per_case = self.rows_per_case();
        let cases = self.rows() / rows_per_case;
        if case >= cases {
            return Err(SweepError::OutOfRange { quantity: "case", number: case, count: cases });
        }
        let first = case * rows_per_case;
        let parameters = self.numbers(first)?;
        let mut inputs = Vec::new();
        for row in first..first + rows_per_case {
            let numbers = self.numbers(row)?;
            if numbers[..M::PARAMETERS] != parameters[..M::PARAMETERS] {
                return Err(SweepError::SeveralDesigns { case });
            }
            // A mechanism with closed forms has the inputs next to the parameters.
            inputs.push((row, numbers[M::PARAMETERS]));
        }
        let given: Given<M, [<M as Lanes>::Scalar; 1]> = M::Given::default().array(|column| [parameters[column]]);
        let design = M::design(&given, 0);
        let position = |input| {
            let pose = design.assemble(PerInput::<M>::from([input]).into(), self.branch())?;
            Ok::<_, PathError>(M::coordinates_of(&pose))
        };
        let starts = inputs.iter().map(|(_, input)| *input);
        let range = RangeOfMotion::on_branch(&design, self.branch(), starts, RangeOptions::through_change_points())
            .map_err(|error| SweepError::NoMotion { case, error })?;
        let off = inputs.into_iter().filter_map(|(row, input)| match range.has(&position(input).ok()?) {
            Ok(true) => None,
            Ok(false) => Some(OffMotion { row, ended: None }),
            Err(error) => Some(OffMotion { row, ended: Some(error) }),
        });
        Ok(off.collect())
    }
}
