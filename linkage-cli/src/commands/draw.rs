//! `linkage draw`: the mechanism at one position, as SVG or PNG.

use std::path::{Path, PathBuf};

use linkage_report::drawing::DrawingError;

use crate::arguments::Draw;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::machine::Machine;
use crate::motion::held;
use crate::output;
use crate::picture::{Painter, SHARP};

pub fn run(arguments: &Draw) -> Result<(), Failure> {
    let file = &arguments.numbers.source.file;
    let output = arguments.output.clone().unwrap_or_else(|| next_to(file));
    let is_png = match ending(&output).as_str() {
        "svg" | "" => false,
        "png" => true,
        other => return Err(Failure::Argument(format!("a picture is SVG or PNG: write -o NAME.svg, not `.{other}`"))),
    };
    let machine = Machine::of(&arguments.numbers)?;
    let figure = Figure::of(&machine)?;
    let inputs = held(&machine, &arguments.at, None)?;
    let motion = machine.motion(&inputs, &vec![0.0; inputs.len()]).map_err(Failure::Outside)?;
    let drawing = figure.with_parts(&motion, |parts| parts.drawing(machine.name.as_str(), figure.joints(&motion)));
    let contents = match is_png {
        false => drawing.to_svg().map_err(undrawn)?.into_bytes(),
        true => painter(SHARP).png(&drawing.to_plain_svg().map_err(undrawn)?).map_err(Failure::Outside)?,
    };
    output::write(&output, &contents, file)
}

/// The file with the ending of a picture, or standard output.
pub fn next_to(file: &Path) -> PathBuf {
    if crate::source::is_standard(file) { PathBuf::from("-") } else { file.with_extension("svg") }
}

/// The ending of a file in small letters.
pub fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// A painter; a message if it has no fonts.
pub fn painter(scale: f32) -> Painter {
    let painter = Painter::new(scale);
    if painter.is_without_fonts() {
        anstream::eprintln!("this system has no fonts: the picture has no names; SVG has them");
    }
    painter
}

pub fn undrawn(error: DrawingError) -> Failure {
    Failure::Outside(error.to_string())
}
