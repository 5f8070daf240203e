//! Small linear systems by Gaussian elimination.

use super::model::{N, R, Square, Vector, dot};

/// A pivot smaller than this part of the largest entry of its row counts as zero.
const SINGULAR: f64 = 1e-11;

/// Solves A x = b of this size; None if A is singular.
pub fn solve(mut a: [[f64; R]; R], mut b: [f64; R], size: usize) -> Option<[f64; R]> {
    let mut scale = [0.0; R];
    for (scale, row) in scale.iter_mut().zip(&a).take(size) {
        *scale = row[..size].iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
    }
    for column in 0..size {
        let best = (column..size)
            .max_by(|&i, &j| (a[i][column].abs() / scale[i]).total_cmp(&(a[j][column].abs() / scale[j])))?;
        if a[best][column].abs() <= SINGULAR * scale[best] {
            return None;
        }
        a.swap(column, best);
        b.swap(column, best);
        scale.swap(column, best);
        for below in column + 1..size {
            let factor = a[below][column] / a[column][column];
            if factor != 0.0 {
                let pivot = a[column];
                for (entry, pivot) in a[below].iter_mut().zip(pivot).take(size).skip(column) {
                    *entry -= factor * pivot;
                }
                b[below] -= factor * b[column];
            }
        }
    }
    for column in (0..size).rev() {
        for later in column + 1..size {
            b[column] -= a[column][later] * b[later];
        }
        b[column] /= a[column][column];
    }
    Some(b)
}

/// The inverse of a mass matrix in its first `count` coordinates; zero in the others.
pub fn inverse(mass: &Square, count: usize) -> Square {
    let mut inverse = [[0.0; N]; N];
    let mut a = [[0.0; R]; R];
    for i in 0..count {
        a[i][..count].copy_from_slice(&mass[i][..count]);
    }
    for column in 0..count {
        let mut unit = [0.0; R];
        unit[column] = 1.0;
        let solution = solve(a, unit, count).expect("the masses are positive");
        for (row, value) in inverse.iter_mut().zip(solution).take(count) {
            row[column] = value;
        }
    }
    inverse
}

pub fn times(a: &Square, x: &Vector) -> Vector {
    [dot(&a[0], x), dot(&a[1], x), dot(&a[2], x), dot(&a[3], x)]
}
