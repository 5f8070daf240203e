//! Items used by the code emitted for scenes. Not part of the public API.

pub use crate::contact::{validate_contacts, validate_stops};
pub use crate::equilibrium::equilibrium;
pub use crate::inertia::reduced;
pub use crate::reactions::{bearing_loss, drive_forces, reactions};
pub use crate::scene::{ReducedMotion, finite_each, not_negative};
pub use crate::{
    Balance, Bearing, Contact, ContactCoordinate, ContactLaw, Energy, Equations, Kink, MotionError, Power, Prescribed,
    ReactionRow, Scene, StateParts, StateRates, Unreduced,
};
pub use linkage_runtime::jacobian::Vector;
