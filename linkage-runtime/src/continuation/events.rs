//! The events of a step: dead points, limits and targets of the input, and zeros of a watched function.

use super::change_point::Crossing;
use super::curve::Curve;
use super::groups::Groups;
use super::options::Options;
use super::place::Place;
use super::tangents::Tangents;
use crate::jacobian::VectorOf as Vector;
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero};
use crate::scalar::arithmetic::*;
use crate::{D, Dim, Mechanism, PathError, PositionError, real};

/// An event of a path. The step ends at the event, located to rounding error.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Event<R> {
    /// The determinant of a group of unknowns changes its sign: the input reverses, and the path continues.
    DeadPoint {
        /// The unknowns of the group.
        group: &'static str,
    },
    /// Motions of the mechanism cross: [J A] loses rank.
    ChangePoint {
        /// All groups that are singular there.
        groups: Groups,
        /// The derivatives of the coordinates by arc length along each motion.
        tangents: Tangents<R>,
    },
    /// The input is at an end of its range.
    Limit,
    /// The watched function is zero.
    Zero,
}

/// The end of a step and its event.
pub(super) struct End<M: Mechanism> {
    pub(super) place: Place<M>,
    pub(super) event: Option<Event<M::Rates>>,
    pub(super) is_target: bool,
    pub(super) resume: Resume<M>,
}

/// The state carried over to the next step.
pub(super) enum Resume<M: Mechanism> {
    OnTheWay,
    AtZero,
    AtChangePoint,
    /// At a change point, with no motion chosen yet.
    Undecided(Crossing<M>),
}

impl<M: Mechanism> Clone for Resume<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Resume<M> {}

/// A function to watch, of the position and of the rates of the coordinates along the path.
pub(super) type Watch<'w, M> =
    &'w dyn Fn(&<M as Mechanism>::Coordinates, &<M as Mechanism>::Rates) -> <M as Mechanism>::Scalar;

/// The events that a step looks for in addition to dead points.
pub(super) struct Wanted<'w, M: Mechanism> {
    pub(super) target: Option<M::Scalar>,
    pub(super) watch: Option<Watch<'w, M>>,
    /// True if the watched function is zero at the start of the step.
    pub(super) is_at_zero: bool,
}

impl<M> Curve<'_, M>
where
    M: Mechanism<V = D<1>>,
{
    /// Finds the first event on the arc from a place to `end`, or returns `end` itself; `None` if a point between them
    /// is not found.
    pub(super) fn first_event(
        &self,
        from: &Place<M>,
        mut end: End<M>,
        wanted: &Wanted<'_, M>,
        options: &Options<M::Scalar>,
    ) -> Result<Option<End<M>>, PathError> {
        for (index, group) in M::GROUPS.iter().map(|group| group.name).enumerate() {
            let determinant = |place: &Place<M>| place.determinants[index];
            match self.find_zero(from, &end.place, determinant)? {
                SignChange::None => {}
                SignChange::Lost => return Ok(None),
                SignChange::At(mut place) => {
                    place.forget_sign(group);
                    end = End {
                        place,
                        event: Some(Event::DeadPoint { group }),
                        is_target: false,
                        resume: Resume::OnTheWay,
                    };
                }
            }
        }
        // Between dead points the input is monotonic.
        let limits = options.range.into_iter().flatten().map(|limit| (limit, false));
        for (limit, is_target) in limits.chain(wanted.target.map(|input| (input, true))) {
            let gap = |place: &Place<M>| Self::input(&place.q) - limit;
            // A change point counts as at the limit or target if its input agrees to rounding error.
            let is_crossing = matches!(end.event, Some(Event::ChangePoint { .. }));
            let slack =
                if is_crossing { self.rounding_error(&end.place.q) * real(EQUAL_ULPS) } else { M::Scalar::zero() };
            if self.input_distance(gap(&end.place)).abs() <= slack && !gap(from).is_zero() {
                end.place.q = Self::with_input(&end.place.q, limit);
                let event = end.event.or((!is_target).then_some(Event::Limit));
                end = End { event, is_target, ..end };
                continue;
            }
            match self.find_zero(from, &end.place, gap)? {
                SignChange::None => {}
                SignChange::Lost => return Ok(None),
                SignChange::At(place) => {
                    let place = self.with_exact_input(place, limit)?;
                    end =
                        End { place, event: (!is_target).then_some(Event::Limit), is_target, resume: Resume::OnTheWay };
                }
            }
        }
        if let Some(watch) = wanted.watch {
            let value = |place: &Place<M>| watch(&place.q, &self.rates(&place.tangent));
            if ![value(from), value(&end.place)].iter().all(M::Scalar::is_finite) {
                let quantity = "the watched function";
                return Err(PositionError::NotFinite { mechanism: M::NAME, quantity }.into());
            }
            if !wanted.is_at_zero {
                match self.find_zero(from, &end.place, value)? {
                    SignChange::None => {}
                    SignChange::Lost => return Ok(None),
                    SignChange::At(place) => {
                        end = End { place, event: Some(Event::Zero), is_target: false, resume: Resume::AtZero }
                    }
                }
            }
        }
        Ok(Some(end))
    }

    /// Finds the place between two at which a value changes its sign.
    fn find_zero(
        &self,
        from: &Place<M>,
        end: &Place<M>,
        value: impl Fn(&Place<M>) -> M::Scalar,
    ) -> Result<SignChange<M>, PathError> {
        let values = [value(from), value(end)];
        let changes = |[low, high]: [M::Scalar; 2]| {
            (low < M::Scalar::zero() && high > M::Scalar::zero())
                || (low > M::Scalar::zero() && high < M::Scalar::zero())
        };
        if !changes(values) {
            return Ok(SignChange::None);
        }
        let distance = self.difference(&end.q, &from.q).dot(&from.tangent);
        let Some(root) = self.sign_change(from, [M::Scalar::zero(), distance], values, value)? else {
            return Ok(SignChange::Lost);
        };
        Ok(if root <= M::Scalar::zero() {
            SignChange::At(from.clone())
        } else if root >= distance {
            SignChange::At(end.clone())
        } else {
            self.at(from, root)?.map_or(SignChange::Lost, SignChange::At)
        })
    }

    /// Gives a place exactly this input and corrects the other coordinates, unless the input is at rest.
    pub(super) fn with_exact_input(&self, place: Place<M>, input: M::Scalar) -> Result<Place<M>, PathError> {
        let q = Self::with_input(&place.q, input);
        let moves = place.tangent.inputs[0].abs() > nearly_zero() && place.regularity > nearly_zero();
        if moves && let Ok((q, elimination)) = self.correct(q, &Vector::<M>::unit(M::U::COUNT))? {
            return Ok(self.place(q, &elimination, &place.tangent));
        }
        Ok(Place { q, ..place })
    }
}

enum SignChange<M: Mechanism> {
    None,
    Lost,
    At(Place<M>),
}
