//! Accelerations from a mass matrix.

use crate::MotionError;
use linkage_runtime::__shared::{Definite, greatest, to_f64};
use linkage_runtime::{Column, D, Dim, Matrix, Name, PositionError, Real, real};

/// A pivot below this many ulps of its diagonal entry counts as zero: it is rounding error.
const LEAST_PIVOT_ULPS: f64 = 4.0;

/// The triangular factors of a positive definite mass matrix. Nothing here can panic, even without optimisation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inertia<T: Real, N: Dim> {
    factors: Definite<T, N>,
}

impl<T: Real, N: Dim> Inertia<T, N> {
    /// # Errors
    /// Those of [`reduced`].
    #[inline]
    pub(crate) fn new<S: Name + Copy>(
        scene: S,
        coordinates: &Column<S, N>,
        mass: &Matrix<T, N, N>,
    ) -> Result<Self, MotionError<S>> {
        let factors = Definite::new(mass, |k, pivot, entry| {
            if pivot > real::<T>(LEAST_PIVOT_ULPS) * T::default_epsilon() * entry && pivot <= greatest() {
                return Ok(());
            }
            let coordinate = coordinates.as_slice().get(k).copied().unwrap_or_else(|| S::from_static(""));
            Err(without_inertia(scene, coordinate, pivot, entry))
        })?;
        Ok(Self { factors })
    }

    /// Solves M x = `forces`.
    #[inline]
    pub(crate) fn solve(&self, forces: &Column<T, N>) -> Column<T, N> {
        self.factors.solve(forces)
    }
}

/// Solves M x = `forces` for the accelerations x, where M is symmetric and given by columns.
///
/// # Errors
/// [`MotionError::NoInertia`] with the name of the first coordinate whose pivot is not positive,
/// [`PositionError::NotFinite`] if it is NaN or infinite.
#[inline]
pub fn reduced<T: Real, S: Name + Copy, const N: usize>(
    scene: S,
    coordinates: [S; N],
    columns: [[T; N]; N],
    forces: [T; N],
) -> Result<[T; N], MotionError<S>> {
    let inertia = Inertia::<T, D<N>>::new(scene, &coordinates.into(), &columns.into())?;
    Ok(inertia.solve(&forces.into()).into())
}

#[cold]
fn without_inertia<T: Real, S: Name>(scene: S, coordinate: S, pivot: T, entry: T) -> MotionError<S> {
    if !pivot.is_finite() {
        return PositionError::NotFinite { mechanism: scene, quantity: S::from_static("the mass matrix") }.into();
    }
    let share = if entry > T::zero() { to_f64(pivot / entry) } else { 0.0 };
    MotionError::NoInertia { scene, coordinate, share }
}
