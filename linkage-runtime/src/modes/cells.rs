//! All positions of a group by cells of angles, where its determinant does not show them.
//!
//! A cell is an interval for each angle. It is narrowed to the positions that it can have, by the triangle inequality of each
//! loop and by the tangents of all equations with bounds of their remainders, and else divided. A cell is done if it has no
//! position, or if the derivatives are regular from it to a position that was found: that is then the only one. The list is
//! whole if all cells are done.
//!
//! R. E. Moore, R. B. Kearfott and M. J. Cloud, "Introduction to Interval Analysis", SIAM 2009, chapter 8.

use super::cell::{Cell, MARGIN};
use super::linearized::{Linearized, MOST_ANGLES, PerAngle, System};
use super::numbered::MOST;
use super::solved::Solved;
use super::triangle::{around, close};

/// Cells that are narrower than this, in radians, belong to a family if it passes through them.
pub const COARSE_HALF: f64 = 1.0 / (1 << 4) as f64;

/// The most cells that are searched, and the most after a family was found. Of 300 000 random groups, the largest search
/// had 60 000.
const MOST_CELLS: usize = 1 << 20;
const MOST_WITH_FAMILY: usize = 1 << 11;

/// The most cells that wait: each of six angles is halved 27 times.
const MOST_WAITING: usize = 176;

/// The middle of the first cell, an angle that no drawing has: positions at round angles are not on the sides of cells.
const FIRST: f64 = 0.123_456_789;

/// Above this half width, in radians, the triangle inequality narrows a cell more than tangents.
const WIDE: f64 = 0.02;

/// A cell is narrowed again if one of its angles became narrower than this part of what it was.
const NARROWED: f64 = 0.7;

/// A pivot below this part of the terms of its angle decides nothing: what follows from it is known to half of the digits
/// at most.
pub const NO_PIVOT: f64 = 1e-8;

/// The result of a search.
pub struct Found {
    all: [PerAngle; MOST],
    count: usize,
    /// True if there are infinitely many positions besides.
    pub has_family: bool,
}

impl Found {
    /// The positions, by the angles of their directions.
    pub fn as_slice(&self) -> &[PerAngle] {
        self.all.get(..self.count).unwrap_or_default()
    }
}

/// The search for all positions of one group.
pub struct Cells<'a> {
    system: &'a System,
    /// The most positions that can be apart from each other.
    most: usize,
    found: Found,
}

/// A place at which it is not decided how many positions there are.
pub struct Doubt(pub PerAngle);

/// The state of a cell after it is narrowed.
enum State {
    /// It has no position but those found.
    Done,
    /// It may have positions. The shares of the angles in the remainders of the equations are these.
    Open(PerAngle),
    /// It has more positions than a group can have.
    TooMany,
}

impl<'a> Cells<'a> {
    /// The search for all positions of a group that has at most this many apart from each other.
    pub fn new(system: &'a System, most: usize) -> Self {
        let found = Found { all: [[0.0; MOST_ANGLES]; MOST], count: 0, has_family: false };
        Self { system, most, found }
    }

    /// Searches all angles.
    pub fn search(mut self) -> Result<Found, Doubt> {
        let mut first = Cell { middle: [0.0; MOST_ANGLES], half: [0.0; MOST_ANGLES] };
        for (middle, half) in first.middle.iter_mut().zip(&mut first.half).take(self.system.angles) {
            (*middle, *half) = (FIRST, core::f64::consts::PI + MARGIN);
        }
        let mut waiting = [first; MOST_WAITING];
        let (mut count, mut left) = (1_usize, MOST_CELLS);
        while let Some(mut cell) = count.checked_sub(1).and_then(|last| waiting.get(last)).copied() {
            count -= 1;
            let parts = match self.narrow(&mut cell) {
                State::Done => continue,
                State::Open(parts) => parts,
                State::TooMany => return Err(Doubt(cell.middle)),
            };
            if self.found.has_family && cell.is_within(COARSE_HALF) && self.system.is_on_family(&cell.middle) {
                continue;
            }
            left = left.saturating_sub(1);
            let places = waiting.get_mut(count..count + 2);
            match (cell.divided(&parts), places) {
                (Some(angle), Some(places)) if left > 0 => {
                    places.copy_from_slice(&cell.halves(angle));
                    count += 2;
                }
                // Those found are not all.
                _ if self.found.has_family => return Ok(Found { count: 0, ..self.found }),
                _ if self.system.has_family(&cell.middle, self.most + 1) => {
                    self.found.has_family = true;
                    left = MOST_WITH_FAMILY;
                    // A wide cell may have other positions, too.
                    if let Some(place) = waiting.get_mut(count).filter(|_| !cell.is_within(COARSE_HALF)) {
                        *place = cell;
                        count += 1;
                    }
                }
                _ => return Err(Doubt(cell.middle)),
            }
        }
        Ok(self.found)
    }

    /// Narrows a cell.
    fn narrow(&mut self, cell: &mut Cell) -> State {
        let angles = self.system.angles;
        loop {
            let before = cell.half;
            let widest = before.iter().copied().fold(0.0, f64::max);
            if widest > WIDE && !self.system.loops().all(|row| close(row, cell, angles)) {
                return State::Done;
            }
            let linear = self.system.near(&cell.middle, &cell.half);
            let is_reached = |equation: usize| linear.values[equation].abs() <= linear.reaches[equation];
            if !(0..self.system.equations).all(is_reached) {
                return State::Done;
            }
            let solved = Solved::new(self.system, &linear, NO_PIVOT, None);
            if !self.intersect(cell, &linear, &solved) {
                return State::Done;
            }
            if solved.is_regular(self.system, &linear.changes)
                && let Some(position) = self.system.position(&cell.middle)
                && self.system.is_alone(&position, cell)
            {
                return if self.add(position) { State::Done } else { State::TooMany };
            }
            let is_narrower = |angle: usize| cell.half[angle] < NARROWED * before[angle];
            if !(0..angles).any(is_narrower) {
                return State::Open(linear.parts);
            }
        }
    }

    /// Narrows a cell by the tangents of the equations; false if nothing is left.
    fn intersect(&self, cell: &mut Cell, linear: &Linearized, solved: &Solved) -> bool {
        let mut values = linear.values;
        values.iter_mut().zip(&linear.shifts).for_each(|(value, shift)| *value += shift);
        let (values, bounds) = (solved.times(&values), solved.bound(&linear.bounds));
        let before = *cell;
        for row in 0..self.system.equations {
            let angle = solved.angles[row];
            let others = solved.matrix[row].iter().zip(&before.half).enumerate();
            let free = others.filter(|(place, _)| Some(*place) != angle).map(|(_, (factor, half))| factor.abs() * half);
            let bound = bounds[row] + free.sum::<f64>();
            match angle {
                None if values[row].abs() > bound => return false,
                None => {}
                Some(angle) => {
                    let (middle, half) = (before.middle[angle], before.half[angle]);
                    let low = (-half).max(-values[row] - bound);
                    let high = half.min(-values[row] + bound);
                    if low > high {
                        return false;
                    }
                    if high - low < 2.0 * half {
                        cell.middle[angle] = middle + 0.5 * (low + high);
                        cell.half[angle] = 0.5 * (high - low) + MARGIN;
                    }
                }
            }
        }
        true
    }

    /// Adds a position that is not there yet; false if there is no room.
    fn add(&mut self, position: PerAngle) -> bool {
        let is_same = |other: &PerAngle| {
            let mut cell = Cell { middle: *other, half: [0.0; MOST_ANGLES] };
            for ((half, one), other) in cell.half.iter_mut().zip(&position).zip(other) {
                *half = around(one - other).abs();
            }
            self.system.is_alone(other, &cell)
        };
        if self.found.as_slice().iter().any(is_same) {
            return true;
        }
        let place = self.found.all.get_mut(self.found.count).filter(|_| self.found.count < self.most);
        let Some(place) = place else { return false };
        *place = position;
        self.found.count += 1;
        true
    }
}
