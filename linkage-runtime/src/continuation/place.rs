//! A place on the way, and one step from it.

use super::curve::{Curve, Refusal, Tried};
use super::options::Options;
use super::root::root;
use super::tangent::Elimination;
use super::vector::Vector;
use crate::scalar::to_f64;
use crate::{Error, Mechanism, Real, real};

/// A position of the curve with what tells it from its neighbours.
pub(super) struct Place<M: Mechanism<T, U, 1>, T: Real, const U: usize> {
    pub(super) q: M::Coordinates,
    /// Of length 1, the way that is followed.
    pub(super) tangent: Vector<T, U>,
    /// On which side of the curve the closures are positive, as a sign; zero where that is not known.
    pub(super) side: T,
    /// Of the blocks of J; zero where a block has just passed its zero.
    pub(super) determinants: M::BlockDeterminants,
    pub(super) regularity: T,
}

impl<M: Mechanism<T, U, 1>, T: Real, const U: usize> Clone for Place<M, T, U> {
    fn clone(&self) -> Self {
        Self { q: self.q, ..*self }
    }
}

impl<M: Mechanism<T, U, 1>, T: Real, const U: usize> Place<M, T, U> {
    /// Where the determinant of a group is rounding, its sign says nothing.
    pub(super) fn forget_sign(&mut self, group: &str) {
        for (determinant, other) in self.determinants.as_mut().iter_mut().zip(M::GROUPS) {
            if other.name == group {
                *determinant = T::zero();
            }
        }
    }
}

/// A step may leave its prediction by the angle it turns through, and by this much of its length.
const SLACK: f64 = 1.0 / 64.0;

/// What rounding may add to that, in roundings of the coordinates.
const ROUNDINGS: f64 = 64.0;

/// Below this the smallest pivot may be that of a change point.
pub(super) fn weak<T: Real>() -> T {
    T::default_epsilon().sqrt() * real(16.0)
}

impl<M, T, const U: usize> Curve<'_, M, T, U>
where
    T: Real,
    M: Mechanism<T, U, 1>,
{
    pub(super) fn determinants(&self, q: &M::Coordinates) -> M::BlockDeterminants {
        self.mechanism.block_determinants(&self.mechanism.pose_at(q))
    }

    /// The place at a position of the curve, its tangent the one that goes on along `forward`.
    pub(super) fn place(
        &self,
        q: M::Coordinates,
        elimination: &Elimination<T, U>,
        forward: &Vector<T, U>,
    ) -> Place<M, T, U> {
        let regularity = elimination.regularity();
        let mut tangent = elimination.tangent();
        if tangent.dot(forward) < T::zero() {
            tangent = tangent * -T::one();
        }
        let mut side = elimination.orientation(&tangent);
        if regularity < T::default_epsilon().sqrt() {
            // Of a tangent that is rounding alone nothing is known; the last one is.
            (tangent, side) = (*forward, T::zero());
        }
        Place { q, tangent, side, determinants: self.determinants(&q), regularity }
    }

    /// The place at `distance` from another along its tangent, whatever the curve does between the two.
    pub(super) fn at(&self, from: &Place<M, T, U>, distance: T) -> Tried<Place<M, T, U>> {
        let guess = self.moved(&from.q, &(from.tangent * distance));
        let found = self.correct(guess, &from.tangent)?;
        Ok(found.map(|(q, elimination)| self.place(q, &elimination, &from.tangent)))
    }

    /// Whether the way from one place to the other is an arc: it turns little, and leaves neither tangent further
    /// than that turn explains. Two curves that pass each other side by side do not look like that.
    pub(super) fn is_arc(
        &self,
        from: &Place<M, T, U>,
        q: &M::Coordinates,
        tangent: &Vector<T, U>,
        regularity: T,
        options: &Options<T>,
    ) -> bool {
        let (way, turn) = (self.difference(q, &from.q), (*tangent - from.tangent).norm());
        let rounding = self.rounding(q) * real(ROUNDINGS) / regularity.max(T::default_epsilon().sqrt());
        let most = way.norm() * (turn + real(SLACK)) + rounding;
        way.dot(&from.tangent) > T::zero()
            && turn <= options.largest_turn
            && way.across(&from.tangent) <= most
            && way.across(tangent) <= most
    }

    /// The distance along the tangent of `from` at which a number changes its sign.
    pub(super) fn sign_change(
        &self,
        from: &Place<M, T, U>,
        [low, high]: [T; 2],
        values: [T; 2],
        value: impl Fn(&Place<M, T, U>) -> T,
    ) -> Result<Option<T>, Error> {
        let smallest = self.rounding(&from.q) * real(0.25);
        root([low, high], values, smallest, |distance| Ok(self.at(from, distance)?.ok().map(|place| value(&place))))
    }

    /// The group whose determinant fell most on the way from one place to another.
    pub(super) fn fallen_group(&self, from: &M::BlockDeterminants, to: &M::BlockDeterminants) -> &'static str {
        let mut fallen: Option<(f64, &'static str)> = None;
        for ((before, after), group) in from.as_ref().iter().zip(to.as_ref()).zip(M::GROUPS) {
            let part = to_f64(after.abs()) / to_f64(before.abs());
            if part.is_finite() && fallen.is_none_or(|(least, _)| part < least) {
                fallen = Some((part, group.name));
            }
        }
        fallen.map(|(_, group)| group).or_else(|| M::GROUPS.first().map(|group| group.name)).unwrap_or_default()
    }

    /// The place at a change point, where the sign of this group's determinant is rounding.
    pub(super) fn at_crossing(&self, q: M::Coordinates, tangent: Vector<T, U>, side: T, group: &str) -> Place<M, T, U> {
        let mut place = Place { q, tangent, side, determinants: self.determinants(&q), regularity: T::zero() };
        place.forget_sign(group);
        place
    }

    /// The tangent nearest to these rates, their way.
    pub(super) fn choose(&self, tangents: &[Vector<T, U>], rates: &M::Coordinates) -> Result<Vector<T, U>, Error> {
        let direction = self.direction(rates);
        if !direction.is_finite() {
            return Err(Error::NotFinite { mechanism: M::NAME, quantity: "the direction" });
        }
        let direction = direction * direction.largest().recip();
        let mut nearest = None;
        for tangent in tangents {
            let along = tangent.dot(&direction);
            if along.abs() > nearest.map_or(weak(), |(most, _): (T, _)| most) {
                nearest = Some((along.abs(), if along < T::zero() { *tangent * -T::one() } else { *tangent }));
            }
        }
        nearest.map(|(_, tangent)| tangent).ok_or(Error::NoDirection { mechanism: M::NAME })
    }

    pub(super) fn lost(&self, q: &M::Coordinates, iterations: usize, why: Refusal) -> Error {
        let group = self.singular_group(q);
        let Refusal { residual, regularity } = why;
        Error::Lost { mechanism: M::NAME, group, iterations, residual, regularity }
    }

    /// The group that J calls singular, or else the one of the smallest determinant.
    pub(super) fn singular_group(&self, q: &M::Coordinates) -> &'static str {
        let pose = self.mechanism.pose_at(q);
        if let Err(Error::Singular { group, .. }) =
            self.mechanism.solve_jacobian(&pose, &self.mechanism.residual(&pose))
        {
            return group;
        }
        let determinants = self.mechanism.block_determinants(&pose);
        let mut weakest = None;
        for (determinant, group) in determinants.as_ref().iter().zip(M::GROUPS) {
            if weakest.is_none_or(|(least, _)| determinant.abs() < least) {
                weakest = Some((determinant.abs(), group.name));
            }
        }
        weakest.map_or("", |(_, group)| group)
    }
}
