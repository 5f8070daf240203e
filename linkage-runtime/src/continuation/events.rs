//! The events of a step: dead points, limits and targets of the input, and zeros of a watched function.

use super::change_point::Crossing;
use super::curve::Curve;
use super::groups::Groups;
use super::joint_ranges::JointEnd;
use super::options::Options;
use super::place::Place;
use super::tangents::Tangents;
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero};
use crate::jacobian::{Sample, VectorOf as Vector, first_resolved_zero, first_zero, root};
use crate::scalar::arithmetic::*;
use crate::{BorrowedName, D, Dim, Mechanism, Name, PathError, PathErrorOf, PositionError, RangeEnd, real};

/// An event of a path. The step ends at the event, located to rounding error.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound(serialize = "R: serde::Serialize, N: serde::Serialize"))
)]
pub enum Event<R, N: BorrowedName = &'static str> {
    /// The determinant of a group of unknowns changes its sign: the input reverses, and the path continues.
    DeadPoint {
        /// The unknowns of the group.
        group: N,
    },
    /// Motions of the mechanism cross: [J A] loses rank.
    ChangePoint {
        /// All groups that are singular there.
        groups: Groups<N>,
        /// The derivatives of the coordinates by arc length along each motion.
        tangents: Tangents<R>,
    },
    /// The input is at an end of its range.
    Limit,
    /// A coordinate or an output is at an end of the range that the mechanism declares.
    JointRange {
        /// Its name.
        of: N,
        /// The end of its range.
        end: RangeEnd,
    },
    /// The watched function is zero.
    Zero,
}

/// The end of a step and its event.
pub(super) struct End<M: Mechanism> {
    pub(super) place: Place<M>,
    /// At a change point, the place on the motion of this step: the path may go on along another one.
    pub(super) arrived: Option<Place<M>>,
    pub(super) event: Option<Event<M::Rates, M::Name>>,
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

/// A value at a distance along the tangent at the start of a step, at a position near the curve.
type Near<'n, M> = &'n dyn Fn(<M as Mechanism>::Scalar) -> <M as Mechanism>::Scalar;

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
    ) -> Result<Option<End<M>>, PathErrorOf<M>> {
        self.keep_unresolved_signs(from, &mut end.place);
        let is_known = [false, matches!(end.event, Some(Event::ChangePoint { .. }))];
        let mut arrived = end.arrived.take().unwrap_or_else(|| end.place.clone());
        for (index, group) in self.mechanism.groups().map(|group| group.name).enumerate() {
            let along = |place: &Place<M>| [place.determinants[index], place.slopes[index]];
            let is_resolved = |place: &Place<M>| self.is_resolved(place, index);
            match self.find_zero(from, &arrived, is_known, along, is_resolved)? {
                SignChange::None => {}
                SignChange::Lost => return Ok(None),
                SignChange::At(mut place) => {
                    place.forget_sign(&self.mechanism, group);
                    arrived = place.clone();
                    end = End {
                        place,
                        arrived: None,
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
                arrived.q = end.place.q;
                let event = end.event.or((!is_target).then_some(Event::Limit));
                end = End { event, is_target, ..end };
                continue;
            }
            let along = |place: &Place<M>| [self.input_distance(gap(place)), place.tangent.inputs[0]];
            match self.find_zero(from, &arrived, [false; 2], along, |_| true)? {
                SignChange::None => {}
                SignChange::Lost => return Ok(None),
                SignChange::At(place) => {
                    let place = self.with_exact_input(place, limit)?;
                    arrived = place.clone();
                    end = End {
                        place,
                        arrived: None,
                        event: (!is_target).then_some(Event::Limit),
                        is_target,
                        resume: Resume::OnTheWay,
                    };
                }
            }
        }
        if options.joint_ranges {
            for joint in JointEnd::all::<M>(&self.mechanism, &from.q) {
                if ![from, &arrived].iter().all(|place| self.room_along(place, &joint)[0].is_finite()) {
                    let quantity = Name::from_static("the value of a range");
                    return Err(PositionError::NotFinite { mechanism: self.mechanism.name(), quantity }.into());
                }
                let along = |place: &Place<M>| self.room_along(place, &joint);
                let is_known = !self.has_room(from, &joint);
                let near = |distance: M::Scalar| self.room(&self.between(from, &arrived, distance), &joint);
                let near = joint.is_output.then_some(&near as Near<'_, M>);
                match self.find_resolved_zero(from, &arrived, [is_known, false], along, |_| true, near)? {
                    SignChange::None => {}
                    SignChange::Lost => return Ok(None),
                    SignChange::At(place) => {
                        let place = self.at_joint_end(place, &joint)?;
                        arrived = place.clone();
                        let event = Some(Event::JointRange { of: joint.of, end: joint.end });
                        end = End { place, arrived: None, event, is_target: false, resume: Resume::OnTheWay };
                    }
                }
            }
        }
        if let Some(watch) = wanted.watch {
            let value = |place: &Place<M>| watch(&place.q, &self.rates(&place.tangent));
            if ![value(from), value(&arrived)].iter().all(M::Scalar::is_finite) {
                let quantity = Name::from_static("the watched function");
                return Err(PositionError::NotFinite { mechanism: self.mechanism.name(), quantity }.into());
            }
            let way = self.difference(&arrived.q, &from.q).norm();
            let bend = (arrived.tangent - from.tangent) * way.recip();
            let along = |place: &Place<M>| {
                let little = self.little(&place.q);
                let near = self.moved(&place.q, &(place.tangent * little));
                let here = value(place);
                [here, (watch(&near, &self.rates(&(place.tangent + bend * little))) - here) / little]
            };
            match self.find_zero(from, &arrived, [wanted.is_at_zero, false], along, |_| true)? {
                SignChange::None => {}
                SignChange::Lost => return Ok(None),
                SignChange::At(place) => {
                    end =
                        End { place, arrived: None, event: Some(Event::Zero), is_target: false, resume: Resume::AtZero }
                }
            }
        }
        self.keep_unresolved_signs(from, &mut end.place);
        Ok(Some(end))
    }

    /// Finds the first place between two at which a value changes its sign, from the values and their derivatives along
    /// the curve. A zero at an end where it is known is none.
    fn find_zero(
        &self,
        from: &Place<M>,
        end: &Place<M>,
        is_known: [bool; 2],
        value: impl Fn(&Place<M>) -> [M::Scalar; 2],
        is_resolved: impl Fn(&Place<M>) -> bool,
    ) -> Result<SignChange<M>, PathErrorOf<M>> {
        self.find_resolved_zero(from, end, is_known, value, is_resolved, None)
    }

    /// Finds the same of a value that may oscillate between both places, from its values near the curve.
    fn find_resolved_zero(
        &self,
        from: &Place<M>,
        end: &Place<M>,
        is_known: [bool; 2],
        value: impl Fn(&Place<M>) -> [M::Scalar; 2],
        is_resolved: impl Fn(&Place<M>) -> bool,
        near: Option<Near<'_, M>>,
    ) -> Result<SignChange<M>, PathErrorOf<M>> {
        let sample = |at: M::Scalar, place: &Place<M>| {
            let [value, slope] = value(place);
            Sample { at, value, slope: slope / place.tangent.dot(&from.tangent) }
        };
        let at = |distance: M::Scalar| self.at(from, distance)?.map_err(|_| Missed::Place);
        let mut start = sample(M::Scalar::zero(), from);
        if is_known[0] {
            start.value = M::Scalar::zero();
        }
        let distance = self.difference(&end.q, &from.q).dot(&from.tangent);
        let ends = [start, sample(distance, end)];
        let smallest = self.rounding_error(&from.q);
        let between = |distance| {
            let place = at(distance)?;
            let mut between = sample(distance, &place);
            if !is_resolved(&place) {
                between.value = M::Scalar::zero();
            }
            Ok(between)
        };
        let found = match near {
            Some(near) => first_resolved_zero(ends, smallest, near, between),
            None => first_zero(ends, smallest, between),
        };
        let [low, high] = match found {
            // At the end itself it is known.
            Ok(Some([_, high])) if high.value.is_zero() && is_known[1] => return Ok(SignChange::None),
            Ok(Some(around)) => around,
            Ok(None) => return Ok(SignChange::None),
            Err(Missed::Place) => return Ok(SignChange::Lost),
            Err(Missed::Error(error)) => return Err(error),
        };
        let values = [low.value, high.value];
        let root = root([low.at, high.at], values, smallest * real(0.25), |distance| {
            Ok::<_, Missed<M::Name>>(Some(value(&at(distance)?)[0]))
        });
        let root = match root {
            Ok(root) => root.unwrap_or(high.at),
            Err(Missed::Place) => return Ok(SignChange::Lost),
            Err(Missed::Error(error)) => return Err(error),
        };
        Ok(if root <= M::Scalar::zero() {
            SignChange::At(from.clone())
        } else if root >= distance {
            SignChange::At(end.clone())
        } else {
            self.at(from, root)?.map_or(SignChange::Lost, SignChange::At)
        })
    }

    /// A position near the curve between two places, at this distance along the tangent of the first: on the cubic through
    /// both with their tangents.
    fn between(&self, from: &Place<M>, end: &Place<M>, distance: M::Scalar) -> M::Coordinates {
        let chord = self.difference(&end.q, &from.q);
        let way = chord.dot(&from.tangent);
        let x = distance / way;
        let y = M::Scalar::one() - x;
        let slopes = [from.tangent * way, end.tangent * (way / end.tangent.dot(&from.tangent))];
        let along = chord * (x * x * (y + y + M::Scalar::one())) + slopes[0] * (x * y * y) - slopes[1] * (x * x * y);
        self.moved(&from.q, &along)
    }

    /// Gives a place exactly this input and corrects the other coordinates, unless the input is at rest.
    pub(super) fn with_exact_input(&self, place: Place<M>, input: M::Scalar) -> Result<Place<M>, PathErrorOf<M>> {
        self.with_exact(place, self.mechanism.dims().0.count(), input)
    }

    /// Gives a place exactly this value of a coordinate, by its column in [J A], and corrects the others, unless it is at
    /// rest.
    pub(super) fn with_exact(
        &self,
        place: Place<M>,
        column: usize,
        value: M::Scalar,
    ) -> Result<Place<M>, PathErrorOf<M>> {
        let q = Self::with_coordinate(&place.q, column, value);
        let moves = place.tangent.get(column).abs() > nearly_zero() && place.regularity > nearly_zero();
        if moves && let Ok((q, elimination)) = self.correct(q, &Vector::<M>::unit(place.tangent.dims(), column))? {
            return Ok(self.place(q, &elimination, &place.tangent));
        }
        Ok(Place { q, ..place })
    }
}

/// The reason why a place is not known.
enum Missed<N: BorrowedName> {
    /// It is not found: a shorter step is needed.
    Place,
    Error(PathError<N>),
}

impl<N: BorrowedName> From<PathError<N>> for Missed<N> {
    fn from(error: PathError<N>) -> Self {
        Self::Error(error)
    }
}

enum SignChange<M: Mechanism> {
    None,
    Lost,
    At(Place<M>),
}
