//! `linkage report`: mobility, and all positions at one choice of inputs.

use linkage_lent::Lender;
use linkage_report::report::{ListedMode, Local, Modes, Report, ReportedModes};

use super::documents::Documents;
use super::draw::drawing;
use crate::arguments;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::machine::{Machine, Motion};
use crate::motion::held;
use crate::output::{self, Form, form};

const FORMS: [Form; 2] = [("text", &["txt", "text", "md"]), ("HTML", &["html", "htm"])];

pub fn run(arguments: &arguments::Report) -> Result<(), Failure> {
    let arguments::Report { numbers, place, output } = arguments;
    let is_page = form(output, "a report", &FORMS)? == Some(1);
    let (machine, documents) = &Machine::of_all(numbers, "a report has", Documents::of)?;
    let inputs = held(machine, &place.at, None)?;
    let positions = machine.positions(&inputs);
    let of_unknown =
        |name: &str| machine.about.unknowns.iter().chain(&machine.about.inputs).find(|of| of.name.text == name);
    let is_angle = |name: &str| of_unknown(name).is_some_and(|of| of.is_angle);
    let modes = match &positions {
        // The reason is that of the position on the first branch.
        Ok(positions) if positions.is_empty() => {
            let why = machine.motion(&inputs, &vec![0.0; inputs.len()]).err();
            ReportedModes::Missing(why.unwrap_or_else(|| "there is none at these inputs".to_owned()))
        }
        Ok(positions) => ReportedModes::Listed(Modes {
            inputs: inputs.clone(),
            modes: positions.iter().map(listed).collect(),
            motions: Vec::new(),
            circuits: Vec::new(),
            followed: None,
        }),
        Err(why) => ReportedModes::Missing(why.clone()),
    };
    let lender = Lender::default();
    let Some(derivation) = documents.derivation(&lender)? else { return Ok(()) };
    let of_position = |(_, motion): &(String, Motion)| {
        let are_angles = machine.about.unknowns.iter().map(|unknown| unknown.is_angle).collect();
        let (pose, jacobian) = (motion.pose(), machine.jacobian(motion));
        Local::new(&derivation, are_angles, jacobian, move |rates| machine.gamma(&pose, rates))
    };
    let at_modes: Vec<Local<'_>> = positions.iter().flatten().map(of_position).collect();
    let report = Report::of_data(&derivation, is_angle, modes, &at_modes);
    let text = match is_page {
        false => report.to_string(),
        true => {
            let figure = Figure::of(machine)?;
            let positions = positions.unwrap_or_default();
            let pictures = positions.iter().filter_map(|(_, motion)| drawing(machine, &figure, motion).to_svg().ok());
            report.to_html_with(&pictures.collect::<Vec<_>>())
        }
    };
    output::write(output, text.as_bytes(), &numbers.source.file)
}

fn listed((branch, motion): &(String, Motion)) -> ListedMode {
    ListedMode { branch: branch.clone(), unknowns: motion.unknowns.clone(), motion: None, transmission: Vec::new() }
}
