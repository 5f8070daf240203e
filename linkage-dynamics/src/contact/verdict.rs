//! What no friction and no stop can be.

use super::{Along, Contact, ContactLaw};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Error, Real};

/// The contacts, if their numbers are finite and no limit is negative.
///
/// # Errors
/// [`Error::NotFinite`] or [`Error::Negative`] with the name of the first that is not sound.
pub fn sound<T: Real, const U: usize, const V: usize, const C: usize>(
    scene: &'static str,
    contacts: [Contact<T, U, V>; C],
) -> Result<[Contact<T, U, V>; C], Error> {
    for Contact { name, along, law } in &contacts {
        let Along { value, unknowns, inputs, bias } = along;
        let [a, b, c] = match *law {
            ContactLaw::Friction { limit } => [limit, T::zero(), T::zero()],
            ContactLaw::Stop { lower, upper, restitution } => [lower, upper, restitution],
        };
        let mut all =
            [*value, *bias, a, b, c].into_iter().chain(unknowns.iter().copied()).chain(inputs.iter().copied());
        if !all.all(|number| number.is_finite()) {
            return Err(Error::NotFinite { mechanism: scene, quantity: name });
        }
        if let ContactLaw::Friction { limit } = *law
            && limit < T::zero()
        {
            return Err(Error::Negative { scene, quantity: name, value: to_f64(limit) });
        }
    }
    Ok(contacts)
}

/// Refuses stops between which nothing is left, and a restitution that is not between 0 and 1.
///
/// # Errors
/// [`Error::NoRange`], [`Error::Restitution`] or [`Error::NotFinite`] with the name of the first.
pub fn stops<T: Real, const N: usize>(scene: &'static str, stops: [(&'static str, T, T, T); N]) -> Result<(), Error> {
    for (stop, lower, upper, restitution) in stops {
        if ![lower, upper, restitution].iter().all(T::is_finite) {
            return Err(Error::NotFinite { mechanism: scene, quantity: stop });
        }
        if lower >= upper {
            return Err(Error::NoRange { scene, stop, lower: to_f64(lower), upper: to_f64(upper) });
        }
        if restitution < T::zero() || restitution > T::one() {
            return Err(Error::Restitution { scene, stop, value: to_f64(restitution) });
        }
    }
    Ok(())
}
