//! The error type of dynamics.

use core::fmt;

use linkage_runtime::__shared::{Shown, to_f64};
use linkage_runtime::{InputError, Name, PathError, PositionError, Real};

/// The reason why forces, accelerations or a motion cannot be computed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum MotionError<N: Name = &'static str> {
    /// The reduced mass matrix is not positive definite: an input could accelerate without a force.
    NoInertia {
        /// The scene.
        scene: N,
        /// The input.
        coordinate: N,
        /// Cholesky pivot divided by the diagonal entry of the mass matrix, from 0 (no inertia) to 1.
        share: f64,
    },
    /// No contact forces or impulses satisfy the motion: a prescribed motion drives through a stop, or the stops
    /// contradict each other.
    NoContactForces {
        /// The scene.
        scene: N,
        /// A contact that is involved.
        contact: N,
    },
    /// No acceleration satisfies the law of every contact, as in Painleve's paradox.
    NoMotion {
        /// The scene.
        scene: N,
        /// The friction by a reaction that is involved.
        contact: N,
        /// The time, in a simulation.
        t: Option<f64>,
    },
    /// Several accelerations satisfy the law of every contact, as in Painleve's paradox.
    SeveralMotions {
        /// The scene.
        scene: N,
        /// A friction that differs between them.
        contact: N,
        /// The time, in a simulation.
        t: Option<f64>,
    },
    /// The number of accelerations that satisfy the law of every contact was not found.
    UndecidedMotion {
        /// The scene.
        scene: N,
        /// The friction by a reaction that is involved.
        contact: N,
        /// The time, in a simulation.
        t: Option<f64>,
    },
    /// A scene with frictions or stops is simulated backwards in time: dissipated energy cannot be recovered.
    Irreversible {
        /// The scene.
        scene: N,
        /// The first of its frictions and stops.
        contact: N,
    },
    /// s is not on the stop on which it rests: its position has jumped.
    LeftStop {
        /// The scene.
        scene: N,
        /// The stop.
        stop: N,
        /// s minus the position of the stop.
        gap: f64,
        /// The time.
        t: f64,
    },
    /// The law of a drive jumps in position.
    DriveJumps {
        /// The scene.
        scene: N,
        /// The driven input.
        coordinate: N,
        /// The time.
        t: f64,
    },
    /// The law of an effect has kinks without end: at this time, or ever closer together.
    KinksWithoutEnd {
        /// The scene.
        scene: N,
        /// The effect, or the driven input.
        effect: N,
        /// The time.
        t: f64,
    },
    /// A number became infinite or NaN during an integration.
    NotFinite {
        /// The quantity that is not finite.
        quantity: N,
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
        scene: N,
        /// The unknowns of the group that is singular; of several the one nearest to a singularity.
        group: N,
        /// The rates along the motions that cross, if there are two of one input.
        crossing: Option<CrossingRates<N>>,
    },
    /// Forces in joints, or frictions that depend on them, are infinite or undetermined at a change point.
    UndeterminedReactions {
        /// The scene.
        scene: N,
        /// The unknowns of the group that is singular.
        group: N,
    },
    /// A friction or a stop changes without end at the same time: for example, a body hits two stops that meet in turn.
    ContactWithoutEnd {
        /// The scene.
        scene: N,
        /// The friction or stop that changed last.
        contact: N,
        /// The time that was reached.
        t: f64,
    },
    /// A position during the motion could not be computed.
    Position(PositionError<N>),
    /// An error of path following, from the user's own functions.
    Path(PathError<N>),
    /// An argument is invalid.
    Input(InputError<N>),
}

/// The rates of two coordinates along the two motions that cross at a change point, each pair up to a factor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CrossingRates<N = &'static str> {
    /// The names of the coordinates.
    pub coordinates: [N; 2],
    /// Their rates along each motion; the larger one is 1.
    pub rates: [[f64; 2]; 2],
}

// A list of names need not be `Copy` where a name is.
impl<N: Name<List: Copy> + Copy> Copy for MotionError<N> {}

impl<N> CrossingRates<N> {
    /// These rates with other names.
    pub fn map_names<M>(self, f: impl FnMut(N) -> M) -> CrossingRates<M> {
        let Self { coordinates, rates } = self;
        CrossingRates { coordinates: coordinates.map(f), rates }
    }
}

impl<N: Name> MotionError<N> {
    /// This error with other names: borrowed ones become owned.
    pub fn map_names<M: Name<List: FromIterator<M>>>(self, f: impl FnMut(N) -> M) -> MotionError<M> {
        match self {
            Self::Position(error) => MotionError::Position(error.map_names(f)),
            Self::Path(error) => MotionError::Path(error.map_names(f)),
            other => other.with_names(M::List::default(), f),
        }
    }

    /// This error with other names, and with the inputs of this list: owned names become borrowed.
    pub fn with_names<M: Name>(self, inputs: M::List, mut f: impl FnMut(N) -> M) -> MotionError<M> {
        match self {
            Self::NoInertia { scene, coordinate, share } => {
                MotionError::NoInertia { scene: f(scene), coordinate: f(coordinate), share }
            }
            Self::NoContactForces { scene, contact } => {
                MotionError::NoContactForces { scene: f(scene), contact: f(contact) }
            }
            Self::NoMotion { scene, contact, t } => MotionError::NoMotion { scene: f(scene), contact: f(contact), t },
            Self::SeveralMotions { scene, contact, t } => {
                MotionError::SeveralMotions { scene: f(scene), contact: f(contact), t }
            }
            Self::UndecidedMotion { scene, contact, t } => {
                MotionError::UndecidedMotion { scene: f(scene), contact: f(contact), t }
            }
            Self::Irreversible { scene, contact } => MotionError::Irreversible { scene: f(scene), contact: f(contact) },
            Self::LeftStop { scene, stop, gap, t } => MotionError::LeftStop { scene: f(scene), stop: f(stop), gap, t },
            Self::DriveJumps { scene, coordinate, t } => {
                MotionError::DriveJumps { scene: f(scene), coordinate: f(coordinate), t }
            }
            Self::KinksWithoutEnd { scene, effect, t } => {
                MotionError::KinksWithoutEnd { scene: f(scene), effect: f(effect), t }
            }
            Self::NotFinite { quantity, t } => MotionError::NotFinite { quantity: f(quantity), t },
            Self::StepTooSmall { t, step } => MotionError::StepTooSmall { t, step },
            Self::TooManySteps { t, steps } => MotionError::TooManySteps { t, steps },
            Self::Stiff { t, product } => MotionError::Stiff { t, product },
            Self::EventsWithoutEnd { t, event } => MotionError::EventsWithoutEnd { t, event },
            Self::ChangePoint { scene, group, crossing } => MotionError::ChangePoint {
                scene: f(scene),
                group: f(group),
                crossing: crossing.map(|rates| rates.map_names(f)),
            },
            Self::UndeterminedReactions { scene, group } => {
                MotionError::UndeterminedReactions { scene: f(scene), group: f(group) }
            }
            Self::ContactWithoutEnd { scene, contact, t } => {
                MotionError::ContactWithoutEnd { scene: f(scene), contact: f(contact), t }
            }
            Self::Position(error) => MotionError::Position(error.with_names(inputs, f)),
            Self::Path(error) => MotionError::Path(error.with_names(inputs, f)),
            Self::Input(error) => MotionError::Input(error.map_names(f)),
        }
    }

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
        self.0.map_or(Ok(()), |t| write!(f, " at t = {}", seconds(t)))
    }
}

/// A time for readers, whose digits are those of other numbers.
fn seconds(t: f64) -> Shown {
    Shown { value: t, is_angle: false }
}

impl<N: Name> fmt::Display for MotionError<N> {
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
                "the {stop} in {scene} is left by {gap:.1e} at t = {t}, although it holds: the position jumps",
                t = seconds(*t)
            ),
            Self::DriveJumps { scene, coordinate, t } => write!(
                f,
                "the drive of {coordinate} in {scene} jumps in position at t = {t}: write a law without jumps",
                t = seconds(*t)
            ),
            Self::KinksWithoutEnd { scene, effect, t } => write!(
                f,
                "the law of {effect} in {scene} has kinks without end at t = {t}: write a smooth law there, or a friction",
                t = seconds(*t)
            ),
            Self::NotFinite { quantity, t } => {
                write!(f, "{quantity} is not a finite number at t = {t}", t = seconds(*t))
            }
            Self::StepTooSmall { t, step } => write!(
                f,
                "the step has shrunk to {step:.1e}, too small for t = {t}: the equations are singular or jump here",
                t = seconds(*t)
            ),
            Self::TooManySteps { t, steps } => {
                write!(
                    f,
                    "the limit of {steps} steps is reached at t = {t}: raise `most_steps` or the tolerance",
                    t = seconds(*t)
                )
            }
            Self::Stiff { t, product } => write!(
                f,
                "the equations are stiff at t = {t}: a motion that decays within a step limits it, h |lambda| = \
                 {product:.1}; give it less damping, or leave it out",
                t = seconds(*t)
            ),
            Self::EventsWithoutEnd { t, event } => write!(
                f,
                "event {event} repeats without end at t = {t}: let its action stop, or restart where it does not occur",
                t = seconds(*t)
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
                 before it",
                t = seconds(*t)
            ),
            Self::Position(error) => error.fmt(f),
            Self::Path(error) => error.fmt(f),
            Self::Input(error) => error.fmt(f),
        }
    }
}

impl<N: Name> core::error::Error for MotionError<N> {}

impl<N: Name> From<InputError<N>> for MotionError<N> {
    fn from(error: InputError<N>) -> Self {
        Self::Input(error)
    }
}

impl<N: Name> From<PositionError<N>> for MotionError<N> {
    fn from(error: PositionError<N>) -> Self {
        match error {
            PositionError::Input(error) => Self::Input(error),
            error => Self::Position(error),
        }
    }
}

impl<N: Name> From<PathError<N>> for MotionError<N> {
    fn from(error: PathError<N>) -> Self {
        match error {
            PathError::Input(error) => Self::Input(error),
            PathError::Position(error) => Self::Position(error),
            error => Self::Path(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{CrossingRates, MotionError};
    use linkage_runtime::{InputError, Name, PathError, PositionError};

    /// An error of each variant of an enum. A variant that is not in the list is not matched, and does not compile.
    macro_rules! each {
        ($name:ident: $($variant:ident $fields:tt)*) => {{
            let errors = vec![$($name::$variant $fields),*];
            for error in &errors {
                match error {
                    $($name::$variant { .. } => (),)*
                }
            }
            errors
        }};
    }

    fn errors<N: Name>(n: impl Fn(&'static str) -> N) -> Vec<MotionError<N>> {
        let (e, c, g) = (|| n("drop"), || n("friction on phi"), || n("phi, psi"));
        let crossing = || CrossingRates { coordinates: [n("phi"), n("psi")], rates: [[1.0, 0.5], [-0.5, 1.0]] };
        let t = 2.5;
        let all = each! { MotionError:
            NoInertia { scene: e(), coordinate: n("theta"), share: 0.25 }
            NoContactForces { scene: e(), contact: c() }
            NoMotion { scene: e(), contact: c(), t: Some(t) }
            SeveralMotions { scene: e(), contact: c(), t: Some(t) }
            UndecidedMotion { scene: e(), contact: c(), t: Some(t) }
            Irreversible { scene: e(), contact: c() }
            LeftStop { scene: e(), stop: n("stop on s"), gap: 0.1, t }
            DriveJumps { scene: e(), coordinate: n("theta"), t }
            KinksWithoutEnd { scene: e(), effect: n("drive theta"), t }
            NotFinite { quantity: n("speed"), t }
            StepTooSmall { t, step: 0.1 }
            TooManySteps { t, steps: 7 }
            Stiff { t, product: 3.5 }
            EventsWithoutEnd { t, event: 1 }
            ChangePoint { scene: e(), group: g(), crossing: Some(crossing()) }
            UndeterminedReactions { scene: e(), group: g() }
            ContactWithoutEnd { scene: e(), contact: c(), t }
            Position (PositionError::Undetermined { mechanism: n("FourBar"), group: g() })
            Path (PathError::NoDirection { mechanism: n("FourBar") })
            Input (InputError::NotPeriodic { mechanism: n("FourBar") })
        };
        let timeless = [
            MotionError::NoMotion { scene: e(), contact: c(), t: None },
            MotionError::ChangePoint { scene: e(), group: g(), crossing: None },
        ];
        all.into_iter().chain(timeless).collect()
    }

    /// Names borrowed from a text that ends with the test, and owned ones, have the texts of static ones.
    #[test]
    fn names_of_any_type_have_the_same_text() {
        let text = "FourBar drop friction on phi, psi stop on s drive theta speed".to_owned();
        let borrowed = |name: &'static str| -> &str {
            let start = text.find(name).expect(name);
            &text[start..start + name.len()]
        };
        let fixed = errors(|name| name);
        let of_borrowed = errors(borrowed);
        assert_eq!(fixed, of_borrowed);
        let owned: Vec<MotionError<String>> = of_borrowed.iter().map(|error| error.map_names(String::from)).collect();
        for (fixed, (borrowed, owned)) in fixed.iter().zip(of_borrowed.iter().zip(&owned)) {
            assert_eq!([borrowed.to_string(), owned.to_string()], [fixed.to_string(), fixed.to_string()]);
            assert_eq!([format!("{borrowed:?}"), format!("{owned:?}")], [format!("{fixed:?}"), format!("{fixed:?}")]);
        }
    }
}
