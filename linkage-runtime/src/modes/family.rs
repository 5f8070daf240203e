//! Families of positions: infinitely many, of which one is followed.

use super::cells::COARSE_HALF;
use super::linearized::{MOST_ANGLES, PerAngle, System};
use super::solved::Solved;

/// A pivot below this part of the terms of its angle is taken as zero on a family.
const NO_PIVOT: f64 = 1e-5;

/// The steps of the angle that is turned, in radians: the first with which all positions are found is enough.
const STEPS: [f64; 6] = [0.05, -0.05, 0.01, -0.01, 0.002, -0.002];

/// The most steps of Newton's method to one position.
const MOST_STEPS: usize = 8;

impl System {
    /// True if more positions than `most`, the number of those that can be apart from each other, are found next to each
    /// other near these angles, or if a length is free: the group then has infinitely many. At each of them the loops close
    /// as well as rounding allows.
    pub fn has_family(&self, near: &PerAngle, most: usize) -> bool {
        let Some(start) = self.closed(near, None).filter(|_| self.shows_all_links()) else { return false };
        if self.has_free_length {
            return true;
        }
        let linear = self.near(&start, &[0.0; MOST_ANGLES]);
        let solved = Solved::new(self, &linear, NO_PIVOT, None);
        let has_pivot = |angle: usize| solved.angles.iter().take(solved.rank).any(|with| *with == Some(angle));
        (0..self.angles).filter(|angle| !has_pivot(*angle)).any(|free| {
            STEPS.into_iter().any(|step| {
                let mut at = start;
                (0..most).all(|_| {
                    let next = self.next(&at, free, step);
                    next.inspect(|next| at = *next).is_some()
                })
            })
        })
    }

    /// True if there is a position near these angles at which the equations are singular.
    pub fn is_on_family(&self, near: &PerAngle) -> bool {
        self.closed(near, None).is_some_and(|at| {
            let is_near = at.iter().zip(near).all(|(one, other)| (one - other).abs() < 2.0 * COARSE_HALF);
            let linear = self.near(&at, &[0.0; MOST_ANGLES]);
            let rank = Solved::new(self, &linear, NO_PIVOT, None).rank;
            is_near && (self.has_free_length || rank < self.angles)
        })
    }

    /// The position at which one angle is larger by a step.
    fn next(&self, from: &PerAngle, free: usize, step: f64) -> Option<PerAngle> {
        let linear = self.near(from, &[0.0; MOST_ANGLES]);
        let solved = Solved::new(self, &linear, NO_PIVOT, Some(free));
        let mut start = *from;
        start[free] += step;
        for (row, angle) in solved.angles.iter().enumerate().take(solved.rank) {
            if let Some(angle) = *angle {
                start[angle] -= solved.matrix[row][free] * step;
            }
        }
        let next = self.closed(&start, Some(free))?;
        // A position of its own, not one far away.
        let is_near = (0..self.angles).all(|angle| (next[angle] - start[angle]).abs() < MOST_MOVED);
        is_near.then_some(next)
    }

    /// The angles near others at which all equations hold within rounding error. One of them can be kept.
    fn closed(&self, start: &PerAngle, kept: Option<usize>) -> Option<PerAngle> {
        let mut at = *start;
        for _ in 0..MOST_STEPS {
            let linear = self.near(&at, &[0.0; MOST_ANGLES]);
            if linear.values.iter().zip(&linear.noise).all(|(value, noise)| value.abs() <= *noise) {
                return Some(at);
            }
            let solved = Solved::new(self, &linear, NO_PIVOT, kept);
            let step = solved.times(&linear.values);
            for (row, angle) in solved.angles.iter().enumerate().take(solved.rank) {
                if let Some(angle) = *angle {
                    at[angle] -= step[row];
                }
            }
            if !at.iter().all(|angle| angle.is_finite()) {
                return None;
            }
        }
        None
    }
}

/// A position of the family differs by less than this from the tangent, in radians.
const MOST_MOVED: f64 = 0.05;
