//! The error type of dynamics.

use core::fmt;

use linkage_runtime::__shared::to_f64;
use linkage_runtime::{InputError, PathError, PositionError, Real};

/// The reason why forces, accelerations or a motion cannot be computed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum MotionError {
    /// The reduced mass matrix is not positive definite: an input could accelerate without a force.
    NoInertia {
        /// The scene.
        scene: &'static str,
        /// The input.
        coordinate: &'static str,
        /// Cholesky pivot divided by the diagonal entry of the mass matrix, from 0 (no inertia) to 1.
        share: f64,
    },
    /// No contact forces or impulses satisfy the motion: a prescribed motion drives through a stop, or the stops
    /// contradict each other.
    NoContactForces {
        /// The scene.
        scene: &'static str,
        /// A contact that is involved.
        contact: &'static str,
    },
    /// No acceleration satisfies the law of every contact, as in Painleve's paradox.
    NoMotion {
        /// The scene.
        scene: &'static str,
        /// The friction by a reaction that is involved.
        contact: &'static str,
        /// The time, in a simulation.
        t: Option<f64>,
    },
    /// Several accelerations satisfy the law of every contact, as in Painleve's paradox.
    SeveralMotions {
        /// The scene.
        scene: &'static str,
        /// A friction that differs between them.
        contact: &'static str,
        /// The time, in a simulation.
        t: Option<f64>,
    },
    /// The number of accelerations that satisfy the law of every contact was not found.
    UndecidedMotion {
        /// The scene.
        scene: &'static str,
        /// The friction by a reaction that is involved.
        contact: &'static str,
        /// The time, in a simulation.
        t: Option<f64>,
    },
    /// A scene with frictions or stops is simulated backwards in time: dissipated energy cannot be recovered.
    Irreversible {
        /// The scene.
        scene: &'static str,
        /// The first of its frictions and stops.
        contact: &'static str,
    },
    /// s is not on the stop on which it rests: its position has jumped.
    LeftStop {
        /// The scene.
        scene: &'static str,
        /// The stop.
        stop: &'static str,
        /// s minus the position of the stop.
        gap: f64,
        /// The time.
        t: f64,
    },
    /// The law of a drive jumps in position.
    DriveJumps {
        /// The scene.
        scene: &'static str,
        /// The driven input.
        coordinate: &'static str,
        /// The time.
        t: f64,
    },
    /// The law of an effect has kinks without end: at this time, or ever closer together.
    KinksWithoutEnd {
        /// The scene.
        scene: &'static str,
        /// The effect, or the driven input.
        effect: &'static str,
        /// The time.
        t: f64,
    },
    /// A number became infinite or NaN during an integration.
    NotFinite {
        /// The quantity that is not finite.
        quantity: &'static str,
        /// The time.
        t: f64,
    },
    /// The step has become smaller than the rounding error of t: near a singularity of the equations, or at a jump.
    StepTooSmall {
        /// The time that was reached.
        t: f64,
        /// The next step that was too small.
        step: f64,
    },
    /// The limit on the number of steps is reached.
    TooManySteps {
        /// The time that was reached.
        t: f64,
        /// The number of steps taken, rejected ones included.
        steps: usize,
    },
    /// The equations have become stiff: a motion that decays within a step limits it, so that stability and not accuracy
    /// determines the step of an explicit method.
    Stiff {
        /// The time that was reached.
        t: f64,
        /// h |lambda|: the step times an estimate of the dominant eigenvalue.
        product: f64,
    },
    /// An event repeats at the same time: for example, a ball at rest that still bounces.
    EventsWithoutEnd {
        /// The time that was reached.
        t: f64,
        /// The index of the last event.
        event: usize,
    },
    /// The position is a change point, where motions of the mechanism cross, and none of them is chosen: at a start
    /// there, or where a contact changes exactly there. Also where motions are nearer to each other than rounding
    /// errors.
    ChangePoint {
        /// The scene.
        scene: &'static str,
        /// The unknowns of the group that is singular; of several the one nearest to a singularity.
        group: &'static str,
        /// The rates along the motions that cross, if there are two of one input.
        crossing: Option<CrossingRates>,
    },
    /// Forces in joints, or frictions that depend on them, are infinite or undetermined at a change point.
    UndeterminedReactions {
        /// The scene.
        scene: &'static str,
        /// The unknowns of the group that is singular.
        group: &'static str,
    },
    /// A friction or a stop changes without end at the same time: for example, a body hits two stops that meet in turn.
    ContactWithoutEnd {
        /// The scene.
        scene: &'static str,
        /// The friction or stop that changed last.
        contact: &'static str,
        /// The time that was reached.
        t: f64,
    },
    /// A position during the motion could not be computed.
    Position(PositionError),
    /// An error of path following, from the user's own functions.
    Path(PathError),
    /// An argument is invalid.
    Input(InputError),
}

/// The rates of two coordinates along the two motions that cross at a change point, each pair up to a factor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CrossingRates {
    /// The names of the coordinates.
    pub coordinates: [&'static str; 2],
    /// Their rates along each motion; the larger one is 1.
    pub rates: [[f64; 2]; 2],
}

impl MotionError {
    /// Adds the time of a simulation to an error of contacts that has none.
    pub(crate) fn at<T: Real>(mut self, now: T) -> Self {
        if let Self::NoMotion { t, .. } | Self::SeveralMotions { t, .. } | Self::UndecidedMotion { t, .. } = &mut self
            && t.is_none()
        {
            *t = Some(to_f64(now));
        }
        self
    }
}

/// ` at t = 2`, or nothing.
struct At(Option<f64>);

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |t| write!(f, " at t = {t}"))
    }
}

impl fmt::Display for MotionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoInertia { scene, coordinate, share } => write!(
                f,
                "the mass matrix of {scene} is singular in {coordinate} (pivot / diagonal {share:.1e}): give the bodies \
                 that it moves mass or inertia"
            ),
            Self::NoContactForces { scene, contact } => {
                write!(
                    f,
                    "no contact forces satisfy the motion of {scene}, {contact} included: a prescribed motion drives \
                     through a stop, or stops contradict each other"
                )
            }
            Self::NoMotion { scene, contact, t } => write!(
                f,
                "no acceleration of {scene} satisfies the law of {contact}{}: reduce the friction or give a given limit",
                At(*t)
            ),
            Self::SeveralMotions { scene, contact, t } => write!(
                f,
                "several accelerations of {scene} satisfy the law of {contact}{}: reduce the friction or give a given \
                 limit",
                At(*t)
            ),
            Self::UndecidedMotion { scene, contact, t } => write!(
                f,
                "the motion of {scene} was not found, nor shown not to exist, with {contact}{}: reduce the friction or \
                 the number of contacts at rest",
                At(*t)
            ),
            Self::Irreversible { scene, contact } => {
                write!(
                    f,
                    "{scene} has a {contact} and cannot be simulated backwards in time: choose an end after the start"
                )
            }
            Self::LeftStop { scene, stop, gap, t } => write!(
                f,
                "the {stop} in {scene} is left by {gap:.1e} at t = {t}, although it holds: the position jumps"
            ),
            Self::DriveJumps { scene, coordinate, t } => write!(
                f,
                "the drive of {coordinate} in {scene} jumps in position at t = {t}: write a law without jumps"
            ),
            Self::KinksWithoutEnd { scene, effect, t } => write!(
                f,
                "the law of {effect} in {scene} has kinks without end at t = {t}: write a smooth law there, or a friction"
            ),
            Self::NotFinite { quantity, t } => write!(f, "{quantity} is not a finite number at t = {t}"),
            Self::StepTooSmall { t, step } => write!(
                f,
                "the step has shrunk to {step:.1e}, too small for t = {t}: the equations are singular or jump here"
            ),
            Self::TooManySteps { t, steps } => {
                write!(f, "the limit of {steps} steps is reached at t = {t}: raise `most_steps` or the tolerance")
            }
            Self::Stiff { t, product } => write!(
                f,
                "the equations are stiff at t = {t}: a motion that decays within a step limits it, h |lambda| = \
                 {product:.1}; give it less damping, or leave it out"
            ),
            Self::EventsWithoutEnd { t, event } => write!(
                f,
                "event {event} repeats without end at t = {t}: let its action stop, or restart where it does not occur"
            ),
            Self::ChangePoint { scene, group, crossing } => {
                write!(f, "motions of {scene} cross here, where group {group} is singular")?;
                if let Some(CrossingRates { coordinates: [one, two], rates: [first, second] }) = crossing {
                    let [[a, b], [c, d]] = [first, second];
                    write!(f, " ({one}' : {two}' = {a:.3} : {b:.3} or {c:.3} : {d:.3})")?;
                }
                write!(f, ": start next to it, on one of them")
            }
            Self::UndeterminedReactions { scene, group } => write!(
                f,
                "forces in joints of {scene} are infinite or undetermined at the change point where group {group} is \
                 singular: end the motion before it, and give frictions a limit without `reaction`"
            ),
            Self::ContactWithoutEnd { scene, contact, t } => write!(
                f,
                "{contact} of {scene} changes again and again within the rounding error of t = {t}: end the simulation \
                 before it"
            ),
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
