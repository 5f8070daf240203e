//! The accelerations of a motion with contacts, and the gaps of its stops.

use super::Mode;
use super::reduced::{ReducedContact, ReducedEquations};
use linkage_runtime::{BorrowedName, Column, Dim, Real};

/// The accelerations, and the forces of the contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, V: Default, C: Default"
    ))
)]
pub struct ContactMotion<T: Real, V: Dim, C: Dim> {
    /// `v''`.
    pub acceleration: Column<T, V>,
    /// The force of each contact along its s: its work is f ds. With redundant contacts the forces are not unique; this
    /// is one solution.
    pub forces: Column<T, C>,
    /// False if other forces give the same motion: contacts are redundant.
    pub are_unique: bool,
}

impl<T: Real, V: Dim, C: Dim> ContactMotion<T, V, C> {
    /// `M v'' - Q - S' f` of equations in which no motion is prescribed: the forces of the drives.
    pub(crate) fn residual<N: BorrowedName>(&self, equations: &ReducedEquations<T, V, C, N>) -> Column<T, V> {
        let mut residual = equations.mass * self.acceleration - equations.forces;
        for (contact, &force) in equations.contacts.iter().zip(&self.forces) {
            residual -= contact.row * force;
        }
        residual
    }
}

/// Returns the nearer stop and the distance to it.
pub(super) fn nearer<T: Real, V: Dim, N: BorrowedName>(
    contact: &ReducedContact<T, V, N>,
    lower: T,
    upper: T,
) -> (Mode, T) {
    let (below, above) = (contact.value - lower, upper - contact.value);
    if below <= above { (Mode::AtLower, below) } else { (Mode::AtUpper, above) }
}
