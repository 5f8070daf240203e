//! Energy and power of a scene.

/// The energy of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy<T> {
    /// The kinetic energy of the bodies listed under `inertia`.
    pub kinetic: T,
    /// The potential energy of gravity, springs and potentials.
    pub potential: T,
}

/// The power of a scene: dE/dt = `applied` - `dissipated`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Power<T> {
    /// The power of forces, torques and drives.
    pub applied: T,
    /// The power of dampers and frictions.
    pub dissipated: T,
}
