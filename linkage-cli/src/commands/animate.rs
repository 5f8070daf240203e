//! `linkage animate`: a motion of the mechanism, as SVG or GIF.

use std::f64::consts::TAU;

use super::draw::{painter, undrawn};
use crate::arguments::Animate;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::followed::Followed;
use crate::machine::{Machine, Motion};
use crate::motion::Path;
use crate::output::{self, Form, form, next_to};
use crate::picture::MOST_FRAMES;
use crate::progress;
use crate::terminal::say;

const FORMS: [Form; 2] = [("SVG", &["svg"]), ("GIF", &["gif"])];

/// Pixels of a GIF for each unit of a drawing.
const SCALE: f32 = 1.5;

/// The seconds of a film without a rate, and the most: players count those of a frame in 16 bits.
const SECONDS: f64 = 4.0;
const MOST_SECONDS: f64 = 600.0;

/// A motion that takes less cannot be seen: ten frames of a GIF.
const LEAST_SECONDS: f64 = 0.2;

/// The most frames of an SVG, which has the places of all joints in each.
const MOST_STEPS: u32 = 10_000;

/// A film jumps where a joint is farther from its first place than this part of the picture.
const JUMP: f64 = 1e-6;

pub fn run(arguments: &Animate) -> Result<(), Failure> {
    let file = &arguments.numbers.source.file;
    let output = arguments.output.clone().unwrap_or_else(|| next_to(file, "svg"));
    let is_gif = form(&output, "a film", &FORMS)? == Some(1);
    let steps = arguments.along.steps;
    if steps > MOST_STEPS {
        return Err(Failure::Argument(format!("a film has at most {MOST_STEPS} steps")));
    }
    let machine = Machine::of(&arguments.numbers)?;
    let figure = Figure::of(&machine)?;
    let path = Path::of(&machine, &arguments.along)?;
    let prepared = machine.solver.design.prepared();
    let followed = Followed::of(&machine, &prepared, &path, (0..=steps).map(|step| path.step(step, steps)))?;
    let course = course(&machine, &followed, &path, steps, arguments.back_and_forth)?;
    let seconds = seconds(arguments, course.length())?;
    // At least two, so that something moves.
    let steps = if is_gif { steps.min((MOST_FRAMES * seconds) as u32).max(2) } else { steps };
    let frames = frames(&followed, course, steps)?;
    let [Some(first), Some(last)] = [frames.first(), frames.last()] else { return Ok(()) };
    if is_far(&figure.joints(first)?, &figure.joints(last)?) {
        say!(
            "the film jumps back to its start, which is another position: \
             write more turns with --to, or --back-and-forth"
        );
    }
    let joints = frames.iter().map(|motion| figure.joints(motion)).collect::<Result<Vec<_>, Failure>>()?;
    let mut film = figure.with_parts(first, |parts| parts.animation(machine.about.name.as_str(), joints, seconds))?;
    if let Some(width) = arguments.size.width {
        film.width(width);
    }
    let contents = match is_gif {
        false => film.to_svg().map_err(undrawn)?.into_bytes(),
        true => {
            let pictures = film.frames_to_svg().map_err(undrawn)?;
            // The last frame is the first one again.
            let count = pictures.len() - 1;
            let painter = painter(arguments.size.width.map_or(SCALE, |_| 1.0));
            let pictures = progress::over("painting", pictures.take(count));
            painter.gif(pictures, seconds)?
        }
    };
    output::write(&output, &contents, file)
}

/// The seconds that a film takes in which the input moves by this much.
fn seconds(arguments: &Animate, length: f64) -> Result<f64, Failure> {
    let seconds = match (arguments.rate, arguments.seconds) {
        (Some(rate), _) if rate.number == 0.0 => return Err(Failure::Argument("--rate is not 0".to_owned())),
        (Some(rate), _) => {
            let seconds = length / rate.number.abs();
            if seconds < LEAST_SECONDS {
                let message =
                    format!("at this --rate the film takes {seconds:.3} seconds: for slow motion write --seconds");
                return Err(Failure::Argument(message));
            }
            seconds
        }
        (None, given) => given.map_or(SECONDS, |seconds| seconds.number),
    };
    match seconds > 0.0 && seconds <= MOST_SECONDS {
        true => Ok(seconds),
        false => {
            let takes = if arguments.rate.is_some() { format!(", not {seconds:.3e}") } else { String::new() };
            Err(Failure::Argument(format!("a film takes more than 0 and at most {MOST_SECONDS} seconds{takes}")))
        }
    }
}

/// The motion of the input in a film.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Course {
    /// From the first value to the last.
    Once([f64; 2]),
    /// From the first value to the last and back.
    BackAndForth([f64; 2]),
}

impl Course {
    /// The way of the input.
    fn length(self) -> f64 {
        match self {
            Self::Once([from, to]) => (to - from).abs(),
            Self::BackAndForth([from, to]) => 2.0 * (to - from).abs(),
        }
    }

    /// The input at one of this number of steps: back and forth as a sine, which stands still at both ends.
    fn at(self, step: u32, steps: u32) -> f64 {
        let share = f64::from(step) / f64::from(steps);
        match self {
            // Exactly at both ends: the sums may differ in the last digit.
            Self::Once([_, to]) if step == steps => to,
            Self::Once([from, to]) => from + (to - from) * share,
            Self::BackAndForth([_, to]) if 2 * step == steps => to,
            Self::BackAndForth([from, _]) if step.is_multiple_of(steps) => from,
            Self::BackAndForth([from, to]) => {
                let middle = f64::midpoint(from, to);
                middle - (to - middle) * (TAU * share).cos()
            }
        }
    }
}

/// Once over whole turns that have all positions; else back and forth over the longest part that has, which may pass the
/// beginning of a turn. Messages say so.
fn course(
    machine: &Machine,
    followed: &Followed<'_>,
    path: &Path,
    steps: u32,
    is_back_and_forth: bool,
) -> Result<Course, Failure> {
    let at = |step: u32| followed.motion(path.step(step, steps), 0.0);
    let errors: Vec<Option<String>> = progress::over("computing", 0..steps + 1).map(|step| at(step).err()).collect();
    let without = (0..=steps).zip(&errors).filter_map(|(step, error)| Some((path.step(step, steps), error.clone()?)));
    let without: Vec<(f64, String)> = without.collect();
    let missing = without.len();
    let first_error = without.first().map(|(_, error)| error);
    if missing <= steps as usize {
        followed.say(&without, &format!("{} frames", steps + 1));
    }
    // A film with missing positions may pass the beginning of a turn where these are the same a turn later.
    let is_turn = path.is_turn(machine) && (missing == 0 || followed.repeats());
    if is_turn && missing == 0 && !is_back_and_forth {
        return Ok(Course::Once(path.ends));
    }
    let last = if is_turn && missing > 0 { 2 * steps } else { steps };
    let has_position = |step: u32| errors[(step % (steps + u32::from(!is_turn || missing == 0))) as usize].is_none();
    let first_error = first_error.cloned().unwrap_or_default();
    let part = longest(last, has_position).ok_or(Failure::Outside(first_error))?;
    let ends = part.map(|step| path.step(step, steps));
    // The turn with its middle nearest to 0.
    let turns = if is_turn && followed.repeats() { (f64::midpoint(ends[0], ends[1]) / TAU).round() * TAU } else { 0.0 };
    let ends = ends.map(|end| end - turns);
    if !is_back_and_forth {
        let input = &machine.about.inputs[path.moving];
        let [from, to] = ends.map(|value| input.shown(value));
        say!("`{}` goes from {from} to {to} and back", input.name.text);
    }
    Ok(Course::BackAndForth(ends))
}

/// The positions of a film, the first one again at its end.
fn frames(followed: &Followed<'_>, course: Course, steps: u32) -> Result<Vec<Motion>, Failure> {
    let at = |step: u32| followed.motion(course.at(step, steps), 0.0);
    (0..=steps).map(at).collect::<Result<_, _>>().map_err(Failure::Outside)
}

/// True if joints are at different places, of the size of all of them.
fn is_far(one: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let largest =
        |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0, |most: f64, number| most.max(number.abs()));
    let size = largest(&mut one.iter().flatten().copied());
    largest(&mut one.iter().flatten().zip(other.iter().flatten()).map(|(a, b)| a - b)) > JUMP * size
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
    fn back_and_forth_meets_both_ends() {
        let course = Course::BackAndForth([0.1, 0.7]);
        assert_eq!([0, 5, 10].map(|step| course.at(step, 10)), [0.1, 0.7, 0.1]);
        assert!((1..5).all(|step| course.at(step, 10) < course.at(step + 1, 10)));
    }

    #[test]
    fn the_longest_part_can_pass_the_beginning_of_a_turn() {
        let turn = [true, true, false, false, true, false, true, true];
        assert_eq!(longest(15, |step| turn[step as usize % 8]), Some([6, 9]));
        assert_eq!(longest(7, |step| turn[step as usize]), Some([0, 1]));
        assert_eq!(longest(7, |step| step == 3), None);
    }
}
