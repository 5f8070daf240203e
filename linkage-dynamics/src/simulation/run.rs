//! A simulation: its start, its settings, and what it tells.

use nalgebra::SVector;

use super::motion::{Motion, Position};
use super::outputs::Outputs;
use super::road::{AtSingularity, Passages, scale_of};
use super::scales::Scales;
use super::state::{Loads, State};
use super::watch::{Then, Unwatched, Watch, Watched};
use crate::Inputs;
use crate::Scene;
use crate::contact::Contacts;
use crate::integrate::{Counts, Crossing, Dop853, Integration, Method, Tolerance};
use linkage_runtime::__shared::{largest, to_f64};
use linkage_runtime::{Error, Mechanism, Real, real};

/// What of the change of a step's length is dared. A mechanism is now slow and now fast within one turn, and the usual
/// 0.9 has every third step rejected.
const SAFETY: f64 = 0.8;

pub(super) type Moment<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
    State<T, Position<S, T, U, V, N, C>, C>;
pub(super) type Rates<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
    Inputs<<S as Scene<T, U, V, N, C>>::Mechanism, T, U, V>;
pub(super) type Signs<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
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
    pub(super) integration: Integration<M, Motion<'a, S, W, T, U, V, N, C>, T, N, K, C>,
    pub(super) relative: f64,
    /// The size of rates beside those of coordinates.
    pub(super) frequency: T,
    pub(super) at_singularity: AtSingularity,
    pub(super) state: Moment<S, T, U, V, N, C>,
    /// The contacts in the step that led to the state.
    pub(super) contacts: Contacts<T, C>,
    /// Where the step begins, closed, with the signs of the determinants there.
    pub(super) from: (T, SVector<T, N>),
    pub(super) signs: Signs<S, T, U, V, N, C>,
    pub(super) passages: Passages,
    /// Steps in other coordinates that are left since one in the inputs went over a singularity.
    pub(super) warned: u32,
    pub(super) is_over: bool,
    /// Why nothing follows the state.
    pub(super) failure: Option<Error>,
    /// The next step is prepared.
    pub(super) is_prepared: bool,
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
/// equations of motion there; [`Error::Irreversible`] if `end` is the earlier and the scene has frictions or stops;
/// [`Error::OutOfRange`] for a tolerance below ten roundings or above 1 and for times
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
    if C > 0 && end < t {
        let contact = motion.contacts_alone(t, &y)?.contacts[0].name;
        return Err(Error::Irreversible { scene: S::NAME, contact });
    }
    let y = if C > 0 { motion.begin(t, &y)? } else { y };
    let contacts = motion.contacts;
    let (unknowns, inputs) = motion.velocity(t, &y)?;
    let (_, accelerations) = Motion::<S, Unwatched, T, U, V, N, C>::unpack(&scene.derivative(t, &y)?);
    let speed = scales.speed(&unknowns, &inputs);
    let urge = largest(accelerations.component_div(&scales.inputs).iter().copied()).sqrt();
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
        let drive_power = drives.dot(&rates);
        if !contacts.iter().chain(drives.iter()).chain([&drive_power]).all(T::is_finite) {
            return Err(Error::NotFiniteAt { quantity: "the loads", t: to_f64(t) });
        }
        Ok(Loads { contacts, drives: drives.into(), drive_power })
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
