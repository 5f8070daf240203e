//! How far an input can go: the interval about a position in which a mechanism can be assembled.
//!
//! A group that depends on the input alone, or through linear equations solved before it, can be assembled where one or
//! two functions of it are not negative: a + b cos(k v) + c sin(k v) or a + b v + c v^2. Their zeros are known in closed
//! form. Groups that depend on other groups are searched: in steps, with a closer look wherever the determinant of a
//! group is smallest. An input at which a group is undetermined ([`PositionError::Undetermined`]) stops no search.

use crate::linear::power_of_two_below;
use crate::{PositionError, Real, real};

/// The inputs between which a mechanism can be assembled on one branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits<T> {
    /// Where it ends towards smaller inputs.
    pub lower: Limit<T>,
    /// Where it ends towards larger inputs.
    pub upper: Limit<T>,
}

/// An end of an interval of inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit<T> {
    /// There is none: an angle can turn all the way, a length can take any value. Where groups had to be
    /// searched, none was found within a turn, or within four times the lengths of all links together.
    Unlimited,
    /// In closed form: right to two ulp times the condition number, the sum of what a relative change of each length
    /// does to it. There the links are in line; a later group may be undetermined ([`PositionError::Undetermined`]).
    Exact {
        /// The last input at which the mechanism can be assembled.
        input: T,
        /// The unknowns of the group whose links are in line there.
        group: &'static str,
    },
    /// By search: between two inputs that are next to each other, or between which a group is undetermined. Links that
    /// miss each other by a rounding error count as in line, so the true limit lies between the two widened by three
    /// ulp times its condition number.
    Bracketed {
        /// The last input found at which the mechanism can be assembled.
        assembled: T,
        /// An input beyond at which it cannot.
        unbuildable: T,
        /// The unknowns of the group that stops it.
        group: &'static str,
    },
}

impl<T: Copy> Limit<T> {
    /// The last input at which the mechanism is known to assemble; none if there is no limit.
    pub fn input(&self) -> Option<T> {
        match *self {
            Self::Unlimited => None,
            Self::Exact { input, .. } => Some(input),
            Self::Bracketed { assembled, .. } => Some(assembled),
        }
    }
}

/// What must not be negative for a group to be assembled.
#[derive(Debug, Clone, Copy)]
pub enum Bound<T> {
    /// a + b cos(k v) + c sin(k v) of an input v, and k.
    Angle(Block, [T; 3], T),
    /// a + b v + c v^2 of an input v.
    Length(Block, [T; 3]),
}

/// A group: its place among the determinants, and its unknowns.
pub type Block = (usize, &'static str);

/// How the groups that have no [`Bound`] are searched.
#[derive(Debug, Clone, Copy)]
pub enum Search<T> {
    /// There are none.
    ClosedFormOnly,
    /// As far as a turn.
    Turn,
    /// As far as this on either side.
    Length(T),
}

/// Steps of a search, of a degree where the input is an angle that nothing else limits. A group that turns forty times as
/// fast as the input is seen at nine places of its turn; with a tenth of the steps it is not followed, twice as many
/// cost twice as much.
const STEPS: u32 = 360;

/// Narrowings of an interval: a bracket of a turn by halves, or a minimum by the golden section, to rounding.
const NARROWINGS: usize = 80;

/// The distance from a limit in closed form at which a search looks for other groups, relative to that of the start. One
/// that stops the mechanism nearer to it than this may pass for undetermined there; half of it loses digits of the positions.
const BESIDE: f64 = 1e-12;

/// Secants towards a limit: one where its closed form is right, and up to a dozen where the coefficients cancel to a
/// digit; with half as many those are not all found.
const SECANTS: usize = 16;

/// Doublings of an ulp by which a limit in closed form is drawn back to where the mechanism can be assembled: up to what a
/// thousand turns of an angle leave of its digits. Where another group stops it before, it stays.
const ULPS_INWARD: usize = 10;

/// The limits about the input `start`, at which the mechanism stands in `position`; `assemble` gives the
/// position at another input from one nearby, `determinants` those of its blocks.
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
        lower = tighter(lower, below, |new, old| new > old);
        upper = tighter(upper, above, |new, old| new < old);
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

/// The nearer of two ends.
fn tighter<T: Copy>(
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
    /// The nearest zeros on either side of an input at which the function is not negative, or by rounding just is;
    /// none if a number is not finite.
    fn about(&self, start: T) -> Option<[Option<(T, Block)>; 2]> {
        let (block, [lower, upper]) = match *self {
            Self::Angle(block, coefficients, rate) => (block, of_angle(coefficients, rate, start)?),
            Self::Length(block, coefficients) => (block, of_length(coefficients, start)?),
        };
        let is_finite = lower.into_iter().chain(upper).all(|input| input.is_finite());
        // At a limit rounding may be on either side of it.
        let lower = lower.map(|input| if input < start { input } else { start });
        let upper = upper.map(|input| if input > start { input } else { start });
        is_finite.then(|| [lower, upper].map(|input| Some((input?, block))))
    }
}

/// The end of an interval to either side, where there is one.
type Ends<T> = [Option<T>; 2];

/// The interval about `start` in which a + b cos(k v) + c sin(k v) is not negative.
fn of_angle<T: Real>(coefficients: [T; 3], rate: T, start: T) -> Option<Ends<T>> {
    if rate.is_zero() {
        return Some([None; 2]);
    }
    let [a, b, c] = of_one_size(coefficients)?;
    let r = b.hypot(c);
    if a >= r || r.is_zero() {
        return Some([None; 2]);
    }
    // The width by its tangent: a cosine says nothing near 0 and pi. Where links just touch, a may be less than -r.
    let sine = ((r - a) / r * ((r + a) / r)).max(T::zero()).sqrt();
    let (width, middle) = (sine.atan2(-a / r), c.atan2(b));
    let turns = ((rate * start - middle) / T::two_pi()).round() * T::two_pi();
    let ends = [middle - width + turns, middle + width + turns].map(|angle| Some(angle / rate));
    let [first, second] = ends;
    Some(if rate < T::zero() { [second, first] } else { [first, second] })
}

/// The interval about `start` in which a + b v + c v^2 is not negative.
fn of_length<T: Real>([a, b, c]: [T; 3], start: T) -> Option<Ends<T>> {
    // In a unit in which a and c are of one size, v^2 does not leave the range.
    let root = |value: T| if value.is_zero() { T::one() } else { power_of_two_below(value.abs().sqrt()) };
    let unit = if a.is_zero() || c.is_zero() { T::one() } else { root(a) / root(c) };
    let [a, b, c] = of_one_size([a, b * unit, c * unit * unit])?;
    let half = b / real::<T>(2.0);
    if c.is_zero() {
        let end = (!b.is_zero()).then(|| -a / b * unit);
        return Some(if b > T::zero() { [end, None] } else { [None, end] });
    }
    let radicand = half * half - a * c;
    let [low, high] = if radicand > T::zero() {
        // Neither is a difference of near numbers.
        let q = -(half + radicand.sqrt().copysign(half));
        let [one, other] = [q / c, a / q];
        if one < other { [one, other] } else { [other, one] }
    } else if c < T::zero() {
        // Links that just touch, at one input: rounding may say nowhere.
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

/// Coefficients divided by a power of two near the largest; none if one is not finite.
fn of_one_size<T: Real>(coefficients: [T; 3]) -> Option<[T; 3]> {
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

struct Searched<A, D> {
    assemble: A,
    determinants: D,
}

/// The outcome at an input.
enum Found<S> {
    /// A position.
    Assembled(S),
    /// A position that cannot be told from others: it is passed.
    Undetermined,
    /// The unknowns of a group that has no position.
    Stopped(&'static str),
}

/// A position on the way, with the magnitudes of its determinants.
struct Stop<T, P, const N: usize> {
    input: T,
    position: P,
    determinants: [T; N],
}

impl<T: Real, P, const N: usize> Stop<T, P, N> {
    /// The determinant of a block; there is one at each place that is asked for.
    fn determinant(&self, place: usize) -> T {
        self.determinants.get(place).copied().unwrap_or_else(T::zero)
    }
}

impl<A, D> Searched<A, D> {
    /// An end in closed form without the rounding errors of its coefficients, which cancel where lengths are nearly equal.
    ///
    /// The square of the determinant of its group vanishes there in proportion to the distance: a secant through its values
    /// at two inputs before the end, which are the nearer the less it moves the end. Of second order it is off by four
    /// squares of their distance, relative to that of the next zero: at `NEAREST` that is nothing, and three digits of the
    /// distance are left, of which an end that is this near needs one.
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
        // Where a later group coincides, the links are in line to rounding: there is nothing to correct.
        if matches!(self.at(position, end)?, Found::Undetermined) {
            return Ok(end);
        }
        let (mut input, mut exponent) = (end, NEAREST);
        for _ in 0..SECANTS {
            let step = (start - end) * real::<T>(2.0).powi(-exponent);
            let (near, far) = (input + step, input + step * real::<T>(4.0));
            let mut by = None;
            if let (Found::Assembled(one), Found::Assembled(other)) =
                (self.at(position, near)?, self.at(position, far)?)
            {
                let ratio = one.determinant(place) / other.determinant(place);
                let part = ratio * ratio;
                let secant = ((near - input) - part * (far - input)) / (T::one() - part);
                // From farther away the two determinants differ by too few digits.
                by = (secant.abs() <= step.abs() * real::<T>(1000.0)).then_some(secant);
            }
            match by {
                Some(by) => {
                    input += by;
                    if by.abs() > step.abs() {
                        continue;
                    }
                    if exponent == NEAREST {
                        // Where nothing cancels the closed form is right to the last digit.
                        let is_right = (input - end).abs() <= real::<T>(2.0) * T::default_epsilon() * end.abs();
                        return Ok(if is_right { end } else { input });
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

    /// The last input at which no group stops the mechanism, next to a limit that is rounded.
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

    /// The first limit on the way to one that is known, or to `beyond` if none is.
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
        let step = (end - start) / real::<T>(f64::from(STEPS));
        let mut last: [Option<Stop<T, P, N>>; 2] = [None, None];
        for index in 1..=STEPS {
            let input = if index == STEPS { end } else { start + step * real::<T>(f64::from(index)) };
            let [before, here] = &last;
            let (from, at) = here.as_ref().map_or((position, start), |here| (&here.position, here.input));
            let there = match self.at(from, input)? {
                Found::Assembled(there) => there,
                Found::Undetermined if index < STEPS => continue,
                Found::Stopped(group)
                    if index < STEPS || !matches!(known, Limit::Exact { group: other, .. } if other == group) =>
                {
                    return self.between(from, at, input, group);
                }
                _ => {
                    // On a limit in closed form, where rounding may be on either side and a later group undetermined, the
                    // inputs next to it tell whether another group stops before.
                    let inside = end + (start - end) * real::<T>(BESIDE);
                    return match self.at(from, inside)? {
                        Found::Stopped(group) => self.between(from, at, inside, group),
                        _ => Ok(known),
                    };
                }
            };
            if let (Some(before), Some(here)) = (before, here) {
                let determinants = before.determinants.iter().zip(&here.determinants).zip(&there.determinants);
                for (block, ((a, b), c)) in determinants.enumerate() {
                    if b < a
                        && b <= c
                        && let Some(limit) = self.lowest(before, there.input, block)?
                    {
                        return Ok(limit);
                    }
                }
            }
            let [_, here] = last;
            last = [here, Some(there)];
        }
        Ok(known)
    }

    /// The position at an input, or the group that stops it.
    fn at<T: Real, P, const N: usize>(&self, from: &P, input: T) -> Result<Found<Stop<T, P, N>>, PositionError>
    where
        A: Fn(&P, T) -> Result<P, PositionError>,
        D: Fn(&P) -> [T; N],
    {
        match (self.assemble)(from, input) {
            Ok(position) => {
                let determinants = (self.determinants)(&position).map(|determinant| determinant.abs());
                Ok(Found::Assembled(Stop { input, position, determinants }))
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

    /// The limit between an input at which the mechanism assembles and one at which a group does not.
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
        let mut nearest: Option<Stop<T, P, N>> = None;
        for _ in 0..NARROWINGS {
            let mut middle = assembled + (unbuildable - assembled) / real::<T>(2.0);
            if middle == assembled || middle == unbuildable {
                break;
            }
            let from = nearest.as_ref().map_or(from, |stop| &stop.position);
            let mut found = self.at(from, middle)?;
            if matches!(found, Found::Undetermined) {
                // Most often at this input alone: one nearer by says on which side of it the limit lies.
                middle = assembled + (middle - assembled) / real::<T>(2.0);
                found = self.at(from, middle)?;
            }
            match found {
                Found::Assembled(stop) => (assembled, nearest) = (middle, Some(stop)),
                Found::Stopped(other) => (unbuildable, group) = (middle, other),
                Found::Undetermined => break,
            }
        }
        Ok(Limit::Bracketed { assembled, unbuildable, group })
    }

    /// A limit where the determinant of a block is smallest between two positions, if it cannot be assembled
    /// there.
    fn lowest<T: Real, P, const N: usize>(
        &self,
        from: &Stop<T, P, N>,
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
                Found::Assembled(stop) => Ok(stop.determinant(block)),
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
