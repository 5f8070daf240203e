//! Validation of contacts: finite numbers, limits and factors that are not negative, ranges that are not empty.

use super::{Contact, ContactCoordinate, ContactLaw};
use crate::MotionError;
use crate::scene::negative;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Dim, InputError, Name, PositionError, Real};

/// The contacts of a scene.
type Each<T, U, V, S, const C: usize> = [Contact<T, U, V, S>; C];

/// Returns the contacts if their numbers are finite and no friction limit or factor is negative.
///
/// # Errors
/// [`PositionError::NotFinite`] or [`InputError::OutOfRange`] with the name of the first that is invalid.
pub fn validate_contacts<T: Real, U: Dim, V: Dim, S: Name + Copy, const C: usize>(
    scene: S,
    contacts: Each<T, U, V, S, C>,
) -> Result<Each<T, U, V, S, C>, MotionError<S>> {
    for Contact { name, along, law } in &contacts {
        let ContactCoordinate { value, unknowns, inputs, bias } = along;
        let [a, b, c] = match *law {
            ContactLaw::Friction { limit } | ContactLaw::Bearing { factor: limit } => [limit, T::zero(), T::zero()],
            ContactLaw::Stop { lower, upper, restitution } => [lower, upper, restitution],
        };
        let mut all =
            [*value, *bias, a, b, c].into_iter().chain(unknowns.iter().copied()).chain(inputs.iter().copied());
        if !all.all(|number| number.is_finite()) {
            return Err(PositionError::NotFinite { mechanism: scene, quantity: *name }.into());
        }
        if let ContactLaw::Friction { limit } | ContactLaw::Bearing { factor: limit } = *law
            && limit < T::zero()
        {
            return Err(negative(scene, *name, limit).into());
        }
    }
    Ok(contacts)
}

/// Checks that lower < upper and that the restitution is between 0 and 1.
///
/// # Errors
/// [`InputError::EmptyRange`], [`InputError::OutOfRange`] or [`PositionError::NotFinite`] with the name of the first
/// stop that is invalid.
pub fn validate_stops<T: Real, S: Name + Copy, const N: usize>(
    scene: S,
    stops: [(S, T, T, T); N],
) -> Result<(), MotionError<S>> {
    for (stop, lower, upper, restitution) in stops {
        if ![lower, upper, restitution].iter().all(T::is_finite) {
            return Err(PositionError::NotFinite { mechanism: scene, quantity: stop }.into());
        }
        if lower >= upper {
            return Err(InputError::EmptyRange { scene, stop, lower: to_f64(lower), upper: to_f64(upper) }.into());
        }
        if restitution < T::zero() || restitution > T::one() {
            let (quantity, value) = (S::from_static("the restitution"), to_f64(restitution));
            return Err(InputError::OutOfRange { of: Some(stop), quantity, value, least: 0.0, most: 1.0 }.into());
        }
    }
    Ok(())
}
