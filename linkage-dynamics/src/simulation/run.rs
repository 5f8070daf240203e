//! A simulation: its start, its settings, and what it tells.

use super::motion::Motion;
use super::outputs::States;
use super::road::{AtSingularity, Passages, scale_of};
use super::state::{Loads, State};
use super::watch::{EventFunctions, Then, Unwatched, Watch};
use crate::contact::Contacts;
use crate::integrate::{Counts, Crossing, Dop853, Integration, Method, Tolerance};
use crate::{Coordinates, Inputs, MotionError, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::jacobian::Scales;
use linkage_runtime::{Column, Dim, InputError, Mechanism, real};

/// What of the change of a step's length is dared. A mechanism is now slow and now fast within one turn, and the usual
/// 0.9 has every third step rejected.
const SAFETY_IN_TURNS: f64 = 0.8;

/// The determinants of the groups of a scene, whose signs tell branches apart.
pub(super) type Signs<S> = Column<<S as Scene>::Scalar, <<S as Scene>::Mechanism as Mechanism>::G>;

/// A simulation under way: an iterator over the [states](State) at the ends of its steps and at its events, which ends
/// with an error or at the end of the interval. What was reached stays readable after an error.
pub struct Simulation<'a, S: Scene, M = Dop853, W: Watch<S> = Unwatched> {
    pub(super) integration: Integration<Motion<'a, S, W>, M>,
    pub(super) relative: f64,
    /// The size of rates beside those of coordinates.
    pub(super) frequency: S::Scalar,
    pub(super) at_singularity: AtSingularity,
    pub(super) state: State<S>,
    /// The contacts in the step that led to the state.
    pub(super) contacts: Contacts<S::Scalar, S::Contacts>,
    /// Where the step begins, closed, with the signs of the determinants there.
    pub(super) from: (S::Scalar, StateColumn<S>),
    pub(super) signs: Signs<S>,
    pub(super) passages: Passages,
    /// Steps in other coordinates that are left since one in the inputs went over a singularity.
    pub(super) warned: u32,
    pub(super) is_over: bool,
    /// Why nothing follows the state.
    pub(super) failure: Option<MotionError>,
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
/// Those of [`Scene::start`]: [`InputError::OutOfRange`], [`InputError::Inconsistent`],
/// [`PositionError::NotConverged`](linkage_runtime::PositionError::NotConverged); those of the equations of motion there;
/// [`MotionError::Irreversible`] if `end` is the earlier and the scene has frictions or stops;
/// [`InputError::OutOfRange`] for a tolerance below ten roundings or above 1 and for times that are not finite.
pub fn simulate<S: Scene>(
    scene: &S,
    (t, q, input_rates): (S::Scalar, Coordinates<S>, impl Into<Inputs<S>>),
    end: S::Scalar,
    tolerance: f64,
) -> Result<Simulation<'_, S>, MotionError> {
    let mechanism = scene.mechanism();
    let y = scene.start(t, &q, &input_rates.into())?;
    let (q, _) = S::parts(&y);
    let scales = Scales::of(mechanism, &mechanism.pose_at(&q));
    let mut motion = Motion::new(scene, scales);
    if S::Contacts::COUNT > 0 && end < t {
        let contacts = motion.contacts_alone(t, &y)?.contacts;
        let contact = contacts.iter().next().map(|contact| contact.name).unwrap_or_default();
        return Err(MotionError::Irreversible { scene: S::NAME, contact });
    }
    let y = if S::Contacts::COUNT > 0 { motion.begin(t, &y)? } else { y };
    let contacts = motion.contacts;
    let velocity = motion.velocity(t, &y)?;
    let (_, accelerations) = Motion::<S, Unwatched>::unpack(&scene.derivative(t, &y)?);
    let speed = motion.size_of(&velocity);
    let urge = accelerations.component_div(&scales.coordinates.inputs).largest().sqrt();
    let span = to_f64(end - t).abs();
    let frequency = speed.max(urge);
    let slow = if span > 0.0 { real(span.recip()) } else { S::Scalar::one() };
    let frequency = if frequency > S::Scalar::zero() { frequency } else { slow };
    let state = motion.state(t, &y)?;
    let scale = scale_of(&motion, frequency);
    let mut integration = Integration::new(motion, (t, y), end, Tolerance::new(tolerance, scale)?)?;
    integration.set_safety(SAFETY_IN_TURNS);
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

impl<'a, S: Scene, M: Method, W: Watch<S>> Simulation<'a, S, M, W> {
    /// The same by another method: [`Dopri5`](crate::integrate::Dopri5) for pictures.
    ///
    /// # Errors
    /// None that [`simulate`] has not found.
    pub fn method<M2: Method>(self) -> Result<Simulation<'a, S, M2, W>, MotionError> {
        self.with(|motion| motion)
    }

    /// Watches K functions of the state: `values` gives them, `crossings` says which way each must pass through zero,
    /// and `action` what happens at an event. Set it before the first step.
    ///
    /// # Errors
    /// None that [`simulate`] has not found.
    pub fn events<F, A, const K: usize>(
        self,
        crossings: [Crossing; K],
        values: F,
        action: A,
    ) -> Result<Simulation<'a, S, M, EventFunctions<F, A, K>>, MotionError>
    where
        F: FnMut(&State<S>) -> Result<[S::Scalar; K], MotionError>,
        A: FnMut(usize, &State<S>) -> Result<Then<Inputs<S>>, MotionError>,
    {
        self.with(|motion| motion.watched(EventFunctions { crossings, values, action }))
    }

    fn with<M2: Method, W2: Watch<S>>(
        self,
        motion: impl FnOnce(Motion<'a, S, W>) -> Motion<'a, S, W2>,
    ) -> Result<Simulation<'a, S, M2, W2>, MotionError> {
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
    /// [`InputError::OutOfRange`] if it is not positive and finite.
    pub fn largest_step(mut self, length: S::Scalar) -> Result<Self, InputError> {
        self.integration = self.integration.largest_step(length)?;
        Ok(self)
    }

    /// The length of the first step, in place of an estimate.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if it is not positive and finite.
    pub fn first_step(mut self, length: S::Scalar) -> Result<Self, InputError> {
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
    pub fn t(&self) -> S::Scalar {
        self.state.t
    }

    /// The last state that was reached.
    #[must_use]
    pub fn state(&self) -> &State<S> {
        &self.state
    }

    /// The forces of frictions, stops and drives at the last state that was reached, at an event those after it.
    ///
    /// # Errors
    /// Those of the equations of motion, and [`PathError::ChangePoint`](linkage_runtime::PathError::ChangePoint) very near to one.
    pub fn loads(&self) -> Result<Loads<S>, MotionError> {
        let (t, motion) = (self.integration.t(), self.integration.system());
        let y = motion.closed(t, self.integration.state())?;
        let (contacts, drives) = motion.loads(t, &y)?;
        let drive_power = drives.dot(&motion.velocity(t, &y)?.inputs);
        if !contacts.iter().chain(drives.iter()).chain([&drive_power]).all(S::Scalar::is_finite) {
            return Err(MotionError::NotFinite { quantity: "the loads", t: to_f64(t) });
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
    pub fn at<I: IntoIterator<Item = S::Scalar>>(&mut self, times: I) -> States<'_, 'a, S, M, W, I::IntoIter> {
        States { simulation: self, times: times.into_iter(), failed: false }
    }

    /// Simulates to the end. `watch` sees every state and how much of the interval is done; where it returns false the
    /// simulation pauses, and may be continued.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn finish(&mut self, mut watch: impl FnMut(&State<S>, f64) -> bool) -> Result<(), MotionError> {
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
    /// What the scene returns where no shorter step avoids it,
    /// [`PositionError::Singular`](linkage_runtime::PositionError::Singular) and
    /// [`PathError::ChangePoint`](linkage_runtime::PathError::ChangePoint) where the motion cannot be followed, and those of
    /// [`Integration::advance`]. Nothing follows after an error.
    pub fn advance(&mut self) -> Result<Option<State<S>>, MotionError> {
        if self.is_over || (self.failure.is_none() && self.integration.is_over()) {
            return Ok(None);
        }
        let result = self.failure.take().map_or_else(|| self.proceed(), Err);
        self.is_over = result.is_err();
        result
    }
}

impl<S: Scene, M: Method, W: Watch<S>> Iterator for Simulation<'_, S, M, W> {
    type Item = Result<State<S>, MotionError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}
