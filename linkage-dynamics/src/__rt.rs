//! The names that the code emitted for scenes uses. Not part of the interface.

pub use crate::contact::{sound, stops};
pub use crate::equilibrium::equilibrium;
pub use crate::inertia::reduced;
pub use crate::scene::{Kinematics, finite_each, not_negative};
pub use crate::{
    Balance, Contact, ContactCoordinate, ContactLaw, Energy, Equations, MotionError, Power, Prescribed, Scene,
    Unreduced,
};
