//! The two solutions of an Assur group, named for what they mean.

use crate::linear::power_of_two_below;
use crate::scalar::to_f64;
use crate::{PositionError, Real, real};

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

/// The positions that exist among these branches, each with its branch. A branch with no position is left out, and so is
/// one with infinitely many.
pub fn existing<B: Copy, P>(
    branches: impl Iterator<Item = B>,
    mut assemble: impl FnMut(B) -> Result<P, PositionError>,
) -> impl Iterator<Item = Result<(B, P), PositionError>> {
    branches.filter_map(move |branch| match assemble(branch) {
        Err(PositionError::Unbuildable { .. } | PositionError::Undetermined { .. }) => None,
        position => Some(position.map(|position| (branch, position))),
    })
}

/// A factor below zero by at most this many epsilons of its scale is zero: links that just touch, in line.
///
/// Brackets of limits are off by up to 1.9 ulp times their condition number with it, by up to 3.2 with 1.5 and by up to 4.0
/// with 2 (`tests/limits_to_forty_digits.rs`); with none, links whose lengths are rounded decimals do not touch.
const TOUCHING: f64 = 1.0;

/// A distance below this many epsilons of the sum of the magnitudes of its terms is zero. The gallery's joints are right to
/// three ulp of such terms times their condition number (`tests/forty_digits`): with none, joints that coincide but for a
/// rounding error count as apart; with more, positions are refused that have digits left.
const COINCIDENT: f64 = 8.0;

/// The root of the product of the factors n - h and n + h, `size` = n, with the sign of a side. `scales` are the sums of
/// the magnitudes of the terms that n and h are made of.
///
/// # Errors
/// [`PositionError::Unbuildable`] if there is none, [`PositionError::Undetermined`] if n and h are both zero, [`PositionError::NotFinite`] if a
/// number is not finite.
#[inline]
pub fn chord<T: Real, S: Side>(
    mechanism: &'static str,
    group: &'static str,
    factors: [T; 2],
    size: T,
    scales: [T; 2],
    side: S,
) -> Result<T, PositionError> {
    let [low, high] = factors;
    let radicand = low * high;
    // Both factors cannot be negative.
    let root = if is_in_range(radicand) {
        radicand.sqrt()
    } else {
        touching_chord(mechanism, group, low, high, size, scales)?
    };
    Ok(if side == S::OF_POSITIVE_ROOT { root } else { -root })
}

/// [`chord`] where n is a distance between joints, or another sum that may vanish by rounding alone.
///
/// # Errors
/// Those of [`chord`].
#[inline]
pub fn reach_chord<T: Real, S: Side>(
    mechanism: &'static str,
    group: &'static str,
    factors: [T; 2],
    size: T,
    scales: [T; 2],
    side: S,
) -> Result<T, PositionError> {
    if size <= real::<T>(COINCIDENT) * T::default_epsilon() * scales[0] {
        touching_chord(mechanism, group, factors[0], factors[1], size, scales)?;
    }
    chord(mechanism, group, factors, size, scales, side)
}

/// Refuses a group of linear unknowns whose determinant is zero. Of each unknown, `numerators` are what Cramer's rule
/// divides by the determinant, `scales` the sums of the magnitudes of their terms.
///
/// # Errors
/// [`PositionError::Undetermined`] if the numerators are zero as well, else [`PositionError::Unbuildable`]; [`PositionError::NotFinite`] if a
/// numerator is not finite.
#[inline]
pub fn solvable<T: Real, const N: usize>(
    mechanism: &'static str,
    group: &'static str,
    determinant: T,
    numerators: [T; N],
    scales: [T; N],
) -> Result<(), PositionError> {
    // What is not a number has its own error, at the end of the chain.
    if determinant.is_zero() { Err(unsolvable(mechanism, group, &numerators, &scales)) } else { Ok(()) }
}

#[cold]
#[inline(never)]
fn unsolvable<T: Real>(mechanism: &'static str, group: &'static str, numerators: &[T], scales: &[T]) -> PositionError {
    let gaps = numerators.iter().zip(scales).map(|(numerator, scale)| relative(numerator.abs(), *scale));
    let tolerance = COINCIDENT * to_f64(T::default_epsilon());
    // Not by `max`, which loses what is not a number.
    let gap = gaps.fold(0.0, |most: f64, gap| if gap <= most { most } else { gap });
    if !numerators.iter().all(T::is_finite) {
        PositionError::NotFinite { mechanism, quantity: POSITION }
    } else if gap <= tolerance {
        PositionError::Undetermined { mechanism, group }
    } else {
        PositionError::Unbuildable { mechanism, group, gap }
    }
}

/// The quantity that errors of positions name.
const POSITION: &str = "the position";

/// A magnitude relative to a scale.
fn relative<T: Real>(magnitude: T, scale: T) -> f64 {
    if magnitude.is_zero() {
        0.0
    } else if scale.is_zero() {
        f64::INFINITY
    } else {
        to_f64(magnitude / scale)
    }
}

/// Whether a product of squares of lengths is far from the ends of its range. That of huge or tiny lengths is taken in
/// other units.
#[inline]
fn is_in_range<T: Real>(product: T) -> bool {
    let epsilon = T::default_epsilon();
    let tiny = epsilon * epsilon * epsilon * epsilon;
    product > tiny && product < T::one() / tiny
}

/// Where a factor is less than this part of the squares that it is the difference of, they are subtracted
/// without rounding.
const CANCELLATION: f64 = 1.0 / 16.0;

/// Two links of lengths p and q between joints whose line is (x, y), D^2 = x^2 + y^2. A length may be negative, and counts
/// by its magnitude.
#[derive(Debug, Clone, Copy)]
pub struct Triangle<T> {
    /// p and q.
    pub links: [T; 2],
    /// x and y.
    pub line: [T; 2],
    /// The sum of the magnitudes of the terms of x and y.
    pub scale: T,
    /// (p + q)^2.
    pub reach_squared: T,
    /// D^2.
    pub distance_squared: T,
    /// (p + q)^2 - D^2 and D^2 - (p - q)^2.
    pub factors: [T; 2],
}

/// The half chord of a triangle, twice: the root of ((p + q)^2 - D^2) (D^2 - (p - q)^2), with the sign of a side.
///
/// Besides, whether the triangle is plain: open, and of a size at which no step from here to the directions of the links
/// can leave the range of the scalar. With s = p + q, then D^2 < s^2 15/16 and (p - q)^2 < D^2 15/16, so that neither link
/// is shorter than s/32; and since D^2 / s^2, s^2 D^2 and 1 / s are in range, so are the links' components, which are
/// less than 2 s before any rounding or after it.
///
/// Near a dead point a factor is a difference of nearly equal squares. It is then computed from the lengths and
/// the line themselves as if nothing was rounded before the end, so that the chord is right to a few roundings
/// however flat the triangle: T. J. Dekker, "A floating-point technique for extending the available precision",
/// Numerische Mathematik 18, 1971.
///
/// # Errors
/// [`PositionError::Unbuildable`] if there is none, [`PositionError::Undetermined`] if the joints coincide and the links are equally long
/// or if a link has no length, [`PositionError::NotFinite`] if a number is not finite.
#[inline]
pub fn elbow_chord<T: Real, S: Side>(
    mechanism: &'static str,
    group: &'static str,
    triangle: Triangle<T>,
    side: S,
) -> Result<(T, bool), PositionError> {
    let Triangle { links: [p, q], line: [x, y], scale, reach_squared, distance_squared, factors: [low, high] } =
        triangle;
    let part = real::<T>(CANCELLATION);
    let is_open = low > part * reach_squared
        && high > part * distance_squared
        && distance_squared > T::default_epsilon() * reach_squared;
    let product = low * high;
    let is_plain = is_open && is_in_range(product);
    let root = if is_plain {
        product.sqrt()
    } else if is_open {
        root(low, high, reach_squared)
    } else {
        flat_chord(mechanism, group, p, q, x, y, scale)?
    };
    Ok((if side == S::OF_POSITIVE_ROOT { root } else { -root }, is_plain))
}

/// The chord of a triangle that is not plain.
///
/// Scalars come and go in registers: arrays would be stored by callers that never come here, too.
#[cold]
#[inline(never)]
fn flat_chord<T: Real>(
    mechanism: &'static str,
    group: &'static str,
    p: T,
    q: T,
    x: T,
    y: T,
    scale: T,
) -> Result<T, PositionError> {
    let (p, q, epsilon) = (p.abs(), q.abs(), T::default_epsilon());
    let (sum, distance, line) = ((p + q) * (p + q), x * x + y * y, x.hypot(y));
    if !(sum.is_finite() && distance.is_finite()) {
        return Err(PositionError::NotFinite { mechanism, quantity: POSITION });
    }
    let coincident = real::<T>(COINCIDENT) * epsilon;
    let difference = (p - q).abs();
    if line <= coincident * scale {
        let gap = relative(difference, p + q);
        let is_undetermined = difference <= coincident * (scale + p + q);
        return Err(if is_undetermined {
            PositionError::Undetermined { mechanism, group }
        } else {
            PositionError::Unbuildable { mechanism, group, gap: gap * gap }
        });
    }
    let (low, high) = exactly(p, q, x, y, sum, distance);
    // The sums of the magnitudes of the terms of both factors, each as often as it counts.
    let two = real::<T>(2.0);
    let of_line = line * scale;
    let scales = [two * (sum + of_line), two * (difference * (p + q) + of_line)];
    let least = if low < high { low } else { high };
    let tolerance = real::<T>(TOUCHING) * epsilon * if low < high { scales[0] } else { scales[1] };
    let root = if least > T::zero() {
        root(low, high, sum)
    } else if -least <= tolerance {
        T::zero()
    } else {
        return Err(PositionError::Unbuildable { mechanism, group, gap: relative(-least, sum) });
    };
    // The angle of a link without length is any.
    if p.is_zero() || q.is_zero() { Err(PositionError::Undetermined { mechanism, group }) } else { Ok(root) }
}

/// (p + q)^2 - D^2 and D^2 - (p - q)^2 of the lengths and the line as they are. What is less than one rounding of the
/// squares is zero: lengths such as 33.3 and 66.7 are no nearer to what was meant.
///
/// In a scalar without fused multiplication, such as double-double, the squares' own roundings stay.
fn exactly<T: Real>(p: T, q: T, x: T, y: T, sum: T, distance: T) -> (T, T) {
    let (low, high) = (beyond(two_sum(p, q), [x, y]), -beyond(two_sum(p, -q), [x, y]));
    let touching = |factor: T, size: T| if factor.abs() <= T::default_epsilon() * size { T::zero() } else { factor };
    (touching(low, sum), touching(high, distance))
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

/// The chord of a group that is not in range, or touches, or does not exist.
#[cold]
#[inline(never)]
fn touching_chord<T: Real>(
    mechanism: &'static str,
    group: &'static str,
    low: T,
    high: T,
    size: T,
    [of_size, of_rest]: [T; 2],
) -> Result<T, PositionError> {
    if !(low.is_finite() && high.is_finite() && size.is_finite()) {
        return Err(PositionError::NotFinite { mechanism, quantity: POSITION });
    }
    let (scale, epsilon) = (of_size + of_rest, T::default_epsilon());
    let least = if low < high { low } else { high };
    let vanishes = size <= real::<T>(COINCIDENT) * epsilon * of_size;
    let tolerance = real::<T>(if vanishes { COINCIDENT } else { TOUCHING }) * epsilon * scale;
    if least > T::zero() && !vanishes {
        Ok(root(low, high, size))
    } else if -least > tolerance {
        Err(PositionError::Unbuildable { mechanism, group, gap: relative(-least, size) })
    } else if vanishes {
        Err(PositionError::Undetermined { mechanism, group })
    } else {
        // Zero has the sign of the side, not of a factor.
        Ok(T::zero())
    }
}

/// The root of a product of positive factors in units of a power of two: the same bits as those of lengths near 1.
#[cold]
fn root<T: Real>(low: T, high: T, size: T) -> T {
    let unit = power_of_two_below(size);
    ((low / unit) * (high / unit)).sqrt() * unit
}

/// The side that a root with this sign belongs to: at a dead point, where it is zero, the sign of the
/// zero tells.
#[must_use]
pub fn side_of<T: Real, S: Side>(root: T) -> S {
    if root.is_sign_positive() { S::OF_POSITIVE_ROOT } else { S::OF_NEGATIVE_ROOT }
}
