//! The sheet with the numbers of a position.

use linkage_lent::Lender;
use linkage_report::sheet::Values;
use linkage_runtime::Mechanism as _;
use linkage_runtime::analysis::Analysis;

use crate::Refusal;
use crate::at::{coordinates, moving, rates};
use crate::machine::{Machine, prepared};
use crate::question::{At, Form, Language};

/// The sheet of a position; with a rate of the first input, also its velocities and accelerations.
pub fn sheet(machine: &Machine, at: &At, rate: Option<f64>, language: Language, form: Form) -> Result<String, Refusal> {
    let _ = language;
    let lender = Lender::default();
    let derivation = machine.documents.derivation(&lender).map_err(Refusal::new)?;
    let Some(derivation) = derivation else { return Err(Refusal::new("it has no formulas")) };
    let values = numbers(machine, at, rate, &derivation);
    let written = machine.documents.sheet(|sheet| {
        for (parameter, value) in machine.about.parameters.iter().zip(&at.parameters) {
            sheet.given(&parameter.name, *value);
        }
        if let Some(values) = values {
            sheet.at(values);
        }
        match form {
            Form::Html => sheet.to_html_fragment(),
            Form::Latex => sheet.to_latex(),
            Form::Text => sheet.to_text(),
        }
    });
    written.map_err(Refusal::new).map(Option::unwrap_or_default)
}

/// The numbers of the formulas; none if the mechanism cannot be moved, or rates do not exist at the position.
fn numbers(
    machine: &Machine,
    at: &At,
    rate: Option<f64>,
    derivation: &linkage_runtime::derivation::Derivation<'_>,
) -> Option<Values> {
    let design = machine.design(&at.parameters);
    let prepared = prepared(&design).ok()?;
    let mechanism = moving(&prepared).ok()?;
    let q = coordinates(&mechanism, &at.place).ok()?;
    let parameters = machine.about.parameters.iter().map(|parameter| parameter.name.as_str());
    let parameters = parameters.zip(at.parameters.iter().copied());
    let [moved, zero] = [rate.unwrap_or_default(), 0.0].map(|rate| rates(&mechanism, 0, rate));
    let analysis = Analysis::of(&mechanism, &mechanism.pose_at(&q), moved, zero).ok()?;
    Some(Values::of::<crate::at::Moving<'_>>(derivation, parameters, &q, &analysis))
}
