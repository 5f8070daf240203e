//! The names that the code emitted for scenes uses. Not part of the interface.

pub use crate::contact::{sound, stops};
pub use crate::equilibrium::{equilibrium, on_branch};
pub use crate::inertia::reduced;
pub use crate::scene::{Kinematics, finite_each, not_negative};
pub use crate::{Along, Balance, Contact, ContactLaw, Energy, Equations, Power, Scene, Unreduced};
