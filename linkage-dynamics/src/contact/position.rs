//! The positions of held stops: the forces of a stop keep `s'' = 0`, so that s drifts from it by the errors of the steps.

use super::held::Held;
use super::reduced::ReducedEquations;
use super::state::Contacts;
use super::tolerance::ZERO_ULPS;
use super::{ContactLaw, Mode};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{BorrowedName, Build, Column, Dim, Real, real};

impl<T: Real, C: Dim> Contacts<T, C> {
    /// True if s rests on a stop.
    pub(crate) fn has_stops(&self) -> bool {
        self.modes.iter().any(|mode| matches!(mode, Mode::AtLower | Mode::AtUpper))
    }

    /// Returns the change of v that moves each s back onto the stop on which it rests; None if all are there within
    /// their tolerance. `most` is the largest distance, relative to the terms of s.
    ///
    /// # Errors
    /// [`MotionError::LeftStop`] if a distance is larger: s has jumped. Those of [`motion`](Self::motion).
    pub(crate) fn return_to_stops<V: Dim, N: BorrowedName>(
        &self,
        t: T,
        equations: &ReducedEquations<T, V, C, N>,
        most: T,
    ) -> Result<Option<Column<T, V>>, MotionError<N>> {
        let mut moved = *equations;
        moved.rates = equations.dims().0.zeros();
        let mut has_left = false;
        for (place, contact) in moved.contacts.iter_mut().enumerate() {
            contact.drift = T::zero();
            let ContactLaw::Stop { lower, upper, .. } = contact.law else { continue };
            let bound = match self.modes[place] {
                Mode::AtLower => lower,
                Mode::AtUpper => upper,
                _ => continue,
            };
            // With equal bounds the tolerance is that of this one.
            let (_, _, tolerance) = self.nearest(place, contact, [bound, bound]);
            let gap = contact.value - bound;
            if gap.abs() <= tolerance {
                continue;
            }
            let size = tolerance / (T::default_epsilon() * real(ZERO_ULPS));
            if gap.abs() > most * size {
                let (scene, stop) = (equations.scene, contact.name);
                return Err(MotionError::LeftStop { scene, stop, gap: to_f64(gap), t: to_f64(t) });
            }
            contact.drift = gap;
            has_left = true;
        }
        if has_left { Held::new(&moved, &self.modes).map(|held| Some(held.rates(&moved))) } else { Ok(None) }
    }
}
