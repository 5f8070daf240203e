//! What happens on a step, each event where it happens.

use super::change_point::Crossing;
use super::curve::Curve;
use super::groups::Groups;
use super::options::Options;
use super::place::{Place, weak};
use super::tangents::Tangents;
use super::vector::Vector;
use crate::{Error, Mechanism, Real, real};

/// A distance of this many roundings of the coordinates is none.
const ROUNDINGS: f64 = 16.0;

/// What a path meets. Each ends the step that meets it, so that the position is that of the event, to rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event<Q> {
    /// The determinant of a group of unknowns changes its sign: the input turns back, and the path goes on.
    DeadPoint {
        /// The unknowns of the group.
        group: &'static str,
    },
    /// Motions of the mechanism cross: [J A] loses rank.
    ChangePoint {
        /// The groups that are singular there, all of them.
        groups: Groups,
        /// The rates of the coordinates along the motions.
        tangents: Tangents<Q>,
    },
    /// The input is at an end of its range.
    Limit,
    /// The number that is watched is zero.
    Zero,
}

/// Where a step ends, and why there.
pub(super) struct End<M: Mechanism<T, U, 1>, T: Real, const U: usize> {
    pub(super) place: Place<M, T, U>,
    pub(super) event: Option<Event<M::Coordinates>>,
    pub(super) is_target: bool,
    pub(super) stands: Stands<M::Coordinates, T, U>,
}

/// What is to be known of the end of a step for the next one.
#[derive(Clone, Copy)]
pub(super) enum Stands<Q, T, const U: usize> {
    OnTheWay,
    AtZero,
    AtChangePoint,
    /// At a change point where nothing has been chosen yet.
    Undecided(Crossing<Q, T, U>),
}

/// A number that is watched, from the position and the rates of the coordinates along the path.
pub(super) type Watch<'w, Q, T> = &'w dyn Fn(&Q, &Q) -> T;

/// What a step looks for beside dead points.
pub(super) struct Wanted<'w, Q, T> {
    pub(super) target: Option<T>,
    pub(super) watch: Option<Watch<'w, Q, T>>,
    /// Whether the watched number is zero where the step begins.
    pub(super) is_at_zero: bool,
}

impl<M, T, const U: usize> Curve<'_, M, T, U>
where
    T: Real,
    M: Mechanism<T, U, 1>,
{
    /// The first event on the arc from a place to `end`, or `end` itself; `None` where a point between them is not
    /// found.
    pub(super) fn first_event(
        &self,
        from: &Place<M, T, U>,
        mut end: End<M, T, U>,
        wanted: &Wanted<'_, M::Coordinates, T>,
        options: &Options<T>,
    ) -> Result<Option<End<M, T, U>>, Error> {
        for (index, group) in M::GROUPS.iter().map(|group| group.name).enumerate() {
            let determinant = |place: &Place<M, T, U>| place.determinants.as_ref()[index];
            match self.cut(from, &end.place, determinant)? {
                Cut::None => {}
                Cut::Lost => return Ok(None),
                Cut::At(mut place) => {
                    place.forget_sign(group);
                    end = End {
                        place,
                        event: Some(Event::DeadPoint { group }),
                        is_target: false,
                        stands: Stands::OnTheWay,
                    };
                }
            }
        }
        // Between dead points the input goes one way.
        let limits = options.range.into_iter().flatten().map(|limit| (limit, false));
        for (limit, is_target) in limits.chain(wanted.target.map(|input| (input, true))) {
            let gap = |place: &Place<M, T, U>| Self::input(&place.q) - limit;
            // At a change point the input is met where it is met to rounding.
            let is_crossing = matches!(end.event, Some(Event::ChangePoint { .. }));
            let slack = if is_crossing { self.rounding(&end.place.q) * real(ROUNDINGS) } else { T::zero() };
            if self.input_distance(gap(&end.place)).abs() <= slack && !gap(from).is_zero() {
                end.place.q = Self::with_input(&end.place.q, limit);
                let event = end.event.or((!is_target).then_some(Event::Limit));
                end = End { event, is_target, ..end };
                continue;
            }
            match self.cut(from, &end.place, gap)? {
                Cut::None => {}
                Cut::Lost => return Ok(None),
                Cut::At(place) => {
                    let place = self.with_exact_input(place, limit)?;
                    end =
                        End { place, event: (!is_target).then_some(Event::Limit), is_target, stands: Stands::OnTheWay };
                }
            }
        }
        if let Some(watch) = wanted.watch {
            let value = |place: &Place<M, T, U>| watch(&place.q, &self.rates(&place.q, &place.tangent));
            if ![value(from), value(&end.place)].iter().all(T::is_finite) {
                return Err(Error::NotFinite { mechanism: M::NAME, quantity: "the watched number" });
            }
            if !wanted.is_at_zero {
                match self.cut(from, &end.place, value)? {
                    Cut::None => {}
                    Cut::Lost => return Ok(None),
                    Cut::At(place) => {
                        end = End { place, event: Some(Event::Zero), is_target: false, stands: Stands::AtZero }
                    }
                }
            }
        }
        Ok(Some(end))
    }

    /// The place between two at which a number changes its sign.
    fn cut(
        &self,
        from: &Place<M, T, U>,
        end: &Place<M, T, U>,
        value: impl Fn(&Place<M, T, U>) -> T,
    ) -> Result<Cut<M, T, U>, Error> {
        let values = [value(from), value(end)];
        let changes =
            |[low, high]: [T; 2]| (low < T::zero() && high > T::zero()) || (low > T::zero() && high < T::zero());
        if !changes(values) {
            return Ok(Cut::None);
        }
        let distance = self.difference(&end.q, &from.q).dot(&from.tangent);
        let Some(root) = self.sign_change(from, [T::zero(), distance], values, value)? else { return Ok(Cut::Lost) };
        Ok(if root <= T::zero() {
            Cut::At(from.clone())
        } else if root >= distance {
            Cut::At(end.clone())
        } else {
            self.at(from, root)?.map_or(Cut::Lost, Cut::At)
        })
    }

    /// A place with this input to the last digit, where the input moves it at all.
    pub(super) fn with_exact_input(&self, place: Place<M, T, U>, input: T) -> Result<Place<M, T, U>, Error> {
        let q = Self::with_input(&place.q, input);
        let moves = place.tangent.input.abs() > weak() && place.regularity > weak();
        if moves && let Ok((q, elimination)) = self.correct(q, &Vector::unit(U))? {
            return Ok(self.place(q, &elimination, &place.tangent));
        }
        Ok(Place { q, ..place })
    }
}

enum Cut<M: Mechanism<T, U, 1>, T: Real, const U: usize> {
    None,
    Lost,
    At(Place<M, T, U>),
}
