//! The equations of motion as they stand before the accelerations are solved for.

use nalgebra::{SMatrix, SVector};

use linkage_runtime::__shared::all_finite;
use linkage_runtime::{Error, Mechanism, Real};

/// The equations of motion in the inputs, without frictions and stops: M v'' = Q, u' = W v', u'' = W v'' + `bias`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equations<T, const U: usize, const V: usize> {
    /// M.
    pub mass: SMatrix<T, V, V>,
    /// Q.
    pub forces: SVector<T, V>,
    /// W.
    pub ratios: SMatrix<T, U, V>,
    /// u'' at v'' = 0.
    pub bias: SVector<T, U>,
}

impl<T: Real, const U: usize, const V: usize> Equations<T, U, V> {
    /// From M and Q at a position and the rates v', with what the mechanism says of u.
    ///
    /// # Errors
    /// [`Error::Singular`] where J has no inverse, [`Error::NotFinite`] if a number is not finite.
    pub fn at<M: Mechanism<T, U, V>>(
        mechanism: &M,
        q: &M::Coordinates,
        rates: &SVector<T, V>,
        mass: SMatrix<T, V, V>,
        forces: SVector<T, V>,
    ) -> Result<Self, Error> {
        let pose = mechanism.pose_at(q);
        let by_inputs = mechanism.jacobian_inputs(&pose);
        let mut ratios = SMatrix::<T, U, V>::zeros();
        for (input, column) in by_inputs.column_iter().enumerate() {
            ratios.set_column(input, &(-mechanism.solve_jacobian(&pose, &column.into_owned())?));
        }
        let velocity = M::with_unknowns(&M::with_inputs(q, *rates), ratios * rates);
        let bias = -mechanism.solve_jacobian(&pose, &mechanism.gamma(&pose, &velocity))?;
        let values = mass.iter().chain(forces.iter()).chain(ratios.iter()).chain(bias.iter());
        all_finite(M::NAME, "the equations of motion", values)?;
        Ok(Self { mass, forces, ratios, bias })
    }
}
