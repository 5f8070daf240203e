//! A simulation: step after step, in the coordinates that are good for the step.

use nalgebra::SVector;

use super::independent::Independent;
use super::motion::{Motion, Road, weakest};
use super::over::Ahead;
use super::scales::Scales;
use super::state::{Loads, State, Touch};
use super::watch::{Then, Unwatched, Watch, Watched};
use crate::contact::{Change, Contacts};
use crate::integrate::{Counts, Crossing, Dop853, Integration, Interpolant, Method, Tolerance};
use crate::scalar::to_f64;
use crate::scene::{Coordinates, Inputs};
use crate::{Error, Mechanism, Real, Scene, real, same_signs};

/// What of the change of a step's length is dared. A mechanism is now slow and now fast within one turn, and the usual
/// 0.9 has every third step rejected.
const SAFETY: f64 = 0.8;

/// Below this regularity of the inputs other coordinates are taken: two links are then within 6 degrees of a line.
const LEAVE: f64 = 0.05;

/// Above this they are taken again.
const RETURN: f64 = 0.1;

/// Below this the determinants of the groups are watched.
const NEAR: f64 = 0.4;

/// How far ahead a singularity is looked for, in radians or as a part of the sizes of lengths.
const SIGHT: f64 = 0.7;

/// Another choice must be this much better to be taken.
const BETTER: f64 = 3.0;

/// Steps in other coordinates after one in the inputs went over a singularity, if it is not met before.
const WARNED: u32 = 16;

/// Nearer to a change point nothing is left of the tangent.
const NEAREST: f64 = 1e-7;

/// What a simulation does where the inputs cannot drive the mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtSingularity {
    /// It goes on: in other coordinates at a dead point, straight on at a change point.
    #[default]
    Pass,
    /// It ends with [`Error::Singular`].
    Stop,
}

/// What a simulation has met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Passages {
    /// Changes of the independent coordinates, those back to the inputs included.
    pub exchanges: usize,
    /// Change points passed.
    pub change_points: usize,
}

type Position<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
    Coordinates<<S as Scene<T, U, V, N, C>>::Mechanism, T, U, V>;
type Moment<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
    State<T, Position<S, T, U, V, N, C>, C>;
type Rates<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
    Inputs<<S as Scene<T, U, V, N, C>>::Mechanism, T, U, V>;
type Signs<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
    <<S as Scene<T, U, V, N, C>>::Mechanism as Mechanism<T, U, V>>::BlockDeterminants;

/// A simulation under way: an iterator over the [states](State) at the ends of its steps and at its events, which ends
/// with an error or at the end of the interval. What was reached stays readable after an error.
pub struct Simulation<
    'a,
    S,
    T,
    const U: usize,
    const V: usize,
    const N: usize,
    const C: usize,
    M = Dop853,
    W = Unwatched,
    const K: usize = 0,
> where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    integration: Integration<M, Motion<'a, S, W, T, U, V, N, C>, T, N, K, C>,
    relative: f64,
    /// The size of rates beside those of coordinates.
    frequency: T,
    at_singularity: AtSingularity,
    state: Moment<S, T, U, V, N, C>,
    /// The contacts in the step that led to the state.
    contacts: Contacts<T, C>,
    /// Where the step begins, closed, with the signs of the determinants there.
    from: (T, SVector<T, N>),
    signs: Signs<S, T, U, V, N, C>,
    passages: Passages,
    /// Steps in other coordinates that are left since one in the inputs went over a singularity.
    warned: u32,
    is_over: bool,
    /// Why nothing follows the state.
    failure: Option<Error>,
    /// The next step is prepared.
    is_prepared: bool,
}

/// A simulation of this scene from a time, a position and the rates of the inputs there to the time `end`, by the
/// method of order 8(5,3). `tolerance` is the relative error allowed of a step: a pure number such as 1e-9, beside the
/// magnitude of each coordinate and rate, or beside what is large for it if that is more: 1 rad, the lengths of the
/// loops, and for rates these times the angular frequency of the motion at the start.
///
/// The position need only be near: it is closed with its inputs as they are.
///
/// # Errors
/// Those of [`Scene::start`]: [`Error::Negative`], [`Error::Inconsistent`], [`Error::NotConverged`]; those of the
/// equations of motion there; [`Error::OutOfRange`] for a tolerance below ten roundings or above 1 and for times
/// that are not finite.
pub fn simulate<S, T, const U: usize, const V: usize, const N: usize, const C: usize>(
    scene: &S,
    (t, q, rates): (T, Position<S, T, U, V, N, C>, impl Into<Rates<S, T, U, V, N, C>>),
    end: T,
    tolerance: f64,
) -> Result<Simulation<'_, S, T, U, V, N, C>, Error>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    let mechanism = scene.mechanism();
    let y = scene.start(t, &q, &rates.into())?;
    let (q, _) = S::parts(&y);
    let scales = Scales::of(mechanism, &q);
    let mut motion = Motion::new(scene, scales);
    let y = if C > 0 { motion.begin(t, &y)? } else { y };
    let contacts = motion.contacts;
    let (unknowns, inputs) = motion.velocity(t, &y)?;
    let (_, accelerations) = Motion::<S, Unwatched, T, U, V, N, C>::unpack(&scene.derivative(t, &y)?);
    let speed = scales.speed(&unknowns, &inputs);
    let urge = accelerations.component_div(&scales.inputs).amax().sqrt();
    let span = to_f64(end - t).abs();
    let frequency = speed.max(urge);
    let slow = if span > 0.0 { real::<T>(span.recip()) } else { T::one() };
    let frequency = if frequency > T::zero() { frequency } else { slow };
    let state = motion.state(t, &y)?;
    let scale = scale_of(&motion, &q, frequency);
    let mut integration = Integration::new(motion, (t, y), end, Tolerance::new(tolerance, scale)?)?;
    integration.set_safety(SAFETY);
    Ok(Simulation {
        integration,
        relative: tolerance,
        frequency,
        at_singularity: AtSingularity::Pass,
        state,
        contacts,
        from: (t, y),
        signs: mechanism.block_determinants(&mechanism.pose_at(&q)),
        passages: Passages::default(),
        warned: 0,
        is_over: false,
        failure: None,
        is_prepared: false,
    })
}

/// The sizes of the components of y.
fn scale_of<S, W, T, const U: usize, const V: usize, const N: usize, const C: usize>(
    motion: &Motion<'_, S, W, T, U, V, N, C>,
    q: &Position<S, T, U, V, N, C>,
    frequency: T,
) -> SVector<T, N>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    let scales = &motion.scales;
    let sizes = Motion::<S, W, T, U, V, N, C>::joined(q, (scales.unknowns, scales.inputs));
    let rates = match &motion.road {
        Road::Inputs => scales.inputs,
        Road::Others(independent) | Road::Over(independent, _) => independent.of(&scales.unknowns, &scales.inputs),
    };
    Motion::<S, W, T, U, V, N, C>::pack(&sizes, &(rates * frequency))
}

impl<'a, S, T, const U: usize, const V: usize, const N: usize, const C: usize, M, W, const K: usize>
    Simulation<'a, S, T, U, V, N, C, M, W, K>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
    M: Method,
    W: Watch<T, Position<S, T, U, V, N, C>, Rates<S, T, U, V, N, C>, K, C>,
{
    /// The same by another method: [`Dopri5`](crate::integrate::Dopri5) for pictures.
    ///
    /// # Errors
    /// None that [`simulate`] has not found.
    pub fn method<M2: Method>(self) -> Result<Simulation<'a, S, T, U, V, N, C, M2, W, K>, Error> {
        self.with(|motion| motion)
    }

    /// Watches K functions of the state: `values` gives them, `crossings` says which way each must pass through zero,
    /// and `action` what happens at an event. Set it before the first step.
    ///
    /// # Errors
    /// None that [`simulate`] has not found.
    #[allow(clippy::type_complexity)] // A shorter name would hide which closure takes what.
    pub fn events<F, A, const K2: usize>(
        self,
        crossings: [Crossing; K2],
        values: F,
        action: A,
    ) -> Result<Simulation<'a, S, T, U, V, N, C, M, Watched<F, A, K2>, K2>, Error>
    where
        F: FnMut(&Moment<S, T, U, V, N, C>) -> Result<[T; K2], Error>,
        A: FnMut(usize, &Moment<S, T, U, V, N, C>) -> Result<Then<Rates<S, T, U, V, N, C>>, Error>,
    {
        self.with(|motion| motion.watched(Watched { crossings, values, action }))
    }

    #[allow(clippy::type_complexity)] // As above.
    fn with<M2, W2, const K2: usize>(
        self,
        motion: impl FnOnce(Motion<'a, S, W, T, U, V, N, C>) -> Motion<'a, S, W2, T, U, V, N, C>,
    ) -> Result<Simulation<'a, S, T, U, V, N, C, M2, W2, K2>, Error>
    where
        M2: Method,
        W2: Watch<T, Position<S, T, U, V, N, C>, Rates<S, T, U, V, N, C>, K2, C>,
    {
        Ok(Simulation {
            integration: self.integration.with(motion)?,
            relative: self.relative,
            frequency: self.frequency,
            at_singularity: self.at_singularity,
            state: self.state,
            contacts: self.contacts,
            from: self.from,
            signs: self.signs,
            passages: self.passages,
            warned: self.warned,
            is_over: self.is_over,
            failure: self.failure,
            is_prepared: self.is_prepared,
        })
    }

    /// What happens where the inputs cannot drive the mechanism; without it the motion goes on.
    #[must_use]
    pub fn at_singularity(mut self, policy: AtSingularity) -> Self {
        self.at_singularity = policy;
        self
    }

    /// The largest length of a step; without it the whole interval.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not positive and finite.
    pub fn largest_step(mut self, length: T) -> Result<Self, Error> {
        self.integration = self.integration.largest_step(length)?;
        Ok(self)
    }

    /// The length of the first step, in place of an estimate.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not positive and finite.
    pub fn first_step(mut self, length: T) -> Result<Self, Error> {
        self.integration = self.integration.first_step(length)?;
        Ok(self)
    }

    /// Steps, accepted or not, after which the simulation is given up; 100 000 without it.
    #[must_use]
    pub fn most_steps(mut self, steps: usize) -> Self {
        self.integration = self.integration.most_steps(steps);
        self
    }

    /// How far the simulation is.
    #[must_use]
    pub fn t(&self) -> T {
        self.state.t
    }

    /// The last state that was reached.
    #[must_use]
    pub fn state(&self) -> &Moment<S, T, U, V, N, C> {
        &self.state
    }

    /// The forces of frictions, stops and drives at the last state that was reached, at an event those after it.
    ///
    /// # Errors
    /// Those of the equations of motion, and [`Error::ChangePoint`] very near to one.
    pub fn loads(&self) -> Result<Loads<T, Rates<S, T, U, V, N, C>, C>, Error> {
        let (t, motion) = (self.integration.t(), self.integration.system());
        let y = motion.closed(t, self.integration.state())?;
        let (contacts, drives) = motion.loads(t, &y)?;
        let (_, rates) = motion.velocity(t, &y)?;
        Ok(Loads { contacts, drives: drives.into(), drive_power: drives.dot(&rates) })
    }

    /// How much of the interval is done, from 0 to 1.
    #[must_use]
    pub fn progress(&self) -> f64 {
        self.integration.progress()
    }

    /// What it has cost. The evaluations of a step over a change point are not among them.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.integration.counts()
    }

    /// The singularities that were met.
    #[must_use]
    pub fn passages(&self) -> Passages {
        self.passages
    }

    /// The states at these times, which follow one another in the direction of the simulation, by dense output and
    /// with the closures closed: the steps are those that are taken without them.
    pub fn at<I: IntoIterator<Item = T>>(
        &mut self,
        times: I,
    ) -> Outputs<'_, 'a, S, T, I::IntoIter, U, V, N, C, M, W, K> {
        Outputs { simulation: self, times: times.into_iter(), failed: false }
    }

    /// Simulates to the end. `watch` sees every state and how much of the interval is done; where it returns false the
    /// simulation pauses, and may be continued.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn finish(&mut self, mut watch: impl FnMut(&Moment<S, T, U, V, N, C>, f64) -> bool) -> Result<(), Error> {
        while let Some(state) = self.advance()? {
            if !watch(&state, self.progress()) {
                break;
            }
        }
        Ok(())
    }

    /// To the end of the next step or to the next event; None where nothing follows.
    ///
    /// # Errors
    /// What the scene returns where no shorter step avoids it, [`Error::Singular`] and [`Error::ChangePoint`] where the
    /// motion cannot be followed, and those of [`Integration::advance`]. Nothing follows after an error.
    pub fn advance(&mut self) -> Result<Option<Moment<S, T, U, V, N, C>>, Error> {
        if self.is_over || (self.failure.is_none() && self.integration.is_over()) {
            return Ok(None);
        }
        let result = self.failure.take().map_or_else(|| self.proceed(), Err);
        self.is_over = result.is_err();
        result
    }

    fn proceed(&mut self) -> Result<Option<Moment<S, T, U, V, N, C>>, Error> {
        loop {
            let is_prepared = core::mem::take(&mut self.is_prepared);
            if self.integration.is_at_boundary() && !is_prepared {
                self.prepare()?;
            }
            let Some(step) = self.integration.advance()? else { return Ok(None) };
            let motion = self.integration.system();
            let (q, _) = S::parts(&step.state);
            let mechanism = motion.scene.mechanism();
            if matches!(motion.road, Road::Inputs) {
                let signs = mechanism.block_determinants(&mechanism.pose_at(&q));
                if !same_signs(self.signs.as_ref(), signs.as_ref()) {
                    if self.at_singularity == AtSingularity::Stop {
                        return Err(motion.singular(&q));
                    }
                    // The step went over a singularity: again from its start, in coordinates that tell.
                    self.go_back()?;
                    continue;
                }
            }
            let contacts = motion.contacts;
            let closed = motion.closed(step.t, &step.state)?;
            let (kept, holds) = motion.reviewed(&contacts, step.t, &closed)?;
            let mut state = State { event: step.event.filter(|&event| event < K), ..motion.state(step.t, &kept)? };
            let result = match step.event {
                Some(event) if event < K => self.happens(event, &mut state, &kept),
                None if holds => {
                    if kept != step.state {
                        self.integration.correct(kept);
                    }
                    Ok(())
                }
                // At just the state at which the guard was zero.
                guard => self.settle(&mut state, &closed, guard.map(|event| event - K)),
            };
            // Of several events of contacts at one time the first decides for all.
            if step.event.is_some() && state.event.is_none() && result.is_ok() && state.changes().next().is_none() {
                continue;
            }
            self.failure = result.err();
            if step.event.is_some() {
                self.from = (step.t, *self.integration.state());
            }
            (self.state, self.contacts) = (state, contacts);
            return Ok(Some(self.state));
        }
    }

    /// Takes the step again, in other coordinates than the inputs.
    fn go_back(&mut self) -> Result<(), Error> {
        let (t, y) = self.from;
        self.integration.go_back(t, y);
        self.warned = WARNED;
        self.leave_inputs()?;
        self.is_prepared = true;
        Ok(())
    }

    /// What the user wishes to happen at an event.
    fn happens(
        &mut self,
        event: usize,
        state: &mut Moment<S, T, U, V, N, C>,
        closed: &SVector<T, N>,
    ) -> Result<(), Error> {
        let motion = self.integration.system_mut();
        match motion.watch.at_event(event, state)? {
            Then::GoOn => {}
            Then::Stop => self.integration.stop(),
            Then::Restart(rates) => {
                let y = motion.with_rates(&state.q, &rates.into())?;
                let (after, changes) = motion.resumed(state.t, closed, &y)?;
                self.integration.restart(after)?;
                self.note(state, changes);
            }
        }
        Ok(())
    }

    /// What happens to the contacts.
    fn settle(
        &mut self,
        state: &mut Moment<S, T, U, V, N, C>,
        closed: &SVector<T, N>,
        guard: Option<usize>,
    ) -> Result<(), Error> {
        let (after, changes) = self.integration.system_mut().settled(state.t, closed, guard)?;
        self.integration.restart(after)?;
        self.note(state, changes);
        Ok(())
    }

    /// What the contacts have done, and do from here on.
    fn note(&self, state: &mut Moment<S, T, U, V, N, C>, changes: [Option<Change>; C]) {
        let modes = self.integration.system().contacts.modes;
        for ((touch, mode), change) in state.contacts.iter_mut().zip(modes).zip(changes) {
            *touch = Touch { mode, change, ..*touch };
        }
    }

    /// Looks where the next step may go, and takes the coordinates for it.
    fn prepare(&mut self) -> Result<(), Error> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let before = self.from.0;
        self.from = (t, y);
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let pose = mechanism.pose_at(&S::parts(&y).0);
        let (regularity, _) = weakest(mechanism, &pose);
        match motion.road {
            Road::Inputs if regularity < real(LEAVE) && self.at_singularity == AtSingularity::Pass => {
                self.leave_inputs()
            }
            Road::Inputs => {
                let determinants = mechanism.block_determinants(&pose);
                let rest = self.rest(t - before, &determinants);
                self.signs = determinants;
                let is_watched = regularity < real(NEAR) && self.at_singularity == AtSingularity::Pass;
                if let Some(rest) = rest.filter(|_| is_watched) { self.watch(rest) } else { Ok(()) }
            }
            _ if regularity > real(RETURN) && self.is_past(&mechanism.block_determinants(&pose)) => {
                let (_, inputs) = motion.velocity(t, &y)?;
                self.warned = 0;
                self.signs = mechanism.block_determinants(&pose);
                self.take(Road::Inputs, &inputs);
                Ok(())
            }
            Road::Others(independent) | Road::Over(independent, _) => self.stay(independent),
        }
    }

    /// The time until the determinant of a group is zero, if it goes on as in the last step.
    fn rest(&self, last: T, determinants: &Signs<S, T, U, V, N, C>) -> Option<f64> {
        let groups = self.signs.as_ref().iter().zip(determinants.as_ref());
        let falling = groups.filter(|(before, now)| now.abs() < before.abs());
        falling
            .map(|(&before, &now)| to_f64(now / (before - now) * last).abs())
            .reduce(|a, b| if a < b { a } else { b })
    }

    /// In the inputs, where they may soon be singular: a change point is passed from afar, as the step over it suffers
    /// the less from rounding the longer it is.
    fn watch(&mut self, rest: f64) -> Result<(), Error> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let (unknowns, inputs) = motion.velocity(t, &y)?;
        let is_near = rest * to_f64(motion.scales.speed(&unknowns, &inputs)) < SIGHT;
        let is_next = self.integration.next_length().is_some_and(|next| rest < 2.0 * next);
        if !(is_near || is_next) {
            return Ok(());
        }
        let (q, _) = S::parts(&y);
        let independent = Independent::choose(mechanism, &mechanism.pose_at(&q), &motion.scales, &motion.held(t));
        let rates = independent.of(&unknowns, &inputs);
        let ahead = motion.over(
            &independent,
            (t, &Motion::<S, W, T, U, V, N, C>::pack(&q, &rates)),
            self.way(),
            self.relative(),
        )?;
        match ahead {
            Ahead::ChangePoint(step) => {
                self.take(Road::Others(independent), &rates);
                self.pass(independent, step);
            }
            Ahead::Near(length) => self.integration.limit_next(to_f64(length)),
            Ahead::Clear if is_next => {
                self.warned = WARNED;
                self.take(Road::Others(independent), &rates);
            }
            Ahead::Clear => {}
        }
        Ok(())
    }

    fn way(&self) -> T {
        if self.integration.end() < self.integration.t() { -T::one() } else { T::one() }
    }

    fn relative(&self) -> T {
        real(self.relative)
    }

    fn pass(&mut self, independent: Independent<T, U, V>, step: Interpolant<T, N>) {
        let step = step.up_to(self.integration.end()).unwrap_or(step);
        self.integration.system_mut().road = Road::Over(independent, step);
        self.integration.pass(step);
        self.passages.change_points += 1;
    }

    /// Whether nothing speaks for staying in other coordinates: a singularity that was met is passed, or seems to be
    /// avoided.
    fn is_past(&self, signs: &Signs<S, T, U, V, N, C>) -> bool {
        self.warned == 0 || !same_signs(self.signs.as_ref(), signs.as_ref())
    }

    fn leave_inputs(&mut self) -> Result<(), Error> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let pose = mechanism.pose_at(&S::parts(&y).0);
        let independent = Independent::choose(mechanism, &pose, &motion.scales, &motion.held(t));
        let (unknowns, inputs) = motion.velocity(t, &y)?;
        self.take(Road::Others(independent), &independent.of(&unknowns, &inputs));
        self.look_ahead(independent)
    }

    /// In other coordinates than the inputs: still the same, or better ones.
    fn stay(&mut self, mut independent: Independent<T, U, V>) -> Result<(), Error> {
        self.warned = self.warned.saturating_sub(1);
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let (q, mut rates) = Motion::<S, W, T, U, V, N, C>::unpack(&y);
        let pose = mechanism.pose_at(&q);
        independent.pivots = independent.factors(mechanism, &pose, &motion.scales).pivots();
        let best = Independent::choose(mechanism, &pose, &motion.scales, &motion.held(t));
        if best.regularity() > independent.regularity() * real(BETTER) {
            let (unknowns, inputs) = motion.velocity(t, &y)?;
            (rates, independent) = (best.of(&unknowns, &inputs), best);
            self.passages.exchanges += 1;
        }
        self.set(Road::Others(independent), &rates);
        self.look_ahead(independent)
    }

    /// Goes over a change point if one is near.
    fn look_ahead(&mut self, independent: Independent<T, U, V>) -> Result<(), Error> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        match motion.over(&independent, (t, &y), self.way(), self.relative())? {
            Ahead::ChangePoint(step) => self.pass(independent, step),
            _ if independent.regularity() < real(NEAREST) => return Err(motion.cannot_go_on(t, &S::parts(&y).0)),
            Ahead::Near(length) => self.integration.limit_next(to_f64(length)),
            Ahead::Clear => {}
        }
        Ok(())
    }

    fn take(&mut self, road: Road<T, U, V, N>, rates: &SVector<T, V>) {
        self.passages.exchanges += 1;
        self.set(road, rates)
    }

    fn set(&mut self, road: Road<T, U, V, N>, rates: &SVector<T, V>) {
        let (q, _) = S::parts(self.integration.state());
        self.integration.system_mut().road = road;
        let y = Motion::<S, W, T, U, V, N, C>::pack(&q, rates);
        let scale = scale_of(self.integration.system(), &q, self.frequency);
        // The same tolerance with other scales, which are positive as those before were.
        if let Ok(tolerance) = Tolerance::new(self.relative, scale) {
            self.integration.set_tolerance(tolerance);
        }
        self.integration.exchange(y);
    }

    fn output(&mut self, t: T) -> Result<Option<Moment<S, T, U, V, N, C>>, Error> {
        let end = self.integration.end();
        let [earliest, _] = self.integration.reached();
        let is_forward = end >= earliest;
        let ahead = to_f64(if is_forward { end - t } else { t - end });
        let behind = to_f64(if is_forward { t - earliest } else { earliest - t });
        if !(ahead >= 0.0 && behind >= 0.0) {
            let [a, b] = [earliest, end].map(to_f64);
            let (least, most) = if a < b { (a, b) } else { (b, a) };
            return Err(Error::OutOfRange { quantity: "the output time", value: to_f64(t), least, most });
        }
        while if is_forward { t > self.state.t } else { t < self.state.t } {
            if self.advance()?.is_none() {
                return Ok(None);
            }
        }
        if t == self.state.t {
            return Ok(Some(self.state));
        }
        let y = self.integration.state_within(t)?;
        let motion = self.integration.system();
        let closed = motion.closed(t, &y)?;
        let (closed, _) = motion.reviewed(&self.contacts, t, &closed)?;
        let mut state = motion.state(t, &closed)?;
        for (touch, mode) in state.contacts.iter_mut().zip(self.contacts.modes) {
            touch.mode = mode;
        }
        Ok(Some(state))
    }
}

impl<S, T, const U: usize, const V: usize, const N: usize, const C: usize, M, W, const K: usize> Iterator
    for Simulation<'_, S, T, U, V, N, C, M, W, K>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
    M: Method,
    W: Watch<T, Position<S, T, U, V, N, C>, Rates<S, T, U, V, N, C>, K, C>,
{
    type Item = Result<Moment<S, T, U, V, N, C>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

/// The states of a simulation at given times. Made by [`Simulation::at`].
///
/// It ends after the last time, where an event stops the simulation, or with an error; what came before stands. A time
/// that is not in the part of the interval that lies ahead is an [`Error::OutOfRange`].
pub struct Outputs<
    's,
    'a,
    S,
    T,
    I,
    const U: usize,
    const V: usize,
    const N: usize,
    const C: usize,
    M,
    W,
    const K: usize,
> where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    simulation: &'s mut Simulation<'a, S, T, U, V, N, C, M, W, K>,
    times: I,
    failed: bool,
}

impl<S, T, I, const U: usize, const V: usize, const N: usize, const C: usize, M, W, const K: usize> Iterator
    for Outputs<'_, '_, S, T, I, U, V, N, C, M, W, K>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
    I: Iterator<Item = T>,
    M: Method,
    W: Watch<T, Position<S, T, U, V, N, C>, Rates<S, T, U, V, N, C>, K, C>,
{
    type Item = Result<Moment<S, T, U, V, N, C>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let t = self.times.next()?;
        let state = self.simulation.output(t);
        self.failed = !matches!(state, Ok(Some(_)));
        state.transpose()
    }
}
