//! The path follower and its steps.

use super::curve::{Curve, Rejection};
use super::events::{End, Event, Resume, Wanted, Watch};
use super::groups::Groups;
use super::joint_ranges::JointEnd;
use super::options::{Direction, Options};
use super::place::Place;
use crate::held::IntoHeld;
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero};
use crate::jacobian::{EliminationOf as Elimination, VectorOf as Vector};
use crate::mechanism::check_ranges;
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::{D, Dim, InputError, Mechanism, Name, PathError, PathErrorOf, PositionError, Solution, position, real};

/// The end of a step of a path.
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound(
        serialize = "M::Scalar: serde::Serialize, M::Coordinates: serde::Serialize, M::Rates: serde::Serialize, \
                     M::Name: serde::Serialize"
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
    pub event: Option<Event<M::Rates, M::Name>>,
}

crate::__by_fields!([M: Mechanism] PathStep<M> { position, rates, length, event });

/// A mechanism with one input, followed along its motion.
///
/// As an iterator it returns the steps one by one, each a `Result`, and ends after a limit or an error. It borrows the mechanism,
/// owns it or shares it ([`Held`](crate::held::Held)):
///
/// ```
/// linkage::linkage! {
///     pub mechanism Lever {
///         param a = 1, b = 2;
///         input theta;
///         unknown s, phi;
///         loop a@theta + b@phi = s@0;
///     }
/// }
/// use linkage::PathError;
/// use linkage::continuation::{Direction, Path};
///
/// /// A struct that owns its path.
/// struct Walk {
///     path: Path<'static, Lever>,
/// }
///
/// fn started(m: Lever) -> Result<Walk, PathError> {
///     let start = LeverCoordinates { theta: 0.0, s: 3.0, phi: 0.0 };
///     Ok(Walk { path: Path::new(m, &start, Direction::Increasing)? })
/// }
///
/// let mut walk = started(Lever::default())?;
/// assert!((walk.path.advance_to(1.0)?.position.s - 2.354).abs() < 1e-3);
/// # Ok::<(), linkage::Error>(())
/// ```
pub struct Path<'a, M: Mechanism> {
    pub(super) curve: Curve<'a, M>,
    pub(super) place: Place<M>,
    pub(super) options: Options<M::Scalar>,
    /// The length at which the next step is tried first.
    step: M::Scalar,
    /// The arc length so far.
    length: M::Scalar,
    /// The change point just passed, which is not reported again, until the path has left it.
    pub(super) passed: Option<M::Coordinates>,
    resume: Resume<M>,
    is_ended: bool,
}

/// The most lengths at which one step is tried, each half the one before: 2^-64 of the first is below rounding error.
const MOST_TRIALS: usize = 64;

impl<'a, M> Path<'a, M>
where
    M: Mechanism<V = D<1>>,
{
    /// Starts a path at the position near `guess` with the same input, with the default options.
    ///
    /// # Errors
    /// Those of [`with`](Self::with).
    pub fn new<By>(
        mechanism: impl IntoHeld<'a, By, Of = M>,
        guess: &M::Coordinates,
        direction: Direction<M::Rates>,
    ) -> Result<Self, PathErrorOf<M>> {
        Self::with(mechanism, guess, direction, Options::default())
    }

    /// Starts a path at the position near `guess` with the same input.
    ///
    /// # Errors
    /// Those of [`position::newton`]; [`PathError::NoDirection`] and [`PathError::ChangePoint`] if `direction` is
    /// ambiguous, as where motions touch; [`PathError::Lost`] if the path has no tangent; [`InputError::OutOfRange`] for
    /// invalid options, and with [`joint_ranges`](Options::joint_ranges) for a start outside of a range;
    /// [`InputError::EmptyJointRange`] for a range without room.
    pub fn with<By>(
        mechanism: impl IntoHeld<'a, By, Of = M>,
        guess: &M::Coordinates,
        direction: Direction<M::Rates>,
        options: Options<M::Scalar>,
    ) -> Result<Self, PathErrorOf<M>> {
        const {
            assert!(M::G::CAPACITY <= Groups::<M::Name>::MOST, "a mechanism of more than 512 groups cannot be followed")
        };
        let mechanism = mechanism.into_held();
        options.check(mechanism.name(), Curve::<'_, M>::input(guess))?;
        let solution = position::newton(&*mechanism, guess)?;
        if options.joint_ranges {
            check_ranges(&*mechanism, &solution.coordinates)?;
        }
        let curve = Curve::new(mechanism, &solution.coordinates);
        let (place, passed, resume) = curve.start(&solution, direction)?;
        let (step, length) = (options.longest_step * real(0.25), M::Scalar::zero());
        Ok(Self { curve, place, options, step, length, passed, resume, is_ended: false })
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

    /// The smallest pivot of the Jacobian [J A] divided by the largest, at the current position: 0 at a change point, small
    /// where the path passes near another motion.
    #[must_use]
    pub fn regularity(&self) -> M::Scalar {
        self.place.regularity
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
    pub fn choose(&mut self, rates: &M::Rates) -> Result<(), PathErrorOf<M>> {
        let Resume::Undecided(crossing) = self.resume else {
            return Err(PathError::NoDirection { mechanism: self.curve.mechanism.name() });
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
    pub fn advance(&mut self) -> Result<PathStep<M>, PathErrorOf<M>> {
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
    ) -> Result<PathStep<M>, PathErrorOf<M>> {
        self.advance_until(None, Some(&watched)).map(|(step, _)| step)
    }

    /// Follows the path until the input is `input`, without passing a dead point; the event is the last change point
    /// passed.
    ///
    /// The path reverses if the input is behind it. From a dead point it continues forward.
    ///
    /// # Errors
    /// [`PathError::DeadPoint`] if the input reverses before: the path is then at the dead point;
    /// [`PathError::JointRange`] if a coordinate or an output is at an end of its range before: the path is then there;
    /// [`PathError::TooManySteps`] after [`most_steps`](Options::most_steps), [`InputError::OutOfRange`] if the input
    /// is outside its range, and those of [`advance`](Self::advance).
    pub fn advance_to(&mut self, input: M::Scalar) -> Result<PathStep<M>, PathErrorOf<M>> {
        if !input.is_finite() {
            return Err(PositionError::NotFinite {
                mechanism: self.curve.mechanism.name(),
                quantity: Name::from_static("the input"),
            }
            .into());
        }
        if let Some([least, most]) = self.options.range
            && (input < least || input > most)
        {
            let [value, least, most] = [input, least, most].map(to_f64);
            let of = Some(self.curve.mechanism.name());
            let quantity = Name::from_static("the input");
            return Err(InputError::OutOfRange { of, quantity, value, least, most }.into());
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
                        return Err(self.dead_point(group, input));
                    }
                }
                Some(Event::JointRange { of, end }) => {
                    let left = self.curve.input_distance(input - self.input()).abs();
                    if left <= self.curve.rounding_error(&self.place.q) * real(EQUAL_ULPS) {
                        self.place.q = Curve::<'_, M>::with_input(&self.place.q, input);
                        return Ok(self.here(step.event));
                    }
                    if is_onward {
                        let gap = to_f64((input - self.input()).abs());
                        return Err(PathError::JointRange { mechanism: self.curve.mechanism.name(), of, end, gap });
                    }
                }
                Some(Event::ChangePoint { groups, .. }) => {
                    passed = step.event;
                    let group = groups.first();
                    if matches!(self.resume, Resume::Undecided(_)) && !is_target {
                        return Err(PathError::ChangePoint { mechanism: self.curve.mechanism.name(), group });
                    }
                    // Where all groups are singular at once, the motions cross at a limit of the input.
                    if !is_target && is_onward && self.place.tangent.inputs[0].abs() <= nearly_zero() {
                        return Err(self.dead_point(group, input));
                    }
                }
                _ => {}
            }
            if is_target {
                return Ok(PathStep { event: passed, ..step });
            }
        }
        Err(PathError::TooManySteps { mechanism: self.curve.mechanism.name(), steps: self.options.most_steps })
    }

    /// Follows the path for this arc length, through dead points and change points; the event is the last one passed, or
    /// that which ended the path before.
    ///
    /// The arc length is that of [`PathStep::length`], the sum of the chords of all steps. The last step may be longer by an
    /// eighth of the square of its turn.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`] for a length that is not finite, [`PathError::TooManySteps`] after
    /// [`most_steps`](Options::most_steps), and those of [`advance`](Self::advance).
    pub fn advance_by(&mut self, length: M::Scalar) -> Result<PathStep<M>, PathErrorOf<M>> {
        if !length.is_finite() {
            return Err(PositionError::NotFinite {
                mechanism: self.curve.mechanism.name(),
                quantity: Name::from_static("the arc length"),
            }
            .into());
        }
        let (end, mut passed) = (self.length + length, None);
        for _ in 0..self.options.most_steps {
            let left = end - self.length;
            if left <= self.curve.rounding_error(&self.place.q) * real(EQUAL_ULPS) || self.is_ended {
                return Ok(self.here(passed));
            }
            self.step = self.step.min(left);
            let step = self.advance()?;
            passed = step.event.or(passed);
        }
        Err(PathError::TooManySteps { mechanism: self.curve.mechanism.name(), steps: self.options.most_steps })
    }

    /// The error of a dead point before an input.
    fn dead_point(&self, group: M::Name, input: M::Scalar) -> PathErrorOf<M> {
        let gap = to_f64((input - self.input()).abs());
        PathError::DeadPoint { mechanism: self.curve.mechanism.name(), group, gap }
    }

    fn input(&self) -> M::Scalar {
        Curve::<'_, M>::input(&self.place.q)
    }

    fn here(&self, event: Option<Event<M::Rates, M::Name>>) -> PathStep<M> {
        PathStep { position: self.place.q, rates: self.rates(), length: self.length, event }
    }

    /// Takes one step that ends early at an event, at a target of the input, or at a zero of a watched function; the
    /// flag returned is true at the target.
    fn advance_until(
        &mut self,
        target: Option<M::Scalar>,
        watch: Option<Watch<'_, M>>,
    ) -> Result<(PathStep<M>, bool), PathErrorOf<M>> {
        if let Resume::Undecided(crossing) = self.resume {
            let group = crossing.groups.first();
            return Err(PathError::ChangePoint { mechanism: self.curve.mechanism.name(), group });
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
        if self.options.joint_ranges
            && let Some(JointEnd { of, end, .. }) = self.curve.joint_end_ahead(&self.place)
        {
            self.is_ended = true;
            return Ok((self.here(Some(Event::JointRange { of, end })), false));
        }
        let wanted = Wanted { target, watch, is_at_zero: matches!(self.resume, Resume::AtZero) };
        let shortest = self.curve.rounding_error(&self.place.q) * real(EQUAL_ULPS);
        let mut trial = self.step;
        let mut rejection = Rejection { residual: f64::NAN, regularity: f64::NAN };
        let mut not_finite = None;
        for number in 0..MOST_TRIALS {
            match self.attempt(trial, &wanted) {
                Ok(Ok((end, tried))) => {
                    let chord = self.curve.difference(&end.place.q, &self.place.q).norm();
                    if !(self.length + chord).is_finite() {
                        let quantity = Name::from_static("the length of the path");
                        return Err(
                            PositionError::NotFinite { mechanism: self.curve.mechanism.name(), quantity }.into()
                        );
                    }
                    self.curve.mechanism.check_implied(&end.place.q)?;
                    return Ok(self.arrive(end, tried, chord, number > 0));
                }
                Ok(Err(why)) => (rejection, not_finite) = (why, None),
                // A shorter step may stay where the equations have values.
                Err(error @ PathError::Position(PositionError::NotFinite { .. })) => not_finite = Some(error),
                Err(error) => return Err(error),
            }
            trial *= real(0.5);
            if trial < shortest {
                break;
            }
        }
        self.is_ended = true;
        Err(not_finite.unwrap_or_else(|| self.curve.lost(&self.place.q, MOST_TRIALS, rejection)))
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
        self.is_ended = matches!(end.event, Some(Event::Limit | Event::JointRange { .. }))
            || matches!(resume, Resume::Undecided(..));
        self.place = end.place;
        (self.here(end.event), end.is_target)
    }
}

/// The place from which a path starts, the change point at which it does, and the way on from there.
type Start<M> = (Place<M>, Option<<M as Mechanism>::Coordinates>, Resume<M>);

impl<M: Mechanism<V = D<1>>> Curve<'_, M> {
    /// Starts at a position, in a direction.
    fn start(
        &self,
        solution: &Solution<M::Coordinates>,
        direction: Direction<M::Rates>,
    ) -> Result<Start<M>, PathErrorOf<M>> {
        let q = solution.coordinates;
        let elimination = Elimination::<M>::new(self.linear(&q)?.jacobian);
        if elimination.regularity() < nearly_zero() {
            let rates = match direction {
                Direction::Along(rates) => Some(rates),
                Direction::Increasing | Direction::Decreasing => None,
            };
            let along = rates.map_or(Vector::<M>::zero(self.dims()), |rates| self.direction(&rates));
            if let Some(crossing) = self.crossing(&q, nearly_zero(), &along)? {
                let group = crossing.groups.first();
                let Some(rates) = rates else {
                    return Err(PathError::ChangePoint { mechanism: self.mechanism.name(), group });
                };
                let tangent = self.choose(crossing.tangents(), &rates)?;
                let place = self.at_crossing(&crossing, tangent, M::Scalar::zero());
                return Ok((place, Some(crossing.q), Resume::AtChangePoint));
            }
            if elimination.regularity() < M::Scalar::default_epsilon().sqrt() {
                if let Some(touch) = self.touch(&q, nearly_zero(), &along)? {
                    return Err(PathError::ChangePoint {
                        mechanism: self.mechanism.name(),
                        group: touch.groups.first(),
                    });
                }
                let rejection = Rejection { residual: solution.residual, regularity: to_f64(elimination.regularity()) };
                return Err(self.lost(&q, 0, rejection));
            }
        }
        let tangent = elimination.tangent();
        let forward = match direction {
            Direction::Along(rates) => self.choose(&[tangent], &rates)?,
            _ if tangent.inputs[0].abs() < nearly_zero() => {
                return Err(PathError::NoDirection { mechanism: self.mechanism.name() });
            }
            _ if (tangent.inputs[0] > M::Scalar::zero()) == matches!(direction, Direction::Increasing) => tangent,
            _ => -tangent,
        };
        Ok((self.place(q, &elimination, &forward), None, Resume::OnTheWay))
    }
}

impl<M> Iterator for Path<'_, M>
where
    M: Mechanism<V = D<1>>,
{
    type Item = Result<PathStep<M>, PathErrorOf<M>>;

    fn next(&mut self) -> Option<Self::Item> {
        (!self.is_ended).then(|| {
            let step = self.advance();
            self.is_ended |= step.is_err();
            step
        })
    }
}
