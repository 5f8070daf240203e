//! Positions without a closed form: the first is found from a guess or from a list, each other one by following the motion from the
//! nearest one that is known.
//!
//! A step of the inputs is predicted by rates and accelerations, and Newton's method begins there. It is halved until what is found
//! is next to what was predicted, so that it is a position of the same motion.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::solver::{Motion, Solver};

/// The largest distance of a position from its prediction, in radians, and as a share of the largest length.
const NEAR: f64 = 1.0 / 64.0;

/// The smallest part of the way to a position that is a step.
const SMALLEST: f64 = 1.0 / (1 << 20) as f64;

/// The beginning of a motion.
#[derive(Debug, Clone, PartialEq)]
pub enum Start {
    /// A guess of the unknowns.
    Guess(Vec<f64>),
    /// A position by its number, in the branch.
    Listed,
}

/// The positions of one motion that are known.
pub struct Following {
    start: Start,
    known: RefCell<BTreeMap<Place, Vec<f64>>>,
    ends: RefCell<Vec<End>>,
}

/// The end of a motion.
#[derive(Debug, Clone)]
struct End {
    /// The known position before it.
    from: Vec<f64>,
    /// The first inputs that are not reached.
    beyond: Vec<f64>,
    message: String,
}

impl End {
    /// True if the way of one input to this place leads over the end.
    fn is_before(&self, place: &[f64]) -> bool {
        let mut ways = self.from.iter().zip(&self.beyond).zip(place).filter(|((from, _), to)| from != to);
        match (ways.next(), ways.next()) {
            (Some(((from, beyond), to)), None) => (from < beyond && beyond <= to) || (to <= beyond && beyond < from),
            _ => false,
        }
    }
}

/// Values of the inputs, ordered one after the other: where one input moves, neighbours are next to each other.
#[derive(Debug, Clone, PartialEq)]
struct Place(Vec<f64>);

impl Eq for Place {}

impl Ord for Place {
    fn cmp(&self, other: &Self) -> Ordering {
        let each = self.0.iter().zip(&other.0).map(|(one, other)| one.total_cmp(other));
        each.fold(Ordering::Equal, Ordering::then)
    }
}

impl PartialOrd for Place {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Place {
    fn distance(&self, other: &[f64]) -> f64 {
        self.0.iter().zip(other).map(|(one, other)| (one - other).abs()).sum()
    }
}

impl Following {
    pub fn new(start: Start) -> Self {
        Self { start, known: RefCell::default(), ends: RefCell::default() }
    }

    /// The motion at these inputs.
    pub fn motion(&self, solver: &Solver, inputs: &[f64], rates: &[f64]) -> Result<Motion, String> {
        let unknowns = match (self.nearest(inputs), &self.start) {
            (Some((Place(from), unknowns)), _) => self.followed(solver, from, unknowns, inputs)?,
            (None, Start::Guess(guess)) => guess.clone(),
            (None, Start::Listed) => solver.listed(inputs)?,
        };
        let motion = solver.motion_near(inputs, &unknowns, rates)?;
        self.known.borrow_mut().insert(Place(inputs.to_vec()), motion.unknowns.clone());
        Ok(motion)
    }

    /// The unknowns at inputs next to known ones.
    fn followed(&self, solver: &Solver, from: Vec<f64>, unknowns: Vec<f64>, to: &[f64]) -> Result<Vec<f64>, String> {
        if let Some(end) = self.ends.borrow().iter().find(|end| end.from == from && end.is_before(to)) {
            return Err(end.message.clone());
        }
        followed(solver, &from, unknowns, to).map_err(|(beyond, message)| {
            self.ends.borrow_mut().push(End { from, beyond, message: message.clone() });
            message
        })
    }

    fn nearest(&self, inputs: &[f64]) -> Option<(Place, Vec<f64>)> {
        let (known, place) = (self.known.borrow(), Place(inputs.to_vec()));
        let neighbours = [known.range(..=&place).next_back(), known.range(&place..).next()].into_iter().flatten();
        let nearest = neighbours.min_by(|(one, _), (other, _)| one.distance(inputs).total_cmp(&other.distance(inputs)));
        nearest.map(|(place, unknowns)| (place.clone(), unknowns.clone()))
    }
}

/// The unknowns at the end of a straight way of the inputs; the first inputs that are not reached otherwise.
fn followed(solver: &Solver, from: &[f64], unknowns: Vec<f64>, to: &[f64]) -> Result<Vec<f64>, (Vec<f64>, String)> {
    let way: Vec<f64> = from.iter().zip(to).map(|(from, to)| to - from).collect();
    if way.iter().all(|way| *way == 0.0) {
        return Ok(unknowns);
    }
    let mut here = solver.motion_near(from, &unknowns, &way).map_err(|error| (to.to_vec(), error))?;
    let (mut done, mut step) = (0.0, 1.0);
    while done < 1.0 {
        let next = f64::min(done + step, 1.0);
        let inputs: Vec<f64> = match next < 1.0 {
            true => from.iter().zip(&way).map(|(from, way)| from + next * way).collect(),
            // Exactly.
            false => to.to_vec(),
        };
        let predicted = predicted(&here, next - done);
        let found = solver.motion_near(&inputs, &predicted, &way);
        match found {
            Ok(found) if is_near(solver, &here.unknowns, &predicted, &found) => {
                (here, done, step) = (found, next, 2.0 * step)
            }
            _ if step > SMALLEST => step /= 2.0,
            _ => {
                let at = solver.at(&here.inputs);
                let message =
                    format!("the motion of {} ends near {at}, at a dead point or a change point", solver.name);
                return Err((inputs, message));
            }
        }
    }
    Ok(here.unknowns)
}

/// The unknowns after a part of the way.
fn predicted(from: &Motion, step: f64) -> Vec<f64> {
    let each = from.unknowns.iter().zip(from.rates.iter().zip(&from.accelerations));
    each.map(|(value, (rate, acceleration))| value + step * (rate + 0.5 * step * acceleration)).collect()
}

/// True if a position is next to its prediction.
fn is_near(solver: &Solver, from: &[f64], predicted: &[f64], found: &Motion) -> bool {
    let lengths = [from, predicted, &found.unknowns].map(|unknowns| solver.largest_length(&found.inputs, unknowns));
    let length = lengths.into_iter().fold(0.0, f64::max);
    let unknowns = solver.unknowns.iter().zip(&found.are_directions).zip(predicted.iter().zip(&found.unknowns));
    unknowns.into_iter().all(|((unknown, is_direction), (predicted, found))| {
        let off = found - predicted;
        let off = if *is_direction { off - (off / TAU).round() * TAU } else { off };
        off.abs() <= NEAR * if unknown.is_angle { 1.0 } else { length }
    })
}
