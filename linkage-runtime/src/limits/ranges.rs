//! The declared ranges of coordinates and outputs, as limits of an input.
//!
//! A range of the input itself is a limit as it is. For the others the branch is sampled from the start to the limit that
//! is known, and between two samples the first zero of the distance from an end is bracketed by two neighbouring inputs.

use super::limit::Limit;
use super::search::STEPS;
use super::searched::{Found, Sample, Searched};
use super::touch::in_turn_of;
use crate::jacobian::{ScalesOf as Scales, first_resolved_zero, first_zero};
use crate::mechanism::check_ranges;
use crate::scalar::arithmetic::*;
use crate::{Build, Dim, Mechanism, PerUnknown, PositionErrorOf, RangeEnd, Ranged, real};

/// The most steps that narrow an interval to two neighbouring numbers.
const NARROWINGS: usize = 80;

/// The distance from a limit at which the last sample is tried if there is none at the limit, divided by the distance from
/// the start.
const INSET: f64 = 1e-12;

/// The inputs to either side at which a length without limits is searched, in units of the lengths of its loops: as far as a search of groups.
const REACH: f64 = 4.0;

/// A range, with its value at a position of the search: angles count turns from the start.
#[derive(Clone, Copy)]
struct Watched<T> {
    place: usize,
    end: RangeEnd,
    value: T,
    /// The unit of the input.
    unit: T,
    /// True for an output, which may oscillate between two samples.
    is_output: bool,
}

impl<M: Mechanism> Searched<'_, M> {
    /// The nearer of a limit and of the first end of a range, on the side of `sign`.
    pub(super) fn within_ranges(
        &self,
        start: M::Scalar,
        position: &M::Coordinates,
        limit: Limit<M::Scalar, M::Name>,
        sign: M::Scalar,
    ) -> Result<Limit<M::Scalar, M::Name>, PositionErrorOf<M>> {
        check_ranges(self.mechanism, position)?;
        let limit = self.within_own_range(start, position, limit, sign);
        let reach = match self.mechanism.input_angles().get(self.place) {
            Some(true) => M::Scalar::two_pi(),
            _ if self.reach > M::Scalar::zero() => self.reach,
            _ => {
                let scales = Scales::<M>::of(self.mechanism, &self.mechanism.pose_at(position)).coordinates.inputs;
                scales.as_slice().get(self.place).copied().unwrap_or_else(M::Scalar::one) * real(REACH)
            }
        };
        let end = limit.input().unwrap_or(start + reach * sign);
        let mut first: Option<(M::Scalar, M::Name, RangeEnd)> = None;
        for (place, name) in self.mechanism.range_names().enumerate() {
            if self.mechanism.input_name(self.place) == name {
                continue;
            }
            let Some(ranged) = self.mechanism.ranged(place, position) else { continue };
            let (u, v, _) = self.mechanism.dims();
            let is_output = !(0..u.count() + v.count()).any(|column| self.mechanism.coordinate_name(column) == name);
            for side in RangeEnd::BOTH {
                if ranged.end(side).is_none() {
                    continue;
                }
                let watched = Watched { place, end: side, value: ranged.value, unit: reach, is_output };
                let to = first.map_or(end, |(input, ..)| input);
                if let Some(input) = self.first_end(start, position, to, watched)? {
                    first = Some((input, name, side));
                }
            }
        }
        Ok(first.map_or(limit, |(input, of, end)| Limit::JointRange { input, of, end }))
    }

    /// The nearer of a limit and of the end of the range of the input itself.
    fn within_own_range(
        &self,
        start: M::Scalar,
        position: &M::Coordinates,
        limit: Limit<M::Scalar, M::Name>,
        sign: M::Scalar,
    ) -> Limit<M::Scalar, M::Name> {
        let of = self.mechanism.input_name(self.place);
        let Some(place) = self.mechanism.range_names().position(|name| name == of) else { return limit };
        let Some(ranged) = self.mechanism.ranged(place, position) else { return limit };
        let end = if sign > M::Scalar::zero() { RangeEnd::Most } else { RangeEnd::Least };
        let Some(input) = ranged.end(end) else { return limit };
        let turns = ((start - ranged.value) / M::Scalar::two_pi()).round();
        let input = if ranged.is_direction { input + turns * M::Scalar::two_pi() } else { input };
        let is_nearer = limit.input().is_none_or(|other| (input - other) * sign < M::Scalar::zero());
        if is_nearer { Limit::JointRange { input, of, end } } else { limit }
    }

    /// The last input, on the way to `end`, before the value is beyond an end of its range; none if it is not.
    fn first_end(
        &self,
        start: M::Scalar,
        position: &M::Coordinates,
        end: M::Scalar,
        mut watched: Watched<M::Scalar>,
    ) -> Result<Option<M::Scalar>, PositionErrorOf<M>> {
        let Found::Assembled(mut last) = self.at(position, start)? else { return Ok(None) };
        last.position = *position;
        let whole = f64::from(STEPS);
        let inset = whole * (1.0 - INSET);
        let steps = (1..STEPS).map(f64::from).chain([inset, whole]);
        for step in steps {
            let input = if step < whole { start + (end - start) * real::<M::Scalar>(step / whole) } else { end };
            let Found::Assembled(there) = self.next(&last, input)? else { continue };
            let ends = [&last, &there].map(|sample| self.room_along(sample, &watched));
            let mut ends = ends.map(|[at, value, slope]| crate::jacobian::Sample { at, value, slope });
            // At the start the value may be at its end.
            if last.input == start && ends[0].value.abs() <= self.slack(&last, &watched) {
                if ends[0].slope * (end - start) < M::Scalar::zero() {
                    return Ok(Some(start));
                }
                ends[0].value = M::Scalar::zero();
                // Where the slope is unknown, the sign is that of the next value.
                ends[0].slope = if ends[0].slope.is_finite() { ends[0].slope } else { M::Scalar::zero() };
            }
            let smallest = (input - last.input).abs() * M::Scalar::default_epsilon();
            let between = |at: M::Scalar| {
                let Found::Assembled(between) = self.next(&last, at)? else {
                    return Ok(crate::jacobian::Sample { at, value: M::Scalar::zero(), slope: M::Scalar::zero() });
                };
                let [at, value, slope] = self.room_along(&between, &watched);
                Ok::<_, PositionErrorOf<M>>(crate::jacobian::Sample { at, value, slope })
            };
            let slopes = [&last, &there].map(|sample| self.slopes(&sample.position));
            let found = match slopes {
                [Some(one), Some(other)] if watched.is_output => {
                    let near = |at: M::Scalar| self.room(&self.near([&last, &there], [&one, &other], at), &watched);
                    first_resolved_zero(ends, smallest, near, between)?
                }
                _ => first_zero(ends, smallest, between)?,
            };
            if let Some([low, high]) = found {
                return self.narrowed(&last, [low.at, high.at], &watched).map(Some);
            }
            watched.value = self.value(&there.position, &watched).map_or(watched.value, |ranged| ranged.value);
            last = there;
        }
        Ok(None)
    }

    /// The last input of an interval at which the value is in its range.
    fn narrowed(
        &self,
        from: &Sample<M>,
        [mut low, mut high]: [M::Scalar; 2],
        watched: &Watched<M::Scalar>,
    ) -> Result<M::Scalar, PositionErrorOf<M>> {
        for _ in 0..NARROWINGS {
            let middle = (low + high) * real(0.5);
            if middle == low || middle == high {
                break;
            }
            let is_within = match self.next(from, middle)? {
                Found::Assembled(there) => self.room_along(&there, watched)[1] >= M::Scalar::zero(),
                Found::Undetermined | Found::Stopped(_) => true,
            };
            if is_within {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(low)
    }

    /// The position at another input, with angles in the turn nearest to the last position.
    fn next(&self, last: &Sample<M>, input: M::Scalar) -> Result<Found<M>, PositionErrorOf<M>> {
        Ok(match self.at(&last.position, input)? {
            Found::Assembled(there) => {
                let unknowns = in_turn_of(self.mechanism, M::unknowns(&there.position), &M::unknowns(&last.position));
                Found::Assembled(Sample { position: M::with_unknowns(&there.position, unknowns), ..there })
            }
            other => other,
        })
    }

    fn value(&self, position: &M::Coordinates, watched: &Watched<M::Scalar>) -> Option<Ranged<M::Scalar>> {
        self.mechanism.ranged(watched.place, position).map(|ranged| ranged.following(watched.value))
    }

    /// The distance from the end; NaN without a value.
    fn room(&self, q: &M::Coordinates, watched: &Watched<M::Scalar>) -> M::Scalar {
        let room = self.value(q, watched).and_then(|ranged| ranged.room_at(watched.end));
        room.unwrap_or_else(|| real(f64::NAN))
    }

    /// The input, the distance from the end, and its derivative by the input; NaN where that is unknown.
    fn room_along(&self, sample: &Sample<M>, watched: &Watched<M::Scalar>) -> [M::Scalar; 3] {
        let here = self.room(&sample.position, watched);
        let Some(slopes) = self.slopes(&sample.position) else {
            return [sample.input, here, real(f64::NAN)];
        };
        let little = watched.unit * M::Scalar::default_epsilon().sqrt();
        let near = self.moved(&sample.position, slopes * -little, little);
        [sample.input, here, (self.room(&near, watched) - here) / little]
    }

    /// The derivatives of the unknowns by the input, with the other sign; none at a singular position.
    fn slopes(&self, q: &M::Coordinates) -> Option<PerUnknown<M>> {
        let pose = self.mechanism.pose_at(q);
        let by_inputs = self.mechanism.jacobian_inputs(&pose);
        let by_input =
            by_inputs.columns().as_slice().get(self.place).copied().unwrap_or_else(|| self.mechanism.dims().0.zeros());
        self.mechanism.solve_jacobian(&pose, &by_input).ok()
    }

    /// A position with other unknowns and another input.
    fn moved(&self, q: &M::Coordinates, unknowns: PerUnknown<M>, input: M::Scalar) -> M::Coordinates {
        let (here, mut inputs) = M::parts(q);
        if let Some(here) = inputs.as_mut_slice().get_mut(self.place) {
            *here += input;
        }
        M::coordinates(here + unknowns, inputs)
    }

    /// A position near the motion at an input between two samples, on the cubic through both with these slopes.
    fn near(&self, [last, there]: [&Sample<M>; 2], slopes: [&PerUnknown<M>; 2], input: M::Scalar) -> M::Coordinates {
        let way = there.input - last.input;
        let x = (input - last.input) / way;
        let y = M::Scalar::one() - x;
        let chord = M::unknowns(&there.position) - M::unknowns(&last.position);
        let along = chord * (x * x * (y + y + M::Scalar::one())) + *slopes[1] * (way * x * x * y)
            - *slopes[0] * (way * x * y * y);
        self.moved(&last.position, along, way * x)
    }

    /// A distance of the value from an end that may be a rounding error.
    fn slack(&self, sample: &Sample<M>, watched: &Watched<M::Scalar>) -> M::Scalar {
        let ranged = self.value(&sample.position, watched);
        let limit = ranged.and_then(|ranged| ranged.end(watched.end)).unwrap_or_else(M::Scalar::zero);
        (watched.value.abs() + limit.abs()) * M::Scalar::default_epsilon() * real(4.0)
    }
}
