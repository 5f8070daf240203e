//! The search for limits in steps, and the correction of limits in closed form.
//!
//! A gap between two inputs shows as a minimum of the determinant of a group, which is zero at its edges: about each sample
//! that is lower than both its neighbours the minimum is searched, and in the first step and the last one, which are
//! divided, between two samples where the determinant falls and rises.

use super::limit::Limit;
use super::searched::{Found, LimitOf, Sample, Searched};
use super::walk::{Stuck, Walked};
use crate::scalar::arithmetic::*;
use crate::{Dim, Mechanism, PositionError, PositionErrorOf, real};

/// Steps of a search, one degree each for an angle without other limits. A group that turns forty times as fast as the
/// input is then sampled nine times in its turn. With a tenth of the steps its limits are missed; twice as many take
/// twice the time.
pub(super) const STEPS: u32 = 360;

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

/// Two inputs between which a group stops the mechanism.
struct Bracket<M: Mechanism> {
    assembled: M::Scalar,
    unbuildable: M::Scalar,
    group: M::Name,
}

/// The outcome of a step from one input to another.
enum Reached<M: Mechanism> {
    /// The position at the input.
    Assembled(Sample<M>),
    /// A group is undetermined there.
    Undetermined,
    /// Motions touch next to it.
    Touch,
    /// The mechanism stops before.
    Limit(Limit<M::Scalar, M::Name>),
}

impl<M: Mechanism> Searched<'_, M> {
    /// Corrects a limit in closed form for the rounding errors of its coefficients, which cancel where lengths are
    /// nearly equal.
    ///
    /// Near the limit the square of the determinant of the group is proportional to the distance from it. The zero is
    /// found by the secant through its values at the distances x and 4 x before the limit, where x is 2^-exponent of
    /// the distance from `start`; the exponent grows as the corrections become smaller. If the next zero is at the
    /// distance X beyond the limit, the error of the secant is 4 x^2 / X: at the exponent `NEAREST` it is negligible,
    /// while x, the difference of two inputs, still has three correct digits.
    pub(super) fn corrected(
        &self,
        start: M::Scalar,
        position: &M::Coordinates,
        end: M::Scalar,
        place: usize,
    ) -> Result<M::Scalar, PositionErrorOf<M>> {
        const NEAREST: i32 = 40;
        // If a later group is undetermined, the links are in line up to rounding error: the limit needs no correction.
        if matches!(self.at(position, end)?, Found::Undetermined) {
            return Ok(end);
        }
        let (mut input, mut exponent) = (end, NEAREST);
        for _ in 0..SECANTS {
            let step = (start - end) * real::<M::Scalar>(2.0).powi(-exponent);
            let (near, far) = (input + step, input + step * real::<M::Scalar>(4.0));
            let mut correction = None;
            if let (Found::Assembled(one), Found::Assembled(other)) =
                (self.at(position, near)?, self.at(position, far)?)
            {
                let ratio = one.determinant(place) / other.determinant(place);
                let part = ratio * ratio;
                let secant = ((near - input) - part * (far - input)) / (M::Scalar::one() - part);
                // From farther away the two determinants differ in too few digits.
                correction = (secant.abs() <= step.abs() * real::<M::Scalar>(1000.0)).then_some(secant);
            }
            match correction {
                Some(correction) => {
                    input += correction;
                    if correction.abs() > step.abs() {
                        continue;
                    }
                    if exponent == NEAREST {
                        // Without cancellation the closed form is accurate to the last digit.
                        let is_accurate =
                            (input - end).abs() <= real::<M::Scalar>(2.0) * M::Scalar::default_epsilon() * end.abs();
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
    pub(super) fn last(
        &self,
        start: M::Scalar,
        position: &M::Coordinates,
        end: M::Scalar,
    ) -> Result<M::Scalar, PositionErrorOf<M>> {
        let mut input = end;
        let mut step = M::Scalar::default_epsilon() * end.abs();
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
    pub(super) fn toward(
        &self,
        start: M::Scalar,
        position: &M::Coordinates,
        known: Limit<M::Scalar, M::Name>,
        beyond: M::Scalar,
    ) -> Result<Limit<M::Scalar, M::Name>, PositionErrorOf<M>> {
        let end = known.input().unwrap_or(beyond);
        // The first step and the last one are divided: the minima next to their ends have no neighbours beyond.
        let whole = f64::from(STEPS);
        let parts = |step: f64| (1..=PARTS).map(move |part| step + f64::from(part) / f64::from(PARTS));
        let places = parts(0.0).chain((2..STEPS).map(f64::from)).chain(parts(whole - 1.0));
        let mut last: [Option<Sample<M>>; 2] = [None, None];
        if let Found::Assembled(sample) = self.at(position, start)? {
            last[1] = Some(sample);
        }
        for place in places {
            let is_last = place >= whole;
            let input = if is_last { end } else { start + (end - start) * real::<M::Scalar>(place / whole) };
            let (from, at) = last[1].as_ref().map_or((position, start), |here| (&here.position, here.input));
            let is_known = |found: &Found<M>| match (found, known) {
                (Found::Undetermined, _) => true,
                (Found::Stopped(group), Limit::Exact { group: other, .. }) => *group == other,
                _ => false,
            };
            let reached = match self.at(from, input)? {
                found if is_last && is_known(&found) => {
                    // At a limit in closed form the mechanism may not assemble because of rounding errors, or a later
                    // group may be undetermined; an input just inside shows whether another group stops the mechanism
                    // before.
                    self.reach(from, at, end + (start - end) * real::<M::Scalar>(INSET))?
                }
                found => self.follow(from, at, input, found)?,
            };
            let there = match reached {
                Reached::Assembled(there) => there,
                Reached::Undetermined | Reached::Touch if is_last => return Ok(known),
                Reached::Undetermined | Reached::Touch => continue,
                Reached::Limit(limit) => return Ok(limit),
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
    fn limit_within(&self, here: &Sample<M>, there: &Sample<M>) -> Result<Option<LimitOf<M>>, PositionErrorOf<M>> {
        let little = (there.input - here.input) * real::<M::Scalar>(BESIDE);
        let inside = [here.input + little, there.input - little];
        let [mut after, mut before] = [None, None];
        for (beside, input) in [&mut after, &mut before].into_iter().zip(inside) {
            *beside = match self.reach(&here.position, here.input, input)? {
                Reached::Assembled(beside) => Some(beside),
                Reached::Undetermined | Reached::Touch => None,
                Reached::Limit(limit) => return Ok(Some(limit)),
            };
        }
        let (Some(after), Some(before)) = (after, before) else { return Ok(None) };
        for group in 0..self.mechanism.dims().2.count() {
            let falls = after.determinant(group) < here.determinant(group);
            let rises = before.determinant(group) < there.determinant(group);
            if falls
                && rises
                && let Some(limit) = self.limit_at_minimum(here, there.input, group)?
            {
                return Ok(Some(limit));
            }
        }
        Ok(None)
    }

    /// The limit at a minimum of a determinant about the middle one of three samples, if the mechanism cannot be assembled
    /// there.
    fn limit_among(&self, [before, here, there]: [&Sample<M>; 3]) -> Result<Option<LimitOf<M>>, PositionErrorOf<M>> {
        let determinants = before.determinants.iter().zip(&here.determinants).zip(&there.determinants);
        for (group, ((a, b), c)) in determinants.enumerate() {
            if b < a
                && b <= c
                && let Some(limit) = self.limit_at_minimum(before, there.input, group)?
            {
                return Ok(Some(limit));
            }
        }
        Ok(None)
    }

    /// The coordinates of a position with this input.
    pub(super) fn at_input(&self, position: &M::Coordinates, input: M::Scalar) -> M::Coordinates {
        let mut inputs = M::inputs(position);
        if let Some(place) = inputs.as_mut_slice().get_mut(self.place) {
            *place = input;
        }
        M::with_inputs(position, inputs)
    }

    /// Computes the position at an input, or finds the group that stops it.
    pub(super) fn at(&self, from: &M::Coordinates, input: M::Scalar) -> Result<Found<M>, PositionErrorOf<M>> {
        match (self.assemble)(&self.at_input(from, input)) {
            Ok(pose) => {
                let determinants = self.mechanism.block_determinants(&pose).abs();
                Ok(Found::Assembled(Sample { input, position: (self.coordinates)(&pose), determinants }))
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

    /// Follows the motion from the position `from` at the input `at` to another input.
    fn reach(&self, from: &M::Coordinates, at: M::Scalar, input: M::Scalar) -> Result<Reached<M>, PositionErrorOf<M>> {
        let found = self.at(from, input)?;
        self.follow(from, at, input, found)
    }

    /// Follows the motion from the position `from` at the input `at` to another input, where `found` is the outcome of one
    /// step there.
    ///
    /// Newton's method may fail far from a position although the mechanism moves on: an input is unbuildable only if it
    /// stops the mechanism from a position next to it, too.
    fn follow(
        &self,
        from: &M::Coordinates,
        at: M::Scalar,
        input: M::Scalar,
        found: Found<M>,
    ) -> Result<Reached<M>, PositionErrorOf<M>> {
        let mut group = match found {
            Found::Assembled(there) => return Ok(Reached::Assembled(there)),
            Found::Undetermined => return Ok(Reached::Undetermined),
            Found::Stopped(group) => group,
        };
        let (mut position, mut here) = (*from, at);
        loop {
            let stuck = match self.walk((position, here), input, group)? {
                Walked::Arrived(there) => return Ok(Reached::Assembled(there)),
                Walked::Stuck(stuck) => stuck,
            };
            let Bracket { assembled, unbuildable, group: other } = self.between(&stuck, group)?;
            group = other;
            let Some(beyond) = self.beyond_touch((position, here), unbuildable, group)? else {
                return Ok(Reached::Limit(Limit::Bracketed { assembled, unbuildable, group }));
            };
            (position, here) = (beyond.position, beyond.input);
            if here == input || (here > input) == (here > assembled) {
                return Ok(Reached::Touch);
            }
        }
    }

    /// Bisects between an input at which the mechanism assembles and one at which a group does not.
    fn between(&self, stuck: &Stuck<M>, mut group: M::Name) -> Result<Bracket<M>, PositionErrorOf<M>> {
        let (mut nearest, mut unbuildable) = (stuck.last, stuck.unbuildable);
        for _ in 0..NARROWINGS {
            let assembled = nearest.input;
            let mut middle = assembled + (unbuildable - assembled) / real::<M::Scalar>(2.0);
            if middle == assembled || middle == unbuildable {
                break;
            }
            let mut found = self.along(&nearest, middle)?;
            if matches!(found, Found::Undetermined) {
                // Usually only this input is undetermined: one nearby shows on which side of it the limit lies.
                middle = assembled + (middle - assembled) / real::<M::Scalar>(2.0);
                found = self.along(&nearest, middle)?;
            }
            match found {
                Found::Assembled(sample) => nearest = sample,
                Found::Stopped(other) => (unbuildable, group) = (middle, other),
                Found::Undetermined => break,
            }
        }
        Ok(Bracket { assembled: nearest.input, unbuildable, group })
    }

    /// Minimises the determinant of a group between two inputs, and returns the limit if the mechanism cannot be
    /// assembled at the minimum.
    fn limit_at_minimum(
        &self,
        from: &Sample<M>,
        to: M::Scalar,
        group: usize,
    ) -> Result<Option<LimitOf<M>>, PositionErrorOf<M>> {
        let golden = real::<M::Scalar>(0.618_033_988_749_894_9);
        let (mut a, mut b) = (from.input, to);
        let determinant = |found: &Reached<M>| match found {
            Reached::Assembled(sample) => sample.determinant(group),
            _ => M::Scalar::zero(),
        };
        for _ in 0..NARROWINGS {
            let width = (b - a) * golden;
            let (low, high) = (b - width, a + width);
            if low == high || low == a || high == b {
                break;
            }
            let look = |input: M::Scalar| self.reach(&from.position, from.input, input);
            match (look(low)?, look(high)?) {
                (Reached::Limit(limit), _) | (_, Reached::Limit(limit)) => return Ok(Some(limit)),
                (Reached::Touch, _) | (_, Reached::Touch) => break,
                (left, right) if determinant(&left) <= determinant(&right) => b = high,
                _ => a = low,
            }
        }
        Ok(None)
    }
}
