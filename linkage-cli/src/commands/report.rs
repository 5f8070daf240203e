//! `linkage report`: mobility, all positions at one choice of inputs, and of a mechanism with one input the circuits and one
//! motion from end to end.

use linkage_interpreter::{NotPrepared, Prepared};
use linkage_lent::{Documents, Lender};
use linkage_report::report::{ListedMode, Local, Modes, Report, ReportOptions, ReportedModes};
use linkage_runtime::derivation::Derivation;
use linkage_runtime::{BorrowedName, Branches, Column, D};

use super::draw::svg_or_message;
use crate::arguments;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::machine::{Machine, Motion};
use crate::motion::held;
use crate::output::{self, Form, form};
use crate::progress;

const FORMS: [Form; 2] = [("text", &["txt", "text", "md"]), ("HTML", &["html", "htm"])];

/// All positions at the inputs, each with its branch in words; or why they are not listed.
type Positions = Result<Vec<(String, Motion)>, String>;

pub fn run(arguments: &arguments::Report) -> Result<(), Failure> {
    let arguments::Report { numbers, place, output } = arguments;
    let is_page = form(output, "a report", &FORMS)? == Some(1);
    let (machine, documents) = &Machine::of_all(numbers, "a report has", Documents::of)?;
    let inputs = held(machine, &place.at, None)?;
    let positions = match machine.positions(&inputs) {
        // The reason is that of the position on the first branch.
        Ok(positions) if positions.is_empty() => {
            let why = machine.motion(&inputs, &vec![0.0; inputs.len()]).err();
            Err(why.unwrap_or_else(|| "there is none at these inputs".to_owned()))
        }
        positions => positions,
    };
    let lender = Lender::default();
    let Some(derivation) = documents.derivation(&lender)? else { return Ok(()) };
    let pictures = match is_page {
        false => None,
        true => {
            let figure = Figure::of(machine)?;
            let positions = positions.iter().flatten().zip(1..);
            let picture = |((_, motion), number): (&(String, Motion), usize)| {
                svg_or_message(machine, &figure, motion, &format!("mode {number}")).map(Option::unwrap_or_default)
            };
            Some(positions.map(picture).collect::<Result<_, _>>()?)
        }
    };
    let prepared = machine.solver.design.prepared();
    let text = match inputs.as_slice() {
        &[input] => match whole(machine, &prepared, &derivation, input, &positions) {
            Ok(report) => written(&report, pictures),
            Err(why) => {
                written(&Report { no_motion: Some(why), ..part(machine, &derivation, inputs, &positions) }, pictures)
            }
        },
        _ => written(&part(machine, &derivation, inputs, &positions), pictures),
    };
    output::write(output, text.as_bytes(), &numbers.source.file)
}

/// The report as text, or with pictures as a page.
fn written<N: BorrowedName>(report: &Report<N>, pictures: Option<Vec<String>>) -> String {
    pictures.map_or_else(|| report.to_string(), |pictures| report.to_html_with(&pictures))
}

/// The report with circuits and the motion through the first position from which it can be followed; or why there is none.
fn whole<'p>(
    machine: &Machine,
    prepared: &'p Result<Prepared<'_>, NotPrepared>,
    derivation: &Derivation<'_>,
    input: f64,
    positions: &Positions,
) -> Result<Report<&'p str>, String> {
    let positions = positions.as_ref().map_err(String::clone)?;
    if machine.about.unknowns.is_empty() {
        return Err("all positions are those of the input".to_owned());
    }
    let prepared = prepared.as_ref().map_err(NotPrepared::to_string)?;
    let mechanism = prepared.with_inputs::<D<1>>().map_err(|error| error.to_string())?;
    let starts = mechanism.all_positions(Column::from([input])).map_err(|error| error.to_string())?;
    let mut first = None;
    let found = progress::during("following".to_owned(), || {
        { starts }.find_map(|(_, start)| match Report::of(&mechanism, derivation, &start, &ReportOptions::default()) {
            Ok(report) => Some(report),
            Err(error) => {
                first.get_or_insert_with(|| machine.about.reasons.of_path(&error));
                None
            }
        })
    });
    if let Some(failure) = prepared.failure() {
        return Err(failure.to_string());
    }
    let mut report = found.ok_or_else(|| first.unwrap_or_default())?;
    if let ReportedModes::Listed(modes) = &mut report.modes {
        modes.modes.iter_mut().zip(positions).for_each(|(mode, (branch, _))| mode.branch.clone_from(branch));
    }
    Ok(report)
}

/// The report without circuits and a motion.
fn part(machine: &Machine, derivation: &Derivation<'_>, inputs: Vec<f64>, positions: &Positions) -> Report {
    let of_unknown =
        |name: &str| machine.about.unknowns.iter().chain(&machine.about.inputs).find(|of| of.name.text == name);
    let is_angle = |name: &str| of_unknown(name).is_some_and(|of| of.is_angle);
    let modes = match positions {
        Ok(positions) => ReportedModes::Listed(Modes {
            inputs,
            modes: positions.iter().map(listed).collect(),
            motions: Vec::new(),
            circuits: Vec::new(),
            followed: None,
        }),
        Err(why) => ReportedModes::Missing(why.clone()),
    };
    let of_position = |(_, motion): &(String, Motion)| {
        let are_angles = machine.about.unknowns.iter().map(|unknown| unknown.is_angle).collect();
        let (pose, jacobian) = (motion.pose(), machine.jacobian(motion));
        Local::new(derivation, are_angles, jacobian, move |rates| machine.gamma(&pose, rates))
    };
    let at_modes: Vec<Local<'_>> = positions.iter().flatten().map(of_position).collect();
    Report::of_data(derivation, is_angle, modes, &at_modes)
}

fn listed((branch, motion): &(String, Motion)) -> ListedMode {
    ListedMode { branch: branch.clone(), unknowns: motion.unknowns.clone(), motion: None, transmission: Vec::new() }
}
