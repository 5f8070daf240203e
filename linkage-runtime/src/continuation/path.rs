//! The follower: where it is, and how it takes a step.

use super::curve::{Curve, Refusal, Tried};
use super::events::{End, Event, Stands, Wanted, Watch};
use super::groups::Groups;
use super::options::{AtChangePoint, Direction, Options};
use super::place::{Place, weak};
use super::tangent::Elimination;
use super::tangents::Tangents;
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

/// A dead point of less regularity than this may be a crossing: a step passes one at which an even number of pivots is
/// zero without a change of side.
const DOUBTFUL: f64 = 1e-3;

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
        const { assert!(M::GROUPS.len() <= Groups::MOST, "more groups than a path can tell apart") };
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
            let rates = match direction {
                Direction::Along(rates) => Some(rates),
                Direction::Increasing | Direction::Decreasing => None,
            };
            let along = rates.map_or(Vector::zero(), |rates| curve.direction(&rates));
            if let Some(crossing) = curve.crossing(&q, weak(), &along)? {
                let group = crossing.groups.first();
                let Some(rates) = rates else { return Err(Error::ChangePoint { mechanism: M::NAME, group }) };
                let tangent = curve.choose(crossing.tangents(), &rates)?;
                let place = curve.at_crossing(&crossing, tangent, T::zero());
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
        let Stands::Undecided(crossing) = self.stands else {
            return Err(Error::NoDirection { mechanism: M::NAME });
        };
        self.place.tangent = self.curve.choose(crossing.tangents(), rates)?;
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
                Some(Event::ChangePoint { groups, .. }) => {
                    passed = step.event;
                    let group = groups.first();
                    if matches!(self.stands, Stands::Undecided(_)) && !is_target {
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
        if let Stands::Undecided(crossing) = self.stands {
            let group = crossing.groups.first();
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
                Ok((end, tried)) => {
                    let way = self.curve.difference(&end.place.q, &self.place.q).norm();
                    if !(self.length + way).is_finite() {
                        return Err(Error::NotFinite { mechanism: M::NAME, quantity: "the length of the path" });
                    }
                    return Ok(self.arrive(end, tried, way, number > 0));
                }
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
        let turns = |place: &Place<M, T, U>| from.sign_changes(place).is_some();
        let guess = match &found {
            Ok(place) if flips(place) => Some(tried * (from.side / (from.side - place.side))),
            Ok(place) if turns(place) => from.sign_changes(place).map(|share| tried * share),
            Ok(place) if arc.is_some() && !is_weak(place) => curve.falls_twice(from, place, tried)?,
            _ => Some(tried),
        };
        if let Some(guess) = guess
            && let Some(end) = self.crossing_ahead(guess, tried)?
        {
            let found = curve.first_event(from, end, wanted, &self.options)?;
            return Ok(found.ok_or(refusal).map(|end| (end, tried)));
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
        let mut found = curve.first_event(from, end, wanted, &self.options)?;
        // At a dead point [J A] has full rank.
        let is_doubtful = |end: &End<M, T, U>| {
            matches!(end.event, Some(Event::DeadPoint { .. })) && end.place.regularity < real(DOUBTFUL)
        };
        if let Some(end) = found.as_ref().filter(|end| is_doubtful(end)) {
            let guess = curve.difference(&end.place.q, &from.q).dot(&from.tangent);
            if let Some(crossing) = self.crossing_ahead(guess, tried)? {
                found = curve.first_event(from, crossing, wanted, &self.options)?;
            }
        }
        Ok(found.ok_or(refusal).map(|end| (end, tried)))
    }

    /// The change point on the next `tried` of the path.
    fn crossing_ahead(&self, guess: T, tried: T) -> Result<Option<End<M, T, U>>, Error> {
        let (curve, from) = (&self.curve, &self.place);
        let guess = curve.moved(&from.q, &(from.tangent * guess));
        let reach = tried * real(AHEAD) + weak();
        let Some(mut crossing) = curve.crossing(&guess, reach, &from.tangent)? else { return Ok(None) };
        let at = crossing.q;
        let is_near = |q: &M::Coordinates| curve.difference(&at, q).norm() <= weak();
        if self.passed.as_ref().is_some_and(is_near) {
            return Ok(None);
        }
        let ahead = curve.difference(&crossing.q, &from.q).dot(&from.tangent);
        crossing.followed(&from.tangent);
        curve.add_fallen_groups(&mut crossing, from);
        let kept = crossing.tangents()[0];
        let is_on_the_way = ahead > T::zero()
            && ahead <= tried * real(AHEAD)
            && curve.is_arc(from, &crossing.q, &kept, from.regularity, &self.options);
        if !(is_on_the_way || is_near(&from.q)) {
            return Ok(None);
        }
        // The closures change their side once for each pivot that passes its zero.
        let behind = if crossing.defect % 2 == 1 { -from.side } else { from.side };
        let beside = if crossing.defect == 1 { from.side } else { T::zero() };
        let (tangent, side, is_decided) = match (self.options.at_change_point, crossing.tangents()) {
            (AtChangePoint::Switch, &[_, other]) if crossing.is_complete => (other.like(&kept), beside, true),
            (policy, _) => (kept, behind, policy == AtChangePoint::Keep),
        };
        let place = curve.at_crossing(&crossing, tangent, side);
        let tangents = crossing.tangents().iter().map(|tangent| curve.rates(&crossing.q, tangent));
        let tangents = Tangents::new(tangents, crossing.is_complete);
        let event = Event::ChangePoint { groups: crossing.groups, tangents };
        let stands = if is_decided { Stands::AtChangePoint } else { Stands::Undecided(crossing) };
        Ok(Some(End { place, event: Some(event), is_target: false, stands }))
    }

    fn arrive(&mut self, end: End<M, T, U>, tried: T, way: T, was_refused: bool) -> (Step<M::Coordinates, T>, bool) {
        let stands = end.stands;
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
