//! Limits of an input: the interval about a position in which a mechanism can be assembled.
//!
//! A group has a position where one or two functions are not negative, such as (p + q)^2 - D^2 for two links p and q
//! whose outer joints are D apart. If the group depends on the input v alone, or through linear equations solved before
//! it, they are of the form a + b cos(k v) + c sin(k v) or a + b v + c v^2, whose zeros have a closed form. Groups that
//! depend on other groups are searched in steps, refined wherever the determinant of a group has a minimum. Where a group
//! stops the mechanism, the motion is followed along its tangent, and through a position at which it touches another. A
//! limit may be a change point, beyond which the motion is on another branch. A search skips inputs at which a group is
//! undetermined ([`PositionError::Undetermined`]).
//!
//! Where the mechanism declares ranges of coordinates and outputs, the nearer of the limit and of the first end of a range
//! is returned; the range of the input itself is one.

mod limit;
mod ranges;
mod search;
mod searched;
mod touch;
mod walk;

pub use self::limit::Limit;

use core::fmt::{self, Display, Formatter};

use self::searched::Searched;
use crate::bounded::{angle_but_for_turns, has_bound, instead};
use crate::linear::power_of_two_below;
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::shown::Shown;
use crate::{Mechanism, Name, PositionError, PositionErrorOf, RangeEnd, Real, real};

/// The inputs between which a mechanism can be assembled on one branch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Limits<T, N = &'static str> {
    /// The name of the input.
    pub of: N,
    /// True if it is an angle.
    pub is_angle: bool,
    /// The end towards smaller inputs.
    pub lower: Limit<T, N>,
    /// The end towards larger inputs.
    pub upper: Limit<T, N>,
}

/// The limits and their reasons in one line, angles in degrees: `theta from 28.95502° (links of phi, psi in line) to 90° (the
/// largest value of theta)`.
impl<T: Real, N: Display> Display for Limits<T, N> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { of, is_angle, lower, upper } = self;
        let end = |f: &mut Formatter<'_>, word: &str, limit: &Limit<T, N>| {
            let Some(input) = limit.input() else { return Ok(()) };
            f.write_str(word)?;
            Shown { value: to_f64(input), is_angle: *is_angle }.fmt(f)?;
            match limit {
                Limit::Unlimited => Ok(()),
                Limit::Exact { group, .. } => write!(f, " (links of {group} in line)"),
                Limit::JointRange { of, end: RangeEnd::Least, .. } => write!(f, " (the least value of {of})"),
                Limit::JointRange { of, end: RangeEnd::Most, .. } => write!(f, " (the largest value of {of})"),
                Limit::Bracketed { group, .. } => write!(f, " ({group}, found by search)"),
            }
        };
        write!(f, "{of}")?;
        end(f, " from ", lower)?;
        end(f, if lower.input().is_some() { " to " } else { " up to " }, upper)?;
        f.write_str(match [lower.input(), upper.input()] {
            [None, None] => " without limits",
            [Some(_), None] => " on",
            [_, Some(_)] => "",
        })
    }
}

/// A function of an input that is not negative where a group can be assembled.
#[derive(Debug, Clone, Copy)]
pub enum Bound<T, N = &'static str> {
    /// a + b cos(k v) + c sin(k v) of an input v: a, b and c, then k.
    Angle(NamedGroup<N>, [T; 3], T),
    /// a + b v + c v^2 of an input v.
    Length(NamedGroup<N>, [T; 3]),
}

/// A group: its index among the determinants, and its unknowns.
pub type NamedGroup<N = &'static str> = (usize, N);

/// The range in which groups that have no [`Bound`] are searched for limits.
#[derive(Debug, Clone, Copy)]
pub enum Search<T> {
    /// No group is searched: all have bounds.
    ClosedFormOnly,
    /// One turn to either side.
    Turn,
    /// This distance to either side.
    Length(T),
}

/// Computes the limits of the input at `place` about `position`. `assemble` computes the position at the inputs of a
/// position nearby, `coordinates` those of a position.
///
/// # Errors
/// [`PositionError::NotFinite`] if a number is not finite; an [`InputError`](crate::InputError) if the position is outside of
/// a declared range.
pub fn limits<M: Mechanism>(
    mechanism: &M,
    place: usize,
    position: &M::Pose,
    bounds: impl IntoIterator<Item = Bound<M::Scalar, M::Name>>,
    search: Search<M::Scalar>,
    assemble: impl Fn(&M::Coordinates) -> Result<M::Pose, PositionErrorOf<M>>,
    coordinates: impl Fn(&M::Pose) -> M::Coordinates,
) -> Result<Limits<M::Scalar, M::Name>, PositionErrorOf<M>> {
    let position = coordinates(position);
    let start = M::inputs(&position).as_slice().get(place).copied().unwrap_or_else(M::Scalar::zero);
    let [mut lower, mut upper] = [None; 2];
    for bound in bounds {
        let not_finite =
            PositionError::NotFinite { mechanism: mechanism.name(), quantity: Name::from_static("a limit") };
        let [below, above] = bound.about(start).ok_or(not_finite)?;
        lower = nearer(lower, below, |new, old| new > old);
        upper = nearer(upper, above, |new, old| new < old);
    }
    let reach = match search {
        Search::ClosedFormOnly => M::Scalar::zero(),
        Search::Turn => M::Scalar::two_pi(),
        Search::Length(reach) => reach,
    };
    let searched = Searched { mechanism, place, reach, assemble: &assemble, coordinates: &coordinates };
    let exact =
        |end: Option<(M::Scalar, NamedGroup<M::Name>)>| -> Result<Limit<M::Scalar, M::Name>, PositionErrorOf<M>> {
            let Some((end, (place, group))) = end else { return Ok(Limit::Unlimited) };
            let input = searched.corrected(start, &position, end, place)?;
            Ok(Limit::Exact { input: instead(searched.last(start, &position, input)?, input), group })
        };
    let (lower, upper) = (exact(lower)?, exact(upper)?);
    let (lower, upper) = match search {
        Search::ClosedFormOnly => (lower, upper),
        _ => (
            searched.toward(start, &position, lower, start - reach)?,
            searched.toward(start, &position, upper, start + reach)?,
        ),
    };
    let of = mechanism.input_name(place);
    let is_angle = mechanism.input_angles().get(place).copied().unwrap_or_default();
    if mechanism.range_name(0).is_none() {
        return Ok(Limits { of, is_angle, lower, upper });
    }
    Ok(Limits {
        of,
        is_angle,
        lower: searched.within_ranges(start, &position, lower, -M::Scalar::one())?,
        upper: searched.within_ranges(start, &position, upper, M::Scalar::one())?,
    })
}

/// The end nearer to the start, of two that may not exist.
fn nearer<T: Copy, N: Copy>(
    known: Option<(T, NamedGroup<N>)>,
    new: Option<(T, NamedGroup<N>)>,
    is_nearer: fn(&T, &T) -> bool,
) -> Option<(T, NamedGroup<N>)> {
    match (known, new) {
        (Some((old, _)), Some((input, _))) if !is_nearer(&input, &old) => known,
        (_, Some(_)) => new,
        _ => known,
    }
}

impl<T: Real, N: Copy> Bound<T, N> {
    /// The nearest zeros on either side of `start`, where the function is not negative up to rounding error; none if a
    /// number is not finite. With one negative length of two both functions of a group have the other sign.
    fn about(&self, start: T) -> Option<Ends<(T, NamedGroup<N>)>> {
        let with_sign = |coefficients: [T; 3], terms: [T; 3]| {
            let least = terms.iter().fold(T::zero(), |sum, term| sum + term.abs()) * T::default_epsilon().sqrt();
            if terms[0] + terms[1] + terms[2] < -least { coefficients.map(|part| -part) } else { coefficients }
        };
        let (group, [lower, upper]) = match *self {
            Self::Angle(group, [a, b, c], rate) => {
                let (sine, cosine) = (rate * start).sine_cosine();
                (group, of_angle(with_sign([a, b, c], [a, b * cosine, c * sine]), rate, start)?)
            }
            Self::Length(group, [a, b, c]) => {
                (group, of_length(with_sign([a, b, c], [a, b * start, c * start * start]), start)?)
            }
        };
        let is_finite = lower.into_iter().chain(upper).all(|input| input.is_finite());
        // At a limit a rounding error may put the zero on the other side of `start`.
        let lower = lower.map(|input| if input < start { input } else { instead(start, input) });
        let upper = upper.map(|input| if input > start { input } else { instead(start, input) });
        is_finite.then(|| [lower, upper].map(|input| Some((input?, group))))
    }
}

/// The ends of an interval, where they exist.
type Ends<T> = [Option<T>; 2];

/// The interval about `start` in which a + b cos(k v) + c sin(k v) is not negative.
fn of_angle<T: Real>(coefficients: [T; 3], rate: T, start: T) -> Option<Ends<T>> {
    if rate.is_zero() {
        return Some([None; 2]);
    }
    let [a, b, c] = normalised(coefficients)?;
    let r = b.hypotenuse(c);
    if a >= r || r.is_zero() {
        return Some([None; 2]);
    }
    // atan2 gives the half width: acos loses digits near 0 and pi. Where links just touch, a may be less than -r.
    let sine = ((r - a) / r * ((r + a) / r)).max(T::zero()).sqrt();
    let (width, middle) = (sine.arctangent2(-a / r), angle_but_for_turns(c, b));
    let turns = ((rate * start - middle) / T::two_pi()).round() * T::two_pi();
    let ends = [middle - width + turns, middle + width + turns].map(|angle| Some(angle / rate));
    let [first, second] = ends;
    Some(if rate < T::zero() { [second, first] } else { [first, second] })
}

/// The interval about `start` in which a + b v + c v^2 is not negative.
fn of_length<T: Real>([a, b, c]: [T; 3], start: T) -> Option<Ends<T>> {
    // In a unit in which a and c are of similar magnitude, v^2 does not overflow.
    let root = |value: T| if value.is_zero() { T::one() } else { power_of_two_below(value.abs().sqrt()) };
    let unit = if a.is_zero() || c.is_zero() { T::one() } else { root(a) / root(c) };
    let [a, b, c] = normalised([a, b * unit, c * unit * unit])?;
    let half = b / real::<T>(2.0);
    if c.is_zero() {
        let end = (!b.is_zero()).then(|| -a / b * unit);
        return Some(if b > T::zero() { [end, None] } else { [None, end] });
    }
    let radicand = half * half - a * c;
    let [low, high] = if radicand > T::zero() {
        // Neither root is a difference of nearly equal numbers.
        let q = -(half + radicand.sqrt().copysign(half));
        let [one, other] = [q / c, a / q];
        if one < other { [one, other] } else { [other, one] }
    } else if c < T::zero() {
        // Links that just touch, at one input: a rounding error may make the radicand negative.
        let middle = -half / c;
        [if has_bound::<T>() { middle - instead(T::zero(), radicand).sqrt() / c } else { middle }; 2]
    } else {
        return Some([None; 2]);
    };
    let [low, high] = [low * unit, high * unit];
    Some(if c < T::zero() {
        [Some(low), Some(high)]
    } else if start - low > high - start {
        [Some(high), None]
    } else {
        [None, Some(low)]
    })
}

/// Divides coefficients by a power of two near the largest; none if one is not finite.
fn normalised<T: Real>(coefficients: [T; 3]) -> Option<[T; 3]> {
    let largest = coefficients.iter().fold(T::zero(), |most, part| if part.abs() > most { part.abs() } else { most });
    if !coefficients.iter().all(T::is_finite) {
        None
    } else if largest.is_zero() {
        Some(coefficients)
    } else {
        let unit = power_of_two_below(largest);
        Some(coefficients.map(|part| part / unit))
    }
}
