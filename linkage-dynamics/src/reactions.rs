//! The forces of frictions, stops, drives and joints in the motion that starts at a state.

use crate::contact::{ContactMotion, Contacts, ReducedEquations};
use crate::scene::{Accelerations, Coordinates, Inputs};
use crate::simulation::Loads;
use crate::{ContactLaw, Equations, MotionError, Scene};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::{Column, Mechanism, PerInput};

type MotionOf<S> = (
    ReducedEquations<<S as Scene>::Scalar, <S as Scene>::V, <S as Scene>::Contacts>,
    ContactMotion<<S as Scene>::Scalar, <S as Scene>::V, <S as Scene>::Contacts>,
);

/// The power that frictions by reaction dissipate in the motion that starts at a state.
///
/// # Errors
/// Those of [`Contacts::begin`].
pub fn bearing_loss<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    input_rates: Inputs<S>,
) -> Result<S::Scalar, MotionError> {
    let (equations, motion) = motion(scene, t, q, input_rates)?;
    let losses = equations.contacts.iter().zip(&motion.forces).map(|(contact, &force)| match contact.law {
        ContactLaw::Bearing { .. } => -force * contact.rate(&equations.rates).0,
        ContactLaw::Friction { .. } | ContactLaw::Stop { .. } => S::Scalar::zero(),
    });
    Ok(losses.fold(S::Scalar::zero(), |sum, loss| sum + loss))
}

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
    let (equations, motion) = motion(scene, t, q, input_rates)?;
    joints(scene, t, q, &equations.rates, &motion)
}

/// The forces of frictions, stops, drives and joints in the motion that starts at a state.
///
/// # Errors
/// Those of [`reactions`], and [`MotionError::NotFinite`].
// The search for modes is long: it is not copied into each emitted function that calls it.
#[inline(never)]
pub(crate) fn loads<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    input_rates: Inputs<S>,
) -> Result<Loads<S>, MotionError> {
    let (ReducedEquations { rates, .. }, motion) = motion(scene, t, q, input_rates)?;
    let (free, _) = ReducedEquations::unprescribed(scene, t, &S::state(q, &rates.into()))?;
    let (residual, laws) = (motion.residual(&free), scene.prescribed(t));
    let drives: PerInput<S::Mechanism> =
        Column::from_fn(|input| laws[input].map_or_else(S::Scalar::zero, |_| residual[input]));
    Loads {
        contacts: motion.forces,
        are_unique: motion.are_unique,
        drives: drives.into(),
        drive_power: drives.dot(&rates),
        joints: joints(scene, t, q, &rates, &motion)?,
    }
    .finite(t)
}

/// The forces of the drives by input, zero without a drive, in the motion that starts at a state.
///
/// # Errors
/// Those of [`Scene::loads`].
pub fn drive_forces<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    input_rates: Inputs<S>,
) -> Result<Inputs<S>, MotionError> {
    loads(scene, t, q, input_rates).map(|loads| loads.drives)
}

/// The forces in the joints at these rates of the inputs and in this motion.
fn joints<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    rates: &PerInput<S::Mechanism>,
    motion: &ContactMotion<S::Scalar, S::V, S::Contacts>,
) -> Result<S::Reactions, MotionError> {
    let Equations { ratios, bias, .. } = scene.equations(t, &S::state(q, &(*rates).into()))?;
    let all = S::Mechanism::rates(ratios * *rates, *rates);
    let accelerations =
        Accelerations::<S> { unknowns: ratios * motion.acceleration + bias, inputs: motion.acceleration };
    scene.reactions(t, q, &all, &accelerations, &motion.forces)
}

/// The equations at a state after any impact there, with the accelerations and the forces of contacts.
#[inline(never)]
fn motion<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    input_rates: Inputs<S>,
) -> Result<MotionOf<S>, MotionError> {
    let rates: PerInput<S::Mechanism> = input_rates.into();
    let evaluate = |rates: &PerInput<S::Mechanism>| ReducedEquations::of(scene, t, &S::state(q, &(*rates).into()));
    let (contacts, rates) = Contacts::begin(t, &rates, evaluate)?;
    let equations = evaluate(&rates)?;
    let motion = contacts.motion(&equations)?;
    Ok((equations, motion))
}
