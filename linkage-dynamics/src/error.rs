//! Why a motion cannot be computed.

use core::fmt;

use linkage_runtime::{InputError, PathError, PositionError};

/// Why forces, accelerations or a motion cannot be computed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum MotionError {
    /// The reduced mass matrix is not positive: an input could accelerate without a force.
    NoInertia {
        /// The scene.
        scene: &'static str,
        /// The input.
        coordinate: &'static str,
        /// What is left of its reduced inertia while the inputs before it are held by forces alone, beside its
        /// reduced inertia while they stand still: 1 for one input, 0 where there is none.
        share: f64,
    },
    /// No forces or impulses of the frictions and stops agree with the motion: a prescribed motion drives through a
    /// stop, or stops leave no way to move.
    NoContactForces {
        /// The scene.
        scene: &'static str,
        /// A contact that takes part.
        contact: &'static str,
    },
    /// A simulation back in time of a scene with frictions or stops: what they take does not say where the motion came
    /// from.
    Irreversible {
        /// The scene.
        scene: &'static str,
        /// The first of its frictions and stops.
        contact: &'static str,
    },
    /// On the way of an integration a number is infinite or not a number.
    NotFinite {
        /// What is not finite.
        quantity: &'static str,
        /// The time.
        t: f64,
    },
    /// An integration needs steps that rounding swallows: near a singularity of the equations, or where they jump.
    StepTooSmall {
        /// The time that was reached.
        t: f64,
        /// The step that would have been tried.
        step: f64,
    },
    /// An integration has taken as many steps as it may.
    TooManySteps {
        /// The time that was reached.
        t: f64,
        /// The steps taken, accepted or not.
        steps: usize,
    },
    /// The equations have become stiff: stability, not accuracy, sets the length of the steps of an explicit method.
    Stiff {
        /// The time that was reached.
        t: f64,
        /// The step times the size of the fastest rate that holds it up.
        product: f64,
    },
    /// Events follow one another without time passing: a ball that has come to rest still bounces.
    EventsWithoutEnd {
        /// The time that was reached.
        t: f64,
        /// The number of the last event.
        event: usize,
    },
    /// A position on the way has no value.
    Position(PositionError),
    /// The motion comes to where motions cross, or cannot be followed.
    Path(PathError),
    /// What was given cannot be used.
    Input(InputError),
}

impl fmt::Display for MotionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoInertia { scene, coordinate, share } => {
                write!(f, "{coordinate} of {scene} has no inertia here: {share:.1e} of it is left")
            }
            Self::NoContactForces { scene, contact } => {
                write!(f, "no forces of frictions and stops agree with the motion of {scene}: {contact}")
            }
            Self::Irreversible { scene, contact } => {
                write!(
                    f,
                    "{scene} cannot be followed back in time, for it has a {contact}: let it end later than it starts"
                )
            }
            Self::NotFinite { quantity, t } => write!(f, "{quantity} is not a finite number at t = {t}"),
            Self::StepTooSmall { t, step } => write!(f, "the integration needs a step of {step:.1e} at t = {t}"),
            Self::TooManySteps { t, steps } => write!(f, "{steps} steps lead to t = {t} only"),
            Self::Stiff { t, product } => write!(
                f,
                "the equations have become stiff at t = {t}: the step times their fastest rate is {product:.1}"
            ),
            Self::EventsWithoutEnd { t, event } => write!(f, "event {event} happens without end at t = {t}"),
            Self::Position(error) => error.fmt(f),
            Self::Path(error) => error.fmt(f),
            Self::Input(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for MotionError {}

impl From<InputError> for MotionError {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl From<PositionError> for MotionError {
    fn from(error: PositionError) -> Self {
        match error {
            PositionError::Input(error) => Self::Input(error),
            error => Self::Position(error),
        }
    }
}

impl From<PathError> for MotionError {
    fn from(error: PathError) -> Self {
        match error {
            PathError::Input(error) => Self::Input(error),
            PathError::Position(error) => Self::Position(error),
            error => Self::Path(error),
        }
    }
}
