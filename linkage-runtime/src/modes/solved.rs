//! Linear equations solved for as many angles as they determine.

use super::linearized::{Linearized, MOST_ANGLES, PerAngle, System};

/// The equations A delta + r = 0 as delta_p + sum_f B_pf delta_f + (Y r)_p = 0 for each angle p of a pivot, over the angles
/// f without one; the other rows are sum_f B_f delta_f + Y r = 0.
#[derive(Debug, Clone)]
pub struct Solved {
    /// Y, by row and equation.
    pub inverse: [PerAngle; MOST_ANGLES],
    /// B and the unit matrix, by row and angle.
    pub matrix: [PerAngle; MOST_ANGLES],
    /// The angle of each row with a pivot.
    pub angles: [Option<usize>; MOST_ANGLES],
    /// The number of pivots.
    pub rank: usize,
}

impl Solved {
    /// The equations at the middle of a cell, by elimination with complete pivoting. A pivot is more than the part `least` of
    /// the terms of its angle. One angle can be kept from having a pivot.
    pub fn new(system: &System, linear: &Linearized, least: f64, free: Option<usize>) -> Self {
        let (equations, count) = (system.equations, system.angles);
        let mut matrix = linear.slopes;
        let mut inverse = [[0.0; MOST_ANGLES]; MOST_ANGLES];
        for (place, row) in inverse.iter_mut().enumerate() {
            row[place] = 1.0;
        }
        let mut angles = [None; MOST_ANGLES];
        let mut is_done = [false; MOST_ANGLES];
        free.and_then(|angle| is_done.get_mut(angle)).into_iter().for_each(|is_done| *is_done = true);
        let mut rank = 0;
        while rank < equations.min(count) {
            let (mut best, mut at) = (least, None);
            for (row, entries) in matrix.iter().enumerate().take(equations).skip(rank) {
                for angle in (0..count).filter(|angle| !is_done[*angle]) {
                    let part = entries[angle].abs() / linear.scales[angle];
                    if part > best {
                        (best, at) = (part, Some((row, angle)));
                    }
                }
            }
            let Some((row, angle)) = at else { break };
            matrix.swap(rank, row);
            inverse.swap(rank, row);
            is_done[angle] = true;
            angles[rank] = Some(angle);
            let reciprocal = 1.0 / matrix[rank][angle];
            matrix[rank].iter_mut().chain(&mut inverse[rank]).for_each(|entry| *entry *= reciprocal);
            matrix[rank][angle] = 1.0;
            let (pivot, of_inverse) = (matrix[rank], inverse[rank]);
            for other in (0..equations).filter(|other| *other != rank) {
                let factor = matrix[other][angle];
                if factor == 0.0 {
                    continue;
                }
                for (entry, above) in matrix[other].iter_mut().zip(&pivot) {
                    *entry -= factor * above;
                }
                matrix[other][angle] = 0.0;
                for (entry, above) in inverse[other].iter_mut().zip(&of_inverse) {
                    *entry -= factor * above;
                }
            }
            rank += 1;
        }
        Self { inverse, matrix, angles, rank }
    }

    /// Y r
    pub fn times(&self, right: &PerAngle) -> PerAngle {
        self.inverse.map(|row| row.iter().zip(right).map(|(one, other)| one * other).sum())
    }

    /// |Y| r
    pub fn bound(&self, right: &PerAngle) -> PerAngle {
        self.inverse.map(|row| row.iter().zip(right).map(|(one, other)| one.abs() * other).sum())
    }

    /// True if the derivatives, which differ from those in the middle by `changes` at most, are regular in the whole cell:
    /// it has one position at most. The matrix C = |Y| changes has then a spectral radius below 1: C w < w for some w.
    pub fn is_regular(&self, system: &System, changes: &[PerAngle; MOST_ANGLES]) -> bool {
        let count = system.angles;
        if self.rank < count || system.equations != count {
            return false;
        }
        // By angle and angle.
        let mut change = [[0.0; MOST_ANGLES]; MOST_ANGLES];
        for (row, angle) in self.angles.iter().enumerate().take(count) {
            let Some(angle) = *angle else { return false };
            for (equation, changes) in changes.iter().enumerate().take(count) {
                let factor = self.inverse[row][equation].abs();
                change[angle].iter_mut().zip(changes).for_each(|(to, from)| *to += factor * from);
            }
        }
        let product =
            |weights: &PerAngle| change.map(|row| row.iter().zip(weights).map(|(one, other)| one * other).sum::<f64>());
        let mut weights = [1.0; MOST_ANGLES];
        for _ in 0..MOST_POWERS {
            let next = product(&weights);
            if (0..count).all(|angle| next[angle] < 0.9 * weights[angle]) {
                return true;
            }
            let largest = next.iter().copied().fold(0.0, f64::max);
            if !largest.is_finite() {
                return false;
            }
            // Not below a part of the largest, so that no weight is zero.
            weights = next.map(|weight| (weight / largest).max(LEAST_WEIGHT));
        }
        false
    }
}

/// The most steps of the search for w, and its least entry.
const MOST_POWERS: usize = 8;
const LEAST_WEIGHT: f64 = 1e-9;
