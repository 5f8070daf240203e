//! A place on the way, and one step from it.

use nalgebra::{SMatrix, SVector};

use super::change_point::Crossing;
use super::curve::{Curve, Linear, Refusal, Tried};
use super::groups::Groups;
use super::options::Options;
use super::root::root;
use super::tangent::Elimination;
use super::vector::Vector;
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
    /// The sign of the last but one pivot.
    pub(super) last_but_one: T,
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

    /// The share of the way to another place after which the determinant of a group is zero, if one changes its sign.
    pub(super) fn sign_changes(&self, to: &Self) -> Option<T> {
        let mut pairs = self.determinants.as_ref().iter().zip(to.determinants.as_ref());
        let (before, after) = pairs.find(|(before, after)| **before * **after < T::zero())?;
        Some(*before / (*before - *after))
    }
}

/// A step may leave its prediction by the angle it turns through, and by this much of its length.
const SLACK: f64 = 1.0 / 64.0;

/// Two pivots fall to zero on the way if the last but one falls to less than this part of its sum at the ends where that is
/// expected: to zero if it falls and rises by one slope, to an eighth if by one and the double. At a half every way would
/// do, at a sixteenth a bend hides a crossing.
const FALLEN: f64 = 0.25;

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

    /// The distance from one place on the way to another at which two pivots may be zero at once. No determinant and no
    /// side need change its sign there.
    pub(super) fn falls_twice(&self, from: &Place<M, T, U>, to: &Place<M, T, U>, way: T) -> Result<Option<T>, Error> {
        if U < 2 {
            return Ok(None);
        }
        let sum = from.last_but_one + to.last_but_one;
        let distance = way * (from.last_but_one / sum);
        if !distance.is_finite() {
            return Ok(None);
        }
        let at = self.linear(&self.moved(&from.q, &(from.tangent * distance)))?;
        let between = Elimination::new(at.unknowns, at.input).last_but_one();
        Ok((between <= sum * real(FALLEN)).then_some(distance))
    }

    /// The groups whose block of J has a pivot that is zero to the root of rounding: so far rounding of the loop equations
    /// moves a double root.
    pub(super) fn singular_groups(&self, at: &Linear<T, U>) -> Groups {
        let mut groups = Groups::none(M::GROUPS);
        for (place, group) in M::GROUPS.iter().enumerate() {
            let entries =
                group.equations.iter().flat_map(|&row| group.unknowns.iter().map(move |&column| (row, column)));
            let largest = entries.clone().fold(T::zero(), |most, entry| most.max(at.unknowns[entry].abs()));
            // The block, and beside it a diagonal in the rows and columns of the other groups.
            let mut block = SMatrix::<T, U, U>::zeros();
            for entry in entries {
                block[entry] = at.unknowns[entry];
            }
            let rows = (0..U).filter(|row| !group.equations.contains(row));
            for (row, column) in rows.zip((0..U).filter(|column| !group.unknowns.contains(column))) {
                block[(row, column)] = largest;
            }
            if Elimination::new(block, SVector::zeros()).defect(weak()) > 0 {
                groups.insert(place);
            }
        }
        groups
    }

    /// Adds the groups whose determinants have fallen to that on the way from a place: where all terms of a user's
    /// equation vanish at the crossing, a block tells nothing by its own size.
    pub(super) fn add_fallen_groups(&self, crossing: &mut Crossing<M::Coordinates, T, U>, from: &Place<M, T, U>) {
        let determinants = self.determinants(&crossing.q);
        let pairs = determinants.as_ref().iter().zip(from.determinants.as_ref());
        for (place, (at, before)) in pairs.enumerate() {
            if at.abs() <= before.abs() * weak() && !before.is_zero() {
                crossing.groups.insert(place);
            }
        }
    }

    /// The place at a crossing, where the signs of the determinants of the groups that are singular are rounding.
    pub(super) fn at_crossing(
        &self,
        crossing: &Crossing<M::Coordinates, T, U>,
        tangent: Vector<T, U>,
        side: T,
    ) -> Place<M, T, U> {
        let mut determinants = self.determinants(&crossing.q);
        for (place, determinant) in determinants.as_mut().iter_mut().enumerate() {
            if crossing.groups.contains(place) {
                *determinant = T::zero();
            }
        }
        Place { q: crossing.q, tangent, side, determinants, regularity: T::zero(), last_but_one: T::zero() }
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
