//! `linkage draw`: the mechanism at one position, as SVG or PNG.

use linkage_report::drawing::{Drawing, DrawingError};

use crate::arguments::Draw;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::machine::{Machine, Motion};
use crate::motion::held;
use crate::output::{self, Form, form, next_to};
use crate::picture::{Painter, SHARP};
use crate::terminal::say;

const FORMS: [Form; 2] = [("SVG", &["svg"]), ("PNG", &["png"])];

pub fn run(arguments: &Draw) -> Result<(), Failure> {
    let file = &arguments.numbers.source.file;
    let output = arguments.output.clone().unwrap_or_else(|| next_to(file, "svg"));
    let is_png = form(&output, "a picture", &FORMS)? == Some(1);
    let machine = Machine::of(&arguments.numbers)?;
    let figure = Figure::of(&machine)?;
    let inputs = held(&machine, &arguments.place.at, None)?;
    let motion = machine.motion(&inputs, &vec![0.0; inputs.len()]).map_err(Failure::Outside)?;
    let mut drawing = drawing(&machine, &figure, &motion)?;
    if let Some(width) = arguments.size.width {
        drawing.width(width);
    }
    let contents = match is_png {
        false => drawing.to_svg().map_err(undrawn)?.into_bytes(),
        true => {
            let painter = painter(arguments.size.width.map_or(SHARP, |_| 1.0));
            painter.png(&drawing.to_plain_svg().map_err(undrawn)?).map_err(Failure::Outside)?
        }
    };
    output::write(&output, &contents, file)
}

/// The drawing of a position.
pub fn drawing(machine: &Machine, figure: &Figure<'_>, motion: &Motion) -> Result<Drawing, Failure> {
    let joints = figure.joints(motion)?;
    figure.with_parts(motion, |parts| parts.drawing(machine.about.name.as_str(), joints))
}

/// The picture of a position as SVG; where there is none, a message says why.
pub fn svg_or_message(
    machine: &Machine,
    figure: &Figure<'_>,
    motion: &Motion,
    of: &str,
) -> Result<Option<String>, Failure> {
    match drawing(machine, figure, motion)?.to_svg() {
        Ok(svg) => Ok(Some(svg)),
        Err(error) => {
            say!("{of} has no picture: {error}");
            Ok(None)
        }
    }
}

/// A painter; a message if it has no fonts.
pub fn painter(scale: f32) -> Painter {
    let painter = Painter::new(scale);
    if painter.is_without_fonts() {
        say!("this system has no fonts: the picture has no names; SVG has them");
    }
    painter
}

pub fn undrawn(error: DrawingError) -> Failure {
    Failure::Outside(error.to_string())
}
