//! One step of a path: a trial of a length, and the change point that ends it.

use super::change_point::{Crossing, Touch};
use super::curve::{Curve, Rejection, Tried};
use super::events::{End, Event, Resume, Wanted};
use super::options::AtChangePoint;
use super::path::Path;
use super::place::Place;
use super::tangents::Tangents;
use crate::jacobian::VectorOf as Vector;
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero};
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::{D, Dim, Mechanism, PathErrorOf, real};

/// A change point up to this many step lengths ahead ends the step, so that no step ends just before one.
const AHEAD: f64 = 1.25;

/// At a dead point [J A] is regular. Where its regularity is less than this, the dead point may be a change point at
/// which an even number of pivots vanishes, so that the orientation does not show it.
const DOUBTFUL: f64 = 1e-3;

impl<M> Path<'_, M>
where
    M: Mechanism<V = D<1>>,
{
    /// Tries a step of this length; returns its end, at the first event, and the length tried.
    pub(super) fn attempt(&self, trial: M::Scalar, wanted: &Wanted<'_, M>) -> Tried<M, (End<M>, M::Scalar)> {
        let (curve, from) = (&self.curve, &self.place);
        // If the tangent predicts that the input reaches its target within the step, the step is corrected at that
        // input.
        let aim = wanted.target.and_then(|target| {
            let distance = curve.input_distance(target - Curve::<'_, M>::input(&self.place.q)) / from.tangent.inputs[0];
            (distance > M::Scalar::zero() && distance <= trial).then_some((target, distance))
        });
        let tried = aim.map_or(trial, |(_, distance)| distance);
        let found = match aim {
            Some((target, distance)) => {
                let guess = curve.moved(&from.q, &(from.tangent * distance));
                let guess = Curve::<'_, M>::with_input(&guess, target);
                let found = curve
                    .correct(guess, &Vector::<M>::unit(from.tangent.dims(), from.tangent.unknowns.dim().count()))?;
                found.map(|(q, elimination)| curve.place(q, &elimination, &from.tangent))
            }
            None => curve.at(from, trial)?,
        };
        let rejection = match &found {
            Ok(place) => Rejection { residual: 0.0, regularity: to_f64(place.regularity) },
            Err(rejection) => *rejection,
        };
        let flips = |place: &Place<M>| place.orientation * from.orientation < M::Scalar::zero();
        let is_nearly_singular = |place: &Place<M>| place.regularity < nearly_zero();
        // If the target is nearer than the rounding errors of the coordinates, the corrected step may point backward.
        let is_there = aim.is_some_and(|(_, distance)| distance <= curve.rounding_error(&from.q) * real(EQUAL_ULPS));
        let arc = found.as_ref().ok().filter(|place| {
            let (q, tangent) = (&place.q, &place.tangent);
            curve.is_arc(from, q, tangent, from.regularity, &self.options)
                || (is_there && curve.are_joined(from, q, tangent, from.regularity, &self.options))
        });
        let changes_branch = |place: &Place<M>| from.sign_changes(place).is_some();
        // The distance at which a change point is sought, if anything suggests one.
        let guess = match &found {
            Ok(place) if flips(place) => Some(tried * (from.orientation / (from.orientation - place.orientation))),
            Ok(place) if changes_branch(place) => from.sign_changes(place).map(|share| tried * share),
            Ok(place) if arc.is_some() && !is_nearly_singular(place) => curve.double_zero(from, place, tried)?,
            _ => Some(tried),
        };
        if let Some(guess) = guess
            && let Some(end) = self.crossing_ahead(guess, tried)?
        {
            let found = curve.first_event(from, end, wanted, &self.options)?;
            return Ok(found.ok_or(rejection).map(|end| (end, tried)));
        }
        // Where motions touch, no shorter step comes any further.
        let rejected = || -> Tried<M, (End<M>, M::Scalar)> {
            let guess = curve.moved(&from.q, &(from.tangent * tried));
            if from.regularity < real(DOUBTFUL)
                && let Some(end) = self.touch_ahead(&guess, tried)?
            {
                let found = curve.first_event(from, end, wanted, &self.options)?;
                return Ok(found.ok_or(rejection).map(|end| (end, tried)));
            }
            Ok(Err(rejection))
        };
        let Some(place) = arc.filter(|place| !flips(place)) else { return rejected() };
        let mut place = place.clone();
        if place.orientation.is_zero() {
            place.orientation = from.orientation;
        }
        if place.regularity <= curve.rounding_error(&place.q) * real(EQUAL_ULPS) {
            let (_, group) = curve.least_regular_group(&place.q);
            place.forget_sign(&curve.mechanism, group);
        }
        let end = End { place, arrived: None, event: None, is_target: false, resume: Resume::OnTheWay };
        let mut found = curve.first_event(from, end, wanted, &self.options)?;
        // A dead point where [J A] is nearly singular is checked for a change point.
        let is_doubtful =
            |end: &End<M>| matches!(end.event, Some(Event::DeadPoint { .. })) && end.place.regularity < real(DOUBTFUL);
        if let Some(end) = found.as_ref().filter(|end| is_doubtful(end)) {
            let guess = curve.difference(&end.place.q, &from.q).dot(&from.tangent);
            let touch = match self.crossing_ahead(guess, tried)? {
                None => self.touch_ahead(&end.place.q, tried)?,
                found => found,
            };
            if let Some(crossing) = touch {
                found = curve.first_event(from, crossing, wanted, &self.options)?;
            }
        }
        match found {
            Some(end) => Ok(Ok((end, tried))),
            None => rejected(),
        }
    }

    /// Finds the change point within [`AHEAD`] times the distance `tried`, from a guess of its distance.
    fn crossing_ahead(&self, guess: M::Scalar, tried: M::Scalar) -> Result<Option<End<M>>, PathErrorOf<M>> {
        let (curve, from) = (&self.curve, &self.place);
        let guess = curve.moved(&from.q, &(from.tangent * guess));
        let reach = tried * real(AHEAD) + nearly_zero();
        let crossing = curve.crossing(&guess, reach, &from.tangent)?;
        Ok(crossing.and_then(|crossing| self.crossing_at(crossing, tried)))
    }

    /// Finds the change point near a dead point at which motions touch.
    fn touch_ahead(&self, near: &M::Coordinates, tried: M::Scalar) -> Result<Option<End<M>>, PathErrorOf<M>> {
        let crossing = self.curve.touch(near, tried, &self.place.tangent)?;
        Ok(crossing.and_then(|crossing| self.crossing_at(crossing, tried)))
    }

    /// The end of a step at a change point, if that lies within [`AHEAD`] times the distance `tried` on this motion.
    fn crossing_at(&self, mut crossing: Crossing<M>, tried: M::Scalar) -> Option<End<M>> {
        let (curve, from) = (&self.curve, &self.place);
        let at = crossing.q;
        let is_near = |q: &M::Coordinates| curve.difference(&at, q).norm() <= nearly_zero();
        if self.passed.as_ref().is_some_and(is_near) {
            return None;
        }
        let ahead = curve.difference(&crossing.q, &from.q).dot(&from.tangent);
        crossing.put_first(&from.tangent);
        curve.add_vanished_groups(&mut crossing, from);
        let kept = crossing.tangents()[0];
        let is_on_the_way = ahead > M::Scalar::zero()
            && ahead <= tried * real(AHEAD)
            && curve.is_arc(from, &crossing.q, &kept, from.regularity, &self.options);
        if !(is_on_the_way || is_near(&from.q)) {
            return None;
        }
        // The orientation changes its sign once for each pivot that passes zero.
        let orientation_if_kept = match crossing.defect % 2 {
            // Unknown where the motions touch: the pivot vanishes without a change of sign.
            _ if crossing.touch.is_some() => M::Scalar::zero(),
            1 => -from.orientation,
            _ => from.orientation,
        };
        let orientation_if_switched = if crossing.defect == 1 { from.orientation } else { M::Scalar::zero() };
        let (tangent, orientation, is_decided) = match (self.options.at_change_point, crossing.tangents()) {
            (AtChangePoint::Switch, &[_, other]) if crossing.is_complete => {
                (other.like(&kept), orientation_if_switched, true)
            }
            (policy, _) => (kept, orientation_if_kept, policy == AtChangePoint::Keep),
        };
        let mut place = curve.at_crossing(&crossing, tangent, orientation);
        let mut arrived = curve.turned(&place, kept, orientation);
        if let Some(Touch { groups, tangents: [one, other] }) = crossing.touch {
            for slopes in [&mut place.slopes, &mut arrived.slopes] {
                // Their determinants have double zeros.
                let doubles = slopes.iter_mut().enumerate().filter(|(place, _)| groups.contains(*place));
                doubles.for_each(|(_, slope)| *slope = M::Scalar::zero());
            }
            // This motion deviates from the tangent beyond as it did before, along the motion of the part that crosses.
            let back = curve.difference(&from.q, &crossing.q);
            let along = back.dot(&tangent);
            let [away, otherwise] = [back.dot(&one), back.dot(&other)];
            let bend = if away.abs() > otherwise.abs() { one * away } else { other * otherwise };
            if along.abs() > nearly_zero() {
                place.bend = bend * (along * along).recip();
            }
        }
        let tangents = crossing.tangents().iter().map(|tangent| curve.rates(tangent));
        let tangents = Tangents::new(tangents, crossing.is_complete);
        let event = Event::ChangePoint { groups: crossing.groups, tangents };
        let resume = if is_decided { Resume::AtChangePoint } else { Resume::Undecided(crossing) };
        Some(End { place, arrived: Some(arrived), event: Some(event), is_target: false, resume })
    }
}
