//! The sheet with the numbers of a position.

use linkage_report::lend::Lender;
use linkage_report::sheet::MotionNumbers;
use linkage_runtime::Kinematic as _;

use crate::Refusal;
use crate::at::{coordinates, moving, rates};
use crate::machine::{Machine, prepared};
use crate::question::{At, Form, Language};

/// The sheet of a position; with a rate of the first input, also its velocities and accelerations. A mechanism that cannot be
/// moved, or has no rates at the position, has a sheet without numbers.
pub fn sheet(machine: &Machine, at: &At, rate: Option<f64>, language: Language, form: Form) -> Result<String, Refusal> {
    let numbers = numbers(machine, at, rate).ok();
    let lender = Lender::default();
    let sheet = lender.whole(&machine.documents).map_err(Refusal::new)?;
    let mut sheet = sheet.ok_or_else(|| Refusal::new("it has no formulas"))?;
    sheet.language(language.of_sheet());
    for (parameter, value) in machine.about.parameters.iter().zip(&at.parameters) {
        sheet.given(&parameter.name, *value);
    }
    if let Some(numbers) = numbers {
        sheet.motion(&numbers);
    }
    Ok(match form {
        Form::Html => sheet.to_html_fragment(),
        Form::Latex => sheet.to_latex(),
        Form::Text => sheet.to_text(),
    })
}

/// The numbers of a position.
fn numbers(machine: &Machine, at: &At, rate: Option<f64>) -> Result<MotionNumbers, Refusal> {
    let design = machine.design(&at.parameters);
    let prepared = prepared(&design)?;
    let mechanism = moving(&prepared)?;
    let q = coordinates(&mechanism, &at.place)?;
    let [moved, zero] = [rate.unwrap_or_default(), 0.0].map(|rate| rates(&mechanism, 0, rate));
    let motion = mechanism.motion(&q, moved, zero).map_err(|error| Refusal::of_position(&error))?;
    let numbers = MotionNumbers::of(&mechanism, &motion).map_err(|error| Refusal::of_position(&error))?;
    Ok(MotionNumbers { has_rates: rate.is_some(), ..numbers })
}
