//! A place on the way, and one step from it.

use super::change_point::Crossing;
use super::curve::{Curve, Refusal, Tried};
use super::groups::Groups;
use super::options::Options;
use crate::jacobian::rounding::{SAME, weak};
use crate::jacobian::{Blocks, EliminationOf as Elimination, VectorOf as Vector, root};
use crate::scalar::arithmetic::*;
use crate::{Column, D, Dim, Mechanism, PathError, PositionError, real};

/// A position of the curve with what tells it from its neighbours.
pub(super) struct Place<M: Mechanism> {
    pub(super) q: M::Coordinates,
    /// Of length 1, the way that is followed.
    pub(super) tangent: Vector<M>,
    /// On which side of the curve the closures are positive, as a sign; zero where that is not known.
    pub(super) side: M::Scalar,
    /// Of the blocks of J; zero where a block has just passed its zero.
    pub(super) determinants: Column<M::Scalar, M::G>,
    pub(super) regularity: M::Scalar,
    /// The sign of the last but one pivot.
    pub(super) last_but_one: M::Scalar,
}

impl<M: Mechanism> Clone for Place<M> {
    fn clone(&self) -> Self {
        Self { q: self.q, ..*self }
    }
}

impl<M: Mechanism> Place<M> {
    /// Where the determinant of a group is rounding, its sign says nothing.
    pub(super) fn forget_sign(&mut self, group: &str) {
        for (determinant, other) in self.determinants.iter_mut().zip(M::GROUPS) {
            if other.name == group {
                *determinant = M::Scalar::zero();
            }
        }
    }

    /// The share of the way to another place after which the determinant of a group is zero, if one changes its sign.
    pub(super) fn sign_changes(&self, to: &Self) -> Option<M::Scalar> {
        let mut pairs = self.determinants.iter().zip(&to.determinants);
        let (before, after) = pairs.find(|(before, after)| **before * **after < M::Scalar::zero())?;
        Some(*before / (*before - *after))
    }
}

/// A step may leave its prediction by the angle that it turns through, by this much of its length, and by what rounding of
/// the coordinates adds.
const SLACK: f64 = 1.0 / 64.0;

/// Two pivots fall to zero on the way if the last but one falls to less than this part of its sum at the ends where that is
/// expected: to zero if it falls and rises by one slope, to an eighth if by one and the double. At a half every way would
/// do, at a sixteenth a bend hides a crossing.
const FALLEN: f64 = 0.25;

impl<M> Curve<'_, M>
where
    M: Mechanism<V = D<1>>,
{
    pub(super) fn determinants(&self, q: &M::Coordinates) -> Column<M::Scalar, M::G> {
        self.mechanism.block_determinants(&self.mechanism.pose_at(q))
    }

    /// The place at a position of the curve, its tangent the one that goes on along `forward`.
    pub(super) fn place(&self, q: M::Coordinates, elimination: &Elimination<M>, forward: &Vector<M>) -> Place<M> {
        let regularity = elimination.regularity();
        let mut tangent = elimination.tangent();
        if tangent.dot(forward) < M::Scalar::zero() {
            tangent = -tangent;
        }
        let mut side = elimination.orientation(&tangent);
        if regularity < M::Scalar::default_epsilon().sqrt() {
            // Of a tangent that is rounding alone nothing is known; the last one is.
            (tangent, side) = (*forward, M::Scalar::zero());
        }
        Place {
            q,
            tangent,
            side,
            determinants: self.determinants(&q),
            regularity,
            last_but_one: elimination.last_but_one(),
        }
    }

    /// The place at `distance` from another along its tangent, whatever the curve does between the two.
    pub(super) fn at(&self, from: &Place<M>, distance: M::Scalar) -> Tried<Place<M>> {
        let guess = self.moved(&from.q, &(from.tangent * distance));
        let found = self.correct(guess, &from.tangent)?;
        Ok(found.map(|(q, elimination)| self.place(q, &elimination, &from.tangent)))
    }

    /// Whether the way from one place to the other is an arc: it turns little, and leaves neither tangent further
    /// than that turn explains. Two curves that pass each other side by side do not look like that.
    pub(super) fn is_arc(
        &self,
        from: &Place<M>,
        q: &M::Coordinates,
        tangent: &Vector<M>,
        regularity: M::Scalar,
        options: &Options<M::Scalar>,
    ) -> bool {
        let (way, turn) = (self.difference(q, &from.q), (*tangent - from.tangent).norm());
        let rounding = self.rounding(q) * real(SAME) / regularity.max(M::Scalar::default_epsilon().sqrt());
        let most = way.norm() * (turn + real(SLACK)) + rounding;
        way.dot(&from.tangent) > M::Scalar::zero()
            && turn <= options.largest_turn
            && way.across(&from.tangent) <= most
            && way.across(tangent) <= most
    }

    /// The distance along the tangent of `from` at which a number changes its sign.
    pub(super) fn sign_change(
        &self,
        from: &Place<M>,
        [low, high]: [M::Scalar; 2],
        values: [M::Scalar; 2],
        value: impl Fn(&Place<M>) -> M::Scalar,
    ) -> Result<Option<M::Scalar>, PathError> {
        let smallest = self.rounding(&from.q) * real(0.25);
        root([low, high], values, smallest, |distance| Ok(self.at(from, distance)?.ok().map(|place| value(&place))))
    }

    /// The distance from one place on the way to another at which two pivots may be zero at once. No determinant and no
    /// side need change its sign there.
    pub(super) fn falls_twice(
        &self,
        from: &Place<M>,
        to: &Place<M>,
        way: M::Scalar,
    ) -> Result<Option<M::Scalar>, PathError> {
        if M::U::COUNT < 2 {
            return Ok(None);
        }
        let sum = from.last_but_one + to.last_but_one;
        let distance = way * (from.last_but_one / sum);
        if !distance.is_finite() {
            return Ok(None);
        }
        let at = self.linear(&self.moved(&from.q, &(from.tangent * distance)))?;
        let between = Elimination::<M>::new(at.jacobian).last_but_one();
        Ok((between <= sum * real(FALLEN)).then_some(distance))
    }

    /// The groups that are singular to the root of rounding: so far rounding of the loop equations moves a double root.
    pub(super) fn singular_groups(&self, q: &M::Coordinates) -> Groups {
        let mut groups = Groups::none(M::GROUPS);
        let blocks = Blocks::of(self.mechanism, &self.mechanism.pose_at(q));
        for place in 0..M::GROUPS.len() {
            if blocks.regularity(place) <= weak() {
                groups.insert(place);
            }
        }
        groups
    }

    /// Adds the groups whose determinants have fallen to that on the way from a place: where all terms of a user's
    /// equation vanish at the crossing, a block tells nothing by its own size.
    pub(super) fn add_fallen_groups(&self, crossing: &mut Crossing<M>, from: &Place<M>) {
        let determinants = self.determinants(&crossing.q);
        let pairs = determinants.iter().zip(&from.determinants);
        for (place, (at, before)) in pairs.enumerate() {
            if at.abs() <= before.abs() * weak() && !before.is_zero() {
                crossing.groups.insert(place);
            }
        }
    }

    /// The place at a crossing, where the signs of the determinants of the groups that are singular are rounding.
    pub(super) fn at_crossing(&self, crossing: &Crossing<M>, tangent: Vector<M>, side: M::Scalar) -> Place<M> {
        let mut determinants = self.determinants(&crossing.q);
        for (place, determinant) in determinants.iter_mut().enumerate() {
            if crossing.groups.contains(place) {
                *determinant = M::Scalar::zero();
            }
        }
        Place {
            q: crossing.q,
            tangent,
            side,
            determinants,
            regularity: M::Scalar::zero(),
            last_but_one: M::Scalar::zero(),
        }
    }

    /// The tangent nearest to these rates, their way.
    pub(super) fn choose(&self, tangents: &[Vector<M>], rates: &M::Rates) -> Result<Vector<M>, PathError> {
        let direction = self.direction(rates);
        if !direction.is_finite() {
            return Err(PositionError::NotFinite { mechanism: M::NAME, quantity: "the direction" }.into());
        }
        let direction = direction * direction.largest().recip();
        let mut nearest = None;
        for tangent in tangents {
            let along = tangent.dot(&direction);
            if along.abs() > nearest.map_or(weak(), |(most, _): (M::Scalar, _)| most) {
                nearest = Some((along.abs(), if along < M::Scalar::zero() { -*tangent } else { *tangent }));
            }
        }
        nearest.map(|(_, tangent)| tangent).ok_or(PathError::NoDirection { mechanism: M::NAME })
    }

    pub(super) fn lost(&self, q: &M::Coordinates, iterations: usize, why: Refusal) -> PathError {
        let (_, group) = self.weakest_group(q);
        let Refusal { residual, regularity } = why;
        PathError::Lost { mechanism: M::NAME, group, iterations, residual, regularity }
    }

    /// The group that is nearest to a singularity, and how regular it is.
    pub(super) fn weakest_group(&self, q: &M::Coordinates) -> (M::Scalar, &'static str) {
        Blocks::of(self.mechanism, &self.mechanism.pose_at(q)).weakest()
    }
}
