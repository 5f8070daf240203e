//! Why there is no result.

use core::fmt;

use nalgebra::SMatrix;

use crate::Real;

/// Why a computation has no result. All measures are pure numbers: scaling all lengths of a
/// mechanism changes none of them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The constraint Jacobian has no inverse here: the input cannot drive the mechanism.
    Singular {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that is singular; the groups before it are regular.
        group: &'static str,
        /// How regular the Jacobian is: its determinant beside the largest value that its formula
        /// could take at these lengths; of more than two unknowns the smallest pivot of the
        /// equilibrated Jacobian. 1 is far from singular, 0 is singular.
        regularity: f64,
    },
    /// A group cannot be assembled at this input: its links do not reach each other.
    Unbuildable {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group; the groups before it can be assembled.
        group: &'static str,
        /// By how much it misses, 0 where the links just touch. Of two links (RRR) how far the square of
        /// the distance of their outer joints lies outside what they span, beside the square of their sum;
        /// of the other groups what the link misses beside its length.
        gap: f64,
    },
    /// A group has infinitely many positions at this input. Of two links (RRR) the outer joints coincide and the lengths
    /// are equal to rounding, or a length is zero; of the other groups likewise everything that fixes an unknown
    /// vanishes: the pin of a slotted link lies in its pivot, guides are parallel and coincide, the factor of an
    /// unknown is zero and what it must equal too. Near this input the position depends on the side it is approached from.
    Undetermined {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group; the groups before it can be assembled.
        group: &'static str,
    },
    /// Newton's method found no position: the mechanism cannot be assembled at this input, or the
    /// guess is too far.
    NotConverged {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that was solved alone, or that is singular where the search ended; none
        /// if all were solved together.
        group: Option<&'static str>,
        /// Newton steps taken.
        iterations: usize,
        /// The largest residual that was left, beside the sum of the magnitudes of its terms.
        residual: f64,
        /// How regular the Jacobian is where the search ended, as in [`Error::Singular`].
        regularity: f64,
    },
    /// Newton's method found a position of another assembly branch than the guess belongs to: between the two
    /// the group is singular.
    OtherBranch {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group.
        group: &'static str,
    },
    /// The input cannot reach the value that is asked for: on this branch it turns back at a dead point.
    DeadPoint {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that locks.
        group: &'static str,
        /// How far the input stays from what is asked for, in radians or beside the lengths of its loops.
        gap: f64,
    },
    /// Motions of the mechanism cross here, and nothing says which of them is meant.
    ChangePoint {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that is singular; of several the first.
        group: &'static str,
    },
    /// At this start the input does not say where the path goes: it is a dead point, or the direction given is
    /// across the path.
    NoDirection {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
    },
    /// The path cannot be followed on: the shortest step fails. Where motions are closer to each other than rounding can
    /// tell, it ends.
    Lost {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that is nearest to a singularity.
        group: &'static str,
        /// Trials of the last step.
        iterations: usize,
        /// The largest residual of the last trial beside the size of its closure.
        residual: f64,
        /// The smallest pivot of the whole Jacobian of the closures beside the largest: 0 is a change point.
        regularity: f64,
    },
    /// The path is longer than the steps that were allowed.
    TooLong {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The steps taken.
        steps: usize,
    },
    /// A number that is given makes no sense.
    Invalid {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// What must be otherwise.
        quantity: &'static str,
    },
    /// An input lies outside the inputs that a table was made for.
    OutsideTable {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The input.
        input: f64,
        /// The smallest and the largest input of the table.
        range: [f64; 2],
    },
    /// A turn of the input does not bring the mechanism back to where it was.
    NotPeriodic {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
    },
    /// A number given or computed is infinite or not a number.
    NotFinite {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// What is not finite.
        quantity: &'static str,
    },
    /// A setting that cannot be used.
    OutOfRange {
        /// What was set.
        quantity: &'static str,
        /// To what.
        value: f64,
        /// The least it may be.
        least: f64,
        /// The most it may be.
        most: f64,
    },
    /// On the way of an integration a number is infinite or not a number.
    NotFiniteAt {
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
    /// A mass or an inertia is negative.
    Negative {
        /// The scene.
        scene: &'static str,
        /// What of which body.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
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
    /// A motion begins at another place or rate than its drive says.
    Inconsistent {
        /// The scene.
        scene: &'static str,
        /// The driven input.
        coordinate: &'static str,
        /// Its position or its rate.
        quantity: &'static str,
        /// By how much it differs.
        gap: f64,
    },
    /// A motion begins beyond a stop.
    BeyondStop {
        /// The scene.
        scene: &'static str,
        /// The stop.
        stop: &'static str,
        /// By how much, in the unit of what it stops.
        gap: f64,
    },
    /// A stop whose least value is not below its greatest.
    NoRange {
        /// The scene.
        scene: &'static str,
        /// The stop.
        stop: &'static str,
        /// Its least value.
        lower: f64,
        /// Its greatest value.
        upper: f64,
    },
    /// A restitution that is not between 0 and 1.
    Restitution {
        /// The scene.
        scene: &'static str,
        /// The stop.
        stop: &'static str,
        /// Its restitution.
        value: f64,
    },
    /// A simulation back in time of a scene with frictions or stops: what they take does not say where the motion came
    /// from.
    Irreversible {
        /// The scene.
        scene: &'static str,
        /// The first of its frictions and stops.
        contact: &'static str,
    },
    /// No forces or impulses of the frictions and stops agree with the motion: a prescribed motion drives through a
    /// stop, or stops leave no way to move.
    NoContactForces {
        /// The scene.
        scene: &'static str,
        /// A contact that takes part.
        contact: &'static str,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { mechanism, group, regularity } => write!(
                f,
                "{mechanism} is in a singular configuration: the Jacobian of {group} is regular to {regularity:.1e} only"
            ),
            Self::Unbuildable { mechanism, group, gap } => {
                write!(f, "{mechanism} cannot be assembled at this input: {group} miss closing by {gap:.1e}")
            }
            Self::Undetermined { mechanism, group } => {
                write!(f, "{mechanism} is undetermined at this input: the outer joints of group {group} coincide")
            }
            Self::NotConverged { mechanism, group, iterations, residual, regularity } => {
                let of = group.map_or("", |_| " of ");
                write!(
                    f,
                    "no position of {mechanism} found in {iterations} Newton steps: relative residual {residual:.1e}, \
                     Jacobian{of}{} regular to {regularity:.1e}",
                    group.unwrap_or_default()
                )
            }
            Self::OtherBranch { mechanism, group } => {
                write!(f, "the position of {mechanism} near the guess has {group} on another branch than the guess")
            }
            Self::DeadPoint { mechanism, group, gap } => {
                write!(f, "{mechanism} locks {gap:.1e} before this input: {group} are at a dead point")
            }
            Self::ChangePoint { mechanism, group } => {
                write!(f, "motions of {mechanism} cross here, where {group} are singular: choose one")
            }
            Self::NoDirection { mechanism } => {
                write!(f, "the direction given does not say which way {mechanism} moves from this start")
            }
            Self::Lost { mechanism, group, iterations, residual, regularity } => write!(
                f,
                "the path of {mechanism} cannot be followed on, {group} being nearest to a singularity: after \
                 {iterations} trials relative residual {residual:.1e}, Jacobian regular to {regularity:.1e}"
            ),
            Self::TooLong { mechanism, steps } => {
                write!(f, "the path of {mechanism} goes on after {steps} steps")
            }
            Self::Invalid { mechanism, quantity } => write!(f, "{mechanism} cannot be followed: check {quantity}"),
            Self::OutsideTable { mechanism, input, range: [low, high] } => {
                write!(f, "the table of {mechanism} goes from {low} to {high}: {input} lies outside")
            }
            Self::NotPeriodic { mechanism } => write!(f, "a turn of the input does not bring {mechanism} back"),
            Self::NotFinite { mechanism, quantity } => write!(f, "{quantity} of {mechanism} is not a finite number"),
            Self::OutOfRange { quantity, value, least, most } => {
                write!(f, "{quantity} is {value:e}: it must be between {least:e} and {most:e}")
            }
            Self::NotFiniteAt { quantity, t } => write!(f, "{quantity} is not a finite number at t = {t}"),
            Self::StepTooSmall { t, step } => write!(f, "the integration needs a step of {step:.1e} at t = {t}"),
            Self::TooManySteps { t, steps } => write!(f, "{steps} steps lead to t = {t} only"),
            Self::Stiff { t, product } => write!(
                f,
                "the equations have become stiff at t = {t}: the step times their fastest rate is {product:.1}"
            ),
            Self::EventsWithoutEnd { t, event } => write!(f, "event {event} happens without end at t = {t}"),
            Self::Negative { scene, quantity, value } => write!(f, "{quantity} in {scene} is negative: {value:.1e}"),
            Self::NoInertia { scene, coordinate, share } => {
                write!(f, "{coordinate} of {scene} has no inertia here: {share:.1e} of it is left")
            }
            Self::Inconsistent { scene, coordinate, quantity, gap } => {
                write!(
                    f,
                    "{scene} begins with another {quantity} of {coordinate} than its drive says: off by {gap:.1e}"
                )
            }
            Self::BeyondStop { scene, stop, gap } => write!(f, "{scene} begins beyond the {stop}: by {gap:.1e}"),
            Self::NoRange { scene, stop, lower, upper } => {
                write!(f, "the {stop} in {scene} leaves nothing between {lower} and {upper}")
            }
            Self::Restitution { scene, stop, value } => {
                write!(f, "the restitution of the {stop} in {scene} is {value}: it must be between 0 and 1")
            }
            Self::Irreversible { scene, contact } => {
                write!(
                    f,
                    "{scene} cannot be followed back in time, for it has a {contact}: let it end later than it starts"
                )
            }
            Self::NoContactForces { scene, contact } => {
                write!(f, "no forces of frictions and stops agree with the motion of {scene}: {contact}")
            }
        }
    }
}

impl core::error::Error for Error {}

/// Refuses values that are infinite or not numbers.
///
/// # Errors
/// [`Error::NotFinite`] with these names.
#[inline]
pub fn finite<T: Real, const N: usize>(
    mechanism: &'static str,
    quantity: &'static str,
    values: [T; N],
) -> Result<(), Error> {
    all_finite(mechanism, quantity, values.iter())
}

/// Refuses a matrix with an entry that is infinite or not a number.
///
/// # Errors
/// [`Error::NotFinite`] with these names.
#[inline]
pub fn finite_matrix<T: Real, const R: usize, const C: usize>(
    mechanism: &'static str,
    quantity: &'static str,
    matrix: &SMatrix<T, R, C>,
) -> Result<(), Error> {
    all_finite(mechanism, quantity, matrix.iter())
}

/// As [`finite`], of any number of values.
///
/// # Errors
/// [`Error::NotFinite`] with these names.
#[inline]
pub fn all_finite<'a, T: Real>(
    mechanism: &'static str,
    quantity: &'static str,
    values: impl Iterator<Item = &'a T> + Clone,
) -> Result<(), Error> {
    // A sum is finite only if all its terms are, and takes one verdict; but it may be too large where none is.
    let sum = values.clone().copied().reduce(|sum, value| sum + value);
    if sum.is_none_or(|sum| sum.is_finite()) || values.clone().all(T::is_finite) {
        Ok(())
    } else {
        Err(Error::NotFinite { mechanism, quantity })
    }
}
