//! `linkage report`: mobility, all positions at one choice of inputs, and of a mechanism with one input the circuits and one
//! motion from end to end.

use linkage_interpreter::{CoordinatesAtRunTime, NotPrepared, Prepared};
use linkage_report::lend::Lender;
use linkage_report::report::{ListedMode, Local, MOST_MODES, Modes, Report, ReportOptions, ReportedModes};
use linkage_runtime::derivation::Derivation;
use linkage_runtime::{BorrowedName, Column, D, Mechanism as _, PathError};

use super::draw::svg_or_message;
use crate::arguments;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::machine::{Machine, Motion};
use crate::motion::held;
use crate::one_input::Inputs;
use crate::output::{self, Form, form};
use crate::progress;

/// The most positions from which a motion is tried to be followed.
const MOST_TRIALS: usize = 8;

const FORMS: [Form; 2] = [("text", &["txt", "text", "md"]), ("HTML", &["html", "htm"])];

/// Positions at the inputs, each with its branch in words, and how many more there may be; or why they are not listed.
type Positions = Result<(Vec<(String, Motion)>, usize), String>;

pub fn run(arguments: &arguments::Report) -> Result<(), Failure> {
    let arguments::Report { numbers, place, output } = arguments;
    let is_page = form(output, "a report", &FORMS)? == Some(1);
    let (machine, documents) = &Machine::of_all(numbers, |lowered| lowered.documents())?;
    let inputs = held(machine, &place.at, None)?;
    let prepared = machine.solver.design.prepared();
    let positions = positions(machine, &prepared, &inputs);
    // A position that is asked for exists, or the report has none.
    let chosen = match numbers.choose() {
        true => Some(machine.place(&inputs, &vec![0.0; inputs.len()]).map_err(Failure::Outside)?),
        false => None,
    };
    let lender = Lender::default();
    let Some(driver) = &documents.driver else { return Ok(()) };
    let derivation = lender.derivation(driver)?;
    let pictures = match is_page {
        false => None,
        true => {
            let figure = Figure::of(machine)?;
            let positions = positions.iter().flat_map(|(positions, _)| positions).zip(1..);
            let picture = |((_, motion), number): (&(String, Motion), usize)| {
                svg_or_message(machine, &figure, motion, &format!("mode {number}")).map(Option::unwrap_or_default)
            };
            Some(positions.map(picture).collect::<Result<_, _>>()?)
        }
    };
    let text = match inputs.as_slice() {
        &[input] => match whole(machine, &prepared, &derivation, (input, chosen), &positions) {
            Ok(report) => written(&report, pictures),
            Err(why) => {
                written(&Report { no_motion: Some(why), ..part(machine, &derivation, inputs, &positions) }, pictures)
            }
        },
        _ => written(&part(machine, &derivation, inputs, &positions), pictures),
    };
    output::write(output, text.as_bytes(), &numbers.source.file)
}

/// The first positions at the inputs in the declared ranges.
fn positions(machine: &Machine, prepared: &Result<Prepared<'_>, NotPrepared>, inputs: &[f64]) -> Positions {
    let (mut positions, more) = machine.first_positions(inputs, MOST_MODES)?;
    if positions.is_empty() {
        // The reason is that of the position on the first branch.
        let why = machine.motion(inputs, &vec![0.0; inputs.len()]).err();
        return Err(why.unwrap_or_else(|| "there is none at these inputs".to_owned()));
    }
    if let Ok(prepared) = prepared
        && let Ok(mechanism) = prepared.with_inputs::<Inputs>()
    {
        let (all, mut outside) = (std::mem::take(&mut positions), None);
        for (branch, motion) in all {
            let (unknowns, inputs) = (Column::from_slice(&motion.unknowns), Column::from_slice(inputs));
            let at = unknowns.zip(inputs).map(|(unknowns, inputs)| CoordinatesAtRunTime { unknowns, inputs });
            match at.map_or(Ok(true), |at| mechanism.is_within_ranges(&at)) {
                Ok(true) => positions.push((branch, motion)),
                Ok(false) => _ = outside.get_or_insert("no position at these inputs is in the declared ranges"),
                Err(error) => return Err(error.to_string()),
            }
        }
        if let Some(why) = outside.filter(|_| positions.is_empty()) {
            return Err(why.to_owned());
        }
    }
    Ok((positions, more))
}

/// The report as text, or with pictures as a page.
fn written<N: BorrowedName>(report: &Report<N>, pictures: Option<Vec<String>>) -> String {
    pictures.map_or_else(|| report.to_string(), |pictures| report.to_html_with(&pictures))
}

/// The report with circuits and the motion through the chosen position, or the first from which it can be followed; or why
/// there are no circuits.
fn whole<'p>(
    machine: &Machine,
    prepared: &'p Result<Prepared<'_>, NotPrepared>,
    derivation: &Derivation<'_>,
    (input, chosen): (f64, Option<Vec<f64>>),
    positions: &Positions,
) -> Result<Report<&'p str>, String> {
    if machine.about.unknowns.is_empty() {
        return Err("all positions are those of the input".to_owned());
    }
    if let (Err(why), None) = (positions, &chosen) {
        return Err(why.clone());
    }
    let prepared = prepared.as_ref().map_err(NotPrepared::to_string)?;
    let mechanism = prepared.with_inputs::<D<1>>().map_err(|error| error.to_string())?;
    let listed = positions.as_ref().map_or(&[][..], |(positions, _)| positions);
    let starts = chosen.iter().chain(listed.iter().map(|(_, motion)| &motion.unknowns).filter(|_| chosen.is_none()));
    let starts = starts.take(MOST_TRIALS).filter_map(|unknowns| {
        Some(CoordinatesAtRunTime { unknowns: Column::from_slice(unknowns)?, inputs: Column::from([input]) })
    });
    let starts: Vec<_> = starts.collect();
    let options = ReportOptions::default();
    let mut first = None;
    let found = progress::during("following".to_owned(), || {
        let words = |error: &PathError<&str>| machine.about.reasons.of_path(error);
        let found =
            starts.iter().find_map(|start| match Report::in_words(&mechanism, derivation, start, &options, &words) {
                Ok(report) => Some(report),
                Err(error) => {
                    first.get_or_insert_with(|| words(&error));
                    None
                }
            });
        found.or_else(|| Some(Report::of_circuits(&mechanism, derivation, starts.first()?, &options)))
    });
    if let Some(failure) = prepared.failure() {
        return Err(failure.to_string());
    }
    let mut report = found.ok_or("the position has too many numbers")?;
    report.no_motion = report.no_motion.or(first);
    if let ReportedModes::Listed(modes) = &mut report.modes {
        modes.modes.iter_mut().zip(listed).for_each(|(mode, (branch, _))| mode.branch.clone_from(branch));
    }
    Ok(report)
}

/// The report without circuits and a motion.
fn part(machine: &Machine, derivation: &Derivation<'_>, inputs: Vec<f64>, positions: &Positions) -> Report {
    let of_unknown =
        |name: &str| machine.about.unknowns.iter().chain(&machine.about.inputs).find(|of| of.name.text == name);
    let is_angle = |name: &str| of_unknown(name).is_some_and(|of| of.is_angle);
    let modes = match positions {
        Ok((positions, left_out)) => ReportedModes::Listed(Modes {
            left_out: *left_out,
            ..Modes::only(inputs, positions.iter().map(listed).collect())
        }),
        Err(why) => ReportedModes::Missing(why.clone()),
    };
    let of_position = |(_, motion): &(String, Motion)| {
        let are_angles = machine.about.unknowns.iter().map(|unknown| unknown.is_angle).collect();
        let (pose, jacobian) = (motion.pose(), machine.jacobian(motion));
        Local::new(derivation, are_angles, jacobian, move |rates| machine.gamma(&pose, rates))
    };
    let at_modes: Vec<Local<'_, '_>> = positions.iter().flat_map(|(all, _)| all).map(of_position).collect();
    Report::of_data(derivation, is_angle, modes, &at_modes)
}

fn listed((branch, motion): &(String, Motion)) -> ListedMode {
    ListedMode { branch: branch.clone(), unknowns: motion.unknowns.clone(), motion: None, transmission: Vec::new() }
}
