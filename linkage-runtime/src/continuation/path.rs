//! The path follower and its steps.

use super::change_point::{Crossing, Touch};
use super::curve::{Curve, Rejection, Tried};
use super::events::{End, Event, Resume, Wanted, Watch};
use super::groups::Groups;
use super::options::{AtChangePoint, Direction, Options};
use super::place::Place;
use super::tangents::Tangents;
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero};
use crate::jacobian::{EliminationOf as Elimination, VectorOf as Vector};
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::{D, Dim, InputError, Mechanism, PathError, PositionError, position, real};

/// The end of a step of a path.
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound(
        serialize = "M::Scalar: serde::Serialize, M::Coordinates: serde::Serialize, M::Rates: serde::Serialize"
    ))
)]
pub struct PathStep<M: Mechanism> {
    /// The position.
    pub position: M::Coordinates,
    /// The derivatives of the coordinates by `length`, proportional to the velocity ratios (W, 1); that of the input is
    /// zero at a dead point.
    pub rates: M::Rates,
    /// The arc length of the path so far, in the space of all coordinates: angles in radians, lengths divided by the
    /// lengths of their loops.
    pub length: M::Scalar,
    /// The event that ended the step, if any.
    pub event: Option<Event<M::Rates>>,
}

crate::__by_fields!([M: Mechanism] PathStep<M> { position, rates, length, event });

/// A mechanism with one input, followed along its motion.
///
/// As an iterator it returns the steps one by one, each a `Result`, and ends after a limit or an error.
pub struct Path<'a, M: Mechanism> {
    pub(super) curve: Curve<'a, M>,
    pub(super) place: Place<M>,
    pub(super) options: Options<M::Scalar>,
    /// The length at which the next step is tried first.
    step: M::Scalar,
    /// The arc length so far.
    length: M::Scalar,
    /// The change point just passed, which is not reported again, until the path has left it.
    passed: Option<M::Coordinates>,
    resume: Resume<M>,
    is_ended: bool,
}

/// The most lengths at which one step is tried, each half the one before: 2^-64 of the first is below rounding error.
const MOST_TRIALS: usize = 64;

/// A change point up to this many step lengths ahead ends the step, so that no step ends just before one.
const AHEAD: f64 = 1.25;

/// At a dead point [J A] is regular. Where its regularity is less than this, the dead point may be a change point at
/// which an even number of pivots vanishes, so that the orientation does not show it.
const DOUBTFUL: f64 = 1e-3;

impl<'a, M> Path<'a, M>
where
    M: Mechanism<V = D<1>>,
{
    /// Starts a path at the position near `guess` with the same input, with the default options.
    ///
    /// # Errors
    /// Those of [`with`](Self::with).
    pub fn new(mechanism: &'a M, guess: &M::Coordinates, direction: Direction<M::Rates>) -> Result<Self, PathError> {
        Self::with(mechanism, guess, direction, Options::default())
    }

    /// Starts a path at the position near `guess` with the same input.
    ///
    /// # Errors
    /// Those of [`position::newton`]; [`PathError::NoDirection`] and [`PathError::ChangePoint`] if `direction` is
    /// ambiguous; [`PathError::Lost`] if the path has no tangent; [`InputError::OutOfRange`] for invalid options.
    pub fn with(
        mechanism: &'a M,
        guess: &M::Coordinates,
        direction: Direction<M::Rates>,
        options: Options<M::Scalar>,
    ) -> Result<Self, PathError> {
        const { assert!(M::GROUPS.len() <= Groups::MOST, "a mechanism of more than 512 groups cannot be followed") };
        options.check(M::NAME, Curve::<'_, M>::input(guess))?;
        let solution = position::newton(mechanism, guess)?;
        let q = solution.coordinates;
        let curve = Curve::new(mechanism, &q);
        let at = curve.linear(&q)?;
        let elimination = Elimination::<M>::new(at.jacobian);
        let (step, length) = (options.longest_step * real(0.25), M::Scalar::zero());
        let path =
            |place, passed, resume| Self { curve, place, options, step, length, passed, resume, is_ended: false };
        if elimination.regularity() < nearly_zero() {
            let rates = match direction {
                Direction::Along(rates) => Some(rates),
                Direction::Increasing | Direction::Decreasing => None,
            };
            let along = rates.map_or(Vector::<M>::zero(), |rates| curve.direction(&rates));
            if let Some(crossing) = curve.crossing(&q, nearly_zero(), &along)? {
                let group = crossing.groups.first();
                let Some(rates) = rates else { return Err(PathError::ChangePoint { mechanism: M::NAME, group }) };
                let tangent = curve.choose(crossing.tangents(), &rates)?;
                let place = curve.at_crossing(&crossing, tangent, M::Scalar::zero());
                return Ok(path(place, Some(crossing.q), Resume::AtChangePoint));
            }
            if elimination.regularity() < M::Scalar::default_epsilon().sqrt() {
                let rejection = Rejection { residual: solution.residual, regularity: to_f64(elimination.regularity()) };
                return Err(curve.lost(&q, 0, rejection));
            }
        }
        let tangent = elimination.tangent();
        let forward = match direction {
            Direction::Along(rates) => curve.choose(&[tangent], &rates)?,
            _ if tangent.inputs[0].abs() < nearly_zero() => return Err(PathError::NoDirection { mechanism: M::NAME }),
            _ if (tangent.inputs[0] > M::Scalar::zero()) == matches!(direction, Direction::Increasing) => tangent,
            _ => -tangent,
        };
        Ok(path(curve.place(q, &elimination, &forward), None, Resume::OnTheWay))
    }

    /// The current position.
    #[must_use]
    pub fn position(&self) -> M::Coordinates {
        self.place.q
    }

    /// The derivatives of the coordinates by the arc length, at the current position.
    #[must_use]
    pub fn rates(&self) -> M::Rates {
        self.curve.rates(&self.place.tangent)
    }

    /// Reverses the path.
    pub fn turn_back(&mut self) {
        self.place.tangent = -self.place.tangent;
        self.place.slopes = -self.place.slopes;
        // At a change point the orientation changes its sign twice: with the tangent, and since the path leaves on the
        // side from which it came.
        if !matches!(self.resume, Resume::AtChangePoint) {
            self.place.orientation = -self.place.orientation;
            self.passed = None;
        }
        self.is_ended = false;
    }

    /// Selects the motion nearest to these rates, at a change point where the path stopped.
    ///
    /// # Errors
    /// [`PathError::NoDirection`] if they are orthogonal to all motions, or if the path has not stopped at a change
    /// point.
    pub fn choose(&mut self, rates: &M::Rates) -> Result<(), PathError> {
        let Resume::Undecided(crossing) = self.resume else {
            return Err(PathError::NoDirection { mechanism: M::NAME });
        };
        let tangent = self.curve.choose(crossing.tangents(), rates)?;
        // The orientation beyond the change point depends on the motion chosen: it is unknown until the next step.
        self.place = self.curve.turned(&self.place, tangent, M::Scalar::zero());
        self.resume = Resume::AtChangePoint;
        self.is_ended = false;
        Ok(())
    }

    /// Takes one step, which ends early at an event.
    ///
    /// # Errors
    /// [`PathError::ChangePoint`] if the path stopped at one and no motion has been chosen, [`PathError::Lost`] if the
    /// path cannot be continued, [`PositionError::NotFinite`] if a number is not finite.
    pub fn advance(&mut self) -> Result<PathStep<M>, PathError> {
        self.advance_until(None, None).map(|(step, _)| step)
    }

    /// Takes one step, which ends early at an event; the zeros of `watched` are events, too. `watched` is a function of
    /// the position and of the derivatives of the coordinates by the arc length: an output, or one of the derivatives,
    /// which is zero where that coordinate reverses. Its slope is computed by a small displacement along the path: two
    /// zeros in one step are found, but a kink or a jump of the function may hide some.
    ///
    /// # Errors
    /// Those of [`advance`](Self::advance).
    pub fn advance_watching(
        &mut self,
        watched: impl Fn(&M::Coordinates, &M::Rates) -> M::Scalar,
    ) -> Result<PathStep<M>, PathError> {
        self.advance_until(None, Some(&watched)).map(|(step, _)| step)
    }

    /// Follows the path until the input is `input`, without passing a dead point; the event is the last change point
    /// passed.
    ///
    /// The path reverses if the input is behind it. From a dead point it continues forward.
    ///
    /// # Errors
    /// [`PathError::DeadPoint`] if the input reverses before: the path is then at the dead point;
    /// [`PathError::TooManySteps`] after [`most_steps`](Options::most_steps), [`InputError::OutOfRange`] if the input
    /// is outside its range, and those of [`advance`](Self::advance).
    pub fn advance_to(&mut self, input: M::Scalar) -> Result<PathStep<M>, PathError> {
        if !input.is_finite() {
            return Err(PositionError::NotFinite { mechanism: M::NAME, quantity: "the input" }.into());
        }
        if let Some([least, most]) = self.options.range
            && (input < least || input > most)
        {
            let [value, least, most] = [input, least, most].map(to_f64);
            let of = Some(M::NAME);
            return Err(InputError::OutOfRange { of, quantity: "the input", value, least, most }.into());
        }
        let (mut passed, mut reversals, mut zero_steps) = (None, 0, 0_usize);
        for _ in 0..self.options.most_steps {
            let gap = self.curve.input_distance(input - self.input());
            if gap.is_zero() {
                return Ok(PathStep { event: passed, ..self.here(None) });
            }
            let mut heading = self.place.tangent.inputs[0] * gap;
            if heading < M::Scalar::zero() && self.place.tangent.inputs[0].abs() > nearly_zero() {
                // At most two reversals: one if the input is behind, one if a dead point was left in the wrong
                // direction.
                if reversals == 2 {
                    let rejection = Rejection { residual: 0.0, regularity: to_f64(self.place.regularity) };
                    return Err(self.curve.lost(&self.place.q, 0, rejection));
                }
                self.turn_back();
                (heading, reversals) = (-heading, reversals + 1);
            }
            let before = self.length;
            let (step, is_target) = self.advance_until(Some(input), None)?;
            // A path that starts at a dead point may report it again; after three steps of zero length the input cannot
            // be reached.
            zero_steps += usize::from(self.length - before <= nearly_zero());
            let is_onward = heading > M::Scalar::zero() || zero_steps > 2;
            match step.event {
                Some(Event::DeadPoint { group }) => {
                    let left = self.curve.input_distance(input - self.input()).abs();
                    if left <= self.curve.rounding_error(&self.place.q) * real(EQUAL_ULPS) {
                        self.place.q = Curve::<'_, M>::with_input(&self.place.q, input);
                        return Ok(self.here(step.event));
                    }
                    if is_onward {
                        return Err(PathError::DeadPoint { mechanism: M::NAME, group, gap: to_f64(left) });
                    }
                }
                Some(Event::ChangePoint { groups, .. }) => {
                    passed = step.event;
                    let group = groups.first();
                    if matches!(self.resume, Resume::Undecided(_)) && !is_target {
                        return Err(PathError::ChangePoint { mechanism: M::NAME, group });
                    }
                    // Where all groups are singular at once, the motions cross at a limit of the input.
                    if !is_target && is_onward && self.place.tangent.inputs[0].abs() <= nearly_zero() {
                        let left = self.curve.input_distance(input - self.input()).abs();
                        return Err(PathError::DeadPoint { mechanism: M::NAME, group, gap: to_f64(left) });
                    }
                }
                _ => {}
            }
            if is_target {
                return Ok(PathStep { event: passed, ..step });
            }
        }
        Err(PathError::TooManySteps { mechanism: M::NAME, steps: self.options.most_steps })
    }

    fn input(&self) -> M::Scalar {
        Curve::<'_, M>::input(&self.place.q)
    }

    fn here(&self, event: Option<Event<M::Rates>>) -> PathStep<M> {
        PathStep { position: self.place.q, rates: self.rates(), length: self.length, event }
    }

    /// Takes one step that ends early at an event, at a target of the input, or at a zero of a watched function; the
    /// flag returned is true at the target.
    fn advance_until(
        &mut self,
        target: Option<M::Scalar>,
        watch: Option<Watch<'_, M>>,
    ) -> Result<(PathStep<M>, bool), PathError> {
        if let Resume::Undecided(crossing) = self.resume {
            let group = crossing.groups.first();
            return Err(PathError::ChangePoint { mechanism: M::NAME, group });
        }
        // At a limit of its range the input cannot move outward.
        let (input, rate) = (self.input(), self.place.tangent.inputs[0]);
        let is_outward = |[low, high]: [M::Scalar; 2]| {
            (input <= low && rate < M::Scalar::zero()) || (input >= high && rate > M::Scalar::zero())
        };
        if self.options.range.is_some_and(is_outward) {
            self.is_ended = true;
            return Ok((self.here(Some(Event::Limit)), false));
        }
        let wanted = Wanted { target, watch, is_at_zero: matches!(self.resume, Resume::AtZero) };
        let shortest = self.curve.rounding_error(&self.place.q) * real(EQUAL_ULPS);
        let mut trial = self.step;
        let mut rejection = Rejection { residual: f64::NAN, regularity: f64::NAN };
        for number in 0..MOST_TRIALS {
            match self.attempt(trial, &wanted)? {
                Ok((end, tried)) => {
                    let chord = self.curve.difference(&end.place.q, &self.place.q).norm();
                    if !(self.length + chord).is_finite() {
                        let quantity = "the length of the path";
                        return Err(PositionError::NotFinite { mechanism: M::NAME, quantity }.into());
                    }
                    self.curve.mechanism.check_implied(&end.place.q)?;
                    return Ok(self.arrive(end, tried, chord, number > 0));
                }
                Err(why) => rejection = why,
            }
            trial *= real(0.5);
            if trial < shortest {
                break;
            }
        }
        self.is_ended = true;
        Err(self.curve.lost(&self.place.q, MOST_TRIALS, rejection))
    }

    /// Tries a step of this length; returns its end, at the first event, and the length tried.
    fn attempt(&self, trial: M::Scalar, wanted: &Wanted<'_, M>) -> Tried<(End<M>, M::Scalar)> {
        let (curve, from) = (&self.curve, &self.place);
        // If the tangent predicts that the input reaches its target within the step, the step is corrected at that
        // input.
        let aim = wanted.target.and_then(|target| {
            let distance = curve.input_distance(target - self.input()) / from.tangent.inputs[0];
            (distance > M::Scalar::zero() && distance <= trial).then_some((target, distance))
        });
        let tried = aim.map_or(trial, |(_, distance)| distance);
        let found = match aim {
            Some((target, distance)) => {
                let guess = curve.moved(&from.q, &(from.tangent * distance));
                let guess = Curve::<'_, M>::with_input(&guess, target);
                let found = curve.correct(guess, &Vector::<M>::unit(M::U::COUNT))?;
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
        let arc = found
            .as_ref()
            .ok()
            .filter(|place| curve.is_arc(from, &place.q, &place.tangent, from.regularity, &self.options));
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
        let rejected = |guess: M::Scalar| -> Tried<(End<M>, M::Scalar)> {
            let guess = curve.moved(&from.q, &(from.tangent * guess));
            if from.regularity < real(DOUBTFUL)
                && let Some(end) = self.touch_ahead(&guess, tried)?
            {
                let found = curve.first_event(from, end, wanted, &self.options)?;
                return Ok(found.ok_or(rejection).map(|end| (end, tried)));
            }
            Ok(Err(rejection))
        };
        let Some(place) = arc.filter(|place| !flips(place)) else { return rejected(tried) };
        let mut place = place.clone();
        if place.orientation.is_zero() {
            place.orientation = from.orientation;
        }
        if place.regularity <= curve.rounding_error(&place.q) * real(EQUAL_ULPS) {
            let (_, group) = curve.least_regular_group(&place.q);
            place.forget_sign(group);
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
            None => rejected(tried),
        }
    }

    /// Finds the change point within [`AHEAD`] times the distance `tried`, from a guess of its distance.
    fn crossing_ahead(&self, guess: M::Scalar, tried: M::Scalar) -> Result<Option<End<M>>, PathError> {
        let (curve, from) = (&self.curve, &self.place);
        let guess = curve.moved(&from.q, &(from.tangent * guess));
        let reach = tried * real(AHEAD) + nearly_zero();
        let crossing = curve.crossing(&guess, reach, &from.tangent)?;
        Ok(crossing.and_then(|crossing| self.crossing_at(crossing, tried)))
    }

    /// Finds the change point near a dead point at which motions touch.
    fn touch_ahead(&self, near: &M::Coordinates, tried: M::Scalar) -> Result<Option<End<M>>, PathError> {
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
            place.bend = bend * (along * along).recip();
        }
        let tangents = crossing.tangents().iter().map(|tangent| curve.rates(tangent));
        let tangents = Tangents::new(tangents, crossing.is_complete);
        let event = Event::ChangePoint { groups: crossing.groups, tangents };
        let resume = if is_decided { Resume::AtChangePoint } else { Resume::Undecided(crossing) };
        Some(End { place, arrived: Some(arrived), event: Some(event), is_target: false, resume })
    }

    /// Moves to the end of a step that was tried with a length and whose chord is given; `was_rejected` if longer
    /// trials failed.
    fn arrive(&mut self, end: End<M>, tried: M::Scalar, chord: M::Scalar, was_rejected: bool) -> (PathStep<M>, bool) {
        let resume = end.resume;
        let turn = (end.place.tangent - self.place.tangent).norm();
        let is_whole = end.event.is_none() && !end.is_target;
        // The next step is to turn by 0.7 of the largest turn: at most twice, at least half as long as this one.
        let factor = real::<M::Scalar>(0.7) * self.options.largest_turn / turn;
        let factor = if is_whole { factor.min(real(2.0)).max(real(0.5)) } else { M::Scalar::one() };
        let last = if is_whole || was_rejected { tried } else { self.step };
        self.step = (last * factor).min(self.options.longest_step);
        self.length += chord;
        if matches!(resume, Resume::AtChangePoint | Resume::Undecided(..)) {
            self.passed = Some(end.place.q);
        } else if end.place.regularity >= nearly_zero() {
            self.passed = None;
        }
        self.resume = resume;
        self.is_ended = matches!(end.event, Some(Event::Limit)) || matches!(resume, Resume::Undecided(..));
        self.place = end.place;
        (self.here(end.event), end.is_target)
    }
}

impl<M> Iterator for Path<'_, M>
where
    M: Mechanism<V = D<1>>,
{
    type Item = Result<PathStep<M>, PathError>;

    fn next(&mut self) -> Option<Self::Item> {
        (!self.is_ended).then(|| {
            let step = self.advance();
            self.is_ended |= step.is_err();
            step
        })
    }
}
