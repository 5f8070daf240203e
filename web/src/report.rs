//! The report of a mechanism.

use linkage_interpreter::Prepared;
use linkage_report::lend::Lender;
use linkage_report::report::{MOST_MODES, Report, ReportOptions, ReportedModes};
use linkage_runtime::derivation::Derivation;
use linkage_runtime::{BorrowedName, Branches as _, Column, D, Mechanism as _, PathError};

use crate::Refusal;
use crate::at::{Coordinates, coordinates, moving};
use crate::machine::{Machine, prepared};
use crate::picture::drawing;
use crate::question::At;

/// The report as the sections of a page: with the motion through the position, or with the reason why there is none.
pub fn report(machine: &Machine, at: &At) -> Result<String, Refusal> {
    let lender = Lender::default();
    let Some(driver) = &machine.documents.driver else {
        return Err(Refusal::new("it has no formulas to report on"));
    };
    let derivation = lender.derivation(driver).map_err(Refusal::new)?;
    let design = machine.design(&at.parameters);
    let prepared = prepared(&design)?;
    let mechanism = moving(&prepared)?;
    let q = coordinates(&mechanism, &at.place)?;
    // Each with its branch in the words of the program, not as the value in Rust.
    let listed: Vec<(String, Coordinates)> = match mechanism.all_positions(q.inputs) {
        Ok(all) => {
            let within = all.filter(|(_, q)| mechanism.is_within_ranges(q).unwrap_or(false));
            within.take(MOST_MODES).map(|(branch, q)| (branch.to_string(), q)).collect()
        }
        Err(_) => Vec::new(),
    };
    // The page says of a mode without a picture that it has none.
    let picture = |q: &Coordinates| drawing(&mechanism, q)?.to_svg().map_err(Refusal::new);
    let pictures = listed.iter().map(|(_, q)| picture(q).unwrap_or_default()).collect::<Vec<_>>();
    let text = match whole(machine, &prepared, &derivation, at) {
        Ok(report) => written(report, &listed, &pictures),
        Err(why) => {
            let part = Report::at(&mechanism, &derivation, &q);
            written(Report { no_motion: Some(why.why), ..part }, &listed, &pictures)
        }
    };
    match prepared.failure() {
        Some(failure) => Err(Refusal::new(failure)),
        None => Ok(text),
    }
}

/// The report of the motion of a mechanism with one input.
fn whole<'p>(
    machine: &Machine,
    prepared: &'p Prepared<'p>,
    derivation: &Derivation<'_>,
    at: &At,
) -> Result<Report<&'p str>, Refusal> {
    let mechanism = prepared.with_inputs::<D<1>>().map_err(Refusal::new)?;
    let few = || Refusal::new("the position has other numbers than the mechanism");
    let start = linkage_interpreter::CoordinatesAtRunTime {
        unknowns: Column::from_slice(&at.place.unknowns).ok_or_else(few)?,
        inputs: Column::from_slice(&at.place.inputs).ok_or_else(few)?,
    };
    let options = ReportOptions::default();
    let words = |why: &PathError<&'p str>| Refusal::of_path(&machine.about, why).why;
    Ok(Report::in_words(&mechanism, derivation, &start, &options, &words).unwrap_or_else(|why| Report {
        no_motion: Some(words(&why)),
        ..Report::of_circuits(&mechanism, derivation, &start, &options)
    }))
}

fn written<N: BorrowedName>(mut report: Report<N>, listed: &[(String, Coordinates)], pictures: &[String]) -> String {
    if let ReportedModes::Listed(modes) = &mut report.modes {
        modes.modes.iter_mut().zip(listed).for_each(|(mode, (branch, _))| mode.branch.clone_from(branch));
    }
    report.to_html_fragment_with(pictures)
}
