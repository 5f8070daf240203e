//! The two solutions of an Assur group, named for what they mean.

use crate::linear::power_of_two_below;
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
    // tiny lengths, it is that of other units.
    let tiny = epsilon * epsilon * epsilon * epsilon;
    let is_plain = radicand > tiny && radicand < T::one() / tiny;
    let root = if is_plain { radicand.sqrt() } else { guarded(mechanism, group, low, high, size)? };
    Ok(if side == S::OF_POSITIVE_ROOT { root } else { -root })
}

/// Where a factor is less than this part of the squares that it is the difference of, they are subtracted
/// without rounding.
const CANCELLATION: f64 = 1.0 / 16.0;

/// The half chord of two links `[p, q]` between joints whose line is `[x, y]`, twice: the root of
/// ((p + q)^2 - D^2) (D^2 - (p - q)^2), D^2 = x^2 + y^2, with the sign of a side; `factors` are the two
/// differences, `sizes` are (p + q)^2 and D^2. A length may be negative, and counts by its magnitude.
///
/// Near a dead point a factor is a difference of nearly equal squares. It is then computed from the lengths and
/// the line themselves as if nothing was rounded before the end, so that the chord is right to a few roundings
/// however flat the triangle: T. J. Dekker, "A floating-point technique for extending the available precision",
/// Numerische Mathematik 18, 1971.
///
/// # Errors
/// [`Error::Unbuildable`] if there is none, [`Error::NotFinite`] if a number is not finite.
#[inline]
pub fn elbow_chord<T: Real, S: Side>(
    mechanism: &'static str,
    group: &'static str,
    factors: [T; 2],
    sizes: [T; 2],
    links: [T; 2],
    line: [T; 2],
    side: S,
) -> Result<T, Error> {
    let ([low, high], [sum, distance], [p, q], [x, y]) = (factors, sizes, links, line);
    let part = real::<T>(CANCELLATION);
    let (low, high, sum) =
        if low > part * sum && high > part * distance { (low, high, sum) } else { exactly(p, q, x, y, distance) };
    chord(mechanism, group, [low, high], sum, side)
}

/// (p + q)^2 - D^2, D^2 - (p - q)^2 and (p + q)^2 of the lengths and the line as they are. What is less than one rounding of the
/// squares is zero: lengths such as 33.3 and 66.7 are no nearer to what was meant.
///
/// In a scalar without fused multiplication, such as double-double, the squares' own roundings stay.
///
/// Scalars come and go in registers: arrays would be stored on the road that does not call this, too.
#[cold]
#[inline(never)]
fn exactly<T: Real>(p: T, q: T, x: T, y: T, distance: T) -> (T, T, T) {
    let (p, q) = (p.abs(), q.abs());
    let sum = (p + q) * (p + q);
    let (low, high) = (beyond(two_sum(p, q), [x, y]), -beyond(two_sum(p, -q), [x, y]));
    let touching = |factor: T, size: T| if factor.abs() <= T::default_epsilon() * size { T::zero() } else { factor };
    (touching(low, sum), touching(high, distance), sum)
}

/// (a + b)^2 - x^2 - y^2 for a sum a and its rounding error b.
fn beyond<T: Real>((a, b): (T, T), [x, y]: [T; 2]) -> T {
    let ([a2, e], [x2, f], [y2, g]) = (two_product(a), two_product(x), two_product(y));
    // The larger difference last, so that it is one of numbers of the same size.
    let (large, small) = if x2 < y2 { (y2, x2) } else { (x2, y2) };
    let (first, h) = two_sum(a2, -large);
    let (second, i) = two_sum(first, -small);
    second + (h + i + (e - f - g) + (a + a + b) * b)
}

/// a + b and what its rounding lost: D. E. Knuth.
fn two_sum<T: Real>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// a^2 and what its rounding lost.
fn two_product<T: Real>(a: T) -> [T; 2] {
    let square = a * a;
    [square, a.mul_add(a, -square)]
}

#[cold]
#[inline(never)]
fn guarded<T: Real>(mechanism: &'static str, group: &'static str, low: T, high: T, size: T) -> Result<T, Error> {
    if !(low.is_finite() && high.is_finite() && size.is_finite()) {
        return Err(Error::NotFinite { mechanism, quantity: "the position" });
    }
    let least = if low < high { low } else { high };
    if least > T::zero() {
        // By a power of two: the same bits as those of lengths near 1.
        let unit = power_of_two_below(size);
        return Ok(((low / unit) * (high / unit)).sqrt() * unit);
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
