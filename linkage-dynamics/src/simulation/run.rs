//! A simulation: start, settings and results.

use super::data::{AtSingularity, Passages, Simulation};
use super::failure::start_error;
use super::held::IntoHeldScene;
use super::motion::Motion;
use super::outputs::States;
use super::parametrisation::scale_of;
use super::start::Start;
use super::state::State;
use super::watch::{EventFunctions, Then, Unwatched, Watch};
use crate::integrate::{Counts, Crossing, Integration, Method, Tolerance};
use crate::scene::Loads;
use crate::{Coordinates, Inputs, MotionError, MotionErrorOf, NameOf, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::jacobian::Scales;
use linkage_runtime::{Dim, InputError, Mechanism, Name, real};

/// The safety factor of the step-size controller. The speed of a mechanism varies within each turn; with the usual 0.9
/// every third step is rejected.
const SAFETY_IN_TURNS: f64 = 0.8;

/// Starts a simulation of this scene, to the time `end`, by the method of order 8(5,3). `tolerance` is the allowed
/// relative error of a step, such as 1e-9: relative to the magnitude of each coordinate and rate plus its scale, which
/// is 1 rad or the lengths of the loops, and for rates that times the angular frequency of the motion at the start.
///
/// The position may be approximate: it is projected onto the constraints with its inputs fixed. The scene is `&scene`, or
/// `scene` or an `Arc` of it, for a simulation that outlives the function that starts it.
///
/// # Errors
/// Those of [`Scene::start`]: [`InputError::OutOfRange`], [`InputError::Inconsistent`],
/// [`PositionError::NotConverged`](linkage_runtime::PositionError::NotConverged); those of the equations of motion at the
/// start, [`PositionError::Singular`](linkage_runtime::PositionError::Singular) at a dead point and
/// [`MotionError::ChangePoint`] at a change point, which of whose motions is to follow the rates of the inputs do not tell;
/// [`MotionError::Irreversible`] if `end` is before the start and the scene has frictions or stops;
/// [`InputError::OutOfRange`] for a tolerance below ten ulps or above 1 and for times that are not finite.
pub fn simulate<'a, S: Scene, By>(
    scene: impl IntoHeldScene<'a, By, Of = S>,
    start: Start<S::Scalar, Coordinates<S>, impl Into<Inputs<S>>>,
    end: S::Scalar,
    tolerance: f64,
) -> Result<Simulation<'a, S>, MotionErrorOf<S>> {
    let (scene, Start { t, q: given, input_rates }) = (scene.into_held_scene(), start);
    let y = scene.start(t, &given, &input_rates.into()).map_err(|error| start_error(&*scene, &given, error))?;
    let q = scene.parts_of(&y).q;
    let mechanism = scene.mechanism();
    let pose = mechanism.pose_at(&q);
    let (scales, signs) = (Scales::of(mechanism, &pose), mechanism.block_determinants(&pose));
    let mut motion = Motion::new(scene, scales, [t, end]);
    let begun = begin(&mut motion, (t, y), end);
    let Begun { y, frequency, state } = begun.map_err(|error| start_error(&*motion.scene, &given, error))?;
    let (contacts, scale) = (motion.contacts, scale_of(&motion, frequency));
    let mut integration = Integration::new(motion, (t, y), end, Tolerance::checked(tolerance, scale)?)?;
    integration.set_safety(SAFETY_IN_TURNS);
    Ok(Simulation {
        integration,
        relative: tolerance,
        frequency,
        at_singularity: AtSingularity::Pass,
        state,
        contacts,
        output: None,
        gap: None,
        from: (t, y),
        signs,
        passages: Passages::default(),
        is_beyond: false,
        steps_before_return: 0,
        is_over: false,
        failure: None,
        is_prepared: false,
    })
}

/// The start of a motion.
struct Begun<S: Scene> {
    y: StateColumn<S>,
    frequency: S::Scalar,
    state: State<S>,
}

/// Begins a motion, with its contacts, at a state that is projected onto the constraints.
fn begin<S: Scene>(
    motion: &mut Motion<'_, S, Unwatched>,
    (t, y): (S::Scalar, StateColumn<S>),
    end: S::Scalar,
) -> Result<Begun<S>, MotionErrorOf<S>> {
    let y = motion.off_kinks(t, &y).filter(|_| motion.scene.derivative(motion.beside(t), &y).is_err()).unwrap_or(y);
    if motion.names.dim().count() > 0 && end < t {
        let contacts = motion.contacts_alone(t, &y)?.contacts;
        let contact = contacts.iter().next().map_or_else(|| Name::from_static(""), |contact| contact.name);
        return Err(MotionError::Irreversible { scene: motion.scene.name(), contact });
    }
    let y = if motion.names.dim().count() > 0 { motion.begin(t, &y)? } else { y };
    let velocity = motion.velocity(&y)?;
    let (_, accelerations) = motion.unpack(&motion.scene.derivative(motion.beside(t), &y)?);
    let speed = motion.scaled_norm(&velocity);
    let urge = accelerations.component_div(&motion.scales.coordinates.inputs).largest().sqrt();
    let span = to_f64(end - t).abs();
    let frequency = speed.max(urge);
    let slow = if span > 0.0 { real(span.recip()) } else { S::Scalar::one() };
    let frequency = if frequency > S::Scalar::zero() { frequency } else { slow };
    Ok(Begun { y, frequency, state: motion.state(t, &y)? })
}

impl<'a, S: Scene, M: Method, W: Watch<S>> Simulation<'a, S, M, W> {
    /// Changes the method: [`Dopri5`](crate::integrate::Dopri5) for pictures.
    ///
    /// # Errors
    /// Those of [`simulate`]; after it has succeeded there are none.
    pub fn method<M2: Method>(self) -> Result<Simulation<'a, S, M2, W>, MotionErrorOf<S>> {
        self.with(|motion| motion)
    }

    /// Sets K event functions: `values` computes them, `crossings` is the direction in which each must pass through
    /// zero, and `action` handles an event. Call it before the first step.
    ///
    /// # Errors
    /// Those of [`simulate`]; after it has succeeded there are none.
    pub fn events<F, A, const K: usize>(
        self,
        crossings: [Crossing; K],
        values: F,
        action: A,
    ) -> Result<Simulation<'a, S, M, EventFunctions<F, A, K>>, MotionErrorOf<S>>
    where
        F: FnMut(&State<S>) -> Result<[S::Scalar; K], MotionErrorOf<S>>,
        A: FnMut(usize, &State<S>) -> Result<Then<Inputs<S>>, MotionErrorOf<S>>,
    {
        self.with(|motion| motion.watched(EventFunctions { crossings, values, action }))
    }

    fn with<M2: Method, W2: Watch<S>>(
        self,
        motion: impl FnOnce(Motion<'a, S, W>) -> Motion<'a, S, W2>,
    ) -> Result<Simulation<'a, S, M2, W2>, MotionErrorOf<S>> {
        Ok(Simulation {
            integration: self.integration.with(motion)?,
            relative: self.relative,
            frequency: self.frequency,
            at_singularity: self.at_singularity,
            state: self.state,
            contacts: self.contacts,
            output: self.output,
            gap: self.gap,
            from: self.from,
            signs: self.signs,
            passages: self.passages,
            is_beyond: self.is_beyond,
            steps_before_return: self.steps_before_return,
            is_over: self.is_over,
            failure: self.failure,
            is_prepared: self.is_prepared,
        })
    }

    /// Sets the behaviour at singularities of the inputs; the default is to continue.
    #[must_use]
    pub fn at_singularity(mut self, policy: AtSingularity) -> Self {
        self.at_singularity = policy;
        self
    }

    /// Sets the largest step; the default is the whole interval.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if it is not positive and finite.
    pub fn largest_step(mut self, length: S::Scalar) -> Result<Self, InputError<NameOf<S>>> {
        self.integration = self.integration.largest_step(length)?;
        Ok(self)
    }

    /// Sets the length of the first step; the default is an estimate.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if it is not positive and finite.
    pub fn first_step(mut self, length: S::Scalar) -> Result<Self, InputError<NameOf<S>>> {
        self.integration = self.integration.first_step(length)?;
        Ok(self)
    }

    /// Sets the limit on the number of steps, rejected ones included; the default is 100 000.
    #[must_use]
    pub fn most_steps(mut self, steps: usize) -> Self {
        self.integration = self.integration.most_steps(steps);
        self
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &S {
        &self.integration.system().scene
    }

    /// The time reached.
    #[must_use]
    pub fn t(&self) -> S::Scalar {
        self.state.t
    }

    /// The state reached.
    #[must_use]
    pub fn state(&self) -> &State<S> {
        &self.state
    }

    /// The forces of frictions, stops, drives and joints at the state that [`advance`](Self::advance) or
    /// [`at`](Self::at) returned last, before the first at the start; at an event, those after it.
    /// [`States::with_loads`] has those of many times, and [`Scene::loads`] those of any state.
    ///
    /// # Errors
    /// Those of the equations of motion, and [`MotionError::UndeterminedReactions`] next to a change point if the scene
    /// has forces in joints.
    pub fn loads(&self) -> Result<Loads<S>, MotionErrorOf<S>> {
        let motion = self.integration.system();
        if let Some((t, y, contacts)) = &self.output {
            return motion.loads(contacts, *t, y);
        }
        let t = self.integration.t();
        let y = motion.projected(t, self.integration.state())?;
        motion.loads(&motion.contacts, t, &y)
    }

    /// The part of the interval that is done, from 0 to 1.
    #[must_use]
    pub fn progress(&self) -> f64 {
        self.integration.progress()
    }

    /// The cost so far.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.integration.counts()
    }

    /// The singularities passed so far.
    #[must_use]
    pub fn passages(&self) -> Passages {
        self.passages
    }

    /// Returns the states at these times, which must be in the direction of the simulation, by dense output and
    /// projection onto the constraints. This does not change the steps.
    pub fn at<I: IntoIterator<Item = S::Scalar>>(&mut self, times: I) -> States<'_, 'a, S, M, W, I::IntoIter> {
        States { simulation: self, times: times.into_iter(), failed: false }
    }

    /// Simulates to the end. `watch` receives every state and the progress from 0 to 1; if it returns false the
    /// simulation pauses, and may be continued.
    ///
    /// # Errors
    /// Those of [`advance`](Self::advance).
    pub fn finish(&mut self, mut watch: impl FnMut(&State<S>, f64) -> bool) -> Result<(), MotionErrorOf<S>> {
        while let Some(state) = self.advance()? {
            if !watch(&state, self.progress()) {
                break;
            }
        }
        Ok(())
    }

    /// Advances to the next event or to the end of the step; returns None at the end.
    ///
    /// # Errors
    /// Those of the scene, if no shorter step avoids them,
    /// [`PositionError::Singular`](linkage_runtime::PositionError::Singular) and
    /// [`MotionError::ChangePoint`] where the motion cannot be followed, and those of [`Integration::advance`]. After
    /// an error the simulation has ended.
    pub fn advance(&mut self) -> Result<Option<State<S>>, MotionErrorOf<S>> {
        let before = self.state.t;
        while let Some(has_changed) = self.advance_within()? {
            // Also at an event that changes nothing: the motion restarts there, and no state before it remains.
            if has_changed || self.state.t != before {
                return Ok(Some(self.state));
            }
        }
        Ok(None)
    }

    /// Does the same, and returns false at an event that changes nothing.
    pub(super) fn advance_within(&mut self) -> Result<Option<bool>, MotionErrorOf<S>> {
        self.output = None;
        if self.is_over || (self.failure.is_none() && self.integration.is_over()) {
            return Ok(None);
        }
        let result = self.failure.take().map_or_else(|| self.proceed(), Err);
        self.is_over = result.is_err();
        result
    }
}

impl<S: Scene, M: Method, W: Watch<S>> Iterator for Simulation<'_, S, M, W> {
    type Item = Result<State<S>, MotionErrorOf<S>>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}
