//! The trait of mechanisms with inertia and forces, and functions that the code emitted for scenes calls.

use crate::contact::within;
use crate::simulation::scales::resolution_by_inputs;
use crate::{Bearing, Contact, ContactLaw, Energy, Equations, MotionError, Power, Unreduced};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::{all_finite, finite, to_f64};
use linkage_runtime::jacobian::{Scales, Vector};
use linkage_runtime::{
    Build, Column, Dim, InputError, Joint, JointForces, Mechanism, Name, PerInput, PositionError, Real, newton, real,
};

/// Values shared by the functions of a scene, at one position and one set of input rates.
#[derive(Debug, Clone, Copy)]
pub struct ReducedMotion<P, R, T, const U: usize, const V: usize> {
    /// The position.
    pub pose: P,
    /// W, column by column.
    pub ratios: [[T; U]; V],
    /// q' = (W v', v').
    pub rates: R,
    /// `u''` at `v'' = 0`.
    pub bias: [T; U],
}

/// A mechanism with inertia and forces, as a differential equation, with frictions and stops.
///
/// `linkage!` implements it for every `scene` with `inertia`. The state is y = (q, v'): all coordinates, then the rates
/// of the inputs. Its derivative `(W v', v'')` requires no position solution, follows angles beyond a turn, and stays on
/// its branch, because W is infinite at a dead point. [`Scene::project`] removes the residual of the constraints that
/// the errors of the steps accumulate: call it after each step or after several. At a [kink](Scene::KINKS) of a law the
/// derivative may be undefined, and a jump of the rate of a drive does not reach the other coordinates: simulations end
/// their steps there and apply the impulse. For an integrator of plain functions,
/// pass
///
/// ```text
/// |t, y: &_| scene.derivative(t, y)
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a scene with inertia",
    note = "`linkage!` implements `Scene` for each `scene` with `inertia;`"
)]
pub trait Scene {
    /// The scalar type of lengths and angles.
    type Scalar: Real;
    /// The number of dependent coordinates.
    type U: Dim;
    /// The number of independent coordinates.
    type V: Dim;
    /// The number of components of the state, [`U`](Self::U) + 2 [`V`](Self::V).
    type State: Dim;
    /// The number of frictions and stops.
    type Contacts: Dim;
    /// The kinematics.
    type Mechanism: Mechanism<Scalar = Self::Scalar, U = Self::U, V = Self::V>;
    /// The forces in the joints that `reaction` statements name, or `()`.
    type Reactions: JointForces<Self::Scalar, NameOf<Self>>;

    /// The name of the scene, used in errors.
    const NAME: &'static str;
    /// True if a friction depends on the reaction of its joint.
    const BEARINGS: bool = false;
    /// The kinks of its laws, without those of user functions.
    const KINKS: &'static [Kink] = &[];

    /// The name of the scene, used in errors. Here and below: the names of emitted code are constants, those of a scene at run
    /// time are of its value.
    #[inline]
    fn name(&self) -> NameOf<Self> {
        Name::from_static(Self::NAME)
    }
    /// True if a friction depends on the reaction of its joint. Without one [`bearings`](Self::bearings) is not called.
    #[inline]
    fn has_bearings(&self) -> bool {
        Self::BEARINGS
    }
    /// The kinks of its laws, without those of user functions.
    #[inline]
    fn kinks(&self) -> impl Iterator<Item = Kink<NameOf<Self>>> {
        Self::KINKS.iter().map(|kink| kink.map_names(Name::from_static))
    }
    /// The joints of its [`Reactions`](Self::Reactions), also before these are computed.
    #[inline]
    fn joints(&self) -> impl Iterator<Item = Joint<NameOf<Self>>> {
        let joints = <Self::Reactions as JointForces<Self::Scalar, NameOf<Self>>>::JOINTS;
        joints.iter().map(|joint| joint.map_names(Name::from_static))
    }
    /// The kinematics.
    fn mechanism(&self) -> &Self::Mechanism;
    /// The number of frictions and stops. A scene needs a body of it if it is not a constant.
    #[inline]
    fn contact_count(&self) -> Self::Contacts {
        Dim::least()
    }
    /// y = (q, v') of a scene whose type says the order of its coordinates, as that of emitted code does.
    fn state(q: &Coordinates<Self>, input_rates: &Inputs<Self>) -> StateColumn<Self>;
    /// Splits y into q and v', likewise.
    fn parts(state: &StateColumn<Self>) -> StateParts<Coordinates<Self>, Inputs<Self>>;
    /// y = (q, v'), in the order of the coordinates of this scene.
    #[inline]
    fn state_of(&self, q: &Coordinates<Self>, input_rates: &Inputs<Self>) -> StateColumn<Self> {
        Self::state(q, input_rates)
    }
    /// Splits y into q and v', in the order of the coordinates of this scene.
    #[inline]
    fn parts_of(&self, state: &StateColumn<Self>) -> StateParts<Coordinates<Self>, Inputs<Self>> {
        Self::parts(state)
    }
    /// Splits `y'`, as [`derivative`](Self::derivative) returns it, into `q'` and `v''`.
    fn rate_parts(derivative: &StateColumn<Self>) -> StateRates<Rates<Self>, Inputs<Self>> {
        let StateParts { q, input_rates: input_accelerations } = Self::parts(derivative);
        let (unknowns, inputs) = Self::Mechanism::parts(&q);
        StateRates { rates: Self::Mechanism::rates(unknowns, inputs), input_accelerations }
    }
    /// Checks that the parameters are physically valid.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if a mass, an inertia or a friction is negative, with its name, or if the restitution
    /// of a stop is not between 0 and 1; [`InputError::EmptyRange`] with the name of a stop.
    fn check(&self) -> Result<(), MotionErrorOf<Self>>;
    /// `y' = (W v', v'')`, without frictions and stops.
    ///
    /// # Errors
    /// [`PositionError::Singular`] where J is singular, [`MotionError::NoInertia`] where an input could accelerate
    /// without a force, [`PositionError::NotFinite`] with the name of the body or the effect whose value is not finite.
    fn derivative(&self, t: Self::Scalar, state: &StateColumn<Self>) -> Result<StateColumn<Self>, MotionErrorOf<Self>>;
    /// M, Q, W and `u''` at `v'' = 0`: [`derivative`](Self::derivative) where no input is prescribed.
    ///
    /// # Errors
    /// [`PositionError::Singular`] where J is singular, [`PositionError::NotFinite`] with the name of the body or the
    /// effect whose value is not finite.
    fn equations(&self, t: Self::Scalar, state: &StateColumn<Self>) -> Result<EquationsOf<Self>, MotionErrorOf<Self>>;
    /// The frictions and stops in the order of declaration, at a position and the rates q'.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`] with the name of the effect whose value is not finite, [`InputError::OutOfRange`]
    /// with the name of the friction whose limit is negative.
    fn contacts(
        &self,
        t: Self::Scalar,
        q: &Coordinates<Self>,
        rates: &Rates<Self>,
    ) -> Result<ContactsOf<Self>, MotionErrorOf<Self>>;
    /// The reactions of the contacts with the law [`ContactLaw::Bearing`], at a position and the rates q'.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`] with the name of the effect whose value is not finite.
    fn bearings(
        &self,
        _: Self::Scalar,
        _: &Coordinates<Self>,
        _: &Rates<Self>,
    ) -> Result<BearingsOf<Self>, MotionErrorOf<Self>> {
        Ok(self.contact_count().repeat(None))
    }
    /// M and F of `M q'' + Psi_q' lambda = F` in all coordinates, at the rates `q'`: they hold for any choice of
    /// independent coordinates.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`] if an entry is not finite.
    fn unreduced(
        &self,
        t: Self::Scalar,
        q: &Coordinates<Self>,
        rates: &Rates<Self>,
    ) -> Result<UnreducedOf<Self>, MotionErrorOf<Self>>;
    /// The forces in the joints in a motion with the rates `q'`, the accelerations `(u'', v'')`, and these forces of
    /// frictions and stops along their scalars.
    ///
    /// # Errors
    /// [`PositionError::Singular`] where J is singular, [`PositionError::NotFinite`] if a number is not finite.
    fn reactions(
        &self,
        t: Self::Scalar,
        q: &Coordinates<Self>,
        rates: &Rates<Self>,
        accelerations: &Accelerations<Self>,
        contact_forces: &Column<Self::Scalar, Self::Contacts>,
    ) -> Result<Self::Reactions, MotionErrorOf<Self>>;
    /// The expression at whose zeros the law of the kink at this place of [`kinks`](Self::kinks) has a kink or a jump, where it
    /// changes its sign.
    fn kink(&self, place: usize, t: Self::Scalar, q: &Coordinates<Self>, rates: &Rates<Self>) -> Self::Scalar {
        let _ = (place, t, q, rates);
        Self::Scalar::one()
    }
    /// A bound of the change of the s of each stop while each coordinate moves from its value by at most so much, in any complex
    /// direction: it bounds the derivatives of all orders of s along a motion, by which no impact between the samples of a step is
    /// missed. `None` for frictions, for polynomials in the coordinates, and where no bound is known, as with user functions; no
    /// number where there is none at this position.
    fn gap_changes(&self, q: &Coordinates<Self>, moves: &Rates<Self>) -> Column<Option<Self::Scalar>, Self::Contacts> {
        let _ = (q, moves);
        self.contact_count().repeat(None)
    }
    /// The forces of frictions, stops, drives and joints in the motion that starts at a position with the rates v' of
    /// the inputs: a friction slips by the sign of s', what is at rest is held if it can. At the states of a simulation
    /// these are its [`loads`](crate::simulation::Simulation::loads), except where rounding error hides which contact is
    /// at rest: the simulation remembers it.
    ///
    /// # Errors
    /// Those of [`equations`](Self::equations), [`contacts`](Self::contacts) and [`reactions`](Self::reactions), those
    /// of [`Contacts::begin`](crate::contact::Contacts::begin), and [`MotionError::NotFinite`].
    fn loads(
        &self,
        t: Self::Scalar,
        q: &Coordinates<Self>,
        input_rates: impl Into<Inputs<Self>>,
    ) -> Result<Loads<Self>, MotionErrorOf<Self>>
    where
        Self: Sized,
    {
        crate::reactions::loads(self, t, q, input_rates.into())
    }
    /// The [`loads`](Self::loads) in a motion with these rates v' and accelerations `v''` of the inputs, as if each
    /// input had a drive that makes this motion: the forces of the drives are those that motors must apply.
    ///
    /// # Errors
    /// Those of [`loads`](Self::loads).
    fn loads_of_motion(
        &self,
        t: Self::Scalar,
        q: &Coordinates<Self>,
        input_rates: impl Into<Inputs<Self>>,
        input_accelerations: impl Into<Inputs<Self>>,
    ) -> Result<Loads<Self>, MotionErrorOf<Self>>
    where
        Self: Sized,
    {
        crate::reactions::loads_of_motion(self, t, q, (input_rates.into(), input_accelerations.into()))
    }
    /// The energy at a position and the rates v' of the inputs, if the scene has `energy;`.
    ///
    /// # Errors
    /// [`PositionError::Singular`] where J is singular, [`PositionError::NotFinite`] if the energy is not finite.
    fn kinetic_and_potential(
        &self,
        _: &Coordinates<Self>,
        _: &Inputs<Self>,
    ) -> Result<Option<Energy<Self::Scalar>>, MotionErrorOf<Self>> {
        Ok(None)
    }
    /// The power of forces and torques, and that which dampers and frictions dissipate, if the scene has `power;`. The power of
    /// drives is in the first, unless the scene has frictions or stops.
    ///
    /// # Errors
    /// Those of [`derivative`](Self::derivative).
    fn applied_and_dissipated(
        &self,
        _: Self::Scalar,
        _: &Coordinates<Self>,
        _: &Inputs<Self>,
    ) -> Result<Option<Power<Self::Scalar>>, MotionErrorOf<Self>> {
        Ok(None)
    }
    /// The prescribed motion of each input, or None.
    fn prescribed(&self, t: Self::Scalar) -> Column<Option<Prescribed<Self::Scalar>>, Self::V>;

    /// Projects the state onto the constraints Psi = 0 with the inputs fixed.
    ///
    /// # Errors
    /// [`PositionError::NotConverged`] if no position is found, [`PositionError::NotFinite`] if a number is not finite.
    fn project(&self, state: &StateColumn<Self>) -> Result<StateColumn<Self>, MotionErrorOf<Self>> {
        all_finite(self.name(), Name::from_static("the state"), state.iter())?;
        let StateParts { q, input_rates } = self.parts_of(state);
        let closed = newton(self.mechanism(), &q)?;
        Ok(self.state_of(&closed.coordinates, &input_rates))
    }

    /// Builds the initial state: the position near `q` that satisfies the constraints with the inputs of `q`.
    ///
    /// # Errors
    /// Those of [`Scene::check`] and [`Scene::project`], [`InputError::Inconsistent`] if a driven input or its rate
    /// differs from its law, and [`InputError::BeyondStop`] if the position is beyond a stop.
    fn start(
        &self,
        t: Self::Scalar,
        q: &Coordinates<Self>,
        input_rates: &Inputs<Self>,
    ) -> Result<StateColumn<Self>, MotionErrorOf<Self>> {
        self.check()?;
        let (inputs, rates): (_, PerInput<Self::Mechanism>) = (Self::Mechanism::inputs(q), (*input_rates).into());
        // At a kink the rate after it.
        let laws = one_sided(self, t, true);
        let given = inputs.iter().zip(&rates).zip(&laws);
        for (input, ((&value, &rate), law)) in given.enumerate() {
            let Some(law) = law else { continue };
            // Relative to an infinite value of the law every difference would be zero.
            finite(self.name(), Name::from_static("the law of a drive"), [law.value, law.rate])?;
            for (quantity, given, law) in [("position", value, law.value), ("rate", rate, law.rate)] {
                let gap = (given - law).abs();
                // The comparison is false for NaN, which is inconsistent too.
                let agrees = gap <= Self::Scalar::default_epsilon().sqrt() * (given.abs() + law.abs());
                if !agrees {
                    let (coordinate, quantity) = (self.mechanism().input_name(input), Name::from_static(quantity));
                    return Err(InputError::Inconsistent {
                        scene: self.name(),
                        coordinate,
                        quantity,
                        gap: to_f64(gap),
                    }
                    .into());
                }
            }
        }
        let state = self.project(&self.state_of(q, input_rates))?;
        if self.contact_count().count() > 0 {
            let q = self.parts_of(&state).q;
            let (u, v, _) = self.mechanism().dims();
            let rest = Self::Mechanism::rates(u.zeros(), v.zeros());
            let scales = Scales::of(self.mechanism(), &self.mechanism().pose_at(&q));
            for Contact { name, along, law } in self.contacts(t, &q, &rest)? {
                if let ContactLaw::Stop { lower, upper, .. } = law {
                    let resolution = resolution_by_inputs(self.mechanism(), &scales, &q, &along)?;
                    within(self.name(), name, (along.value, resolution), [lower, upper])?;
                }
            }
        }
        Ok(state)
    }
}

/// The type of the names of a scene, those of its mechanism.
pub type NameOf<S> = <<S as Scene>::Mechanism as Mechanism>::Name;
/// The error of a motion, with names of a scene.
pub type MotionErrorOf<S> = MotionError<NameOf<S>>;
/// The coordinates q of a scene by name.
pub type Coordinates<S> = <<S as Scene>::Mechanism as Mechanism>::Coordinates;
/// The rates q' of all coordinates of a scene by name.
pub type Rates<S> = <<S as Scene>::Mechanism as Mechanism>::Rates;
/// The inputs v of a scene by name, or their rates.
pub type Inputs<S> = <<S as Scene>::Mechanism as Mechanism>::Inputs;
/// The accelerations `(u'', v'')` of all coordinates of a scene.
pub type Accelerations<S> = Vector<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;
/// The state y = (q, v') of a scene as one column.
pub type StateColumn<S> = Column<<S as Scene>::Scalar, <S as Scene>::State>;

type EquationsOf<S> = Equations<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;
type UnreducedOf<S> = Unreduced<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;
type BearingsOf<S> = Column<
    Option<Bearing<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V, <S as Scene>::Contacts>>,
    <S as Scene>::Contacts,
>;
type ContactsOf<S> =
    Column<Contact<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V, NameOf<S>>, <S as Scene>::Contacts>;

/// The state y = (q, v') of a scene, by name.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StateParts<Q, V> {
    /// All coordinates q.
    pub q: Q,
    /// The rates v' of the inputs.
    pub input_rates: V,
}

/// The derivative `y' = (q', v'')` of the state of a scene, by name.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StateRates<R, V> {
    /// The rates q' of all coordinates.
    pub rates: R,
    /// The accelerations `v''` of the inputs.
    pub input_accelerations: V,
}

/// A kink or a jump of a law of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kink<N = &'static str> {
    /// The effect with the law, as in errors: `drive x`.
    pub effect: N,
    /// True if its expression depends on time alone.
    pub is_timed: bool,
}

impl<N> Kink<N> {
    /// This kink with another name.
    #[inline]
    pub fn map_names<M>(self, f: impl FnOnce(N) -> M) -> Kink<M> {
        Kink { effect: f(self.effect), is_timed: self.is_timed }
    }
}

/// The prescribed motion of an input at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Prescribed<T> {
    /// The value of the input.
    pub value: T,
    /// Its rate.
    pub rate: T,
    /// Its acceleration.
    pub acceleration: T,
}

/// The sign of a number; zero for NaN.
pub(crate) fn sign<T: Real>(value: T) -> i8 {
    if value > T::zero() {
        1
    } else if value < T::zero() {
        -1
    } else {
        0
    }
}

/// The sign of an expression of time alone.
pub(crate) fn sign_at<S: Scene + ?Sized>(scene: &S, place: usize, t: S::Scalar) -> i8 {
    let (u, v, _) = scene.mechanism().dims();
    let q = S::Mechanism::coordinates(u.zeros(), v.zeros());
    let rates = S::Mechanism::rates(u.zeros(), v.zeros());
    sign(scene.kink(place, t, &q, &rates))
}

/// Returns t, or if an expression of time alone is zero there, a time next to it, in this direction, where none is.
pub(crate) fn beside<S: Scene + ?Sized>(scene: &S, t: S::Scalar, is_forward: bool) -> S::Scalar {
    let is_smooth = |t: S::Scalar| {
        let mut kinks = scene.kinks().enumerate();
        kinks.all(|(place, kink)| !kink.is_timed || sign_at(scene, place, t) != 0)
    };
    if is_smooth(t) {
        return t;
    }
    // From one ulp; at t = 0, where there is no ulp, from a time whose square does not underflow.
    let ulp = t.abs() * S::Scalar::default_epsilon();
    let (mut little, factor) = if ulp > S::Scalar::zero() { (ulp, 2.0) } else { (real(1e-150), 1e8) };
    for _ in 0..20 {
        let near = if is_forward { t + little } else { t - little };
        if is_smooth(near) {
            return near;
        }
        little *= real(factor);
    }
    t
}

/// The prescribed motion of each input at a time, with the rate and the acceleration just after it where its law has a kink: the
/// rates with which a simulation starts.
pub fn prescribed_after<S: Scene + ?Sized>(scene: &S, t: S::Scalar) -> Column<Option<Prescribed<S::Scalar>>, S::V> {
    one_sided(scene, t, true)
}

/// The prescribed motion of each input: at a kink its rate and acceleration just after it, or before it.
pub(crate) fn one_sided<S: Scene + ?Sized>(
    scene: &S,
    t: S::Scalar,
    is_after: bool,
) -> Column<Option<Prescribed<S::Scalar>>, S::V> {
    let laws = scene.prescribed(t);
    let near = beside(scene, t, is_after);
    if near == t {
        return laws;
    }
    let beside = scene.prescribed(near);
    laws.dim().column(|input| {
        let (law, beside) = (laws[input]?, beside[input]?);
        Some(Prescribed { value: law.value, ..beside })
    })
}

/// The forces of frictions, stops, drives and joints.
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "S::Scalar: serde::Serialize, Inputs<S>: serde::Serialize, S::Reactions: serde::Serialize",
        deserialize = "S::Scalar: serde::Deserialize<'de>, Inputs<S>: serde::Deserialize<'de>, \
                       S::Reactions: serde::Deserialize<'de>, S::Contacts: Default, S::U: Default, S::V: Default"
    ))
)]
pub struct Loads<S: Scene> {
    /// The force of each friction and stop along its scalar s, in the order of declaration: its work is f ds. With
    /// redundant contacts the forces are not unique; this is one solution.
    pub contacts: Column<S::Scalar, S::Contacts>,
    /// False if other forces of the contacts give the same motion.
    pub are_unique: bool,
    /// The force (for an angle, torque) of each drive; zero for inputs without a drive.
    pub drives: Inputs<S>,
    /// The power of the drives. dE/dt = this + the power of the scene's other forces - the dissipation of frictions and
    /// dampers.
    pub drive_power: S::Scalar,
    /// The forces in the joints that `reaction` statements of the scene name.
    pub joints: S::Reactions,
    /// The accelerations `(u'', v'')` in the motion with these forces.
    pub accelerations: Accelerations<S>,
}

impl<S: Scene> Loads<S> {
    /// Checks that all forces are finite; those in the joints are already checked.
    pub(crate) fn finite(self, t: S::Scalar) -> Result<Self, MotionErrorOf<S>> {
        let drives: PerInput<S::Mechanism> = self.drives.into();
        let Vector { unknowns, inputs } = &self.accelerations;
        let forces = self.contacts.iter().chain(drives.iter()).chain([&self.drive_power]);
        if !forces.chain(unknowns.iter()).chain(inputs.iter()).all(S::Scalar::is_finite) {
            return Err(MotionError::NotFinite { quantity: Name::from_static("the loads"), t: to_f64(t) });
        }
        Ok(self)
    }
}

linkage_runtime::__by_fields!([S: Scene] Loads<S> { contacts, are_unique, drives, drive_power, joints, accelerations });

/// Checks that the numbers are finite and not negative.
///
/// # Errors
/// [`InputError::OutOfRange`] or [`PositionError::NotFinite`] with the name of the first.
pub fn not_negative<T: Real, S: Name + Copy>(
    scene: S,
    values: impl IntoIterator<Item = (S, T)>,
) -> Result<(), MotionError<S>> {
    for (quantity, value) in values {
        if !value.is_finite() {
            return Err(PositionError::NotFinite { mechanism: scene, quantity }.into());
        }
        if value < T::zero() {
            return Err(negative(scene, quantity, value).into());
        }
    }
    Ok(())
}

/// The error for a negative number.
pub(crate) fn negative<T: Real, S>(scene: S, quantity: S, value: T) -> InputError<S> {
    InputError::OutOfRange { of: Some(scene), quantity, value: to_f64(value), least: 0.0, most: f64::MAX }
}

/// Checks that all values are finite.
///
/// # Errors
/// [`PositionError::NotFinite`] with the name of the first that is not.
pub fn finite_each<T: Real, S: Name, const N: usize>(scene: S, values: [(S, T); N]) -> Result<(), MotionError<S>> {
    values
        .into_iter()
        .find(|(_, value)| !value.is_finite())
        .map_or(Ok(()), |(quantity, _)| Err(PositionError::NotFinite { mechanism: scene, quantity }.into()))
}
