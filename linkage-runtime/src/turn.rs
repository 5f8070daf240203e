//! Full turns of an angle: the choice among values 2 pi apart, which have the same direction.
//!
//! A group solved in closed form determines the direction of an angle. If its value matters, as for a gear that drives
//! another, the value is the principal value, between -pi and pi, plus a number of turns.

use core::cell::Cell;

use crate::scalar::{rounded, to_f64, whole};
use crate::{InputError, Name, PositionError, Real};

/// A choice of turns for the angles of a mechanism, each of which has an index.
pub trait Turn<T: Real> {
    /// Returns the value of the angle with this index.
    fn number(&self, place: usize, principal: T) -> T;
}

/// Numbers of turns; 0 is the principal value.
#[derive(Debug, Clone, Copy)]
pub struct Turns<const N: usize>(pub [i32; N]);

impl<T: Real, const N: usize> Turn<T> for Turns<N> {
    #[inline]
    fn number(&self, place: usize, principal: T) -> T {
        turned(principal, self.0.get(place).copied().unwrap_or_default())
    }
}

/// The turns in which angles are nearest to given values.
#[derive(Debug, Clone)]
pub struct NearestTurns<T, const N: usize> {
    near: [T; N],
    turns: Cell<[i32; N]>,
}

impl<T: Real, const N: usize> NearestTurns<T, N> {
    /// Takes the turns nearest to these values; a value beyond 2^31 turns gets the largest number of turns.
    #[must_use]
    pub fn new(near: [T; N]) -> Self {
        Self { near, turns: Cell::new(near.map(whole_turns)) }
    }

    /// The turns chosen; for an angle not computed yet, those of direction zero.
    #[must_use]
    pub fn turns(&self) -> [i32; N] {
        self.turns.get()
    }
}

impl<T: Real, const N: usize> Turn<T> for NearestTurns<T, N> {
    #[inline]
    fn number(&self, place: usize, principal: T) -> T {
        let mut all = self.turns.get();
        // Emitted code passes valid indices only.
        let (Some(near), Some(turns)) = (self.near.get(place), all.get_mut(place)) else { return principal };
        *turns = whole_turns(*near - principal);
        let number = turned(principal, *turns);
        self.turns.set(all);
        number
    }
}

/// principal + 2 pi turns.
#[inline]
fn turned<T: Real>(principal: T, turns: i32) -> T {
    principal + T::two_pi() * whole(turns)
}

/// The number of turns nearest to an angle.
#[inline]
fn whole_turns<T: Real>(angle: T) -> i32 {
    rounded(angle / T::two_pi())
}

/// Returns an error if the guess of an angle is infinite or NaN, or if a branch cannot count its turns.
///
/// # Errors
/// [`PositionError::NotFinite`], [`InputError::OutOfRange`].
pub fn countable<T: Real, S: Name, const N: usize>(mechanism: S, guesses: [T; N]) -> Result<(), PositionError<S>> {
    let most = f64::from(i32::MAX) * core::f64::consts::TAU;
    for guess in guesses {
        if !guess.is_finite() {
            return Err(PositionError::NotFinite { mechanism, quantity: S::from_static("the guess") });
        }
        let value = to_f64(guess);
        if value.abs() > most {
            return Err(InputError::OutOfRange {
                of: Some(mechanism),
                quantity: S::from_static("the guess of an angle"),
                value,
                least: -most,
                most,
            }
            .into());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const PI: f64 = core::f64::consts::PI;

    #[test]
    fn the_nearest_turn_gives_the_number_back() {
        for turns in [-100_000, -3, -1, 0, 1, 2, 77] {
            for principal in [-PI, -3.0, -1e-300, 0.0, 0.4, 3.0, PI] {
                let number = Turns([turns]).number(0, principal);
                let nearest = NearestTurns::new([number]);
                assert_eq!((nearest.number(0, principal), nearest.turns()), (number, [turns]));
            }
        }
    }

    #[test]
    fn numbers_that_no_turn_reaches() {
        assert_eq!(NearestTurns::new([f64::NAN, 1e300, -1e300]).turns(), [0, i32::MAX, i32::MIN]);
        assert!(matches!(countable("m", [f64::NAN]), Err(PositionError::NotFinite { .. })));
        assert!(matches!(countable("m", [0.0, -1.4e10]), Err(PositionError::Input(InputError::OutOfRange { .. }))));
        assert!(countable("m", [0.0, -1.3e10]).is_ok());
    }
}
