//! An interval for each angle.

use super::linearized::PerAngle;

/// Cells that are narrower than this, in radians, are in doubt: there the values of the equations are as small as their
/// rounding errors if two positions meet.
const LEAST_HALF: f64 = 1.0 / (1 << 25) as f64;

/// Each cell is wider by this than it was computed, in radians: more than the rounding errors of its ends, which are below
/// 16 epsilons.
pub const MARGIN: f64 = 1e-14;

/// An interval for each angle.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    pub middle: PerAngle,
    pub half: PerAngle,
}

impl Cell {
    /// True if all its angles are narrower than this.
    pub fn is_within(&self, half: f64) -> bool {
        self.half.iter().all(|one| *one < half)
    }

    /// The angle to be divided: of those wide enough, the one with the largest part in the remainders.
    pub fn divided(&self, parts: &PerAngle) -> Option<usize> {
        let wide =
            parts.iter().zip(&self.half).enumerate().filter(|(_, (part, half))| **part > 0.0 && **half > LEAST_HALF);
        wide.max_by(|(_, (one, _)), (_, (other, _))| one.total_cmp(other)).map(|(angle, _)| angle)
    }

    /// The halves of a cell, at an angle.
    pub fn halves(&self, angle: usize) -> [Self; 2] {
        [-0.5, 0.5].map(|side| {
            let mut part = *self;
            part.middle[angle] += side * self.half[angle];
            part.half[angle] = 0.5 * self.half[angle] + MARGIN;
            part
        })
    }
}
