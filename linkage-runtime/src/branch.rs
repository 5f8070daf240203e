//! The two solutions of an Assur group.

use crate::scalar::to_f64;
use crate::{Error, Real, real};

/// Which of the two solutions of a group is meant: the sign of the determinant of its part of J up to the
/// order of its columns. It changes only where the group is singular.
///
/// Left means: of two links (RRR) that the second turns left from the first, both taken as they stand in
/// the closure with all terms on one side; of a link and a slider (RRP) that the link points the way in
/// which the slider's modulus moves the closure; of a slider on a turning guide (RPR) that it is the one
/// with the larger modulus; of a single angle that its equation grows with the angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// The root is positive.
    Left,
    /// The root is negative.
    Right,
}

impl Side {
    /// The side of a root with this sign; zero counts as left.
    #[must_use]
    pub fn of<T: Real>(root: T) -> Self {
        if root >= T::zero() { Self::Left } else { Self::Right }
    }
}

/// A radicand of this many roundings of its largest value below zero is zero: a chord that just touches.
const ROUNDINGS: f64 = 16.0;

/// The root of `radicand`, whose largest value is `size`, with the sign of a side.
///
/// # Errors
/// [`Error::Unbuildable`] if there is none, [`Error::NotFinite`] if a number is not finite.
#[inline]
pub fn chord<T: Real>(
    mechanism: &'static str,
    group: &'static str,
    radicand: T,
    size: T,
    side: Side,
) -> Result<T, Error> {
    if radicand >= T::zero() && radicand.is_finite() {
        let root = radicand.sqrt();
        return Ok(if side == Side::Left { root } else { -root });
    }
    if radicand < T::zero() && -radicand <= real::<T>(ROUNDINGS) * T::default_epsilon() * size {
        return Ok(T::zero());
    }
    Err(unbuildable(mechanism, group, radicand, size))
}

#[cold]
fn unbuildable<T: Real>(mechanism: &'static str, group: &'static str, radicand: T, size: T) -> Error {
    if radicand.is_finite() && size.is_finite() {
        let gap = if size.is_zero() { f64::INFINITY } else { to_f64((radicand / size).abs().sqrt()) };
        Error::Unbuildable { mechanism, group, gap }
    } else {
        Error::NotFinite { mechanism, quantity: "the position" }
    }
}
