//! The forces in the joints of a scene with frictions and stops.

use crate::contact::{Contacts, ReducedEquations};
use crate::scene::{Coordinates, Inputs};
use crate::{Equations, MotionError, Scene};
use linkage_runtime::{Mechanism, PerInput};

/// The forces in the joints in the motion that starts at a state: contacts at rest are held if they can.
///
/// # Errors
/// Those of [`Contacts::begin`] and of [`Scene::reactions`].
pub fn reactions<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    input_rates: Inputs<S>,
) -> Result<S::Reactions, MotionError> {
    let rates: PerInput<S::Mechanism> = input_rates.into();
    let evaluate = |rates: &PerInput<S::Mechanism>| ReducedEquations::of(scene, t, &S::state(q, &(*rates).into()));
    let (contacts, rates) = Contacts::begin(t, &rates, evaluate)?;
    let motion = contacts.motion(&evaluate(&rates)?)?;
    let Equations { ratios, bias, .. } = scene.equations(t, &S::state(q, &rates.into()))?;
    let all = S::Mechanism::rates(ratios * rates, rates);
    scene.reactions(t, q, &all, (ratios * motion.acceleration + bias, motion.acceleration), &motion.forces)
}
