//! The follower: where it is, and how it takes a step.

use super::curve::{Curve, Refusal, Tried};
use super::events::{End, Event, Stands, Wanted, Watch};
use super::options::{AtChangePoint, Direction, Options};
use super::place::{Place, weak};
use super::tangent::Elimination;
use super::vector::Vector;
use crate::mechanism::other_group;
use crate::scalar::to_f64;
use crate::{Error, Mechanism, Real, position, real};

/// Where a path has come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step<Q, T = f64> {
    /// The position.
    pub position: Q,
    /// The rates of the coordinates along the path: the velocity ratios (W, 1), times the rate of the input, which is
    /// zero at a dead point.
    pub rates: Q,
    /// The length of the path so far, angles in radians and lengths beside those of their loops.
    pub length: T,
    /// What ended the step.
    pub event: Option<Event<Q>>,
}

/// A mechanism with one input, followed along its motion.
///
/// As an iterator it gives step after step, each a `Result`, and ends after a limit or an error.
pub struct Path<'a, M: Mechanism<T, U, 1>, T: Real, const U: usize> {
    curve: Curve<'a, M, T, U>,
    place: Place<M, T, U>,
    options: Options<T>,
    /// The length of the next trial.
    step: T,
    length: T,
    /// The change point that has been passed, until it is left.
    passed: Option<M::Coordinates>,
    stands: Stands<M::Coordinates, T, U>,
    is_ended: bool,
}

/// Halvings of one step: 2^-64 of it no longer moves anything.
const MOST_TRIALS: usize = 64;

/// An event is ahead of a step of this many times its length at most.
const AHEAD: f64 = 1.25;

/// A step of this many roundings of the coordinates is the shortest.
const ROUNDINGS: f64 = 64.0;

impl<'a, M, T, const U: usize> Path<'a, M, T, U>
where
    T: Real,
    M: Mechanism<T, U, 1>,
{
    /// The path through the position near `guess` at its input, followed with the default options.
    ///
    /// # Errors
    /// Those of [`with`](Self::with).
    pub fn new(mechanism: &'a M, guess: &M::Coordinates, direction: Direction<M::Coordinates>) -> Result<Self, Error> {
        Self::with(mechanism, guess, direction, Options::default())
    }

    /// The path through the position near `guess` at its input.
    ///
    /// # Errors
    /// Those of [`position::newton`]; [`Error::OtherBranch`] if the position found is of another branch than the
    /// guess; [`Error::NoDirection`] and [`Error::ChangePoint`] where `direction` does not say which way;
    /// [`Error::Lost`] where the mechanism has no tangent; [`Error::Invalid`] for options that make no sense.
    pub fn with(
        mechanism: &'a M,
        guess: &M::Coordinates,
        direction: Direction<M::Coordinates>,
        options: Options<T>,
    ) -> Result<Self, Error> {
        options.check(M::NAME, Curve::<'_, M, T, U>::input(guess))?;
        let solution = position::newton(mechanism, guess)?;
        if !solution.same_branch {
            return Err(Error::OtherBranch {
                mechanism: M::NAME,
                group: other_group(mechanism, &mechanism.pose_at(guess), &mechanism.pose_at(&solution.coordinates)),
            });
        }
        let q = solution.coordinates;
        let curve = Curve::new(mechanism, &q);
        let at = curve.linear(&q)?;
        let elimination = Elimination::new(at.unknowns, at.input);
        let (step, length) = (options.longest_step * real(0.25), T::zero());
        let path =
            |place, passed, stands| Self { curve, place, options, step, length, passed, stands, is_ended: false };
        if elimination.regularity() < weak() {
            if let Some(crossing) = curve.crossing(&q, weak())? {
                let group = curve.singular_group(&crossing.q);
                let chosen = match direction {
                    Direction::Along(rates) => Some(rates),
                    Direction::Increasing | Direction::Decreasing => None,
                };
                let Some(rates) = chosen else { return Err(Error::ChangePoint { mechanism: M::NAME, group }) };
                let tangent = curve.choose(&crossing.tangents, &rates)?;
                let place = curve.at_crossing(crossing.q, tangent, T::zero(), group);
                return Ok(path(place, Some(crossing.q), Stands::AtChangePoint));
            }
            if elimination.regularity() < T::default_epsilon().sqrt() {
                let refusal = Refusal { residual: solution.residual, regularity: to_f64(elimination.regularity()) };
                return Err(curve.lost(&q, 0, refusal));
            }
        }
        let tangent = elimination.tangent();
        let forward = match direction {
            Direction::Along(rates) => curve.choose(&[tangent], &rates)?,
            _ if tangent.input.abs() < weak() => return Err(Error::NoDirection { mechanism: M::NAME }),
            _ if (tangent.input > T::zero()) == matches!(direction, Direction::Increasing) => tangent,
            _ => tangent * -T::one(),
        };
        Ok(path(curve.place(q, &elimination, &forward), None, Stands::OnTheWay))
    }

    /// Where the path has come to.
    #[must_use]
    pub fn position(&self) -> M::Coordinates {
        self.place.q
    }

    /// The rates of the coordinates along the path.
    #[must_use]
    pub fn rates(&self) -> M::Coordinates {
        self.curve.rates(&self.place.q, &self.place.tangent)
    }

    /// The path goes back from here.
    pub fn turn_back(&mut self) {
        self.place.tangent = self.place.tangent * -T::one();
        // At a change point the closures change their side, and back they change it again.
        if !matches!(self.stands, Stands::AtChangePoint) {
            self.place.side = -self.place.side;
            self.passed = None;
        }
        self.is_ended = false;
    }

    /// At a change point where the path stopped, goes on along the motion nearest to these rates.
    ///
    /// # Errors
    /// [`Error::NoDirection`] if they are across both motions, or the path does not stand at a change point.
    pub fn choose(&mut self, rates: &M::Coordinates) -> Result<(), Error> {
        let Stands::Undecided(crossing, _) = self.stands else {
            return Err(Error::NoDirection { mechanism: M::NAME });
        };
        self.place.tangent = self.curve.choose(&crossing.tangents, rates)?;
        // On which side the closures go on depends on the way that is chosen.
        self.place.side = T::zero();
        self.stands = Stands::AtChangePoint;
        self.is_ended = false;
        Ok(())
    }

    /// One step, or less where an event ends it.
    ///
    /// # Errors
    /// [`Error::ChangePoint`] where the path stopped at one and nothing has been chosen, [`Error::Lost`] where the
    /// path cannot be followed on, [`Error::NotFinite`] if a number is not finite.
    pub fn advance(&mut self) -> Result<Step<M::Coordinates, T>, Error> {
        self.advance_wanting(None, None).map(|(step, _)| step)
    }

    /// One step, or less where an event ends it; among the events are the zeros of `watched`, a function of the
    /// position and of the rates of the coordinates along the path: an output, or one of the rates, which is zero
    /// where that coordinate turns back.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn advance_watching(
        &mut self,
        watched: impl Fn(&M::Coordinates, &M::Coordinates) -> T,
    ) -> Result<Step<M::Coordinates, T>, Error> {
        self.advance_wanting(None, Some(&watched)).map(|(step, _)| step)
    }

    /// On to where the input is `input`, without passing a dead point; the event is the last change point on the way.
    ///
    /// The path turns back if the input is behind it. From a dead point it goes on the way it came.
    ///
    /// # Errors
    /// [`Error::DeadPoint`] where the input turns back before that: the path then stands at the dead point;
    /// [`Error::TooLong`] after the most steps, [`Error::Invalid`] if the range does not hold the input, and those
    /// of [`advance`](Self::advance).
    pub fn advance_to(&mut self, input: T) -> Result<Step<M::Coordinates, T>, Error> {
        let is_outside = self.options.range.is_some_and(|[low, high]| input < low || input > high);
        if !input.is_finite() {
            return Err(Error::NotFinite { mechanism: M::NAME, quantity: "the input" });
        }
        if is_outside {
            return Err(Error::Invalid { mechanism: M::NAME, quantity: "the input, which its range must hold" });
        }
        let (mut passed, mut turns, mut rests) = (None, 0, 0_usize);
        for _ in 0..self.options.most_steps {
            let gap = self.curve.input_distance(input - self.input());
            if gap.is_zero() {
                return Ok(Step { event: passed, ..self.here(None) });
            }
            let mut heading = self.place.tangent.input * gap;
            if heading < T::zero() && self.place.tangent.input.abs() > weak() {
                // Once because the input is behind, once because a dead point was left for the other side.
                if turns == 2 {
                    let refusal = Refusal { residual: 0.0, regularity: to_f64(self.place.regularity) };
                    return Err(self.curve.lost(&self.place.q, 0, refusal));
                }
                self.turn_back();
                (heading, turns) = (-heading, turns + 1);
            }
            let before = self.length;
            let (step, is_target) = self.advance_wanting(Some(input), None)?;
            // A path that stands at a dead point may be told so once more; twice, and no way leads on.
            rests += usize::from(self.length - before <= weak());
            let is_onward = heading > T::zero() || rests > 2;
            match step.event {
                Some(Event::DeadPoint { group }) => {
                    let left = self.curve.input_distance(input - self.input()).abs();
                    if left <= self.curve.rounding(&self.place.q) * real(ROUNDINGS) {
                        self.place.q = Curve::<'_, M, T, U>::with_input(&self.place.q, input);
                        return Ok(self.here(step.event));
                    }
                    if is_onward {
                        return Err(Error::DeadPoint { mechanism: M::NAME, group, gap: to_f64(left) });
                    }
                }
                Some(Event::ChangePoint { group, .. }) => {
                    passed = step.event;
                    if self.options.at_change_point == AtChangePoint::Stop && !is_target {
                        return Err(Error::ChangePoint { mechanism: M::NAME, group });
                    }
                    // Where all groups are flat at once the motions cross at the end of the input's range.
                    if !is_target && is_onward && self.place.tangent.input.abs() <= weak() {
                        let left = self.curve.input_distance(input - self.input()).abs();
                        return Err(Error::DeadPoint { mechanism: M::NAME, group, gap: to_f64(left) });
                    }
                }
                _ => {}
            }
            if is_target {
                return Ok(Step { event: passed, ..step });
            }
        }
        Err(Error::TooLong { mechanism: M::NAME, steps: self.options.most_steps })
    }

    fn input(&self) -> T {
        Curve::<'_, M, T, U>::input(&self.place.q)
    }

    fn here(&self, event: Option<Event<M::Coordinates>>) -> Step<M::Coordinates, T> {
        Step { position: self.place.q, rates: self.rates(), length: self.length, event }
    }

    fn advance_wanting(
        &mut self,
        target: Option<T>,
        watch: Option<Watch<'_, M::Coordinates, T>>,
    ) -> Result<(Step<M::Coordinates, T>, bool), Error> {
        if let Stands::Undecided(_, group) = self.stands {
            return Err(Error::ChangePoint { mechanism: M::NAME, group });
        }
        // At an end of its range the input goes no further.
        let (input, way) = (self.input(), self.place.tangent.input);
        let is_outward = |[low, high]: [T; 2]| (input <= low && way < T::zero()) || (input >= high && way > T::zero());
        if self.options.range.is_some_and(is_outward) {
            self.is_ended = true;
            return Ok((self.here(Some(Event::Limit)), false));
        }
        let wanted = Wanted { target, watch, is_at_zero: matches!(self.stands, Stands::AtZero) };
        let shortest = self.curve.rounding(&self.place.q) * real(ROUNDINGS);
        let mut trial = self.step;
        let mut refusal = Refusal { residual: f64::NAN, regularity: f64::NAN };
        for number in 0..MOST_TRIALS {
            match self.attempt(trial, &wanted)? {
                Ok((end, tried)) => return Ok(self.arrive(end, tried, number > 0)),
                Err(why) => refusal = why,
            }
            trial *= real(0.5);
            if trial < shortest {
                break;
            }
        }
        self.is_ended = true;
        Err(self.curve.lost(&self.place.q, MOST_TRIALS, refusal))
    }

    /// A step of this length, up to its first event, and the length that was tried.
    fn attempt(&self, trial: T, wanted: &Wanted<'_, M::Coordinates, T>) -> Tried<(End<M, T, U>, T)> {
        let (curve, from) = (&self.curve, &self.place);
        // Within reach the target is aimed at: the velocity ratios predict its position.
        let aim = wanted.target.and_then(|target| {
            let distance = curve.input_distance(target - self.input()) / from.tangent.input;
            (distance > T::zero() && distance <= trial).then_some((target, distance))
        });
        let tried = aim.map_or(trial, |(_, distance)| distance);
        let found = match aim {
            Some((target, distance)) => {
                let guess = curve.moved(&from.q, &(from.tangent * distance));
                let guess = Curve::<'_, M, T, U>::with_input(&guess, target);
                let found = curve.correct(guess, &Vector::unit(U))?;
                found.map(|(q, elimination)| curve.place(q, &elimination, &from.tangent))
            }
            None => curve.at(from, trial)?,
        };
        let refusal = match &found {
            Ok(place) => Refusal { residual: 0.0, regularity: to_f64(place.regularity) },
            Err(refusal) => *refusal,
        };
        let flips = |place: &Place<M, T, U>| place.side * from.side < T::zero();
        let is_weak = |place: &Place<M, T, U>| place.regularity < weak();
        let arc = found
            .as_ref()
            .ok()
            .filter(|place| curve.is_arc(from, &place.q, &place.tangent, from.regularity, &self.options));
        if arc.is_none_or(|place| flips(place) || is_weak(place)) {
            let guess = match &found {
                Ok(place) if flips(place) => tried * (from.side / (from.side - place.side)),
                _ => tried,
            };
            if let Some(end) = self.crossing_ahead(guess, tried)? {
                let found = curve.first_event(from, end, wanted, &self.options)?;
                return Ok(found.ok_or(refusal).map(|end| (end, tried)));
            }
        }
        let Some(place) = arc.filter(|place| !flips(place)) else { return Ok(Err(refusal)) };
        let mut place = place.clone();
        if place.side.is_zero() {
            place.side = from.side;
        }
        if place.regularity <= curve.rounding(&place.q) * real(ROUNDINGS) {
            place.forget_sign(curve.singular_group(&place.q));
        }
        let end = End { place, event: None, is_target: false, stands: Stands::OnTheWay };
        let found = curve.first_event(from, end, wanted, &self.options)?;
        Ok(found.ok_or(refusal).map(|end| (end, tried)))
    }

    /// The change point on the next `tried` of the path.
    fn crossing_ahead(&self, guess: T, tried: T) -> Result<Option<End<M, T, U>>, Error> {
        let (curve, from) = (&self.curve, &self.place);
        let guess = curve.moved(&from.q, &(from.tangent * guess));
        let Some(mut crossing) = curve.crossing(&guess, tried * real(AHEAD) + weak())? else { return Ok(None) };
        let is_near = |q: &M::Coordinates| curve.difference(&crossing.q, q).norm() <= weak();
        if self.passed.as_ref().is_some_and(is_near) {
            return Ok(None);
        }
        let way = curve.difference(&crossing.q, &from.q);
        let ahead = way.dot(&from.tangent);
        let [one, two] = crossing.tangents;
        if one.dot(&from.tangent).abs() < two.dot(&from.tangent).abs() {
            crossing.tangents = [two, one];
        }
        let sign = if crossing.tangents[0].dot(&from.tangent) < T::zero() { -T::one() } else { T::one() };
        crossing.tangents[0] = crossing.tangents[0] * sign;
        let [kept, other] = crossing.tangents;
        let is_on_the_way = ahead > T::zero()
            && ahead <= tried * real(AHEAD)
            && curve.is_arc(from, &crossing.q, &kept, from.regularity, &self.options);
        if !(is_on_the_way || is_near(&from.q)) {
            return Ok(None);
        }
        let (tangent, side) = match self.options.at_change_point {
            AtChangePoint::Keep | AtChangePoint::Stop => (kept, -from.side),
            AtChangePoint::Switch => {
                let inputs = other.input * kept.input;
                let agreement = if inputs.abs() > weak() { inputs } else { other.dot(&kept) };
                (if agreement < T::zero() { other * -T::one() } else { other }, from.side)
            }
        };
        let group = curve.fallen_group(&from.determinants, &curve.determinants(&crossing.q));
        let place = curve.at_crossing(crossing.q, tangent, side, group);
        let tangents = [kept, other].map(|tangent| curve.rates(&crossing.q, &tangent));
        let stands = match self.options.at_change_point {
            AtChangePoint::Stop => Stands::Undecided(crossing, group),
            _ => Stands::AtChangePoint,
        };
        Ok(Some(End { place, event: Some(Event::ChangePoint { group, tangents }), is_target: false, stands }))
    }

    fn arrive(&mut self, end: End<M, T, U>, tried: T, was_refused: bool) -> (Step<M::Coordinates, T>, bool) {
        let stands = end.stands;
        let way = self.curve.difference(&end.place.q, &self.place.q).norm();
        let turn = (end.place.tangent - self.place.tangent).norm();
        let is_whole = end.event.is_none() && !end.is_target;
        // Steps grow and shrink towards the turn that is allowed.
        let factor = real::<T>(0.7) * self.options.largest_turn / turn;
        let factor = if is_whole { factor.min(real(2.0)).max(real(0.5)) } else { T::one() };
        let last = if is_whole || was_refused { tried } else { self.step };
        self.step = (last * factor).min(self.options.longest_step);
        self.length += way;
        if matches!(stands, Stands::AtChangePoint | Stands::Undecided(..)) {
            self.passed = Some(end.place.q);
        } else if end.place.regularity >= weak() {
            self.passed = None;
        }
        self.stands = stands;
        self.is_ended = matches!(end.event, Some(Event::Limit)) || matches!(stands, Stands::Undecided(..));
        self.place = end.place;
        (self.here(end.event), end.is_target)
    }
}

impl<M, T, const U: usize> Iterator for Path<'_, M, T, U>
where
    T: Real,
    M: Mechanism<T, U, 1>,
{
    type Item = Result<Step<M::Coordinates, T>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        (!self.is_ended).then(|| {
            let step = self.advance();
            self.is_ended |= step.is_err();
            step
        })
    }
}
