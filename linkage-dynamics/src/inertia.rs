//! Accelerations from a mass matrix: symmetric elimination without pivoting.

use crate::MotionError;
use linkage_runtime::__shared::{greatest, to_f64};
use linkage_runtime::{Column, D, Dim, Matrix, PositionError, Real, real};

/// A pivot below this many ulps of its diagonal entry counts as zero: it is rounding error.
const LEAST_PIVOT_ULPS: f64 = 4.0;

/// The triangular factors of a positive definite mass matrix. Nothing here can panic, even without optimisation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inertia<T: Real, N: Dim> {
    matrix: Matrix<T, N, N>,
}

impl<T: Real, N: Dim> Inertia<T, N> {
    /// # Errors
    /// Those of [`reduced`].
    #[inline]
    pub(crate) fn new(
        scene: &'static str,
        coordinates: &Column<&'static str, N>,
        mass: &Matrix<T, N, N>,
    ) -> Result<Self, MotionError> {
        let mut matrix = *mass;
        for (k, coordinate) in coordinates.iter().enumerate() {
            let (pivot, entry) = (matrix.part(k, k), mass.part(k, k));
            if !(pivot > real::<T>(LEAST_PIVOT_ULPS) * T::default_epsilon() * entry && pivot <= greatest()) {
                return Err(without_inertia(scene, coordinate, pivot, entry));
            }
            for i in k + 1..N::COUNT {
                let factor = matrix.part(i, k) / pivot;
                for column in k + 1..N::COUNT {
                    let above = matrix.part(k, column);
                    if let Some(entry) = matrix.get_mut(i, column) {
                        *entry -= factor * above;
                    }
                }
            }
        }
        Ok(Self { matrix })
    }

    /// Solves M x = `forces`.
    #[inline]
    pub(crate) fn solve(&self, forces: &Column<T, N>) -> Column<T, N> {
        let (matrix, mut x) = (&self.matrix, *forces);
        for k in 0..N::COUNT {
            let Some([value, below @ ..]) = x.as_mut_slice().get_mut(k..) else { continue };
            for (i, entry) in (k + 1..).zip(below) {
                *entry -= matrix.part(i, k) / matrix.part(k, k) * *value;
            }
        }
        for k in (0..N::COUNT).rev() {
            let Some([entry, known @ ..]) = x.as_mut_slice().get_mut(k..) else { continue };
            for (i, known) in (k + 1..).zip(known) {
                *entry -= matrix.part(k, i) * *known;
            }
            *entry /= matrix.part(k, k);
        }
        x
    }
}

/// Solves M x = `forces` for the accelerations x, where M is symmetric and given by columns.
///
/// # Errors
/// [`MotionError::NoInertia`] with the name of the first coordinate whose pivot is not positive,
/// [`PositionError::NotFinite`] if it is NaN or infinite.
#[inline]
pub fn reduced<T: Real, const N: usize>(
    scene: &'static str,
    coordinates: [&'static str; N],
    columns: [[T; N]; N],
    forces: [T; N],
) -> Result<[T; N], MotionError> {
    let inertia = Inertia::<T, D<N>>::new(scene, &coordinates.into(), &columns.into())?;
    Ok(inertia.solve(&forces.into()).into())
}

#[cold]
fn without_inertia<T: Real>(scene: &'static str, coordinate: &'static str, pivot: T, entry: T) -> MotionError {
    if !pivot.is_finite() {
        return PositionError::NotFinite { mechanism: scene, quantity: "the mass matrix" }.into();
    }
    let share = if entry > T::zero() { to_f64(pivot / entry) } else { 0.0 };
    MotionError::NoInertia { scene, coordinate, share }
}
