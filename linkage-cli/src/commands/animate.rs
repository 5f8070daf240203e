//! `linkage animate`: a motion of the mechanism, as SVG or GIF.

use std::f64::consts::TAU;

use super::draw::{ending, next_to, painter, undrawn};
use crate::arguments::Animate;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::machine::{Machine, Motion};
use crate::motion::Path;
use crate::output;
use crate::progress;

/// Pixels of a GIF for each unit of a drawing.
const SCALE: f32 = 1.5;

pub fn run(arguments: &Animate) -> Result<(), Failure> {
    let file = &arguments.numbers.source.file;
    let output = arguments.output.clone().unwrap_or_else(|| next_to(file));
    let is_gif = match ending(&output).as_str() {
        "svg" | "" => false,
        "gif" => true,
        other => return Err(Failure::Argument(format!("a film is SVG or GIF: write -o NAME.gif, not `.{other}`"))),
    };
    let seconds = arguments.seconds.number;
    if seconds <= 0.0 {
        return Err(Failure::Argument("a film takes more than 0 seconds".to_owned()));
    }
    let machine = Machine::of(&arguments.numbers)?;
    let figure = Figure::of(&machine)?;
    let path = Path::of(&machine, &arguments.along)?;
    let frames = frames(&machine, &path, arguments.along.steps)?;
    let Some(first) = frames.first() else { return Ok(()) };
    let joints = frames.iter().map(|motion| figure.joints(motion));
    let film = figure.with_parts(first, |parts| parts.animation(machine.name.as_str(), joints, seconds));
    let contents = match is_gif {
        false => film.to_svg().map_err(undrawn)?.into_bytes(),
        true => {
            let pictures = film.frames_to_svg().map_err(undrawn)?;
            // The last frame is the first one again.
            let count = pictures.len() - 1;
            let painter = painter(SCALE);
            let pictures = progress::over("painting", pictures.take(count));
            painter.gif(pictures, seconds).map_err(Failure::Outside)?
        }
    };
    output::write(&output, &contents, file)
}

/// The positions of a film, the first one again at its end: over a whole turn, or forth and back over the longest part of the
/// inputs that has positions. A part of a turn can pass its beginning.
fn frames(machine: &Machine, path: &Path, steps: u32) -> Result<Vec<Motion>, Failure> {
    let rates = vec![0.0; machine.inputs.len()];
    let at = |value: f64| machine.motion(&path.at(value), &rates);
    let all: Vec<Result<Motion, String>> = (0..=steps).map(|step| at(path.step(step, steps))).collect();
    let is_turn = path.is_turn(machine);
    if is_turn && all.iter().all(Result::is_ok) {
        return all.into_iter().collect::<Result<_, _>>().map_err(Failure::Outside);
    }
    let last = if is_turn { 2 * steps } else { steps };
    let Some([first, last]) = longest(last, |step| all[(step % (steps + u32::from(!is_turn))) as usize].is_ok()) else {
        let error = all.into_iter().find_map(Result::err);
        return Err(Failure::Outside(error.unwrap_or_default()));
    };
    let [from, to] = [first, last].map(|step| path.step(step, steps));
    let middle = f64::midpoint(from, to);
    let slow = |step: u32| match 2 * step == steps {
        // Exactly: the sum below may differ in the last digit.
        true => to,
        false => middle - (to - middle) * (TAU * f64::from(step % steps) / f64::from(steps)).cos(),
    };
    (0..=steps).map(|step| at(slow(step))).collect::<Result<_, _>>().map_err(Failure::Outside)
}

/// The first and the last step of the longest part in which all have positions; none if it is one step or less.
fn longest(last: u32, has_position: impl Fn(u32) -> bool) -> Option<[u32; 2]> {
    let mut longest: Option<[u32; 2]> = None;
    let mut first = 0;
    for step in 0..=last {
        if !has_position(step) {
            first = step + 1;
        } else if step > first && longest.is_none_or(|[from, to]| to - from < step - first) {
            longest = Some([first, step]);
        }
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_part_can_pass_the_beginning_of_a_turn() {
        let turn = [true, true, false, false, true, false, true, true];
        assert_eq!(longest(15, |step| turn[step as usize % 8]), Some([6, 9]));
        assert_eq!(longest(7, |step| turn[step as usize]), Some([0, 1]));
        assert_eq!(longest(7, |step| step == 3), None);
    }
}
