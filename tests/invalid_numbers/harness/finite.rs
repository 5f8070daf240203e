//! True if every number of a result is finite.

use std::marker::PhantomData;

use linkage::accuracy::Reached;
use linkage::contact::Along;
use linkage::continuation::{Event, Step};
use linkage::integrate::{Action, Interpolant};
use linkage::limits::{Limit, Limits};
use linkage::nalgebra::{SMatrix, UnitComplex};
use linkage::simulation::{Loads, State};
use linkage::singularity::{Accuracy, Exchange, GroupMeasure, Singularity};
use linkage::{
    Balance, Contact, ContactLaw, Elbow, Energy, Equations, OutputMotion, PointMotion, Power, Slider, Slope, Solution,
    Unreduced,
};

/// Every number of a value: a type says so of its parts.
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
always! { () bool usize i32 &'static str Elbow Slider Slope }

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
    [Q: Finite] Solution<Q> {
        Solution { coordinates, iterations: _, residual, same_branch: _ } => coordinates residual
    }
    [Q: Finite, P: Finite] Reached<Q, P> { Reached { coordinates, pose } => coordinates pose }
    [] PointMotion<f64> { PointMotion { position, velocity, acceleration } => position velocity acceleration }
    [] OutputMotion<f64> { OutputMotion { value, velocity, acceleration } => value velocity acceleration }
    [] Energy<f64> { Energy { kinetic, potential } => kinetic potential }
    [] Power<f64> { Power { applied, dissipated } => applied dissipated }
    [const N: usize] Balance<f64, N> { Balance { forces, sizes, slopes } => forces sizes slopes }
    [const U: usize, const V: usize] Equations<f64, U, V> {
        Equations { mass, forces, ratios, bias } => mass forces ratios bias
    }
    [const U: usize, const V: usize] Unreduced<f64, U, V> {
        Unreduced { unknowns, mixed, inputs, unknown_forces, input_forces } =>
            unknowns mixed inputs unknown_forces input_forces
    }
    [const U: usize, const V: usize] Along<f64, U, V> {
        Along { value, unknowns, inputs, bias } => value unknowns inputs bias
    }
    [const U: usize, const V: usize] Contact<f64, U, V> { Contact { name: _, along, law } => along law }
    [] Limits<f64> { Limits { lower, upper } => lower upper }
    [Q: Finite + Copy] Step<Q, f64> { Step { position, rates, length, event } => position rates length event }
    [const N: usize] linkage::integrate::Step<f64, N> {
        linkage::integrate::Step { t, state, event: _ } => t state
    }
    [Q: Finite, const C: usize] State<f64, Q, C> {
        State { t, q, rate, event: _, contacts: _ } => t q rate
    }
    [I: Finite, const C: usize] Loads<f64, I, C> {
        Loads { contacts, drives, drive_power } => contacts drives drive_power
    }
    [] GroupMeasure<f64> {
        GroupMeasure { name: _, determinant, regularity, sigma_min, is_regular: _ } => determinant regularity sigma_min
    }
    [] Exchange<f64> { Exchange { unknown: _, input: _, sigma_min } => sigma_min }
}

impl Finite for ContactLaw<f64> {
    fn all_finite(&self) -> bool {
        match self {
            Self::Friction { limit } => limit.all_finite(),
            Self::Stop { lower, upper, restitution } => [*lower, *upper, *restitution].all_finite(),
        }
    }
}

impl Finite for Limit<f64> {
    fn all_finite(&self) -> bool {
        match self {
            Self::None => true,
            Self::Exact { input, group: _ } => input.all_finite(),
            Self::Bracketed { assembled, unbuildable, group: _ } => [*assembled, *unbuildable].all_finite(),
        }
    }
}

impl<Q: Finite + Copy> Finite for Event<Q> {
    fn all_finite(&self) -> bool {
        match self {
            Self::ChangePoint { tangents, .. } => tangents.iter().all(Finite::all_finite),
            _ => true,
        }
    }
}

impl<const N: usize> Finite for Action<f64, N> {
    fn all_finite(&self) -> bool {
        match self {
            Self::Restart(state) => state.all_finite(),
            _ => true,
        }
    }
}

/// At its ends and between them.
impl<const N: usize> Finite for Interpolant<f64, N> {
    fn all_finite(&self) -> bool {
        let (from, to) = self.interval();
        [from, to].all_finite() && [from, 0.5 * from + 0.5 * to, to].map(|t| self.at(t)).all_finite()
    }
}

/// Its numbers, and not what follows from them where the position is singular.
impl<const U: usize> Finite for Accuracy<f64, U> {
    fn all_finite(&self) -> bool {
        [self.residual, self.sigma_min].all_finite()
            && (self.sigma_min < f64::MIN_POSITIVE || self.attainable().is_finite())
    }
}

/// By all that it can be asked.
impl<const U: usize, const V: usize> Finite for Singularity<f64, U, V> {
    fn all_finite(&self) -> bool {
        [self.determinant(), self.sigma_min()].all_finite()
            && self.groups().all(Finite::all_finite)
            && self.free().all(|rates| rates.all_finite())
            && self.admissible().all(|rates| rates.all_finite())
            && self.drivers().all(|exchange| exchange.all_finite())
    }
}
