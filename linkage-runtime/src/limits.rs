//! Limits of an input: the interval about a position in which a mechanism can be assembled.
//!
//! A group has a position where one or two functions are not negative, such as (p + q)^2 - D^2 for two links p and q
//! whose outer joints are D apart. If the group depends on the input v alone, or through linear equations solved before
//! it, they are of the form a + b cos(k v) + c sin(k v) or a + b v + c v^2, whose zeros have a closed form. Groups that
//! depend on other groups are searched in steps, refined wherever the determinant of a group has a minimum. A search
//! skips inputs at which a group is undetermined ([`PositionError::Undetermined`]).

use crate::linear::power_of_two_below;
use crate::{PositionError, Real, real};

/// The inputs between which a mechanism can be assembled on one branch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Limits<T> {
    /// The end towards smaller inputs.
    pub lower: Limit<T>,
    /// The end towards larger inputs.
    pub upper: Limit<T>,
}

/// An end of an interval of inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Limit<T> {
    /// No limit: an angle can turn fully, a length can have any value. If groups were searched, no limit was found
    /// within a turn, or within four times the sum of the lengths of all links.
    Unlimited,
    /// A limit v in closed form, accurate to two ulp times its condition number, 1 + the sum of |(l / v) dv/dl| over
    /// the lengths l. The links are in line there; a later group may be undetermined
    /// ([`PositionError::Undetermined`]).
    Exact {
        /// The last input at which the mechanism can be assembled.
        input: T,
        /// The unknowns of the group whose links are in line there.
        group: &'static str,
    },
    /// A limit found by search, between two neighbouring inputs, or between two inputs where a group is undetermined.
    /// Links that miss each other by a rounding error count as in line, so the true limit lies between the two inputs,
    /// widened by three ulp times its condition number.
    Bracketed {
        /// The last input found at which the mechanism can be assembled.
        assembled: T,
        /// An input beyond the limit at which it cannot.
        unbuildable: T,
        /// The unknowns of the group that cannot be assembled beyond the limit.
        group: &'static str,
    },
}

impl<T: Copy> Limit<T> {
    /// Returns the last input at which the mechanism is known to assemble; none if there is no limit.
    pub fn input(&self) -> Option<T> {
        match *self {
            Self::Unlimited => None,
            Self::Exact { input, .. } => Some(input),
            Self::Bracketed { assembled, .. } => Some(assembled),
        }
    }
}

/// A function of an input that is not negative where a group can be assembled.
#[derive(Debug, Clone, Copy)]
pub enum Bound<T> {
    /// a + b cos(k v) + c sin(k v) of an input v: a, b and c, then k.
    Angle(Block, [T; 3], T),
    /// a + b v + c v^2 of an input v.
    Length(Block, [T; 3]),
}

/// A group: its index among the determinants, and its unknowns.
pub type Block = (usize, &'static str);

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

/// Steps of a search, one degree each for an angle without other limits. A group that turns forty times as fast as the
/// input is then sampled nine times in its turn. With a tenth of the steps its limits are missed; twice as many take
/// twice the time.
const STEPS: u32 = 360;

/// The parts of the first step and of the last one.
const PARTS: u32 = 8;

/// The distance from an end of a step at which a determinant falls or rises, divided by the step.
const BESIDE: f64 = 1e-3;

/// The most steps that narrow an interval to rounding error: about 55 by bisection, about 77 by golden section.
const NARROWINGS: usize = 80;

/// The distance from a limit in closed form at which other groups are tested, divided by the distance from `start` to
/// the limit. A group that stops the mechanism nearer to the limit than this may be missed; at half the distance
/// positions lose digits.
const INSET: f64 = 1e-12;

/// The most secant steps towards a limit: one is enough where its closed form is accurate, a dozen where cancellation
/// leaves one digit of the coefficients. With half as many, some of the latter are not found.
const SECANTS: usize = 16;

/// The most steps, of one ulp, two, four and so on, by which a limit in closed form is moved inward until the mechanism
/// can be assembled: enough for the digits that an angle loses in a thousand turns. If that is not enough, another
/// group stops the mechanism before, and the limit is not moved.
const ULPS_INWARD: usize = 10;

/// Computes the limits about the input `start` of `position`. `assemble` computes the position at an input from one
/// nearby, `determinants` the determinants of the blocks of a position.
///
/// # Errors
/// [`PositionError::NotFinite`] if a number is not finite.
pub fn limits<T: Real, P, const B: usize, const N: usize>(
    mechanism: &'static str,
    start: T,
    position: P,
    bounds: [Bound<T>; B],
    search: Search<T>,
    assemble: impl Fn(&P, T) -> Result<P, PositionError>,
    determinants: impl Fn(&P) -> [T; N],
) -> Result<Limits<T>, PositionError> {
    let [mut lower, mut upper] = [None; 2];
    for bound in &bounds {
        let [below, above] = bound.about(start).ok_or(PositionError::NotFinite { mechanism, quantity: "a limit" })?;
        lower = nearer(lower, below, |new, old| new > old);
        upper = nearer(upper, above, |new, old| new < old);
    }
    let searched = Searched { assemble, determinants };
    let exact = |end: Option<(T, Block)>| -> Result<Limit<T>, PositionError> {
        let Some((end, (place, group))) = end else { return Ok(Limit::Unlimited) };
        let input = searched.corrected(start, &position, end, place)?;
        Ok(Limit::Exact { input: searched.last(start, &position, input)?, group })
    };
    let (lower, upper) = (exact(lower)?, exact(upper)?);
    let reach = match search {
        Search::ClosedFormOnly => return Ok(Limits { lower, upper }),
        Search::Turn => T::two_pi(),
        Search::Length(reach) => reach,
    };
    Ok(Limits {
        lower: searched.toward(start, &position, lower, start - reach)?,
        upper: searched.toward(start, &position, upper, start + reach)?,
    })
}

/// The end nearer to the start, of two that may not exist.
fn nearer<T: Copy>(
    known: Option<(T, Block)>,
    new: Option<(T, Block)>,
    is_nearer: fn(&T, &T) -> bool,
) -> Option<(T, Block)> {
    match (known, new) {
        (Some((old, _)), Some((input, _))) if !is_nearer(&input, &old) => known,
        (_, Some(_)) => new,
        _ => known,
    }
}

impl<T: Real> Bound<T> {
    /// The nearest zeros on either side of `start`, where the function is not negative up to rounding error; none if a
    /// number is not finite. With one negative length of two both functions of a group have the other sign.
    fn about(&self, start: T) -> Option<[Option<(T, Block)>; 2]> {
        let with_sign = |coefficients: [T; 3], terms: [T; 3]| {
            let least = terms.iter().fold(T::zero(), |sum, term| sum + term.abs()) * T::default_epsilon().sqrt();
            if terms[0] + terms[1] + terms[2] < -least { coefficients.map(|part| -part) } else { coefficients }
        };
        let (block, [lower, upper]) = match *self {
            Self::Angle(block, [a, b, c], rate) => {
                let (sine, cosine) = (rate * start).sine_cosine();
                (block, of_angle(with_sign([a, b, c], [a, b * cosine, c * sine]), rate, start)?)
            }
            Self::Length(block, [a, b, c]) => {
                (block, of_length(with_sign([a, b, c], [a, b * start, c * start * start]), start)?)
            }
        };
        let is_finite = lower.into_iter().chain(upper).all(|input| input.is_finite());
        // At a limit a rounding error may put the zero on the other side of `start`.
        let lower = lower.map(|input| if input < start { input } else { start });
        let upper = upper.map(|input| if input > start { input } else { start });
        is_finite.then(|| [lower, upper].map(|input| Some((input?, block))))
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
    let r = b.hypot(c);
    if a >= r || r.is_zero() {
        return Some([None; 2]);
    }
    // atan2 gives the half width: acos loses digits near 0 and pi. Where links just touch, a may be less than -r.
    let sine = ((r - a) / r * ((r + a) / r)).max(T::zero()).sqrt();
    let (width, middle) = (sine.atan2(-a / r), c.atan2(b));
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
        [-half / c; 2]
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

/// The functions of a mechanism that a search calls.
struct Searched<A, D> {
    assemble: A,
    determinants: D,
}

/// The outcome at an input.
enum Found<S> {
    /// A position.
    Assembled(S),
    /// A group is undetermined here: the search skips the input.
    Undetermined,
    /// A group has no position: its unknowns.
    Stopped(&'static str),
}

/// A position evaluated by the search, with the magnitudes of the determinants of its blocks.
struct Sample<T, P, const N: usize> {
    input: T,
    position: P,
    determinants: [T; N],
}

impl<T: Real, P, const N: usize> Sample<T, P, N> {
    /// The determinant of a block; zero for an invalid index.
    fn determinant(&self, place: usize) -> T {
        self.determinants.get(place).copied().unwrap_or_else(T::zero)
    }
}

impl<A, D> Searched<A, D> {
    /// Corrects a limit in closed form for the rounding errors of its coefficients, which cancel where lengths are
    /// nearly equal.
    ///
    /// Near the limit the square of the determinant of the group is proportional to the distance from it. The zero is
    /// found by the secant through its values at the distances x and 4 x before the limit, where x is 2^-exponent of
    /// the distance from `start`; the exponent grows as the corrections become smaller. If the next zero is at the
    /// distance X beyond the limit, the error of the secant is 4 x^2 / X: at the exponent `NEAREST` it is negligible,
    /// while x, the difference of two inputs, still has three correct digits.
    fn corrected<T: Real, P, const N: usize>(
        &self,
        start: T,
        position: &P,
        end: T,
        place: usize,
    ) -> Result<T, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        const NEAREST: i32 = 40;
        // If a later group is undetermined, the links are in line up to rounding error: the limit needs no correction.
        if matches!(self.at(position, end)?, Found::Undetermined) {
            return Ok(end);
        }
        let (mut input, mut exponent) = (end, NEAREST);
        for _ in 0..SECANTS {
            let step = (start - end) * real::<T>(2.0).powi(-exponent);
            let (near, far) = (input + step, input + step * real::<T>(4.0));
            let mut correction = None;
            if let (Found::Assembled(one), Found::Assembled(other)) =
                (self.at(position, near)?, self.at(position, far)?)
            {
                let ratio = one.determinant(place) / other.determinant(place);
                let part = ratio * ratio;
                let secant = ((near - input) - part * (far - input)) / (T::one() - part);
                // From farther away the two determinants differ in too few digits.
                correction = (secant.abs() <= step.abs() * real::<T>(1000.0)).then_some(secant);
            }
            match correction {
                Some(correction) => {
                    input += correction;
                    if correction.abs() > step.abs() {
                        continue;
                    }
                    if exponent == NEAREST {
                        // Without cancellation the closed form is accurate to the last digit.
                        let is_accurate = (input - end).abs() <= real::<T>(2.0) * T::default_epsilon() * end.abs();
                        return Ok(if is_accurate { end } else { input });
                    }
                    exponent += 8;
                }
                None if exponent > 12 => exponent -= 8,
                None => break,
            }
        }
        // Another group stops the mechanism before.
        Ok(end)
    }

    /// Moves a limit, which rounding error may have put outside, inward to an input at which no group stops the
    /// mechanism.
    fn last<T: Real, P, const N: usize>(&self, start: T, position: &P, end: T) -> Result<T, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        let mut input = end;
        let mut step = T::default_epsilon() * end.abs();
        for _ in 0..ULPS_INWARD {
            if (start - input).abs() <= step || !matches!(self.at(position, input)?, Found::Stopped(_)) {
                return Ok(input);
            }
            input += if start < end { -step } else { step };
            step += step;
        }
        Ok(end)
    }

    /// Searches for the first limit between `start` and a known limit, or `beyond` if there is none.
    fn toward<T: Real, P, const N: usize>(
        &self,
        start: T,
        position: &P,
        known: Limit<T>,
        beyond: T,
    ) -> Result<Limit<T>, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        let end = known.input().unwrap_or(beyond);
        // The first step and the last one are divided: the minima next to their ends have no neighbours beyond.
        let whole = f64::from(STEPS);
        let parts = |step: f64| (1..=PARTS).map(move |part| step + f64::from(part) / f64::from(PARTS));
        let places = parts(0.0).chain((2..STEPS).map(f64::from)).chain(parts(whole - 1.0));
        let mut last: [Option<Sample<T, P, N>>; 2] = [None, None];
        if let Found::Assembled(sample) = self.at(position, start)? {
            last[1] = Some(sample);
        }
        for place in places {
            let is_last = place >= whole;
            let input = if is_last { end } else { start + (end - start) * real::<T>(place / whole) };
            let (from, at) = last[1].as_ref().map_or((position, start), |here| (&here.position, here.input));
            let there = match self.at(from, input)? {
                Found::Assembled(there) => there,
                Found::Undetermined if !is_last => continue,
                Found::Stopped(group)
                    if !is_last || !matches!(known, Limit::Exact { group: other, .. } if other == group) =>
                {
                    return self.between(from, at, input, group);
                }
                _ => {
                    // At a limit in closed form the mechanism may not assemble because of rounding errors, or a later
                    // group may be undetermined; an input just inside shows whether another group stops the mechanism
                    // before.
                    let inside = end + (start - end) * real::<T>(INSET);
                    match self.at(from, inside)? {
                        Found::Stopped(group) => return self.between(from, at, inside, group),
                        Found::Undetermined => return Ok(known),
                        Found::Assembled(inside) => inside,
                    }
                }
            };
            let found = match &last {
                [Some(before), Some(here)] => self.limit_among([before, here, &there])?,
                [None, Some(here)] => self.limit_within(here, &there)?,
                _ => None,
            };
            if let Some(limit) = found {
                return Ok(limit);
            }
            if let ([_, Some(here)], true) = (&last, is_last)
                && let Some(limit) = self.limit_within(here, &there)?
            {
                return Ok(limit);
            }
            let [_, here] = last;
            last = [here, Some(there)];
        }
        Ok(known)
    }

    /// The limit at a minimum of a determinant between two samples: it falls at the first and rises at the second.
    fn limit_within<T: Real, P, const N: usize>(
        &self,
        here: &Sample<T, P, N>,
        there: &Sample<T, P, N>,
    ) -> Result<Option<Limit<T>>, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        let little = (there.input - here.input) * real::<T>(BESIDE);
        let inside = [here.input + little, there.input - little];
        let [after, before] = [self.at(&here.position, inside[0])?, self.at(&here.position, inside[1])?];
        let (after, before) = match (after, before) {
            (Found::Assembled(after), Found::Assembled(before)) => (after, before),
            (Found::Stopped(group), _) => return self.between(&here.position, here.input, inside[0], group).map(Some),
            (_, Found::Stopped(group)) => return self.between(&here.position, here.input, inside[1], group).map(Some),
            _ => return Ok(None),
        };
        for block in 0..N {
            let falls = after.determinant(block) < here.determinant(block);
            let rises = before.determinant(block) < there.determinant(block);
            if falls
                && rises
                && let Some(limit) = self.limit_at_minimum(here, there.input, block)?
            {
                return Ok(Some(limit));
            }
        }
        Ok(None)
    }

    /// The limit at a minimum of a determinant about the middle one of three samples, if the mechanism cannot be assembled
    /// there.
    fn limit_among<T: Real, P, const N: usize>(
        &self,
        [before, here, there]: [&Sample<T, P, N>; 3],
    ) -> Result<Option<Limit<T>>, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        let determinants = before.determinants.iter().zip(&here.determinants).zip(&there.determinants);
        for (block, ((a, b), c)) in determinants.enumerate() {
            if b < a
                && b <= c
                && let Some(limit) = self.limit_at_minimum(before, there.input, block)?
            {
                return Ok(Some(limit));
            }
        }
        Ok(None)
    }

    /// Computes the position at an input, or finds the group that stops it.
    fn at<T: Real, P, const N: usize>(&self, from: &P, input: T) -> Result<Found<Sample<T, P, N>>, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        match (self.assemble)(from, input) {
            Ok(position) => {
                let determinants = (self.determinants)(&position).map(|determinant| determinant.abs());
                Ok(Found::Assembled(Sample { input, position, determinants }))
            }
            Err(
                PositionError::Unbuildable { group, .. }
                | PositionError::Singular { group, .. }
                | PositionError::OtherBranch { group, .. }
                | PositionError::NotConverged { group: Some(group), .. },
            ) => Ok(Found::Stopped(group)),
            Err(PositionError::Undetermined { .. }) => Ok(Found::Undetermined),
            Err(error) => Err(error),
        }
    }

    /// Bisects between an input at which the mechanism assembles and one at which a group does not.
    fn between<T: Real, P, const N: usize>(
        &self,
        from: &P,
        mut assembled: T,
        mut unbuildable: T,
        mut group: &'static str,
    ) -> Result<Limit<T>, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        let mut nearest: Option<Sample<T, P, N>> = None;
        for _ in 0..NARROWINGS {
            let mut middle = assembled + (unbuildable - assembled) / real::<T>(2.0);
            if middle == assembled || middle == unbuildable {
                break;
            }
            let from = nearest.as_ref().map_or(from, |sample| &sample.position);
            let mut found = self.at(from, middle)?;
            if matches!(found, Found::Undetermined) {
                // Usually only this input is undetermined: one nearby shows on which side of it the limit lies.
                middle = assembled + (middle - assembled) / real::<T>(2.0);
                found = self.at(from, middle)?;
            }
            match found {
                Found::Assembled(sample) => (assembled, nearest) = (middle, Some(sample)),
                Found::Stopped(other) => (unbuildable, group) = (middle, other),
                Found::Undetermined => break,
            }
        }
        Ok(Limit::Bracketed { assembled, unbuildable, group })
    }

    /// Minimises the determinant of a block between two inputs, and returns the limit if the mechanism cannot be
    /// assembled at the minimum.
    fn limit_at_minimum<T: Real, P, const N: usize>(
        &self,
        from: &Sample<T, P, N>,
        to: T,
        block: usize,
    ) -> Result<Option<Limit<T>>, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        let golden = real::<T>(0.618_033_988_749_894_9);
        let (mut a, mut b) = (from.input, to);
        let look = |input: T| -> Result<Result<T, Limit<T>>, PositionError> {
            Ok(match self.at(&from.position, input)? {
                Found::Assembled(sample) => Ok(sample.determinant(block)),
                Found::Undetermined => Ok(T::zero()),
                Found::Stopped(group) => Err(self.between(&from.position, from.input, input, group)?),
            })
        };
        for _ in 0..NARROWINGS {
            let width = (b - a) * golden;
            let (low, high) = (b - width, a + width);
            if low == high || low == a || high == b {
                break;
            }
            match (look(low)?, look(high)?) {
                (Err(limit), _) | (_, Err(limit)) => return Ok(Some(limit)),
                (Ok(left), Ok(right)) if left <= right => b = high,
                _ => a = low,
            }
        }
        Ok(None)
    }
}
