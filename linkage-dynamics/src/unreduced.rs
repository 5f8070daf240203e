//! Inertia and forces before the multipliers are eliminated.

use linkage_runtime::{Column, Dim, Matrix, Real};

/// Inertia and forces in all coordinates, `M q'' + Psi_q' lambda = F`, split into unknowns u and inputs v.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, U: Default, V: Default"
    ))
)]
pub struct Unreduced<T: Real, U: Dim, V: Dim> {
    /// M_uu.
    pub unknowns: Matrix<T, U, U>,
    /// M_uv.
    pub mixed: Matrix<T, U, V>,
    /// M_vv.
    pub inputs: Matrix<T, V, V>,
    /// F_u, with the quadratic velocity terms of the inertia.
    pub unknown_forces: Column<T, U>,
    /// F_v, with the quadratic velocity terms of the inertia.
    pub input_forces: Column<T, V>,
}
