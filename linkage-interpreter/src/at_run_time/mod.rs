//! Mechanisms for the algorithms of the runtime: the traits of emitted mechanisms, implemented by running compiled functions.
//!
//! [`Design::prepared`](crate::Design::prepared) makes a design ready, and [`Prepared::with_inputs`] gives it the number of
//! its inputs as a type: [`AtRunTime`] is then a [`Mechanism`](linkage_runtime::Mechanism), and paths, limits, circuits and
//! the others take it as they take an emitted one. Numbers of unknowns, groups, points and outputs are values up to a
//! capacity; names are borrowed from the compiled mechanism.

mod algorithms;
mod branch;
mod calls;
mod certifiable;
mod coordinates;
mod kinematic;
mod mechanism;
mod names;
mod not_prepared;
mod parameters;
mod parts;
mod pose;
mod positions;
mod prepared;
mod read;
mod scene;
mod skeleton;

use linkage_runtime::UpTo;

pub(crate) use algorithms::OfTheRuntime;
pub use branch::BranchAtRunTime;
pub use certifiable::{CertifiableAtRunTime, FormulasAtRunTime, ParameterCount, QuantityCount, WithFormulas};
pub use coordinates::CoordinatesAtRunTime;
pub use not_prepared::NotPrepared;
pub use parameters::OfDesign;
pub use pose::PoseAtRunTime;
pub use prepared::Prepared;
pub use scene::{ContactCount, JointForcesAtRunTime, PreparedScene, SceneAtRunTime, StateCount};

/// The most unknowns, groups, points and outputs.
pub(crate) const MOST: usize = 24;

/// The most inputs.
pub(crate) const MOST_INPUTS: usize = 6;

/// The most joints of a drawing.
pub(crate) const MOST_JOINTS: usize = 64;

/// The most numbers of a pose.
pub(crate) const MOST_OF_POSE: usize = 256;

/// The number of unknowns, groups, points or outputs.
pub type Count = UpTo<MOST>;

/// The number of coordinates.
pub type AllCoordinates = UpTo<{ MOST + MOST_INPUTS }>;

/// Twice the number of joints of a drawing.
pub type JointCoordinates = UpTo<{ 2 * MOST_JOINTS }>;

/// A mechanism with values of its parameters, with `V` inputs, that the algorithms of the runtime take.
///
/// `P` are the values of its parameters: those of the design, or [`WithFormulas`] for certificates.
#[derive(Debug, Clone, Copy)]
pub struct AtRunTime<'p, V, P = OfDesign> {
    pub(crate) prepared: &'p Prepared<'p>,
    pub(crate) inputs: V,
    parameters: P,
}
