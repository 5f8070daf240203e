//! The motion of a table or a film: the first row that has the position asked for chooses it. It is followed through change
//! points to both of its ends.

use std::f64::consts::TAU;

use linkage_interpreter::{CoordinatesAtRunTime, NotPrepared, Prepared};
use linkage_report::table::NEXT_TO_KINK;
use linkage_runtime::kinematic::MotionOf;
use linkage_runtime::range_of_motion::{MotionEnd, RangeOfMotion, RangeOptions};
use linkage_runtime::{Kinematic, PathError};

use crate::ends::Reason;
use crate::failure::Failure;
use crate::machine::{Machine, Motion};
use crate::motion::Path;
use crate::one_input::{Followable, OneInput, coordinates, one_input};
use crate::terminal::say;

/// The share of an input up to which it counts as an end of the range.
pub const EQUAL: f64 = 1e-12;

/// The reason why there is no motion.
enum Why<'p> {
    Words(String),
    Path(PathError<&'p str>),
}

impl<'p> From<PathError<&'p str>> for Why<'p> {
    fn from(error: PathError<&'p str>) -> Self {
        Self::Path(error)
    }
}

impl Why<'_> {
    fn in_words(&self, machine: &Machine) -> String {
        match self {
            Self::Words(words) => words.clone(),
            Self::Path(error) => machine.about.reasons.of_path(error),
        }
    }
}

/// The range of a motion.
pub type Range<'p> = RangeOfMotion<'p, OneInput<'p>>;

/// A motion that is followed.
pub struct Followed<'p> {
    pub machine: &'p Machine,
    pub path: &'p Path,
    /// None if it has nothing to follow or is too large to be followed: positions are those of the branch.
    pub range: Option<Range<'p>>,
}

impl<'p> Followed<'p> {
    /// The motion that these values of the moving input are about.
    pub fn of(
        machine: &'p Machine,
        prepared: &'p Result<Prepared<'p>, NotPrepared>,
        path: &'p Path,
        values: impl IntoIterator<Item = f64>,
    ) -> Result<Self, Failure> {
        let with = |range| Self { machine, path, range };
        let prepared = match prepared {
            Ok(_) if machine.about.unknowns.is_empty() => return Ok(with(None)),
            Ok(prepared) => prepared,
            Err(error) if machine.is_closed() => {
                say!("the motion is not followed, positions keep the branch: {error}");
                return Ok(with(None));
            }
            Err(error) => return Err(Failure::Outside(error.to_string())),
        };
        let still = vec![0.0; machine.about.inputs.len()];
        let mechanism = one_input(prepared, &path.at(path.ends[0]), path.moving)?;
        let position = |value: f64| {
            let unknowns = machine.place(&path.at(value), &still).map_err(Why::Words)?;
            let at = coordinates(&mechanism, &unknowns, value);
            at.ok_or_else(|| Why::Words(format!("`{}` has too many coordinates", machine.about.name)))
        };
        let range = Range::chosen(mechanism, values, position, RangeOptions::through_change_points());
        match range {
            Ok(range) => Ok(with(Some(range))),
            Err(why) => {
                let words = || why.in_words(machine);
                Err(Failure::Outside(prepared.failure().map_or_else(words, |failure| failure.to_string())))
            }
        }
    }

    /// The motion at a value of the moving input.
    pub fn motion(&self, value: f64, rate: f64) -> Result<Motion, String> {
        let inputs = self.path.at(value);
        let Some(range) = &self.range else {
            let mut rates = vec![0.0; inputs.len()];
            rates[self.path.moving] = rate;
            return self.machine.motion(&inputs, &rates);
        };
        let found = range.motion(value, rate, 0.0).map_err(|error| self.machine.about.reasons.of_path(&error))?;
        Ok(self.numbers(inputs, found))
    }

    /// The motions next to a value on both sides of it, where there is none at the value itself, as at a kink of an output.
    pub fn next_to(&self, value: f64, rate: f64) -> Option<[Motion; 2]> {
        let [from, to] = self.path.ends;
        let unit = f64::EPSILON * value.abs().max((to - from).abs());
        NEXT_TO_KINK.into_iter().find_map(|distance| {
            let at = |distance: f64| self.motion(value + distance * unit, rate).ok();
            Some([at(-distance)?, at(distance)?])
        })
    }

    fn numbers(&self, inputs: Vec<f64>, found: MotionOf<Followable<'p>>) -> Motion {
        let list = |of: CoordinatesAtRunTime<_>| of.unknowns.iter().copied().collect::<Vec<f64>>();
        let points = Followable::each_point(found.points);
        let outputs = Followable::each_output(found.outputs);
        self.machine.solver.moved(
            [inputs, list(found.position), list(found.rates), list(found.accelerations)],
            points.as_slice(),
            outputs.as_slice(),
        )
    }

    /// The difference of two inputs of the same position, if the motion is at the start again after it.
    pub fn period(&self) -> Option<f64> {
        let range = self.range.as_ref()?;
        let [least, largest] = range.inputs();
        // Within a gap of less than a turn there are the same positions a turn later.
        let middle = f64::midpoint(least, largest);
        match range.ends()[1] {
            MotionEnd::Closed { .. } => Some(largest - least),
            _ if largest - least < TAU && range.at(middle + TAU).is_ok() => Some(TAU),
            _ => None,
        }
    }

    /// True if whole turns of the input change no position.
    pub fn repeats(&self) -> bool {
        self.range.is_none() || self.period().is_some_and(|period| (period / TAU).fract().abs() < EQUAL)
    }
}

/// The reasons of both ends of a motion, of which one input moves; none of an end of a closed motion.
pub fn ends(machine: &Machine, range: &Range<'_>) -> Result<[Option<Reason>; 2], Failure> {
    let mut reasons = range.ends().map(Reason::of);
    for (reason, input) in reasons.iter_mut().zip(range.inputs()) {
        let Some(known) = reason.take() else { continue };
        let singular = match range.at(input) {
            Ok(at) => {
                let inputs: Vec<f64> = at.inputs.iter().copied().collect();
                let unknowns: Vec<f64> = at.unknowns.iter().copied().collect();
                machine.singular(&inputs, &unknowns)?
            }
            Err(_) => Vec::new(),
        };
        *reason = Some(known.where_singular(&singular));
    }
    Ok(reasons)
}

/// The inputs of the change points that a motion passes: at those at its ends it goes back.
pub fn passed(range: &Range<'_>) -> Vec<f64> {
    let is_end = |input: f64| !range.is_closed() && range.inputs().contains(&input);
    range.crossings().map(|crossing| crossing.input).filter(|input| !is_end(*input)).collect()
}
