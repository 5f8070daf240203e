//! The half chords of groups with two solutions: square roots of products of two factors, exact near dead points.

use crate::bounded::{exact, has_bound, instead, lost};
use crate::branch::Side;
use crate::error::{InputValues, Name};
use crate::linear::{is_nonzero, power_of_two_below};
use crate::native::same;
use crate::origin::Origin;
use crate::scalar::to_f64;
use crate::{PositionError, Real, real};

/// A factor under the root of a chord that is negative by at most this many ulps of its scale counts as zero: the links
/// are in line.
///
/// Limits of an input are then off by up to 1.9 ulp times their condition number; with 1.5 by up to 3.2, with 2 by up
/// to 4.0 (`tests/digits/limits_to_forty_digits.rs`). With 0, links in line whose lengths are rounded decimals do not reach
/// each other.
const TOUCHING_ULPS: f64 = 1.0;

/// A distance of at most this many ulps of the sum of the magnitudes of its terms counts as zero. The joints of the
/// test mechanisms are accurate to three ulp of that sum times their condition number (`tests/digits/forty_digits`). With 0, two
/// joints at one place would count as apart, because their positions are rounded; with more, positions that still have
/// correct digits are rejected.
pub const COINCIDENT_ULPS: f64 = 8.0;

/// ±sqrt((n - h) (n + h)), with the sign of `side`: the half chord of a circle of radius n at the distance h from its
/// centre. The joint of a link (RRP) is on both the circle about its other end, with the link's length as n, and the
/// guide at the distance h; for RPR n is the distance of the outer joints and h the offset of the arm; for
/// a cos(phi) + b sin(phi) = h, n is hypot(a, b).
///
/// `factors` are n - h and n + h, `radius` is n, `scales` are the sums of the magnitudes of the terms of n and of h.
///
/// # Errors
/// [`PositionError::Unbuildable`] if the product is negative, [`PositionError::Undetermined`] if n and h are both zero,
/// [`PositionError::NotFinite`] if a number is not finite.
#[inline]
pub fn chord<T: Real, S: Side, O: Origin>(
    origin: O,
    group: O::Name,
    factors: [T; 2],
    radius: T,
    scales: [T; 2],
    side: S,
) -> Result<T, PositionError<O::Name>> {
    let [low, high] = factors;
    let radicand = low * high;
    // At most one factor is negative.
    let root = if is_in_range(radicand) {
        radicand.sqrt()
    } else {
        touching_chord(origin.mechanism(), group, low, high, radius, scales[0], scales[1])
            .map_err(|error| origin.located(error))?
    };
    Ok(side.signed(root))
}

/// Computes the [`chord`] where n is a distance between joints, or another sum that may be zero but for the rounding of
/// its terms.
///
/// # Errors
/// Those of [`chord`].
#[inline]
pub fn reach_chord<T: Real, S: Side, O: Origin>(
    origin: O,
    group: O::Name,
    factors: [T; 2],
    radius: T,
    scales: [T; 2],
    side: S,
) -> Result<T, PositionError<O::Name>> {
    if radius <= real::<T>(COINCIDENT_ULPS) * T::default_epsilon() * scales[0] {
        touching_chord(origin.mechanism(), group, factors[0], factors[1], radius, scales[0], scales[1])
            .map_err(|error| origin.located(error))?;
    }
    chord(origin, group, factors, radius, scales, side)
}

/// Returns an error if the determinant of a group of linear unknowns is zero. `numerators` are those of Cramer's rule,
/// `scales` the sums of the magnitudes of the terms of each.
///
/// # Errors
/// [`PositionError::Undetermined`] if the numerators are zero as well, else [`PositionError::Unbuildable`];
/// [`PositionError::NotFinite`] if a numerator is not finite.
#[inline]
pub fn solvable<T: Real, O: Origin, const N: usize>(
    origin: O,
    group: O::Name,
    determinant: T,
    numerators: [T; N],
    scales: [T; N],
) -> Result<(), PositionError<O::Name>> {
    // A determinant that is NaN makes the position NaN, which is reported when the position is complete.
    if determinant.is_zero() {
        Err(origin.located(unsolvable(origin.mechanism(), group, &numerators, &scales)))
    } else {
        Ok(())
    }
}

/// Returns an error if a distance that an equation gives is negative.
///
/// # Errors
/// [`PositionError::Unbuildable`], with the whole distance as the gap.
#[inline]
pub fn reachable<T: Real, O: Origin>(origin: O, group: O::Name, distance: T) -> Result<(), PositionError<O::Name>> {
    // A distance that is NaN makes the position NaN, which is reported when the position is complete.
    if distance < T::zero() { Err(origin.located(unbuildable(origin.mechanism(), group, 1.0))) } else { Ok(()) }
}

#[cold]
#[inline(never)]
fn unsolvable<T: Real, S: Name>(mechanism: S, group: S, numerators: &[T], scales: &[T]) -> PositionError<S> {
    let gaps = numerators.iter().zip(scales).map(|(numerator, scale)| relative(numerator.abs(), *scale));
    let tolerance = real::<T>(COINCIDENT_ULPS) * T::default_epsilon();
    // `max` would drop NaN.
    let gap = gaps.fold(T::zero(), |most, gap| if gap <= most { most } else { gap });
    if !numerators.iter().all(T::is_finite) {
        PositionError::NotFinite { mechanism, quantity: S::from_static(POSITION) }
    } else if gap <= tolerance {
        PositionError::Undetermined { mechanism, group }
    } else {
        unbuildable(mechanism, group, to_f64(gap))
    }
}

/// The error of a group that cannot be assembled; its caller may know the inputs.
fn unbuildable<S: Name>(mechanism: S, group: S, gap: f64) -> PositionError<S> {
    PositionError::Unbuildable { mechanism, group, gap, inputs: InputValues::default() }
}

/// The quantity named in errors of this module.
const POSITION: &str = "the position";

/// magnitude / scale, where 0 / 0 = 0.
fn relative<T: Real>(magnitude: T, scale: T) -> T {
    if magnitude.is_zero() {
        T::zero()
    } else if scale.is_zero() {
        real(f64::INFINITY)
    } else {
        magnitude / scale
    }
}

/// A product of two squared lengths that is no larger is near underflow, one no smaller than its inverse near overflow.
#[inline]
#[must_use]
pub fn smallest_product<T: Real>() -> T {
    let epsilon = T::default_epsilon();
    epsilon * epsilon * epsilon * epsilon
}

/// True if a product of two squared lengths is far from overflow and underflow. If not, [`root`] computes in other
/// units.
#[inline]
fn is_in_range<T: Real>(product: T) -> bool {
    let tiny = smallest_product::<T>();
    (product > tiny) & (product < T::one() / tiny)
}

/// If a factor, a difference of two squares, is less than this fraction of the larger one, it is computed exactly.
pub const CANCELLATION: f64 = 1.0 / 16.0;

/// The triangle of two links of lengths p and q whose outer joints are (x, y) apart, D^2 = x^2 + y^2. Only the
/// magnitude of a length counts.
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

impl<T: Real> Triangle<T> {
    /// True if it is far from flat.
    #[inline(always)]
    fn is_open(&self) -> bool {
        let Self { reach_squared, distance_squared, factors: [low, high], .. } = *self;
        let part = real::<T>(CANCELLATION);
        (low > part * reach_squared)
            & (high > part * distance_squared)
            & (distance_squared > T::default_epsilon() * reach_squared)
    }
}

/// ±sqrt(((p + q)^2 - D^2) (D^2 - (p - q)^2)), with the sign of `side`: twice the half chord of a triangle.
///
/// The flag returned is true if the triangle is far from flat and of moderate size. The directions of the links are
/// then computed without overflow and underflow. Let s = p + q. From D^2 < s^2 15/16 and (p - q)^2 < D^2 15/16 it follows
/// that neither link is shorter than s/32. D^2 / s^2, s^2 D^2 and 1 / s are in range. So are the links' components: they
/// are at most s, and rounding does not double them.
///
/// Near a dead point a factor is a difference of nearly equal squares. It is then computed in extended precision, so
/// that the chord is accurate to a few ulp however flat the triangle is: T. J. Dekker, "A floating-point technique for
/// extending the available precision", Numerische Mathematik 18, 1971.
///
/// # Errors
/// [`PositionError::Unbuildable`] if there is no such triangle, [`PositionError::Undetermined`] if the joints coincide
/// and the links are equally long or if a link has no length, [`PositionError::NotFinite`] if a number is not finite.
#[inline(always)]
pub fn elbow_chord<T: Real, S: Side, O: Origin>(
    origin: O,
    group: O::Name,
    triangle: Triangle<T>,
    side: S,
) -> Result<(T, bool), PositionError<O::Name>> {
    let Triangle { links: [p, q], line: [x, y], scale, reach_squared, factors: [low, high], .. } = triangle;
    let (is_open, product) = (triangle.is_open(), low * high);
    let is_plain = is_open && is_in_range(product);
    let root = if is_plain {
        product.sqrt()
    } else if is_open {
        root(low, high, reach_squared)
    } else {
        flat_chord(origin.mechanism(), group, p, q, x, y, scale).map_err(|error| origin.located(error))?
    };
    Ok((side.signed(root), is_plain))
}

/// The [`regular_elbow_chord`] without branches; false if that computes it in another way or has none.
#[inline(always)]
pub fn elbow_chord_in_lane<T: Real, S: Side>(triangle: Triangle<T>, side: S) -> (T, bool) {
    let [low, high] = triangle.factors;
    let product = low * high;
    (product.sqrt() * sign(side), triangle.is_open() & is_in_range(product))
}

/// The [`elbow_chord`] of a triangle whose links have finite directions and whose determinant is larger than its
/// rounding error. `None` for any other triangle, and if there is no triangle.
#[inline(always)]
pub fn regular_elbow_chord<T: Real, S: Side>(triangle: Triangle<T>, side: S) -> Option<T> {
    let Triangle { links: [p, q], line: [x, y], scale, factors: [low, high], .. } = triangle;
    let product = low * high;
    let is_plain = triangle.is_open() && is_in_range(product);
    let root = if is_plain { product.sqrt() } else { uncommon_chord(p, q, x, y, scale, low, high)? };
    Some(side.signed(root))
}

/// The [`regular_elbow_chord`] of a triangle that is nearly flat, or very large or small, without its sign.
#[cold]
#[inline(never)]
fn uncommon_chord<T: Real>(p: T, q: T, x: T, y: T, scale: T, low: T, high: T) -> Option<T> {
    let (sum, reach) = (p + q, p.abs() + q.abs());
    let (reach_squared, distance_squared) = (sum * sum, x * x + y * y);
    let triangle =
        Triangle { links: [p, q], line: [x, y], scale, reach_squared, distance_squared, factors: [low, high] };
    // Its inverse is finite, and so is that of any part of it that is not negligible.
    let has_inverse = (T::default_epsilon() * reach * reach).recip().is_finite();
    if triangle.is_open() {
        return has_inverse.then(|| root(low, high, reach_squared));
    }
    let chord = flat_chord("", "", p, q, x, y, scale).ok()?;
    let shortest = T::default_epsilon() * reach * reach;
    let are_apart = [distance_squared, p * p, q * q].into_iter().all(|square| square > shortest);
    // The determinant is half the chord.
    (are_apart && has_inverse && is_nonzero(chord * real(0.5), p * q)).then_some(chord)
}

/// The [`chord`] of two positive finite factors, else `None`.
#[inline]
pub fn regular_chord<T: Real, S: Side>(factors: [T; 2], radius: T, side: S) -> Option<T> {
    let [low, high] = factors;
    let radicand = low * high;
    let root = if is_in_range(radicand) { radicand.sqrt() } else { uncommon_circle_chord(low, high, radius)? };
    Some(side.signed(root))
}

/// The [`regular_chord`] of a circle that is very large or small, without its sign.
#[cold]
#[inline(never)]
fn uncommon_circle_chord<T: Real>(low: T, high: T, radius: T) -> Option<T> {
    // Where these are not finite, `chord` is an error.
    let is_regular = low > T::zero() && high > T::zero() && [low, high, radius].iter().all(T::is_finite);
    is_regular.then(|| root(low, high, radius))
}

/// The [`regular_chord`] without branches; false if that computes it in other units or has none.
#[inline(always)]
pub fn chord_in_lane<T: Real, S: Side>([low, high]: [T; 2], side: S) -> (T, bool) {
    let radicand = low * high;
    (radicand.sqrt() * sign(side), is_in_range(radicand))
}

/// The [`regular_reach_chord`] without branches; false if that computes it in other units or has none.
#[inline(always)]
pub fn reach_chord_in_lane<T: Real, S: Side>(factors: [T; 2], radius: T, scale: T, side: S) -> (T, bool) {
    let (chord, is_regular) = chord_in_lane(factors, side);
    (chord, is_regular & is_apart(radius, scale))
}

/// 1 or -1: a factor, since a choice of the side would divide the loop.
#[inline(always)]
fn sign<T: Real, S: Side>(side: S) -> T {
    side.signed(T::one())
}

/// True if a distance is larger than its rounding error; `scale` is the sum of the magnitudes of its terms.
#[inline(always)]
fn is_apart<T: Real>(radius: T, scale: T) -> bool {
    radius > real::<T>(COINCIDENT_ULPS) * T::default_epsilon() * scale
}

/// The [`reach_chord`] of two positive factors and a distance `radius` larger than its rounding error, else `None`.
/// `scale` is the sum of the magnitudes of the terms of the distance.
#[inline]
pub fn regular_reach_chord<T: Real, S: Side>(factors: [T; 2], radius: T, scale: T, side: S) -> Option<T> {
    if is_apart(radius, scale) { regular_chord(factors, radius, side) } else { None }
}

/// The chord of a triangle that is nearly flat, does not exist, or is very large or small.
///
/// Scalars instead of arrays: arrays would be stored in memory even by callers that do not reach this function.
#[cold]
#[inline(never)]
fn flat_chord<T: Real, S: Name>(
    mechanism: S,
    group: S,
    p: T,
    q: T,
    x: T,
    y: T,
    scale: T,
) -> Result<T, PositionError<S>> {
    let (p, q, epsilon) = (p.abs(), q.abs(), T::default_epsilon());
    let (sum, distance, line) = ((p + q) * (p + q), x * x + y * y, x.hypotenuse(y));
    if !(sum.is_finite() && distance.is_finite()) {
        return Err(PositionError::NotFinite { mechanism, quantity: S::from_static(POSITION) });
    }
    let coincident = real::<T>(COINCIDENT_ULPS) * epsilon;
    let difference = (p - q).abs();
    if line <= coincident * scale {
        let gap = relative(difference, p + q);
        let is_undetermined = difference <= coincident * (scale + p + q);
        return Err(if is_undetermined {
            PositionError::Undetermined { mechanism, group }
        } else {
            unbuildable(mechanism, group, to_f64(gap * gap))
        });
    }
    let [low, high] = exact_factors(p, q, x, y, sum, distance);
    // The sums of the magnitudes of the terms of both factors, with their multiplicities.
    let two = real::<T>(2.0);
    let of_line = line * scale;
    let scales = [two * (sum + of_line), two * (difference * (p + q) + of_line)];
    let least = if low < high { low } else { high };
    let tolerance = real::<T>(TOUCHING_ULPS) * epsilon * if low < high { scales[0] } else { scales[1] };
    let root = if least > T::zero() {
        root(low, high, sum)
    } else if -least <= tolerance {
        in_line(low, high, sum)
    } else {
        return Err(unbuildable(mechanism, group, to_f64(relative(-least, sum))));
    };
    // A link of length zero can have any angle.
    if p.is_zero() || q.is_zero() { Err(PositionError::Undetermined { mechanism, group }) } else { Ok(root) }
}

/// (p + q)^2 - D^2 and D^2 - (p - q)^2, computed exactly. A result below one ulp of the squares is set to zero,
/// because lengths such as 33.3 and 66.7 are themselves rounded to that precision.
///
/// A scalar without fused multiply-add, such as double-double, gives rounded squares: the result is then not exact.
fn exact_factors<T: Real>(p: T, q: T, x: T, y: T, sum: T, distance: T) -> [T; 2] {
    let touching = |factor: T, size: T| {
        if factor.abs() <= T::default_epsilon() * size { instead(T::zero(), factor) } else { factor }
    };
    let [low, high] =
        [q, -q].map(|q| if has_bound::<T>() { bounded_beyond(p, q, [x, y]) } else { beyond(two_sum(p, q), [x, y]) });
    [touching(low, sum), touching(-high, distance)]
}

/// (a + b)^2 - x^2 - y^2 of the values, with the bound that follows from those of a, b, x and y: the bounds of the
/// rounding errors that [`beyond`] makes good would be added.
///
/// With errors e the change is (2 (a + b) + e_ab) e_ab - (2 x + e_x) e_x - (2 y + e_y) e_y. `beyond` itself rounds its
/// result, and before that eight terms below 2^-50 (a^2 + b^2 + x^2 + y^2).
fn bounded_beyond<T: Real>(a: T, b: T, [x, y]: [T; 2]) -> T {
    let [of_a, of_b, of_x, of_y] = [a, b, x, y].map(to_f64);
    let value = beyond(two_sum(of_a, of_b), [of_x, of_y]);
    let change = |number: T, off: T| lost((number + number + off) * off);
    let off = |number: T| number - exact(number);
    let [a, b, x, y] = [a, b, x, y].map(|number| (exact(number), off(number)));
    let epsilon = T::default_epsilon();
    let squares = a.0 * a.0 + b.0 * b.0 + x.0 * x.0 + y.0 * y.0;
    let changes = change(a.0 + b.0, a.1 + b.1) + change(x.0, x.1) + change(y.0, y.1);
    let value = exact(real::<T>(value));
    value - (changes + lost(real::<T>(16.0) * epsilon * epsilon * squares) + lost(real::<T>(0.5) * epsilon * value))
}

/// (a + b)^2 - x^2 - y^2 for a sum a and its rounding error b.
fn beyond<T: Real>((a, b): (T, T), [x, y]: [T; 2]) -> T {
    let ([a2, e], [x2, f], [y2, g]) = (two_product(a), two_product(x), two_product(y));
    // The larger square is subtracted first, so that the other difference is one of similar numbers.
    let (large, small) = if x2 < y2 { (y2, x2) } else { (x2, y2) };
    let (first, h) = two_sum(a2, -large);
    let (second, i) = two_sum(first, -small);
    second + (h + i + (e - f - g) + (a + a + b) * b)
}

/// a + b and its rounding error: D. E. Knuth.
fn two_sum<T: Real>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// a^2 and its rounding error.
fn two_product<T: Real>(a: T) -> [T; 2] {
    let square = a * a;
    let rest = match same(a) {
        Some(a) => same(rest_of_square(a)),
        None => None,
    };
    [square, rest.unwrap_or_else(|| a.mul_add(a, -square))]
}

/// The rounding error of the square of a float by its halves (Dekker): without an instruction for it, a fused
/// multiply-add of floats is computed in doubles.
fn rest_of_square(a: f32) -> f32 {
    /// The sign, the exponent and the first 12 bits.
    const UPPER: u32 = 0xffff_f000;
    let upper = f32::from_bits(a.to_bits() & UPPER);
    let lower = a - upper;
    (upper * upper - a * a) + (upper + upper) * lower + lower * lower
}

/// The chord of a group whose links are in line or do not reach each other, or whose factors overflow or underflow.
#[cold]
#[inline(never)]
fn touching_chord<T: Real, S: Name>(
    mechanism: S,
    group: S,
    low: T,
    high: T,
    radius: T,
    radius_scale: T,
    offset_scale: T,
) -> Result<T, PositionError<S>> {
    if !(low.is_finite() && high.is_finite() && radius.is_finite()) {
        return Err(PositionError::NotFinite { mechanism, quantity: S::from_static(POSITION) });
    }
    let (scale, epsilon) = (radius_scale + offset_scale, T::default_epsilon());
    let least = if low < high { low } else { high };
    let vanishes = radius <= real::<T>(COINCIDENT_ULPS) * epsilon * radius_scale;
    let tolerance = real::<T>(if vanishes { COINCIDENT_ULPS } else { TOUCHING_ULPS }) * epsilon * scale;
    if least > T::zero() && !vanishes {
        Ok(root(low, high, radius))
    } else if -least > tolerance {
        Err(unbuildable(mechanism, group, to_f64(relative(-least, radius))))
    } else if vanishes {
        Err(PositionError::Undetermined { mechanism, group })
    } else {
        Ok(in_line(low, high, radius))
    }
}

/// The chord zero of links in line, of which a factor is zero or negative within rounding error: a scalar with a bound
/// keeps that the root of the factor that was meant need not be zero. The caller gives the zero the sign of the side.
fn in_line<T: Real>(low: T, high: T, size: T) -> T {
    if !has_bound::<T>() {
        return T::zero();
    }
    let unit = power_of_two_below(size);
    let [least, other] = if low < high { [low, high] } else { [high, low] };
    let radicand = instead(T::zero(), least) / unit * (other / unit).abs();
    radicand.sqrt() * unit
}

/// sqrt(`low` `high`) of positive factors, divided by a power of two near `size` against overflow: the digits are those
/// of a mechanism with lengths near 1.
#[cold]
#[inline(never)]
fn root<T: Real>(low: T, high: T, size: T) -> T {
    let unit = power_of_two_below(size);
    ((low / unit) * (high / unit)).sqrt() * unit
}
