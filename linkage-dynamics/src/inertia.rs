//! Accelerations from a mass matrix: symmetric elimination without exchange.

use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Error, Real, real};

/// A pivot below this many roundings of its own entry is no better than the rounding of the others.
const ROUNDINGS: f64 = 4.0;

/// A mass matrix with the columns before each pivot taken out, good for a matrix whose every pivot is positive.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inertia<T, const N: usize> {
    columns: [[T; N]; N],
}

impl<T: Real, const N: usize> Inertia<T, N> {
    /// # Errors
    /// As [`reduced`].
    #[inline]
    pub(crate) fn new(
        scene: &'static str,
        coordinates: [&'static str; N],
        columns: [[T; N]; N],
    ) -> Result<Self, Error> {
        let mut matrix = columns;
        for k in 0..N {
            let pivot = matrix[k][k];
            if !(pivot > real::<T>(ROUNDINGS) * T::default_epsilon() * columns[k][k] && pivot.is_finite()) {
                return Err(without_inertia(scene, coordinates[k], pivot, columns[k][k]));
            }
            for i in k + 1..N {
                let factor = matrix[k][i] / pivot;
                for column in &mut matrix[k + 1..] {
                    column[i] -= factor * column[k];
                }
            }
        }
        Ok(Self { columns: matrix })
    }

    /// The x of M x = `forces`.
    #[inline]
    pub(crate) fn solve(&self, forces: [T; N]) -> [T; N] {
        let (matrix, mut x) = (&self.columns, forces);
        for k in 0..N {
            for i in k + 1..N {
                let factor = matrix[k][i] / matrix[k][k];
                x[i] -= factor * x[k];
            }
        }
        for k in (0..N).rev() {
            let mut sum = x[k];
            for i in k + 1..N {
                sum -= matrix[i][k] * x[i];
            }
            x[k] = sum / matrix[k][k];
        }
        x
    }
}

/// The accelerations of M x = `forces`, where M is symmetric and given by columns.
///
/// # Errors
/// [`Error::NoInertia`] with the name of the first coordinate whose pivot is not positive,
/// [`Error::NotFinite`] if it is not a number.
#[inline]
pub fn reduced<T: Real, const N: usize>(
    scene: &'static str,
    coordinates: [&'static str; N],
    columns: [[T; N]; N],
    forces: [T; N],
) -> Result<[T; N], Error> {
    Ok(Inertia::new(scene, coordinates, columns)?.solve(forces))
}

#[cold]
fn without_inertia<T: Real>(scene: &'static str, coordinate: &'static str, pivot: T, entry: T) -> Error {
    if !pivot.is_finite() {
        return Error::NotFinite { mechanism: scene, quantity: "the mass matrix" };
    }
    let share = if entry > T::zero() { to_f64(pivot / entry) } else { 0.0 };
    Error::NoInertia { scene, coordinate, share }
}
