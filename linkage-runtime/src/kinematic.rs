//! The velocities, accelerations, points and outputs of any mechanism.

use core::fmt::Debug;

use nalgebra::{Point2, Vector2};

use crate::mechanism::no_unknowns;
use crate::scalar::arithmetic::*;
use crate::{
    Build, Column, D, Dim, Matrix, Mechanism, Name, OutputMotion, PerInput, PerUnknown, PointMotion, PositionErrorOf,
};

/// A position with its rates and accelerations, as `kinematics` finds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Kinematics<P, R, A> {
    /// The position.
    pub pose: P,
    /// The rates q'.
    pub rates: R,
    /// The accelerations `q''`.
    pub accelerations: A,
}

/// A position with its rates and accelerations, and the motion of points and outputs, as `full_kinematics` finds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FullKinematics<P, R, A, Q, O> {
    /// The position.
    pub pose: P,
    /// The rates q'.
    pub rates: R,
    /// The accelerations `q''`.
    pub accelerations: A,
    /// Positions, velocities and accelerations of the points; an empty list if there are none.
    pub points: Q,
    /// Values, rates and accelerations of the outputs; an empty list if there are none.
    pub outputs: O,
}

/// The coordinates of a position with their rates and accelerations, and the motion of points and outputs, as `motion`
/// finds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion<C, R, A, Q, O> {
    /// The position q.
    pub position: C,
    /// The rates q'.
    pub rates: R,
    /// The accelerations `q''`.
    pub accelerations: A,
    /// Positions, velocities and accelerations of the points; an empty list if there are none.
    pub points: Q,
    /// Values, rates and accelerations of the outputs; an empty list if there are none.
    pub outputs: O,
}

/// [`Kinematics`] of a mechanism.
pub type KinematicsOf<M> = Kinematics<<M as Mechanism>::Pose, <M as Mechanism>::Rates, <M as Kinematic>::Accelerations>;

/// [`FullKinematics`] of a mechanism.
pub type FullKinematicsOf<M> = FullKinematics<
    <M as Mechanism>::Pose,
    <M as Mechanism>::Rates,
    <M as Kinematic>::Accelerations,
    <M as Kinematic>::Points<PointMotion<<M as Mechanism>::Scalar>>,
    <M as Kinematic>::Outputs<OutputMotion<<M as Mechanism>::Scalar>>,
>;

/// [`Motion`] of a mechanism.
pub type MotionOf<M> = Motion<
    <M as Mechanism>::Coordinates,
    <M as Mechanism>::Rates,
    <M as Kinematic>::Accelerations,
    <M as Kinematic>::Points<PointMotion<<M as Mechanism>::Scalar>>,
    <M as Kinematic>::Outputs<OutputMotion<<M as Mechanism>::Scalar>>,
>;

/// A vector with a number for each coordinate of a mechanism, in the order of the fields of its types.
pub type PerCoordinate<M> = <<M as Kinematic>::N as Dim>::Vector<<M as Mechanism>::Scalar>;

/// Rates by the rates of the inputs of a mechanism: a row for each, `R` of them.
pub type Ratios<M, R> = Matrix<<M as Mechanism>::Scalar, R, <M as Mechanism>::V>;

/// A quantity of a point or an output: a number, a vector, a matrix.
pub trait Quantity: Copy + Debug + PartialEq {}

impl<Q: Copy + Debug + PartialEq> Quantity for Q {}

/// A mechanism with its velocities and accelerations, its points and its outputs.
///
/// `linkage!` implements it for every mechanism and every driver of one, also for open chains and for mechanisms whose
/// position has no closed form, so that a function can ask any mechanism for its motion. A mechanism of a known type has
/// functions of the same names, which need no import; those here that have no body call them.
///
/// ```
/// use linkage_runtime::{Kinematic, PositionError};
///
/// /// The fastest point of a mechanism and its speed.
/// fn fastest<M: Kinematic<Scalar = f64>>(
///     m: &M,
///     q: &M::Coordinates,
///     input_rates: M::Inputs,
/// ) -> Result<Option<(M::Name, f64)>, PositionError<M::Name>> {
///     let pose = m.pose_at(q);
///     let rates = m.velocity(&pose, input_rates)?;
///     let speeds = M::each_point(m.point_velocities(&pose, &rates)?).map(|velocity| velocity.norm());
///     let named = speeds.into_iter().enumerate().map(|(place, speed)| (m.point_name(place), speed));
///     Ok(named.max_by(|(_, one), (_, other)| one.total_cmp(other)))
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a mechanism with velocities and accelerations",
    note = "`linkage!` implements `Kinematic` for each `mechanism`, or for each `drive` of one with several inputs; a scene has its mechanism in the field `mechanism`"
)]
pub trait Kinematic:
    Mechanism<
        // rustc shows the next line, or that of `Points`, for `dyn Kinematic`.
        Coordinates: From<PerCoordinate<Self>> + Into<PerCoordinate<Self>>, // Instead: your trait for all `M: Kinematic`.
        Rates: From<PerCoordinate<Self>> + Into<PerCoordinate<Self>>,
        Pose: Copy + Debug,
    >
{
    /// The number of coordinates, that of the unknowns and that of the inputs together.
    type N: Dim;
    /// The number of points.
    type P: Dim;
    /// The number of outputs.
    type O: Dim;
    /// The accelerations `q''` by name.
    type Accelerations: Copy + Debug + PartialEq + From<PerCoordinate<Self>> + Into<PerCoordinate<Self>>;
    /// A quantity for each point by name; without points an empty list.
    type Points<Q: Quantity>: Copy // Instead of `dyn`: a generic function, or your trait for all `M: Kinematic`.
        + Debug
        + PartialEq
        + From<<Self::P as Dim>::Array<Q>>
        + Into<<Self::P as Dim>::Array<Q>>;
    /// A quantity for each output by name; without outputs an empty list.
    type Outputs<Q: Quantity>: Copy
        + Debug
        + PartialEq
        + From<<Self::O as Dim>::Array<Q>>
        + Into<<Self::O as Dim>::Array<Q>>;

    /// The names of the points, in order.
    const POINTS: &'static [&'static str] = &[];
    /// The names of the outputs, in order.
    const OUTPUTS: &'static [&'static str] = &[];

    /// The name of a point, in order; empty beyond the last.
    #[inline]
    fn point_name(&self, place: usize) -> Self::Name {
        Name::from_static(Self::POINTS.get(place).copied().unwrap_or_default())
    }
    /// The name of an output, in order; empty beyond the last.
    #[inline]
    fn output_name(&self, place: usize) -> Self::Name {
        Name::from_static(Self::OUTPUTS.get(place).copied().unwrap_or_default())
    }

    /// The coordinates of a position; an angle that it stores as a direction alone is between -pi and pi, unless the pose keeps
    /// the coordinates that it is made of, as one at run time does.
    fn coordinates_of(pose: &Self::Pose) -> Self::Coordinates;
    /// The rates q' at the rates v' of the inputs.
    ///
    /// # Errors
    /// [`PositionError::Singular`](crate::PositionError::Singular) if J is singular,
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a rate is not finite.
    fn velocity(&self, pose: &Self::Pose, input_rates: Self::Inputs) -> Result<Self::Rates, PositionErrorOf<Self>>;
    /// The accelerations `q''` at the rates `q'` and the accelerations `v''` of the inputs.
    ///
    /// # Errors
    /// [`PositionError::Singular`](crate::PositionError::Singular) if J is singular,
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if an acceleration is not finite.
    fn acceleration(
        &self,
        pose: &Self::Pose,
        rates: &Self::Rates,
        input_accelerations: Self::Inputs,
    ) -> Result<Self::Accelerations, PositionErrorOf<Self>>;
    /// The position at the inputs of `guess` on this branch, with its rates and accelerations, in one computation. Groups
    /// without a closed form are solved by Newton's method from the guess; a position in closed form depends on the inputs
    /// alone, and at a change point a branch may jump to another motion.
    ///
    /// # Errors
    /// The error that the separate calls for position, velocity and acceleration return first.
    fn kinematics(
        &self,
        guess: &Self::Coordinates,
        branch: Self::Branch,
        input_rates: Self::Inputs,
        input_accelerations: Self::Inputs,
    ) -> Result<KinematicsOf<Self>, PositionErrorOf<Self>>;
    /// The rates, the accelerations, and the motion of points and outputs at the coordinates q of a position, in one
    /// computation.
    ///
    /// # Errors
    /// [`PositionError::Singular`](crate::PositionError::Singular) if J is singular,
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a coordinate or a result is not
    /// finite.
    fn motion(
        &self,
        q: &Self::Coordinates,
        input_rates: Self::Inputs,
        input_accelerations: Self::Inputs,
    ) -> Result<MotionOf<Self>, PositionErrorOf<Self>>;

    /// [`kinematics`](Self::kinematics) with the motion of points and outputs. A mechanism without points and outputs
    /// needs no body of it.
    ///
    /// # Errors
    /// Those of `kinematics`, and [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn full_kinematics(
        &self,
        guess: &Self::Coordinates,
        branch: Self::Branch,
        input_rates: Self::Inputs,
        input_accelerations: Self::Inputs,
    ) -> Result<FullKinematicsOf<Self>, PositionErrorOf<Self>> {
        let Kinematics { pose, rates, accelerations } =
            self.kinematics(guess, branch, input_rates, input_accelerations)?;
        let zero = Self::Scalar::zero();
        let point =
            PointMotion { position: Point2::origin(), velocity: Vector2::zeros(), acceleration: Vector2::zeros() };
        let output = OutputMotion { value: zero, rate: zero, acceleration: zero };
        let (points, outputs) = (none::<Self::P, _, _>(point), none::<Self::O, _, _>(output));
        Ok(FullKinematics { pose, rates, accelerations, points, outputs })
    }
    /// The velocity ratios W = -J^-1 A with u' = W v'. A mechanism without unknowns needs no body of it.
    ///
    /// # Errors
    /// [`PositionError::Singular`](crate::PositionError::Singular) if J is singular,
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a ratio is not finite.
    fn velocity_ratios(&self, _: &Self::Pose) -> Result<Ratios<Self, Self::U>, PositionErrorOf<Self>> {
        const { no_unknowns::<Self>() };
        let (u, v, _) = self.dims();
        Ok(u.zero_matrix(v))
    }
    /// The velocity ratios by name: for each input, in the order of [`INPUTS`](Mechanism::INPUTS), the rates of all
    /// coordinates while this input alone moves, at the rate 1.
    ///
    /// # Errors
    /// [`PositionError::Singular`](crate::PositionError::Singular) if J is singular,
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a ratio is not finite.
    fn ratios_by_input(&self, pose: &Self::Pose) -> Result<Column<Self::Rates, Self::V>, PositionErrorOf<Self>> {
        let ratios = self.velocity_ratios(pose)?;
        let (_, v) = ratios.dims();
        Ok(v.column(|input| Self::rates(ratios.column(input), v.unit(input))))
    }
    /// The points. A mechanism without points needs no body of this and of the next three functions.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn points(&self, _: &Self::Pose) -> Result<Self::Points<Point2<Self::Scalar>>, PositionErrorOf<Self>> {
        Ok(none::<Self::P, _, _>(Point2::origin()))
    }
    /// The velocities of the points at the rates q'.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn point_velocities(
        &self,
        _: &Self::Pose,
        _: &Self::Rates,
    ) -> Result<Self::Points<Vector2<Self::Scalar>>, PositionErrorOf<Self>> {
        Ok(none::<Self::P, _, _>(Vector2::zeros()))
    }
    /// The accelerations of the points at the rates `q'` and the accelerations `q''`.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn point_accelerations(
        &self,
        _: &Self::Pose,
        _: &Self::Rates,
        _: &Self::Accelerations,
    ) -> Result<Self::Points<Vector2<Self::Scalar>>, PositionErrorOf<Self>> {
        Ok(none::<Self::P, _, _>(Vector2::zeros()))
    }
    /// For each point the matrix of its velocity by the rates of the inputs.
    ///
    /// # Errors
    /// [`PositionError::Singular`](crate::PositionError::Singular) if J is singular,
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn point_ratios(&self, _: &Self::Pose) -> Result<Self::Points<Ratios<Self, D<2>>>, PositionErrorOf<Self>> {
        Ok(none::<Self::P, _, _>(D.zero_matrix(self.dims().1)))
    }
    /// The outputs. A mechanism without outputs needs no body of this and of the next three functions.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn outputs(&self, _: &Self::Pose) -> Result<Self::Outputs<Self::Scalar>, PositionErrorOf<Self>> {
        Ok(none::<Self::O, _, _>(Self::Scalar::zero()))
    }
    /// The rates of the outputs at the rates q'.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn output_rates(&self, _: &Self::Pose, _: &Self::Rates) -> Result<Self::Outputs<Self::Scalar>, PositionErrorOf<Self>> {
        Ok(none::<Self::O, _, _>(Self::Scalar::zero()))
    }
    /// The second derivatives of the outputs at the rates `q'` and the accelerations `q''`.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn output_accelerations(
        &self,
        _: &Self::Pose,
        _: &Self::Rates,
        _: &Self::Accelerations,
    ) -> Result<Self::Outputs<Self::Scalar>, PositionErrorOf<Self>> {
        Ok(none::<Self::O, _, _>(Self::Scalar::zero()))
    }
    /// For each output the row of its rate by the rates of the inputs.
    ///
    /// # Errors
    /// [`PositionError::Singular`](crate::PositionError::Singular) if J is singular,
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a result is not finite.
    fn output_ratios(&self, _: &Self::Pose) -> Result<Self::Outputs<Ratios<Self, D<1>>>, PositionErrorOf<Self>> {
        Ok(none::<Self::O, _, _>(D.zero_matrix(self.dims().1)))
    }

    /// Combines `u''` and `v''` into `q''`.
    #[inline]
    fn accelerations(unknowns: PerUnknown<Self>, inputs: PerInput<Self>) -> Self::Accelerations {
        let listed: PerCoordinate<Self> = Self::rates(unknowns, inputs).into();
        Self::Accelerations::from(listed)
    }
    /// Splits `q''` into `u''` and `v''`.
    #[inline]
    fn acceleration_parts(accelerations: &Self::Accelerations) -> (PerUnknown<Self>, PerInput<Self>) {
        let listed: PerCoordinate<Self> = (*accelerations).into();
        Self::rate_parts(&Self::Rates::from(listed))
    }
    /// A quantity for each point as a list.
    #[inline]
    fn each_point<Q: Quantity>(points: Self::Points<Q>) -> Column<Q, Self::P> {
        Column::of(points.into())
    }
    /// A quantity for each output as a list.
    #[inline]
    fn each_output<Q: Quantity>(outputs: Self::Outputs<Q>) -> Column<Q, Self::O> {
        Column::of(outputs.into())
    }
}

/// The quantities of points or outputs that a mechanism does not have; a mechanism that has some does not compile without
/// functions of its own.
#[inline]
fn none<N: Dim, Q: Quantity, G: From<N::Array<Q>>>(like: Q) -> G {
    const { assert!(N::CAPACITY == 0, "a mechanism with points or outputs has functions that compute them") };
    N::least().array(|_| like).into()
}
