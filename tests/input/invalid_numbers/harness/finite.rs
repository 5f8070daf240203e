//! True if every number of a result is finite.

use std::fmt::Debug;
use std::marker::PhantomData;

use linkage::accuracy::{Reached, Table};
use linkage::continuation::{self, Event};
use linkage::integrate::{self, Action, Interpolant};
use linkage::kinematic::{FullKinematics, Kinematics, Motion};
use linkage::limits::{Limit, Limits};
use linkage::nalgebra::{Point2, SMatrix, UnitComplex};
use linkage::__rt::Vector as ByCoordinate;
use linkage::simulation::{Loads, State, Touch};
use linkage::singularity::{Accuracy, Exchange, GroupMeasure, Singularity};
use linkage::{
    AnyBranch, Assembled, AssemblyMode, Balance, Bearing, BorrowedName, Column, Contact, ContactCoordinate, ContactLaw, D, Dim, Elbow, Energy, Equations, Matrix,
    Mechanism, OutputMotion, PointMotion, Power, ReactionRow, Scene, Slider, Slope, Solution, StateRates, Unreduced,
};

/// Checks every number of a value: a type passes on its parts.
pub trait Finite {
    fn all_finite(&self) -> bool;
}

impl Finite for f64 {
    fn all_finite(&self) -> bool {
        self.is_finite()
    }
}

macro_rules! always {
    ($($name:ty)*) => {$(
        impl Finite for $name {
            fn all_finite(&self) -> bool {
                true
            }
        }
    )*};
}
always! { () bool usize i32 &'static str AssemblyMode Elbow Slider Slope }

impl<N> Finite for Touch<N> {
    fn all_finite(&self) -> bool {
        true
    }
}

impl<T> Finite for PhantomData<T> {
    fn all_finite(&self) -> bool {
        true
    }
}

impl<Q: Finite> Finite for Option<Q> {
    fn all_finite(&self) -> bool {
        self.as_ref().is_none_or(Finite::all_finite)
    }
}

impl<Q: Finite, const N: usize> Finite for [Q; N] {
    fn all_finite(&self) -> bool {
        self.iter().all(Finite::all_finite)
    }
}

impl<Q: Finite> Finite for Vec<Q> {
    fn all_finite(&self) -> bool {
        self.iter().all(Finite::all_finite)
    }
}

impl<B, P: Finite> Finite for Assembled<B, P> {
    fn all_finite(&self) -> bool {
        self.pose.all_finite()
    }
}

impl<Q: Finite, R: Finite> Finite for (Q, R) {
    fn all_finite(&self) -> bool {
        self.0.all_finite() && self.1.all_finite()
    }
}

impl<const R: usize, const C: usize> Finite for SMatrix<f64, R, C> {
    fn all_finite(&self) -> bool {
        self.iter().all(|entry| entry.is_finite())
    }
}

impl Finite for Point2<f64> {
    fn all_finite(&self) -> bool {
        self.coords.all_finite()
    }
}

impl<Q: Finite + Copy + Debug, R: Dim> Finite for Column<Q, R> {
    fn all_finite(&self) -> bool {
        self.iter().all(Finite::all_finite)
    }
}

impl<R: Dim, C: Dim> Finite for Matrix<f64, R, C> {
    fn all_finite(&self) -> bool {
        self.columns().all_finite()
    }
}

impl Finite for UnitComplex<f64> {
    fn all_finite(&self) -> bool {
        self.re.is_finite() && self.im.is_finite()
    }
}

/// Types whose parts are all public: none can be forgotten.
macro_rules! parts {
    ($([$($generics:tt)*] $name:ty { $pattern:pat => $($part:ident)* })*) => {$(
        impl<$($generics)*> Finite for $name {
            fn all_finite(&self) -> bool {
                let $pattern = self;
                true $(&& $part.all_finite())*
            }
        }
    )*};
}
parts! {
    [P: Finite, R: Finite, A: Finite] Kinematics<P, R, A> {
        Kinematics { pose, rates, accelerations } => pose rates accelerations
    }
    [P: Finite, R: Finite, A: Finite, Q: Finite, O: Finite] FullKinematics<P, R, A, Q, O> {
        FullKinematics { pose, rates, accelerations, points, outputs } => pose rates accelerations points outputs
    }
    [C: Finite, R: Finite, A: Finite, Q: Finite, O: Finite] Motion<C, R, A, Q, O> {
        Motion { position, rates, accelerations, points, outputs } => position rates accelerations points outputs
    }
    [Q: Finite] Solution<Q> {
        Solution { coordinates, iterations: _, residual } => coordinates residual
    }
    [Q: Finite] AnyBranch<Q> {
        AnyBranch { coordinates, iterations: _, residual, same_branch: _ } => coordinates residual
    }
    [Q: Finite, P: Finite] Reached<Q, P> { Reached { coordinates, pose } => coordinates pose }
    [] PointMotion<f64> { PointMotion { position, velocity, acceleration } => position velocity acceleration }
    [] OutputMotion<f64> { OutputMotion { value, rate, acceleration } => value rate acceleration }
    [] Energy<f64> { Energy { kinetic, potential } => kinetic potential }
    [R: Finite, V: Finite] StateRates<R, V> {
        StateRates { rates, input_accelerations } => rates input_accelerations
    }
    [] Power<f64> { Power { applied, dissipated } => applied dissipated }
    [const N: usize] Balance<f64, N> { Balance { forces, scales, slopes } => forces scales slopes }
    [U: Dim, V: Dim] Equations<f64, U, V> {
        Equations { mass, forces, ratios, bias } => mass forces ratios bias
    }
    [U: Dim, V: Dim] Unreduced<f64, U, V> {
        Unreduced { unknowns, mixed, inputs, unknown_forces, input_forces } =>
            unknowns mixed inputs unknown_forces input_forces
    }
    [U: Dim, V: Dim] ContactCoordinate<f64, U, V> {
        ContactCoordinate { value, unknowns, inputs, bias } => value unknowns inputs bias
    }
    [U: Dim, V: Dim, C: Dim] Bearing<f64, U, V, C> { Bearing { components } => components }
    [U: Dim, V: Dim, C: Dim] ReactionRow<f64, U, V, C> {
        ReactionRow { constant, unknowns, inputs, rows, contacts } => constant unknowns inputs rows contacts
    }
    [U: Dim, V: Dim] Contact<f64, U, V> { Contact { name: _, along, law } => along law }
    [] Limits<f64> { Limits { of: _, is_angle: _, lower, upper } => lower upper }
    [M: Mechanism<Scalar = f64, Coordinates: Finite, Rates: Finite>] continuation::PathStep<M> {
        continuation::PathStep { position, rates, length, event } => position rates length event
    }
    [N: Dim] integrate::Step<f64, N> { integrate::Step { t, state, event } => t state event }
    [S: Scene<Scalar = f64, Mechanism: Mechanism<Coordinates: Finite, Rates: Finite>>] State<S> {
        State { t, q, rates, event, kink: _, contacts } => t q rates event contacts
    }
    [S: Scene<Scalar = f64, Mechanism: Mechanism<Inputs: Finite>, Reactions: Finite>] Loads<S> {
        Loads { contacts, are_unique: _, drives, drive_power, joints, accelerations } =>
            contacts drives drive_power joints accelerations
    }
    [U: Dim, V: Dim] ByCoordinate<f64, U, V> { ByCoordinate { unknowns, inputs } => unknowns inputs }
    [N] GroupMeasure<f64, N> {
        GroupMeasure { name: _, determinant, regularity, sigma_min, is_regular: _ } => determinant regularity sigma_min
    }
    [N] Exchange<f64, N> { Exchange { unknown: _, input: _, sigma_min } => sigma_min }
}

impl Finite for ContactLaw<f64> {
    fn all_finite(&self) -> bool {
        match self {
            Self::Friction { limit } | Self::Bearing { factor: limit } => limit.all_finite(),
            Self::Stop { lower, upper, restitution } => [*lower, *upper, *restitution].all_finite(),
        }
    }
}

impl Finite for Limit<f64> {
    fn all_finite(&self) -> bool {
        match self {
            Self::Unlimited => true,
            Self::Exact { input, group: _ } | Self::JointRange { input, of: _, end: _ } => input.all_finite(),
            Self::Bracketed { assembled, unbuildable, group: _ } => [*assembled, *unbuildable].all_finite(),
        }
    }
}

impl<Q: Finite + Copy, N: BorrowedName> Finite for Event<Q, N> {
    fn all_finite(&self) -> bool {
        match self {
            Self::ChangePoint { tangents, .. } => tangents.iter().all(Finite::all_finite),
            _ => true,
        }
    }
}

impl<Y: Finite> Finite for Action<Y> {
    fn all_finite(&self) -> bool {
        match self {
            Self::Restart(state) => state.all_finite(),
            _ => true,
        }
    }
}

/// An interpolant at the ends of its step and between them.
impl<N: Dim> Finite for Interpolant<f64, N> {
    fn all_finite(&self) -> bool {
        let (from, to) = self.interval();
        [from, to].all_finite() && [from, 0.5 * from + 0.5 * to, to].map(|t| self.at(t)).all_finite()
    }
}

/// A table by its error; its entries show in the positions that it gives.
impl<M: Mechanism<Scalar = f64, V = D<1>>, const N: usize> Finite for Table<M, N> {
    fn all_finite(&self) -> bool {
        self.error().is_finite()
    }
}

/// The accuracy of a position, without the attainable error where the position is singular.
impl<M: Mechanism<Scalar = f64>> Finite for Accuracy<M> {
    fn all_finite(&self) -> bool {
        [self.residual, self.sigma_min].all_finite()
            && (self.sigma_min < f64::MIN_POSITIVE || self.attainable().is_finite())
    }
}

/// A singularity report by all its functions.
impl<M: Mechanism<Scalar = f64>> Finite for Singularity<M> {
    fn all_finite(&self) -> bool {
        [self.determinant(), self.sigma_min()].all_finite()
            && self.groups().all(Finite::all_finite)
            && self.free().all(|rates| rates.all_finite())
            && self.admissible().all(|rates| rates.all_finite())
            && self.drivers().all(|exchange| exchange.all_finite())
    }
}
