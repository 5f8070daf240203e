//! Positions of which it is shown that they exist, and that they are the only ones in a cell.
//!
//! With Y the inverse of the derivatives in the middle of a cell, and C a bound of the changes of Y times the derivatives in
//! the cell, the cell has one position at most if C has a spectral radius below 1, and one if delta -> delta - Y Psi maps it
//! into itself: R. Krawczyk, "Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken", Computing 4, 1969.

use super::cell::Cell;
use super::cells::NO_PIVOT;
use super::linearized::{MOST_ANGLES, PerAngle, System};
use super::solved::Solved;

impl System {
    /// A position near these angles, if Newton's method finds one at which the equations are regular beyond rounding error.
    pub fn position(&self, start: &PerAngle) -> Option<PerAngle> {
        let none = [0.0; MOST_ANGLES];
        let mut at = *start;
        for _ in 0..MOST_STEPS {
            let linear = self.near(&at, &none);
            let solved = Solved::new(self, &linear, NO_PIVOT, None);
            if solved.rank < self.angles {
                return None;
            }
            let step = solved.times(&linear.values);
            let mut largest = 0.0_f64;
            for (angle, step) in solved.angles.iter().zip(&step) {
                if let Some(angle) = *angle {
                    at[angle] -= step;
                    largest = largest.max(step.abs());
                }
            }
            let is_within = largest < core::f64::consts::PI;
            if !is_within {
                return None;
            }
            if largest < ENOUGH {
                return self.exists(&at).then_some(at);
            }
        }
        None
    }

    /// True if there is a position within the rounding error of these angles: a cell of four times the size of the error is
    /// mapped into itself.
    fn exists(&self, at: &PerAngle) -> bool {
        let none = [0.0; MOST_ANGLES];
        let linear = self.near(at, &none);
        let solved = Solved::new(self, &linear, NO_PIVOT, None);
        if solved.rank < self.angles {
            return false;
        }
        let mut errors = linear.noise;
        errors.iter_mut().zip(&linear.values).for_each(|(error, value)| *error += value.abs());
        let errors = solved.bound(&errors);
        let mut half = none;
        for (angle, error) in solved.angles.iter().zip(&errors) {
            if let Some(angle) = *angle {
                half[angle] = 4.0 * error;
            }
        }
        let around = self.near(at, &half);
        let remainders = solved.bound(&around.bounds);
        remainders.iter().zip(&errors).all(|(remainder, error)| *remainder <= 3.0 * error)
            && solved.is_regular(self, &around.changes)
    }

    /// True if a position is the only one in a cell that is widened to it.
    pub fn is_alone(&self, position: &PerAngle, cell: &Cell) -> bool {
        let mut half = cell.half;
        for ((half, middle), position) in half.iter_mut().zip(&cell.middle).zip(position) {
            *half += (middle - position).abs();
        }
        let linear = self.near(position, &half);
        Solved::new(self, &linear, NO_PIVOT, None).is_regular(self, &linear.changes)
    }
}

/// The most steps of Newton's method, and a step after which it ends, in radians: the next one is below rounding error.
const MOST_STEPS: usize = 12;
const ENOUGH: f64 = 1e-9;
