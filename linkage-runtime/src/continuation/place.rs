//! Points of a path, and one step from a point.

use super::change_point::Crossing;
use super::curve::{Curve, Rejection, Tried};
use super::groups::Groups;
use super::options::Options;
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero};
use crate::jacobian::{Blocks, EliminationOf as Elimination, VectorOf as Vector};
use crate::scalar::arithmetic::*;
use crate::{Column, D, Dim, Mechanism, Name, PathError, PathErrorOf, PositionError, real};

/// A position of the curve, with its tangent, orientation and determinants.
pub(super) struct Place<M: Mechanism> {
    pub(super) q: M::Coordinates,
    /// The unit tangent, in the direction of the path.
    pub(super) tangent: Vector<M>,
    /// The part of a step that grows with its square, where the motion cannot be told from another with the same tangent;
    /// else zero.
    pub(super) bend: Vector<M>,
    /// det [J A; tangent'], which changes its sign at a change point where one pivot vanishes; zero if unknown.
    pub(super) orientation: M::Scalar,
    /// The determinants of the blocks of J; zero where the sign is unknown.
    pub(super) determinants: Column<M::Scalar, M::G>,
    /// The derivatives of the determinants along the tangent.
    pub(super) slopes: Column<M::Scalar, M::G>,
    /// The last pivot of [J A] divided by the first.
    pub(super) regularity: M::Scalar,
    /// The last but one pivot of [J A] divided by the first.
    pub(super) last_but_one: M::Scalar,
}

impl<M: Mechanism> Clone for Place<M> {
    fn clone(&self) -> Self {
        Self { q: self.q, ..*self }
    }
}

impl<M: Mechanism> Place<M> {
    /// Sets the determinant of a group, whose sign is that of a rounding error, to zero.
    pub(super) fn forget_sign(&mut self, mechanism: &M, group: M::Name) {
        for (determinant, other) in self.determinants.iter_mut().zip(mechanism.groups()) {
            if other.name == group {
                *determinant = M::Scalar::zero();
            }
        }
    }

    /// The place on the way back.
    #[cfg(feature = "std")]
    pub(super) fn reversed(&self) -> Self {
        Self { tangent: -self.tangent, slopes: -self.slopes, orientation: -self.orientation, ..self.clone() }
    }

    /// The fraction of the distance to another place at which the determinant of a group is zero, if one changes its
    /// sign.
    pub(super) fn sign_changes(&self, to: &Self) -> Option<M::Scalar> {
        let mut pairs = self.determinants.iter().zip(&to.determinants);
        let (before, after) = pairs.find(|(before, after)| **before * **after < M::Scalar::zero())?;
        Some(*before / (*before - *after))
    }
}

/// A step may deviate from each tangent by its length times the turn between the tangents, and by this fraction of its
/// length.
const SLACK: f64 = 1.0 / 64.0;

/// Two pivots may vanish within a step if the last but one, at the zero expected from a fall and a rise of equal slope,
/// is below this fraction of the sum of its values at both ends. With equal slopes it is zero there, with one slope
/// twice the other an eighth of the sum. At 1/2 every step would qualify, at 1/16 a bend hides a change point.
const DOUBLE_ZERO_SHARE: f64 = 0.25;

impl<M> Curve<'_, M>
where
    M: Mechanism<V = D<1>>,
{
    pub(super) fn determinants(&self, q: &M::Coordinates) -> Column<M::Scalar, M::G> {
        self.mechanism.block_determinants(&self.mechanism.pose_at(q))
    }

    /// The determinants at a position of the curve, and their derivatives along a tangent: the curve deviates from it by a
    /// square.
    fn determinants_along(&self, q: &M::Coordinates, tangent: &Vector<M>) -> [Column<M::Scalar, M::G>; 2] {
        let (here, little) = (self.determinants(q), self.little(q));
        let near = self.determinants(&self.moved(q, &(*tangent * little)));
        [here, (near - here) / little]
    }

    /// The length of the way by which derivatives along the curve are computed.
    pub(super) fn little(&self, q: &M::Coordinates) -> M::Scalar {
        self.rounding_error(q).sqrt()
    }

    /// Changes the tangent of a place.
    pub(super) fn turned(&self, place: &Place<M>, tangent: Vector<M>, orientation: M::Scalar) -> Place<M> {
        let [_, slopes] = self.determinants_along(&place.q, &tangent);
        Place { q: place.q, tangent, orientation, slopes, ..*place }
    }

    /// The place at a position of the curve, with the tangent in the direction of `forward`.
    pub(super) fn place(&self, q: M::Coordinates, elimination: &Elimination<M>, forward: &Vector<M>) -> Place<M> {
        let regularity = elimination.regularity();
        let mut tangent = elimination.tangent();
        if tangent.dot(forward) < M::Scalar::zero() {
            tangent = -tangent;
        }
        let mut orientation = elimination.orientation(&tangent);
        if regularity < M::Scalar::default_epsilon().sqrt() {
            // The tangent is unreliable here; the previous one is kept.
            (tangent, orientation) = (*forward, M::Scalar::zero());
        }
        let [determinants, slopes] = self.determinants_along(&q, &tangent);
        let (bend, last_but_one) = (Vector::<M>::zero(self.dims()), elimination.last_but_one());
        Place { q, tangent, bend, orientation, determinants, slopes, regularity, last_but_one }
    }

    /// Predicts and corrects the place at `distance` along the tangent of another; the curve between them is not
    /// checked.
    pub(super) fn at(&self, from: &Place<M>, distance: M::Scalar) -> Tried<M, Place<M>> {
        let guess = self.moved(&from.q, &(from.tangent * distance + from.bend * (distance * distance)));
        let found = self.correct(guess, &from.tangent)?;
        Ok(found.map(|(q, elimination)| self.place(q, &elimination, &from.tangent)))
    }

    /// True if the step from `from` to `q` goes forward on an arc of one curve.
    pub(super) fn is_arc(
        &self,
        from: &Place<M>,
        q: &M::Coordinates,
        tangent: &Vector<M>,
        regularity: M::Scalar,
        options: &Options<M::Scalar>,
    ) -> bool {
        self.difference(q, &from.q).dot(&from.tangent) > M::Scalar::zero()
            && self.are_joined(from, q, tangent, regularity, options)
    }

    /// True if `from` and `q` are on an arc of one curve: the tangent turns by at most the largest turn of the
    /// options, and the step deviates from neither tangent by more than the turn between them explains. A jump to a
    /// neighbouring curve does not satisfy this.
    pub(super) fn are_joined(
        &self,
        from: &Place<M>,
        q: &M::Coordinates,
        tangent: &Vector<M>,
        regularity: M::Scalar,
        options: &Options<M::Scalar>,
    ) -> bool {
        let (step, turn) = (self.difference(q, &from.q), (*tangent - from.tangent).norm());
        let rounding_error =
            self.rounding_error(q) * real(EQUAL_ULPS) / regularity.max(M::Scalar::default_epsilon().sqrt());
        let most = step.norm() * (turn + real(SLACK)) + rounding_error;
        turn <= options.largest_turn && step.across(&from.tangent) <= most && step.across(tangent) <= most
    }

    /// True if the sign of the determinant of a group is not that of the error of the position, which is that of its
    /// coordinates divided by the regularity of [J A].
    pub(super) fn is_resolved(&self, place: &Place<M>, group: usize) -> bool {
        let error = self.rounding_error(&place.q) * real(EQUAL_ULPS);
        Blocks::of(&*self.mechanism, &self.mechanism.pose_at(&place.q)).regularity(group) * place.regularity > error
    }

    /// Gives each determinant whose sign is not resolved the sign that it had at the place before.
    pub(super) fn keep_unresolved_signs(&self, from: &Place<M>, place: &mut Place<M>) {
        for group in 0..self.mechanism.dims().2.count() {
            let before = if from.determinants[group].is_zero() { from.slopes[group] } else { from.determinants[group] };
            let now = place.determinants[group];
            if now * before < M::Scalar::zero() && !self.is_resolved(place, group) {
                place.determinants[group] = -now;
            }
        }
    }

    /// Estimates the distance from one place towards another at which two pivots may be zero at once; `None` if they do
    /// not approach zero. At such a change point neither the orientation nor a determinant need change its sign.
    pub(super) fn double_zero(
        &self,
        from: &Place<M>,
        to: &Place<M>,
        length: M::Scalar,
    ) -> Result<Option<M::Scalar>, PathErrorOf<M>> {
        if self.mechanism.dims().0.count() < 2 {
            return Ok(None);
        }
        let sum = from.last_but_one + to.last_but_one;
        let distance = length * (from.last_but_one / sum);
        if !distance.is_finite() {
            return Ok(None);
        }
        let at = self.linear(&self.moved(&from.q, &(from.tangent * distance)))?;
        let between = Elimination::<M>::new(at.jacobian).last_but_one();
        Ok((between <= sum * real(DOUBLE_ZERO_SHARE)).then_some(distance))
    }

    /// The groups that are singular at a change point: their regularity is at most [`nearly_zero`], since small
    /// errors of Psi move the change point, a double root, by their square root.
    pub(super) fn singular_groups(&self, q: &M::Coordinates) -> Groups<M::Name> {
        let mut groups = Groups::none(self.mechanism.group_list());
        let blocks = Blocks::of(&*self.mechanism, &self.mechanism.pose_at(q));
        for place in 0..self.mechanism.dims().2.count() {
            if blocks.regularity(place) <= nearly_zero() {
                groups.insert(place);
            }
        }
        groups
    }

    /// Adds the groups whose determinants have fallen by the factor [`nearly_zero`] since another place. Where all
    /// terms of an equation vanish at the crossing, the regularity of its block is 0/0.
    pub(super) fn add_vanished_groups(&self, crossing: &mut Crossing<M>, from: &Place<M>) {
        let determinants = self.determinants(&crossing.q);
        let pairs = determinants.iter().zip(&from.determinants);
        for (place, (at, before)) in pairs.enumerate() {
            if at.abs() <= before.abs() * nearly_zero() && !before.is_zero() {
                crossing.groups.insert(place);
            }
        }
    }

    /// The place at a crossing; the determinants of singular groups, whose signs are those of rounding errors, are set
    /// to zero.
    pub(super) fn at_crossing(&self, crossing: &Crossing<M>, tangent: Vector<M>, orientation: M::Scalar) -> Place<M> {
        let [mut determinants, slopes] = self.determinants_along(&crossing.q, &tangent);
        for (place, determinant) in determinants.iter_mut().enumerate() {
            if crossing.groups.contains(place) {
                *determinant = M::Scalar::zero();
            }
        }
        Place {
            q: crossing.q,
            tangent,
            bend: Vector::<M>::zero(self.dims()),
            orientation,
            determinants,
            slopes,
            regularity: M::Scalar::zero(),
            last_but_one: M::Scalar::zero(),
        }
    }

    /// Returns the tangent nearest to these rates, in their direction.
    pub(super) fn choose(&self, tangents: &[Vector<M>], rates: &M::Rates) -> Result<Vector<M>, PathErrorOf<M>> {
        let direction = self.direction(rates);
        if !direction.is_finite() {
            return Err(PositionError::NotFinite {
                mechanism: self.mechanism.name(),
                quantity: Name::from_static("the direction"),
            }
            .into());
        }
        let direction = direction * direction.largest().recip();
        let mut nearest = None;
        for tangent in tangents {
            let along = tangent.dot(&direction);
            if along.abs() > nearest.map_or(nearly_zero(), |(most, _): (M::Scalar, _)| most) {
                nearest = Some((along.abs(), if along < M::Scalar::zero() { -*tangent } else { *tangent }));
            }
        }
        nearest.map(|(_, tangent)| tangent).ok_or(PathError::NoDirection { mechanism: self.mechanism.name() })
    }

    pub(super) fn lost(&self, q: &M::Coordinates, iterations: usize, why: Rejection) -> PathErrorOf<M> {
        let (_, group) = self.least_regular_group(q);
        let Rejection { residual, regularity } = why;
        PathError::Lost { mechanism: self.mechanism.name(), group, iterations, residual, regularity }
    }

    /// The regularity and the name of the group that is nearest to singular.
    pub(super) fn least_regular_group(&self, q: &M::Coordinates) -> (M::Scalar, M::Name) {
        Blocks::of(&*self.mechanism, &self.mechanism.pose_at(q)).least_regular()
    }
}
