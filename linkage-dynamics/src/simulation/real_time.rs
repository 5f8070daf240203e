//! Simulation in step with a clock.

use nalgebra::SVector;

use super::motion::Motion;
use super::scales::Scales;
use super::state::State;
use super::watch::Unwatched;
use crate::Scene;
use crate::integrate::{FixedStep, System};
use crate::{Coordinates, Inputs};
use linkage_runtime::__shared::same_signs;
use linkage_runtime::{Error, Mechanism, Real};

/// A scene by steps of one length, each of four evaluations of its equations in the inputs and one closing of the
/// closures: [`FixedStep`]. Nothing is tried twice, and no step goes over a singularity of the inputs.
pub struct RealTime<'a, S, T: Real, const U: usize, const V: usize, const N: usize> {
    steps: FixedStep<Closing<'a, S, T, U, V, N>, T, N>,
}

/// A motion whose closures are closed before each step.
struct Closing<'a, S, T: Real, const U: usize, const V: usize, const N: usize>(Motion<'a, S, Unwatched, T, U, V, N, 0>);

impl<S, T, const U: usize, const V: usize, const N: usize> System<T, N, 0> for Closing<'_, S, T, U, V, N>
where
    S: Scene<T, U, V, N, 0>,
    T: Real,
{
    fn rate(&mut self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        self.0.scene.derivative(t, y)
    }

    fn events(&mut self, _: T, _: &SVector<T, N>) -> Result<[T; 0], Error> {
        Ok([])
    }

    fn before_step(&mut self, t: T, y: &SVector<T, N>) -> Result<Option<SVector<T, N>>, Error> {
        self.0.closed(t, y).map(Some)
    }
}

impl<'a, S, T, const U: usize, const V: usize, const N: usize> RealTime<'a, S, T, U, V, N>
where
    S: Scene<T, U, V, N, 0>,
    T: Real,
{
    /// From a time, a position and the rates of the inputs there, by steps of this length.
    ///
    /// # Errors
    /// Those of [`Scene::start`], and [`Error::OutOfRange`] if the length is zero or not finite.
    pub fn new(
        scene: &'a S,
        (t, q, rates): (T, Coordinates<S::Mechanism, T, U, V>, impl Into<Inputs<S::Mechanism, T, U, V>>),
        length: T,
    ) -> Result<Self, Error> {
        let y = scene.start(t, &q, &rates.into())?;
        let scales = Scales::of(scene.mechanism(), &q);
        let motion = Motion::new(scene, scales);
        Ok(Self { steps: FixedStep::new(Closing(motion), (t, y), length)? })
    }

    /// The time.
    #[must_use]
    pub fn t(&self) -> T {
        self.steps.t()
    }

    /// The state that was reached, closed.
    ///
    /// # Errors
    /// [`Error::NotConverged`] if the closures cannot be closed, [`Error::Singular`] where J has no inverse.
    pub fn state(&self) -> Result<State<T, Coordinates<S::Mechanism, T, U, V>>, Error> {
        let (t, motion) = (self.t(), &self.steps.system().0);
        motion.state(t, &motion.closed(t, self.steps.state())?)
    }

    /// Takes a step.
    ///
    /// # Errors
    /// What the scene returns, and [`Error::Singular`] if the step goes over a singularity; time and state stay what
    /// they were.
    pub fn step(&mut self) -> Result<(), Error> {
        let before = *self.steps.state();
        self.steps.step()?;
        let motion = &self.steps.system().0;
        let mechanism = motion.scene.mechanism();
        let signs = |y: &SVector<T, N>| mechanism.block_determinants(&mechanism.pose_at(&S::parts(y).0));
        let (q, _) = S::parts(self.steps.state());
        if same_signs(signs(&before).as_ref(), signs(self.steps.state()).as_ref()) {
            return Ok(());
        }
        let error = motion.singular(&q);
        self.steps.undo(before);
        Err(error)
    }
}
