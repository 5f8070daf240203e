//! The equations of motion before they are solved for the accelerations.

use crate::MotionError;
use linkage_runtime::__shared::all_finite;
use linkage_runtime::{Column, Dim, Matrix, Mechanism, Name, Real};

/// The equations of motion in the inputs, without frictions and stops: `M v'' = Q`, `u' = W v'`, `u'' = W v'' + bias`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, U: Default, V: Default"
    ))
)]
pub struct Equations<T: Real, U: Dim, V: Dim> {
    /// M.
    pub mass: Matrix<T, V, V>,
    /// Q.
    pub forces: Column<T, V>,
    /// W.
    pub ratios: Matrix<T, U, V>,
    /// `u''` at `v'' = 0`.
    pub bias: Column<T, U>,
}

impl<T: Real, U: Dim, V: Dim> Equations<T, U, V> {
    /// Builds the equations from M and Q at a position and the rates v'; the mechanism gives W and the bias.
    ///
    /// # Errors
    /// [`PositionError::Singular`](linkage_runtime::PositionError::Singular) where J is singular,
    /// [`PositionError::NotFinite`](linkage_runtime::PositionError::NotFinite) if a number is not finite.
    pub fn at<M: Mechanism<Scalar = T, U = U, V = V>>(
        mechanism: &M,
        q: &M::Coordinates,
        input_rates: impl Into<Column<T, V>>,
        mass: impl Into<Matrix<T, V, V>>,
        forces: impl Into<Column<T, V>>,
    ) -> Result<Self, MotionError<M::Name>> {
        let (input_rates, mass, forces) = (input_rates.into(), mass.into(), forces.into());
        let pose = mechanism.pose_at(q);
        let mut ratios = mechanism.jacobian_inputs(&pose);
        for column in ratios.columns_mut() {
            *column = -mechanism.solve_jacobian(&pose, column)?;
        }
        let rates = M::rates(ratios * input_rates, input_rates);
        let bias = -mechanism.solve_jacobian(&pose, &mechanism.gamma(&pose, &rates))?;
        let values = mass.iter().chain(forces.iter()).chain(ratios.iter()).chain(bias.iter());
        all_finite(mechanism.name(), Name::from_static("the equations of motion"), values)?;
        Ok(Self { mass, forces, ratios, bias })
    }
}
