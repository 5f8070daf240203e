//! Scenes for simulations: the trait of emitted scenes, implemented by running compiled functions.

mod forces;
mod implementation;
mod prepared;
mod read;

use linkage_runtime::{Dim, UpTo};

pub use forces::JointForcesAtRunTime;
pub use prepared::PreparedScene;

use super::{AtRunTime, MOST, MOST_INPUTS};

/// The most frictions and stops.
pub(crate) const MOST_CONTACTS: usize = 16;

/// The most joints whose forces a scene shows.
pub(crate) const MOST_JOINTS: usize = 32;

/// The number of components of a state.
pub type StateCount = UpTo<{ MOST + 2 * MOST_INPUTS }>;

/// The number of frictions and stops.
pub type ContactCount = UpTo<MOST_CONTACTS>;

/// A scene with values of its parameters, with `V` inputs, that simulations take.
#[derive(Debug)]
pub struct SceneAtRunTime<'p, V> {
    pub(crate) prepared: &'p PreparedScene<'p>,
    pub(crate) mechanism: AtRunTime<'p, V>,
}

impl<V: Dim> Clone for SceneAtRunTime<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V: Dim> Copy for SceneAtRunTime<'_, V> {}
