//! The declared ranges of coordinates and outputs along a step.

use super::curve::Curve;
use super::place::Place;
use crate::jacobian::ulp::EQUAL_ULPS;
use crate::scalar::arithmetic::*;
use crate::{BorrowedName, D, Dim, Mechanism, PathErrorOf, RangeEnd, Real, real};

/// An end of a range, with the value at the start of a step.
pub(super) struct JointEnd<T, N> {
    place: usize,
    pub(super) of: N,
    pub(super) end: RangeEnd,
    limit: T,
    value: T,
    /// True for an output, which may oscillate within a step; coordinates do not.
    pub(super) is_output: bool,
}

/// An end of a range of a mechanism.
pub(super) type JointEndOf<M> = JointEnd<<M as Mechanism>::Scalar, <M as Mechanism>::Name>;

impl<T: Real, N: BorrowedName> JointEnd<T, N> {
    /// All ends of a mechanism that are given.
    pub(super) fn all<M: Mechanism<Scalar = T, Name = N>>(
        mechanism: &M,
        q: &M::Coordinates,
    ) -> impl Iterator<Item = Self> {
        let names = mechanism.range_names().enumerate();
        let (u, v, _) = mechanism.dims();
        let is_output = move |of| !(0..u.count() + v.count()).any(|column| mechanism.coordinate_name(column) == of);
        let all = names.filter_map(move |(place, of)| Some((place, of, mechanism.ranged(place, q)?, is_output(of))));
        all.flat_map(|(place, of, ranged, is_output)| {
            let ends = RangeEnd::BOTH.into_iter().filter_map(move |end| Some((end, ranged.end(end)?)));
            ends.map(move |(end, limit)| Self { place, of, end, limit, value: ranged.value, is_output })
        })
    }
}

impl<M> Curve<'_, M>
where
    M: Mechanism<V = D<1>>,
{
    /// The distance from an end of a range, negative beyond it; NaN without a value.
    pub(super) fn room(&self, q: &M::Coordinates, joint: &JointEndOf<M>) -> M::Scalar {
        let ranged = self.mechanism.ranged(joint.place, q).map(|ranged| ranged.following(joint.value));
        ranged.and_then(|ranged| ranged.room_at(joint.end)).unwrap_or_else(|| real(f64::NAN))
    }

    /// The distance from an end of a range, and its derivative along the tangent.
    pub(super) fn room_along(&self, place: &Place<M>, joint: &JointEndOf<M>) -> [M::Scalar; 2] {
        let little = self.little(&place.q);
        let near = self.moved(&place.q, &(place.tangent * little));
        let here = self.room(&place.q, joint);
        [here, (self.room(&near, joint) - here) / little]
    }

    /// True if the distance from an end of a range is more than the rounding error of the place.
    pub(super) fn has_room(&self, place: &Place<M>, joint: &JointEndOf<M>) -> bool {
        let [room, slope] = self.room_along(place, joint);
        room > slope.abs() * self.rounding_error(&place.q) * real(EQUAL_ULPS)
    }

    /// An end of a range at which the place is, if the path leads beyond it.
    pub(super) fn joint_end_ahead(&self, place: &Place<M>) -> Option<JointEndOf<M>> {
        let is_ahead = |joint: &JointEndOf<M>| {
            !self.has_room(place, joint) && self.room_along(place, joint)[1] < M::Scalar::zero()
        };
        JointEnd::all(&*self.mechanism, &place.q).find(is_ahead)
    }

    /// Gives a place at an end of a range exactly this value, if a coordinate has the range.
    pub(super) fn at_joint_end(&self, place: Place<M>, joint: &JointEndOf<M>) -> Result<Place<M>, PathErrorOf<M>> {
        let (u, v) = self.dims();
        let mut columns = 0..u.count() + v.count();
        let column = columns.find(|&column| self.mechanism.coordinate_name(column) == joint.of);
        let Some(column) = column else { return Ok(place) };
        let (unknowns, inputs) = M::parts(&place.q);
        let value = unknowns.iter().chain(&inputs).nth(column).copied();
        // An angle keeps its turns.
        let value = value.map_or(joint.limit, |value| {
            let ranged = self.mechanism.ranged(joint.place, &place.q);
            let turns = ranged
                .filter(|ranged| ranged.is_direction)
                .map_or_else(M::Scalar::zero, |_| ((value - joint.limit) / M::Scalar::two_pi()).round());
            joint.limit + turns * M::Scalar::two_pi()
        });
        self.with_exact(place, column, value)
    }
}
