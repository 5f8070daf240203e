//! The scene that a simulation holds.

use crate::Scene;
use linkage_runtime::held::{ByPointer, ByValue, Held, IntoHeld};

/// The scene that a simulation is to hold: `&scene`, `scene`, or an `Arc` of it.
///
/// `By` distinguishes them and is always inferred.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a scene with inertia",
    note = "pass `&scene`, `scene` or an `Arc` of a scene; `linkage!` implements `Scene` for each `scene` with `inertia;`"
)]
pub trait IntoHeldScene<'a, By> {
    /// The scene.
    type Of;

    /// Holds it.
    fn into_held_scene(self) -> Held<'a, Self::Of>;
}

impl<'a, S: Scene> IntoHeldScene<'a, ByValue> for S {
    type Of = S;

    #[inline]
    fn into_held_scene(self) -> Held<'a, S> {
        Held::Owned(self)
    }
}

impl<'a, P: IntoHeld<'a, ByPointer>> IntoHeldScene<'a, ByPointer> for P {
    type Of = P::Of;

    #[inline]
    fn into_held_scene(self) -> Held<'a, P::Of> {
        self.into_held()
    }
}
