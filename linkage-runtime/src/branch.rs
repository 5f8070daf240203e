//! The two solutions of an Assur group.

use crate::scalar::to_f64;
use crate::{Error, Real, real};

/// Which of the two solutions of a group is meant: the sign of the determinant of its part of J up to the
/// order of its columns. It changes only where the group is singular.
///
/// Of two links (RRR) it tells to which side the second turns from the first, going round the closure; of
/// a slider (RRP, RPR) which of the two positions on its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// The root is positive: the second link turns left, the slider is far.
    Left,
    /// The root is negative: the second link turns right, the slider is near.
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
