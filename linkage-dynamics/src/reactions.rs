//! The forces of frictions, stops, drives and joints in the motion that starts at a state.

use crate::contact::{ContactMotion, Contacts, ReducedEquations};
use crate::scene::{Accelerations, Coordinates, Inputs, Rates};
use crate::simulation::Loads;
use crate::{ContactLaw, Equations, MotionErrorOf, NameOf, Scene};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::{Build, Column, Mechanism, PerInput};

/// The prescribed acceleration of each input, or None.
type Laws<S> = Column<Option<<S as Scene>::Scalar>, <S as Scene>::V>;

type MotionOf<S> = (
    ReducedEquations<<S as Scene>::Scalar, <S as Scene>::V, <S as Scene>::Contacts, NameOf<S>>,
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
) -> Result<S::Scalar, MotionErrorOf<S>> {
    let (equations, motion) = motion(scene, t, q, input_rates, &laws(scene, t))?;
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
) -> Result<S::Reactions, MotionErrorOf<S>> {
    let (equations, motion) = motion(scene, t, q, input_rates, &laws(scene, t))?;
    let (rates, accelerations) = moving(scene, t, q, &equations.rates, &motion)?;
    scene.reactions(t, q, &rates, &accelerations, &motion.forces)
}

/// The forces of frictions, stops, drives and joints in the motion that starts at a state.
///
/// # Errors
/// Those of [`reactions`], and [`MotionError::NotFinite`](crate::MotionError::NotFinite).
pub(crate) fn loads<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    input_rates: Inputs<S>,
) -> Result<Loads<S>, MotionErrorOf<S>> {
    loads_with(scene, t, q, input_rates, &laws(scene, t))
}

/// The loads if a drive of each input makes the motion with these rates and accelerations of the inputs.
///
/// # Errors
/// Those of [`loads`].
pub(crate) fn loads_of_motion<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    (input_rates, input_accelerations): (Inputs<S>, Inputs<S>),
) -> Result<Loads<S>, MotionErrorOf<S>> {
    let accelerations: PerInput<S::Mechanism> = input_accelerations.into();
    loads_with(scene, t, q, input_rates, &accelerations.map(Some))
}

// The search for modes is long: it is not copied into each emitted function that calls it.
#[inline(never)]
fn loads_with<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    input_rates: Inputs<S>,
    laws: &Laws<S>,
) -> Result<Loads<S>, MotionErrorOf<S>> {
    let (ReducedEquations { rates, .. }, motion) = motion(scene, t, q, input_rates, laws)?;
    let (free, _) = ReducedEquations::unprescribed(scene, t, &scene.state_of(q, &rates.into()))?;
    let residual = motion.residual(&free);
    let drives: PerInput<S::Mechanism> =
        rates.dim().column(|input| laws[input].map_or_else(S::Scalar::zero, |_| residual[input]));
    let (all, accelerations) = moving(scene, t, q, &rates, &motion)?;
    Loads {
        contacts: motion.forces,
        are_unique: motion.are_unique,
        drives: drives.into(),
        drive_power: drives.dot(&rates),
        joints: scene.reactions(t, q, &all, &accelerations, &motion.forces)?,
        accelerations,
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
) -> Result<Inputs<S>, MotionErrorOf<S>> {
    loads(scene, t, q, input_rates).map(|loads| loads.drives)
}

/// The rates q' and the accelerations `(u'', v'')` at these rates of the inputs and in this motion.
fn moving<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    rates: &PerInput<S::Mechanism>,
    motion: &ContactMotion<S::Scalar, S::V, S::Contacts>,
) -> Result<(Rates<S>, Accelerations<S>), MotionErrorOf<S>> {
    let Equations { ratios, bias, .. } = scene.equations(t, &scene.state_of(q, &(*rates).into()))?;
    let all = S::Mechanism::rates(ratios * *rates, *rates);
    let unknowns = ratios * motion.acceleration + bias;
    Ok((all, Accelerations::<S> { unknowns, inputs: motion.acceleration }))
}

/// The accelerations of the inputs that have a drive.
fn laws<S: Scene>(scene: &S, t: S::Scalar) -> Laws<S> {
    scene.prescribed(t).map(|law| law.map(|law| law.acceleration))
}

/// The equations at a state after any impact there, with the accelerations and the forces of contacts.
#[inline(never)]
fn motion<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &Coordinates<S>,
    input_rates: Inputs<S>,
    laws: &Laws<S>,
) -> Result<MotionOf<S>, MotionErrorOf<S>> {
    let rates: PerInput<S::Mechanism> = input_rates.into();
    let evaluate = |rates: &PerInput<S::Mechanism>| {
        let (mut equations, _) = ReducedEquations::unprescribed(scene, t, &scene.state_of(q, &(*rates).into()))?;
        equations.prescribe_all(laws);
        Ok(equations)
    };
    let (contacts, rates) = Contacts::begin(t, &rates, evaluate)?;
    let equations = evaluate(&rates)?;
    let motion = contacts.motion(&equations)?;
    Ok((equations, motion))
}
