//! Simulation with steps of fixed length and cost.

use super::held::IntoHeldScene;
use super::motion::Motion;
use super::start::Start;
use super::state::State;
use super::watch::Unwatched;
use crate::integrate::{FixedStep, System};
use crate::{Coordinates, Inputs, MotionErrorOf, NameOf, Scene, StateColumn};
use linkage_runtime::__shared::same_signs;
use linkage_runtime::jacobian::Scales;
use linkage_runtime::{Column, D, Mechanism};

/// A simulation with steps of fixed length, each with four evaluations of the equations in the inputs and one
/// projection onto the constraints: [`FixedStep`]. No step is repeated, and none passes a singularity of the inputs. None
/// ends at a kink of a law: where the rate of a drive jumps, its impulse acts at the end of the step.
pub struct RealTime<'a, S: Scene<Contacts = D<0>>> {
    steps: FixedStep<Projected<'a, S>>,
}

/// A motion that is projected onto the constraints before each step.
struct Projected<'a, S: Scene<Contacts = D<0>>>(Motion<'a, S, Unwatched>);

impl<S: Scene<Contacts = D<0>>> System for Projected<'_, S> {
    type Scalar = S::Scalar;
    type Name = NameOf<S>;
    type N = S::State;
    type Events = D<0>;
    type Guards = D<0>;

    fn rate(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        self.0.scene.derivative(self.0.beside(t), y)
    }

    fn events(&mut self, _: S::Scalar, _: &StateColumn<S>) -> Result<Column<S::Scalar, D<0>>, MotionErrorOf<S>> {
        Ok(Column::from([]))
    }

    fn before_step(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<Option<StateColumn<S>>, MotionErrorOf<S>> {
        self.0.begin_step(t);
        self.0.projected_with_jumps(t, y).map(Some)
    }
}

impl<'a, S: Scene<Contacts = D<0>>> RealTime<'a, S> {
    /// Starts with steps of this length. The scene is `&scene`, `scene` or an `Arc` of it.
    ///
    /// # Errors
    /// Those of [`Scene::start`], and [`InputError::OutOfRange`](linkage_runtime::InputError::OutOfRange) if the length
    /// is zero or not finite.
    pub fn new<By>(
        scene: impl IntoHeldScene<'a, By, Of = S>,
        start: Start<S::Scalar, Coordinates<S>, impl Into<Inputs<S>>>,
        length: S::Scalar,
    ) -> Result<Self, MotionErrorOf<S>> {
        let (scene, Start { t, q, input_rates }) = (scene.into_held_scene(), start);
        let y = scene.start(t, &q, &input_rates.into())?;
        let scales = Scales::of(scene.mechanism(), &scene.mechanism().pose_at(&q));
        let motion = Motion::new(scene, scales, [t, t + length]);
        Ok(Self { steps: FixedStep::new(Projected(motion), (t, y), length)? })
    }

    /// The time.
    #[must_use]
    pub fn t(&self) -> S::Scalar {
        self.steps.t()
    }

    /// The state reached, projected onto the constraints.
    ///
    /// # Errors
    /// [`PositionError::NotConverged`](linkage_runtime::PositionError::NotConverged) if the constraints cannot be
    /// satisfied, [`PositionError::Singular`](linkage_runtime::PositionError::Singular) where J is singular.
    pub fn state(&self) -> Result<State<S>, MotionErrorOf<S>> {
        let (t, motion) = (self.t(), &self.steps.system().0);
        motion.state(t, &motion.projected_with_jumps(t, self.steps.state())?)
    }

    /// Takes a step.
    ///
    /// # Errors
    /// Those of the scene, and [`PositionError::Singular`](linkage_runtime::PositionError::Singular) if the step passes
    /// a singularity; time and state then stay unchanged.
    pub fn step(&mut self) -> Result<(), MotionErrorOf<S>> {
        let before = *self.steps.state();
        self.steps.step()?;
        let motion = &self.steps.system().0;
        let mechanism = motion.scene.mechanism();
        let signs = |y: &StateColumn<S>| mechanism.block_determinants(&mechanism.pose_at(&motion.scene.parts_of(y).q));
        let q = motion.scene.parts_of(self.steps.state()).q;
        if same_signs(signs(&before).as_slice(), signs(self.steps.state()).as_slice()) {
            return Ok(());
        }
        let error = motion.singular_error(&q);
        self.steps.undo(before);
        Err(error)
    }
}
