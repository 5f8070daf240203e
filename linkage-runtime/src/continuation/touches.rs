//! Touches on a path within one group: its motions touch others there, and go on.
//!
//! No pivot changes its sign, and no step is stopped: the last pivot is proportional to the square of the distance, and has
//! a minimum. The steps before and after each minimum are searched.

use super::Groups;
use super::path::Path;
use super::place::Place;
use crate::jacobian::ulp::nearly_zero;
use crate::scalar::arithmetic::*;
use crate::{D, Mechanism, PathErrorOf, real};

/// A minimum of the regularity above this is no touch: within a step of a touch it is about the square of the distance.
const LARGEST: f64 = 0.25;

/// The last two places of a path.
pub(crate) struct Touches<M: Mechanism> {
    before: Option<Place<M>>,
    last: Place<M>,
}

/// A position on a path at which its motion touches another.
pub(crate) struct TouchOnPath<M: Mechanism> {
    pub(crate) position: M::Coordinates,
    pub(crate) groups: Groups<M::Name>,
    /// True if it lies before the place of the path next to it.
    pub(crate) is_before: bool,
}

impl<M: Mechanism<V = D<1>>> Touches<M> {
    /// Begins at the current place of a path.
    pub(crate) fn new(path: &Path<'_, M>) -> Self {
        Self { before: None, last: path.place.clone() }
    }

    /// After a step, the touch nearest to the place at which the step began.
    pub(crate) fn after_step(&mut self, path: &Path<'_, M>) -> Result<Option<TouchOnPath<M>>, PathErrorOf<M>> {
        let next = path.place.clone();
        let found = self.nearest(path, Some(&next))?;
        self.before = Some(core::mem::replace(&mut self.last, next));
        Ok(found)
    }

    /// After the last step, the touch before its end.
    pub(crate) fn at_end(&self, path: &Path<'_, M>) -> Result<Option<TouchOnPath<M>>, PathErrorOf<M>> {
        self.nearest(path, None)
    }

    /// The touch nearest to the last place, if the regularity has a minimum there.
    fn nearest(&self, path: &Path<'_, M>, next: Option<&Place<M>>) -> Result<Option<TouchOnPath<M>>, PathErrorOf<M>> {
        let (place, curve) = (&self.last, &path.curve);
        let neighbours = [self.before.as_ref(), next];
        // Of two equal ones the first.
        let is_minimum = self.before.as_ref().is_none_or(|before| before.regularity > place.regularity)
            && next.is_none_or(|next| next.regularity >= place.regularity);
        // At a change point that was found it is zero.
        if !is_minimum || place.regularity > real(LARGEST) || place.regularity.is_zero() {
            return Ok(None);
        }
        let lengths = neighbours.map(|other| other.map(|other| curve.difference(&other.q, &place.q).norm()));
        let reach = lengths.iter().flatten().fold(M::Scalar::zero(), |most, &length| most.max(length));
        let Some(mut crossing) = curve.touch(&place.q, reach, &place.tangent)? else { return Ok(None) };
        let way = curve.difference(&crossing.q, &place.q);
        let is_before = way.dot(&place.tangent) < M::Scalar::zero();
        let is_between = lengths[usize::from(!is_before)].is_some();
        let towards = if is_before { place.reversed() } else { place.clone() };
        crossing.put_first(&towards.tangent);
        let tangent = crossing.tangents()[0];
        let is_on_path = way.norm() <= nearly_zero()
            || curve.is_arc(&towards, &crossing.q, &tangent, place.regularity, &path.options);
        let found = TouchOnPath { position: crossing.q, groups: crossing.groups, is_before };
        Ok((is_between && is_on_path).then_some(found))
    }
}
