//! How far an input can go: the interval about a position in which a mechanism can be assembled.
//!
//! A group that stands on the input alone can be assembled where one or two functions of it are not
//! negative: of an angle v, a + b cos(v) + c sin(v), of a length a + b v + c v^2. Their zeros are known in
//! closed form. Groups that stand on other groups are searched: in steps, with a closer look wherever the
//! determinant of a group is smallest.

use crate::{Error, Real, real};

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
    None,
    /// In closed form.
    Exact {
        /// The last input at which the mechanism can be assembled.
        input: T,
        /// The unknowns of the group whose links are in line there.
        group: &'static str,
    },
    /// By search: between two inputs that are next to each other.
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
            Self::None => None,
            Self::Exact { input, .. } => Some(input),
            Self::Bracketed { assembled, .. } => Some(assembled),
        }
    }
}

/// What must not be negative for a group to be assembled.
#[derive(Debug, Clone, Copy)]
pub enum Bound<T> {
    /// a + b cos(v) + c sin(v) of an angle v.
    Angle(&'static str, [T; 3]),
    /// a + b v + c v^2 of a length v.
    Length(&'static str, [T; 3]),
}

/// How the groups that have no [`Bound`] are searched.
#[derive(Debug, Clone, Copy)]
pub enum Search<T> {
    /// There are none.
    Nothing,
    /// As far as a turn.
    Turn,
    /// As far as this on either side.
    Length(T),
}

/// Steps of a search.
const STEPS: u32 = 360;

/// Narrowings of an interval: a bracket of a turn by halves, or a minimum by the golden section, to rounding.
const NARROWINGS: usize = 80;

/// The limits about the input `start`, at which the mechanism stands in `position`; `assemble` gives the
/// position at another input from one nearby, `determinants` those of its blocks.
///
/// # Errors
/// [`Error::NotFinite`] if a number is not finite.
pub fn limits<T: Real, P, const B: usize, const N: usize>(
    start: T,
    position: P,
    bounds: [Bound<T>; B],
    search: Search<T>,
    assemble: impl Fn(&P, T) -> Result<P, Error>,
    determinants: impl Fn(&P) -> [T; N],
) -> Result<Limits<T>, Error> {
    let [mut lower, mut upper] = [Limit::None; 2];
    for bound in &bounds {
        let [below, above] = bound.about(start);
        lower = tighter(lower, below, |new, old| new > old);
        upper = tighter(upper, above, |new, old| new < old);
    }
    let reach = match search {
        Search::Nothing => return Ok(Limits { lower, upper }),
        Search::Turn => T::two_pi(),
        Search::Length(reach) => reach,
    };
    let searched = Searched { assemble, determinants };
    Ok(Limits {
        lower: searched.toward(start, &position, lower, start - reach)?,
        upper: searched.toward(start, &position, upper, start + reach)?,
    })
}

fn tighter<T: Copy>(known: Limit<T>, new: Limit<T>, is_nearer: fn(&T, &T) -> bool) -> Limit<T> {
    match (known.input(), new.input()) {
        (Some(old), Some(input)) if !is_nearer(&input, &old) => known,
        (_, Some(_)) => new,
        _ => known,
    }
}

impl<T: Real> Bound<T> {
    /// The nearest zeros on either side of an input at which the function is not negative.
    fn about(&self, start: T) -> [Limit<T>; 2] {
        match *self {
            Self::Angle(group, [a, b, c]) => {
                let r = b.hypot(c);
                if a >= r {
                    return [Limit::None; 2];
                }
                // The width by its tangent: a cosine says nothing near 0 and pi.
                let sine = ((r - a) / r * ((r + a) / r)).max(T::zero()).sqrt();
                let width = sine.atan2(-a / r);
                let turned = start - c.atan2(b);
                let turned = turned - (turned / T::two_pi()).round() * T::two_pi();
                // At a limit rounding may be on either side of it.
                let (below, above) = ((width + turned).max(T::zero()), (width - turned).max(T::zero()));
                [start - below, start + above].map(|input| Limit::Exact { input, group })
            }
            Self::Length(group, [a, b, c]) => {
                let mut limits = [Limit::None; 2];
                for zero in zeros(a, b, c).into_iter().flatten() {
                    let input = Limit::Exact { input: zero, group };
                    if zero <= start {
                        limits[0] = tighter(limits[0], input, |new, old| new > old);
                    } else {
                        limits[1] = tighter(limits[1], input, |new, old| new < old);
                    }
                }
                limits
            }
        }
    }
}

/// The real zeros of a + b v + c v^2; neither is a difference of near numbers.
fn zeros<T: Real>(a: T, b: T, c: T) -> [Option<T>; 2] {
    if c.is_zero() {
        return [(!b.is_zero()).then(|| -a / b), None];
    }
    let half = b / real::<T>(2.0);
    let radicand = half * half - a * c;
    if radicand < T::zero() {
        return [None; 2];
    }
    let q = -(half + radicand.sqrt().copysign(half));
    if q.is_zero() { [Some(T::zero()), None] } else { [Some(q / c), Some(a / q)] }
}

struct Searched<A, D> {
    assemble: A,
    determinants: D,
}

/// A position on the way, with the magnitudes of its determinants.
struct Stop<T, P, const N: usize> {
    input: T,
    position: P,
    determinants: [T; N],
}

impl<A, D> Searched<A, D> {
    /// The first limit on the way to one that is known, or to `beyond` if none is.
    fn toward<T: Real, P, const N: usize>(
        &self,
        start: T,
        position: &P,
        known: Limit<T>,
        beyond: T,
    ) -> Result<Limit<T>, Error>
    where
        A: Fn(&P, T) -> Result<P, Error>,
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
                Ok(there) => there,
                Err(group) => {
                    // On a limit in closed form rounding may be on either side of it.
                    let is_known =
                        index == STEPS && matches!(known, Limit::Exact { group: other, .. } if other == group);
                    return if is_known { Ok(known) } else { self.between(from, at, input, group) };
                }
            };
            if let (Some(before), Some(here)) = (before, here) {
                for block in 0..N {
                    let [a, b, c] = [before, here, &there].map(|stop| stop.determinants[block]);
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
    fn at<T: Real, P, const N: usize>(&self, from: &P, input: T) -> Result<Result<Stop<T, P, N>, &'static str>, Error>
    where
        A: Fn(&P, T) -> Result<P, Error>,
        D: Fn(&P) -> [T; N],
    {
        match (self.assemble)(from, input) {
            Ok(position) => {
                let determinants = (self.determinants)(&position).map(|determinant| determinant.abs());
                Ok(Ok(Stop { input, position, determinants }))
            }
            Err(
                Error::Unbuildable { group, .. }
                | Error::Singular { group, .. }
                | Error::OtherBranch { group, .. }
                | Error::NotConverged { group: Some(group), .. },
            ) => Ok(Err(group)),
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
    ) -> Result<Limit<T>, Error>
    where
        A: Fn(&P, T) -> Result<P, Error>,
        D: Fn(&P) -> [T; N],
    {
        let mut nearest: Option<Stop<T, P, N>> = None;
        for _ in 0..NARROWINGS {
            let middle = assembled + (unbuildable - assembled) / real::<T>(2.0);
            if middle == assembled || middle == unbuildable {
                break;
            }
            match self.at(nearest.as_ref().map_or(from, |stop| &stop.position), middle)? {
                Ok(stop) => (assembled, nearest) = (middle, Some(stop)),
                Err(other) => (unbuildable, group) = (middle, other),
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
    ) -> Result<Option<Limit<T>>, Error>
    where
        A: Fn(&P, T) -> Result<P, Error>,
        D: Fn(&P) -> [T; N],
    {
        let golden = real::<T>(0.618_033_988_749_894_9);
        let (mut a, mut b) = (from.input, to);
        let look = |input: T| -> Result<Result<T, Limit<T>>, Error> {
            Ok(match self.at(&from.position, input)? {
                Ok(stop) => Ok(stop.determinants[block]),
                Err(group) => Err(self.between(&from.position, from.input, input, group)?),
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
