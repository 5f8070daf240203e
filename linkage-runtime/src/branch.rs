//! The two solutions of an Assur group, named for what they mean.

use crate::scalar::to_f64;
use crate::{Error, Real, real};

/// One of the two solutions of a group, which are the two signs of a root.
pub trait Side: Copy + PartialEq {
    /// The solution of the positive root.
    const OF_POSITIVE_ROOT: Self;
    /// The solution of the negative root.
    const OF_NEGATIVE_ROOT: Self;
}

macro_rules! choices {
    ($($(#[$docs:meta])* $name:ident { $(#[$plus_docs:meta])* $plus:ident, $(#[$minus_docs:meta])* $minus:ident })*) => {$(
        $(#[$docs])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum $name {
            $(#[$plus_docs])*
            $plus,
            $(#[$minus_docs])*
            $minus,
        }

        impl Side for $name {
            const OF_POSITIVE_ROOT: Self = Self::$plus;
            const OF_NEGATIVE_ROOT: Self = Self::$minus;
        }
    )*};
}

// Each changes only where its group is singular: it is the sign of the determinant of the group's part of
// J, up to the order of its columns and rows.
choices! {
    /// Where the middle joint of a dyad of two links (RRR) stands.
    ///
    /// The line runs from the outer joint of the link that the group names first to the outer joint of
    /// the other.
    Elbow {
        /// Left of the line.
        Left,
        /// Right of the line.
        Right
    }
    /// Where a slider stands on its guide (RRP, RPR).
    Slider {
        /// The larger of the two moduli.
        Far,
        /// The smaller of the two moduli.
        Near
    }
    /// Which of two angles solves a scalar closure a cos(phi) + b sin(phi) = h.
    Slope {
        /// Left side minus right side of the closure grows with the angle.
        Rising,
        /// Left side minus right side of the closure falls as the angle grows.
        Falling
    }
}

/// The positions that exist among these branches, each with its branch.
pub fn existing<B: Copy, P>(
    branches: impl Iterator<Item = B>,
    mut assemble: impl FnMut(B) -> Result<P, Error>,
) -> impl Iterator<Item = Result<(B, P), Error>> {
    branches.filter_map(move |branch| match assemble(branch) {
        Err(Error::Unbuildable { .. }) => None,
        position => Some(position.map(|position| (branch, position))),
    })
}

/// A factor of this many roundings of its largest value below zero is zero: a chord that just touches.
const ROUNDINGS: f64 = 16.0;

/// The root of the product of two factors whose largest value is `size`, with the sign of a side.
///
/// # Errors
/// [`Error::Unbuildable`] if there is none, [`Error::NotFinite`] if a number is not finite.
#[inline]
pub fn chord<T: Real, S: Side>(
    mechanism: &'static str,
    group: &'static str,
    factors: [T; 2],
    size: T,
    side: S,
) -> Result<T, Error> {
    let [low, high] = factors;
    let (radicand, epsilon) = (low * high, T::default_epsilon());
    // Both factors cannot be negative. Where their product is near the ends of its range, of huge and of
    // tiny lengths, each has its own root.
    let is_plain = radicand > epsilon * epsilon * epsilon * epsilon && radicand.is_finite();
    let root = if is_plain { radicand.sqrt() } else { guarded(mechanism, group, factors, size)? };
    Ok(if side == S::OF_POSITIVE_ROOT { root } else { -root })
}

#[cold]
fn guarded<T: Real>(mechanism: &'static str, group: &'static str, factors: [T; 2], size: T) -> Result<T, Error> {
    let [low, high] = factors;
    if !(low.is_finite() && high.is_finite() && size.is_finite()) {
        return Err(Error::NotFinite { mechanism, quantity: "the position" });
    }
    let least = if low < high { low } else { high };
    if least > T::zero() {
        return Ok(low.sqrt() * high.sqrt());
    }
    // Zero has the sign of the side, not of a factor.
    if -least <= real::<T>(ROUNDINGS) * T::default_epsilon() * size {
        return Ok(T::zero());
    }
    let gap = if size.is_zero() { f64::INFINITY } else { to_f64(-least / size) };
    Err(Error::Unbuildable { mechanism, group, gap })
}

/// The side that a root with this sign belongs to: at a dead point, where it is zero, the sign of the
/// zero tells.
#[must_use]
pub fn side_of<T: Real, S: Side>(root: T) -> S {
    if root.is_sign_positive() { S::OF_POSITIVE_ROOT } else { S::OF_NEGATIVE_ROOT }
}
