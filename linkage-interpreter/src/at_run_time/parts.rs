//! The parts of a drawing.

use linkage_runtime::skeleton::{NoDrawing, Part};

use super::MOST_JOINTS;
use crate::program::{self, Driver};

/// The parts of a drawing, or the reason why there is none.
pub(crate) fn drawing(driver: &Driver) -> Result<Vec<Part<'_>>, NoDrawing> {
    let drawing = driver.written.drawing.as_ref().ok_or(NoDrawing::NotDerived)?;
    match drawing.joints.len() {
        ..=MOST_JOINTS => Ok(drawing.parts.iter().map(part).collect()),
        joints => Err(NoDrawing::TooLarge { joints, most: MOST_JOINTS }),
    }
}

fn part(of: &program::Part) -> Part<'_> {
    match *of {
        program::Part::Ground(joint) => Part::Ground(joint),
        program::Part::Bar { ref joints, is_driven } => Part::Bar { joints, is_driven },
        program::Part::Slider(joint) => Part::Slider(joint),
        program::Part::Sleeve { pin, on, towards } => Part::Sleeve { pin, on, towards },
        program::Part::Trace(joint) => Part::Trace(joint),
    }
}
